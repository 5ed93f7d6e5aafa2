//! What a system refuses to be set up with is typed, and gives back what it was handed.

use crate::faults::units;
use loschmidt_core::fields::{Field, MAX_FIELDS, POSITION_FIELD, Side, words_each};
use loschmidt_core::integrator::PEFRL;
use loschmidt_core::model::SetupError;
use loschmidt_core::neighbours::Grid;
use loschmidt_core::number::{Quantity, Whole};
use loschmidt_core::owned::{Owned, PushError, words};
use loschmidt_core::schemes::wcsph::{Central, FIXED_DENSITY, Wall};
use loschmidt_core::set::Set;
use loschmidt_core::{CapacityError, Fixed, Model, Parameters, Symplectic};
use loschmidt_tests::small::{FLUID, Recipe, downwards, water};

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
    assert_eq!((parts.particles.len(), parts.walls.len()), (FLUID, 512));
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
    assert!(system.parts().1.particles.is_empty());
}

type Water = Symplectic<Fixed, 2>;
const FIELDS: &[Field] = <Water as Model<Fixed, 2>>::FIELDS;
/// Words of four particles and three walls.
const TINY: usize = words(FIELDS, 2, 4, 3);
type Tiny<const B: usize, const K: usize> = Owned<Fixed, Water, 2, 4, 3, B, K>;

/// With nine buckets.
fn tiny() -> Water {
    let model = Water::new(Parameters {
        max_buckets: 9,
        ..water()
    });
    let model = model.unwrap();
    assert_eq!(model.grids().map(Grid::buckets), [9, 9]);
    model
}

#[test]
fn too_small_a_grid_is_a_capacity_error() {
    assert!(Tiny::<10, TINY>::new(tiny()).is_ok());
    let expected = CapacityError {
        what: "cell start",
        needed: 10,
        given: 9,
    };
    assert_eq!(Tiny::<9, TINY>::new(tiny()).err(), Some(expected));
}

#[test]
fn too_little_memory_for_the_fields_is_a_capacity_error() {
    // x, v, C, ρ, p, J of a particle; x, v, C, ρ, p and what is fixed of ρ of a wall.
    assert_eq!(TINY, 4 * (3 * 2 + 3) + 3 * (2 * 2 + 4));
    let expected = CapacityError {
        what: "words of memory",
        needed: TINY,
        given: TINY - 1,
    };
    const LESS: usize = TINY - 1;
    assert_eq!(Tiny::<10, LESS>::new(tiny()).err(), Some(expected));
    const MORE: usize = TINY + 1;
    assert!(Tiny::<10, MORE>::new(tiny()).is_ok());
}

#[test]
fn lent_memory_that_is_too_small_is_named() {
    for (side, each) in [(Side::Particles, 9), (Side::Walls, 8)] {
        assert_eq!(words_each(FIELDS, side, 2), each);
        let over = |particles: usize, words: usize, room: usize| {
            let (mut id, mut memory) = (vec![0; particles], vec![Whole::ZERO; words]);
            let set = Set::<Fixed, 2>::over(&mut id, &mut memory, room, FIELDS, side);
            set.map(|set| set.len())
        };
        for room in 0..4 {
            for particles in 0..=room {
                assert_eq!(over(particles, room * each, room), Ok(particles));
            }
            let (needed, given) = (room + 1, room);
            let what = "particles";
            let expected = CapacityError {
                what,
                needed,
                given,
            };
            assert_eq!(over(room + 1, 100, room), Err(expected));
        }
        for words in 0..3 * each {
            let expected = CapacityError {
                what: "words of the particles",
                needed: 3 * each,
                given: words,
            };
            assert_eq!(over(2, words, 3), Err(expected));
        }
        // No product of sizes wraps.
        let error = over(1, 100, usize::MAX).unwrap_err();
        assert_eq!((error.needed, error.given), (usize::MAX, 100));
    }
    const MANY: [Field; MAX_FIELDS + 1] = [POSITION_FIELD; MAX_FIELDS + 1];
    let set = Set::<Fixed, 2>::over(&mut [], &mut [], 0, &MANY, Side::Particles);
    let expected = CapacityError {
        what: "fields of a particle",
        needed: MAX_FIELDS + 1,
        given: MAX_FIELDS,
    };
    assert_eq!(set.err(), Some(expected));
}

#[test]
fn a_sets_fields_lie_one_after_another_with_room_after_each() {
    let mut memory: Vec<Whole> = (0..3 * 9).map(Whole::from_word).collect();
    let mut id = [7, 5];
    let set = Set::<Fixed, 2>::over(&mut id, &mut memory, 3, FIELDS, Side::Particles).unwrap();
    let mut first = 0;
    for (f, field) in FIELDS.iter().enumerate() {
        let each = field.words(Side::Particles, 2);
        let expected: Vec<i64> = (first..first + 2 * each as i64).collect();
        let found: Vec<i64> = set.words(f).iter().map(|w| w.to_word()).collect();
        assert_eq!(found, expected, "{}", field.name);
        for place in 0..2 {
            for c in 0..each {
                assert_eq!(set.word(f, c, place), expected[place * each + c]);
            }
        }
        first += 3 * each as i64;
    }
    // Particles that move have no fixed density.
    assert!(set.words(FIXED_DENSITY).is_empty());
}

#[test]
fn parameters_out_of_range_are_named() {
    let name = |change: &dyn Fn(&mut Parameters<2>)| {
        let mut p = Parameters {
            gravity: downwards(),
            ..water::<2>()
        };
        change(&mut p);
        match Water::new(p) {
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
