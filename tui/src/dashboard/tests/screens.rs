//! Whole screens at three sizes. Below the characters stands a hash of all colours, so that a
//! picture of the fluid is compared pixel by pixel.

use super::{Bench, screen, text};
use crate::dashboard::state::{DashboardState, Depth};
use loschmidt_core::digest::hash;
use loschmidt_runner::deck::Report;
use loschmidt_viewer::Key;
use loschmidt_viewer::session::{Message, Overlay};
use ratatui::buffer::Buffer;

const SIZES: [(u16, u16); 3] = [(200, 60), (100, 30), (60, 20)];

/// 200 particles, 2,000 steps out.
fn dam() -> Bench {
    Bench::open(
        "dam-break",
        &["particle_spacing=0.1", "output.rows=200"],
        SIZES[0],
    )
}

fn colours(buffer: &Buffer) -> String {
    let mut bytes = Vec::new();
    for cell in &buffer.content {
        bytes.extend(format!("{:?}{:?}{:?};", cell.fg, cell.bg, cell.modifier).bytes());
    }
    let hash = hash(&bytes);
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn assert_screens(name: &str, state: &mut DashboardState) {
    for size in SIZES {
        state.size = size;
        let buffer = screen(state);
        let shown = format!("{}colours {}\n", text(&buffer), colours(&buffer));
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path("../snapshots");
        settings.set_prepend_module_to_snapshot(false);
        settings.bind(|| {
            insta::assert_snapshot!(format!("{name}-{}x{}", size.0, size.1), shown);
        });
    }
}

/// What depends on the machine.
fn neutral(bench: &mut Bench) {
    let stage = bench.state.session.stage.as_mut().expect("a scene");
    stage.opened.options.threads = std::num::NonZeroUsize::MIN;
    stage.status.pace = 0.03;
    stage.status.keeps_up = true;
}

#[test]
fn running() {
    let mut bench = dam();
    bench.seek(1200);
    neutral(&mut bench);
    let stage = bench.state.session.stage.as_mut().expect("a scene");
    stage.status.playing = true;
    stage.status.steps_per_second = 60.0;
    assert_screens("running", &mut bench.state);
}

#[test]
fn reversed() {
    let mut bench = dam();
    bench.seek(1200);
    bench.key(Key::Char('r'));
    bench.until(|report| matches!(report, Report::Turned(_)));
    bench.seek(700);
    neutral(&mut bench);
    let stage = bench.state.session.stage.as_mut().expect("a scene");
    stage.status.playing = true;
    stage.status.steps_per_second = 60.0;
    assert_screens("reversed", &mut bench.state);
}

#[test]
fn returned() {
    let mut bench = dam();
    bench.seek(1200);
    bench.key(Key::Char('r'));
    bench.key(Key::Home);
    bench.shot_at(0);
    neutral(&mut bench);
    assert!(
        bench
            .state
            .session
            .banner
            .as_ref()
            .is_some_and(|a| a.comparison.is_exact())
    );
    assert_screens("returned", &mut bench.state);
}

#[test]
fn perturbed() {
    let mut bench = dam();
    bench.seek(1200);
    bench.key(Key::Char('r'));
    bench.key(Key::Char('b'));
    bench.key(Key::Home);
    bench.shot_at(0);
    neutral(&mut bench);
    assert!(
        bench
            .state
            .session
            .banner
            .as_ref()
            .is_some_and(|a| !a.comparison.is_exact())
    );
    assert_screens("perturbed", &mut bench.state);
}

#[test]
fn help() {
    let mut bench = dam();
    bench.seek(300);
    bench.key(Key::Char('?'));
    neutral(&mut bench);
    assert_eq!(bench.state.session.overlay, Overlay::Help);
    assert_screens("help", &mut bench.state);
}

#[test]
fn error() {
    let mut state = DashboardState::new(Depth::True, SIZES[0]);
    let why = "the scene needs about 3.2 TiB of memory and 20 GiB are available; \
               choose a larger particle_spacing";
    super::update(
        &mut state,
        Message::Report(0, Box::new(Report::Failed(why.to_owned()))),
    );
    assert_screens("error", &mut state);
}
