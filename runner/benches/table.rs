//! Prints the README's tables of speeds, that of the executors or that of the two arithmetics:
//!
//! ```text
//! cargo bench -p loschmidt-runner --bench table [-- [float] SIZE…]
//! ```
//!
//! Each column is nanoseconds of wall time for one particle and step. In every round each of the
//! executors runs the same number of steps in turn, from the same [`states`]; the least of the
//! rounds is kept, which on a shared machine is the one that was disturbed least.

mod states;

use loschmidt_runner::fast::Backend;
use loschmidt_runner::scene::{InitialState, Scene, Source, load};
use loschmidt_runner::{ArithmeticKind, ExecutorKind, Options, Player};
use states::{SIZES, Size, options, player, state};
use std::time::Instant;

const ROUNDS: usize = 5;
/// Particle steps of a fast executor in a round.
const WORK: f64 = 4e6;

/// Elastic bodies of ten thousand particles and more: three sums of 4, 9 and 2 words in the plane,
/// of 9, 17 and 3 in space, where water has two of 1 and 2 or 3. Helium has five of 8, 9, 4, 9 and 9
/// words, with friction eight, and as many again over walls.
const OTHERS: [Size; 4] = [
    Size {
        scene: "beryllium-plate",
        spacing: "2.5e-4",
        name: "2D plate 10k",
    },
    Size {
        scene: "twisting-column",
        spacing: "0.066",
        name: "3D column 20k",
    },
    Size {
        scene: "second-sound-steep",
        spacing: "1e-4",
        name: "2D helium 10k",
    },
    Size {
        scene: "fountain",
        spacing: "2e-4",
        name: "2D helium fountain",
    },
];

/// A scene of the catalogue at home.
fn body(size: Size) -> (Scene, InitialState) {
    let source = Source::Catalogue(size.scene.to_owned());
    let set = [format!("particle_spacing={}", size.spacing)];
    let scene = load(&source, &set).expect("a scene of the catalogue");
    let initial = scene.initial_state().expect("particles");
    (scene, initial)
}

fn main() {
    // cargo bench adds --bench.
    let only: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| a != "--bench")
        .collect();
    if only.first().is_some_and(|first| first == "float") {
        return arithmetics(&only[1..]);
    }
    let backends: Vec<Backend> = Backend::ALL
        .into_iter()
        .filter(|backend| backend.is_available())
        .collect();
    let names: Vec<&str> = backends.iter().map(|backend| backend.name()).collect();
    println!(
        "| state | particles | serial | {} | 2 threads | serial : 1 thread | 1 : 2 threads |",
        names.join(" | ")
    );
    println!(
        "|---|---:|---:|{}---:|---:|---:|",
        "---:|".repeat(names.len())
    );
    let wanted = |size: &Size| is_wanted(size, &only);
    for (disordered, kind) in [(true, "disordered"), (false, "near a lattice")] {
        for size in SIZES.into_iter().filter(wanted) {
            row(size, &state(size, disordered), kind, &backends);
        }
    }
    for size in OTHERS.into_iter().filter(wanted) {
        row(size, &body(size), "as it begins", &backends);
    }
}

fn is_wanted(size: &Size, only: &[String]) -> bool {
    only.is_empty() || only.iter().any(|name| size.name.contains(name.as_str()))
}

/// Floating point by the reference and by the fast executor, and fixed point by the latter, on one
/// thread.
fn arithmetics(only: &[String]) {
    println!(
        "| state | particles | float, serial | float | fixed | serial : float | float : fixed |"
    );
    println!("|---|---:|---:|---:|---:|---:|---:|");
    let of = |executor, arithmetic| Options {
        arithmetic,
        ..options(executor, 1, Backend::best())
    };
    let ways = [
        of(ExecutorKind::Serial, ArithmeticKind::Float),
        of(ExecutorKind::Fast, ArithmeticKind::Float),
        of(ExecutorKind::Fast, ArithmeticKind::Fixed),
    ];
    for size in SIZES.into_iter().filter(|size| is_wanted(size, only)) {
        let state = state(size, true);
        let [serial, float, fixed] = least(&mut ways.map(|way| player(&state, way)))[..] else {
            return;
        };
        println!(
            "| {size}, disordered | {} | {serial:.0} | {float:.0} | {fixed:.0} | {:.1} | {:.2} |",
            state.1.fluid.len(),
            serial / float,
            float / fixed
        );
    }
}

/// The least time of each player; the first is the reference.
fn least(players: &mut [Player]) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; players.len()];
    for _ in 0..ROUNDS {
        for (p, (player, least)) in players.iter_mut().zip(&mut least).enumerate() {
            // A layout lasts for a few steps: some of its lives. The reference has none.
            let steps = (WORK / player.home().id.len() as f64).clamp(14.0, 700.0) as u64;
            let steps = if p == 0 { steps.div_ceil(7) } else { steps };
            *least = least.min(nanoseconds(player, steps));
        }
    }
    least
}

fn row(size: Size, state: &(Scene, InitialState), kind: &str, backends: &[Backend]) {
    let fast = |threads, backend| player(state, options(ExecutorKind::Fast, threads, backend));
    let mut players = vec![player(
        state,
        options(ExecutorKind::Serial, 1, Backend::Baseline),
    )];
    players.extend(backends.iter().map(|backend| fast(1, *backend)));
    players.push(fast(2, Backend::best()));
    let particles = state.1.fluid.len();
    let least = least(&mut players);
    let serial = least[0];
    let one = least[1];
    let two = least[least.len() - 1];
    let cells: Vec<String> = least.iter().map(|ns| format!("{ns:.0}")).collect();
    println!(
        "| {size}, {kind} | {particles} | {} | {:.1} | {:.2} |",
        cells.join(" | "),
        serial / one,
        one / two
    );
}

fn nanoseconds(player: &mut Player, steps: u64) -> f64 {
    let particles = player.home().id.len() as f64;
    let before = Instant::now();
    player.advance(steps).expect("numbers in range");
    before.elapsed().as_secs_f64() * 1e9 / (particles * steps as f64)
}
