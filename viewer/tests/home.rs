//! Points for the other tests: small scenes, run for a few steps.

use loschmidt_runner::run::Row;
use loschmidt_runner::scene::{load, resolve};
use loschmidt_runner::{Options, Player, Points};
use loschmidt_viewer::{History, Home};

/// A scene of the catalogue after some steps, its home, and its history.
pub fn after(scene: &str, set: &[&str], steps: u64) -> (Points, Home, History) {
    let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
    let scene = load(&resolve(scene).expect("a scene"), &set).expect("a scene");
    let initial = scene.initial_state().expect("particles");
    let mut player = Player::new(scene.clone(), initial, Options::default()).expect("a player");
    let home = Home::new(&scene, &player.frame().expect("a frame"));
    let mut history = History::new(home.span);
    let mut note = |player: &mut Player, leg| {
        history.push((&Row::measure(player, leg).expect("a row")).into());
    };
    note(&mut player, 1);
    for _ in 0..10 {
        player.advance(steps / 10).expect("steps");
        note(&mut player, 1);
    }
    player.turn();
    for _ in 0..5 {
        player.advance(steps / 10).expect("steps");
        note(&mut player, 2);
    }
    let mut points = Points::default();
    player.points(&mut points).expect("points");
    (points, home, history)
}
