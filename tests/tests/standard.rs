//! The standard scheme: what the reversible one is compared with.

use loschmidt_core::fields::{Role, TimeParity};
use loschmidt_core::integrator::STORMER_VERLET;
use loschmidt_core::number::{Quantity, Whole};
use loschmidt_core::schemes::wcsph::{CONSTANT, DENSITY, StateEquation, Wall};
use loschmidt_core::{Fixed, Model, Serial, Standard, Symplectic};
use loschmidt_tests::permitted;
use loschmidt_tests::small::{
    Recipe, Small, conservative, dam_2d, dam_3d, measure, position, there_and_back,
};

fn every_dam(check: impl Fn(&Recipe<2>), check_3d: impl Fn(&Recipe<3>)) {
    for wall in [conservative(), Wall::Dummy] {
        for state_equation in [StateEquation::Tait, StateEquation::Linear] {
            let mut plane = dam_2d(wall, &STORMER_VERLET).stirred(2, 1.0);
            plane.parameters.state_equation = state_equation;
            check(&plane);
            let mut space = dam_3d(wall, &STORMER_VERLET).stirred(2, 1.0);
            space.parameters.state_equation = state_equation;
            check_3d(&space);
        }
    }
}

fn does_not_return<const D: usize>(recipe: &Recipe<D>) {
    let mut system = recipe.build::<Fixed, Standard<Fixed, D>>();
    let [initial, far, last] = there_and_back(&mut system, 10);
    assert_ne!(initial, far);
    assert_ne!(initial, last);
}

#[test]
fn it_runs_and_does_not_return() {
    every_dam(does_not_return, does_not_return);
}

#[test]
fn one_step_is_enough_not_to_return() {
    let recipe = dam_2d(conservative(), &STORMER_VERLET).stirred(2, 1.0);
    let [initial, _, last] = there_and_back(&mut recipe.build::<Fixed, Standard<Fixed, 2>>(), 1);
    assert_ne!(initial, last);
}

fn starts_at_rho_0<const D: usize>(recipe: &Recipe<D>) {
    let mut system = recipe.build::<Fixed, Standard<Fixed, D>>();
    let quantum = recipe.parameters.scale.density_quantum();
    let rho0 = (recipe.parameters.reference_density / quantum) as i64;
    assert_eq!(measure(&mut system).energies.get("internal"), 0.0);
    let (_, parts) = system.parts();
    for field in [CONSTANT, DENSITY] {
        let mut densities = parts.particles.words(field).iter();
        assert!(densities.all(|rho| rho.to_word() == rho0));
    }
    let dummies = recipe.parameters.wall == Wall::Dummy;
    let of_walls = if dummies { rho0 } else { 0 };
    let mut densities = parts.walls.words(CONSTANT).iter();
    assert!(densities.all(|rho| rho.to_word() == of_walls));
}

#[test]
fn density_starts_at_the_reference_density_of_fluid_and_dummies() {
    every_dam(starts_at_rho_0, starts_at_rho_0);
}

/// The densities of the state.
fn densities<const D: usize>(system: &mut Small<Standard<Fixed, D>, D>) -> Vec<Whole> {
    system.parts().1.particles.words(CONSTANT).to_vec()
}

#[test]
fn its_density_is_a_field_that_evolves() {
    let mut system = dam_2d(Wall::Dummy, &STORMER_VERLET).build::<Fixed, Standard<Fixed, 2>>();
    let field = <Standard<Fixed, 2> as Model<Fixed, 2>>::FIELDS[CONSTANT];
    assert_eq!((field.name, field.parity), ("density", TimeParity::Even));
    assert_eq!([field.particles, field.walls], [Role::State; 2]);
    let before = densities(&mut system);
    let walls = system.parts().1.walls.words(CONSTANT).to_vec();
    system.advance(10, &Serial).unwrap();
    assert_ne!(densities(&mut system), before);
    assert_ne!(system.parts().1.walls.words(CONSTANT), walls);
}

#[test]
fn in_rigid_translation_no_density_changes() {
    let mut recipe = Recipe::block(loschmidt_tests::small::water::<3>(), [3, 3, 3]);
    for (_, v) in &mut recipe.fluid {
        *v = [1.0, -2.0, 0.5];
    }
    let mut system = recipe.build::<Fixed, Standard<Fixed, 3>>();
    let before = densities(&mut system);
    system.advance(10, &Serial).unwrap();
    assert_eq!(densities(&mut system), before);
}

/// Under a uniform compression at rate k, dρ/dt = Σ m (W'/r) u·x with u = -k x: positive, the same
/// for the whole block's symmetric partners, and the kernel sum's own derivative.
#[test]
fn compression_raises_the_density() {
    let mut recipe = Recipe::block(loschmidt_tests::small::water::<2>(), [5, 5]);
    let middle = 2.5 * loschmidt_tests::small::SPACING;
    for (x, v) in &mut recipe.fluid {
        *v = x.map(|x| -0.5 * (x - middle));
    }
    let mut system = recipe.build::<Fixed, Standard<Fixed, 2>>();
    let before = densities(&mut system);
    system.advance(1, &Serial).unwrap();
    let after = densities(&mut system);
    assert!(before.iter().zip(&after).all(|(b, a)| a > b));
}

/// Largest distance between the same particles of two runs, m.
fn distance<const D: usize>(
    a: &mut Small<Symplectic<Fixed, D>, D>,
    b: &mut Small<Standard<Fixed, D>, D>,
) -> f64 {
    let n = a.parts().1.particles.len();
    (0..n).fold(0.0, |largest: f64, i| {
        let (x, y) = (position(a, i), position(b, i));
        (0..D).fold(largest, |largest, d| largest.max((x[d] - y[d]).abs()))
    })
}

fn approaches_the_reversible_scheme<const D: usize>(recipe: &Recipe<D>) {
    let after = |halvings: i32| {
        let mut recipe = recipe.clone();
        recipe.parameters.time_step /= 8.0 * 2f64.powi(halvings);
        let steps = 80 << halvings;
        let mut symplectic = recipe.symplectic();
        let mut standard = recipe.build::<Fixed, Standard<Fixed, D>>();
        symplectic.advance(steps, &Serial).unwrap();
        standard.advance(steps, &Serial).unwrap();
        distance(&mut symplectic, &mut standard)
    };
    let ratio = after(1) / after(2);
    assert!(
        (ratio - 2.0).abs() < permitted::FIRST_ORDER_RATIO,
        "{ratio}"
    );
}

/// ρ0 + ∫ (1a) dt is the sum (5) with its C_a: with dt → 0 the schemes are the same.
#[test]
fn both_schemes_are_the_same_as_the_time_step_goes_to_zero() {
    every_dam(
        approaches_the_reversible_scheme,
        approaches_the_reversible_scheme,
    );
}
