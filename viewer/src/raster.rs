//! The pixels: a rectangle of opaque colours, row by row from the top left.

use crate::colour::Rgb;

/// A rectangle of whole pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rect {
    /// Left edge, pixels from the left.
    pub x: usize,
    /// Upper edge, pixels from the top.
    pub y: usize,
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
}

impl Rect {
    /// The rectangle with these edges and sizes, pixels.
    #[must_use]
    pub fn new(x: usize, y: usize, width: usize, height: usize) -> Self {
        Self {
            x,
            y,
            width,
            height,
        }
    }

    /// The same without a margin of `by` pixels on every side.
    #[must_use]
    pub fn shrunk(self, by: usize) -> Self {
        Self {
            x: self.x + by.min(self.width / 2),
            y: self.y + by.min(self.height / 2),
            width: self.width.saturating_sub(2 * by),
            height: self.height.saturating_sub(2 * by),
        }
    }

    /// The part of it within a raster of this size.
    #[must_use]
    pub fn clipped(self, width: usize, height: usize) -> Self {
        let (x, y) = (self.x.min(width), self.y.min(height));
        Self {
            x,
            y,
            width: self.width.min(width - x),
            height: self.height.min(height - y),
        }
    }
}

/// A picture. A pixel is `0x00RRGGBB`, as windows take it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Raster {
    width: usize,
    height: usize,
    pixels: Vec<u32>,
}

impl Raster {
    /// A picture of one colour; `width` and `height` in pixels.
    #[must_use]
    pub fn new(width: usize, height: usize, colour: Rgb) -> Self {
        Self {
            width,
            height,
            pixels: vec![colour.0; width * height],
        }
    }

    /// Width in pixels.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }
    /// Height in pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }
    /// All of it.
    #[must_use]
    pub fn rect(&self) -> Rect {
        Rect::new(0, 0, self.width, self.height)
    }
    /// The pixels, `0x00RRGGBB`, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }
    /// The pixels, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [u32] {
        &mut self.pixels
    }
    /// The colour of a pixel; black outside.
    #[must_use]
    pub fn at(&self, x: usize, y: usize) -> Rgb {
        let inside = x < self.width && y < self.height;
        Rgb(if inside {
            self.pixels[y * self.width + x]
        } else {
            0
        })
    }
    /// The pixels as bytes R, G, B.
    #[must_use]
    pub fn rgb(&self) -> Vec<u8> {
        let bytes = |p: &u32| {
            let [_, r, g, b] = p.to_be_bytes();
            [r, g, b]
        };
        self.pixels.iter().flat_map(bytes).collect()
    }
    /// A copy of the part in this rectangle.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Self {
        part(&self.pixels, self.rect(), rect)
    }

    /// The pixels, to be drawn on.
    #[must_use]
    pub fn draw(&mut self) -> Pixels<'_> {
        Pixels {
            width: self.width,
            height: self.height,
            pixels: &mut self.pixels,
        }
    }
}

fn part(pixels: &[u32], whole: Rect, rect: Rect) -> Raster {
    let rect = rect.clipped(whole.width, whole.height);
    let rows = (rect.y..rect.y + rect.height).flat_map(|y| {
        let start = y * whole.width + rect.x;
        &pixels[start..start + rect.width]
    });
    Raster {
        width: rect.width,
        height: rect.height,
        pixels: rows.copied().collect(),
    }
}

/// The pixels of a [`Raster`] or of a window, to be drawn on.
#[derive(Debug)]
pub struct Pixels<'a> {
    width: usize,
    height: usize,
    pixels: &'a mut [u32],
}

impl<'a> Pixels<'a> {
    /// Pixels row by row from the top left, as many as `width * height`; `None` if there are not.
    #[must_use]
    pub fn new(width: usize, height: usize, pixels: &'a mut [u32]) -> Option<Self> {
        let fits = width.checked_mul(height) == Some(pixels.len());
        fits.then_some(Self {
            width,
            height,
            pixels,
        })
    }

    /// Width in pixels.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// All of them.
    #[must_use]
    pub fn rect(&self) -> Rect {
        Rect::new(0, 0, self.width, self.height)
    }

    /// The pixels, `0x00RRGGBB`, row by row.
    pub(crate) fn all(&mut self) -> &mut [u32] {
        self.pixels
    }

    /// A copy of the part in this rectangle.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Raster {
        part(self.pixels, self.rect(), rect)
    }

    /// Copies another picture to where its upper left corner is at `x`, `y`; what does not fit is
    /// left out.
    pub fn place(&mut self, other: &Raster, x: usize, y: usize) {
        let rect = Rect::new(x, y, other.width, other.height).clipped(self.width, self.height);
        for row in 0..rect.height {
            let to = (rect.y + row) * self.width + rect.x;
            let from = row * other.width;
            self.pixels[to..to + rect.width]
                .copy_from_slice(&other.pixels[from..from + rect.width]);
        }
    }

    /// Mixes a colour into a pixel with a weight of `alpha` / 255; outside nothing happens.
    pub fn blend(&mut self, x: i64, y: i64, colour: Rgb, alpha: u8) {
        let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else {
            return;
        };
        if x < self.width && y < self.height {
            let pixel = &mut self.pixels[y * self.width + x];
            *pixel = Rgb(*pixel).mix(colour, alpha).0;
        }
    }

    /// Fills a rectangle with a colour at a weight of `alpha` / 255.
    pub fn fill(&mut self, rect: Rect, colour: Rgb, alpha: u8) {
        let rect = rect.clipped(self.width, self.height);
        for y in rect.y..rect.y + rect.height {
            let start = y * self.width + rect.x;
            let row = &mut self.pixels[start..start + rect.width];
            if alpha == 255 {
                row.fill(colour.0);
                continue;
            }
            for pixel in row {
                *pixel = Rgb(*pixel).mix(colour, alpha).0;
            }
        }
    }
}

/// A mask of coverage, 0 to 255, for a shape whose parts overlap: they count once.
#[derive(Clone, Debug)]
pub struct Mask {
    rect: Rect,
    coverage: Vec<u8>,
}

impl Mask {
    /// An empty mask over a rectangle.
    #[must_use]
    pub fn new(rect: Rect) -> Self {
        Self {
            rect,
            coverage: vec![0; rect.width * rect.height],
        }
    }

    /// Adds the line from `a` to `b` (pixels from the top left of the picture), `width` pixels
    /// wide, with round ends and smooth edges.
    pub fn line(&mut self, a: [f64; 2], b: [f64; 2], width: f64) {
        let radius = 0.5 * width;
        let reach = radius + 1.0;
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let squared = dx * dx + dy * dy;
        // Of a row, only the columns near the part of the line that is near the row.
        let columns = |y: f64| {
            let part = |y: f64| ((y - a[1]) / dy).clamp(0.0, 1.0);
            let [p, q] = if dy.abs() > 1e-9 {
                [part(y - reach), part(y + reach)]
            } else {
                [0.0, 1.0]
            };
            let [p, q] = [a[0] + p * dx, a[0] + q * dx];
            [p.min(q) - reach, p.max(q) + reach]
        };
        let rows = [a[1].min(b[1]) - reach, a[1].max(b[1]) + reach];
        self.shape(rows, columns, |x, y| {
            let (px, py) = (x - a[0], y - a[1]);
            let t = if squared > 0.0 {
                ((px * dx + py * dy) / squared).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let (ex, ey) = (px - t * dx, py - t * dy);
            radius + 0.5 - (ex * ex + ey * ey).sqrt()
        });
    }

    /// Adds a ring: the circle of this radius around `centre`, `width` pixels wide.
    pub fn ring(&mut self, centre: [f64; 2], radius: f64, width: f64) {
        let reach = radius + 0.5 * width + 1.0;
        let around = |c: f64| [c - reach, c + reach];
        self.shape(
            around(centre[1]),
            |_| around(centre[0]),
            |x, y| {
                let (dx, dy) = (x - centre[0], y - centre[1]);
                0.5 * width + 0.5 - ((dx * dx + dy * dy).sqrt() - radius).abs()
            },
        );
    }

    /// Adds a triangle; its corners in either sense of rotation.
    pub fn triangle(&mut self, corners: [[f64; 2]; 3]) {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let sense = if area < 0.0 { -1.0 } else { 1.0 };
        // Distance from the edge p q, positive inside.
        let edge = |p: [f64; 2], q: [f64; 2], x: f64, y: f64| {
            let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
            let length = (dx * dx + dy * dy).sqrt().max(1e-9);
            sense * (dx * (y - p[1]) - dy * (x - p[0])) / length
        };
        let range = |k: usize| {
            let (low, high) = (a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k]));
            [low - 1.0, high + 1.0]
        };
        self.shape(
            range(1),
            |_| range(0),
            |x, y| 0.5 + edge(a, b, x, y).min(edge(b, c, x, y)).min(edge(c, a, x, y)),
        );
    }

    /// Adds a shape between two rows. Of the row at `y` it lies within `columns(y)`, and `inside`
    /// is its coverage at the middle of a pixel, below 0 outside.
    fn shape(
        &mut self,
        rows: [f64; 2],
        columns: impl Fn(f64) -> [f64; 2],
        inside: impl Fn(f64, f64) -> f64,
    ) {
        let range = |[low, high]: [f64; 2], start: usize, size: usize| {
            let from = (low - start as f64).floor().clamp(0.0, size as f64) as usize;
            let to = (high - start as f64).ceil().clamp(0.0, size as f64) as usize;
            from..to
        };
        for row in range(rows, self.rect.y, self.rect.height) {
            let y = (self.rect.y + row) as f64 + 0.5;
            for column in range(columns(y), self.rect.x, self.rect.width) {
                let x = (self.rect.x + column) as f64 + 0.5;
                let coverage = (inside(x, y).clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
                let pixel = &mut self.coverage[row * self.rect.width + column];
                *pixel = (*pixel).max(coverage);
            }
        }
    }

    /// Paints a colour through the mask, at a weight of `alpha` / 255.
    pub fn paint(&self, raster: &mut Pixels<'_>, colour: Rgb, alpha: u8) {
        for (row, line) in self.coverage.chunks(self.rect.width.max(1)).enumerate() {
            for (column, &coverage) in line.iter().enumerate() {
                if coverage > 0 {
                    let weight = (u32::from(coverage) * u32::from(alpha) + 127) / 255;
                    raster.blend(
                        (self.rect.x + column) as i64,
                        (self.rect.y + row) as i64,
                        colour,
                        weight as u8,
                    );
                }
            }
        }
    }
}
