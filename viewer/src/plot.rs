//! Curves over physical time. On the way back time falls, and so the curve runs back over itself:
//! the way out is drawn thin, and the way back thick on top of it.

use crate::colour::{Rgb, Theme};
use crate::colouring::round_number;
use crate::history::{History, HistoryPoint};
use crate::raster::{Mask, Pixels, Rect};
use crate::text::{self, TextStyle, Weight};
use loschmidt_runner::figures::quantity;

/// A curve and what it is called.
pub struct HistoryCurve<'a> {
    /// Name, in the colour of the curve.
    pub name: &'a str,
    /// Its colour.
    pub colour: Rgb,
    /// The moments.
    pub history: &'a History,
    /// The number at a moment; none leaves a gap.
    pub value: &'a dyn Fn(&HistoryPoint) -> Option<f64>,
    /// A line to compare with, drawn faintly and without a mark at its end.
    pub reference: bool,
}

/// A plot: some curves with a common pair of axes.
pub struct Plot<'a> {
    /// What is plotted.
    pub title: &'a str,
    /// Its unit.
    pub unit: &'a str,
    /// The curves, the first one in front.
    pub curves: &'a [HistoryCurve<'a>],
    /// The numbers at the bottom and the top.
    pub range: [f64; 2],
    /// A number within the range that a faint line marks.
    pub mark: Option<MarkedValue>,
    /// The largest time, s.
    pub span: f64,
}

/// A number that a faint line marks.
pub struct MarkedValue {
    /// The number.
    pub value: f64,
    /// Its text.
    pub text: String,
    /// Whether the text stands at the left end of the line, or at the right one.
    pub left: bool,
}

impl Plot<'_> {
    /// Draws the plot into a rectangle; `em` is the size of its text in pixels.
    pub fn draw(&self, raster: &mut Pixels<'_>, rect: Rect, theme: &Theme, em: usize) {
        let style = TextStyle {
            size: em,
            weight: Weight::Medium,
            colour: theme.text,
        };
        let line = em + em / 2;
        if rect.height < 3 * line || rect.width < 4 * em {
            return;
        }
        self.names(raster, rect, &style);
        let axes = Rect::new(
            rect.x,
            rect.y + line,
            rect.width,
            rect.height.saturating_sub(line + line),
        );
        raster.fill(
            Rect::new(axes.x, axes.y + axes.height, axes.width, 1),
            theme.rule,
            255,
        );
        let faint = TextStyle {
            colour: theme.faint,
            ..style
        };
        let below = (rect.y + rect.height) as i64 - em as i64 / 3;
        text::write(raster, &faint, rect.x as f64, below, "0");
        let right = (rect.x + rect.width) as f64;
        let end = quantity(self.span, "s", 3);
        text::write_left_of(raster, &faint, right, below, &end);
        if rect.width > 12 * em {
            let middle = rect.x as f64 + 0.5 * rect.width as f64;
            text::write_around(raster, &faint, middle, below, "time");
        }
        self.mark(raster, axes, theme, &faint);
        for curve in self.curves.iter().rev() {
            self.curve(raster, axes, curve, theme, em);
        }
    }

    /// The line at the marked number, its text at one end.
    fn mark(&self, raster: &mut Pixels<'_>, axes: Rect, theme: &Theme, style: &TextStyle) {
        let Some(mark) = &self.mark else {
            return;
        };
        let [low, high] = self.range;
        let part = (mark.value - low) / (high - low).max(f64::MIN_POSITIVE);
        let y = axes.y + ((1.0 - part.clamp(0.0, 1.0)) * axes.height as f64) as usize;
        let text = text::width(style, &mark.text);
        let used = (text as usize + style.size / 2).min(axes.width);
        let start = if mark.left { axes.x + used } else { axes.x };
        let line = Rect::new(start, y, axes.width - used, 1);
        raster.fill(line, theme.rule, 160);
        let x = if mark.left {
            axes.x as f64
        } else {
            (axes.x + axes.width) as f64 - text
        };
        text::write(raster, style, x, (y + style.size / 3) as i64, &mark.text);
    }

    /// The title and, where there is room, the names of the curves in their colours.
    fn names(&self, raster: &mut Pixels<'_>, rect: Rect, style: &TextStyle) {
        let baseline = (rect.y + style.size) as i64;
        let title = if self.unit.is_empty() {
            self.title.to_owned()
        } else {
            format!("{} / {}", self.title, self.unit)
        };
        let bold = TextStyle {
            weight: Weight::SemiBold,
            ..*style
        };
        let room = rect.width as f64;
        let title = text::fitted(&bold, &title, room);
        let end = text::write(raster, &bold, rect.x as f64, baseline, &title);
        let gap = 0.7 * style.size as f64;
        let mut right = (rect.x + rect.width) as f64;
        for curve in self.curves.iter().rev().filter(|c| !c.name.is_empty()) {
            let width = text::width(style, curve.name);
            if right - width < end + gap {
                break;
            }
            let style = TextStyle {
                colour: curve.colour,
                ..*style
            };
            text::write_left_of(raster, &style, right, baseline, curve.name);
            right -= width + gap;
        }
    }

    fn curve(
        &self,
        raster: &mut Pixels<'_>,
        axes: Rect,
        curve: &HistoryCurve<'_>,
        theme: &Theme,
        em: usize,
    ) {
        let [low, high] = self.range;
        let place = |point: &HistoryPoint| {
            let value = (curve.value)(point)?;
            let part = (value - low) / (high - low).max(f64::MIN_POSITIVE);
            let x = point.time / self.span.max(f64::MIN_POSITIVE);
            part.is_finite().then(|| {
                [
                    axes.x as f64 + x * (axes.width as f64 - 1.0) + 0.5,
                    axes.y as f64
                        + (1.0 - part.clamp(-0.02, 1.02)) * (axes.height as f64 - 1.0)
                        + 0.5,
                ]
            })
        };
        let points = curve.history.points();
        let turn = points.partition_point(|point| !point.way_back);
        let thin = (em as f64 / 10.0).max(1.0);
        // The way back begins where the way out ended.
        let (out, back) = (&points[..turn], &points[turn.saturating_sub(1)..]);
        let returned = turn < points.len();
        let room = Rect::new(
            axes.x.saturating_sub(em),
            axes.y.saturating_sub(em / 2),
            axes.width + 2 * em,
            axes.height + em,
        )
        .clipped(raster.width(), raster.height());
        let draw = |raster: &mut Pixels<'_>, points: &[HistoryPoint], width: f64, alpha: u8| {
            let mut mask = Mask::new(room);
            let mut last: Option<[f64; 2]> = None;
            for (n, point) in points.iter().enumerate() {
                let here = place(point);
                if let (Some(a), Some(b)) = (last, here) {
                    // Points within a fraction of a pixel add nothing.
                    let near = (a[0] - b[0]).abs() < 0.4 && (a[1] - b[1]).abs() < 0.4;
                    if near && n + 1 < points.len() {
                        continue;
                    }
                    mask.line(a, b, width);
                }
                last = here;
            }
            mask.paint(raster, curve.colour, alpha);
        };
        let weights = match (curve.reference, returned) {
            (true, _) => [110, 110],
            (false, true) => [120, 255],
            (false, false) => [255, 255],
        };
        draw(raster, out, thin, weights[0]);
        if returned {
            let width = if curve.reference { thin } else { 2.0 * thin };
            draw(raster, back, width, weights[1]);
        }
        if let (Some(end), false) = (points.last().and_then(place), curve.reference) {
            let mut mask = Mask::new(room);
            mask.line(end, end, 5.0 * thin);
            mask.paint(raster, theme.panel, 255);
            let mut mask = Mask::new(room);
            mask.line(end, end, 3.6 * thin);
            mask.paint(raster, curve.colour, 255);
        }
    }
}

/// Energies of a run: the kinetic, the potential one of gravity, and the total.
pub fn energy(raster: &mut Pixels<'_>, rect: Rect, history: &History, theme: &Theme, em: usize) {
    let points = history.points();
    let largest = points
        .iter()
        .flat_map(|p| [p.kinetic, p.potential, p.total])
        .fold(0.0, f64::max);
    let lowest = points
        .iter()
        .flat_map(|p| [p.potential, p.total])
        .fold(0.0, f64::min);
    let curve = |name, colour, value| HistoryCurve {
        name,
        colour,
        history,
        value,
        reference: false,
    };
    let total = |p: &HistoryPoint| Some(p.total);
    let kinetic = |p: &HistoryPoint| Some(p.kinetic);
    let potential = |p: &HistoryPoint| Some(p.potential);
    let lifts = points.iter().any(|p| p.potential != 0.0);
    let mut curves = vec![curve("kinetic", theme.forward, &kinetic)];
    if lifts {
        curves.push(curve("potential", theme.second, &potential));
    }
    curves.push(curve("total", theme.faint, &total));
    let first = points.first().map_or([0.0; 2], |p| {
        [
            p.potential.min(p.total),
            p.kinetic.max(p.potential).max(p.total),
        ]
    });
    let half = round_number(0.5 * largest);
    Plot {
        title: "energy",
        unit: "",
        curves: &curves,
        range: steady(first, [lowest, largest]),
        // At the left the curves are far from the middle.
        mark: Some(MarkedValue {
            value: half,
            text: quantity(half, "J", 3),
            left: true,
        }),
        span: history.span(),
    }
    .draw(raster, rect, theme, em);
}

/// Ends of an axis that rests: those of what is known at the first moment, and beyond it, where later
/// moments go farther, the next of a few round numbers. Zero is on the axis.
#[must_use]
pub fn steady(first: [f64; 2], seen: [f64; 2]) -> [f64; 2] {
    let size = first.iter().chain(&seen).map(|x| x.abs());
    let size = size.fold(0.0, f64::max);
    if size == 0.0 {
        return [0.0, 1.0];
    }
    let end = |first: f64, seen: f64| {
        let room = 1.04 * first;
        if seen <= room { room } else { at_least(seen) }
    };
    let low = -end((-first[0]).max(0.0), (-seen[0]).max(0.0));
    let high = end(first[1].max(0.0), seen[1].max(0.0));
    // A hair below zero is no reason for an axis below zero.
    let low = if -low < 1e-9 * size { 0.0 } else { low };
    [low, if high < 1e-9 * size { 0.0 } else { high }]
}

/// The least of 1, 1.5, 2, 3, 5 and 7 times a power of ten that is not below `x`.
fn at_least(x: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(x)));
    let steps = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|step| *step >= x).unwrap_or(x)
}

/// Ends of an axis of entropies: even whole numbers, so that it rests while the curve grows.
#[must_use]
pub fn whole_numbers([low, high]: [f64; 2]) -> [f64; 2] {
    if low > high {
        return [0.0, 1.0];
    }
    let even = |x: f64| 2.0 * (0.5 * x).floor();
    [even(low - 0.3), -even(-high - 0.3)]
}

/// Entropies of one or two runs, with the equilibrium value of the first.
pub fn entropy(
    raster: &mut Pixels<'_>,
    rect: Rect,
    runs: &[(&str, &History)],
    theme: &Theme,
    em: usize,
) {
    let Some((_, first)) = runs.first() else {
        return;
    };
    let value = |p: &HistoryPoint| Some(p.entropy);
    let balance = |p: &HistoryPoint| p.equilibrium;
    let colours = [theme.forward, theme.backward, theme.second, theme.third];
    let mut curves: Vec<HistoryCurve<'_>> = runs
        .iter()
        .zip(colours)
        .map(|((name, history), colour)| HistoryCurve {
            name: if runs.len() > 1 { name } else { "" },
            colour,
            history,
            value: &value,
            reference: false,
        })
        .collect();
    curves.push(HistoryCurve {
        name: if runs.len() > 1 { "" } else { "equilibrium" },
        colour: theme.faint,
        history: first,
        value: &balance,
        reference: true,
    });
    let all = runs.iter().flat_map(|(_, history)| history.points());
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
        let top = p.equilibrium.map_or(p.entropy, |e| e.max(p.entropy));
        (low.min(p.entropy), high.max(top))
    });
    let [low, high] = whole_numbers([low, high]);
    Plot {
        title: "entropy",
        unit: "",
        curves: &curves,
        range: [low, high],
        mark: (low < 0.0 && high > 0.0).then(|| MarkedValue {
            value: 0.0,
            text: "0".to_owned(),
            left: false,
        }),
        span: first.span(),
    }
    .draw(raster, rect, theme, em);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_rest_while_curves_grow() {
        // Energy that was there at the start, and flows to and fro.
        let ranges: Vec<[f64; 2]> = (0..100)
            .map(|n| steady([0.0, 9810.0], [0.0, 9810.0 * f64::from(n) / 99.0]))
            .collect();
        assert!(ranges.iter().all(|range| *range == ranges[0]), "{ranges:?}");
        // Energy that comes from outside, over four decades: a few steps for each.
        let mut ends: Vec<f64> = (1..4000)
            .map(|n| steady([0.0, 0.0], [0.0, libm::pow(10.0, f64::from(n) / 1000.0)])[1])
            .collect();
        assert!(ends.is_sorted());
        ends.dedup();
        assert!((20..30).contains(&ends.len()), "{ends:?}");
        assert_eq!(steady([-5.0, 0.0], [-5.0, 0.0]), [-5.2, 0.0]);
        assert_eq!(steady([0.0; 2], [0.0; 2]), [0.0, 1.0]);
        assert_eq!(whole_numbers([-1.2, 3.9]), [-2.0, 6.0]);
        assert_eq!(
            whole_numbers([f64::INFINITY, f64::NEG_INFINITY]),
            [0.0, 1.0]
        );
    }
}
