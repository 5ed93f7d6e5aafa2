//! The filtered scheme: a Shepard average of the velocities every few steps, and no way back.

use loschmidt_core::integrator::STORMER_VERLET;
use loschmidt_core::kernel::WendlandC2;
use loschmidt_core::schemes::wcsph::{DensityCorrection, Wall};
use loschmidt_core::{Filtered, Fixed, Model, Reversibility, Serial, Symplectic};
use loschmidt_runner::fast::Backend;
use loschmidt_runner::filter::shepard;
use loschmidt_runner::player::PlayerError;
use loschmidt_runner::scene::{Source, load};
use loschmidt_runner::{ExecutorKind, Options};
use loschmidt_tests::permitted;
use loschmidt_tests::program::{player, run, scene, serial, shuffled, threads};
use loschmidt_tests::small::{
    Recipe, Small, conservative, dam_2d, dam_3d, measure, there_and_back, velocity, water,
};
use std::ops::ControlFlow;

type Model2 = Filtered<Fixed, 2>;

fn filtered_every<const D: usize>(mut recipe: Recipe<D>, every: u64) -> Recipe<D> {
    recipe.parameters.filter_every = every;
    recipe
}

/// The average of u over fluid and walls (at rest), in plain doubles.
fn average<const D: usize>(recipe: &Recipe<D>, walls: bool) -> Vec<[f64; D]> {
    let h = recipe.parameters.support_radius;
    let kernel = WendlandC2::new(D, h, 1.0);
    let at_rest = recipe.walls.iter().map(|x| (*x, [0.0; D]));
    let walls: Vec<_> = at_rest.filter(|_| walls).collect();
    let of = |(x, _): &([f64; D], [f64; D])| {
        let (mut sum, mut gamma) = ([0.0; D], 0.0);
        for (y, u) in recipe.fluid.iter().chain(&walls) {
            let r2: f64 = (0..D).map(|d| (x[d] - y[d]).powi(2)).sum();
            let w = kernel.value(r2.sqrt());
            gamma += w;
            for d in 0..D {
                sum[d] += w * u[d];
            }
        }
        sum.map(|s| s / gamma)
    };
    recipe.fluid.iter().map(of).collect()
}

/// Compares one filtering, at rest of everything else, with the average in doubles.
fn is_the_average<const D: usize>(mut recipe: Recipe<D>, walls: bool) {
    // A step so short that nothing moves and nothing is pushed: the filter alone is seen.
    recipe.parameters.time_step = 1e-15;
    let expected = average(&recipe, walls);
    let mut system = filtered_every(recipe, 1).build::<Fixed, Filtered<Fixed, D>>();
    system.advance(1, &Serial).expect("in range");
    for (i, u) in expected.iter().enumerate() {
        let found = velocity(&mut system, i);
        for d in 0..D {
            let error = (found[d] - u[d]).abs();
            assert!(error < permitted::SHEPARD_AVERAGE, "{i}: {error:e}");
        }
    }
}

#[test]
fn a_filtering_is_the_shepard_average_with_dummies_at_rest() {
    for correction in [DensityCorrection::Constant, DensityCorrection::None] {
        for (wall, counted) in [(conservative(), false), (Wall::Dummy, true)] {
            let mut plane = dam_2d(wall, &STORMER_VERLET).stirred(3, 1.0);
            plane.parameters.density_correction = correction;
            is_the_average(plane, counted);
            let mut space = dam_3d(wall, &STORMER_VERLET).stirred(3, 1.0);
            space.parameters.density_correction = correction;
            is_the_average(space, counted);
        }
    }
}

#[test]
fn a_common_velocity_is_not_changed_by_a_bit() {
    let mut recipe = Recipe::block(water::<2>(), [5, 4]);
    for (_, v) in &mut recipe.fluid {
        *v = [1.0, -0.3];
    }
    let mut plain = recipe.symplectic();
    let mut filtered = filtered_every(recipe, 1).build::<Fixed, Model2>();
    plain.advance(20, &Serial).expect("in range");
    filtered.advance(20, &Serial).expect("in range");
    assert_eq!(plain.digest(), filtered.digest());
}

#[test]
fn between_filterings_it_is_the_symplectic_scheme() {
    let recipe = filtered_every(dam_2d(conservative(), &STORMER_VERLET).stirred(5, 1.0), 10);
    let mut plain = recipe.symplectic();
    let mut filtered = recipe.build::<Fixed, Model2>();
    for step in 1..=10 {
        plain.advance(1, &Serial).expect("in range");
        filtered.advance(1, &Serial).expect("in range");
        assert_eq!(plain.digest() == filtered.digest(), step < 10, "{step}");
    }
}

#[test]
fn it_takes_energy_and_never_returns() {
    let recipe = filtered_every(dam_2d(conservative(), &STORMER_VERLET).stirred(5, 1.0), 5);
    let mut plain: Box<Small<Symplectic<Fixed, 2>, 2>> = recipe.symplectic();
    let mut system = recipe.build::<Fixed, Model2>();
    let before = measure(&mut system).energies.total();
    plain.advance(50, &Serial).expect("in range");
    system.advance(50, &Serial).expect("in range");
    let lost = before - measure(&mut system).energies.total();
    let drift = before - measure(&mut plain).energies.total();
    assert!(lost > 100.0 * drift.abs(), "{lost} {drift}");

    let mut system = recipe.build::<Fixed, Model2>();
    let [first, _, last] = there_and_back(&mut system, 5);
    assert_ne!(first, last);
    assert_eq!(
        <Model2 as Model<Fixed, 2>>::REVERSIBILITY,
        Reversibility::Dissipative
    );
}

#[test]
fn every_executor_leaves_the_same_bits() {
    let fast = |n| Options {
        executor: ExecutorKind::Fast,
        backend: Backend::best(),
        ..threads(n)
    };
    for (name, spacing) in [
        ("dam-break", "0.05"),
        ("dam-break-3d", "0.1"),
        ("gresho-vortex", "0.05"),
    ] {
        let spacing = format!("particle_spacing={spacing}");
        let set = [
            spacing.as_str(),
            "turnaround=",
            "end=0.1",
            "model=filtered",
            "filter_every=7",
        ];
        let digest = |options| run(scene(name, &set), options).0.digest.last;
        let reference = digest(serial());
        for options in [threads(3), fast(1), fast(4), shuffled(serial(), 9)] {
            assert_eq!(digest(options), reference, "{name} {options:?}");
        }
    }
}

#[test]
fn the_player_refuses_to_go_back_and_says_why() {
    let set = ["turnaround=", "end=0.1", "model=filtered"];
    let mut player = player(
        scene("dam-break", &[&["particle_spacing=0.2"], &set[..]].concat()),
        serial(),
    );
    assert_eq!(player.reversibility(), Reversibility::Dissipative);
    let go_on = |_| ControlFlow::Continue(());
    player.seek(20, 5, go_on).expect("forward it goes");
    assert_eq!(player.seek(19, 5, go_on), Err(PlayerError::Dissipative));
    assert_eq!(
        PlayerError::Dissipative.to_string(),
        "the model takes energy out of the flow for good: it cannot be integrated backwards"
    );
}

#[test]
fn a_scene_that_filters_has_no_turnaround() {
    let source = Source::Catalogue("dam-break".to_owned());
    let error = load(&source, &["model=filtered".to_owned()]).expect_err("no way back");
    assert!(error.to_string().contains("`turnaround` does not go with"));
}

/// The passive filter, on a copy: the average in doubles with the volumes of the frame, and the
/// state as it was.
#[test]
fn the_passive_filter_averages_a_copy_and_leaves_the_state_alone() {
    let set = ["particle_spacing=0.05", "turnaround=0.5"];
    let scene = scene("gresho-vortex", &set);
    let mut player = player(scene.clone(), serial());
    player.advance(100).expect("in range");
    let before = player.save();
    let frame = player.frame().expect("densities");
    let filtered = shepard(&scene, &frame);
    assert_eq!(player.save(), before);
    let kernel = WendlandC2::new(2, scene.support_radius(), 1.0);
    let mass = frame.particle_mass;
    for (x, found) in frame.position.iter().zip(&filtered) {
        let (mut sum, mut gamma) = ([0.0; 2], 0.0);
        let mut add = |y: &[f64; 3], volume: f64, u: &[f64; 3]| {
            let w = volume * kernel.value((x[0] - y[0]).hypot(x[1] - y[1]));
            gamma += w;
            sum = [sum[0] + w * u[0], sum[1] + w * u[1]];
        };
        for ((y, u), rho) in frame
            .position
            .iter()
            .zip(&frame.velocity)
            .zip(frame.column("density").expect("a column"))
        {
            add(y, mass / rho, u);
        }
        for y in &frame.wall_position {
            add(y, mass / scene.reference_density(), &[0.0; 3]);
        }
        for d in 0..2 {
            let error = (found[d] - sum[d] / gamma).abs();
            assert!(error < permitted::SHEPARD_AVERAGE, "{error:e}");
        }
    }
}
