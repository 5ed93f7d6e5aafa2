//! Runs of the scenes of elastic bodies and of viscous fluids.

use loschmidt_runner::SavedState;
use loschmidt_runner::scene::Scene;
use loschmidt_tests::permitted;
use loschmidt_tests::program::{
    assert_same_way_back, every_way, fastest, player, run, scene, serial,
};

use std::f64::consts::PI;

/// Golden values, each with a line in the changelog when it changes. Small editions of the scenes: name, what is set, digests at home and after some steps.
const GOLDEN: [(&str, &[&str], u64, [&str; 2]); 4] = [
    (
        "beryllium-plate",
        &["particle_spacing=1e-3"],
        200,
        [
            "208d893fa994133661fcd7df2fd552cc",
            "05677c98a643f33b0c2eb9e1ed0d6369",
        ],
    ),
    (
        "twisting-column",
        &[
            "particle_spacing=0.2",
            "region.1.shape.box.max=[0.5, 0.5, 2.0]",
        ],
        60,
        [
            "6c619a8f92774dd061e2714ecb145660",
            "988aedce47a12dd72a0ee194d83914e8",
        ],
    ),
    (
        "colliding-rings",
        &["particle_spacing=0.0025"],
        200,
        [
            "6e2802924bd55d1d7339f762c5b09f29",
            "7d8dfff20692cf393371f3b9564839c4",
        ],
    ),
    (
        "cantilever",
        &["particle_spacing=0.004"],
        200,
        [
            "34abd3c2a20074031114997ba3273165",
            "66f92b0f0fbe789dc3454349a10dc76c",
        ],
    ),
];

/// The same of viscous fluids, which do not return.
const GOLDEN_FLOWS: [(&str, &[&str], u64, [&str; 2]); 2] = [
    (
        "taylor-couette",
        &[
            "particle_spacing=0.1",
            "region.1.shape.annulus.inner=0.85",
            "region.2.shape.annulus.outer=2.15",
        ],
        150,
        [
            "983dda1ad40af1ee9d0d5716d4887e88",
            "ed064e485f5c3aa7bb0d05f6e8da7b8c",
        ],
    ),
    (
        "lid-driven-cavity",
        &["particle_spacing=0.05", "viscous.start=0.1"],
        150,
        [
            "9333f5c9a99896076ece8fc93d4943fd",
            "c780e1eb45984685c4a639071a1d82b5",
        ],
    ),
];

#[test]
fn golden_digests_of_viscous_flows_on_every_executor() {
    for (name, set, steps, digests) in GOLDEN_FLOWS {
        let scene = scene(name, set);
        for options in every_way() {
            let mut player = player(scene.clone(), options);
            let home = player.digest();
            player.advance(steps).unwrap();
            let found = [home, player.digest()].map(|digest| digest.to_string());
            assert_eq!(found, digests, "{name}, {options:?}");
        }
    }
}

#[test]
fn a_saved_flow_goes_on_with_its_walls() {
    let (name, set, steps, _) = GOLDEN_FLOWS[0];
    let scene = scene(name, set);
    let mut whole = player(scene.clone(), fastest(2));
    whole.advance(steps).unwrap();
    let mut first = player(scene.clone(), serial());
    first.advance(steps / 2).unwrap();
    let (saved, position, arrow) = (first.save(), first.position(), first.arrow());
    let mut second = player(scene, fastest(2));
    second.restore(&saved, position, arrow).unwrap();
    second.advance(steps - steps / 2).unwrap();
    assert_eq!(second.digest(), whole.digest());
}

#[test]
fn the_flow_between_cylinders_is_the_exact_one_and_its_distortion_turns() {
    let (name, set, ..) = GOLDEN_FLOWS[0];
    let mut player = player(scene(name, set), fastest(2));
    let flowing = player.scene().initial_state().unwrap().parts[1].first as usize;
    let (dt, mut rate, mut deviation) = (player.scene().time_step(), 0.0, 0.0);
    let angle = |state: &SavedState| {
        let words = &state
            .fields
            .iter()
            .find(|f| f.name == "distortion")
            .unwrap()
            .words;
        let mut sums = [0.0; 2];
        for (n, a) in words.chunks_exact(4).enumerate().take(flowing) {
            let [x, y, _] = state.position(n);
            if (x.hypot(y) - 1.5).abs() < 0.1 {
                sums[0] += (a[2] - a[1]) as f64;
                sums[1] += (a[0] + a[3]) as f64;
            }
        }
        sums[0].atan2(sums[1])
    };
    player.advance((4.0 / dt) as u64).unwrap();
    let (looks, apart) = (20, (0.05 / dt) as u64);
    let mut before = angle(&player.save());
    for _ in 0..looks {
        player.advance(apart).unwrap();
        let state = player.save();
        let now = angle(&state);
        rate += (now - before + PI).rem_euclid(2.0 * PI) - PI;
        before = now;
        // The mean deviation of the speed around the axis, (4/3)(r - 1/r).
        for n in 0..flowing {
            let ([x, y, _], [u, v, _]) = (state.position(n), state.velocity(n));
            let r = x.hypot(y);
            deviation += (x * v - y * u) / r - 4.0 / 3.0 * (r - 1.0 / r);
        }
    }
    let rate = rate / (f64::from(looks) * apart as f64 * dt);
    assert!((rate / (-4.0 / 3.0) - 1.0).abs() < 0.04, "{rate}");
    let deviation = deviation / (f64::from(looks) * flowing as f64);
    assert!(deviation.abs() < 0.03, "{deviation}");
}

fn golden(n: usize) -> (Scene, u64, [&'static str; 2]) {
    let (name, set, steps, digests) = GOLDEN[n];
    (scene(name, set), steps, digests)
}

/// Every executor, instruction set, number of threads and order of storage: the same digests, and
/// back to the first bit.
fn check(n: usize) {
    let (scene, steps, digests) = golden(n);
    for options in every_way() {
        let mut player = player(scene.clone(), options);
        let home = player.digest();
        player.advance(steps).unwrap();
        let there = player.digest();
        let found = [home.to_string(), there.to_string()];
        assert_eq!(found, digests, "{}, {options:?}", scene.name);
        player.turn();
        player.advance(steps).unwrap();
        player.turn();
        assert_eq!(player.digest(), home, "{}, {options:?}", scene.name);
    }
}

#[test]
fn golden_digests_of_the_plate_on_every_executor() {
    check(0);
}

#[test]
fn golden_digests_of_the_column_on_every_executor() {
    check(1);
}

#[test]
fn golden_digests_of_the_rings_on_every_executor() {
    check(2);
}

#[test]
fn golden_digests_of_the_cantilever_on_every_executor() {
    check(3);
}

/// With the paper's support, penalty and time step: its Fig. 3 has 5e-6.
#[test]
fn the_plate_keeps_its_energy_over_a_period_and_is_unrung() {
    let set = [
        "particle_spacing=1e-3",
        "support=3.0",
        "solid.penalty=10",
        "time_step=3.618e-9",
        "output.rows=2000",
    ];
    let (outcome, rows) = run(scene("beryllium-plate", &set), fastest(2));
    assert_eq!(outcome.reversed_exactly, Some(true));
    assert!(outcome.momentum.exactly_constant);
    let error = outcome.energy.max_error / rows[0].energy("kinetic");
    println!("energy error {error:e}");
    assert!(error < permitted::ENERGY_OF_THE_PLATE, "{error:e}");
    // It has rung: half a period away the plate is at rest, and bent.
    let least = rows.iter().fold(1.0, |least: f64, row| {
        least.min(row.energy("kinetic") / rows[0].energy("kinetic"))
    });
    assert!(least < 0.1, "{least}");
    assert_same_way_back(&rows);
}

/// The same plate with the integrator of the paper: as accurate, and not undone.
#[test]
fn the_papers_integrator_is_as_accurate_and_does_not_return() {
    let set = |model: &str| {
        vec![
            "particle_spacing=1e-3".to_owned(),
            "turnaround=3e-6".to_owned(),
            format!("model={model}"),
        ]
    };
    let [ours, paper] = ["solid", "solid-midpoint"].map(|model| {
        let set = set(model);
        let set: Vec<&str> = set.iter().map(String::as_str).collect();
        run(scene("beryllium-plate", &set), fastest(2))
    });
    assert_eq!(ours.0.reversed_exactly, Some(true));
    assert_eq!(paper.0.reversed_exactly, Some(false));
    // It is symmetric in time, so it comes back up to rounding.
    let away = paper.0.max_return_error_m.unwrap();
    assert!(
        away > 0.0 && away < permitted::RETURN_OF_THE_MIDPOINT,
        "{away:e}"
    );
    let [a, b] = [ours, paper].map(|(outcome, _)| outcome.energy.max_error);
    assert!(
        (a / b - 1.0).abs() < permitted::INTEGRATORS_OF_A_SOLID,
        "{a} {b}"
    );
}

/// In floating point the same run does not return: the control experiment.
#[test]
fn in_floating_point_a_solid_does_not_return() {
    let set = ["particle_spacing=1e-3", "turnaround=3e-6"];
    let options = loschmidt_tests::program::float(fastest(2));
    let (outcome, _) = run(scene("beryllium-plate", &set), options);
    assert_eq!(outcome.reversed_exactly, Some(false));
}

/// A saved state goes on with another executor as if nothing had happened.
#[test]
fn a_saved_solid_goes_on() {
    let (scene, steps, digests) = golden(0);
    let mut first = player(scene.clone(), serial());
    first.advance(steps / 2).unwrap();
    let saved = first.save();
    let mut second = player(scene, fastest(2));
    let (position, arrow) = (first.position(), first.arrow());
    second.restore(&saved, position, arrow).unwrap();
    second.advance(steps - steps / 2).unwrap();
    assert_eq!(second.digest().to_string(), digests[1]);
}

/// A state that names a body that does not exist is followed without a panic.
#[test]
fn a_foreign_body_is_no_panic() {
    let (scene, ..) = golden(0);
    let mut player = player(scene, serial());
    let mut saved = player.save();
    let body = saved.fields.iter_mut().find(|field| field.name == "body");
    let words = &mut body.expect("a field of that name").words;
    [words[0], words[1], words[2]] = [99, -1, i64::MAX];
    let (position, arrow) = (player.position(), player.arrow());
    player.restore(&saved, position, arrow).unwrap();
    let _ = player.advance(2).and_then(|()| player.measure());
}

/// A clamp never moves, and the beam swings about its static deflection.
#[test]
fn the_clamp_of_the_cantilever_stands_still() {
    let set = ["particle_spacing=0.004", "turnaround=0.02"];
    let scene = scene("cantilever", &set);
    let initial = scene.initial_state().unwrap();
    let [beam, clamp] = [initial.parts[0], initial.parts[1]];
    assert!(!beam.held && clamp.held && beam.body == clamp.body);
    let mut player = player(scene, fastest(2));
    let home = player.save();
    player.advance(500).unwrap();
    let there = player.save();
    let moved = |n: usize| home.position(n) != there.position(n);
    let particles = initial.fluid.len();
    assert!((clamp.first as usize..particles).all(|n| !moved(n)));
    assert!((0..clamp.first as usize).all(moved));
}
