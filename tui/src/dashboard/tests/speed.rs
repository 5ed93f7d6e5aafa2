//! A key is answered within 50 ms at 80,000 particles, while the simulation runs on all processors.

use super::{Bench, screen};
use loschmidt_runner::deck::{Command, Report};
use loschmidt_viewer::Key;
use std::hint::black_box;
use std::time::{Duration, Instant};

#[test]
fn a_key_is_answered_within_50_ms_at_80_000_particles() {
    let mut bench = Bench::open("dam-break", &[], (200, 60));
    let stage = bench.state.session.stage.as_ref().expect("a scene");
    assert_eq!(stage.points.len(), 80_000);
    bench.deck.send(Command::Pace(1e3));
    let mut drawn = Vec::new();
    let mut heard = Vec::new();
    for _ in 0..9 {
        bench.until(|report| matches!(report, Report::Shot(_)));
        let pressed = Instant::now();
        bench.key(Key::Char('r'));
        black_box(screen(&bench.state));
        drawn.push(pressed.elapsed());
        bench.until(|report| matches!(report, Report::Turned(_)));
        heard.push(pressed.elapsed());
    }
    let median = |times: &mut Vec<Duration>| {
        times.sort();
        times[times.len() / 2]
    };
    let (drawn, heard) = (median(&mut drawn), median(&mut heard));
    println!("shown after {drawn:.1?}, turned after {heard:.1?}");
    assert!(drawn < Duration::from_millis(50), "{drawn:?}");
}
