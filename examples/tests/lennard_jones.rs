//! The rooms are open: a model that no file of the workspace knows by name runs out and back
//! through everything that water runs through.

#[path = "../lennard_jones.rs"]
#[allow(dead_code)]
mod gas;

use loschmidt_runner::run::RunError;
use loschmidt_runner::scene::{Dimension, Scene, Source, load};
use loschmidt_runner::{ArithmeticKind, ExecutorKind, Options, Player, Run};
use loschmidt_viewer::movie::{Movie, MovieStyle, Stored};
use std::sync::atomic::{AtomicBool, Ordering};

fn scene(set: &[&str]) -> Scene {
    gas::make_known();
    let source = Source::Text {
        name: "gas.toml".to_owned(),
        text: gas::SCENE.to_owned(),
    };
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    load(&source, &set).expect("a scene")
}

fn player(scene: &Scene, executor: ExecutorKind) -> Player {
    let options = Options {
        executor,
        ..Options::default()
    };
    let initial = scene.initial_state().expect("particles");
    Player::new(scene.clone(), initial, options).expect("a simulation")
}

#[test]
fn a_gas_of_ones_own_returns_to_its_first_bit_with_every_executor() {
    let scene = scene(&[]);
    let mut ends = Vec::new();
    for executor in ExecutorKind::ALL {
        let mut player = player(&scene, executor);
        let first = player.measure().expect("energies");
        player.advance(500).expect("in range");
        ends.push(player.digest());
        let far = player.measure().expect("energies");
        assert!(far.histogram.entropy() > first.histogram.entropy() + 1.0);
        player.turn();
        player.advance(500).expect("in range");
        assert!(player.compare_with_home().is_exact(), "{executor:?}");
    }
    assert!(ends.windows(2).all(|pair| pair[0] == pair[1]), "{ends:?}");
}

#[test]
fn its_energy_error_falls_with_the_square_of_the_time_step() {
    // A force that did not belong to the energy would leave an error of its own.
    let error = |cfl: &str, steps: u64| {
        let mut player = player(&scene(&[cfl]), ExecutorKind::Fast);
        let first = player.measure().expect("energies").energies.total();
        player.advance(steps).expect("in range");
        let energies = player.measure().expect("energies").energies;
        assert!(energies.get("wall") < 0.0 && energies.get("pair") < 0.0);
        (energies.total() - first).abs() / energies.get("kinetic")
    };
    let coarse = error("cfl=0.01", 100);
    let fine = error("cfl=0.005", 200);
    assert!(coarse < 1e-3 && fine < 0.5 * coarse, "{coarse} {fine}");
}

#[test]
fn a_run_of_it_is_interrupted_resumed_finished_and_drawn() {
    let place = tempfile::tempdir().expect("a directory");
    let out = place.path().join("gas");
    let scene = scene(&["turnaround=1.0", "output.frames=4", "output.rows=40"]);
    let options = Options::default();
    let mut run = Run::start(scene, options, Some((&out, false))).expect("a run");
    let stop = AtomicBool::new(false);
    let interrupted = run.execute(|_| stop.store(true, Ordering::Relaxed), &stop);
    assert!(matches!(interrupted, Err(RunError::Interrupted { .. })));
    drop(run);
    let mut run = Run::resume(&out, |_| options).expect("the run");
    let outcome = run
        .execute(|_| {}, &AtomicBool::new(false))
        .expect("an end");
    assert_eq!(outcome.reversed_exactly, Some(true));
    assert_eq!(outcome.model, "lennard-jones");
    let series = std::fs::read_to_string(out.join("series.csv")).expect("a series");
    let header = series.lines().next().expect("a header");
    assert!(
        header.contains(",kinetic_J,pair_J,wall_J,total_J,"),
        "{header}"
    );
    let stored = Stored::open(&out).expect("frames");
    let style = MovieStyle {
        size: (320, 180),
        pictures: 3,
        ..MovieStyle::default()
    };
    let identity = stored.identity();
    let path = place.path().join("movie");
    let mut movie = Movie::create(&path, false, style, "gas", &identity).expect("a movie");
    movie
        .render(&stored, |_| {}, &AtomicBool::new(false))
        .expect("pictures");
    let pictures: Vec<_> = movie.pictures().collect();
    assert!(movie.is_finished() && pictures.len() == 3);
    assert!(pictures.iter().all(|path| path.is_file()), "{pictures:?}");
}

#[test]
fn a_misspelt_model_is_told_the_names_that_this_program_knows() {
    gas::make_known();
    let text = gas::SCENE.replace("lennard-jones", "lenard-jones");
    let name = "gas.toml".to_owned();
    let error = load(&Source::Text { name, text }, &[]).expect_err("no such model");
    let text = error.to_string();
    assert!(text.contains("did you mean \"lennard-jones\"?"), "{text}");
}

#[test]
fn what_the_gas_is_not_written_for_is_refused() {
    let scene = scene(&[]);
    let initial = scene.initial_state().expect("particles");
    let options = Options {
        arithmetic: ArithmeticKind::Float,
        ..Options::default()
    };
    let error = Player::new(scene.clone(), initial.clone(), options)
        .err()
        .expect("no gas of floats");
    let text = error.to_string();
    assert_eq!(
        text,
        "the model `lennard-jones` is not written for this arithmetic"
    );
    let mut space = scene;
    space.dimension = Dimension::Three;
    let error = Player::new(space, initial, Options::default())
        .err()
        .expect("no gas in space");
    let text = error.to_string();
    assert_eq!(
        text,
        "the model `lennard-jones` is not written for this dimension"
    );
}
