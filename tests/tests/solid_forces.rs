//! Every force of a solid is minus the gradient of its energy, along the motion of its distortion.

use loschmidt_core::integrator::Stage::{Drift, Kick, Lift};
use loschmidt_core::model::Model;

use loschmidt_core::schemes::solid::{
    DISTORTION, LOG_VOLUME, Material, Parameters, ShearEnergy, Solid,
};
use loschmidt_core::{Diagnostics, Energies, Float, Serial, System};
use loschmidt_runner::scene::InitialState;
use loschmidt_tests::bodies::{Body, SPACING, block, body, free_body, material};
use loschmidt_tests::generator::Generator;
use loschmidt_tests::permitted;

type Floating<const D: usize> = Body<Solid<Float, D>, D, Float>;

fn energies<const D: usize>(body: &mut Floating<D>) -> Energies {
    let (model, mut system) = body.parts();
    Diagnostics::measure(model, &mut system, &Serial)
        .unwrap()
        .energies
}

/// Potential energy.
fn potential(energies: &Energies) -> f64 {
    energies.total() - energies.get("kinetic")
}

/// The words of the state.
fn words<const D: usize>(body: &mut Floating<D>) -> Vec<Vec<f64>> {
    let system = body.parts().1;
    (0..=LOG_VOLUME)
        .map(|field| system.particles.words(field).to_vec())
        .collect()
}

fn put<const D: usize>(system: &mut System<'_, Float, D>, words: &[Vec<f64>]) {
    for (field, words) in words.iter().enumerate() {
        system.particles.words_mut(field).copy_from_slice(words);
    }
}

/// Particles displaced by up to a tenth of their distance, distortions by a tenth.
fn disordered<const D: usize>(
    parameters: Parameters<D>,
    state: &InitialState,
    seed: u64,
) -> Floating<D> {
    let spacing = SPACING / parameters.scale.length_quantum();
    let one = 2f64.powi(48);
    let mut body = body::<Float, _, D>(Solid::new(parameters).unwrap(), state);
    let mut generator = Generator::new(seed);
    let mut system = body.parts().1;
    for (field, size) in [
        (0, 0.1 * spacing),
        (DISTORTION, 0.1 * one),
        (LOG_VOLUME, 0.02 * one),
    ] {
        for word in system.particles.words_mut(field) {
            *word += size * generator.signed();
        }
    }
    body
}

/// Worst difference of work and fall of energy, relative, over some directions of motion.
fn worst<const D: usize>(body: &mut Floating<D>, seed: u64) -> f64 {
    let home = words(body);
    let mut generator = Generator::new(seed);
    let mut worst = 0.0f64;
    for direction in 0..4 {
        // The last one moves one particle at the surface alone.
        let mut velocity: Vec<f64> = home[1].iter().map(|_| generator.signed()).collect();
        if direction == 3 {
            velocity[D..].fill(0.0);
        }
        let (model, mut system) = body.parts();
        let p = model.bodies().parameters().clone();
        let to_quanta = 1.0 / p.scale.speed_quantum();
        // About 1e-4 spacings in a step.
        let speed = 1e-4 * SPACING / p.time_step * to_quanta;
        put(&mut system, &home);
        model.prepare(Kick(1.0), &mut system, &Serial).unwrap();
        let impulse = system.particles.words(2).to_vec();
        let work: f64 = impulse.iter().zip(&velocity).map(|(j, v)| j * v).sum();
        let unit = p.mass() * p.scale.speed_quantum() * p.scale.speed_quantum();
        let expected = -work * speed * unit;
        let mut after = |factor: f64| {
            let (model, mut system) = body.parts();
            put(&mut system, &home);
            let moving = system.particles.words_mut(1).iter_mut().zip(&velocity);
            moving.for_each(|(word, v)| *word = factor * v * speed);
            for stage in [Lift(0.5), Drift(1.0), Lift(0.5)] {
                model.prepare(stage, &mut system, &Serial).unwrap();
                model.apply(stage, &mut system, &Serial).unwrap();
            }
            potential(&energies(body))
        };
        // Central differences over one and two steps, without the cubic term of both.
        let mut difference = |factor: f64| (after(factor) - after(-factor)) / (2.0 * factor);
        let found = (4.0 * difference(1.0) - difference(2.0)) / 3.0;
        worst = worst.max((found / expected - 1.0).abs());
    }
    worst
}

fn check<const D: usize>(counts: [usize; D], penalty: f64) {
    for energy in [ShearEnergy::Dpr, ShearEnergy::NeoHookean] {
        let material = Material {
            penalty_speed: penalty,
            ..material(energy)
        };
        let mut body = disordered(free_body::<D>(material), &block(counts), 1);
        let worst = worst(&mut body, 2);
        println!("{D} dimensions, {energy:?}, c_p {penalty}: {worst:e}");
        assert!(worst < permitted::FORCE_OF_A_SOLID, "{energy:?}: {worst:e}");
    }
}

#[test]
fn in_the_plane() {
    check([10, 6], 0.0);
    check([10, 6], 200.0);
}

#[test]
fn in_space() {
    check([5, 4, 3], 0.0);
    check([5, 4, 3], 200.0);
}
