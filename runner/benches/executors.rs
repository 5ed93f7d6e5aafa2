//! The plain reference against the fast executor, side by side in one run:
//!
//! ```text
//! cargo bench -p loschmidt-runner --bench executors
//! ```
//!
//! A sample is ten steps of one of the [`states`]; divan counts particle steps, so its throughput
//! is particles times steps a second. `--bench table` prints the README's table.

mod states;

use divan::Bencher;
use divan::counter::ItemsCount;
use loschmidt_runner::fast::Backend;
use loschmidt_runner::{ExecutorKind, Options};
use states::{SIZES, Size, options, player, state};

const STEPS: u64 = 10;

fn main() {
    divan::main();
}

fn bench(bencher: Bencher<'_, '_>, size: Size, disordered: bool, options: Options) {
    let mut player = player(&state(size, disordered), options);
    let particles = player.home().id.len() as u64;
    bencher
        .counter(ItemsCount::new(particles * STEPS))
        .bench_local(|| player.advance(STEPS).expect("numbers in range"));
}

macro_rules! executors {
    ($($name:ident: $kind:ident, $threads:literal, $backend:expr;)*) => {
        mod disordered {
            use super::*;
            $(#[divan::bench(args = SIZES, sample_count = 10, sample_size = 1)]
            fn $name(bencher: Bencher<'_, '_>, size: Size) {
                bench(bencher, size, true, options(ExecutorKind::$kind, $threads, $backend));
            })*
        }
        mod near_lattice {
            use super::*;
            $(#[divan::bench(args = SIZES, sample_count = 10, sample_size = 1)]
            fn $name(bencher: Bencher<'_, '_>, size: Size) {
                bench(bencher, size, false, options(ExecutorKind::$kind, $threads, $backend));
            })*
        }
    };
}

executors! {
    serial: Serial, 1, Backend::Baseline;
    rayon_2_threads: Rayon, 2, Backend::Baseline;
    fast_baseline_1_thread: Fast, 1, Backend::Baseline;
    fast_1_thread: Fast, 1, Backend::best();
    fast_2_threads: Fast, 2, Backend::best();
}
