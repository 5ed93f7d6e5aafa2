//! What pairs exchange, neither of them loses.

use loschmidt_core::integrator::INTEGRATORS;
use loschmidt_core::number::Quantity;
use loschmidt_core::schemes::wcsph::StateEquation;
use loschmidt_core::{Fixed, Parameters, Serial, Standard, Symplectic};
use loschmidt_tests::permitted;
use loschmidt_tests::small::{Recipe, measure, water};

const STEPS: u64 = 100;

/// Two blocks that fly at each other, stirred.
fn collision<const D: usize>(parameters: Parameters<D>, size: [i64; D]) -> Recipe<D> {
    let mut left = Recipe::block(parameters, size);
    let mut right = left.clone();
    let gap = (size[0] as f64 + 1.5) * loschmidt_tests::small::SPACING;
    for (x, v) in &mut right.fluid {
        x[0] += gap;
        v[0] = -3.0;
    }
    left.fluid.append(&mut right.fluid);
    let velocities = left.clone().stirred(11, 1.0);
    for ((_, v), (_, u)) in left.fluid.iter_mut().zip(&velocities.fluid) {
        for (v, u) in v.iter_mut().zip(u) {
            *v += u;
        }
    }
    left
}

fn momentum_is_constant<const D: usize>(size: [i64; D]) {
    for integrator in INTEGRATORS {
        for state_equation in [StateEquation::Tait, StateEquation::Linear] {
            let parameters = Parameters {
                integrator,
                state_equation,
                ..water::<D>()
            };
            let mut system = collision(parameters, size).symplectic();
            let first = measure(&mut system);
            assert!(first.momentum_quanta[..D].iter().all(|&p| p != 0));
            assert!(first.momentum_quanta[D..].iter().all(|&p| p == 0));
            for _ in 0..STEPS {
                system.advance(1, &Serial).unwrap();
                assert_eq!(measure(&mut system).momentum_quanta, first.momentum_quanta);
            }
            system.reverse();
            let negative = first.momentum_quanta.map(|p| -p);
            for _ in 0..STEPS {
                assert_eq!(measure(&mut system).momentum_quanta, negative);
                system.advance(1, &Serial).unwrap();
            }
            assert_eq!(measure(&mut system).momentum_quanta, negative);
            let si = measure(&mut system).momentum;
            assert_eq!(si, first.momentum.map(|p| -p));
        }
    }
}

#[test]
fn without_walls_and_gravity_momentum_is_constant_to_the_last_bit_in_the_plane() {
    momentum_is_constant([4, 3]);
}

#[test]
fn without_walls_and_gravity_momentum_is_constant_to_the_last_bit_in_space() {
    momentum_is_constant([2, 3, 2]);
}

#[test]
fn the_standard_scheme_keeps_momentum_too() {
    let mut system = collision(water::<2>(), [4, 3]).build::<Fixed, Standard<Fixed, 2>>();
    let first = measure(&mut system).momentum_quanta;
    system.advance(STEPS, &Serial).unwrap();
    assert_eq!(measure(&mut system).momentum_quanta, first);
}

/// Σ |x||v| in quanta: what the angular momentum is compared with.
fn lever<const D: usize>(
    system: &mut loschmidt_tests::small::Small<Symplectic<Fixed, D>, D>,
) -> f64 {
    let (_, system) = system.parts();
    let norm = |v: [f64; D]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
    let position = system.particles.position().iter();
    position
        .zip(system.particles.velocity())
        .map(|(x, v)| norm(x.map(|x| x.quanta())) * norm(v.map(|v| v.quanta())))
        .sum()
}

fn angular_momentum_is_kept<const D: usize>(size: [i64; D]) {
    for integrator in INTEGRATORS {
        let parameters = Parameters {
            integrator,
            ..water::<D>()
        };
        let mut system = collision(parameters, size).symplectic();
        let unit = lever(&mut system);
        let first = measure(&mut system).angular_momentum_quanta;
        system.advance(STEPS, &Serial).unwrap();
        let last = measure(&mut system).angular_momentum_quanta;
        for (a, b) in first.iter().zip(last) {
            let error = (b - a) as f64 / unit;
            assert!(error.abs() < permitted::ANGULAR_MOMENTUM, "{error:e}");
        }
        if D == 2 {
            assert_eq!(first[..2], [0, 0]);
        }
    }
}

#[test]
fn angular_momentum_is_kept_up_to_rounding_in_the_plane() {
    angular_momentum_is_kept([4, 3]);
}

#[test]
fn angular_momentum_is_kept_up_to_rounding_in_space() {
    angular_momentum_is_kept([2, 3, 2]);
}

#[test]
fn reversal_negates_angular_momentum_and_keeps_every_energy() {
    let mut system = collision(water::<3>(), [2, 3, 2]).symplectic();
    system.advance(7, &Serial).unwrap();
    let there = measure(&mut system);
    system.reverse();
    let back = measure(&mut system);
    assert_eq!(
        back.angular_momentum_quanta,
        there.angular_momentum_quanta.map(|l| -l)
    );
    assert_eq!(back.energies, there.energies);
    assert_eq!(back.histogram, there.histogram);
    assert_eq!(back.front, there.front);
}

#[test]
fn momenta_are_the_sums_they_are_called() {
    let mut recipe = Recipe::empty(water::<3>());
    recipe.fluid.push(([1.0, 2.0, 3.0], [0.5, -1.0, 0.25]));
    recipe.fluid.push(([-2.0, 0.5, 1.5], [-3.0, 2.0, 1.0]));
    let mut system = recipe.symplectic();
    let d = measure(&mut system);
    let m = recipe.parameters.mass;
    // Dyadic numbers and a dyadic mass times 1000: exact in doubles.
    assert_eq!(d.momentum, [-2.5 * m, 1.0 * m, 1.25 * m]);
    // x × v of each: (3.5, 1.25, -2) and (-2.5, -2.5, -2.5).
    assert_eq!(d.angular_momentum, [1.0 * m, -1.25 * m, -4.5 * m]);
    assert_eq!(d.front, 1.0);
    assert_eq!(d.energies.get("kinetic"), 0.5 * m * (1.3125 + 14.0));
}
