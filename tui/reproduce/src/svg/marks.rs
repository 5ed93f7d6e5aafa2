//! Series of points, and how they are drawn.

use super::axis::Axis;
use std::fmt::Write;

/// Colours of the series, in their order.
pub const COLOURS: [&str; 7] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000",
];

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Joined.
    Line,
    /// Joined by dashes.
    Dashed,
    /// Joined by dots, for a curve that others lie on.
    Dotted,
    /// Joined by dashes and dots.
    DashDotted,
    /// Joined by a broad pale line, for a curve that others lie on.
    Broad,
    /// A disc at each.
    Dots,
    /// Joined, with a disc at each.
    LineDots,
    /// A bar from zero, as wide as the distance of the points.
    Bars,
}

/// A series of points.
#[derive(Clone, Debug)]
pub struct Series {
    /// For the legend; empty for none.
    pub label: String,
    /// x and y; those that are not finite (or not positive on a logarithmic axis) are left out.
    pub points: Vec<[f64; 2]>,
    /// How they are drawn.
    pub style: Style,
    /// LegendPlace in [`COLOURS`].
    pub colour: usize,
}

/// A series that is drawn as a line.
#[must_use]
pub fn line(label: &str, colour: usize, points: impl Iterator<Item = [f64; 2]>) -> Series {
    styled(label, colour, Style::Line, points)
}

/// A series in any style.
#[must_use]
pub fn styled(
    label: &str,
    colour: usize,
    style: Style,
    points: impl Iterator<Item = [f64; 2]>,
) -> Series {
    Series {
        label: label.to_owned(),
        points: points.collect(),
        style,
        colour,
    }
}

impl Series {
    pub(super) fn colour(&self) -> &'static str {
        COLOURS[self.colour % COLOURS.len()]
    }

    fn places(&self, x: &Axis, y: &Axis) -> impl Iterator<Item = Option<[f64; 2]>> {
        let place = |p: &[f64; 2]| Some([x.place(p[0])?, y.place(p[1])?]);
        self.points.iter().map(place)
    }

    /// Pixels that the series covers, close enough to each other that no legend slips between.
    pub(super) fn covered(&self, x: &Axis, y: &Axis) -> Vec<[f64; 2]> {
        let places: Vec<Option<[f64; 2]>> = self.places(x, y).collect();
        let base = y.place(0.0);
        let mut out = Vec::new();
        for (k, place) in places.iter().enumerate() {
            let Some(here) = *place else { continue };
            let from = match self.style {
                Style::Dots => here,
                Style::Bars => [here[0], base.unwrap_or(here[1])],
                _ => k
                    .checked_sub(1)
                    .and_then(|before| places[before])
                    .unwrap_or(here),
            };
            let steps = ((here[0] - from[0]).abs().max((here[1] - from[1]).abs()) / 4.0) as usize;
            for n in 0..=steps {
                let t = n as f64 / steps.max(1) as f64;
                out.push([0, 1].map(|d| here[d] + t * (from[d] - here[d])));
            }
        }
        out
    }

    pub(super) fn draw(&self, out: &mut String, x: &Axis, y: &Axis) {
        if self.style == Style::Bars {
            self.draw_bars(out, x, y);
            return;
        }
        let colour = self.colour();
        if self.style != Style::Dots {
            let mut path = String::new();
            let mut pen = 'M';
            for place in self.places(x, y) {
                match place {
                    Some([px, py]) => {
                        let _ = write!(path, "{pen}{px:.1} {py:.1}");
                        pen = 'L';
                    }
                    None => pen = 'M',
                }
            }
            let _ = writeln!(
                out,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-linejoin=\"round\"{}/>",
                self.stroke()
            );
        }
        if matches!(self.style, Style::Dots | Style::LineDots) {
            for [px, py] in self.places(x, y).flatten() {
                let _ = write!(
                    out,
                    "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.4\" fill=\"{colour}\"/>"
                );
            }
            out.push('\n');
        }
    }

    fn draw_bars(&self, out: &mut String, x: &Axis, y: &Axis) {
        let width = match &self.points[..] {
            [a, b, ..] => b[0] - a[0],
            _ => 1.0,
        };
        let colour = self.colour();
        for p in &self.points {
            let ends = (x.place(p[0] - 0.5 * width), x.place(p[0] + 0.5 * width));
            if let ((Some(a), Some(b)), Some(top), Some(base)) = (ends, y.place(p[1]), y.place(0.0))
            {
                let _ = write!(
                    out,
                    "<rect x=\"{a:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{colour}\" fill-opacity=\"0.5\"/>",
                    b - a,
                    base - top
                );
            }
        }
        out.push('\n');
    }

    /// Width and pattern of the line: no two styles are alike, in black and white either.
    fn stroke(&self) -> &'static str {
        match self.style {
            Style::Dashed => " stroke-width=\"1.6\" stroke-dasharray=\"6 4\"",
            Style::Dotted => {
                " stroke-width=\"2.4\" stroke-linecap=\"round\" stroke-dasharray=\"0.1 5\""
            }
            Style::DashDotted => " stroke-width=\"1.6\" stroke-dasharray=\"9 3 2 3\"",
            Style::Broad => " stroke-width=\"5\" stroke-opacity=\"0.4\"",
            Style::Line | Style::LineDots | Style::Dots | Style::Bars => " stroke-width=\"1.6\"",
        }
    }

    /// What stands for the series in a legend, from this pixel to the right, 22 wide.
    pub(super) fn sample(&self, x: f64, y: f64) -> String {
        let colour = self.colour();
        let disc = format!(
            "<circle cx=\"{:.1}\" cy=\"{y:.1}\" r=\"3.4\" fill=\"{colour}\"/>",
            x + 11.0
        );
        let stroke = format!(
            "<path d=\"M{x:.1} {y:.1}h22\" stroke=\"{colour}\"{}/>",
            self.stroke()
        );
        match self.style {
            Style::Dots => disc,
            Style::LineDots => stroke + &disc,
            Style::Bars => format!(
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"22\" height=\"10\" fill=\"{colour}\" fill-opacity=\"0.5\"/>",
                y - 5.0
            ),
            Style::Line | Style::Dashed | Style::Dotted | Style::DashDotted | Style::Broad => {
                stroke
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_told_apart_without_colours() {
        let styles = [
            Style::Line,
            Style::Dashed,
            Style::Dotted,
            Style::DashDotted,
            Style::Broad,
        ];
        let strokes = styles.map(|style| styled("", 0, style, std::iter::empty()).stroke());
        for (n, stroke) in strokes.iter().enumerate() {
            assert!(!strokes[..n].contains(stroke), "{stroke}");
        }
    }
}
