//! The speed histogram with the fitted Maxwell–Boltzmann curve and its temperature.

use super::dots::Dots;
use super::ink::{Ink, colour};
use super::numbers::short;
use super::{Piece, width, write};
use loschmidt_core::observe::{BINS, SpeedHistogram};
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
                format!("kT/m = {} m²/s²", short(t)),
                ink.of_colour(ink.theme.third),
            ));
        }
        None => pieces.push(("at rest".to_owned(), ink.faint())),
    }
    write(buf, area, area.y, &pieces);
    let axes = Rect::new(area.x, area.y + 1, area.width, area.height - 2);
    let histogram = &moment.histogram;
    let shown = bins_shown(histogram, fit);
    let largest = shown.iter().fold(0.0_f64, |m, &(f, _)| m.max(f));
    // Heights are divided by it.
    let top = largest.max(f64::MIN_POSITIVE);
    bars(&shown, top, axes, buf, ink);
    if let Some(t) = fit {
        let end = shown.len() as f64 * histogram.bin_width;
        curve(histogram, t, end, top, axes, buf, ink);
    }
    for x in axes.left()..axes.right() {
        buf[(x, axes.bottom())].set_char('─').set_style(ink.rule());
    }
    let end = format!(" {} m/s", short(shown.len() as f64 * histogram.bin_width));
    buf.set_string(axes.x, axes.bottom(), "0 ", ink.faint());
    let x = axes.right().saturating_sub(width(&end));
    buf.set_string(x, axes.bottom(), end, ink.faint());
}

/// Densities and midpoints of the bins up to the fastest particles that can be seen: the axis ends
/// after one, two or three fifths of the bins, or after all of them.
fn bins_shown(histogram: &SpeedHistogram, fit: Option<f64>) -> Vec<(f64, f64)> {
    let total: u64 = histogram.counts.iter().map(|&c| u64::from(c)).sum();
    let mut slower = 0;
    let mut last = 0;
    for (k, &count) in histogram.counts.iter().enumerate() {
        slower += u64::from(count);
        last = k;
        // All but one in 500.
        if slower * 500 >= total * 499 {
            break;
        }
    }
    if let Some(t) = fit {
        last = last.max((3.2 * t.sqrt() / histogram.bin_width) as usize);
    }
    let ends = [BINS / 5, BINS * 2 / 5, BINS * 3 / 5, BINS];
    let end = ends.into_iter().find(|&end| end > last).unwrap_or(BINS);
    (0..end)
        .map(|k| (histogram.density(k), histogram.midpoint(k)))
        .collect()
}

fn bars(bins: &[(f64, f64)], top: f64, axes: Rect, buf: &mut Buffer, ink: &Ink) {
    let full = 8 * u32::from(axes.height);
    let bar = ink.theme.forward.mix(ink.theme.background, 110);
    for column in 0..axes.width {
        let bin = usize::from(column) * bins.len() / usize::from(axes.width);
        let part = (bins[bin].0 / top).clamp(0.0, 1.0);
        let mut eighths = (part * f64::from(full)).round() as u32;
        for row in (axes.top()..axes.bottom()).rev() {
            let here = eighths.min(8);
            eighths -= here;
            if here == 0 {
                break;
            }
            buf[(axes.x + column, row)]
                .set_char(EIGHTHS[here as usize])
                .set_fg(colour(bar));
        }
    }
}

/// The curve over the bars: where it crosses a bar, the bar is the ground of the cell.
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
    let bar = colour(ink.theme.forward.mix(ink.theme.background, 110));
    let mut last = at(0.0);
    let mut over = Vec::new();
    for x in 1..width as usize {
        let here = at(x as f64);
        dots.line(last, here, ink.theme.third, true, false);
        let row = (here[1] / 4.0).max(0.0) as u16;
        over.push((axes.x + (x / 2) as u16, axes.y + row));
        last = here;
    }
    for (x, y) in over {
        if y < axes.bottom() && x < axes.right() && buf[(x, y)].symbol() == "█" {
            buf[(x, y)].set_bg(bar);
        }
    }
    dots.render(axes, buf);
}
