//! What runs, where it is in time, and which way time runs.

use super::ink::Ink;
use super::numbers::{count, quantity, steps};
use super::{Piece, write, write_right};
use loschmidt_runner::{ArithmeticKind, Arrow};
use loschmidt_viewer::session::StagedScene;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

/// Draws the header.
pub fn render(stage: &StagedScene, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let scene = &stage.opened.scene;
    let options = &stage.opened.options;
    let status = &stage.status;
    let mut pieces: Vec<Piece> = vec![
        (" LOSCHMIDT ".to_owned(), ink.badge(ink.time_colour())),
        (format!("  {}  ", scene.name), ink.bold()),
        (
            format!("{} particles", count(stage.points.len() as u64)),
            ink.faint(),
        ),
    ];
    let float = status.arithmetic == ArithmeticKind::Float;
    pieces.push(if float {
        (" · floating point".to_owned(), ink.alarm())
    } else {
        (" · fixed point".to_owned(), ink.faint())
    });
    for text in [
        format!("spacing {}", quantity(scene.particle_spacing, "m", 3)),
        format!("c {}", quantity(scene.sound_speed(), "m/s", 3)),
        scene.integrator.word().to_owned(),
        scene.model.word().to_owned(),
        format!(
            "{} × {}",
            options.executor.name(),
            options.threads_at_work()
        ),
    ] {
        pieces.push((format!(" · {text}"), ink.faint()));
    }
    let end = write(buf, area, area.y, &pieces);
    if area.right().saturating_sub(end) > 8 {
        let help = [
            ("? ".to_owned(), ink.text()),
            ("help ".to_owned(), ink.faint()),
        ];
        write_right(buf, area, area.y, &help);
    }
    let row = area.bottom() - 1;
    write(buf, area, row, &clock(stage, area.width, ink));
    write_right(buf, area, row, &pace(stage, area.width, ink));
}

/// Time, steps and the arrow.
fn clock(stage: &StagedScene, columns: u16, ink: &Ink) -> Vec<Piece> {
    let status = &stage.status;
    let strong = ink.time().add_modifier(Modifier::BOLD);
    let unit = stage.opened.scene.time_unit();
    let mut pieces = vec![
        (format!(" t = {} ", unit.amount(status.time, 5)), strong),
        (format!(" step {}  ", steps(status.position)), ink.faint()),
    ];
    let moving = status.seek.is_some() || (status.playing && !status.at_start);
    let shaft = if columns >= 140 {
        "━━━━━━━━━━━━"
    } else {
        "━━━━"
    };
    let (arrow, words) = match stage.arrow() {
        Arrow::Forward => (format!("{shaft}▶"), "forward"),
        Arrow::Backward => (format!("◀{shaft}"), "time reversed"),
    };
    pieces.push((arrow, strong));
    pieces.push((format!("  {words}"), ink.time()));
    if !moving && columns >= 90 {
        pieces.push(("   ‖ paused".to_owned(), ink.text()));
    } else if !moving {
        pieces.push((" ‖".to_owned(), ink.text()));
    }
    pieces
}

/// How fast time runs.
fn pace(stage: &StagedScene, columns: u16, ink: &Ink) -> Vec<Piece> {
    let status = &stage.status;
    let dt = stage.opened.scene.time_step();
    let reached = status.steps_per_second * dt;
    let mut pieces = vec![(format!("{} ", quantity(status.pace, "s/s", 3)), ink.text())];
    if columns >= 80 && status.steps_per_second > 0.0 {
        let speed = count(status.steps_per_second.round() as u64);
        if status.keeps_up {
            pieces.push((format!(" {speed} steps/s "), ink.faint()));
        } else {
            let text = format!(" reached {}, {speed} steps/s ", quantity(reached, "s/s", 3));
            pieces.push((text, ink.of_colour(ink.theme.backward)));
        }
    }
    pieces
}
