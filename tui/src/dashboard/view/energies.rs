//! Energies: the numbers now, and the curves.

use super::ink::Ink;
use super::numbers::{energy_unit, error, fixed};
use super::plot::{DotCurve, DotPlot};
use super::{Piece, width};
use loschmidt_runner::run::Row;
use loschmidt_viewer::Rgb;
use loschmidt_viewer::session::StagedScene;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

/// An energy: its colour, and its value in J.
type Part = (Rgb, fn(&Row) -> f64);

/// Draws the energies.
pub fn render(stage: &StagedScene, area: Rect, buf: &mut Buffer, ink: &Ink) {
    if area.height < 3 {
        return;
    }
    let row = stage.row();
    let first = &stage.opened.first;
    let largest = first
        .total
        .abs()
        .max(stage.track.out().iter().fold(0.0, |m, r| m.max(r.kinetic)));
    let (unit, scale) = energy_unit(largest);
    let theme = &ink.theme;
    let depth = if stage.home.dimension == 2 {
        " per m of depth"
    } else {
        ""
    };
    let title = format!("ENERGY / {unit}");
    let mut x = buf
        .set_stringn(area.x, area.y, &title, area.width.into(), ink.bold())
        .0;
    if area.width >= 44 {
        x = buf
            .set_stringn(
                x,
                area.y,
                depth,
                area.right().saturating_sub(x).into(),
                ink.faint(),
            )
            .0;
    }
    let _ = x;
    type Named<'a> = (&'a str, &'a str, Rgb, fn(&Row) -> f64);
    let parts: [Named<'_>; 5] = [
        ("kinetic", "kin", theme.forward, |r| r.kinetic),
        ("gravitational", "grav", theme.second, |r| r.gravitational),
        ("internal", "int", theme.third, |r| r.internal),
        ("wall", "wall", theme.faint, |r| r.wall),
        ("total", "total", theme.text, |r| r.total),
    ];
    let long = area.width >= 60;
    let mut pieces: Vec<Vec<Piece>> = parts
        .iter()
        .map(|(name, brief, colour, value)| {
            let name = if long { name } else { brief };
            let style = ink.of_colour(*colour);
            vec![
                (format!("{name} "), style),
                (
                    fixed(value(row) / scale, 2),
                    style.add_modifier(Modifier::BOLD),
                ),
            ]
        })
        .collect();
    let off = row.total - first.total;
    let released = stage.released();
    let mut relative = vec![("error ".to_owned(), ink.faint())];
    if released > 0.0 {
        relative.push((error(off / released), ink.text()));
        if long {
            relative.push((" of the energy released".to_owned(), ink.faint()));
        }
    } else {
        relative.push((format!("{} J", error(off)), ink.text()));
    }
    pieces.push(relative);
    let used = flow(&pieces, area, buf);
    let top = area.y + 1 + used;
    let plot = Rect::new(area.x, top, area.width, area.bottom().saturating_sub(top));
    let curves = parts
        .each_ref()
        .map(|(_, _, colour, value)| (*colour, *value));
    draw(stage, scale, &curves, plot, buf, ink);
}

/// Writes groups of pieces in rows below the title; how many rows it took.
fn flow(groups: &[Vec<Piece>], area: Rect, buf: &mut Buffer) -> u16 {
    let most = if area.height >= 12 {
        3
    } else {
        (area.height / 3).min(2)
    };
    let (mut x, mut row) = (area.x, 0);
    for group in groups {
        let wide: u16 = group.iter().map(|(text, _)| width(text)).sum();
        if x > area.x && x + wide > area.right() {
            row += 1;
            x = area.x;
        }
        if row >= most || wide > area.width {
            break;
        }
        for (text, style) in group {
            x = buf
                .set_stringn(x, area.y + 1 + row, text, usize::from(area.width), *style)
                .0;
        }
        x += 3;
    }
    (row + 1).min(most)
}

fn draw(
    stage: &StagedScene,
    scale: f64,
    parts: &[Part; 5],
    area: Rect,
    buf: &mut Buffer,
    ink: &Ink,
) {
    let rows = || stage.track.out().iter().chain(stage.track.back());
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for row in rows() {
        for (_, value) in parts {
            low = low.min(value(row) / scale);
            high = high.max(value(row) / scale);
        }
    }
    if high - low <= 0.0 {
        high = low + 1.0;
    }
    let values: Vec<_> = parts
        .iter()
        .map(|(colour, value)| (*colour, move |row: &Row| Some(value(row) / scale)))
        .collect();
    let curves: Vec<DotCurve<'_>> = values
        .iter()
        .map(|(colour, value)| DotCurve {
            colour: *colour,
            value,
            back: None,
            reference: false,
        })
        .collect();
    DotPlot {
        track: &stage.track,
        curves: &curves,
        range: [low, high + 0.04 * (high - low)],
        span: stage.span() as f64 * stage.opened.scene.time_step(),
        now: stage.status.time,
    }
    .render(area, buf, ink);
}
