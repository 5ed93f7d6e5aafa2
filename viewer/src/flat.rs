//! Discs of the plane, all of one radius.
//!
//! With the coverages w of a pixel by the discs on it, of colours c, and full coverage w₁, the
//! pixel on a ground of colour g has the colour
//!
//! (Σ w c + (w₁ - Σ w) g) / w₁ up to Σ w = w₁, and Σ w c / Σ w above,
//!
//! rounded to the nearest. All are whole numbers, so that no order of the discs matters, and discs
//! that share an edge leave no seam.
//!
//! The sums of red, green, blue and coverage have 16 bits each and share a word: they hold
//! 255 Σ w for Σ w up to 257. w₁ is chosen to leave room for [`ROOM`] times as many discs as lie
//! on a pixel while particles keep their spacing; where more do, the band is drawn again with
//! wider sums.

use crate::bands::{self, Canvas, DiscBatch};
use crate::colour::Rgb;
use crate::stamp::{PARTS, Stamp};
use crate::wide::wide;
use std::cell::Cell;

/// Discs on a pixel that there is room for, in those of particles at rest.
const ROOM: f64 = 2.5;

/// The largest Σ w with which no sum leaves its 16 bits.
const MOST: u32 = 257;

/// Fewest and most steps of a coverage.
const STEPS: [f64; 2] = [4.0, 85.0];

/// Columns of a tile: where no disc lies on a tile, no sum is looked at.
const TILE: usize = 16;

/// A disc to be drawn on a band.
#[derive(Clone, Copy)]
pub(crate) struct Dot {
    /// First column in the rectangle, and first row in the band plus [`Dot::ROW`] in the lowest
    /// bits.
    corner: i32,
    /// Place within a pixel and colour.
    look: u32,
}

impl Dot {
    /// Bits of the row.
    const BITS: u32 = 10;
    /// The largest disc begins so many rows above the band.
    const ROW: i32 = 512;

    #[inline]
    fn column(self) -> i32 {
        self.corner >> Self::BITS
    }

    #[inline]
    fn row(self) -> i32 {
        (self.corner & ((1 << Self::BITS) - 1)) - Self::ROW
    }

    #[inline]
    fn place(self) -> usize {
        (self.look >> 24) as usize
    }

    #[inline]
    fn colour(self) -> Rgb {
        Rgb(self.look & 0xff_ffff)
    }
}

/// What is drawn: a disc of one radius, at every place within a pixel that is told apart.
pub(crate) struct Brush {
    /// Pixels on either side of the one with the centre.
    half: i32,
    /// Pixels of a row.
    size: usize,
    /// Places per axis.
    places: i32,
    /// w₁.
    full: u32,
    /// Coverages in parts of w₁ by places, rows and columns.
    weights: Vec<u8>,
}

impl Brush {
    /// A disc of `radius` pixels, of which `overlap` lie on a pixel where particles keep their
    /// spacing.
    pub fn new(radius: f64, overlap: f64) -> Self {
        let stamp = Stamp::new(radius, false);
        let [least, most] = STEPS;
        let full = (f64::from(MOST) / (ROOM * overlap)).clamp(least, most) as u32;
        let level = |c: &u8| ((u32::from(*c) * full + 127) / 255) as u8;
        Self {
            half: stamp.half,
            size: stamp.size(),
            places: stamp.places,
            full,
            weights: stamp.table().iter().map(level).collect(),
        }
    }

    /// Lays a disc with its centre at `x`, `y` (in [`PARTS`] of a pixel) in a rectangle of so many
    /// columns out by bands.
    #[inline(always)]
    pub fn lay(&self, piece: &mut DiscBatch<Dot>, width: usize, x: i32, y: i32, colour: Rgb) {
        let column = x.div_euclid(PARTS) - self.half;
        let row = y.div_euclid(PARTS) - self.half;
        if column >= width as i32 || column + self.size as i32 <= 0 {
            return;
        }
        let place = |p: i32| p.rem_euclid(PARTS) * self.places / PARTS;
        let place = (place(y) * self.places + place(x)) as u32;
        let look = place << 24 | colour.0;
        bands::of_rows(row, self.size as i32, piece.bands.len(), |band| {
            let row = row - bands::top(band) + Dot::ROW;
            let corner = column << Dot::BITS | row;
            piece.bands[band].push(Dot { corner, look });
        });
    }

    /// Coverages of a disc, row by row.
    #[inline]
    fn weights(&self, dot: Dot) -> &[u8] {
        let pixels = self.size * self.size;
        &self.weights[dot.place() * pixels..][..pixels]
    }
}

/// Sums of a pixel in a word: coverage, red, green, blue, 16 bits each, from the highest.
#[inline]
fn word(colour: Rgb) -> u64 {
    let c = u64::from(colour.0);
    1 << 48 | (c & 0xff_0000) << 16 | (c & 0xff00) << 8 | c & 0xff
}

thread_local! {
    /// The sums of a band, all of them 0: bands and pictures follow one another in the same memory,
    /// which stays in the cache. And how many discs lie on a tile.
    static SUMS: Cell<(Vec<u64>, Vec<u32>)> = const { Cell::new((Vec::new(), Vec::new())) };
}

/// Draws the background, and on it the discs.
pub(crate) fn draw(canvas: &mut Canvas<'_>, pieces: &[DiscBatch<Dot>], brush: &Brush, ground: Rgb) {
    let sparse = wide(
        #[inline(always)]
        || draw_sparse(canvas, pieces, brush, ground),
    );
    if !sparse {
        draw_crowd(canvas, pieces, brush, ground);
    }
}

/// The same; false where more discs lie on a pixel than there is room for.
#[inline(always)]
fn draw_sparse(
    canvas: &mut Canvas<'_>,
    pieces: &[DiscBatch<Dot>],
    brush: &Brush,
    ground: Rgb,
) -> bool {
    let (mut sums, mut tiles) = SUMS.take();
    tiles.clear();
    tiles.resize(canvas.width.div_ceil(TILE), 0);
    let stride = TILE * tiles.len();
    let size = stride * canvas.height;
    if sums.len() < size {
        sums.resize(size, 0);
    }
    let discs = || pieces.iter().flat_map(|piece| &piece.bands[canvas.band]);
    let mut band = ColourSums {
        sums: &mut sums[..size],
        tiles: &mut tiles,
        stride,
        canvas,
        brush,
    };
    // Small discs are the many ones.
    match brush.size {
        3 => band.add_all::<3>(discs()),
        5 => band.add_all::<5>(discs()),
        7 => band.add_all::<7>(discs()),
        _ => discs().for_each(|&disc| band.add(disc)),
    }
    let (mut most, mut deepest) = (0, 0);
    for row in 0..canvas.height {
        let sums = &mut sums[row * stride..][..stride];
        let sums = sums.as_chunks_mut::<TILE>().0.iter_mut();
        let pixels = canvas.row(row).chunks_mut(TILE);
        for ((pixels, sums), &discs) in pixels.zip(sums).zip(&tiles) {
            if discs == 0 {
                pixels.fill(ground.0);
                continue;
            }
            deepest = deepest.max(discs);
            most = most.max(resolve(
                std::mem::replace(sums, [0; TILE]),
                pixels,
                brush.full,
                ground,
            ));
        }
    }
    SUMS.set((sums, tiles));
    // Fewer discs leave the sum of coverages in its own 16 bits, and so tell whether the others
    // are.
    most <= MOST && u64::from(deepest) * u64::from(brush.full) < 0xffff
}

/// The colours of the pixels of a tile; returns the largest Σ w. Beyond [`MOST`] whatever comes out
/// is drawn again.
#[inline(always)]
fn resolve(sums: [u64; TILE], pixels: &mut [u32], full: u32, ground: Rgb) -> u32 {
    let weights = sums.map(|sums| (sums >> 48) as u32);
    let whole = weights.map(|weight| weight.max(full));
    // Single divisions are rounded alike everywhere.
    let inverse = whole.map(|whole| 1.0 / whole as i32 as f32);
    let mut colours = [0; TILE];
    for (shift, ground) in [32, 16, 0].into_iter().zip(ground.channels()) {
        for k in 0..TILE {
            let rest = u32::from(ground) * (whole[k] - weights[k]);
            let sum = ((sums[k] >> shift) & 0xffff) as u32 + rest;
            // Added to 2^23 a number is rounded to a whole one, which stands in its last bits then.
            let mean = sum as i32 as f32 * inverse[k] + 8_388_608.0;
            colours[k] = colours[k] << 8 | mean.to_bits() & 0xff;
        }
    }
    pixels.copy_from_slice(&colours[..pixels.len()]);
    weights.into_iter().max().unwrap_or(0)
}

/// The sums of a band.
struct ColourSums<'a, 'b> {
    sums: &'a mut [u64],
    /// Discs on a tile.
    tiles: &'a mut [u32],
    /// Sums of a row: whole tiles.
    stride: usize,
    canvas: &'a Canvas<'b>,
    brush: &'a Brush,
}

impl ColourSums<'_, '_> {
    /// Adds discs of `SIZE` pixels.
    #[inline(always)]
    fn add_all<'d, const SIZE: usize>(&mut self, discs: impl Iterator<Item = &'d Dot>) {
        let (width, height, stride) = (self.canvas.width, self.canvas.height, self.stride);
        for &disc in discs {
            let column = disc.column() as usize;
            if column.saturating_add(SIZE) > width {
                // It begins before the first column, or ends behind the last.
                self.add(disc);
                continue;
            }
            let (first, last) = (column / TILE, (column + SIZE - 1) / TILE);
            self.tiles[first] += 1;
            if last > first {
                self.tiles[last] += 1;
            }
            let colour = word(disc.colour());
            let weights = self.brush.weights(disc);
            for (k, weights) in weights.as_chunks::<SIZE>().0.iter().enumerate() {
                let row = (disc.row() + k as i32) as usize;
                if row >= height {
                    continue;
                }
                let start = row * stride + column;
                for (sum, &weight) in self.sums[start..start + SIZE].iter_mut().zip(weights) {
                    *sum = sum.wrapping_add(u64::from(weight) * colour);
                }
            }
        }
    }

    /// Adds a disc of any size, wherever it is.
    fn add(&mut self, disc: Dot) {
        let size = self.brush.size;
        let Some(meeting) = self.canvas.meet(disc.column(), disc.row(), size) else {
            return;
        };
        let columns = meeting.columns;
        for tile in &mut self.tiles[columns.start / TILE..=(columns.end - 1) / TILE] {
            *tile += 1;
        }
        let colour = word(disc.colour());
        let weights = self.brush.weights(disc);
        for (k, row) in meeting.rows.enumerate() {
            let from = (meeting.disc_row + k) * size + meeting.disc_column;
            let sums = &mut self.sums[row * self.stride..][columns.clone()];
            for (sum, &weight) in sums.iter_mut().zip(&weights[from..]) {
                *sum = sum.wrapping_add(u64::from(weight) * colour);
            }
        }
    }
}

/// The same where more discs lie on a pixel than sums of 16 bits hold.
fn draw_crowd(canvas: &mut Canvas<'_>, pieces: &[DiscBatch<Dot>], brush: &Brush, ground: Rgb) {
    let width = canvas.width;
    let mut sums = vec![[0_u64; 4]; width * canvas.height];
    for disc in pieces.iter().flat_map(|piece| &piece.bands[canvas.band]) {
        let [r, g, b] = disc.colour().channels().map(u64::from);
        let weights = brush.weights(*disc);
        let Some(meeting) = canvas.meet(disc.column(), disc.row(), brush.size) else {
            continue;
        };
        for (k, row) in meeting.rows.enumerate() {
            let from = (meeting.disc_row + k) * brush.size + meeting.disc_column;
            let line = &mut sums[row * width..][meeting.columns.clone()];
            for (sums, &weight) in line.iter_mut().zip(&weights[from..]) {
                for (sum, c) in sums.iter_mut().zip([r, g, b, 1]) {
                    *sum += u64::from(weight) * c;
                }
            }
        }
    }
    for (row, sums) in sums.chunks(width).enumerate() {
        for (pixel, &[r, g, b, weight]) in canvas.row(row).iter_mut().zip(sums) {
            if weight <= u64::from(MOST) {
                // As it is everywhere else.
                let mut tile = [0; TILE];
                tile[0] = weight << 48 | r << 32 | g << 16 | b;
                resolve(tile, std::slice::from_mut(pixel), brush.full, ground);
            } else {
                let mean = |sum: u64| ((sum + weight / 2) / weight) as u8;
                *pixel = Rgb::of([mean(r), mean(g), mean(b)]).0;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;
    use proptest::prelude::*;

    const SIZE: (usize, usize) = (70, 40);

    /// Draws discs in a picture, by the sums of 16 bits or the wide ones alone.
    fn drawn(brush: &Brush, discs: &[(i32, i32, u32)], wide: bool) -> Raster {
        let (width, height) = SIZE;
        let mut piece = DiscBatch::default();
        piece.clear(bands::count(height));
        for &(x, y, colour) in discs {
            brush.lay(&mut piece, width, x, y, Rgb(colour));
        }
        let ground = Rgb(0x10_2030);
        let mut raster = Raster::new(width, height, Rgb(0xff_00ff));
        let rect = raster.rect();
        bands::draw_bands(&mut raster.draw(), rect, |canvas| {
            let pieces = std::slice::from_ref(&piece);
            match wide {
                true => draw_crowd(canvas, pieces, brush, ground),
                false => draw(canvas, pieces, brush, ground),
            }
        });
        raster
    }

    proptest! {
        #[test]
        fn narrow_sums_draw_what_wide_ones_do(
            radius in prop_oneof![0.5..4.0, 4.0..20.0],
            overlap in 0.5..40.0,
            discs in prop::collection::vec((-200..800, -200..500, 0_u32..1 << 24), 0..300),
        ) {
            let brush = Brush::new(radius, overlap);
            let narrow = drawn(&brush, &discs, false);
            prop_assert!(narrow == drawn(&brush, &discs, true));
        }
    }

    #[test]
    fn a_disc_alone_has_its_area() {
        for radius in [0.5, 0.98, 1.7, 2.9, 5.0, 17.0] {
            let brush = Brush::new(radius, 1.0);
            for place in 0..64 {
                let (x, y) = (8 * 35 + place % 8, 8 * 20 + place / 8);
                let raster = drawn(&brush, &[(x, y, 0x10_20ff)], false);
                let ground = f64::from(0x30);
                let light = |p: &u32| (f64::from(p & 0xff) - ground) / (255.0 - ground);
                let area: f64 = raster.pixels().iter().map(light).sum();
                let expected = std::f64::consts::PI * radius * radius;
                // A coverage is rounded to 1/85 or better on each pixel of the edge.
                let permitted = 0.03 * (4.0 * radius + 4.0);
                assert!((area - expected).abs() < permitted, "{radius}: {area}");
            }
        }
    }

    #[test]
    fn the_smallest_disc_is_seen_in_any_crowd() {
        let brush = Brush::new(0.5, 1e6);
        for place in 0..64 {
            let raster = drawn(
                &brush,
                &[(80 + place % 8, 80 + place / 8, 0xff_ffff)],
                false,
            );
            assert!(raster.pixels().iter().any(|&p| p != 0x10_2030), "{place}");
        }
    }
}
