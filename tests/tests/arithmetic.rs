//! The floating-point control: the same pair terms, without the return.

use loschmidt_core::integrator::INTEGRATORS;
use loschmidt_core::number::Quantity;
use loschmidt_core::schemes::wcsph::{CONSTANT, DensityCorrection, Wall};
use loschmidt_core::{Fixed, Float, Scale, Serial, Standard, Symplectic, System};
use loschmidt_tests::permitted;
use loschmidt_tests::small::{Recipe, Scheme, conservative, dam_2d, dam_3d, there_and_back, water};

/// Largest difference of positions, velocities and densities, in quanta.
fn difference<const D: usize>(a: &System<'_, Fixed, D>, b: &System<'_, Float, D>) -> f64 {
    let mut largest = 0.0f64;
    let (a, b) = (&a.particles, &b.particles);
    for i in 0..a.len() {
        for d in 0..D {
            largest = largest.max((a.position()[i][d].quanta() - b.position()[i][d]).abs());
            largest = largest.max((a.velocity()[i][d].quanta() - b.velocity()[i][d]).abs());
        }
        largest = largest.max((a.words(CONSTANT)[i].quanta() - b.words(CONSTANT)[i]).abs());
    }
    largest
}

/// One step from rest, from positions that both arithmetics hold exactly.
fn one_step<const D: usize>(recipe: &Recipe<D>, standard: bool) {
    fn run<M: Scheme<Fixed, D>, N: Scheme<Float, D>, const D: usize>(recipe: &Recipe<D>) {
        let mut fixed = recipe.build::<Fixed, M>();
        let mut float = recipe.build::<Float, N>();
        let still = fixed.digest();
        fixed.advance(1, &Serial).unwrap();
        float.advance(1, &Serial).unwrap();
        assert_ne!(fixed.digest(), still);
        let error = difference(&fixed.parts().1, &float.parts().1);
        assert!(error > 0.0 && error < permitted::ONE_STEP_QUANTA, "{error}");
    }
    if standard {
        run::<Standard<Fixed, D>, Standard<Float, D>, D>(recipe);
    } else {
        run::<Symplectic<Fixed, D>, Symplectic<Float, D>, D>(recipe);
    }
}

#[test]
fn one_step_from_rest_agrees_with_fixed_point_up_to_rounding() {
    for integrator in INTEGRATORS {
        for wall in [conservative(), Wall::Dummy] {
            // Without C_a there is a pressure from the start.
            let mut plane = dam_2d(wall, integrator);
            plane.parameters.density_correction = DensityCorrection::None;
            let mut space = dam_3d(wall, integrator);
            space.parameters.density_correction = DensityCorrection::None;
            for standard in [false, true] {
                one_step(&plane, standard);
                one_step(&space, standard);
            }
        }
    }
}

#[test]
fn a_float_state_counts_in_the_same_quanta() {
    let mut recipe = Recipe::empty(water::<2>());
    recipe.parameters.scale = Scale {
        length_exponent: 1,
        speed_exponent: -3,
        density_exponent: 2,
    };
    recipe.fluid.push(([0.75, -1.5], [0.25, 1.0]));
    let (mut fixed, mut float) = (
        recipe.build::<Fixed, Symplectic<Fixed, 2>>(),
        recipe.build::<Float, Symplectic<Float, 2>>(),
    );
    let error = difference(&fixed.parts().1, &float.parts().1);
    // The own term of the density is rounded in one and not in the other.
    assert!(error < 1.0);
    assert_eq!(
        float.parts().1.particles.position()[0],
        [0.75, -1.5].map(|x| x * 2f64.powi(45))
    );
    assert_eq!(
        float.parts().1.particles.velocity()[0],
        [0.25, 1.0].map(|x| x * 2f64.powi(43))
    );
}

#[test]
fn a_chaotic_run_does_not_return_in_floating_point() {
    for integrator in INTEGRATORS {
        for wall in [conservative(), Wall::Dummy] {
            let recipe = dam_2d(wall, integrator).stirred(3, 1.0);
            let [first, far, last] =
                there_and_back(&mut recipe.build::<Float, Symplectic<Float, 2>>(), 200);
            assert_ne!(first, far);
            assert_ne!(first, last);
            let [first, far, last] =
                there_and_back(&mut recipe.build::<Fixed, Symplectic<Fixed, 2>>(), 200);
            assert_ne!(first, far);
            assert_eq!(first, last);
        }
    }
}
