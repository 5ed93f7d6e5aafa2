//! Superfluid helium returns to its first bit, on every executor, and keeps what it must.

use loschmidt_core::number::Quantity;
use loschmidt_core::schemes::superfluid::{
    DissipativeSuperfluid, ENTROPY, ENTROPY_COPY, Friction, Helium, HeliumParameters, Operators,
    PaperSuperfluid, Superfluid,
};
use loschmidt_core::{Diagnostics, FaultKind, Fixed, Model, Reversibility, Serial};
use loschmidt_runner::scene::{GivenField, InitialState};
use loschmidt_tests::conformance::{self, Plain};
use loschmidt_tests::helium::{SPACING, drop, stirred};
use loschmidt_tests::permitted;

const OPERATORS: [Operators; 2] = [Operators::Paper, Operators::Renormalised];

fn superfluid<const D: usize>(operators: Operators) -> Superfluid<Fixed, D> {
    Superfluid::new(drop(operators)).unwrap()
}

#[test]
fn in_the_plane_every_executor_leaves_the_bits_of_the_plain_steps() {
    for operators in OPERATORS {
        let state = stirred([14, 11], 2.0, 0.05, 1);
        let model = || superfluid::<2>(operators);
        conformance::check(model, &state, &[1, 2, 25]).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn in_space_every_executor_leaves_the_bits_of_the_plain_steps() {
    for operators in OPERATORS {
        let state = stirred([7, 6, 5], 2.0, 0.05, 2);
        let model = || superfluid::<3>(operators);
        conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn with_the_papers_integrator_every_executor_leaves_the_bits_of_the_plain_steps() {
    let state = stirred([14, 11], 1.0, 0.02, 3);
    let model = || PaperSuperfluid::<Fixed, 2>::new(drop(Operators::Paper)).unwrap();
    conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    let of = <PaperSuperfluid<Fixed, 2> as Model<Fixed, 2>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::Irreversible);
}

/// Digest, energies and conserved sums of what is looked at.
fn look<M: Model<Fixed, D>, const D: usize>(drop: &mut Plain<M, D>) -> (Diagnostics, [i128; 2]) {
    let (model, mut system) = drop.parts();
    let seen = Diagnostics::measure(model, &mut system, &Serial).unwrap();
    let sum = |field: usize| -> i128 {
        let words = system.particles.words(field).iter();
        words.map(|word| i128::from(word.whole_quanta())).sum()
    };
    (seen, [sum(ENTROPY), sum(ENTROPY_COPY)])
}

fn steps<M: Model<Fixed, D>, const D: usize>(drop: &mut Plain<M, D>, steps: u64) {
    for _ in 0..steps {
        let (model, mut system) = drop.parts();
        model.step(&mut system, &Serial).unwrap();
    }
}

fn plain<M: Model<Fixed, D>, const D: usize>(model: M, state: &InitialState) -> Plain<M, D> {
    let mut plain = Plain::new(model, state);
    plain.initialise().unwrap();
    plain
}

fn returns<const D: usize>(counts: [usize; D], there: u64) {
    for operators in OPERATORS {
        let mut parameters = drop::<D>(operators);
        parameters.gravity[D - 1] = -9.8;
        let mut state = stirred(counts, 2.0, 0.05, 4);
        // One particle is alone for the whole run.
        state.fluid[0] = [60.0 * SPACING, 0.0, 0.0];
        let mut drop = plain(Superfluid::<Fixed, D>::new(parameters).unwrap(), &state);
        let digest = |drop: &mut Plain<Superfluid<Fixed, D>, D>| {
            let (model, system) = drop.parts();
            loschmidt_core::digest::digest(&system, &model.scale())
        };
        let home = digest(&mut drop);
        steps(&mut drop, there);
        assert_ne!(digest(&mut drop), home);
        drop.parts().1.reverse();
        steps(&mut drop, there);
        drop.parts().1.reverse();
        assert_eq!(digest(&mut drop), home, "{operators:?}");
        let lone = if operators == Operators::Paper { 0 } else { 1 };
        assert_eq!(look(&mut drop).0.lone_particles, lone);
    }
}

#[test]
fn a_stirred_drop_returns_to_its_first_bit() {
    returns([12, 10], 200);
    returns([6, 5, 4], 60);
}

#[test]
fn momentum_and_both_entropies_stay_to_the_last_bit() {
    for operators in OPERATORS {
        let model = superfluid::<3>(operators);
        let mut drop = plain(model, &stirred([6, 5, 4], 2.0, 0.05, 5));
        let (first, entropies) = look(&mut drop);
        steps(&mut drop, 40);
        let (second, later) = look(&mut drop);
        assert_ne!(first.momentum_quanta, [0; 3]);
        assert_eq!(first.momentum_quanta, second.momentum_quanta);
        assert_ne!(entropies, [0; 2]);
        assert_eq!(entropies, later);
        let total = |seen: &Diagnostics| seen.totals.get("thermodynamic entropy");
        assert_eq!(total(&first), total(&second));
    }
}

/// The sum of what kinds of energy have gained or lost, and the largest of it.
fn exchanged(before: &Diagnostics, after: &Diagnostics) -> [f64; 2] {
    let pairs = before.energies.iter().zip(after.energies.iter());
    pairs.fold([0.0; 2], |[sum, most]: [f64; 2], ((_, a), (_, b))| {
        [sum + (b - a), most.max((b - a).abs())]
    })
}

#[test]
fn all_kinds_of_energy_together_stay_where_steps_are_short() {
    fn check<const D: usize>(counts: [usize; D]) {
        for operators in OPERATORS {
            let mut parameters = drop::<D>(operators);
            parameters.time_step *= 1e-3;
            parameters.gravity[0] = 9.8;
            let model = Superfluid::<Fixed, D>::new(parameters).unwrap();
            let mut drop = plain(model, &stirred(counts, 2.0, 0.05, 6));
            // The first step is the one in which densities leave what they are at the start.
            steps(&mut drop, 100);
            let before = look(&mut drop).0;
            steps(&mut drop, 10);
            let [sum, most] = exchanged(&before, &look(&mut drop).0);
            let error = (sum / most).abs();
            assert!(
                error < permitted::ENERGY_OF_SHORT_STEPS,
                "{operators:?}: {error:e}"
            );
        }
    }
    check([10, 8]);
    check([6, 5, 4]);
}

/// Largest error of the energy over the same time with steps of these fractions of the usual one.
fn energy_error<M: Model<Fixed, 2>>(make: impl Fn(f64) -> M, parts: u64) -> f64 {
    let mut drop = plain(make(1.0 / parts as f64), &stirred([10, 8], 1.0, 0.02, 7));
    let first = look(&mut drop).0.energies.total();
    steps(&mut drop, 40 * parts);
    (look(&mut drop).0.energies.total() - first).abs()
}

#[test]
fn the_reversible_scheme_is_of_second_order_and_the_papers_of_first() {
    let at = |share: f64| {
        let mut parameters = drop::<2>(Operators::Paper);
        parameters.time_step *= share;
        parameters
    };
    let ours = |share: f64| Superfluid::<Fixed, 2>::new(at(share)).unwrap();
    let paper = |share: f64| PaperSuperfluid::<Fixed, 2>::new(at(share)).unwrap();
    let order = |errors: [f64; 2]| (errors[0] / errors[1]).log2();
    let ours = [2, 4].map(|parts| energy_error(ours, parts));
    let paper = [2, 4].map(|parts| energy_error(paper, parts));
    println!("{ours:?} {paper:?}");
    assert!(
        (order(ours) - 2.0).abs() < permitted::ORDER_OF_A_SUPERFLUID,
        "{ours:?}"
    );
    assert!(
        (order(paper) - 1.0).abs() < permitted::ORDER_OF_A_SUPERFLUID,
        "{paper:?}"
    );
    assert!(ours[1] < 0.2 * paper[1], "{ours:?} {paper:?}");
}

#[test]
fn the_temperature_is_the_derivative_of_the_energy_by_the_entropy() {
    for helium in [Helium::AT_1_65_K, Helium::AT_1_90_K] {
        for (excess, squared) in [(0.0, 0.0), (20.0, 0.0), (-10.0, 9.0), (5.0, 25.0)] {
            let energy = |excess: f64| {
                let thermal = helium.thermal_energy(excess);
                helium.counterflow_energy(excess, squared) + thermal
            };
            let h = 1e-3;
            let difference = (energy(excess + h) - energy(excess - h)) / (2.0 * h);
            let error = difference - helium.warming(excess, squared);
            assert!(error.abs() < permitted::TEMPERATURE_OF_HELIUM, "{error:e}");
        }
        let pressure = |density: f64| {
            let h = 1e-4;
            let energy = |density: f64| helium.compression_energy(density - 1.0);
            let slope = (energy(density + h) - energy(density - h)) / (2.0 * h);
            helium.reference_density * density * density * slope
        };
        let error = pressure(1.01) / helium.pressure(1.01) - 1.0;
        assert!(error.abs() < 1e-6, "{error:e}");
    }
}

#[test]
fn second_sound_is_as_fast_as_table_i_says() {
    for (helium, speed) in [(Helium::AT_1_65_K, 20.37), (Helium::AT_1_90_K, 18.83)] {
        assert!((helium.second_sound() - speed).abs() < 0.005);
    }
}

#[test]
fn copies_that_are_too_far_apart_end_the_run() {
    let mut parameters = drop::<2>(Operators::Renormalised);
    parameters.most_separation = 1e-9;
    let model = Superfluid::<Fixed, 2>::new(parameters).unwrap();
    let mut drop = plain(model, &stirred([8, 8], 2.0, 0.05, 8));
    let (model, mut system) = drop.parts();
    let fault = model.step(&mut system, &Serial).expect_err("apart");
    assert_eq!((fault.kind, fault.step), (FaultKind::CopiesApart, 1));
}

#[test]
fn entropies_without_a_normal_component_end_the_run() {
    let mut state = stirred::<2>([8, 8], 0.0, 0.0, 9);
    // χ_n is 0 at s - s0 = -736 J/(kg K).
    let entropy = state.given.iter_mut().find(|field| field.name == "entropy");
    entropy.expect("given").values[7] = [-1.02, 0.0, 0.0];
    let mut drop = plain(superfluid::<2>(Operators::Paper), &state);
    let (model, mut system) = drop.parts();
    let fault = model.step(&mut system, &Serial).expect_err("no fraction");
    assert_eq!((fault.kind, fault.particle), (FaultKind::NormalFraction, 7));
}

#[test]
fn cube_roots_are_those_of_the_library() {
    for k in 0..=1200 {
        let x = 2f64.powf(f64::from(k - 600) / 100.0);
        let error = loschmidt_core::number::root::<3>(x) / x.cbrt() - 1.0;
        assert!(error.abs() < permitted::CUBE_ROOT, "{x}: {error:e}");
    }
    assert_eq!(loschmidt_core::number::root::<3>(1.0), 1.0);
}

fn rubbing<const D: usize>() -> DissipativeSuperfluid<Fixed, D> {
    let mut parameters = drop::<D>(Operators::Renormalised);
    parameters.viscosity = 1e-3;
    parameters.diffusion = 20.0;
    Friction::superfluid(parameters).unwrap()
}

#[test]
fn with_friction_every_executor_leaves_the_bits_of_the_plain_steps() {
    let state = stirred([14, 11], 2.0, 0.05, 10);
    conformance::check(rubbing::<2>, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    let state = stirred([7, 6, 5], 2.0, 0.05, 11);
    conformance::check(rubbing::<3>, &state, &[1, 2, 8]).unwrap_or_else(|e| panic!("{e}"));
    let of = <DissipativeSuperfluid<Fixed, 2> as Model<Fixed, 2>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::Dissipative);
}

#[test]
fn friction_keeps_momentum_and_energy_and_makes_entropy() {
    fn check<const D: usize>(counts: [usize; D], each: u64) {
        // Short steps: the reversible part, of second order, loses little.
        let mut parameters = rubbing::<D>().0.liquid().parameters().clone();
        parameters.time_step *= 0.02;
        let model = Friction::superfluid(parameters).unwrap();
        let mut drop = plain(model, &stirred(counts, 2.0, 0.05, 12));
        let first = look(&mut drop).0;
        let mut before = first.clone();
        let entropy = |seen: &Diagnostics| seen.totals.get("thermodynamic entropy").unwrap();
        for _ in 0..10 {
            steps(&mut drop, each);
            let now = look(&mut drop).0;
            assert_eq!(now.momentum_quanta, first.momentum_quanta);
            assert!(entropy(&now) > entropy(&before));
            before = now;
        }
        let heat = before.energies.get("heat") - first.energies.get("heat");
        let total = before.energies.total() - first.energies.total();
        println!("heat {heat:e} J, error {total:e} J");
        assert!(heat > 0.0);
        assert!(
            (total / heat).abs() < permitted::ENERGY_OF_FRICTION,
            "{total:e} of {heat:e}"
        );
        // The copies are one but for a quantum of each step.
        assert!(before.totals.get("separation of counterflow").unwrap() < 1e-2);
    }
    check([12, 10], 20);
    check([6, 5, 4], 10);
}

/// Helium that is all normal, without waves of second sound.
fn normal(viscosity: f64, diffusion: f64) -> HeliumParameters<2> {
    let mut parameters = drop::<2>(Operators::Paper);
    // On a square lattice the sum of friction is isotropic for wide kernels alone.
    parameters.support_radius = 6.0 * SPACING;
    parameters.helium.normal_fraction = 1.0;
    parameters.helium.fraction_slope = 0.0;
    parameters.viscosity = viscosity;
    parameters.diffusion = diffusion;
    parameters
}

/// The rate at which a wave along y decays inside of a square, over that of the continuum.
fn decay(parameters: HeliumParameters<2>, rate: f64, field: &'static str) -> f64 {
    let mut state = loschmidt_tests::bodies::block([54, 54]);
    let factor = SPACING / loschmidt_tests::bodies::SPACING;
    let k = 2.0 * std::f64::consts::PI / (40.0 * SPACING);
    let mut entropies = Vec::new();
    for (x, v) in state.fluid.iter_mut().zip(&mut state.fluid_velocity) {
        *x = x.map(|x| x * factor);
        let wave = (k * x[1]).sin();
        if field == "velocity" {
            v[0] = 1e-3 * wave;
        }
        entropies.push([if field == "entropy" { 1e-3 * wave } else { 0.0 }, 0.0, 0.0]);
    }
    state.given.push(GivenField {
        name: "entropy",
        values: entropies,
    });
    let (step, quantum) = (parameters.time_step, parameters.scale.speed_quantum());
    let mut drop = plain(Friction::superfluid(parameters).unwrap(), &state);
    let amplitude = |drop: &mut Plain<DissipativeSuperfluid<Fixed, 2>, 2>| {
        let (_, system) = drop.parts();
        let [mut product, mut square] = [0.0; 2];
        for (place, id) in system.particles.id.iter().enumerate() {
            let x = state.fluid[*id as usize];
            if x[0].abs().max(x[1].abs()) > 15.0 * SPACING {
                continue;
            }
            let wave = (k * x[1]).sin();
            let value = if field == "velocity" {
                system.particles.velocity()[place][0].quanta() * quantum
            } else {
                system.particles.words(ENTROPY)[place].quanta()
            };
            product += wave * value;
            square += wave * wave;
        }
        product / square
    };
    let first = amplitude(&mut drop);
    // Faces act on what is within two supports of them.
    let count = 5;
    steps(&mut drop, count);
    let last = amplitude(&mut drop);
    (first / last).ln() / (count as f64 * step) / (rate * k * k)
}

#[test]
fn a_shear_wave_and_a_wave_of_warmth_decay_as_they_should() {
    let helium = Helium::AT_1_90_K;
    let viscosity = 1e-3;
    let shear = decay(
        normal(viscosity, 0.0),
        viscosity / helium.reference_density,
        "velocity",
    );
    let diffusion = 500.0;
    let capacity = helium.reference_density * helium.heat_capacity / helium.temperature;
    let warmth = decay(normal(0.0, diffusion), diffusion / capacity, "entropy");
    println!("of the decay: shear {shear}, warmth {warmth}");
    assert!((shear - 1.0).abs() < permitted::DECAY, "{shear}");
    assert!((warmth - 1.0).abs() < permitted::DECAY, "{warmth}");
}

#[test]
fn temperatures_below_zero_end_the_run() {
    let mut parameters = drop::<2>(Operators::Paper);
    // s0 - C is above 0.
    parameters.helium.heat_capacity = 100.0;
    parameters.helium.fraction_slope = 0.0;
    let mut state = stirred::<2>([8, 8], 0.0, 0.0, 13);
    let entropy = state.given.iter_mut().find(|field| field.name == "entropy");
    entropy.expect("given").values[5] = [-0.2, 0.0, 0.0];
    let mut drop = plain(Superfluid::<Fixed, 2>::new(parameters).unwrap(), &state);
    let (model, mut system) = drop.parts();
    let fault = model.step(&mut system, &Serial).expect_err("too cold");
    assert_eq!((fault.kind, fault.particle), (FaultKind::Temperature, 5));
}
