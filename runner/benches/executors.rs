//! The plain reference against the fast executor, side by side in one run:
//!
//! ```text
//! cargo bench -p loschmidt-runner
//! ```
//!
//! A sample is ten steps of a dam break whose lattice has been disordered by up to a third of a
//! spacing, the same on every machine; divan counts particle steps, so its throughput is particles
//! times steps a second. Lattices flatter the plain traversal, whose branches they make predictable.

use divan::Bencher;
use divan::counter::ItemsCount;
use loschmidt_runner::fast::Backend;
use loschmidt_runner::scene::{Source, load};
use loschmidt_runner::{ExecutorKind, Options, Player};
use std::num::NonZeroUsize;

const STEPS: u64 = 10;
/// Particle spacings in m, for about 1,000, 5,000, 20,000 and 80,000 particles.
const SPACINGS: [&str; 4] = ["0.045", "0.02", "0.01", "0.005"];

fn main() {
    divan::main();
}

/// The dam break at this spacing, disordered.
fn player(spacing: &str, options: Options) -> Player {
    let source = Source::Catalogue("dam-break".to_owned());
    let set = [format!("particle_spacing={spacing}"), "cfl=0.05".to_owned()];
    let scene = load(&source, &set).expect("a scene of the catalogue");
    let mut initial = scene.initial_state().expect("particles");
    // SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
    let mut state = 0u64;
    let mut signed = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for x in &mut initial.fluid {
        x[0] += 0.3 * scene.particle_spacing * signed();
        x[1] += 0.3 * scene.particle_spacing * signed();
    }
    Player::new(scene, initial, options).expect("a simulation")
}

fn bench(bencher: Bencher<'_, '_>, spacing: &str, options: Options) {
    let mut player = player(spacing, options);
    let particles = player.home().id.len() as u64;
    bencher
        .counter(ItemsCount::new(particles * STEPS))
        .bench_local(|| player.advance(STEPS).expect("numbers in range"));
}

fn options(executor: ExecutorKind, threads: usize, backend: Backend) -> Options {
    Options {
        executor,
        backend,
        threads: NonZeroUsize::new(threads).expect("a thread"),
        ..Options::default()
    }
}

#[divan::bench(args = SPACINGS, sample_count = 10)]
fn serial(bencher: Bencher<'_, '_>, spacing: &str) {
    bench(
        bencher,
        spacing,
        options(ExecutorKind::Serial, 1, Backend::Baseline),
    );
}

#[divan::bench(args = SPACINGS, sample_count = 10)]
fn rayon_1_thread(bencher: Bencher<'_, '_>, spacing: &str) {
    bench(
        bencher,
        spacing,
        options(ExecutorKind::Rayon, 1, Backend::Baseline),
    );
}

#[divan::bench(args = SPACINGS, sample_count = 10)]
fn fast_baseline_1_thread(bencher: Bencher<'_, '_>, spacing: &str) {
    bench(
        bencher,
        spacing,
        options(ExecutorKind::Fast, 1, Backend::Baseline),
    );
}

#[divan::bench(args = SPACINGS, sample_count = 10)]
fn fast_1_thread(bencher: Bencher<'_, '_>, spacing: &str) {
    bench(
        bencher,
        spacing,
        options(ExecutorKind::Fast, 1, Backend::best()),
    );
}

#[divan::bench(args = SPACINGS, sample_count = 10)]
fn fast_2_threads(bencher: Bencher<'_, '_>, spacing: &str) {
    bench(
        bencher,
        spacing,
        options(ExecutorKind::Fast, 2, Backend::best()),
    );
}
