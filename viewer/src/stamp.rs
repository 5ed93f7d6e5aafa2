//! Discs as stamps: coverage of the pixels, computed once for every radius and place within a
//! pixel.
//!
//! The coverage of a pixel by a disc of radius r is counted on 8 x 8 points of the pixel for small
//! discs, and is r + 1/2 - d, cut off at 0 and 1, with the distance d of the pixel's middle for
//! large ones. The shade is that of a ball under a lamp over the left shoulder: ambient + diffuse
//! light, by the normal n = (x, y, √(r² - x² - y²))/r.

/// Positions are in these parts of a pixel.
pub(crate) const PARTS: i32 = 8;

/// Radius in pixels from which on the distance formula is good enough.
const LARGE: f64 = 4.0;

/// The largest radius in pixels.
pub(crate) const LARGEST: f64 = 256.0;

/// The smallest: a particle is never lost between the pixels.
pub(crate) const SMALLEST: f64 = 0.5;

/// Discs of one radius at all places within a pixel.
pub(crate) struct Stamp {
    /// Pixels on either side of the one with the centre.
    pub half: i32,
    /// Places within a pixel that are told apart, per axis.
    pub places: i32,
    coverage: Vec<u8>,
    shade: Vec<u8>,
}

impl Stamp {
    /// A disc of this radius in pixels; a ball where it is to be shaded.
    pub fn new(radius: f64, shaded: bool) -> Self {
        let radius = radius.clamp(SMALLEST, LARGEST);
        let half = radius.ceil() as i32;
        let places = match radius {
            r if r < 4.0 => PARTS,
            r if r < 16.0 => 4,
            r if r < 48.0 => 2,
            _ => 1,
        };
        let mut stamp = Self {
            half,
            places,
            coverage: Vec::new(),
            shade: Vec::new(),
        };
        for py in 0..places {
            for px in 0..places {
                let place = |p: i32| (f64::from(p) + 0.5) / f64::from(places);
                stamp.add(radius, [place(px), place(py)], shaded);
            }
        }
        stamp
    }

    fn add(&mut self, radius: f64, place: [f64; 2], shaded: bool) {
        for row in -self.half..=self.half {
            for column in -self.half..=self.half {
                let dx = f64::from(column) + 0.5 - place[0];
                let dy = f64::from(row) + 0.5 - place[1];
                self.coverage.push(coverage(radius, dx, dy));
                if shaded {
                    self.shade.push(shade(dx / radius, dy / radius));
                }
            }
        }
    }

    /// Pixels per row.
    pub fn size(&self) -> usize {
        2 * self.half as usize + 1
    }

    /// The part of a table for the disc with its centre at `x`, `y` (in [`PARTS`] of a pixel).
    #[inline]
    fn part<'a, T>(&self, table: &'a [T], x: i32, y: i32) -> &'a [T] {
        let place = |p: i32| (p.rem_euclid(PARTS) * self.places / PARTS) as usize;
        let pixels = self.size() * self.size();
        let start = (place(y) * self.places as usize + place(x)) * pixels;
        &table[start..start + pixels]
    }

    /// Coverage, 0 to 255, by places (rows of them), rows and columns.
    pub fn table(&self) -> &[u8] {
        &self.coverage
    }

    /// Coverage, 0 to 255, of the pixels, row by row from the top left of the disc.
    pub fn coverage(&self, x: i32, y: i32) -> &[u8] {
        self.part(&self.coverage, x, y)
    }

    /// Brightness, 0 to 255, of the same pixels.
    pub fn shade(&self, x: i32, y: i32) -> &[u8] {
        self.part(&self.shade, x, y)
    }
}

fn coverage(radius: f64, dx: f64, dy: f64) -> u8 {
    if radius >= LARGE {
        let distance = (dx * dx + dy * dy).sqrt();
        return ((radius + 0.5 - distance).clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    }
    const POINTS: i32 = 8;
    let mut inside = 0;
    for j in 0..POINTS {
        for i in 0..POINTS {
            let offset = |n: i32| (f64::from(n) + 0.5) / f64::from(POINTS) - 0.5;
            let (x, y) = (dx + offset(i), dy + offset(j));
            inside += i32::from(x * x + y * y <= radius * radius);
        }
    }
    (inside * 255 / (POINTS * POINTS)) as u8
}

/// `x` to the right and `y` down, in radii.
fn shade(x: f64, y: f64) -> u8 {
    const LAMP: [f64; 3] = [-0.45, 0.65, 0.61];
    let squared = (x * x + y * y).min(1.0);
    let z = (1.0 - squared).sqrt();
    let light = (LAMP[0] * x - LAMP[1] * y + LAMP[2] * z).max(0.0);
    ((0.76 + 0.4 * light).min(1.0) * 255.0 + 0.5) as u8
}
