//! A chart: series in a frame with two axes.

use super::axis::Axis;
use super::legend::Legend;
use super::marks::Series;
use super::{open, text};
use std::fmt::Write;

/// A chart.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Above it; may be empty.
    pub title: String,
    /// With unit.
    pub x_label: String,
    /// With unit.
    pub y_label: String,
    /// Logarithmic x axis.
    pub x_log: bool,
    /// Logarithmic y axis.
    pub y_log: bool,
    /// Bounds of x; `None`: those of the points.
    pub x_range: Option<[f64; 2]>,
    /// Bounds of y.
    pub y_range: Option<[f64; 2]>,
    /// What is drawn, the first below the others.
    pub series: Vec<Series>,
}

/// Width and height of a chart without a legend below it, pixels.
const SIZE: [f64; 2] = [560.0, 370.0];
/// The frame: left, top, right, bottom.
const FRAME: [f64; 4] = [76.0, 32.0, SIZE[0] - 16.0, SIZE[1] - 48.0];

impl Chart {
    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let [left, top, right, bottom] = FRAME;
        let all = |k: usize| {
            let points = self.series.iter().flat_map(|s| &s.points);
            points.map(move |p| p[k])
        };
        let x = Axis::new(all(0), self.x_range, self.x_log, [left, right]);
        let y = Axis::new(all(1), self.y_range, self.y_log, [bottom, top]);
        let covered: Vec<[f64; 2]> = self.series.iter().flat_map(|s| s.covered(&x, &y)).collect();
        let legend = Legend::new(&self.series, FRAME, &covered);
        let mut out = open("chart", SIZE[0], SIZE[1] + legend.height_below());
        grid(&mut out, &x, &y);
        for series in &self.series {
            series.draw(&mut out, &x, &y);
        }
        self.frame(&mut out, &x, &y);
        legend.draw(&mut out, [left - 8.0, SIZE[1] - 4.0]);
        out += "</svg>\n";
        out
    }

    /// The frame with its ticks, over what is drawn, and the labels.
    fn frame(&self, out: &mut String, x: &Axis, y: &Axis) {
        let [left, top, right, bottom] = FRAME;
        let mut ticks = String::new();
        for tick in x.ticks() {
            let Some(p) = x.place(tick.value) else {
                continue;
            };
            let long = if tick.label.is_some() { 6 } else { 3 };
            let _ = write!(ticks, "M{p:.1} {bottom}v-{long}M{p:.1} {top}v{long}");
            if let Some(label) = tick.label {
                let below = bottom + 17.0;
                let _ = writeln!(
                    out,
                    "<text x=\"{p:.1}\" y=\"{below:.1}\" text-anchor=\"middle\">{label}</text>"
                );
            }
        }
        for tick in y.ticks() {
            let Some(p) = y.place(tick.value) else {
                continue;
            };
            let long = if tick.label.is_some() { 6 } else { 3 };
            let _ = write!(ticks, "M{left} {p:.1}h{long}M{right} {p:.1}h-{long}");
            if let Some(label) = tick.label {
                let (beside, p) = (left - 7.0, p + 4.5);
                let _ = writeln!(
                    out,
                    "<text x=\"{beside:.1}\" y=\"{p:.1}\" text-anchor=\"end\">{label}</text>"
                );
            }
        }
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            out,
            "<path d=\"{ticks}\" stroke=\"#444\"/><rect x=\"{left}\" y=\"{top}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"#444\"/>"
        );
        self.labels(out, [x.exponent(), y.exponent()]);
    }

    fn labels(&self, out: &mut String, exponents: [i32; 2]) {
        let [left, top, right, bottom] = FRAME;
        let middle = 0.5 * (left + right);
        let _ = write!(
            out,
            "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(17 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n\
             <text x=\"{middle:.1}\" y=\"20\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\n",
            bottom + 39.0,
            text::content(&self.x_label),
            0.5 * (top + bottom),
            text::content(&self.y_label),
            text::content(&self.title)
        );
        let places = [(right, bottom + 39.0, "end"), (left, top - 6.0, "start")];
        for (exponent, (x, y, anchor)) in exponents.into_iter().zip(places) {
            if exponent != 0 {
                let _ = writeln!(
                    out,
                    "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">× {}</text>",
                    text::power(exponent)
                );
            }
        }
    }
}

/// Faint lines at the labels.
fn grid(out: &mut String, x: &Axis, y: &Axis) {
    let [left, top, right, bottom] = FRAME;
    let mut lines = String::new();
    for tick in x.ticks().iter().filter(|tick| tick.label.is_some()) {
        if let Some(p) = x.place(tick.value) {
            let _ = write!(lines, "M{p:.1} {top}V{bottom}");
        }
    }
    for tick in y.ticks().iter().filter(|tick| tick.label.is_some()) {
        if let Some(p) = y.place(tick.value) {
            let _ = write!(lines, "M{left} {p:.1}H{right}");
        }
    }
    let _ = writeln!(out, "<path d=\"{lines}\" stroke=\"#ebebeb\"/>");
}

#[cfg(test)]
mod tests {
    use super::super::{Style, is_chart, line, styled};
    use super::Chart;

    #[test]
    fn a_chart_draws_what_it_can_and_leaves_out_the_rest() {
        let points = [[0.0, 1.0], [1.0, f64::NAN], [2.0, -1.0], [3.0, 100.0]];
        let chart = Chart {
            title: "a < b & c".to_owned(),
            y_log: true,
            series: vec![
                styled("dots", 0, Style::Dots, points.into_iter()),
                line("line", 1, points.into_iter()),
            ],
            ..Chart::default()
        };
        let svg = chart.svg();
        // Two points can be shown, and one disc stands in the legend.
        assert_eq!(svg.matches("<circle").count(), 3);
        assert!(svg.contains("a &lt; b &amp; c"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert!(is_chart(&svg));
    }

    #[test]
    fn an_empty_chart_is_a_frame() {
        let svg = Chart::default().svg();
        assert!(svg.contains("<rect") && !svg.contains("NaN"));
    }

    #[test]
    fn a_legend_hides_no_curve_and_goes_below_where_it_would() {
        let flat = (0..100).map(|k| [f64::from(k), 0.0]);
        let height = |svg: &str| {
            let rest = svg.split_once(" height=\"").expect("a height").1;
            rest.split_once('"').expect("its end").0.to_owned()
        };
        let mut chart = Chart {
            y_range: Some([-1.0, 1.0]),
            series: vec![line("flat", 0, flat)],
            ..Chart::default()
        };
        assert_eq!(height(&chart.svg()), "370");
        let wild = (0..100).map(|k| [f64::from(k), if k % 2 == 0 { -0.99 } else { 0.99 }]);
        chart.series.push(line("everywhere", 1, wild));
        assert_eq!(height(&chart.svg()), "395");
    }
}
