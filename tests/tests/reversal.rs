//! n steps, reversed, n steps, reversed: the first state, to the last bit.

use loschmidt_core::fields::{TimeParity, state_fields};
use loschmidt_core::integrator::{INTEGRATORS, Integrator};
use loschmidt_core::schemes::wcsph::{Central, DensityCorrection, Gravity, StateEquation, Wall};
use loschmidt_core::{
    Fixed, Model, Parameters, Reversibility, Scale, Serial, Standard, Symplectic,
};
use loschmidt_tests::small::{
    Recipe, SPACING, central, conservative, dam_2d, dam_3d, shuffle, there_and_back, water, words,
};
use proptest::prelude::*;

const STEPS: u64 = 60;

fn returns<const D: usize>(recipe: &Recipe<D>) {
    let mut system = recipe.symplectic();
    let first = words(&mut system);
    let [initial, far, last] = there_and_back(&mut system, STEPS);
    assert_eq!(initial, last);
    assert_ne!(initial, far);
    assert_eq!(first, words(&mut system));
}

/// A dam for every row, both walls and both state equations.
fn every_dam<const D: usize>(dam: impl Fn(Wall, &'static Integrator) -> Recipe<D>) {
    for integrator in INTEGRATORS {
        for wall in [conservative(), Wall::Dummy] {
            for state_equation in [StateEquation::Tait, StateEquation::Linear] {
                let mut recipe = dam(wall, integrator).stirred(3, 1.0);
                recipe.parameters.state_equation = state_equation;
                returns(&recipe);
            }
        }
    }
}

#[test]
fn a_dam_returns_with_every_row_wall_and_state_equation_in_the_plane() {
    every_dam(dam_2d);
}

#[test]
fn a_dam_returns_with_every_row_wall_and_state_equation_in_space() {
    every_dam(dam_3d);
}

#[test]
fn a_drop_returns_in_the_field_of_a_fixed_mass() {
    for integrator in INTEGRATORS {
        let plane = Parameters {
            gravity: central(),
            integrator,
            ..water::<2>()
        };
        returns(&Recipe::block(plane, [5, 5]).stirred(1, 2.0));
        let space = Parameters {
            gravity: central(),
            integrator,
            ..water::<3>()
        };
        returns(&Recipe::block(space, [3, 3, 3]).stirred(1, 2.0));
    }
}

#[test]
fn a_long_run_returns() {
    let mut system = dam_2d(Wall::Dummy, INTEGRATORS[0]).symplectic();
    let [initial, far, last] = there_and_back(&mut system, 3000);
    assert_eq!(initial, last);
    assert_ne!(initial, far);
}

#[test]
fn particles_that_meet_on_one_point_return() {
    // Head on, along one axis, at equal speed: after a whole number of steps they coincide.
    let parameters = Parameters {
        time_step: 1.0 / 256.0,
        sound_speed: 1.0,
        ..water::<2>()
    };
    let mut recipe = Recipe::empty(parameters);
    recipe.fluid.push(([0.0, 0.0], [4.0, 0.0]));
    recipe.fluid.push(([1.0, 0.0], [-4.0, 0.0]));
    returns(&recipe);
    // And from the start.
    let mut recipe = Recipe::block(parameters, [3, 3]).stirred(7, 1.0);
    recipe.fluid[1].0 = recipe.fluid[0].0;
    recipe.fluid[2].0 = recipe.fluid[0].0;
    returns(&recipe);
}

#[test]
fn a_particle_pushed_in_the_middle_of_a_run_is_felt_from_the_first_kick() {
    for wall in [conservative(), Wall::Dummy] {
        let mut system = dam_2d(wall, INTEGRATORS[0]).symplectic();
        system.advance(5, &Serial).unwrap();
        system.push_fluid([0.3, 0.3], [0.0; 2]).unwrap();
        system.push_wall([0.35, 0.9]).unwrap();
        let (model, mut parts) = system.parts();
        model.place_walls(&mut parts, &Serial).unwrap();
        let [initial, far, last] = there_and_back(&mut system, 20);
        assert_eq!(initial, last);
        assert_ne!(initial, far);
    }
}

#[test]
fn every_state_on_the_way_back_is_a_state_of_the_way_out() {
    for integrator in INTEGRATORS {
        let mut system = dam_2d(conservative(), integrator).symplectic();
        let mut out = Vec::new();
        for _ in 0..40 {
            out.push(words(&mut system));
            system.advance(1, &Serial).unwrap();
        }
        system.reverse();
        while let Some(there) = out.pop() {
            system.advance(1, &Serial).unwrap();
            system.reverse();
            assert_eq!(words(&mut system), there);
            system.reverse();
        }
    }
}

#[test]
fn the_order_of_storage_changes_no_bit_of_a_run() {
    for wall in [conservative(), Wall::Dummy] {
        let mut straight = dam_2d(wall, INTEGRATORS[0]).symplectic();
        let mut shuffled = dam_2d(wall, INTEGRATORS[0]).place::<Fixed, Symplectic<Fixed, 2>>();
        shuffle(&mut shuffled.parts().1, 5);
        shuffled.initialise(&Serial).unwrap();
        for round in 0..5 {
            straight.advance(10, &Serial).unwrap();
            shuffled.advance(10, &Serial).unwrap();
            assert_eq!(words(&mut straight), words(&mut shuffled));
            shuffle(&mut shuffled.parts().1, round);
        }
    }
}

#[test]
fn the_grid_changes_no_bit_of_a_run() {
    let run = |extent, max_buckets| {
        let mut recipe = dam_3d(Wall::Dummy, INTEGRATORS[0]);
        recipe.parameters.extent = extent;
        recipe.parameters.max_buckets = max_buckets;
        let mut system = recipe.symplectic();
        system.advance(20, &Serial).unwrap();
        words(&mut system)
    };
    let first = run([2.0; 3], 1024);
    for (extent, max_buckets) in [([0.0; 3], 1), ([9.0, 0.1, 0.5], 64), ([1.0; 3], 300)] {
        assert_eq!(first, run(extent, max_buckets));
    }
}

#[test]
fn reversing_twice_is_the_identity_and_once_follows_the_parity_of_the_fields() {
    let mut system = dam_3d(Wall::Dummy, INTEGRATORS[0])
        .stirred(2, 1.0)
        .symplectic();
    system.advance(3, &Serial).unwrap();
    let before = words(&mut system);
    let (_, parts) = system.parts();
    let side = parts.particles.side();
    let fields = state_fields(parts.particles.fields(), side);
    system.reverse();
    for ((id, after), (same, before)) in words(&mut system).iter().zip(&before) {
        assert_eq!(id, same);
        let mut word = 0;
        for (_, field) in fields.clone() {
            for _ in 0..field.words(side, 3) {
                let expected = match field.parity {
                    TimeParity::Even => before[word],
                    TimeParity::Odd => -before[word],
                };
                assert_eq!(after[word], expected, "{}", field.name);
                word += 1;
            }
        }
        assert_eq!(word, after.len());
    }
    system.reverse();
    assert_eq!(words(&mut system), before);
}

#[test]
fn reversibility_is_part_of_the_type() {
    use loschmidt_core::Float;
    let of = <Symplectic<Fixed, 2> as Model<Fixed, 2>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::BitExact);
    let of = <Symplectic<Float, 3> as Model<Float, 3>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::UpToRounding);
    let of = <Standard<Fixed, 2> as Model<Fixed, 2>>::REVERSIBILITY;
    assert_eq!(of, Reversibility::Irreversible);
}

fn parameters<const D: usize>() -> impl Strategy<Value = Parameters<D>> {
    let wall = prop_oneof![Just(Wall::None), Just(Wall::Dummy), Just(conservative())];
    let equation = prop_oneof![Just(StateEquation::Tait), Just(StateEquation::Linear)];
    let correction = prop_oneof![
        Just(DensityCorrection::Constant),
        Just(DensityCorrection::None)
    ];
    let mass = prop::option::of((
        prop::array::uniform::<_, D>(-1.0..1.0f64),
        0.0..5.0f64,
        0.1..0.3f64,
    ));
    let exponents = prop::array::uniform3(-3..6i32);
    (
        (wall, equation, correction, 0..3usize),
        (
            prop::array::uniform::<_, D>(-10.0..10.0f64),
            mass,
            exponents,
        ),
        (1.2..3.5f64, 0.01..0.2f64, 5.0..50.0f64),
    )
        .prop_map(
            |((wall, state_equation, density_correction, row), (uniform, mass, e), (h, cfl, c))| {
                let support_radius = h * SPACING;
                Parameters {
                    support_radius,
                    time_step: cfl * support_radius / c,
                    sound_speed: c,
                    state_equation,
                    density_correction,
                    gravity: Gravity {
                        uniform,
                        central: mass.map(|(centre, strength, softening)| Central {
                            centre,
                            strength,
                            softening,
                        }),
                    },
                    wall,
                    integrator: INTEGRATORS[row],
                    scale: Scale {
                        length_exponent: e[0],
                        speed_exponent: e[1],
                        density_exponent: 3 + e[2],
                    },
                    ..water()
                }
            },
        )
}

/// Particles thrown at random; some on one point.
fn recipe<const D: usize>() -> impl Strategy<Value = Recipe<D>> {
    let vector = |size: f64| prop::array::uniform::<_, D>(-size..size);
    (
        parameters::<D>(),
        prop::collection::vec((vector(0.5), vector(3.0)), 1..24),
        prop::collection::vec(vector(0.7), 0..24),
        any::<bool>(),
    )
        .prop_map(|(parameters, mut fluid, walls, coincide)| {
            if coincide {
                let first = fluid[0].0;
                fluid.last_mut().unwrap().0 = first;
            }
            Recipe {
                parameters,
                fluid,
                walls,
            }
        })
}

/// Returns exactly, or leaves the range with a typed fault on the way out; never on the way back.
fn check<const D: usize>(recipe: &Recipe<D>, steps: u64) -> Result<bool, TestCaseError> {
    let mut system = recipe.symplectic();
    let first = words(&mut system);
    let digest = system.digest();
    if system.advance(steps, &Serial).is_err() {
        return Ok(false);
    }
    system.reverse();
    prop_assert_eq!(system.advance(steps, &Serial), Ok(()));
    system.reverse();
    prop_assert_eq!(words(&mut system), first);
    prop_assert_eq!(system.digest(), digest);
    Ok(true)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_small_system_returns_in_the_plane(recipe in recipe::<2>(), steps in 1..30u64) {
        let inside = check(&recipe, steps)?;
        prop_assume!(inside);
    }

    #[test]
    fn any_small_system_returns_in_space(recipe in recipe::<3>(), steps in 1..30u64) {
        let inside = check(&recipe, steps)?;
        prop_assume!(inside);
    }
}
