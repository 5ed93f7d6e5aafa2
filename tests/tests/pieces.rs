//! How steps are grouped, and what is given back in between, changes no bit and no fault.

use loschmidt_core::Fault;
use loschmidt_runner::scene::{InitialState, Scene};
use loschmidt_runner::{ExecutorKind, Options, Player};
use loschmidt_tests::generator::Generator;
use loschmidt_tests::program::{scene, serial, threads};

fn fast() -> Options {
    Options {
        executor: ExecutorKind::Fast,
        ..threads(2)
    }
}

fn player(scene: &Scene, initial: &InitialState, options: Options) -> Player {
    Player::new(scene.clone(), initial.clone(), options).unwrap()
}

/// Velocities of up to `speed` along each axis.
fn stirred(scene: &Scene, seed: u64, speed: f64) -> InitialState {
    let mut initial = scene.initial_state().unwrap();
    let mut generator = Generator::new(seed);
    for v in &mut initial.fluid_velocity {
        for v in v.iter_mut().take(scene.dimension.axes()) {
            *v = speed * generator.signed();
        }
    }
    initial
}

#[test]
fn steps_at_once_are_those_taken_one_by_one() {
    for integrator in ["stormer-verlet", "pefrl", "suzuki"] {
        let set = format!("integrator={integrator}");
        for wall in ["conservative", "dummy"] {
            let set = ["particle_spacing=0.1", &set, &format!("wall_model={wall}")];
            let scene = scene("dam-break", &set);
            let initial = stirred(&scene, 7, 2.0);
            let mut reference = player(&scene, &initial, serial());
            for _ in 0..30 {
                reference.advance(1).unwrap();
            }
            for options in [serial(), fast()] {
                for pieces in [&[30][..], &[1, 29], &[13, 2, 15]] {
                    let mut player = player(&scene, &initial, options);
                    pieces.iter().for_each(|n| player.advance(*n).unwrap());
                    assert_eq!(player.digest(), reference.digest(), "{pieces:?} {set:?}");
                }
            }
        }
    }
}

#[test]
fn steps_at_once_end_with_the_fault_of_those_taken_one_by_one() {
    const STEPS: u64 = 400;
    let mut kinds = Vec::new();
    for integrator in ["stormer-verlet", "suzuki"] {
        for (seed, cfl) in (0..12).zip([1.0, 1.4, 1.7, 2.0].into_iter().cycle()) {
            let set = [
                "particle_spacing=0.1".to_owned(),
                format!("cfl={cfl}"),
                format!("integrator={integrator}"),
            ];
            let scene = scene("dam-break", &set.each_ref().map(String::as_str));
            let initial = stirred(&scene, seed, 20.0);
            let one_by_one: Result<(), Fault> = {
                let mut player = player(&scene, &initial, serial());
                (0..STEPS).try_for_each(|_| player.advance(1))
            };
            let kind = one_by_one.err().map(|fault| fault.kind);
            kinds.push(kind);
            for options in [serial(), fast()] {
                let mut player = player(&scene, &initial, options);
                assert_eq!(player.advance(STEPS), one_by_one, "{set:?}");
            }
        }
    }
    let ended = kinds.iter().flatten().count();
    assert!(ended > kinds.len() / 2, "{kinds:?}");
}

#[test]
fn memory_that_is_given_back_is_made_anew_with_the_same_bits() {
    for set in [
        &[][..],
        &["integrator=pefrl"],
        &["wall_model=dummy"],
        &["fluid.anti_clump_pressure=1e4"],
    ] {
        let scene = scene("dam-break", &[&["particle_spacing=0.04"][..], set].concat());
        let initial = stirred(&scene, 3, 1.0);
        let mut reference = player(&scene, &initial, serial());
        let mut player = player(&scene, &initial, fast());
        for _ in 0..6 {
            for player in [&mut reference, &mut player] {
                player.advance(3).unwrap();
            }
            assert_eq!(player.measure(), reference.measure());
            player.release();
            assert_eq!(player.frame(), reference.frame());
            assert_eq!(player.measure(), reference.measure());
            player.release();
            assert_eq!(player.digest(), reference.digest());
        }
    }
}
