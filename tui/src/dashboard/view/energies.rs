//! Energies: the numbers now, and the curves.

use super::ink::Ink;
use super::numbers::{Scale, quantity};
use super::plot::{DotCurve, DotPlot};
use super::{Piece, width};
use crate::brief::brief;
use loschmidt_runner::figures::number;
use loschmidt_runner::run::Row;
use loschmidt_runner::totals::total_for_people;
use loschmidt_viewer::Rgb;
use loschmidt_viewer::plot::steady;
use loschmidt_viewer::session::StagedScene;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;
use std::borrow::Cow;

/// An energy: its name, its colour, and its value in J.
type EnergyCurve = (Cow<'static, str>, Rgb, Box<dyn Fn(&Row) -> f64>);

/// Draws the energies.
pub fn render(stage: &StagedScene, area: Rect, buf: &mut Buffer, ink: &Ink) {
    if area.height < 3 {
        return;
    }
    let row = stage.row();
    let first = &stage.opened.first;
    let largest = first.total.abs().max(
        stage
            .track
            .out()
            .iter()
            .fold(0.0, |m, r| m.max(r.energy("kinetic"))),
    );
    let scale = Scale::of(largest, "J");
    let depth = if stage.home.dimension == 2 {
        " per m of depth"
    } else {
        ""
    };
    let title = format!("ENERGY / {}", scale.name());
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
    let parts = parts(row, ink);
    let long = area.width >= 60;
    let mut pieces: Vec<Vec<Piece>> = parts
        .iter()
        .map(|(name, colour, value)| {
            let name = if long { name } else { brief(name) };
            let style = ink.of_colour(*colour);
            vec![
                (format!("{name} "), style),
                (
                    scale.fixed(value(row), 4),
                    style.add_modifier(Modifier::BOLD),
                ),
            ]
        })
        .collect();
    let off = row.total - first.total;
    let released = stage.released();
    let mut relative = vec![("error ".to_owned(), ink.faint())];
    if released > 0.0 {
        relative.push((number(off / released, 2), ink.text()));
        if long {
            relative.push((" of the energy released".to_owned(), ink.faint()));
        }
    } else {
        relative.push((quantity(off, "J", 2), ink.text()));
    }
    pieces.push(relative);
    for (heading, value) in &row.totals {
        let (name, unit) = total_for_people(heading);
        pieces.push(vec![
            (format!("{name} "), ink.faint()),
            (quantity(*value, unit, 3), ink.text()),
        ]);
    }
    let used = flow(&pieces, row.totals.len(), area, buf);
    let top = area.y + 1 + used;
    let plot = Rect::new(area.x, top, area.width, area.bottom().saturating_sub(top));
    draw(stage, scale, &parts, plot, buf, ink);
}

/// The energies of a row and their sum. The kinetic one comes first, then that of gravity: they are
/// what moves most.
fn parts(row: &Row, ink: &Ink) -> Vec<EnergyCurve> {
    let theme = &ink.theme;
    let colours = [theme.forward, theme.second, theme.third, theme.faint];
    let mut kinds: Vec<_> = row.energies.iter().map(|(kind, _)| kind.clone()).collect();
    kinds.sort_by_key(|kind| match kind.as_ref() {
        "kinetic" => 0,
        "gravitational" => 1,
        _ => 2,
    });
    let kinds = kinds.into_iter().zip(colours.into_iter().cycle());
    let part = |(kind, colour): (Cow<'static, str>, Rgb)| -> EnergyCurve {
        let name = kind.clone();
        (name, colour, Box::new(move |row: &Row| row.energy(&kind)))
    };
    let total: EnergyCurve = ("total".into(), theme.text, Box::new(|row: &Row| row.total));
    kinds.map(part).chain([total]).collect()
}

/// Writes groups of pieces in rows below the title, a row more for each of these totals where there
/// is room; how many rows it took.
fn flow(groups: &[Vec<Piece>], totals: usize, area: Rect, buf: &mut Buffer) -> u16 {
    let most = if area.height >= 12 {
        3 + if area.height >= 16 { totals as u16 } else { 0 }
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
    scale: Scale,
    parts: &[EnergyCurve],
    area: Rect,
    buf: &mut Buffer,
    ink: &Ink,
) {
    let ends = |rows: &mut dyn Iterator<Item = &Row>| {
        let values = rows.flat_map(|row| parts.iter().map(move |(_, _, value)| value(row)));
        values.fold([0.0_f64; 2], |[low, high], x| [low.min(x), high.max(x)])
    };
    let first = ends(&mut std::iter::once(&stage.opened.first));
    let mut rows = stage.track.out().iter().chain(stage.track.back());
    let range = steady(first, ends(&mut rows));
    let values: Vec<_> = parts
        .iter()
        .map(|(_, colour, value)| (*colour, move |row: &Row| Some(scale.count(value(row)))))
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
        range: range.map(|x| scale.count(x)),
        span: stage.span() as f64 * stage.opened.scene.time_step(),
        now: stage.status.time,
    }
    .render(area, buf, ink);
}
