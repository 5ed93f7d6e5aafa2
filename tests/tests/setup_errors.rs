//! What a system refuses to be set up with is typed, and gives back what it was handed.

use crate::faults::units;
use loschmidt_core::integrator::{INTEGRATORS, PEFRL};
use loschmidt_core::model::{Central, SetupError, Wall};
use loschmidt_core::owned::{Owned, PushError};
use loschmidt_core::{CapacityError, Fixed, Forces, Model, Parameters, Symplectic};
use loschmidt_tests::small::{BUCKETS, FLUID, Recipe, Small, dam_3d, downwards, water};

#[test]
fn a_full_system_gives_the_particle_back() {
    let mut system = Recipe::empty(water::<2>()).place::<Fixed, Symplectic<Fixed, 2>>();
    for _ in 0..FLUID {
        system.push_fluid([0.5; 2], [0.0; 2]).unwrap();
    }
    let before = system.digest();
    let position = [0.25, 0.75];
    assert_eq!(
        system.push_fluid(position, [0.0; 2]),
        Err(PushError::Full { position })
    );
    for _ in 0..loschmidt_tests::small::WALLS {
        system.push_wall([0.5; 2]).unwrap();
    }
    assert_eq!(
        system.push_wall(position),
        Err(PushError::Full { position })
    );
    let (_, parts) = system.parts();
    assert_eq!(
        (parts.state.len(), parts.walls.position.len()),
        (FLUID, 512)
    );
    assert_ne!(system.digest(), before);
}

#[test]
fn a_particle_outside_the_range_is_given_back() {
    let mut system = Recipe::empty(units()).place::<Fixed, Symplectic<Fixed, 2>>();
    for position in [
        [32.0, 0.0],
        [0.0, -32.0],
        [f64::NAN, 0.0],
        [0.0, f64::INFINITY],
    ] {
        let fluid = system.push_fluid(position, [0.0; 2]).unwrap_err();
        assert!(matches!(fluid, PushError::Range { .. }));
        assert!(matches!(
            system.push_wall(position),
            Err(PushError::Range { .. })
        ));
    }
    let position = [1.0, 2.0];
    for velocity in [[2048.0, 0.0], [0.0, f64::NAN]] {
        assert_eq!(
            system.push_fluid(position, velocity),
            Err(PushError::Range { position })
        );
    }
    assert!(system.parts().1.state.is_empty());
}

#[test]
fn too_small_a_grid_is_a_capacity_error() {
    type Tiny<const B: usize> = Owned<Fixed, Symplectic<Fixed, 2>, 2, 4, 4, B>;
    let forces = || {
        Forces::<Fixed, 2>::new(Parameters {
            max_buckets: 9,
            ..water()
        })
        .unwrap()
    };
    assert_eq!(forces().grid().buckets(), 9);
    assert!(Tiny::<10>::new(Symplectic::new(forces())).is_ok());
    let error = Tiny::<9>::new(Symplectic::new(forces())).err();
    assert_eq!(
        error,
        Some(CapacityError {
            what: "cell start",
            needed: 10,
            given: 9
        })
    );
}

#[test]
fn slices_of_unequal_length_are_named() {
    let mut system: Box<Small<Symplectic<Fixed, 3>, 3>> =
        dam_3d(Wall::Dummy, INTEGRATORS[0]).symplectic();
    let (model, parts) = system.parts();
    let (buckets, wall_buckets) = {
        let forces = model.forces();
        (forces.grid().buckets(), forces.wall_grid().buckets())
    };
    assert!(buckets < BUCKETS);
    assert_eq!(parts.check_capacity(buckets, wall_buckets), Ok(()));
    let error = parts.check_capacity(buckets + 1, wall_buckets).unwrap_err();
    assert_eq!(
        (error.what, error.needed, error.given),
        ("cell start", buckets + 2, buckets + 1)
    );
    let error = parts.check_capacity(buckets, wall_buckets - 1).unwrap_err();
    assert_eq!(error.what, "wall cell start");

    macro_rules! short {
        ($($field:ident).+, $what:literal) => {{
            let (_, mut parts) = system.parts();
            let slice = std::mem::take(&mut parts.$($field).+);
            let n = slice.len();
            parts.$($field).+ = &mut slice[1..];
            let error = parts.check_capacity(buckets, wall_buckets).unwrap_err();
            assert_eq!(error, CapacityError { what: $what, needed: n, given: n - 1 });
        }};
    }
    short!(state.position, "position");
    short!(state.velocity, "velocity");
    short!(state.density, "density");
    short!(scratch.density, "scratch density");
    short!(scratch.pressure, "pressure");
    short!(scratch.impulse, "impulse");
    short!(scratch.cells.order, "cell order");
    short!(scratch.cells.start, "cell start");
    short!(walls.velocity, "wall velocity");
    short!(walls.density, "wall density field");
    short!(scratch.wall_cells.order, "wall cell order");
    short!(scratch.wall_cells.start, "wall cell start");
    short!(scratch.wall_density, "wall density");
    short!(scratch.wall_density_fixed, "fixed wall density");
    short!(scratch.wall_pressure, "wall pressure");
}

#[test]
fn parameters_out_of_range_are_named() {
    let name = |change: &dyn Fn(&mut Parameters<2>)| {
        let mut p = Parameters {
            gravity: downwards(),
            ..water::<2>()
        };
        change(&mut p);
        match Forces::<Fixed, 2>::new(p) {
            Err(SetupError::Parameter { name, .. }) => name,
            Err(SetupError::Support { .. }) => "support",
            Ok(_) => "fine",
        }
    };
    assert_eq!(name(&|_| ()), "fine");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(name(&|p| p.support_radius = bad), "support_radius");
        assert_eq!(name(&|p| p.time_step = bad), "time_step");
        assert_eq!(name(&|p| p.mass = bad), "mass");
        assert_eq!(name(&|p| p.reference_density = bad), "reference_density");
        assert_eq!(name(&|p| p.sound_speed = bad), "sound_speed");
        let wall = Wall::Conservative {
            energy: bad,
            radius: 1.0,
            softening: 0.0,
        };
        assert_eq!(name(&|p| p.wall = wall), "wall.energy");
        let wall = Wall::Conservative {
            energy: 1.0,
            radius: bad,
            softening: 0.0,
        };
        assert_eq!(name(&|p| p.wall = wall), "wall.radius");
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let wall = Wall::Conservative {
            energy: 1.0,
            radius: 1.0,
            softening: bad,
        };
        assert_eq!(name(&|p| p.wall = wall), "wall.softening");
        let central = Central {
            centre: [0.0; 2],
            strength: 1.0,
            softening: bad,
        };
        assert_eq!(
            name(&|p| p.gravity.central = Some(central)),
            "gravity.central.softening"
        );
        assert_eq!(name(&|p| p.extent[1] = bad), "extent");
    }
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(name(&|p| p.gravity.uniform[1] = bad), "gravity.uniform");
        let central = Central {
            centre: [0.0, bad],
            strength: 1.0,
            softening: 1.0,
        };
        assert_eq!(
            name(&|p| p.gravity.central = Some(central)),
            "gravity.central.centre"
        );
        let central = Central {
            centre: [0.0; 2],
            strength: bad,
            softening: 1.0,
        };
        assert_eq!(
            name(&|p| p.gravity.central = Some(central)),
            "gravity.central.strength"
        );
    }
    assert_eq!(name(&|p| p.support_radius = 1e6), "support_radius");
    assert_eq!(name(&|p| p.reference_density = 1e7), "reference_density");
    assert_eq!(name(&|p| p.support_radius = 1e-3), "support");
    let central = Central {
        centre: [1e6, 0.0],
        strength: 1.0,
        softening: 1.0,
    };
    assert_eq!(
        name(&|p| p.gravity.central = Some(central)),
        "gravity.central.centre"
    );
    assert_eq!(name(&|p| p.integrator = &PEFRL), "fine");
}
