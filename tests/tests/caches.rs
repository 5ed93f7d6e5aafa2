//! What is remembered never shows: looking at a run, or forgetting, changes no bit of it.

use loschmidt_core::fields::IMPULSE;
use loschmidt_core::integrator::{INTEGRATORS, Integrator};
use loschmidt_core::number::{Arithmetic, Quantity, Word};
use loschmidt_core::schemes::wcsph::{DENSITY, FIXED_DENSITY, PRESSURE, Wall};
use loschmidt_core::{Clock, Fixed, Float, Model, Serial, Standard, Symplectic};
use loschmidt_runner::{ExecutorKind, Options, Player, Points};
use loschmidt_tests::program::{float, player, scene, serial, threads};
use loschmidt_tests::small::{Recipe, Scheme, Small, conservative, dam_2d, dam_3d, measure, words};

const STEPS: u64 = 30;

type Words = Vec<(u64, Vec<i64>)>;

/// Out and back, with something done between any two steps.
fn run<A: Arithmetic, M: Scheme<A, D>, const D: usize>(
    recipe: &Recipe<D>,
    mut between: impl FnMut(&mut Small<M, D, A>),
) -> Vec<Words> {
    let mut system = recipe.build::<A, M>();
    let mut all = Vec::new();
    for leg in 0..2 {
        for _ in 0..STEPS {
            between(&mut system);
            system.advance(1, &Serial).unwrap();
            all.push(words(&mut system));
        }
        between(&mut system);
        assert_eq!(system.parts().1.clock.step, (leg + 1) * STEPS);
        system.reverse();
    }
    all
}

/// Overwrites all of the scratch; what follows from the walls alone is computed anew.
fn forget<A: Arithmetic, M: Model<A, D>, const D: usize>(system: &mut Small<M, D, A>) {
    let (model, mut parts) = system.parts();
    let density = A::Word::from_word(0x0123_4567_89ab);
    let pressure = A::Word::of_real(0.1);
    for set in [&mut parts.particles, &mut parts.walls] {
        set.words_mut(DENSITY).fill(density);
        set.words_mut(FIXED_DENSITY).fill(density);
        set.words_mut(PRESSURE).fill(pressure);
        set.words_mut(IMPULSE).fill(A::Word::from_word(77));
    }
    parts.cells.start.fill(3);
    parts.cells.order.fill(5);
    parts.wall_cells.start.fill(3);
    parts.wall_cells.order.fill(5);
    parts.walls.id.fill(9);
    model.place_walls(&mut parts, &Serial).unwrap();
}

fn check<A: Arithmetic, M: Scheme<A, D>, const D: usize>(recipe: &Recipe<D>) {
    let plain = run::<A, M, D>(recipe, |_| ());
    let measured = run::<A, M, D>(recipe, |system| {
        let once = measure(system);
        assert_eq!(once, measure(system));
    });
    assert!(plain == measured, "measuring changed the run");
    let mut step = 0;
    let sometimes = run::<A, M, D>(recipe, |system| {
        step += 1;
        if step % 3 == 0 {
            let _ = measure(system);
        }
    });
    assert!(plain == sometimes, "measuring now and then changed the run");
    let forgetful = run::<A, M, D>(recipe, |system| forget(system));
    assert!(plain == forgetful, "rebuilding the scratch changed the run");
    let resumed = run::<A, M, D>(recipe, |system| {
        let (model, mut parts) = system.parts();
        *parts.clock = Clock {
            step: parts.clock.step,
            initialised: true,
        };
        model.place_walls(&mut parts, &Serial).unwrap();
    });
    assert!(plain == resumed, "placing the walls anew changed the run");
    let both = run::<A, M, D>(recipe, |system| {
        forget(system);
        let _ = measure(system);
    });
    assert!(plain == both, "measuring after rebuilding changed the run");
}

fn everywhere<const D: usize>(dam: impl Fn(Wall, &'static Integrator) -> Recipe<D>) {
    for wall in [conservative(), Wall::Dummy] {
        for integrator in INTEGRATORS {
            let recipe = dam(wall, integrator).stirred(6, 1.0);
            check::<Fixed, Symplectic<Fixed, D>, D>(&recipe);
        }
        let recipe = dam(wall, INTEGRATORS[0]).stirred(6, 0.1);
        check::<Fixed, Standard<Fixed, D>, D>(&recipe);
        check::<Float, Symplectic<Float, D>, D>(&recipe);
    }
}

#[test]
fn measuring_and_rebuilding_change_no_bit_of_a_run_in_the_plane() {
    everywhere(dam_2d);
}

#[test]
fn measuring_and_rebuilding_change_no_bit_of_a_run_in_space() {
    everywhere(dam_3d);
}

#[test]
fn diagnostics_on_the_way_back_have_the_bits_of_the_way_out() {
    for integrator in INTEGRATORS {
        for wall in [conservative(), Wall::Dummy] {
            let mut system = dam_2d(wall, integrator).stirred(6, 1.0).symplectic();
            let mut out = Vec::new();
            for _ in 0..STEPS {
                out.push(measure(&mut system));
                system.advance(1, &Serial).unwrap();
            }
            system.reverse();
            while let Some(there) = out.pop() {
                system.advance(1, &Serial).unwrap();
                let back = measure(&mut system);
                assert_eq!(back.energies, there.energies);
                assert_eq!(back.histogram, there.histogram);
                assert_eq!(back.momentum_quanta, there.momentum_quanta.map(|p| -p));
                assert_eq!(
                    back.angular_momentum_quanta,
                    there.angular_momentum_quanta.map(|l| -l)
                );
            }
        }
    }
}

#[test]
fn initialising_again_gives_the_same_constants() {
    let mut system = dam_3d(Wall::Dummy, INTEGRATORS[0]).symplectic();
    let first = system.digest();
    forget(&mut system);
    system.initialise(&Serial).unwrap();
    assert_eq!(system.digest(), first);
}

/// What a player remembers between steps: looked at, given back, put back.
#[test]
fn nothing_that_is_done_between_steps_changes_a_bit_of_a_players_run() {
    type Between = fn(&mut Player);
    let deeds: [(&str, Between); 5] = [
        ("measured", |player| {
            let once = player.measure();
            assert_eq!(once, player.measure());
        }),
        ("looked at", |player| {
            let mut points = Points::default();
            player.points(&mut points).unwrap();
            assert_eq!(points.len(), player.frame().unwrap().id.len());
        }),
        ("memory given back", |player| player.release()),
        ("measured, and memory given back", |player| {
            let _ = player.measure();
            player.release();
        }),
        ("put back", |player| {
            let (saved, position, arrow) = (player.save(), player.position(), player.arrow());
            player.restore(&saved, position, arrow).unwrap();
        }),
    ];
    let fast = Options {
        executor: ExecutorKind::Fast,
        ..threads(2)
    };
    for set in [
        "wall_model=conservative",
        "wall_model=dummy",
        "integrator=pefrl",
    ] {
        let scene = scene("dam-break", &["particle_spacing=0.1", set]);
        for options in [serial(), fast, float(fast)] {
            let run = |between: Between| {
                let mut player = player(scene.clone(), options);
                let mut digests = Vec::new();
                for _ in 0..2 {
                    for _ in 0..20 {
                        between(&mut player);
                        player.advance(2).unwrap();
                        digests.push(player.digest());
                    }
                    player.turn();
                }
                digests
            };
            let plain = run(|_| ());
            assert_ne!(plain[0], plain[19]);
            for (deed, between) in deeds {
                assert!(run(between) == plain, "{deed}: {set} {options:?}");
            }
        }
    }
}
