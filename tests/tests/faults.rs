//! What ends a run is typed, and names the particle and the step.

use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::fields::{POSITION_FIELD, Side, VELOCITY, VELOCITY_FIELD};
use loschmidt_core::integrator::{Integrator, Stage};
use loschmidt_core::number::{Arithmetic, LIMIT_BITS, Quantity, Whole};
use loschmidt_core::owned::{Owned, words};
use loschmidt_core::points::PointPass;
use loschmidt_core::schemes::wcsph::{
    CONSTANT, Central, DensityCorrection, Gravity, StateEquation, Wall,
};
use loschmidt_core::set::Set;
use loschmidt_core::{
    CapacityError, Diagnostics, Executor, Fault, FaultKind, Fixed, Float, Model, Parameters, Scale,
    Serial, Symplectic,
};
use loschmidt_tests::small::{Recipe, SPACING, conservative, displace, shuffle, water};

/// Far apart: nobody feels anybody.
fn dust(parameters: Parameters<2>, velocities: &[[f64; 2]]) -> Recipe<2> {
    let mut recipe = Recipe::empty(parameters);
    for (i, v) in velocities.iter().enumerate() {
        recipe.fluid.push(([i as f64, 0.0], *v));
    }
    recipe
}

/// Positions below 32 m, speeds below 2048 m/s; one term of a density below 8192 kg/m³.
pub(crate) fn units() -> Parameters<2> {
    Parameters {
        scale: Scale {
            length_exponent: 0,
            speed_exponent: 0,
            density_exponent: 2,
        },
        time_step: 1.0 / 1024.0,
        ..water()
    }
}

/// The fault of the first failing step, in any order of storage.
fn fault_of<A: Arithmetic, const D: usize>(recipe: &Recipe<D>, steps: u64) -> Fault {
    let mut system = recipe.build::<A, Symplectic<A, D>>();
    let fault = system.advance(steps, &Serial).unwrap_err();
    for seed in 0..8 {
        let mut system = recipe.build::<A, Symplectic<A, D>>();
        shuffle(&mut system.parts().1, seed);
        assert_eq!(system.advance(steps, &Serial), Err(fault));
    }
    fault
}

fn fault(kind: FaultKind, particle: u64, step: u64) -> Fault {
    Fault {
        kind,
        particle,
        step,
    }
}

#[test]
fn of_kicks_that_two_steps_add_in_one_go_the_step_is_named() {
    let gravity = Gravity {
        uniform: [1024.0, 0.0],
        central: None,
    };
    let parameters = Parameters { gravity, ..units() };
    // Half a metre per second and kick, two kicks a step: 2048 m/s at kick number n + 1 of particle
    // 1, and one kick later of particle 0.
    for n in 0..6u32 {
        let speed = 2047.75 - 0.5 * f64::from(n);
        let recipe = dust(parameters, &[[speed - 0.5, 0.0], [speed, 0.0]]);
        let expected = fault(FaultKind::VelocityRange, 1, u64::from(n / 2 + 1));
        assert_eq!(fault_of::<Fixed, 2>(&recipe, 10), expected, "{n}");
    }
}

#[test]
fn a_velocity_that_leaves_the_range_is_named() {
    let gravity = Gravity {
        uniform: [1024.0, 0.0],
        central: None,
    };
    let parameters = Parameters { gravity, ..units() };
    // Half a metre per second and kick, 2048 m/s at the third of 2046.75: in step 2.
    let recipe = dust(
        parameters,
        &[[0.0; 2], [2046.75, 0.0], [-2000.0, 0.0], [2046.75, 0.0]],
    );
    assert_eq!(
        fault_of::<Fixed, 2>(&recipe, 5),
        fault(FaultKind::VelocityRange, 1, 2)
    );
    assert_eq!(
        fault_of::<Float, 2>(&recipe, 5),
        fault(FaultKind::VelocityRange, 1, 2)
    );
}

#[test]
fn a_position_that_leaves_the_range_is_named() {
    let mut recipe = dust(
        units(),
        &[[0.0; 2], [-1.0, 0.0], [0.0; 2], [0.0, 1.0], [0.0, -1.0]],
    );
    recipe.fluid[3].0[1] = 32.0 - 2.5 / 1024.0;
    recipe.fluid[4].0[1] = -32.0 + 2.5 / 1024.0;
    assert_eq!(
        fault_of::<Fixed, 2>(&recipe, 5),
        fault(FaultKind::PositionRange, 3, 3)
    );
    assert_eq!(
        fault_of::<Float, 2>(&recipe, 5),
        fault(FaultKind::PositionRange, 3, 3)
    );
    // The last quantum inside is inside.
    let mut recipe = dust(units(), &[[1.0, 0.0]]);
    recipe.fluid[0].0[0] = 32.0 - 2f64.powi(-46) - 1.0 / 1024.0;
    let mut system = recipe.symplectic();
    system.advance(1, &Serial).unwrap();
    assert_eq!(
        system.parts().1.particles.position()[0][0].to_bits(),
        LIMIT_BITS - 1
    );
    assert_eq!(
        system.advance(1, &Serial),
        Err(fault(FaultKind::PositionRange, 0, 2))
    );
}

#[test]
fn a_drift_longer_than_the_range_is_a_fault_of_position() {
    let parameters = Parameters {
        time_step: 1.0,
        ..units()
    };
    let recipe = dust(parameters, &[[0.0; 2], [40.0, 0.0]]);
    assert_eq!(
        fault_of::<Fixed, 2>(&recipe, 1),
        fault(FaultKind::PositionRange, 1, 1)
    );
}

/// Particles 1 and 3 shoot at 2 and 4; at a quarter of the support their push is out of range.
fn collision(speed_exponent: i32) -> Recipe<2> {
    let parameters = Parameters {
        support_radius: SPACING,
        sound_speed: 1000.0,
        scale: Scale {
            speed_exponent,
            ..units().scale
        },
        ..units()
    };
    let mut recipe = dust(
        parameters,
        &[[0.0; 2], [64.0, 0.0], [0.0; 2], [64.0, 0.0], [0.0; 2]],
    );
    for i in [2, 4] {
        recipe.fluid[i].0[0] = recipe.fluid[i - 1].0[0] + 1.5 * SPACING;
    }
    recipe
}

#[test]
fn a_violent_collision_is_a_typed_end() {
    // Limit 128 m/s for velocities and for the push of one kick.
    let found = fault_of::<Fixed, 2>(&collision(-4), 5);
    assert_eq!(found, fault(FaultKind::TermRange, 1, 2));
    assert_eq!(fault_of::<Float, 2>(&collision(-4), 5), found);
    // With more room the same collision is legal.
    assert_eq!(collision(8).symplectic().advance(2, &Serial), Ok(()));
}

#[test]
fn gravity_out_of_range_is_a_fault_of_a_term() {
    for g in [4096.0 * 1024.0 * 2.0, f64::MAX, -f64::MAX] {
        let gravity = Gravity {
            uniform: [0.0, g],
            central: None,
        };
        let recipe = dust(Parameters { gravity, ..units() }, &[[0.0; 2]; 3]);
        assert_eq!(
            fault_of::<Fixed, 2>(&recipe, 1),
            fault(FaultKind::TermRange, 0, 1)
        );
    }
}

#[test]
fn a_particle_on_an_unsoftened_mass_is_a_fault_and_not_a_zero() {
    // 0/0 is not a number; a cast would have made a zero of it.
    let central = Central {
        centre: [2.0, 0.0],
        strength: 1.0,
        softening: 0.0,
    };
    let gravity = Gravity {
        uniform: [0.0; 2],
        central: Some(central),
    };
    let recipe = dust(Parameters { gravity, ..units() }, &[[0.0; 2]; 4]);
    assert_eq!(
        fault_of::<Fixed, 2>(&recipe, 1),
        fault(FaultKind::TermRange, 2, 1)
    );
}

#[test]
fn numbers_that_are_none_in_a_float_state_are_faults() {
    for bad in [f64::NAN, f64::INFINITY] {
        let build = || dust(units(), &[[0.0; 2]; 3]).build::<Float, Symplectic<Float, 2>>();
        let mut system = build();
        system.parts().1.particles.velocity_mut()[1][1] = bad;
        assert_eq!(
            system.advance(1, &Serial),
            Err(fault(FaultKind::VelocityRange, 1, 1))
        );
        let mut system = build();
        system.parts().1.particles.words_mut(CONSTANT)[2] = f64::NAN;
        assert_eq!(
            system.advance(1, &Serial),
            Err(fault(FaultKind::DensityNotPositive, 2, 1))
        );
    }
    let mut system = dust(units(), &[[0.0; 2]; 3]).build::<Float, Symplectic<Float, 2>>();
    system.parts().1.particles.position_mut()[1][1] = f64::NAN;
    assert_eq!(
        system.advance(1, &Serial),
        Err(fault(FaultKind::PositionRange, 1, 1))
    );
}

/// `n` particles on one point whose C_a is so negative that none may leave the others.
fn burst(n: usize) -> Recipe<2> {
    let parameters = Parameters {
        support_radius: SPACING,
        ..units()
    };
    let mut recipe = Recipe::empty(parameters);
    for i in 0..n {
        let v = if i < 2 { 0.0 } else { 64.0 * i as f64 };
        recipe.fluid.push(([0.0; 2], [v, 0.0]));
    }
    recipe
}

#[test]
fn a_density_that_is_not_positive_is_named() {
    let found = fault_of::<Fixed, 2>(&burst(6), 10);
    assert_eq!(
        (found.kind, found.particle),
        (FaultKind::DensityNotPositive, 0)
    );
    assert_eq!(fault_of::<Float, 2>(&burst(6), 10), found);
    assert!((1..=10).contains(&found.step));
}

#[test]
fn a_density_of_dummy_walls_that_is_not_positive_is_named_by_the_walls_id() {
    let parameters = Parameters {
        support_radius: SPACING,
        wall: Wall::Dummy,
        density_correction: DensityCorrection::Constant,
        ..units()
    };
    let mut recipe = Recipe::empty(parameters);
    // Fluid in a heap around a wall particle flies off; a second wall particle is alone.
    for k in 0..4 {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        recipe.fluid.push(([0.0; 2], [0.0, side * 500.0]));
    }
    recipe.walls.push([3.0, 0.0]);
    recipe.walls.push([0.0; 2]);
    let mut system = recipe.symplectic();
    let found = system.advance(20, &Serial).unwrap_err();
    assert_eq!(found.kind, FaultKind::DensityNotPositive);
    // The fluid loses its neighbours too, but its smallest id comes in an earlier sweep.
    assert!(found.particle < 6);
    // C_a of the fluid raised: now it is the wall that fails.
    let mut system = recipe.symplectic();
    system
        .parts()
        .1
        .particles
        .words_mut(CONSTANT)
        .fill(Whole::ZERO);
    let found = system.advance(20, &Serial).unwrap_err();
    assert_eq!(
        (found.kind, found.particle),
        (FaultKind::DensityNotPositive, 5)
    );
}

type Water = Symplectic<Fixed, 2>;
const HEAP: usize = words(<Water as Model<Fixed, 2>>::FIELDS, 2, 4200, 4200);
type Heap = Owned<Fixed, Water, 2, 4200, 4200, 64, HEAP>;

/// `n` fluid and `w` wall particles on nearly one point.
fn heap(n: u32, w: u32, wall: Wall) -> Box<Heap> {
    let parameters = Parameters {
        max_buckets: 63,
        wall,
        ..units()
    };
    let mut system = Box::new(Heap::new(Water::new(parameters).unwrap()).unwrap());
    for i in 0..n {
        system
            .push_fluid([1e-7 * f64::from(i), 0.0], [0.0; 2])
            .unwrap();
    }
    for i in 0..w {
        system.push_wall([1e-7 * f64::from(i), 0.1]).unwrap();
    }
    system
}

#[test]
fn a_crowd_is_a_fault_from_one_neighbour_too_many() {
    let mut system = heap(MAX_NEIGHBOURS + 1, 0, Wall::None);
    assert_eq!(system.initialise(&Serial), Ok(()));
    assert_eq!(system.advance(1, &Serial), Ok(()));
    let mut system = heap(MAX_NEIGHBOURS + 2, 0, Wall::None);
    assert_eq!(
        system.initialise(&Serial),
        Err(fault(FaultKind::Crowded, 0, 0))
    );
}

#[test]
fn a_crowd_of_walls_is_a_fault_of_the_fluid_beside_it() {
    for wall in [conservative(), Wall::Dummy] {
        let mut system = heap(2, MAX_NEIGHBOURS + 1, wall);
        let found = system
            .initialise(&Serial)
            .and_then(|()| system.advance(1, &Serial));
        let step = u64::from(wall != Wall::Dummy);
        assert_eq!(found, Err(fault(FaultKind::Crowded, 0, step)));
    }
}

static KICK: Integrator = Integrator {
    name: "kick",
    order: 1,
    evaluations: 1,
    stages: &[Stage::Kick(1.0)],
};

/// As many fluid neighbours as are allowed, all on one point, and as many walls on another, all
/// pushing particle 0 along the first axis; the velocities of the first two after one kick, m/s.
fn push(sound_speed: f64, energy: f64, gravity: f64, speed: f64) -> Result<[f64; 2], Fault> {
    let parameters = Parameters {
        max_buckets: 63,
        sound_speed,
        state_equation: StateEquation::Linear,
        density_correction: DensityCorrection::None,
        integrator: &KICK,
        gravity: Gravity {
            uniform: [gravity, 0.0],
            central: None,
        },
        wall: Wall::Conservative {
            energy,
            radius: 0.1,
            softening: 0.01,
        },
        ..units()
    };
    let mut system = Box::new(Heap::new(Water::new(parameters).unwrap()).unwrap());
    system.push_fluid([0.0; 2], [speed, 0.0]).unwrap();
    for _ in 0..MAX_NEIGHBOURS {
        system.push_fluid([-0.15, 0.0], [0.0; 2]).unwrap();
        system.push_wall([-0.04, 0.0]).unwrap();
    }
    system.initialise(&Serial)?;
    system.advance(1, &Serial)?;
    let (_, parts) = system.parts();
    let v = |i: usize| parts.particles.velocity()[i][0].quanta() * 2f64.powi(-40);
    Ok([v(0), v(1)])
}

#[test]
fn a_sum_of_very_many_large_terms_is_a_fault_and_not_a_wrap() {
    // Tune both forces so that every single term lies just inside the range.
    let many = f64::from(MAX_NEIGHBOURS);
    let (tiny, wanted) = (1e-15, 2048.0 * 0.999_97);
    let of_fluid = push(1.0, tiny, 0.0, 0.0).unwrap()[0] / many;
    let of_wall = push(tiny, 1e-3, 0.0, 0.0).unwrap()[0] / many;
    let (sound_speed, energy) = ((wanted / of_fluid).sqrt(), 1e-3 * wanted / of_wall);
    // Half a range of gravity and all of a range of velocity on top.
    let pushed = push(sound_speed, energy, 0.5 * 2048.0 * 1024.0, 2047.0);
    assert_eq!(pushed, Err(fault(FaultKind::VelocityRange, 0, 1)));
}

#[test]
fn faults_are_the_same_whoever_finds_them_first() {
    let (a, b) = (
        fault(FaultKind::TermRange, 3, 1),
        fault(FaultKind::Crowded, 2, 1),
    );
    assert_eq!((a.first(b), b.first(a)), (b, b));
    let mut ids = std::array::from_fn::<u64, 10, _>(|i| 10 + (7 * i as u64 + 3) % 10);
    let mut memory = [Whole::ZERO; 40];
    let fields = &[POSITION_FIELD, VELOCITY_FIELD];
    let set = Set::<Fixed, 2>::over(&mut ids, &mut memory, 10, fields, Side::Particles);
    let mut set = set.unwrap();
    let result = Serial.points(&Odd, &mut set);
    assert_eq!(result, Err(fault(FaultKind::TermRange, 10, 0)));
    // All were visited, failed ones or not.
    for (id, v) in set.id.iter().zip(set.velocity()) {
        assert_eq!(v.map(|v| v.to_word()), [*id as i64; 2]);
    }
}

/// Writes the id into the velocity, and fails where it is even.
struct Odd;

impl PointPass<Fixed, 2> for Odd {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = [T; 2];
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[VELOCITY];
    fn at(&self, id: u64, _: &[Whole; 0], v: &mut [Whole; 2]) -> Result<(), Fault> {
        *v = [Whole::from_word(id as i64); 2];
        match id % 2 {
            0 => Err(Fault::new(FaultKind::TermRange, id)),
            _ => Ok(()),
        }
    }
}

#[test]
fn a_fault_reads_as_a_sentence() {
    let text = fault(FaultKind::PositionRange, 17, 4).to_string();
    assert_eq!(
        text,
        "particle 17 in step 4: its position left the number range"
    );
    for kind in [
        FaultKind::VelocityRange,
        FaultKind::TermRange,
        FaultKind::DensityNotPositive,
        FaultKind::Crowded,
    ] {
        assert!(
            fault(kind, 1, 2)
                .to_string()
                .starts_with("particle 1 in step 2: ")
        );
    }
    let capacity = CapacityError {
        what: "cell start",
        needed: 10,
        given: 9,
    };
    assert_eq!(
        capacity.to_string(),
        "cell start: room for 10 needed, 9 given"
    );
}

#[test]
fn a_fault_found_while_measuring_names_the_step_that_the_state_is_at() {
    // A row that ends with a drift leaves a density that nobody has looked at yet.
    let mut system = heap(4, 0, Wall::None);
    system.initialise(&Serial).unwrap();
    system.advance(3, &Serial).unwrap();
    let mut crowd = heap(MAX_NEIGHBOURS + 2, 0, Wall::None);
    let (model, mut parts) = crowd.parts();
    parts.clock.step = 7;
    let found = Diagnostics::measure(model, &mut parts, &Serial).unwrap_err();
    assert_eq!(found, fault(FaultKind::Crowded, 0, 7));
}

#[test]
fn a_density_that_is_not_positive_has_no_energy() {
    for state_equation in [StateEquation::Tait, StateEquation::Linear] {
        for seed in 0..4 {
            let mut recipe = burst(6);
            recipe.parameters.state_equation = state_equation;
            let mut system = recipe.symplectic();
            // Apart, without a step: no kick has seen these densities.
            for place in [2, 3, 4, 5] {
                displace(&mut system, place, 1, (place as i64) << 46);
            }
            let (model, mut parts) = system.parts();
            shuffle(&mut parts, seed);
            parts.clock.step = 3;
            let found = Diagnostics::measure(model, &mut parts, &Serial).unwrap_err();
            assert_eq!(found, fault(FaultKind::DensityNotPositive, 0, 3));
        }
    }
}
