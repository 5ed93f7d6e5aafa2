//! What a picture costs: the paper's dam break, 80,000 particles, in 720 rows.

use loschmidt_runner::scene::{load, resolve};
use loschmidt_runner::{Options, Player, Points};
use loschmidt_viewer::{Colouring, History, Home, Look, Pane, draw, field};

fn main() {
    divan::main();
}

/// The scene at home and after some steps.
fn dam(name: &str, spacing: &str, steps: u64) -> (Points, Home, History) {
    let source = resolve(name).expect("a scene of the catalogue");
    let scene = load(&source, &[format!("particle_spacing={spacing}")]).expect("a scene");
    let initial = scene.initial_state().expect("particles");
    let mut player = Player::new(scene.clone(), initial, Options::default()).expect("a player");
    let home = Home::new(&scene, &player.frame().expect("a frame"));
    player.advance(steps).expect("steps");
    let mut history = History::new(home.span);
    let row = loschmidt_runner::run::Row::measure(&mut player, 1).expect("a row");
    for _ in 0..1000 {
        history.push((&row).into());
    }
    let mut points = Points::default();
    player.points(&mut points).expect("points");
    (points, home, history)
}

/// The whole picture, by its width in pixels.
#[divan::bench(args = [640, 1280, 3840])]
fn picture(bencher: divan::Bencher<'_, '_>, width: usize) {
    let (points, home, history) = dam("dam-break", "0.005", 20);
    let look = Look::default();
    bencher.bench(|| {
        let panes = [Pane::new(&points, &history)];
        draw(&panes, &home, &look, width, width * 9 / 16)
    });
}

/// The particles alone, coloured by what takes longest.
#[divan::bench]
fn particles(bencher: divan::Bencher<'_, '_>) {
    let (points, home, _) = dam("dam-break", "0.005", 20);
    let look = Look {
        colouring: Colouring::Displacement,
        ..Look::default()
    };
    bencher.bench(|| field(&points, &home, &look, 1280, 720));
}

/// The dam break in space, 16,000 balls.
#[divan::bench(args = [640, 1280, 3840])]
fn space(bencher: divan::Bencher<'_, '_>, width: usize) {
    let (points, home, history) = dam("dam-break-3d", "0.025", 20);
    let look = Look::default();
    bencher.bench(|| {
        let panes = [Pane::new(&points, &history)];
        draw(&panes, &home, &look, width, width * 9 / 16)
    });
}
