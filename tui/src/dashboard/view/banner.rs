//! The start was reached: is everything as it was?

use super::ink::Ink;
use super::numbers::{count, quantity};
use super::overlays::{StyledLine, sheet};
use loschmidt_runner::ArithmeticKind;
use loschmidt_runner::deck::Arrival;
use loschmidt_viewer::session::because;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

/// Draws the banner over the field, or where that is too small over everything.
pub fn render(arrival: &Arrival, field: Rect, whole: Rect, buf: &mut Buffer, ink: &Ink) {
    let exact = arrival.comparison.is_exact();
    let lines = if exact {
        returned(arrival, ink)
    } else {
        missed(arrival, ink)
    };
    let colour = if exact {
        ink.success_colour()
    } else {
        ink.alarm_colour()
    };
    let fits = field.width >= 66 && usize::from(field.height) > lines.len() + 2;
    // In the upper part of the field, where it leaves the fluid in sight.
    let upper = Rect::new(field.x, field.y + 1, field.width, lines.len() as u16 + 2);
    let area = if fits { upper } else { whole };
    sheet("", &lines, Some(colour), area, buf, ink);
}

fn digests(arrival: &Arrival, ink: &Ink) -> [StyledLine; 2] {
    let line =
        |name: &str, digest: String| vec![(format!("{name}  "), ink.faint()), (digest, ink.text())];
    [
        line("digest at the start", arrival.comparison.home.to_string()),
        line(
            "digest now         ",
            arrival.comparison.present.to_string(),
        ),
    ]
}

fn returned(arrival: &Arrival, ink: &Ink) -> Vec<StyledLine> {
    let strong = ink
        .of_colour(ink.success_colour())
        .add_modifier(Modifier::BOLD);
    let steps = count(arrival.farthest.unsigned_abs());
    let mut lines = vec![
        vec![("TIME CAME BACK: bit-identical".to_owned(), strong)],
        Vec::new(),
    ];
    lines.extend(digests(arrival, ink));
    lines.push(Vec::new());
    lines.push(vec![(
        format!("{steps} steps out, and back; every bit is as it was"),
        ink.text(),
    )]);
    lines.push(vec![(
        "r runs it again, any other key goes on".to_owned(),
        ink.faint(),
    )]);
    lines
}

fn missed(arrival: &Arrival, ink: &Ink) -> Vec<StyledLine> {
    let c = &arrival.comparison;
    let particles = if c.astray == 1 {
        "particle"
    } else {
        "particles"
    };
    let mut lines = vec![
        vec![("TIME DID NOT COME BACK".to_owned(), ink.alarm())],
        Vec::new(),
        vec![
            (
                format!("{} {particles}", count(c.astray as u64)),
                ink.bold(),
            ),
            (" astray, the farthest ".to_owned(), ink.text()),
            (quantity(c.error, "m", 3), ink.bold()),
            (" from home".to_owned(), ink.text()),
        ],
    ];
    for meddling in arrival.meddling.iter().rev().take(2).rev() {
        lines.push(vec![(because(meddling), ink.of_colour(ink.theme.backward))]);
    }
    if arrival.meddling.is_empty() && arrival.arithmetic == ArithmeticKind::Float {
        let why = "floating-point sums are rounded differently on the way back";
        lines.push(vec![(why.to_owned(), ink.of_colour(ink.theme.backward))]);
    }
    lines.push(Vec::new());
    lines.extend(digests(arrival, ink));
    lines.push(vec![("any key goes on".to_owned(), ink.faint())]);
    lines
}
