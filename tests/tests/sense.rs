//! Scenes whose numbers do not belong together are seen: how far they go, what their walls hold, how
//! much they are compressed.

use loschmidt_core::FaultKind;
use loschmidt_runner::Player;
use loschmidt_runner::RunError;
use loschmidt_runner::scene::Scene;
use loschmidt_runner::setup;
use loschmidt_tests::program::{fastest, player, run, scene_of, try_run};

/// A square of water in the corner of a box of 2 m.
fn base(more: &str) -> Scene {
    scene_of(&format!(
        r#"
        particle_spacing = 0.1
        turnaround = 0.4
        gravity.uniform = [0.0, -9.8]
        output = {{ rows = 40, frames = 8, snapshots = 8 }}
        region = [
            {{ kind = "fluid", shape.rectangle = {{ min = [0.0, 0.0], max = [1.0, 1.0] }} }},
            {{ kind = "wall", shape.layer = {{ around.rectangle = {{ min = [0.0, 0.0], max = [2.0, 2.0] }}, depth = 2.5 }} }},
        ]
        {more}
        "#
    ))
}

/// A drop that nothing holds.
fn drop_of(more: &str) -> Scene {
    scene_of(&format!(
        r#"
        particle_spacing = 0.1
        turnaround = 2.0
        fluid.sound_speed = 40.0
        gravity.uniform = [0.0, -9.8]
        {more}
        [[region]]
        kind = "fluid"
        shape.circle = {{ centre = [0.0, 0.0], radius = 0.5 }}
        "#
    ))
}

#[test]
fn a_drop_falls_as_long_as_it_is_asked_to_and_comes_back() {
    let (outcome, rows) = run(drop_of(""), fastest(1));
    assert_eq!(outcome.reversed_exactly, Some(true));
    let lowest = rows.iter().map(|row| row.energy("gravitational"));
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    // It has fallen by g t²/2, 40 times its radius.
    let mass = outcome.particles as f64 * 10.0;
    let fallen = -lowest / (mass * 9.8);
    assert!((fallen / 19.6 - 1.0).abs() < 1e-2, "{fallen} m");
}

#[test]
fn a_domain_is_kept_and_named_where_it_ends() {
    let (result, _) = try_run(drop_of("domain = 1.5"), fastest(1));
    let Err(error @ RunError::Fault { fault, time, .. }) = &result else {
        panic!("{result:?}");
    };
    assert_eq!(
        (fault.fault.kind, fault.range),
        (FaultKind::PositionRange, 2.0)
    );
    // The lowest particle starts at -0.45 m.
    let expected = (2.0 * (2.0 - 0.45) / 9.8_f64).sqrt();
    assert!((time / expected - 1.0).abs() < 0.02, "{time} s");
    let words =
        "left the number range, 2 m from the origin along an axis; the key `domain` sets it";
    assert!(error.to_string().contains(words), "{error}");
    let small = drop_of("domain = 0.3")
        .initial_state()
        .expect_err("too small");
    assert!(
        small.to_string().contains("allowed: at least 0.45"),
        "{small}"
    );
}

#[test]
fn what_walls_hold_needs_no_more_room_than_at_the_start() {
    let range = |scene: &Scene| {
        let initial = scene.initial_state().expect("a state");
        let reach = setup::reach(scene, &initial);
        (
            reach.expected / reach.first,
            setup::length_range(scene, &initial),
        )
    };
    let closed = base("fluid.sound_speed = 45\nwall.energy = 98");
    assert_eq!(range(&closed), (1.0, 16.0));
    let free = base("fluid.sound_speed = 45\nwall_model = \"none\"");
    // (c/10) t + g t²/2 beyond the corner of the water.
    let expected = 0.95 + 4.5 * 0.4 + 0.5 * 9.8 * 0.16;
    assert!(
        (range(&free).0 - expected / 0.95).abs() < 2e-3,
        "{:?}",
        range(&free)
    );
}

#[test]
fn walls_and_sound_are_compared_with_the_flow() {
    let sense = |more: &str| {
        let scene = base(more);
        let initial = scene.initial_state().expect("a state");
        setup::sense(&scene, &initial).expect("water")
    };
    // The highest particle is 0.9 m above the lowest one; the deepest cell lies a little lower.
    let good = sense("fluid.sound_speed = 45\nwall.energy = 98");
    let height = good.energy() / 9.8;
    assert!((0.89..1.0).contains(&height), "{height} m");
    let wall = good.wall.expect("a wall");
    // Two neighbours half a spacing away, r_w = 0.95 spacings: 2 E (0.9025/0.25 - 1)²/4.
    assert!((wall.barrier / wall.energy - 0.5 * 2.61_f64.powi(2)).abs() < 1e-3);
    let holes = sense("fluid.sound_speed = 45\nwall = { energy = 98, radius = 0.5 }");
    assert!(holes.wall.is_some_and(|wall| wall.barrier < 1e-6));
    assert!(
        sense("fluid.sound_speed = 45\nwall_model = \"dummy\"")
            .wall
            .is_none()
    );
}

#[test]
fn a_run_counts_what_is_beyond_its_walls_and_says_how_much_was_compressed() {
    let seen = |more: &str| run(base(more), fastest(1)).0.seen;
    let good = seen("fluid.sound_speed = 45\nwall.energy = 98");
    assert_eq!(good.beyond_walls, Some(0));
    let compression = good.largest_compression.expect("a density");
    assert!((0.0..0.1).contains(&compression), "{compression}");
    let weak = seen("fluid.sound_speed = 45\nwall.energy = 1");
    assert!(weak.beyond_walls > Some(8), "{weak:?}");
    let holes = seen("fluid.sound_speed = 45\nwall = { energy = 98, radius = 0.5 }");
    assert!(holes.beyond_walls > Some(5), "{holes:?}");
    let soft = seen("fluid.sound_speed = 10\nwall.energy = 98");
    assert!(soft.largest_compression > Some(0.1), "{soft:?}");
    assert_eq!(
        run(drop_of("output.frames = 0"), fastest(1))
            .0
            .seen
            .beyond_walls,
        None
    );
}

/// Root of the mean square speed of the particles, m/s.
fn rms_speed(player: &mut Player) -> f64 {
    let frame = player.frame().expect("in range");
    let squares = frame.velocity.iter().map(|v| v[0] * v[0] + v[1] * v[1]);
    (squares.sum::<f64>() / frame.velocity.len() as f64).sqrt()
}

/// The speed after 5 s in a tank that is half full of water from wall to wall.
fn speed_in_a_tank_at_rest(more: &str) -> f64 {
    let scene = scene_of(&format!(
        r#"
        particle_spacing = 0.1
        turnaround = 5.0
        fluid.sound_speed = 45.0
        gravity.uniform = [0.0, -9.8]
        region = [
            {{ kind = "fluid", shape.rectangle = {{ min = [0.0, 0.0], max = [2.0, 1.0] }} }},
            {{ kind = "wall", shape.layer = {{ around.rectangle = {{ min = [0.0, 0.0], max = [2.0, 1.5] }}, depth = 2.5 }} }},
        ]
        {more}
        "#
    ));
    let steps = scene.steps_out();
    let mut tank = player(scene, fastest(1));
    tank.advance(steps).expect("in range");
    rms_speed(&mut tank)
}

#[test]
fn a_tank_at_rest_stays_at_rest_where_it_begins_with_the_pressure_of_its_weight() {
    let speed = |correction: &str| {
        speed_in_a_tank_at_rest(&format!(
            "wall_model = \"dummy\"\ndensity_correction = \"{correction}\""
        ))
    };
    // Without that pressure the water falls until it has it, and what it gains becomes noise.
    let (falls, rests) = (speed("constant"), speed("hydrostatic"));
    assert!(rests < 0.05 && falls > 0.05, "{falls} and {rests} m/s");
}
