//! Elastic bodies return to their first bit, on every executor, and keep what they must.

use loschmidt_core::schemes::solid::{Material, Midpoint, Part, ShearEnergy, Solid};
use loschmidt_core::{Diagnostics, Fixed, Float, Model, Reversibility, Serial};
use loschmidt_tests::bodies::{SPACING, block, body, free_body, material, stir};
use loschmidt_tests::conformance;
use loschmidt_tests::permitted;

const ENERGIES: [ShearEnergy; 2] = [ShearEnergy::Dpr, ShearEnergy::NeoHookean];

#[test]
fn in_the_plane_every_executor_leaves_the_bits_of_the_plain_steps() {
    for energy in ENERGIES {
        let parameters = free_body::<2>(material(energy));
        let mut state = block([24, 10]);
        stir::<2>(&mut state, 0.4, 0.5, 1);
        let model = || Solid::<Fixed, 2>::new(parameters.clone()).unwrap();
        conformance::check(model, &state, &[1, 2, 25]).unwrap_or_else(|e| panic!("{e}"));
        let model = || Solid::<Float, 2>::new(parameters.clone()).unwrap();
        conformance::check(model, &state, &[1, 12]).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn in_space_every_executor_leaves_the_bits_of_the_plain_steps() {
    for energy in ENERGIES {
        let parameters = free_body::<3>(material(energy));
        let mut state = block([8, 6, 5]);
        stir::<3>(&mut state, 0.4, 0.5, 2);
        let model = || Solid::<Fixed, 3>::new(parameters.clone()).unwrap();
        conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn with_the_papers_integrator_every_executor_leaves_the_bits_of_the_plain_steps() {
    let parameters = free_body::<2>(material(ShearEnergy::Dpr));
    let mut state = block([24, 10]);
    stir::<2>(&mut state, 0.4, 0.5, 3);
    let model = || Midpoint::<Fixed, 2>::new(parameters.clone()).unwrap();
    conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    let of = <Midpoint<Fixed, 2> as Model<Fixed, 2>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::UpToRounding);
}

/// Two bodies of different material, one of them held at its end, on their way into each other.
#[test]
fn two_bodies_and_a_clamp_return() {
    let soft = Material {
        shear_speed: 8.0,
        ..material(ShearEnergy::NeoHookean)
    };
    let mut parameters = free_body::<2>(material(ShearEnergy::Dpr));
    parameters.materials.push(soft).unwrap();
    let mut state = block([8, 8]);
    let other = block([6, 6]);
    for x in &other.fluid {
        state.fluid.push([x[0] + 10.5 * SPACING, x[1] + 0.2, 0.0]);
        state.fluid_velocity.push([-3.0, 0.0, 0.0]);
    }
    let part = |first, body, held| Part {
        first,
        body,
        held,
        ..Part::default()
    };
    parameters.parts = [part(0, 0, true), part(16, 0, false), part(64, 1, false)]
        .into_iter()
        .collect();
    let model = || Solid::<Fixed, 2>::new(parameters.clone()).unwrap();
    conformance::check(model, &state, &[1, 2, 12, 400]).unwrap_or_else(|e| panic!("{e}"));

    let mut body = body::<Fixed, _, 2>(model(), &state);
    let held = |body: &mut loschmidt_tests::bodies::Body<Solid<Fixed, 2>, 2>| {
        let system = body.parts().1;
        let held = system.particles.id.iter().zip(system.particles.position());
        held.filter(|(id, _)| **id < 16)
            .map(|(_, x)| *x)
            .collect::<Vec<_>>()
    };
    let first = held(&mut body);
    body.advance(400, &Serial).unwrap();
    assert_eq!(held(&mut body), first, "what is held has moved");
}

#[test]
fn momentum_stays_to_the_last_bit_and_angular_momentum_up_to_rounding() {
    for energy in ENERGIES {
        let mut state = block([6, 6, 5]);
        stir::<3>(&mut state, 0.4, 0.5, 4);
        let model = Solid::<Fixed, 3>::new(free_body(material(energy))).unwrap();
        let mut body = body(model, &state);
        let mut look = || {
            let (model, mut system) = body.parts();
            let seen = Diagnostics::measure(model, &mut system, &Serial).unwrap();
            body.advance(100, &Serial).unwrap();
            seen
        };
        let first = look();
        let second = look();
        assert_ne!(first.momentum_quanta, [0; 3]);
        assert_eq!(first.momentum_quanta, second.momentum_quanta);
        for (a, b) in first.angular_momentum.iter().zip(second.angular_momentum) {
            let drift = (a - b).abs() / a.abs();
            assert!(drift < permitted::ANGULAR_MOMENTUM, "{drift:e}");
        }
    }
}

#[test]
fn particles_that_have_torn_off_are_counted() {
    let parameters = free_body::<2>(material(ShearEnergy::Dpr));
    let count = |state: &loschmidt_runner::scene::InitialState| {
        let model = Solid::<Fixed, 2>::new(parameters.clone()).unwrap();
        let mut body = body::<Fixed, _, 2>(model, state);
        let (model, mut system) = body.parts();
        let seen = Diagnostics::measure(model, &mut system, &Serial).unwrap();
        seen.lone_particles
    };
    let mut state = block([8, 8]);
    assert_eq!(count(&state), 0, "corners are no lone particles");
    // One alone, and a row of two, whose neighbours lie on a line.
    for x in [[20.0, 0.0], [0.0, 20.0], [1.0, 20.0]] {
        state.fluid.push([x[0] * SPACING, x[1] * SPACING, 0.0]);
        state.fluid_velocity.push([0.0; 3]);
    }
    assert_eq!(count(&state), 3);
}
