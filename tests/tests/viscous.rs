//! Viscous fluids: the viscosity is that of the parameters, heat and work balance, walls are seen as
//! they are said to be, and no executor changes a bit.

use loschmidt_core::model::Relax;
use loschmidt_core::number::{Quantity, power_of_two};
use loschmidt_core::schemes::solid::{
    DISTORTION, FluidParameters, HELD, Law, Material, Motion, Part, Relaxation, Relaxing,
    ShearEnergy, Viscous, WallVelocity, whole_metric,
};
use loschmidt_core::{Diagnostics, Fixed, Float, Model, Reversibility, Serial};
use loschmidt_runner::scene::{GivenField, InitialState};
use loschmidt_tests::bodies::{SPACING, block, free_body, material, stir};
use loschmidt_tests::conformance::{self, Plain};

/// A fluid in a box of walls three particles thick: what is within so many particles along each axis
/// from the middle flows. The walls above turn, those below slide.
fn boxed<const D: usize>(
    counts: [usize; D],
    relaxation: Relaxation,
    wall_velocity: WallVelocity,
) -> (FluidParameters<D>, InitialState) {
    let half = |d: usize| (counts[d] as f64 / 2.0 - 3.0) * SPACING;
    let all = block(counts);
    let part_of = |x: &[f64; 3]| {
        let up = x[1].abs() > half(1);
        match (0..D).any(|d| x[d].abs() > half(d)) {
            false => 0,
            true if up && x[1] > 0.0 => 1,
            true if up => 2,
            true => 3,
        }
    };
    let mut state = InitialState::default();
    let (mut parts, mut ways) = (Vec::new(), Vec::new());
    let motions = [
        Motion::Still,
        Motion::Turns {
            rate: [0.0, 0.0, 0.25],
            centre: [0.0, -0.5, 0.0],
        },
        Motion::Slides([0.5, 0.0, 0.0]),
        Motion::Still,
    ];
    for (part, motion) in motions.into_iter().enumerate() {
        parts.push(Part {
            first: state.fluid.len() as u64,
            body: 0,
            held: part > 0,
            motion,
        });
        for x in all.fluid.iter().filter(|x| part_of(x) == part) {
            state.fluid.push(*x);
            let mut way = [0.0; 3];
            for d in 0..D {
                way[d] = x[d].clamp(-half(d), half(d)) - x[d];
            }
            ways.push(way);
            state.fluid_velocity.push([0.0; 3]);
        }
    }
    state.given.push(GivenField {
        name: "wall offset",
        values: ways,
    });
    let mut bodies = free_body(material(ShearEnergy::Dpr));
    bodies.parts = parts.into_iter().collect();
    let parameters = FluidParameters {
        relaxation_time: 4.0 * bodies.time_step,
        bodies,
        relaxation,
        wall_velocity,
        start: 0.0,
    };
    (parameters, state)
}

/// The ways from the walls to the surface of the flow.
fn ways(state: &InitialState) -> Vec<[f64; 3]> {
    state.given("wall offset").expect("given").to_vec()
}

/// The same with a flow that is stirred.
fn stirred<const D: usize>(
    counts: [usize; D],
    relaxation: Relaxation,
    wall_velocity: WallVelocity,
) -> (FluidParameters<D>, InitialState) {
    let (parameters, mut state) = boxed(counts, relaxation, wall_velocity);
    stir::<D>(&mut state, 0.2, 0.3, 7);
    let ways = ways(&state);
    for (v, way) in state.fluid_velocity.iter_mut().zip(&ways) {
        if *way != [0.0; 3] {
            *v = [0.0; 3];
        }
    }
    (parameters, state)
}

#[test]
fn every_executor_leaves_the_bits_of_the_plain_steps() {
    for (relaxation, wall_velocity) in [
        (Relaxation::Exact, WallVelocity::Mirrored),
        (Relaxation::Paper, WallVelocity::Plain),
    ] {
        let (parameters, state) = stirred([18, 14], relaxation, wall_velocity);
        let model = || Relaxing::<Fixed, 2>::viscous(parameters.clone()).unwrap();
        conformance::check(model, &state, &[1, 2, 25]).unwrap_or_else(|e| panic!("{e}"));
        let model = || Relaxing::<Float, 2>::viscous(parameters.clone()).unwrap();
        conformance::check(model, &state, &[1, 12]).unwrap_or_else(|e| panic!("{e}"));
    }
    let (parameters, state) = stirred([9, 9, 8], Relaxation::Exact, WallVelocity::Mirrored);
    let model = || Relaxing::<Fixed, 3>::viscous(parameters.clone()).unwrap();
    conformance::check(model, &state, &[1, 2, 8]).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn the_type_says_that_there_is_no_way_back() {
    let of = <Viscous<Fixed, 2> as Model<Fixed, 2>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::Dissipative);
}

/// The steady stress in shear at the rate γ over that of the viscosity c_s² τ/6, at dt = `share` τ.
fn viscosity<const D: usize>(relaxation: Relaxation, share: f64) -> f64 {
    let (mut parameters, _) = boxed::<D>([7; D], relaxation, WallVelocity::Plain);
    let material: Material = parameters.bodies.materials[0];
    parameters.relaxation_time = parameters.bodies.time_step / share;
    let (dt, tau) = (parameters.bodies.time_step, parameters.relaxation_time);
    let law = Law::of(&parameters);
    // So slow that squares of the strain do not show.
    let rate = 1e-4 / tau;
    let mut a = [[0.0; D]; D];
    for (i, row) in a.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _ in 0..(60.0 / share).ceil() as usize + 200 {
        // A ← A (1 - dt L), exact for the L of a simple shear, whose square is zero.
        for row in &mut a {
            row[1] -= rate * dt * row[0];
        }
        a = law.relaxed(&a);
    }
    let stress = -material.shear_stress(&whole_metric(&a, 0.0))[0][1];
    stress / (material.shear_speed.powi(2) * tau / 6.0 * rate)
}

#[test]
fn the_viscosity_in_constant_shear_is_that_of_the_parameters_at_every_time_step() {
    for share in [0.01, 0.1, 1.0, 4.0] {
        for found in [
            viscosity::<2>(Relaxation::Exact, share),
            viscosity::<3>(Relaxation::Exact, share),
        ] {
            assert!((found - 1.0).abs() < 1e-4, "{found} at dt = {share} tau");
        }
    }
}

#[test]
fn in_space_the_viscosity_is_the_same_however_the_fluid_is_strained() {
    // Stretched along one axis or squeezed: of what is of second order in the strain nothing is left.
    let (mut parameters, _) = boxed::<3>([7; 3], Relaxation::Exact, WallVelocity::Plain);
    let material = parameters.bodies.materials[0];
    let dt = parameters.bodies.time_step;
    parameters.relaxation_time = dt / 10.0;
    let law = Law::of(&parameters);
    let viscosity = material.shear_speed.powi(2) * parameters.relaxation_time / 6.0;
    let rate = 0.005 / dt;
    for axial in [[1.0, 1.0, -2.0], [-1.0, -1.0, 2.0], [1.0, -1.0, 0.0]] {
        let mut a = [[0.0; 3]; 3];
        for (i, row) in a.iter_mut().enumerate() {
            row[i] = 1.0;
        }
        for _ in 0..200 {
            for (i, row) in a.iter_mut().enumerate() {
                row[i] *= (-rate * dt * axial[i]).exp();
            }
            a = law.relaxed(&a);
        }
        let stress = material.shear_stress(&whole_metric(&a, 0.0));
        let mean = (stress[0][0] + stress[1][1] + stress[2][2]) / 3.0;
        for i in 0..3 {
            let found = -(stress[i][i] - mean) / (2.0 * viscosity * rate);
            assert!((found - axial[i]).abs() < 0.02, "{found} for {axial:?}");
        }
    }
}

#[test]
fn the_papers_relaxation_makes_the_fluid_too_thin() {
    // x/(e^x - 1) of x = 6 dt/tau, but for the error of the fourth order.
    for (share, expected) in [(0.01, 0.970), (0.075, 0.792), (0.1, 0.732), (0.2, 0.561)] {
        let found = viscosity::<2>(Relaxation::Paper, share);
        assert!(
            (found - expected).abs() < 1e-3,
            "{found} at dt = {share} tau"
        );
    }
}

#[test]
fn a_time_step_at_which_the_papers_relaxation_grows_is_refused() {
    let (mut parameters, _) = boxed::<2>([8, 8], Relaxation::Paper, WallVelocity::Plain);
    parameters.relaxation_time = 2.0 * parameters.bodies.time_step;
    assert!(Relaxing::<Fixed, 2>::viscous(parameters.clone()).is_err());
    parameters.relaxation = Relaxation::Exact;
    assert!(Relaxing::<Fixed, 2>::viscous(parameters).is_ok());
}

/// Takes so many steps and measures.
fn after<const D: usize>(plain: &mut Plain<Viscous<Fixed, D>, D>, steps: usize) -> Diagnostics {
    let (model, mut system) = plain.parts();
    for _ in 0..steps {
        model.step(&mut system, &Serial).unwrap();
    }
    Diagnostics::measure(model, &mut system, &Serial).unwrap()
}

fn initialised<const D: usize>(
    parameters: FluidParameters<D>,
    state: &InitialState,
) -> Plain<Viscous<Fixed, D>, D> {
    let mut plain = Plain::new(Relaxing::viscous(parameters).unwrap(), state);
    plain.initialise().unwrap();
    plain
}

#[test]
fn a_vortex_in_a_closed_box_decays_into_heat() {
    let (mut parameters, mut state) =
        boxed::<2>([22, 22], Relaxation::Exact, WallVelocity::Mirrored);
    for part in &mut parameters.bodies.parts {
        part.motion = Motion::Still;
    }
    let pi = std::f64::consts::PI;
    let ways = ways(&state);
    for ((v, x), way) in state.fluid_velocity.iter_mut().zip(&state.fluid).zip(&ways) {
        if *way == [0.0; 3] {
            let angle = |d: usize| pi * (x[d] / (16.0 * SPACING) + 0.5);
            let (a, b) = (angle(0), angle(1));
            *v = [
                a.sin().powi(2) * (2.0 * b).sin(),
                -b.sin().powi(2) * (2.0 * a).sin(),
                0.0,
            ];
        }
    }
    let mut plain = initialised(parameters, &state);
    let first = after(&mut plain, 0).energies;
    let mut last = first;
    for _ in 0..10 {
        let now = after(&mut plain, 20).energies;
        assert!(now.get("heat") > last.get("heat"), "heat is not given back");
        last = now;
    }
    let kinetic = first.get("kinetic");
    assert!(last.get("kinetic") < 0.9 * kinetic, "it decays");
    let error = (last.total() - first.total()) / kinetic;
    assert!(error.abs() < 1e-3, "{error:e}");
}

#[test]
fn what_walls_put_in_is_what_the_fluid_keeps_and_heats() {
    for (relaxation, wall_velocity) in [
        (Relaxation::Exact, WallVelocity::Mirrored),
        (Relaxation::Exact, WallVelocity::Plain),
        (Relaxation::Paper, WallVelocity::Mirrored),
    ] {
        let (mut parameters, state) = boxed::<2>([20, 14], relaxation, wall_velocity);
        parameters.start = 100.0 * parameters.bodies.time_step;
        // A flat wall that turned would press the fluid together.
        parameters.bodies.parts[1].motion = Motion::Slides([-0.5, 0.0, 0.0]);
        let mut plain = initialised(parameters, &state);
        let first = after(&mut plain, 0).energies;
        let last = after(&mut plain, 400).energies;
        let work = -last.get("drive");
        assert!(work > 0.0 && last.get("heat") > 0.1 * work, "{last:?}");
        let error = (last.total() - first.total()) / work;
        assert!(
            error.abs() < 5e-3,
            "{error:e}, {relaxation:?}, {wall_velocity:?}"
        );
    }
}

#[test]
fn walls_at_rest_take_little_of_what_a_vortex_gives_to_the_fluid() {
    let (mut parameters, mut state) =
        stirred::<2>([22, 22], Relaxation::Exact, WallVelocity::Mirrored);
    for part in &mut parameters.bodies.parts {
        part.motion = Motion::Still;
    }
    let ways = ways(&state);
    for (v, way) in state.fluid_velocity.iter_mut().zip(&ways) {
        if *way == [0.0; 3] {
            v[0] += 0.5;
        }
    }
    let mut plain = initialised(parameters, &state);
    let first = after(&mut plain, 0).energies;
    let last = after(&mut plain, 300).energies;
    let (heat, drive) = (last.get("heat"), last.get("drive"));
    assert!(heat > 0.1 * first.get("kinetic"), "{last:?}");
    assert!(drive.abs() < 0.3 * heat, "heat {heat}, drive {drive}");
    let error = (last.total() - first.total()) / first.get("kinetic");
    assert!(error.abs() < 2e-3, "{error:e}");
}

#[test]
fn the_walls_of_a_linear_flow_continue_it() {
    // u = 0.3 y along x over a wall at rest below: what is below the surface moves the other way.
    let (mut parameters, mut state) =
        boxed::<2>([20, 14], Relaxation::Exact, WallVelocity::Mirrored);
    for part in &mut parameters.bodies.parts {
        part.motion = Motion::Still;
    }
    let surface = -4.0 * SPACING;
    let ways = ways(&state);
    for ((v, x), way) in state.fluid_velocity.iter_mut().zip(&state.fluid).zip(&ways) {
        if *way == [0.0; 3] {
            *v = [0.3 * (x[1] - surface), 0.0, 0.0];
        }
    }
    let mut plain = initialised(parameters, &state);
    let (model, system) = plain.parts();
    let speed = model.scale().speed_quantum();
    let mut seen = 0;
    for (x, v) in state.fluid.iter().zip(system.particles.velocity()) {
        // The first row, away from the sides.
        if (x[1] - (surface - 0.5 * SPACING)).abs() < 1e-9 && x[0].abs() < 3.0 * SPACING {
            let expected = 0.3 * -0.5 * SPACING;
            assert!((v[0].quanta() * speed - expected).abs() < 1e-9);
            assert!((v[1].quanta() * speed).abs() < 1e-9);
            seen += 1;
        }
    }
    assert!(seen > 3);
}

#[test]
fn a_wall_that_turns_keeps_its_shape_and_one_that_slides_its_place() {
    let (parameters, state) = boxed::<2>([20, 14], Relaxation::Exact, WallVelocity::Mirrored);
    let parts = parameters.bodies.parts.clone();
    let (dt, rate) = (parameters.bodies.time_step, 0.25);
    let mut plain = initialised(parameters, &state);
    after(&mut plain, 300);
    let (model, system) = plain.parts();
    let length = model.scale().length_quantum();
    let (sin, cos) = (rate * 300.0 * dt).sin_cos();
    let mut counts = [0; 2];
    for (id, x) in system.particles.id.iter().zip(system.particles.position()) {
        let home = state.fluid[*id as usize];
        let now = [x[0].quanta() * length, x[1].quanta() * length];
        let part = parts.iter().rev().find(|part| part.first <= *id).unwrap();
        let expected = match part.motion {
            Motion::Turns { centre, .. } => {
                counts[0] += 1;
                let y = [home[0] - centre[0], home[1] - centre[1]];
                [
                    centre[0] + cos * y[0] - sin * y[1],
                    centre[1] + sin * y[0] + cos * y[1],
                ]
            }
            _ if part.held => {
                counts[1] += 1;
                [home[0], home[1]]
            }
            _ => continue,
        };
        for (a, b) in now.iter().zip(expected) {
            assert!((a - b).abs() < 1e-8, "{now:?} is not {expected:?}");
        }
    }
    assert!(counts.iter().all(|n| *n > 10));
}

#[test]
fn in_space_the_determinant_of_the_distortion_stays_1() {
    let (parameters, state) = stirred::<3>([9, 9, 8], Relaxation::Exact, WallVelocity::Mirrored);
    let mut plain = initialised(parameters, &state);
    after(&mut plain, 40);
    let (_, system) = plain.parts();
    let unit = power_of_two(-48);
    let (mut moved, mut seen) = (0.0_f64, 0);
    for (place, held) in system.particles.words(HELD).iter().enumerate() {
        if held.whole_quanta() != 0 {
            continue;
        }
        let a: [f64; 9] =
            std::array::from_fn(|c| system.particles.word(DISTORTION, c, place) as f64 * unit);
        let determinant = a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6])
            + a[2] * (a[3] * a[7] - a[4] * a[6]);
        assert!((determinant - 1.0).abs() < 1e-12, "{determinant}");
        moved = moved.max((a[1] - a[3]).abs());
        seen += 1;
    }
    assert!(seen > 10 && moved > 1e-3, "it has turned: {moved:e}");
}

#[test]
fn walls_do_not_count_as_flow() {
    let (parameters, state) = boxed::<2>([20, 14], Relaxation::Exact, WallVelocity::Plain);
    let flowing = ways(&state).iter().filter(|way| **way == [0.0; 3]).count();
    let model = Relaxing::<Fixed, 2>::viscous(parameters).unwrap();
    assert_eq!(model.0.scheme().parameters().bodies.parts.len(), 4);
    let mut plain = Plain::new(model, &state);
    plain.initialise().unwrap();
    let seen = after(&mut plain, 0);
    // Walls pretend to move, the flow is at rest.
    assert_eq!(seen.energies.get("kinetic"), 0.0);
    assert_eq!(seen.momentum, [0.0; 3]);
    let counted: u32 = seen.histogram.counts.iter().sum();
    assert_eq!(counted as usize, flowing);
}
