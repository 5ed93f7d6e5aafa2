//! Every force is minus the gradient of its energy.

use loschmidt_core::integrator::{Integrator, Stage};
use loschmidt_core::number::power_of_two;
use loschmidt_core::schemes::wcsph::{AntiClump, DensityCorrection, StateEquation, Wall};
use loschmidt_core::{Energies, Parameters, Serial};
use loschmidt_tests::permitted;
use loschmidt_tests::small::{
    Recipe, SPACING, central, conservative, displace, downwards, measure, velocity, water,
};

/// One whole kick and nothing else: what it adds to a resting particle is dt times its
/// acceleration.
static KICK: Integrator = Integrator {
    name: "kick",
    order: 1,
    evaluations: 1,
    stages: &[Stage::Kick(1.0)],
};

const SEEDS: u64 = 6;

/// Compares the accelerations with the gradient of `part`, of a recipe whose particles are moved
/// about at random once their C_a is fixed.
fn check<const D: usize>(recipe: &Recipe<D>, seed: u64, part: impl Fn(Energies) -> f64) -> f64 {
    let mut recipe = recipe.clone();
    recipe.parameters.integrator = &KICK;
    let parameters = recipe.parameters;
    let mut system = recipe.symplectic();
    // Up to 0.3 spacings along each axis.
    let mut generator = loschmidt_tests::generator::Generator::new(seed);
    let quantum = parameters.scale.length_quantum();
    for i in 0..recipe.fluid.len() {
        for d in 0..D {
            let shift = 0.3 * SPACING * generator.signed() / quantum;
            displace(&mut system, i, d, shift as i64);
        }
    }

    let step = (power_of_two(-20) / quantum) as i64;
    let mut gradient = Vec::new();
    for i in 0..recipe.fluid.len() {
        for d in 0..D {
            displace(&mut system, i, d, step);
            let above = part(measure(&mut system).energies);
            displace(&mut system, i, d, -2 * step);
            let below = part(measure(&mut system).energies);
            displace(&mut system, i, d, step);
            gradient.push((above - below) / (2.0 * step as f64 * quantum));
        }
    }

    system.advance(1, &Serial).unwrap();
    let mut force = Vec::new();
    for i in 0..recipe.fluid.len() {
        for v in velocity(&mut system, i) {
            force.push(parameters.mass * v / parameters.time_step);
        }
    }

    let largest = force.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    assert!(largest > 0.0, "no force at all");
    let error = force
        .iter()
        .zip(&gradient)
        .fold(0.0f64, |m, (f, g)| m.max((f + g).abs()));
    assert!(
        error / largest < permitted::FORCE,
        "seed {seed}: {:e} of {largest:e}",
        error / largest
    );
    error / largest
}

fn check_all<const D: usize>(recipe: &Recipe<D>, part: impl Fn(Energies) -> f64) {
    let mut worst = 0.0f64;
    for seed in 0..SEEDS {
        worst = worst.max(check(recipe, seed, &part));
    }
    println!("worst relative error {worst:e}");
}

/// Particles too far apart to know of each other.
fn sparse<const D: usize>(parameters: Parameters<D>) -> Recipe<D> {
    let mut recipe = Recipe::block(parameters, [2; D]);
    for (x, _) in &mut recipe.fluid {
        *x = x.map(|x| 6.0 * x);
    }
    recipe
}

const EQUATIONS: [StateEquation; 2] = [StateEquation::Tait, StateEquation::Linear];

#[test]
fn pressure_is_minus_the_gradient_of_internal_energy() {
    for state_equation in EQUATIONS {
        for density_correction in [DensityCorrection::Constant, DensityCorrection::None] {
            let plane = Parameters {
                state_equation,
                density_correction,
                ..water::<2>()
            };
            check_all(&Recipe::block(plane, [4, 3]), |e| e.get("internal"));
            let space = Parameters {
                state_equation,
                density_correction,
                ..water::<3>()
            };
            check_all(&Recipe::block(space, [2, 3, 2]), |e| e.get("internal"));
        }
    }
}

#[test]
fn weight_is_minus_the_gradient_of_gravitational_energy() {
    let plane = Parameters {
        gravity: downwards(),
        ..water::<2>()
    };
    check_all(&sparse(plane), |e| e.get("gravitational"));
    let space = Parameters {
        gravity: downwards(),
        ..water::<3>()
    };
    check_all(&sparse(space), |e| e.get("gravitational"));
}

#[test]
fn central_attraction_is_minus_the_gradient_of_its_energy() {
    let plane = Parameters {
        gravity: central(),
        ..water::<2>()
    };
    check_all(&sparse(plane), |e| e.get("gravitational"));
    let space = Parameters {
        gravity: central(),
        ..water::<3>()
    };
    check_all(&sparse(space), |e| e.get("gravitational"));
}

#[test]
fn the_repulsion_of_near_particles_is_minus_the_gradient_of_its_energy() {
    // As far as 1.2 spacings, so that some are near enough in every disorder.
    let clump = Some(AntiClump {
        pressure: 1e5,
        support_radius: 1.2 * SPACING,
    });
    for wall in [Wall::None, Wall::Dummy] {
        let plane = Parameters {
            anti_clump: clump,
            wall,
            ..water::<2>()
        };
        let all = |e: Energies| e.get("internal") + e.get("wall");
        check_all(&Recipe::boxed(plane, [3, 3], [4, 4], 1), all);
        let space = Parameters {
            anti_clump: clump,
            wall,
            ..water::<3>()
        };
        check_all(&Recipe::boxed(space, [2, 2, 2], [3, 2, 2], 1), all);
    }
}

/// Walls half a spacing beside each particle.
fn beside_walls<const D: usize>(wall: Wall) -> Recipe<D> {
    let mut recipe = sparse(Parameters {
        wall,
        ..water::<D>()
    });
    for (x, _) in &recipe.fluid {
        for d in 0..D {
            let mut x = *x;
            x[d] += SPACING;
            recipe.walls.push(x);
        }
    }
    recipe
}

#[test]
fn the_conservative_wall_is_minus_the_gradient_of_its_energy() {
    check_all(&beside_walls::<2>(conservative()), |e| e.get("wall"));
    check_all(&beside_walls::<3>(conservative()), |e| e.get("wall"));
}

#[test]
fn dummies_push_by_the_gradient_of_all_internal_energy_with_their_own() {
    for state_equation in EQUATIONS {
        for density_correction in [DensityCorrection::Constant, DensityCorrection::None] {
            let plane = Parameters {
                state_equation,
                density_correction,
                wall: Wall::Dummy,
                ..water::<2>()
            };
            check_all(&Recipe::boxed(plane, [3, 3], [4, 4], 2), |e| {
                e.get("internal") + e.get("wall")
            });
            let space = Parameters {
                state_equation,
                density_correction,
                wall: Wall::Dummy,
                ..water::<3>()
            };
            check_all(&Recipe::boxed(space, [2, 2, 2], [3, 2, 2], 1), |e| {
                e.get("internal") + e.get("wall")
            });
        }
    }
}

#[test]
#[should_panic(expected = "seed 0")]
fn without_the_dummies_own_energy_the_gradient_is_another() {
    let plane = Parameters {
        wall: Wall::Dummy,
        ..water::<2>()
    };
    check_all(&Recipe::boxed(plane, [3, 3], [4, 4], 2), |e| {
        e.get("internal")
    });
}

#[test]
fn all_forces_together_are_minus_the_gradient_of_the_potential_energy() {
    for wall in [conservative(), Wall::Dummy] {
        let mut gravity = downwards();
        gravity.central = central::<2>().central;
        let parameters = Parameters {
            wall,
            gravity,
            ..water::<2>()
        };
        let recipe = Recipe::boxed(parameters, [3, 3], [4, 4], 2);
        check_all(&recipe, |e| e.total() - e.get("kinetic"));
    }
}

#[test]
fn internal_energy_has_its_zero_at_the_initial_state() {
    for wall in [Wall::None, Wall::Dummy] {
        let parameters = Parameters {
            wall,
            ..water::<2>()
        };
        let mut system = Recipe::boxed(parameters, [3, 4], [5, 5], 2).symplectic();
        let energies = measure(&mut system).energies;
        // ρ = ρ0 to the last bit, and ρ/ρ0 within one ulp of one: (x - 1)² is below 2^-100.
        assert_eq!(
            ["internal", "wall", "kinetic"].map(|kind| energies.get(kind)),
            [0.0; 3]
        );
    }
}

#[test]
fn the_derivative_of_internal_energy_is_pressure_over_density_squared() {
    for equation in EQUATIONS {
        for k in 60..=140 {
            let x = f64::from(k) * 0.01;
            let d = 1e-5;
            let numerical =
                (equation.internal_energy(x + d) - equation.internal_energy(x - d)) / (2.0 * d);
            let error = numerical - equation.pressure_over_density_squared(x);
            assert!(
                error.abs() < permitted::STATE_EQUATION,
                "{equation:?} {x} {error:e}"
            );
        }
    }
}

#[test]
fn pressure_and_internal_energy_vanish_at_the_reference_density() {
    for equation in EQUATIONS {
        assert_eq!(equation.pressure(1.0), 0.0);
        assert_eq!(equation.pressure_over_density_squared(1.0), 0.0);
        assert_eq!(equation.internal_energy(1.0), 0.0);
        for x in [0.5, 0.9, 1.1, 1.5] {
            assert!(equation.internal_energy(x) > 0.0);
            assert_eq!(equation.pressure(x) > 0.0, x > 1.0);
        }
    }
}

#[test]
fn state_equations_are_those_of_the_paper_and_share_the_sound_speed() {
    for k in 60..=140 {
        let x: f64 = f64::from(k) * 0.01;
        let tait = (x.powi(7) - 1.0) / 7.0;
        assert!((StateEquation::Tait.pressure(x) - tait).abs() < permitted::STATE_EQUATION);
        let energy = (x.powi(6) + 6.0 / x - 7.0) / 42.0;
        assert!(
            (StateEquation::Tait.internal_energy(x) - energy).abs() < permitted::STATE_EQUATION
        );
        assert!((StateEquation::Linear.pressure(x) - (x - 1.0)).abs() < permitted::STATE_EQUATION);
    }
    for equation in EQUATIONS {
        let d = 1e-5;
        let slope = (equation.pressure(1.0 + d) - equation.pressure(1.0 - d)) / (2.0 * d);
        assert!((slope - 1.0).abs() < permitted::STATE_EQUATION);
    }
}

#[test]
fn energies_do_not_depend_on_the_order_of_storage() {
    let mut gravity = downwards();
    gravity.central = central::<2>().central;
    for wall in [conservative(), Wall::Dummy] {
        let parameters = Parameters {
            wall,
            gravity,
            ..water::<2>()
        };
        let mut system = Recipe::boxed(parameters, [4, 4], [6, 6], 2)
            .stirred(1, 2.0)
            .symplectic();
        system.advance(5, &Serial).unwrap();
        let first = measure(&mut system);
        for seed in 0..5 {
            loschmidt_tests::small::shuffle(&mut system.parts().1, seed);
            assert_eq!(measure(&mut system), first);
        }
    }
}
