//! Reduced Boltzmann entropy, with its equilibrium values.

use super::ink::Ink;
use super::numbers::Scale;
use super::plot::{DotCurve, DotPlot};
use super::{Piece, write};
use loschmidt_runner::run::Row;
use loschmidt_viewer::plot::whole_numbers;
use loschmidt_viewer::session::StagedScene;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

/// Draws the entropy.
pub fn render(stage: &StagedScene, area: Rect, buf: &mut Buffer, ink: &Ink) {
    if area.height < 3 {
        return;
    }
    let row = stage.row();
    let theme = &ink.theme;
    // As many decimals whatever the number.
    let nats = Scale::of(1.0, "");
    let value = |x: Option<f64>| x.map_or("–".to_owned(), |s| nats.fixed(s, 4));
    let strong = ink.time().add_modifier(Modifier::BOLD);
    let mut pieces: Vec<Piece> = vec![
        ("ENTROPY  ".to_owned(), ink.bold()),
        ("S ".to_owned(), ink.time()),
        (nats.fixed(row.entropy, 5), strong),
    ];
    let of_energy = value(row.equilibrium_entropy_of_energy);
    let of_fit = value(row.equilibrium_entropy_of_fit);
    let equilibrium: [Piece; 2] = if area.width >= 66 {
        [
            (
                format!("   in equilibrium {of_energy} by energy"),
                ink.of_colour(theme.second),
            ),
            (format!("  {of_fit} by fit"), ink.of_colour(theme.third)),
        ]
    } else {
        [
            (format!("  eq {of_energy}"), ink.of_colour(theme.second)),
            (format!(" fit {of_fit}"), ink.of_colour(theme.third)),
        ]
    };
    pieces.extend(equilibrium);
    write(buf, area, area.y, &pieces);

    let curves = [
        DotCurve {
            colour: theme.forward,
            back: Some(theme.backward),
            value: &|row: &Row| Some(row.entropy),
            reference: false,
        },
        DotCurve {
            colour: theme.second,
            back: None,
            value: &|row: &Row| row.equilibrium_entropy_of_energy,
            reference: true,
        },
        DotCurve {
            colour: theme.third,
            back: None,
            value: &|row: &Row| row.equilibrium_entropy_of_fit,
            reference: true,
        },
    ];
    let rows = || stage.track.out().iter().chain(stage.track.back());
    let low = rows().fold(f64::INFINITY, |m, row| m.min(row.entropy));
    let high = rows().fold(f64::NEG_INFINITY, |m, row| {
        m.max(row.entropy)
            .max(row.equilibrium_entropy_of_energy.unwrap_or(row.entropy))
    });
    let plot = Rect::new(area.x, area.y + 1, area.width, area.height - 1);
    DotPlot {
        track: &stage.track,
        curves: &curves,
        range: whole_numbers([low, high]),
        span: stage.span() as f64 * stage.opened.scene.time_step(),
        now: stage.status.time,
    }
    .render(plot, buf, ink);
}
