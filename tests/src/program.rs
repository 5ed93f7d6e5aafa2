//! Scenes, players and runs in a line each, as the tests of the runner need them.
//!
//! Everything here panics where it cannot go on: it is called by tests alone.

use loschmidt_runner::fast::Backend;
use loschmidt_runner::run::Row;
use loschmidt_runner::scene::{Scene, Source, load};
use loschmidt_runner::{ArithmeticKind, ExecutorKind, Options, Outcome, Player, Run, RunError};
use std::num::NonZeroUsize;
use std::sync::atomic::AtomicBool;

/// A scene of the catalogue with overrides.
#[must_use]
pub fn scene(name: &str, set: &[&str]) -> Scene {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    load(&Source::Catalogue(name.to_owned()), &set).unwrap_or_else(|e| panic!("{e}"))
}

/// A scene from its text, called `test`.
#[must_use]
pub fn scene_of(text: &str) -> Scene {
    let source = Source::Text {
        name: "test.toml".to_owned(),
        text: text.to_owned(),
    };
    load(&source, &[]).unwrap_or_else(|e| panic!("{e}"))
}

/// The reference executor.
#[must_use]
pub fn serial() -> Options {
    Options {
        executor: ExecutorKind::Serial,
        ..threads(1)
    }
}

/// The executor that computes, with the best instruction set, on so many threads: for what is long
/// and not about executors.
#[must_use]
pub fn fastest(n: usize) -> Options {
    Options {
        executor: ExecutorKind::Fast,
        ..threads(n)
    }
}

/// The plain parallel executor on so many threads: as slow as the reference.
#[must_use]
pub fn threads(n: usize) -> Options {
    Options {
        executor: ExecutorKind::Rayon,
        threads: NonZeroUsize::new(n).expect("a thread at least"),
        arithmetic: ArithmeticKind::Fixed,
        shuffle: None,
        ..Options::default()
    }
}

/// The fast executor with these instructions on so many threads.
#[must_use]
pub fn fast(backend: Backend, n: usize) -> Options {
    Options {
        executor: ExecutorKind::Fast,
        backend,
        ..threads(n)
    }
}

/// The instruction sets that this machine has.
pub fn backends() -> impl Iterator<Item = Backend> {
    Backend::ALL.into_iter().filter(|b| b.is_available())
}

/// The same options with the particles stored in another order.
#[must_use]
pub fn shuffled(options: Options, seed: u64) -> Options {
    Options {
        shuffle: Some(seed),
        ..options
    }
}

/// The same options in floating point.
#[must_use]
pub fn float(options: Options) -> Options {
    Options {
        arithmetic: ArithmeticKind::Float,
        ..options
    }
}

/// Every way to walk the particles that must not change a bit: the serial executor, the plain
/// parallel one on two threads, and the fast one with every instruction set of this machine on 1, 2
/// and 5 threads; the storage begins in the lattice order and in two others.
#[must_use]
pub fn every_way() -> Vec<Options> {
    let orders = [None, Some(1), Some(0xdead_beef)];
    let fast = backends().flat_map(|backend| [1, 2, 5].map(|n| fast(backend, n)));
    let plain = [serial(), shuffled(threads(2), 1)];
    plain
        .into_iter()
        .chain(
            fast.zip(orders.into_iter().cycle())
                .map(|(options, shuffle)| Options { shuffle, ..options }),
        )
        .collect()
}

/// A player at home.
#[must_use]
pub fn player(scene: Scene, options: Options) -> Player {
    let initial = scene.initial_state().unwrap_or_else(|e| panic!("{e}"));
    Player::new(scene, initial, options).unwrap_or_else(|e| panic!("{e}"))
}

/// A run that has been tried to its end, nothing written.
///
/// # Errors
/// The run's.
pub fn try_run(scene: Scene, options: Options) -> (Result<Outcome, RunError>, Vec<Row>) {
    let mut run = Run::start(scene, options, None).unwrap_or_else(|e| panic!("{e}"));
    let outcome = run.execute(|_| {}, &AtomicBool::new(false));
    (outcome, run.rows().to_vec())
}

/// A run that comes to its end: what it found, and its rows.
#[must_use]
pub fn run(scene: Scene, options: Options) -> (Outcome, Vec<Row>) {
    let (outcome, rows) = try_run(scene, options);
    (outcome.unwrap_or_else(|e| panic!("{e}")), rows)
}

/// Asserts that every row of the way back is that of the way out at the same place: all energies,
/// entropies, speeds and edges to the last bit, all momenta negated.
pub fn assert_same_way_back(rows: &[Row]) {
    let (out, back): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|row| row.leg == 1);
    assert!(!back.is_empty());
    for row in back {
        let there = out.iter().find(|o| o.position == row.position);
        let there = there.unwrap_or_else(|| panic!("no row at {} on the way out", row.position));
        let turned = Row {
            momentum_x_quanta: -row.momentum_x_quanta,
            momentum_y_quanta: -row.momentum_y_quanta,
            momentum_z_quanta: -row.momentum_z_quanta,
            angular_momentum_x: -row.angular_momentum_x,
            angular_momentum_y: -row.angular_momentum_y,
            angular_momentum_z: -row.angular_momentum_z,
            momentum: row.momentum.map(|p| p.map(|p| -p)),
            step: there.step,
            leg: there.leg,
            elapsed_s: there.elapsed_s,
            ..row.clone()
        };
        // Equality of floats: the only bits that it forgives are the sign of a zero momentum.
        assert_eq!(&turned, *there, "at position {}", row.position);
    }
}
