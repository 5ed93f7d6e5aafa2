//! The names of the series: in a corner where nothing is, or else below the chart.

use super::marks::Series;
use super::text;
use std::fmt::Write;

/// Height of a row, pixels.
const ROW: f64 = 18.0;
/// From the left of a mark to its name.
const INDENT: f64 = 30.0;
/// Around the names, and from the legend to the frame.
const PAD: f64 = 7.0;

/// Where the legend stands.
pub(super) enum LegendPlace {
    /// There is none.
    Nowhere,
    /// With its upper left corner here.
    Inside([f64; 2]),
    /// Below the chart, in so many rows.
    Below(usize),
}

pub(super) struct Legend<'a> {
    named: Vec<&'a Series>,
    pub place: LegendPlace,
}

impl<'a> Legend<'a> {
    /// Finds a place within a frame (left, top, right, bottom) in which these pixels are covered.
    pub fn new(series: &'a [Series], frame: [f64; 4], covered: &[[f64; 2]]) -> Self {
        let named: Vec<&Series> = series.iter().filter(|s| !s.label.is_empty()).collect();
        let mut legend = Self {
            named,
            place: LegendPlace::Nowhere,
        };
        if legend.named.is_empty() {
            return legend;
        }
        let [w, h] = legend.size();
        let [left, top, right, bottom] = frame;
        let (near, far) = (left + PAD, right - PAD - w);
        let (high, low) = (top + PAD, bottom - PAD - h);
        let middle = 0.5 * (near + far);
        let corners = [
            [far, high],
            [near, high],
            [near, low],
            [far, low],
            [middle, high],
            [middle, low],
        ];
        let is_free = |corner: &[f64; 2]| {
            let [x, y] = *corner;
            let inside = |p: &[f64; 2]| {
                (x - 5.0..x + w + 5.0).contains(&p[0]) && (y - 5.0..y + h + 5.0).contains(&p[1])
            };
            far >= near && low >= high && !covered.iter().any(inside)
        };
        legend.place = match corners.into_iter().find(is_free) {
            Some(corner) => LegendPlace::Inside(corner),
            None => {
                let columns = (((right - left) / (w + PAD)) as usize).clamp(1, legend.named.len());
                LegendPlace::Below(legend.named.len().div_ceil(columns))
            }
        };
        legend
    }

    /// Width and height of the box.
    fn size(&self) -> [f64; 2] {
        let widest = self.named.iter().map(|s| text::width(&s.label));
        let w = INDENT + widest.fold(0.0, f64::max) + 2.0 * PAD;
        [w, ROW * self.named.len() as f64 + PAD]
    }

    /// Pixels it takes below the chart.
    pub fn height_below(&self) -> f64 {
        match self.place {
            LegendPlace::Below(rows) => ROW * rows as f64 + PAD,
            _ => 0.0,
        }
    }

    /// Draws it; `below` is the upper left corner of the room below the chart.
    pub fn draw(&self, out: &mut String, below: [f64; 2]) {
        let [w, h] = self.size();
        let (corner, rows) = match self.place {
            LegendPlace::Nowhere => return,
            LegendPlace::Inside([x, y]) => {
                let _ = writeln!(
                    out,
                    "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"white\" fill-opacity=\"0.9\" stroke=\"#bbb\"/>"
                );
                ([x, y], self.named.len())
            }
            LegendPlace::Below(rows) => (below, rows),
        };
        for (k, series) in self.named.iter().enumerate() {
            let x = corner[0] + PAD + (k / rows) as f64 * w;
            let y = corner[1] + 0.5 * (PAD + ROW) + (k % rows) as f64 * ROW;
            let _ = writeln!(
                out,
                "{}<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                series.sample(x, y),
                x + INDENT,
                y + 4.5,
                text::content(&series.label)
            );
        }
    }
}
