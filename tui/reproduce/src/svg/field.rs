//! Pictures of particles, coloured by a value, with axes and one colour bar.

use super::axis::Axis;
use super::{open, text};
use std::collections::BTreeSet;
use std::fmt::Write;

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

/// Particles smaller than that, in pixels, are thinned out to one for each square of this edge: a
/// picture has no more pixels.
const FINEST: f64 = 0.9;

/// Left of a picture, above it and below it: room for its ticks and its title, pixels.
const ROOM: [f64; 3] = [38.0, 24.0, 22.0];
/// Between two pictures.
const GAP: f64 = 12.0;

impl Field {
    /// Height of the picture itself at this width, pixels.
    fn height(&self, width: f64) -> f64 {
        let [low, high] = self.bounds;
        width * (high[1] - low[1]) / (high[0] - low[0])
    }

    /// The unit of its axes, of which so many are a metre: small pictures have millimetres.
    fn unit(&self) -> (f64, &'static str) {
        let corners = self.bounds.as_flattened().iter();
        if corners.fold(0.0, |most: f64, x| most.max(x.abs())) < 0.1 {
            (1e3, "mm")
        } else {
            (1.0, "m")
        }
    }

    /// The picture with its upper left corner at the origin.
    fn body(&self, width: f64) -> String {
        let height = self.height(width);
        let mut out = format!(
            "<text x=\"{:.1}\" y=\"-8\" text-anchor=\"middle\">{}</text>\n<rect width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#fafafa\"/>\n",
            0.5 * width,
            text::content(&self.title)
        );
        self.particles(&mut out, width);
        self.frame(&mut out, width);
        out
    }

    fn particles(&self, out: &mut String, width: f64) {
        let [low, high] = self.bounds;
        let scale = width / (high[0] - low[0]);
        let is_fine = self.diameter * scale < FINEST;
        // As large as the diagonal of a square: no gaps are left.
        let diameter = if is_fine {
            FINEST * std::f64::consts::SQRT_2
        } else {
            self.diameter * scale
        };
        let mut taken = BTreeSet::new();
        let mut is_first = |p: &[f64; 2]| {
            let square = |x: f64| (scale * x / FINEST).floor() as i64;
            !is_fine || taken.insert([square(p[0]), square(p[1])])
        };
        let inside = |p: &[f64; 2]| (0..2).all(|k| (low[k]..=high[k]).contains(&p[k]));
        let place = |p: &[f64; 2]| {
            let (x, y) = (scale * (p[0] - low[0]), scale * (high[1] - p[1]));
            format!("M{x:.1} {y:.1}h0")
        };
        let mut paths = vec![String::new(); VIRIDIS.len()];
        let [first, last] = self.range;
        for (p, v) in self.points.iter().zip(&self.values) {
            if inside(p) && is_first(p) {
                let t = (v - first) / (last - first);
                // A NaN becomes the first colour.
                let class = (t.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64).round() as usize;
                paths[class] += &place(p);
            }
        }
        let walls: String = self.walls.iter().filter(|p| inside(p)).map(place).collect();
        let coloured = VIRIDIS.iter().copied().zip(paths);
        for (colour, path) in coloured.chain([("#888888", walls)]) {
            if !path.is_empty() {
                let _ = writeln!(
                    out,
                    "<path d=\"{path}\" stroke=\"{colour}\" stroke-width=\"{diameter:.2}\" stroke-linecap=\"round\" fill=\"none\"/>"
                );
            }
        }
    }

    /// The frame with its ticks and their labels, m.
    fn frame(&self, out: &mut String, width: f64) {
        let [low, high] = self.bounds;
        let height = self.height(width);
        let (unit, _) = self.unit();
        let axis = |k: usize, pixels| {
            let range = [low[k] * unit, high[k] * unit];
            Axis::new(std::iter::empty(), Some(range), false, pixels)
        };
        let (x, y) = (axis(0, [0.0, width]), axis(1, [height, 0.0]));
        let mut ticks = String::new();
        for tick in x.ticks() {
            if let (Some(p), Some(label)) = (x.place(tick.value), tick.label) {
                let _ = write!(ticks, "M{p:.1} {height:.1}v4");
                let _ = writeln!(
                    out,
                    "<text x=\"{p:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\">{label}</text>",
                    height + 15.0
                );
            }
        }
        for tick in y.ticks() {
            if let (Some(p), Some(label)) = (y.place(tick.value), tick.label) {
                let _ = write!(ticks, "M0 {p:.1}h-4");
                let _ = writeln!(
                    out,
                    "<text x=\"-6\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"11\">{label}</text>",
                    p + 4.0
                );
            }
        }
        let _ = writeln!(
            out,
            "<rect width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"#444\"/><path d=\"{ticks}\" stroke=\"#444\"/>"
        );
    }
}

/// Pictures side by side, `columns` in a row, each `width` pixels wide, with one colour scale: that
/// of the first.
#[must_use]
pub fn fields(fields: &[Field], columns: usize, width: f64) -> String {
    let [left, above, below] = ROOM;
    let rows: Vec<&[Field]> = fields.chunks(columns).collect();
    let heights: Vec<f64> = rows
        .iter()
        .map(|row| row.iter().map(|f| f.height(width)).fold(0.0, f64::max))
        .collect();
    let step = left + width + GAP;
    let total_width = columns as f64 * step + GAP;
    let row_room = above + below + GAP;
    let total_height = heights.iter().map(|h| h + row_room).sum::<f64>() + 56.0;
    let mut out = open("fields", total_width, total_height);
    let mut y = above;
    for (row, height) in rows.iter().zip(&heights) {
        for (k, field) in row.iter().enumerate() {
            let x = left + k as f64 * step;
            let _ = write!(
                out,
                "<g transform=\"translate({x:.1} {y:.1})\">\n{}</g>\n",
                field.body(width)
            );
        }
        y += height + row_room;
    }
    if let Some(field) = fields.first() {
        colour_bar(&mut out, field, total_width, total_height - 50.0);
    }
    out += "</svg>\n";
    out
}

/// The scale of the colours, its label to the left, and that the axes are in metres.
fn colour_bar(out: &mut String, field: &Field, width: f64, y: f64) {
    const STEP: f64 = 16.0;
    let long = STEP * VIRIDIS.len() as f64;
    let x = 0.5 * (width - long);
    for (k, colour) in VIRIDIS.iter().enumerate() {
        let _ = write!(
            out,
            "<rect x=\"{:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"12\" fill=\"{colour}\"/>",
            x + STEP * k as f64,
            STEP + 0.3
        );
    }
    let [first, last] = field.range;
    for part in [0.0, 0.5, 1.0] {
        let _ = write!(
            out,
            "\n<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"12\">{}</text>",
            x + part * long,
            y + 27.0,
            text::number(first + part * (last - first))
        );
    }
    let _ = write!(
        out,
        "\n<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text><text x=\"{:.1}\" y=\"{:.1}\">axes: x and y, {}</text>\n",
        x - 14.0,
        y + 11.0,
        text::content(&field.label),
        x + long + 14.0,
        y + 11.0,
        field.unit().1,
    );
}

#[cfg(test)]
mod tests {
    use super::{Field, fields};

    #[test]
    fn small_pictures_have_axes_in_millimetres_and_no_powers_of_ten() {
        let field = Field {
            bounds: [[-0.018, 0.0], [0.018, 0.028]],
            ..Field::default()
        };
        let svg = fields(&[field], 1, 100.0);
        assert!(svg.contains("axes: x and y, mm"), "{svg}");
        assert!(svg.contains(">10</text>"), "{svg}");
        let field = Field {
            bounds: [[0.0; 2], [1.0; 2]],
            ..Field::default()
        };
        assert!(fields(&[field], 1, 100.0).contains("axes: x and y, m<"));
    }

    #[test]
    fn a_picture_holds_every_particle_it_has_room_for_and_no_more_than_one_a_pixel() {
        let picture = |n: usize| {
            let at = |k: usize| (k as f64 + 0.5) / n as f64;
            let points: Vec<[f64; 2]> = (0..n * n).map(|k| [at(k % n), at(k / n)]).collect();
            let field = Field {
                bounds: [[0.0; 2], [1.0; 2]],
                diameter: 1.0 / n as f64,
                values: points.iter().map(|p| p[0]).collect(),
                points,
                range: [0.0, 1.0],
                ..Field::default()
            };
            fields(&[field], 1, 100.0).matches("h0").count()
        };
        assert_eq!(picture(10), 100);
        assert_eq!(picture(100), 10_000);
        let most = picture(400);
        assert!((11_000..13_000).contains(&most), "{most}");
    }
}
