//! The player: going back is integrating back, to the last bit, or it is refused.

use loschmidt_core::{Digest, Reversibility};
use loschmidt_runner::player::PlayerError;
use loschmidt_runner::points::PointColumn;
use loschmidt_runner::{ArithmeticKind, Arrow, Player, Points};
use loschmidt_tests::program::{fastest, float, player, scene, serial, threads};
use proptest::prelude::*;
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// 50 particles in the plane.
fn small() -> Player {
    player(scene("dam-break", &["particle_spacing=0.2"]), serial())
}

/// 200 particles of water, 2000 steps to a turnaround: long enough to be chaotic.
fn chaotic() -> Player {
    player(scene("dam-break", &["particle_spacing=0.1"]), fastest(2))
}
const CHAOTIC_STEPS: u64 = 2_000;

fn go_on(_: i64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The digest at a position, by going there from home in one sweep.
fn direct(position: i64) -> Digest {
    static KNOWN: Mutex<Option<HashMap<i64, Digest>>> = Mutex::new(None);
    let mut known = KNOWN.lock().expect("no panic");
    let known = known.get_or_insert_default();
    *known.entry(position).or_insert_with(|| {
        let mut player = small();
        if position < 0 {
            player.turn();
        }
        player.advance(position.unsigned_abs()).expect("in range");
        player.digest()
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]
    #[test]
    fn wherever_it_seeks_it_finds_what_the_direct_way_finds(
        targets in prop::collection::vec((-150i64..400, 1u64..200, any::<bool>()), 1..6),
    ) {
        let mut player = small();
        let mut farthest = 0;
        for (target, chunk, turn) in targets {
            if turn {
                player.turn();
            }
            let arrow = player.arrow();
            player.seek(target, chunk, go_on).expect("in range");
            farthest = farthest.max(target);
            prop_assert_eq!(player.position(), target);
            prop_assert_eq!(player.arrow(), arrow);
            prop_assert_eq!(player.farthest(), farthest);
            prop_assert_eq!(player.digest(), direct(target));
        }
        player.seek(0, 1_000, go_on).expect("in range");
        let back = player.compare_with_home();
        prop_assert!(back.is_exact());
        prop_assert_eq!((back.astray, back.error), (0, 0.0));
    }
}

#[test]
fn a_seek_is_a_seek_in_space_with_dummies_and_other_integrators() {
    let scenes: [(&str, &[&str]); 3] = [
        ("dam-break-3d", &["particle_spacing=0.2"]),
        (
            "dam-break",
            &[
                "particle_spacing=0.2",
                "wall_model=dummy",
                "integrator=pefrl",
            ],
        ),
        (
            "rotating-drop",
            &["particle_spacing=0.1", "integrator=suzuki"],
        ),
    ];
    for (name, set) in scenes {
        let new = || player(scene(name, set), serial());
        let mut direct = new();
        direct.advance(30).expect("in range");
        let mut other = new();
        for target in [80, 10, -20, 30] {
            other.seek(target, 7, go_on).expect("in range");
        }
        assert_eq!(other.digest(), direct.digest(), "{name} {set:?}");
        assert_eq!(
            other.frame().expect("a frame").position,
            direct.frame().expect("a frame").position
        );
    }
}

#[test]
fn to_turn_twice_is_to_do_nothing() {
    for options in [serial(), float(serial())] {
        for model in ["model=symplectic", "model=standard"] {
            let new = || {
                player(
                    scene("dam-break", &["particle_spacing=0.2", model]),
                    options,
                )
            };
            let (mut turned, mut plain) = (new(), new());
            for player in [&mut turned, &mut plain] {
                player.advance(100).expect("in range");
            }
            turned.turn();
            assert_eq!(turned.arrow(), Arrow::Backward);
            assert_ne!(turned.save(), plain.save());
            turned.turn();
            assert_eq!(turned.arrow(), Arrow::Forward);
            assert_eq!(turned.save(), plain.save());
            for player in [&mut turned, &mut plain] {
                player.advance(100).expect("in range");
            }
            assert_eq!(turned.save(), plain.save());
            assert_eq!(turned.digest(), plain.digest());
        }
    }
}

/// The points of a state in the order of the ids.
fn sorted(player: &mut Player) -> Points {
    let mut points = Points::default();
    player.points(&mut points).expect("in range");
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_unstable_by_key(|&place| points.id[place]);
    let of = |list: &Vec<f32>| match list.is_empty() {
        true => Vec::new(),
        false => order.iter().map(|&i| list[i]).collect(),
    };
    let columns = points.columns.iter().map(|column| PointColumn {
        measure: column.measure,
        values: of(&column.values),
    });
    let columns = columns.collect();
    Points {
        id: order.iter().map(|&i| points.id[i]).collect(),
        position: points.position.each_ref().map(of),
        speed: of(&points.speed),
        columns,
        ..points
    }
}

#[test]
fn points_are_the_particles_of_the_frame_rounded_once() {
    // 5,000 particles in the plane: more than one part.
    let scenes = [
        ("dam-break", &["particle_spacing=0.02"][..]),
        ("dam-break-3d", &["particle_spacing=0.1"]),
    ];
    for (name, set) in scenes {
        for options in [threads(2), float(serial())] {
            let mut player = player(scene(name, set), options);
            player.advance(40).expect("in range");
            player.turn();
            player.advance(10).expect("in range");
            let frame = player.frame().expect("in range");
            assert_eq!(sorted(&mut player), Points::from(&frame), "{name}");
            assert!(frame.way_back && frame.step == 30 && frame.time > 0.0);
        }
    }
}

#[test]
fn looking_changes_nothing() {
    let (mut watched, mut alone) = (small(), small());
    for _ in 0..50 {
        watched.measure().expect("in range");
        watched.frame().expect("in range");
        watched.points(&mut Points::default()).expect("in range");
        watched.digest();
        watched.compare_with_home();
        let (state, position, arrow) = (watched.save(), watched.position(), watched.arrow());
        watched.restore(&state, position, arrow).expect("its own");
        watched.advance(3).expect("in range");
    }
    alone.advance(150).expect("in range");
    assert_eq!(watched.save(), alone.save());
}

#[test]
fn what_cannot_go_back_says_why_and_stays() {
    let floats = player(
        scene("dam-break", &["particle_spacing=0.2"]),
        float(serial()),
    );
    let set = ["particle_spacing=0.2", "model=standard"];
    let standard = player(scene("dam-break", &set), serial());
    let float_standard = player(scene("dam-break", &set), float(serial()));
    let cases = [
        (
            floats,
            Reversibility::UpToRounding,
            PlayerError::FloatingPoint,
        ),
        (
            standard,
            Reversibility::Irreversible,
            PlayerError::Irreversible,
        ),
        (
            float_standard,
            Reversibility::Irreversible,
            PlayerError::Irreversible,
        ),
    ];
    for (mut player, reversibility, reason) in cases {
        assert_eq!(player.reversibility(), reversibility);
        player.seek(20, 5, go_on).expect("forward it goes");
        let before = player.save();
        for target in [19, 0, -1] {
            assert_eq!(player.seek(target, 5, go_on), Err(reason));
            assert_eq!((player.position(), player.save()), (20, before.clone()));
            assert_eq!(player.arrow(), Arrow::Forward);
        }
        assert_eq!(player.seek(20, 5, go_on), Ok(()));
        // It may be turned by hand, and then there is no way to seek in either direction.
        player.turn();
        assert_eq!(player.seek(10, 5, go_on), Err(reason));
        assert_eq!(player.seek(30, 5, go_on), Err(reason));
    }
    assert_eq!(small().reversibility(), Reversibility::BitExact);
    assert_eq!(
        PlayerError::Irreversible.to_string(),
        "the scheme is not symmetric in time: it cannot be integrated backwards"
    );
    assert_eq!(
        PlayerError::FloatingPoint.to_string(),
        "floating-point arithmetic does not return to where it came from"
    );
}

#[test]
fn one_flipped_bit_at_the_turnaround_leads_astray() {
    let mut player = chaotic();
    player.advance(CHAOTIC_STEPS).expect("in range");
    player.flip_last_bit(0);
    player.turn();
    player.advance(CHAOTIC_STEPS).expect("in range");
    let back = player.compare_with_home();
    println!("{} of 200 astray, by up to {} m", back.astray, back.error);
    assert!(!back.is_exact());
    assert!(back.astray > 100);
    assert!(back.error > 0.1, "more than a spacing");
}

#[test]
fn one_flipped_bit_is_one_quantum_and_two_are_none() {
    let mut player = chaotic();
    player.advance(100).expect("in range");
    let before = player.digest();
    player.flip_last_bit(7);
    assert_ne!(player.digest(), before);
    player.flip_last_bit(7);
    assert_eq!(player.digest(), before);
    player.seek(0, 1_000, go_on).expect("in range");
    assert!(player.compare_with_home().is_exact());

    // Flipped at home, out and back: every bit returns, the flipped one flipped.
    player.flip_last_bit(7);
    player.seek(500, 1_000, go_on).expect("in range");
    player.seek(0, 1_000, go_on).expect("in range");
    let back = player.compare_with_home();
    assert!(!back.is_exact());
    assert_eq!(back.astray, 1);
    assert_eq!(back.error, player.home().scale.length_quantum());
    player.flip_last_bit(7);
    assert!(player.compare_with_home().is_exact());
}

#[test]
fn a_return_in_the_other_arithmetic_fails() {
    let mut player = chaotic();
    player.advance(CHAOTIC_STEPS).expect("in range");
    player
        .switch_arithmetic(ArithmeticKind::Float)
        .expect("built");
    assert_eq!(player.options().arithmetic, ArithmeticKind::Float);
    assert_eq!(player.steps_taken(), CHAOTIC_STEPS);
    player.turn();
    player.advance(CHAOTIC_STEPS).expect("in range");
    let back = player.compare_with_home();
    println!("{} of 200 astray, by up to {} m", back.astray, back.error);
    assert!(!back.is_exact());
    assert!(back.astray > 0);
    assert!(back.error > 0.1, "more than a spacing");
}

#[test]
fn to_switch_arithmetic_there_and_back_at_once_changes_no_bit() {
    for set in [
        &["particle_spacing=0.1"][..],
        &["particle_spacing=0.1", "wall_model=dummy"],
    ] {
        let mut player = player(scene("dam-break", set), serial());
        player.advance(300).expect("in range");
        player.turn();
        let before = (player.save(), player.digest());
        player
            .switch_arithmetic(ArithmeticKind::Float)
            .expect("built");
        assert_ne!(player.digest(), before.1, "a digest tells the arithmetic");
        assert_eq!(player.arrow(), Arrow::Backward);
        player
            .switch_arithmetic(ArithmeticKind::Fixed)
            .expect("built");
        assert_eq!((player.save(), player.digest()), before);
        player.advance(300).expect("in range");
        assert!(player.compare_with_home().is_exact());
    }
}

#[test]
fn a_seek_broken_off_leaves_the_player_where_it_says() {
    let mut player = small();
    player.advance(300).expect("in range");
    for arrow in [Arrow::Forward, Arrow::Backward] {
        assert_eq!(player.arrow(), arrow);
        for (target, chunk, stop, expected) in [
            (0, 70, 3, 90),
            (400, 25, 2, 140),
            (-50, 1_000, 1, -50),
            (300, 350, 1, 300),
        ] {
            let mut seen = Vec::new();
            let result = player.seek(target, chunk, |position| {
                seen.push(position);
                if seen.len() == stop {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            });
            assert_eq!(result, Ok(()));
            assert_eq!(seen.len(), stop);
            assert_eq!(seen.last(), Some(&expected));
            assert_eq!(player.position(), expected);
            assert_eq!(player.arrow(), arrow);
            assert_eq!(player.digest(), direct(expected));
        }
        player.seek(300, 1, go_on).expect("in range");
        assert_eq!(player.digest(), direct(300));
        player.turn();
    }
}

#[test]
fn a_state_of_another_scene_is_refused_and_nothing_changes() {
    let mut player = small();
    player.advance(10).expect("in range");
    let before = (player.save(), player.position());
    let others = [
        scene("dam-break", &["particle_spacing=0.1"]),
        scene("dam-break", &["particle_spacing=0.2", "wall_model=none"]),
        scene("dam-break", &["particle_spacing=0.2", "model=standard"]),
        scene("dam-break-3d", &["particle_spacing=0.25"]),
        scene(
            "dam-break",
            &["particle_spacing=0.2", "fluid.sound_speed=1000"],
        ),
    ];
    for other in others {
        let mut other = loschmidt_tests::program::player(other, serial());
        let foreign = other.save();
        assert!(player.restore(&foreign, 0, Arrow::Forward).is_err());
        assert_eq!((player.save(), player.position()), before);
    }
    let mut floats = loschmidt_tests::program::player(
        scene("dam-break", &["particle_spacing=0.2"]),
        float(serial()),
    );
    assert!(player.restore(&floats.save(), 0, Arrow::Forward).is_err());
    assert_eq!((player.save(), player.position()), before);
}
