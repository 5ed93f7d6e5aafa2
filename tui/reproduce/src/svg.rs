//! Figures as SVG: charts with axes, and pictures of particles.
//!
//! Everything is text of a few kilobytes that any browser shows and any diff compares. Colours are
//! those of Okabe & Ito, which the colour-blind can tell apart; fields are in viridis.

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
    /// Place in [`COLOURS`].
    pub colour: usize,
}

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

/// Width and height of a chart, pixels.
const SIZE: [f64; 2] = [560.0, 360.0];
/// Left, right, top, bottom.
const MARGIN: [f64; 4] = [74.0, 14.0, 30.0, 46.0];

/// Text that may stand in XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// One axis: bounds and direction, linear or logarithmic.
struct Axis {
    low: f64,
    high: f64,
    log: bool,
    from: f64,
    to: f64,
}

impl Axis {
    fn new(
        values: impl Iterator<Item = f64>,
        range: Option<[f64; 2]>,
        log: bool,
        [from, to]: [f64; 2],
    ) -> Self {
        let scale = |x: f64| if log { libm::log10(x) } else { x };
        let [low, high] = range.map_or_else(
            || {
                let shown = values.filter(|x| x.is_finite() && (!log || *x > 0.0));
                let (low, high) = shown
                    .map(scale)
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
                        (l.min(x), h.max(x))
                    });
                let room = if high > low { 0.05 * (high - low) } else { 0.5 };
                if low.is_finite() {
                    [low - room, high + room]
                } else {
                    [0.0, 1.0]
                }
            },
            |range| range.map(scale),
        );
        Self {
            low,
            high,
            log,
            from,
            to,
        }
    }

    /// The pixel of a value; `None` where it cannot be shown.
    fn place(&self, x: f64) -> Option<f64> {
        let x = if self.log { libm::log10(x) } else { x };
        let t = (x - self.low) / (self.high - self.low);
        (x.is_finite() && (-0.02..=1.02).contains(&t))
            .then_some(self.from + t * (self.to - self.from))
    }

    /// Values with a tick and their labels.
    fn ticks(&self) -> Vec<(f64, String)> {
        if self.log {
            let (first, last) = (self.low.ceil() as i32, self.high.floor() as i32);
            if last - first >= 1 {
                let every = ((last - first) / 7 + 1).max(1);
                return (first..=last)
                    .filter(|e| e % every == 0)
                    .map(|e| (libm::pow(10.0, f64::from(e)), format!("1e{e}")))
                    .collect();
            }
            // Less than a decade: 1, 2 and 5 in each.
            let candidates = (first - 1..=last + 1)
                .flat_map(|e| [1.0, 2.0, 5.0].map(|d| d * libm::pow(10.0, f64::from(e))));
            return candidates
                .filter(|x| (self.low..=self.high).contains(&libm::log10(*x)))
                .map(|x| (x, short(x)))
                .collect();
        }
        let raw = (self.high - self.low) / 5.0;
        let decade = libm::pow(10.0, libm::floor(libm::log10(raw)));
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * decade)
            .into_iter()
            .find(|step| *step >= raw)
            .unwrap_or(raw);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last)
            .map(|k| (k as f64 * step, short(k as f64 * step)))
            .collect()
    }
}

/// A number in few characters.
fn short(x: f64) -> String {
    let magnitude = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&magnitude) {
        let text = format!("{x:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        let text = format!("{x:.2e}");
        text.replace(".00e", "e").replace("0e", "e")
    }
}

fn open(width: f64, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    )
}

impl Chart {
    /// The chart as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let [width, height] = SIZE;
        let [left, right, top, bottom] = MARGIN;
        let all = || self.series.iter().flat_map(|s| &s.points);
        let x = Axis::new(
            all().map(|p| p[0]),
            self.x_range,
            self.x_log,
            [left, width - right],
        );
        let y = Axis::new(
            all().map(|p| p[1]),
            self.y_range,
            self.y_log,
            [height - bottom, top],
        );
        let mut out = open(width, height);
        self.axes(&mut out, &x, &y);
        for series in &self.series {
            draw(&mut out, series, &x, &y);
        }
        self.legend(&mut out);
        out += "</svg>\n";
        out
    }

    fn axes(&self, out: &mut String, x: &Axis, y: &Axis) {
        let [width, height] = SIZE;
        let [left, right, top, bottom] = MARGIN;
        let (base, end) = (height - bottom, width - right);
        for (value, label) in x.ticks() {
            if let Some(p) = x.place(value) {
                let _ = writeln!(
                    out,
                    "<path d=\"M{p:.1} {top}V{base}\" stroke=\"#e4e4e4\"/><text x=\"{p:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{label}</text>",
                    base + 16.0
                );
            }
        }
        for (value, label) in y.ticks() {
            if let Some(p) = y.place(value) {
                let _ = writeln!(
                    out,
                    "<path d=\"M{left} {p:.1}H{end}\" stroke=\"#e4e4e4\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                    left - 6.0,
                    p + 4.0
                );
            }
        }
        let _ = write!(
            out,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#444\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n\
             <text x=\"{:.1}\" y=\"19\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\n",
            end - left,
            base - top,
            0.5 * (left + end),
            height - 10.0,
            escaped(&self.x_label),
            0.5 * (top + base),
            escaped(&self.y_label),
            0.5 * (left + end),
            escaped(&self.title)
        );
    }

    /// The names of the series, where fewest points are in the way.
    fn legend(&self, out: &mut String) {
        let named: Vec<&Series> = self.series.iter().filter(|s| !s.label.is_empty()).collect();
        if named.is_empty() {
            return;
        }
        let [width, height] = SIZE;
        let [left, right, top, bottom] = MARGIN;
        let longest = named.iter().map(|s| s.label.chars().count()).max();
        let w = 40.0 + 6.4 * longest.unwrap_or(0) as f64;
        let h = 8.0 + 17.0 * named.len() as f64;
        let corners = [
            [width - right - w - 8.0, top + 8.0],
            [left + 8.0, top + 8.0],
            [left + 8.0, height - bottom - h - 8.0],
            [width - right - w - 8.0, height - bottom - h - 8.0],
        ];
        let all = || self.series.iter().flat_map(|s| &s.points);
        let x = Axis::new(
            all().map(|p| p[0]),
            self.x_range,
            self.x_log,
            [left, width - right],
        );
        let y = Axis::new(
            all().map(|p| p[1]),
            self.y_range,
            self.y_log,
            [height - bottom, top],
        );
        let hidden = |corner: &[f64; 2]| {
            let inside = |p: &&[f64; 2]| {
                let (px, py) = (x.place(p[0]), y.place(p[1]));
                px.is_some_and(|px| (corner[0]..corner[0] + w).contains(&px))
                    && py.is_some_and(|py| (corner[1]..corner[1] + h).contains(&py))
            };
            all().filter(inside).count()
        };
        let mut best = corners[0];
        for corner in &corners[1..] {
            if hidden(corner) < hidden(&best) {
                best = *corner;
            }
        }
        let [lx, ly] = best;
        let _ = writeln!(
            out,
            "<rect x=\"{lx:.1}\" y=\"{ly:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"white\" fill-opacity=\"0.85\" stroke=\"#bbb\"/>"
        );
        for (k, series) in named.iter().enumerate() {
            let row = ly + 16.0 + 17.0 * k as f64;
            let colour = COLOURS[series.colour % COLOURS.len()];
            let mark = match series.style {
                Style::Dots => format!(
                    "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\" fill=\"{colour}\"/>",
                    lx + 17.0,
                    row - 4.0
                ),
                Style::Bars => format!(
                    "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"18\" height=\"9\" fill=\"{colour}\" fill-opacity=\"0.5\"/>",
                    lx + 8.0,
                    row - 9.0
                ),
                style => format!(
                    "<path d=\"M{:.1} {:.1}h20\" stroke=\"{colour}\" stroke-width=\"2\"{}/>",
                    lx + 7.0,
                    row - 4.0,
                    dashes(style)
                ),
            };
            let _ = writeln!(
                out,
                "{mark}<text x=\"{:.1}\" y=\"{row:.1}\">{}</text>",
                lx + 33.0,
                escaped(&series.label)
            );
        }
    }
}

fn dashes(style: Style) -> &'static str {
    if style == Style::Dashed {
        " stroke-dasharray=\"6 4\""
    } else {
        ""
    }
}

fn draw(out: &mut String, series: &Series, x: &Axis, y: &Axis) {
    let colour = COLOURS[series.colour % COLOURS.len()];
    let place = |p: &[f64; 2]| Some([x.place(p[0])?, y.place(p[1])?]);
    if series.style == Style::Bars {
        bars(out, series, x, y, colour);
        return;
    }
    if series.style != Style::Dots {
        let mut path = String::new();
        let mut pen = 'M';
        for p in &series.points {
            match place(p) {
                Some([px, py]) => {
                    let _ = write!(path, "{pen}{px:.1} {py:.1}");
                    pen = 'L';
                }
                None => pen = 'M',
            }
        }
        let _ = writeln!(
            out,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{}/>",
            dashes(series.style)
        );
    }
    if matches!(series.style, Style::Dots | Style::LineDots) {
        for [px, py] in series.points.iter().filter_map(place) {
            let _ = write!(
                out,
                "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.2\" fill=\"{colour}\"/>"
            );
        }
        out.push('\n');
    }
}

fn bars(out: &mut String, series: &Series, x: &Axis, y: &Axis, colour: &str) {
    let width = match &series.points[..] {
        [a, b, ..] => b[0] - a[0],
        _ => 1.0,
    };
    for p in &series.points {
        let ends = (x.place(p[0] - 0.5 * width), x.place(p[0] + 0.5 * width));
        if let ((Some(a), Some(b)), Some(top), Some(base)) = (ends, y.place(p[1]), y.place(0.0)) {
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

/// A picture of particles, coloured by a value.
#[derive(Clone, Debug, Default)]
pub struct Field {
    /// Above it.
    pub title: String,
    /// Lower and upper corner of what is shown, m.
    pub bounds: [[f64; 2]; 2],
    /// Diameter of a particle, m.
    pub diameter: f64,
    /// Places, m.
    pub points: Vec<[f64; 2]>,
    /// A value for each.
    pub values: Vec<f64>,
    /// Values of the first and of the last colour.
    pub range: [f64; 2],
    /// What the values are, with unit.
    pub label: String,
    /// Fixed particles.
    pub walls: Vec<[f64; 2]>,
}

/// Viridis in 16 steps (S. van der Walt & N. Smith, 2015; public domain).
const VIRIDIS: [&str; 16] = [
    "#440154", "#481a6c", "#472f7d", "#414487", "#39568c", "#31688e", "#2a788e", "#23888e",
    "#1f988b", "#22a884", "#35b779", "#54c568", "#7ad151", "#a5db36", "#d2e21b", "#fde725",
];

/// More particles than that are thinned out, and drawn larger: a picture has no more pixels.
const MOST_POINTS: usize = 20_000;

impl Field {
    /// Width and height of the picture at this width, pixels.
    fn size(&self, width: f64) -> [f64; 2] {
        let [low, high] = self.bounds;
        let height = width * (high[1] - low[1]) / (high[0] - low[0]);
        [width, height + 26.0]
    }

    fn body(&self, width: f64) -> String {
        let [low, high] = self.bounds;
        let scale = width / (high[0] - low[0]);
        let height = scale * (high[1] - low[1]);
        let every = self.points.len().div_ceil(MOST_POINTS).max(1);
        let diameter = (self.diameter * scale * (every as f64).sqrt()).max(0.6);
        let inside = |p: &[f64; 2]| (0..2).all(|k| (low[k]..=high[k]).contains(&p[k]));
        let place = |p: &[f64; 2]| {
            let (x, y) = (scale * (p[0] - low[0]), 24.0 + scale * (high[1] - p[1]));
            format!("M{x:.1} {y:.1}h0")
        };
        let mut out = format!(
            "<text x=\"{:.1}\" y=\"16\" text-anchor=\"middle\">{}</text>\n<rect x=\"0\" y=\"24\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#f7f7f7\" stroke=\"#999\"/>\n",
            0.5 * width,
            escaped(&self.title)
        );
        let mut paths = vec![String::new(); VIRIDIS.len()];
        let [first, last] = self.range;
        for (p, v) in self.points.iter().zip(&self.values).step_by(every) {
            if inside(p) {
                let t = (v - first) / (last - first);
                // A NaN becomes the first colour.
                let class = (t.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64).round() as usize;
                paths[class] += &place(p);
            }
        }
        let walls: String = self.walls.iter().filter(|p| inside(p)).map(place).collect();
        let wall_diameter = (self.diameter * scale).max(0.6);
        for (path, colour, diameter) in VIRIDIS
            .iter()
            .zip(paths)
            .map(|(colour, path)| (path, *colour, diameter))
            .chain([(walls, "#888888", wall_diameter)])
        {
            if !path.is_empty() {
                let _ = writeln!(
                    out,
                    "<path d=\"{path}\" stroke=\"{colour}\" stroke-width=\"{diameter:.2}\" stroke-linecap=\"round\" fill=\"none\"/>"
                );
            }
        }
        out
    }
}

/// Pictures side by side, `columns` in a row, each `width` pixels wide, with one colour scale: that
/// of the first.
#[must_use]
pub fn fields(fields: &[Field], columns: usize, width: f64) -> String {
    const GAP: f64 = 14.0;
    let rows: Vec<&[Field]> = fields.chunks(columns).collect();
    let heights: Vec<f64> = rows
        .iter()
        .map(|row| row.iter().map(|f| f.size(width)[1]).fold(0.0, f64::max))
        .collect();
    let total_width = columns as f64 * (width + GAP) + GAP;
    let total_height = heights.iter().map(|h| h + GAP).sum::<f64>() + GAP + 40.0;
    let mut out = open(total_width, total_height);
    let mut y = GAP;
    for (row, height) in rows.iter().zip(&heights) {
        for (k, field) in row.iter().enumerate() {
            let x = GAP + k as f64 * (width + GAP);
            let _ = write!(
                out,
                "<g transform=\"translate({x:.1} {y:.1})\">\n{}</g>\n",
                field.body(width)
            );
        }
        y += height + GAP;
    }
    if let Some(field) = fields.first() {
        colour_bar(&mut out, field, total_width, y + 4.0);
    }
    out += "</svg>\n";
    out
}

fn colour_bar(out: &mut String, field: &Field, width: f64, y: f64) {
    const STEP: f64 = 16.0;
    let x = 0.5 * (width - STEP * VIRIDIS.len() as f64);
    for (k, colour) in VIRIDIS.iter().enumerate() {
        let _ = write!(
            out,
            "<rect x=\"{:.1}\" y=\"{y:.1}\" width=\"{STEP}\" height=\"10\" fill=\"{colour}\"/>",
            x + STEP * k as f64
        );
    }
    let right = x + STEP * VIRIDIS.len() as f64;
    let _ = write!(
        out,
        "\n<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text><text x=\"{:.1}\" y=\"{:.1}\">{} {}</text>\n",
        x - 6.0,
        y + 10.0,
        short(field.range[0]),
        right + 6.0,
        y + 10.0,
        short(field.range[1]),
        escaped(&field.label)
    );
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

#[cfg(test)]
mod tests {
    use super::{Chart, Style, line, styled};

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
    }

    #[test]
    fn an_empty_chart_is_a_frame() {
        let svg = Chart::default().svg();
        assert!(svg.contains("<rect") && !svg.contains("NaN"));
    }
}
