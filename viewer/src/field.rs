//! The particles of a frame: anti-aliased discs that are as large as the particles.
//!
//! In the plane the colour of a pixel is the mean of the colours of the discs on it, weighted by their
//! coverages, and its opacity is the sum of these, at most 1; sums of integers, in which discs
//! that share an edge leave no seam. In space the particles are balls with light and shade, drawn from the
//! farthest to the nearest and paler in the distance.
//!
//! The rows of the picture are cut into bands; every band has a list of the discs on it, in the order of the ids
//! or of depth, and is drawn by one thread.

use crate::camera::Projection;
use crate::colour::Rgb;
use crate::colouring::Painter;
use crate::draw::Look;
use crate::home::Home;
use crate::raster::{Mask, Raster, Rect};
use crate::stamp::{PARTS, SMALLEST, Stamp};
use loschmidt_runner::Frame;
use rayon::prelude::*;

/// Rows of a band.
const BAND: usize = 16;

/// Particles that a thread takes at least.
const PIECE: usize = 2048;

/// Weight of a wall particle in space, of 255.
const FAINT: u8 = 70;

/// Weight of the background on the farthest ball, of 255.
const HAZE: f64 = 120.0;

/// A disc to be drawn.
#[derive(Clone, Copy)]
struct Disc {
    /// Centre in [`PARTS`] of a pixel, from the top left of the rectangle.
    x: i32,
    y: i32,
    colour: Rgb,
    /// Number of its stamp.
    stamp: u16,
    /// Weight, of 255.
    weight: u8,
}

/// The particles alone, without text: what a terminal shows, or a test compares. `width` and
/// `height` in pixels.
#[must_use]
pub fn field(frame: &Frame, home: &Home, look: &Look, width: usize, height: usize) -> Raster {
    let mut raster = Raster::new(width, height, look.theme.background);
    let rect = raster.rect();
    paint(&mut raster, rect, frame, home, look);
    raster
}

/// Draws the particles into a rectangle.
pub(crate) fn paint(raster: &mut Raster, rect: Rect, frame: &Frame, home: &Home, look: &Look) {
    let rect = rect.clipped(raster.width(), raster.height());
    if rect.width == 0 || rect.height == 0 {
        return;
    }
    let scene = Scene {
        frame,
        home,
        look,
        rect,
        projection: Projection::new(home, &look.view, rect.width, rect.height),
    };
    if home.dimension == 2 {
        let (discs, stamps) = scene.flat();
        draw_bands(raster, rect, &discs, &stamps, flat_band);
    } else {
        scene.edges(raster, false);
        let (discs, stamps) = scene.deep();
        draw_bands(raster, rect, &discs, &stamps, deep_band);
        scene.edges(raster, true);
    }
}

struct Scene<'a> {
    frame: &'a Frame,
    home: &'a Home,
    look: &'a Look,
    rect: Rect,
    projection: Projection,
}

impl Scene<'_> {
    fn painter(&self) -> Painter<'_> {
        let look = self.look;
        Painter::new(
            &look.colouring,
            look.colormap(),
            look.range
                .unwrap_or_else(|| look.colouring.range(self.home)),
        )
    }

    /// Radius of a particle, m: that of a disc or ball of its volume, times the look's factor.
    fn radius(&self) -> f64 {
        let pi = std::f64::consts::PI;
        let of_volume = match self.home.dimension {
            2 => 1.0 / pi.sqrt(),
            _ => libm::cbrt(0.75 / pi),
        };
        of_volume * self.home.spacing * self.look.disc
    }

    /// A disc, unless it lies outside of the rectangle.
    fn disc(&self, x: f64, y: f64, radius: f64) -> Option<Disc> {
        let reach = radius + 2.0;
        let (w, h) = (self.rect.width as f64, self.rect.height as f64);
        let inside = x > -reach && y > -reach && x < w + reach && y < h + reach;
        let parts = f64::from(PARTS);
        inside.then(|| Disc {
            x: floor(x * parts),
            y: floor(y * parts),
            colour: Rgb(0),
            stamp: 0,
            weight: 255,
        })
    }

    fn flat(&self) -> (Vec<Disc>, Vec<Stamp>) {
        let radius = (self.radius() * self.projection.scale()).max(SMALLEST);
        let painter = self.painter();
        let at = |x: &[f64; 3], colour: Rgb| {
            let p = self.projection.project(*x)?;
            let disc = self.disc(p.x, p.y, radius)?;
            Some(Disc { colour, ..disc })
        };
        let wall = self.look.theme.wall;
        let mut discs: Vec<Disc> = self
            .frame
            .wall_position
            .iter()
            .filter_map(|x| at(x, wall))
            .collect();
        discs.par_extend(
            self.frame
                .position
                .par_iter()
                .with_min_len(PIECE)
                .enumerate()
                .filter_map(|(n, x)| at(x, painter.colour(self.frame, self.home, n))),
        );
        (discs, vec![Stamp::new(radius, false)])
    }

    fn deep(&self) -> (Vec<Disc>, Vec<Stamp>) {
        let painter = self.painter();
        let radius = self.radius();
        let background = self.look.theme.background;
        let mut levels: Vec<u32> = vec![level(SMALLEST)];
        let mut discs: Vec<Disc> = Vec::new();
        for x in &self.frame.wall_position {
            let Some(p) = self.projection.project(*x) else {
                continue;
            };
            if let Some(disc) = self.disc(p.x, p.y, SMALLEST) {
                discs.push(Disc {
                    colour: self.look.theme.faint,
                    weight: FAINT,
                    ..disc
                });
            }
        }
        let mut balls: Vec<(f64, u32, Disc)> = self
            .frame
            .position
            .par_iter()
            .with_min_len(PIECE)
            .enumerate()
            .filter_map(|(n, x)| {
                let p = self.projection.project(*x)?;
                let size = (radius * p.scale).max(SMALLEST);
                let disc = self.disc(p.x, p.y, size)?;
                let haze = HAZE * self.projection.part_of_depth(p.depth);
                let colour = painter
                    .colour(self.frame, self.home, n)
                    .mix(background, haze as u8);
                Some((p.depth, level(size), Disc { colour, ..disc }))
            })
            .collect();
        // Equal depths keep the order of the ids.
        balls.par_sort_by(|a, b| b.0.total_cmp(&a.0));
        levels.extend(balls.iter().map(|ball| ball.1));
        levels.sort_unstable();
        levels.dedup();
        let stamp = |level: u32| levels.binary_search(&level).unwrap_or(0) as u16;
        let smallest = stamp(level(SMALLEST));
        discs.iter_mut().for_each(|disc| disc.stamp = smallest);
        discs.extend(balls.into_iter().map(|(_, level, disc)| Disc {
            stamp: stamp(level),
            ..disc
        }));
        let stamps = levels
            .par_iter()
            .map(|&level| Stamp::new(radius_of(level), true))
            .collect();
        (discs, stamps)
    }

    /// The edges of the box around the walls: those behind the fluid, or those before it.
    fn edges(&self, raster: &mut Raster, before: bool) {
        let Some(walls) = self.home.walls else {
            return;
        };
        let corner = |n: usize| -> [f64; 3] {
            std::array::from_fn(|k| [walls.low[k], walls.high[k]][n >> k & 1])
        };
        let projected: Vec<_> = (0..8).map(|n| self.projection.project(corner(n))).collect();
        // The corner nearest to the camera: the three edges at it are before the fluid.
        let nearest = (0..8).filter(|&n| projected[n].is_some()).min_by(|&a, &b| {
            let depth = |n: usize| projected[n].map_or(f64::INFINITY, |p| p.depth);
            depth(a).total_cmp(&depth(b))
        });
        let mut mask = Mask::new(self.rect);
        let width = (self.rect.height as f64 / 360.0).clamp(1.0, 6.0);
        for a in 0..8_usize {
            for k in 0..3 {
                let b = a | 1 << k;
                let front = Some(a) == nearest || Some(b) == nearest;
                if b == a || front != before {
                    continue;
                }
                if let (Some(p), Some(q)) = (projected[a], projected[b]) {
                    let (x, y) = (self.rect.x as f64, self.rect.y as f64);
                    mask.line([p.x + x, p.y + y], [q.x + x, q.y + y], width);
                }
            }
        }
        mask.paint(raster, self.look.theme.faint, if before { 70 } else { 130 });
    }
}

/// The largest integer that is not above; without a call of a library for each particle.
#[inline]
fn floor(x: f64) -> i32 {
    let whole = x as i32;
    whole - i32::from(f64::from(whole) > x)
}

/// Radii of balls in steps: quarters of a pixel, then whole ones.
fn level(radius: f64) -> u32 {
    if radius <= 16.0 {
        (4.0 * radius).round() as u32
    } else {
        48 + radius.min(crate::stamp::LARGEST).round() as u32
    }
}

fn radius_of(level: u32) -> f64 {
    if level <= 64 {
        0.25 * f64::from(level)
    } else {
        f64::from(level - 48)
    }
}

/// Discs by bands: those of band b are `order[start[b]..start[b + 1]]`.
struct Bands {
    start: Vec<usize>,
    order: Vec<u32>,
}

impl Bands {
    fn new(discs: &[Disc], stamps: &[Stamp], height: usize) -> Self {
        let count = height.div_ceil(BAND);
        let range = |disc: &Disc| {
            let row = disc.y.div_euclid(PARTS);
            let half = stamps[usize::from(disc.stamp)].half;
            let last = row + half;
            if last < 0 {
                return 0..0;
            }
            let first = (row - half).max(0) as usize / BAND;
            first..(last as usize / BAND + 1).min(count)
        };
        let mut start = vec![0; count + 1];
        for disc in discs {
            for band in range(disc) {
                start[band + 1] += 1;
            }
        }
        for band in 0..count {
            start[band + 1] += start[band];
        }
        let mut next = start.clone();
        let mut order = vec![0; start[count]];
        for (n, disc) in discs.iter().enumerate() {
            for band in range(disc) {
                order[next[band]] = n as u32;
                next[band] += 1;
            }
        }
        Self { start, order }
    }
}

/// One band of a raster and the rectangle's place in it.
struct Canvas<'a> {
    pixels: &'a mut [u32],
    /// Pixels of a row of the raster.
    stride: usize,
    /// First column and number of columns of the rectangle.
    left: usize,
    width: usize,
    /// First row of the band in the rectangle, and number of rows.
    top: usize,
    height: usize,
}

/// Where a disc meets a canvas: rows and columns of the canvas, and the first of both in the stamp.
struct Meeting {
    rows: std::ops::Range<usize>,
    columns: std::ops::Range<usize>,
    stamp_row: usize,
    stamp_column: usize,
}

impl Canvas<'_> {
    fn meet(&self, disc: &Disc, stamp: &Stamp) -> Meeting {
        let part = |centre: i32, start: usize, size: usize| {
            let first = i64::from(centre.div_euclid(PARTS) - stamp.half) - start as i64;
            let last = first + stamp.size() as i64;
            let from = first.clamp(0, size as i64);
            let to = last.clamp(from, size as i64);
            (from as usize..to as usize, (from - first) as usize)
        };
        let (rows, stamp_row) = part(disc.y, self.top, self.height);
        let (columns, stamp_column) = part(disc.x, 0, self.width);
        Meeting {
            rows,
            columns,
            stamp_row,
            stamp_column,
        }
    }

    fn row(&mut self, row: usize) -> &mut [u32] {
        let start = row * self.stride + self.left;
        &mut self.pixels[start..start + self.width]
    }
}

type DrawBand = fn(&mut Canvas<'_>, &mut Sums, &[u32], &[Disc], &[Stamp]);

/// Memory for the sums of a band: bands follow one another in the same, which stays in the cache.
#[derive(Default)]
struct Sums {
    flat: Vec<[u64; 2]>,
    deep: Vec<u64>,
    clear: Vec<u8>,
}

fn draw_bands(raster: &mut Raster, rect: Rect, discs: &[Disc], stamps: &[Stamp], draw: DrawBand) {
    let bands = Bands::new(discs, stamps, rect.height);
    let stride = raster.width();
    let rows = &mut raster.pixels_mut()[rect.y * stride..(rect.y + rect.height) * stride];
    rows.par_chunks_mut(BAND * stride)
        .enumerate()
        .for_each_init(Sums::default, |sums, (band, pixels)| {
            let mut canvas = Canvas {
                height: pixels.len() / stride,
                pixels,
                stride,
                left: rect.x,
                width: rect.width,
                top: band * BAND,
            };
            let order = &bands.order[bands.start[band]..bands.start[band + 1]];
            draw(&mut canvas, sums, order, discs, stamps);
        });
}

/// Discs of the plane: sums of coverage times colour, and of coverage.
fn flat_band(
    canvas: &mut Canvas<'_>,
    sums: &mut Sums,
    order: &[u32],
    discs: &[Disc],
    stamps: &[Stamp],
) {
    if order.is_empty() {
        return;
    }
    // Two sums of 32 bits in a word: red and green, blue and coverage. No sum of so many
    // coverages times 255 leaves its 32 bits.
    let shift = (0..8)
        .find(|&s| order.len() as u64 * (255 >> s) * 255 <= u64::from(u32::MAX))
        .unwrap_or(8);
    let sums = &mut sums.flat;
    sums.clear();
    sums.resize(canvas.width * canvas.height, [0; 2]);
    for &n in order {
        let disc = &discs[n as usize];
        let stamp = &stamps[usize::from(disc.stamp)];
        let meeting = canvas.meet(disc, stamp);
        let [r, g, b] = disc.colour.channels().map(u64::from);
        let (rg, bw) = (r | g << 32, b | 1 << 32);
        let width = meeting.columns.len();
        for (k, row) in meeting.rows.enumerate() {
            let coverage = stamp.coverage(disc.x, disc.y, meeting.stamp_row + k);
            let coverage = &coverage[meeting.stamp_column..meeting.stamp_column + width];
            let start = row * canvas.width + meeting.columns.start;
            for (sum, &c) in sums[start..start + width].iter_mut().zip(coverage) {
                let c = u64::from(c >> shift);
                sum[0] += c * rg;
                sum[1] += c * bw;
            }
        }
    }
    let full = 255u32 >> shift;
    let width = canvas.width;
    for (row, sums) in sums.chunks(width).enumerate() {
        for (pixel, sum) in canvas.row(row).iter_mut().zip(sums) {
            let covered = (sum[1] >> 32) as u32;
            if covered == 0 {
                continue;
            }
            // Single divisions are rounded alike everywhere, and the half makes whole means whole.
            let factor = 1.0 / covered as f32;
            let mean = |s: u64| (s as u32 as f32 * factor + 0.5) as u8;
            let colour = Rgb::of([mean(sum[0]), mean(sum[0] >> 32), mean(sum[1])]);
            let alpha = (covered.min(full) * 255 / full.max(1)) as u8;
            *pixel = match alpha {
                255 => colour.0,
                _ => Rgb(*pixel).mix(colour, alpha).0,
            };
        }
    }
}

/// Balls, one over the other, from the nearest to the farthest: a ball behind others costs
/// a look at the pixels that they have covered.
fn deep_band(
    canvas: &mut Canvas<'_>,
    sums: &mut Sums,
    order: &[u32],
    discs: &[Disc],
    stamps: &[Stamp],
) {
    /// Bits of a channel in a sum; a sum of weights is at most 255, one of colours 255².
    const LANE: u32 = 21;
    let canvas_width = canvas.width;
    // How much of a pixel is still to be seen through, of 255, and the colours before that.
    let Sums { clear, deep, .. } = sums;
    clear.clear();
    clear.resize(canvas_width * canvas.height, 255);
    deep.clear();
    deep.resize(clear.len(), 0);
    let sums = deep;
    for &n in order.iter().rev() {
        let disc = &discs[n as usize];
        let stamp = &stamps[usize::from(disc.stamp)];
        let meeting = canvas.meet(disc, stamp);
        let width = meeting.columns.len();
        let from = meeting.stamp_column;
        for (k, row) in meeting.rows.enumerate() {
            let row_of_stamp = meeting.stamp_row + k;
            let coverage = &stamp.coverage(disc.x, disc.y, row_of_stamp)[from..from + width];
            let shade = &stamp.shade(disc.x, disc.y, row_of_stamp)[from..from + width];
            let start = row * canvas_width + meeting.columns.start;
            let pixels = clear[start..start + width]
                .iter_mut()
                .zip(&mut sums[start..start + width]);
            for (((clear, sum), &c), &shade) in pixels.zip(coverage).zip(shade) {
                if c == 0 || *clear == 0 {
                    continue;
                }
                let share = |part: u32, of: u32| (part * of + 127) / 255;
                let alpha = share(u32::from(c), u32::from(disc.weight));
                let weight = share(alpha, u32::from(*clear));
                let [r, g, b] = Rgb(0).mix(disc.colour, shade).channels().map(u64::from);
                *sum += (r << (2 * LANE) | g << LANE | b) * u64::from(weight);
                *clear -= weight as u8;
            }
        }
    }
    for (row, (clear, sums)) in clear
        .chunks(canvas_width)
        .zip(sums.chunks(canvas_width))
        .enumerate()
    {
        for ((pixel, &clear), sum) in canvas.row(row).iter_mut().zip(clear).zip(sums) {
            if clear < 255 {
                let ground = Rgb(*pixel).channels();
                let channel = |c: usize| {
                    let before = (sum >> (LANE * (2 - c as u32))) as u32 & ((1 << LANE) - 1);
                    (before + u32::from(ground[c]) * u32::from(clear) + 127) / 255
                };
                *pixel = Rgb::of([0, 1, 2].map(|c| channel(c) as u8)).0;
            }
        }
    }
}
