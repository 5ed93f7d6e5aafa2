//! The speed histogram with the fitted Maxwell–Boltzmann curve and its temperature.

use super::dots::Dots;
use super::ink::{Ink, colour};
use super::numbers::quantity;
use super::{Piece, width, write};
use loschmidt_core::observe::{BINS, SpeedHistogram};
use loschmidt_viewer::Rgb;
use loschmidt_viewer::session::StagedScene;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

/// Bars in eighths of a cell.
const EIGHTHS: [char; 9] = [' ', '▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// Draws the histogram.
pub fn render(stage: &StagedScene, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let Some(moment) = &stage.moment else { return };
    if area.height < 4 || area.width < 16 {
        return;
    }
    let fit = moment.row.fitted_temperature_m2_per_s2;
    let mut pieces: Vec<Piece> = vec![("SPEEDS  ".to_owned(), ink.bold())];
    match fit {
        Some(t) => {
            let name = if area.width >= 50 {
                "Maxwell–Boltzmann fit  "
            } else {
                "fit "
            };
            pieces.push((name.to_owned(), ink.of_colour(ink.theme.third)));
            pieces.push((
                format!("kT/m = {}", quantity(t, "m²/s²", 3)),
                ink.of_colour(ink.theme.third),
            ));
        }
        None => pieces.push(("at rest".to_owned(), ink.faint())),
    }
    write(buf, area, area.y, &pieces);
    let axes = Rect::new(area.x, area.y + 1, area.width, area.height - 2);
    let histogram = &moment.histogram;
    let end = stage.fastest;
    // The density at every column, by the bin under its middle.
    let density = |column: u16| {
        let speed = (f64::from(column) + 0.5) / f64::from(axes.width) * end;
        let bin = (speed / histogram.bin_width) as usize;
        if bin < BINS {
            histogram.density(bin)
        } else {
            0.0
        }
    };
    let bars: Vec<f64> = (0..axes.width).map(density).collect();
    // Heights are divided by it.
    let top = bars.iter().fold(f64::MIN_POSITIVE, |m, &f| m.max(f));
    draw_bars(&bars, top, axes, buf, ink);
    if let Some(t) = fit {
        curve(histogram, t, end, top, axes, buf, ink);
    }
    for x in axes.left()..axes.right() {
        buf[(x, axes.bottom())].set_char('─').set_style(ink.rule());
    }
    let end = format!(" {}", quantity(end, "m/s", 3));
    buf.set_string(axes.x, axes.bottom(), "0 ", ink.faint());
    let x = axes.right().saturating_sub(width(&end));
    buf.set_string(x, axes.bottom(), end, ink.faint());
}

fn bar_colour(ink: &Ink) -> Rgb {
    ink.theme.forward.mix(ink.theme.background, 110)
}

fn draw_bars(bars: &[f64], top: f64, axes: Rect, buf: &mut Buffer, ink: &Ink) {
    let full = 8 * u32::from(axes.height);
    for (x, density) in (axes.left()..axes.right()).zip(bars) {
        let part = (density / top).clamp(0.0, 1.0);
        let mut eighths = (part * f64::from(full)).round() as u32;
        for row in (axes.top()..axes.bottom()).rev() {
            let here = eighths.min(8);
            eighths -= here;
            if here == 0 {
                break;
            }
            buf[(x, row)]
                .set_char(EIGHTHS[here as usize])
                .set_fg(colour(bar_colour(ink)));
        }
    }
}

/// The curve over the bars. A cell has room for one of both: on a full bar the curve has the bar
/// for its ground, and where it runs along the end of a bar, that end takes its colour. So no bar
/// has a hole.
fn curve(
    histogram: &SpeedHistogram,
    temperature: f64,
    end: f64,
    top: f64,
    axes: Rect,
    buf: &mut Buffer,
    ink: &Ink,
) {
    let mut dots = Dots::new(axes.width, axes.height);
    let (width, height) = dots.size();
    let at = |x: f64| {
        let v = x / width * end;
        let f = histogram.maxwell_boltzmann(temperature, v);
        [x, (1.0 - f / top) * (height - 1.0)]
    };
    let mut last = at(0.0);
    for x in 1..width as usize {
        let here = at(x as f64);
        dots.line(last, here, ink.theme.third, true, false);
        last = here;
    }
    let bars: Vec<_> = axes.positions().map(|at| (at, buf[at].clone())).collect();
    dots.render(axes, buf);
    for (at, bar) in bars {
        let covered = buf[at].symbol() != bar.symbol();
        match bar.symbol() {
            " " => {}
            "█" if covered => {
                buf[at].set_bg(bar.fg);
            }
            _ if covered => {
                buf[at] = bar;
                buf[at].set_fg(colour(ink.theme.third));
            }
            _ => {}
        }
    }
}
