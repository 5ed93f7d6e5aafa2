//! Discs on pixels. The rows of a picture are cut into bands, of which every one is drawn by one thread; the
//! discs come in pieces, of which every one is laid out by bands by one thread.

use crate::colour::Rgb;
use crate::raster::{Pixels, Rect};
use crate::stamp::{PARTS, Stamp};
use glam::Vec4;
use rayon::prelude::*;
use std::cell::Cell;

/// Rows of a band.
const BAND: usize = 16;

/// A disc to be drawn.
#[derive(Clone, Copy, Default)]
pub(crate) struct Disc {
    /// Centre in [`PARTS`] of a pixel, from the top left of the rectangle.
    pub x: i32,
    pub y: i32,
    pub colour: Rgb,
    /// Number of its stamp.
    pub stamp: u16,
    /// Weight, of 255.
    pub weight: u8,
}

/// How many bands a rectangle of so many rows has.
pub(crate) fn count(height: usize) -> usize {
    height.div_ceil(BAND)
}

/// Some discs by bands, in the order they came in; a disc on two bands is there twice.
#[derive(Default)]
pub(crate) struct Piece {
    bands: Vec<Vec<Disc>>,
}

impl Piece {
    /// Forgets the discs of an earlier picture, and takes those of one with so many bands.
    pub fn clear(&mut self, bands: usize) {
        self.bands.iter_mut().for_each(Vec::clear);
        self.bands.resize_with(bands, Vec::new);
    }

    /// Adds a disc with so many pixels on either side of the one with its centre.
    #[inline]
    pub fn push(&mut self, disc: Disc, half: i32) {
        let row = disc.y.div_euclid(PARTS);
        let last = row + half;
        if last < 0 {
            return;
        }
        let (first, last) = ((row - half).max(0) as usize / BAND, last as usize / BAND);
        for band in first..=last {
            if let Some(discs) = self.bands.get_mut(band) {
                discs.push(disc);
            }
        }
    }

    /// The discs on a band.
    pub fn of(&self, band: usize) -> &[Disc] {
        &self.bands[band]
    }
}

/// One band of a raster and the rectangle's place in it.
pub(crate) struct Canvas<'a> {
    pixels: &'a mut [u32],
    /// Pixels of a row of the raster.
    stride: usize,
    /// First column and number of columns of the rectangle.
    left: usize,
    width: usize,
    /// Number of the band, its first row in the rectangle, and number of rows.
    band: usize,
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
    #[inline]
    fn meet(&self, disc: &Disc, stamp: &Stamp) -> Meeting {
        // Centres are within a radius and two pixels of the rectangle: no sum leaves its range.
        let part = |centre: i32, start: usize, size: usize| {
            let first = centre.div_euclid(PARTS) - stamp.half - start as i32;
            let from = first.clamp(0, size as i32);
            let to = (first + stamp.size() as i32).clamp(from, size as i32);
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

/// Draws the discs of all pieces into a rectangle, band by band.
pub(crate) fn draw_bands(
    raster: &mut Pixels<'_>,
    rect: Rect,
    pieces: &[Piece],
    draw: impl Fn(&mut Canvas<'_>, &[Piece]) + Sync,
) {
    let stride = raster.width();
    let rows = &mut raster.all()[rect.y * stride..(rect.y + rect.height) * stride];
    rows.par_chunks_mut(BAND * stride)
        .enumerate()
        .for_each(|(band, pixels)| {
            let mut canvas = Canvas {
                height: pixels.len() / stride,
                pixels,
                stride,
                left: rect.x,
                width: rect.width,
                band,
                top: band * BAND,
            };
            draw(&mut canvas, pieces);
        });
}

/// Red, green and blue times coverage, and coverage: whole numbers, of which nothing is lost up to
/// 2^24.
type Sum = Vec4;

/// Columns of a tile: where no disc lies on a tile, no sum is looked at.
const TILE: usize = 16;

/// As many coverages of 255 on a pixel leave 2^24 to no sum.
const CROWD: f32 = 255.0 * 258.0;

thread_local! {
    /// The sums of a band, all of them 0, and which tiles have other ones: bands and pictures follow
    /// one another in the same memory, which stays in the cache.
    static FLAT: Cell<(Vec<Sum>, Vec<bool>)> = const { Cell::new((Vec::new(), Vec::new())) };
    static DEEP: Cell<(Vec<u64>, Vec<u8>)> = const { Cell::new((Vec::new(), Vec::new())) };
}

/// The background, and on it discs of the plane, all of one stamp.
pub(crate) fn flat_band(canvas: &mut Canvas<'_>, pieces: &[Piece], stamp: &Stamp, background: Rgb) {
    if pieces.iter().all(|piece| piece.of(canvas.band).is_empty()) {
        for row in 0..canvas.height {
            canvas.row(row).fill(background.0);
        }
        return;
    }
    let (mut sums, mut tiles) = FLAT.take();
    let size = canvas.width * canvas.height;
    if sums.len() < size {
        sums.resize(size, Sum::ZERO);
    }
    tiles.clear();
    tiles.resize(canvas.width.div_ceil(TILE), false);
    // Small discs are the many ones.
    match stamp.size() {
        3 => add_discs::<3>(&mut sums, &mut tiles, canvas, pieces, stamp),
        5 => add_discs::<5>(&mut sums, &mut tiles, canvas, pieces, stamp),
        _ => add_discs::<0>(&mut sums, &mut tiles, canvas, pieces, stamp),
    }
    let mut most = 0.0_f32;
    for row in 0..canvas.height {
        let start = row * canvas.width;
        let sums = sums[start..start + canvas.width].chunks_mut(TILE);
        let pixels = canvas.row(row).chunks_mut(TILE);
        for ((pixels, sums), &touched) in pixels.zip(sums).zip(&tiles) {
            if !touched {
                pixels.fill(background.0);
                continue;
            }
            for (pixel, sum) in pixels.iter_mut().zip(sums) {
                let sum = std::mem::take(sum);
                *pixel = if sum.w > 0.0 {
                    covered(background, sum)
                } else {
                    background.0
                };
                if sum.w > most {
                    most = sum.w;
                }
            }
        }
    }
    FLAT.set((sums, tiles));
    if most > CROWD {
        crowded_band(canvas, pieces, stamp, background);
    }
}

/// A pixel under discs with this sum.
#[inline]
fn covered(ground: Rgb, sum: Sum) -> u32 {
    // Single divisions are rounded alike everywhere. Added to 2^23 a number is rounded to a whole
    // one, which stands in its last bits then.
    let mean = sum * (1.0 / sum.w) + Sum::splat(8_388_608.0);
    let [r, g, b, _] = mean.to_array().map(|c| c.to_bits() & 0xff);
    let colour = Rgb(r << 16 | g << 8 | b);
    if sum.w >= 255.0 {
        colour.0
    } else {
        ground.mix(colour, sum.w as u8).0
    }
}

/// Adds the discs to the sums of their pixels, and notes the tiles that they lie on. `SIZE` is the
/// stamp's, or 0 for any.
fn add_discs<const SIZE: usize>(
    sums: &mut [Sum],
    tiles: &mut [bool],
    canvas: &Canvas<'_>,
    pieces: &[Piece],
    stamp: &Stamp,
) {
    let size = stamp.size() as i32;
    for piece in pieces {
        for disc in piece.of(canvas.band) {
            let [r, g, b] = disc.colour.channels().map(f32::from);
            let colour = Sum::new(r, g, b, 1.0);
            let table = stamp.weights(disc.x, disc.y);
            let column = disc.x.div_euclid(PARTS) - stamp.half;
            let row = disc.y.div_euclid(PARTS) - stamp.half - canvas.top as i32;
            let inside = column >= 0
                && row >= 0
                && column + size <= canvas.width as i32
                && row + size <= canvas.height as i32;
            if SIZE > 0 && SIZE <= TILE && inside {
                tiles[column as usize / TILE] = true;
                tiles[(column as usize + SIZE - 1) / TILE] = true;
                let start = row as usize * canvas.width + column as usize;
                for (k, weights) in table.as_chunks::<SIZE>().0.iter().enumerate() {
                    let start = start + k * canvas.width;
                    for (sum, &weight) in sums[start..start + SIZE].iter_mut().zip(weights) {
                        *sum += Sum::splat(weight) * colour;
                    }
                }
                continue;
            }
            let meeting = canvas.meet(disc, stamp);
            let width = meeting.columns.len();
            if width == 0 {
                continue;
            }
            tiles[meeting.columns.start / TILE..=(meeting.columns.end - 1) / TILE].fill(true);
            for (k, row) in meeting.rows.enumerate() {
                let from = (meeting.stamp_row + k) * stamp.size() + meeting.stamp_column;
                let start = row * canvas.width + meeting.columns.start;
                let weights = &table[from..from + width];
                for (sum, &weight) in sums[start..start + width].iter_mut().zip(weights) {
                    *sum += Sum::splat(weight) * colour;
                }
            }
        }
    }
}

/// The same where more discs lie on a pixel than a sum of single precision holds: in integers.
fn crowded_band(canvas: &mut Canvas<'_>, pieces: &[Piece], stamp: &Stamp, background: Rgb) {
    let mut sums = vec![[0_u64; 4]; canvas.width * canvas.height];
    for disc in pieces.iter().flat_map(|piece| piece.of(canvas.band)) {
        let [r, g, b] = disc.colour.channels().map(u64::from);
        let table = stamp.coverage(disc.x, disc.y);
        let meeting = canvas.meet(disc, stamp);
        let width = meeting.columns.len();
        for (k, row) in meeting.rows.enumerate() {
            let from = (meeting.stamp_row + k) * stamp.size() + meeting.stamp_column;
            let start = row * canvas.width + meeting.columns.start;
            let coverage = &table[from..from + width];
            for (sum, &c) in sums[start..start + width].iter_mut().zip(coverage) {
                for (sum, colour) in sum.iter_mut().zip([r, g, b, 1]) {
                    *sum += u64::from(c) * colour;
                }
            }
        }
    }
    let width = canvas.width;
    for (row, sums) in sums.chunks(width).enumerate() {
        for (pixel, &[r, g, b, weight]) in canvas.row(row).iter_mut().zip(sums) {
            *pixel = background.0;
            if weight > 0 {
                let mean = |sum: u64| ((sum + weight / 2) / weight) as u8;
                let colour = Rgb::of([mean(r), mean(g), mean(b)]);
                *pixel = background.mix(colour, weight.min(255) as u8).0;
            }
        }
    }
}

/// Balls, one over the other, from the nearest to the farthest: a ball behind others costs
/// a look at the pixels that they have covered.
pub(crate) fn deep_band(canvas: &mut Canvas<'_>, pieces: &[Piece], stamps: &[Stamp]) {
    /// Bits of a channel in a sum; a sum of weights is at most 255, one of colours 255².
    const LANE: u32 = 21;
    let canvas_width = canvas.width;
    // How much of a pixel is still to be seen through, of 255, and the colours before that.
    let (mut sums, mut clear) = DEEP.take();
    clear.clear();
    clear.resize(canvas_width * canvas.height, 255);
    sums.clear();
    sums.resize(clear.len(), 0);
    let nearest = pieces.iter().rev();
    for disc in nearest.flat_map(|piece| piece.of(canvas.band).iter().rev()) {
        let stamp = &stamps[usize::from(disc.stamp)];
        let meeting = canvas.meet(disc, stamp);
        let width = meeting.columns.len();
        let (table, light) = (stamp.coverage(disc.x, disc.y), stamp.shade(disc.x, disc.y));
        for (k, row) in meeting.rows.enumerate() {
            let from = (meeting.stamp_row + k) * stamp.size() + meeting.stamp_column;
            let coverage = &table[from..from + width];
            let shade = &light[from..from + width];
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
    DEEP.set((sums, clear));
}
