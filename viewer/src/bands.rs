//! Discs on pixels, by many threads. The discs are cut into batches: one thread sorts those of a
//! batch by the bands that they lie on. The rows of a picture are cut into bands: one thread draws
//! all discs of a band.

use crate::raster::{Pixels, Rect};
use rayon::prelude::*;

/// Rows of a band.
const BAND: usize = 16;

/// How many bands a rectangle of so many rows has.
pub(crate) fn count(height: usize) -> usize {
    height.div_ceil(BAND)
}

/// First row of a band.
pub(crate) fn top(band: usize) -> i32 {
    (band * BAND) as i32
}

/// Calls `put` with the bands, of so many, that a disc with its first row at `row` has a part in.
#[inline(always)]
pub(crate) fn of_rows(row: i32, rows: i32, count: usize, mut put: impl FnMut(usize)) {
    let last = row + rows - 1;
    if last < 0 {
        return;
    }
    // Nearly all lie on one or two.
    let (first, last) = (row.max(0) as usize / BAND, last as usize / BAND);
    if first >= count {
        return;
    }
    put(first);
    for band in first + 1..(last + 1).min(count) {
        put(band);
    }
}

/// Some discs by bands, in the order they came in; a disc on two bands is there twice.
pub(crate) struct DiscBatch<Disc> {
    pub bands: Vec<Vec<Disc>>,
}

impl<Disc> Default for DiscBatch<Disc> {
    fn default() -> Self {
        Self { bands: Vec::new() }
    }
}

impl<Disc> DiscBatch<Disc> {
    /// Forgets the discs of an earlier picture, and takes those of one with so many bands.
    pub fn clear(&mut self, bands: usize) {
        self.bands.iter_mut().for_each(Vec::clear);
        self.bands.resize_with(bands, Vec::new);
    }
}

/// One band of a raster and the rectangle's place in it.
pub(crate) struct Canvas<'a> {
    pixels: &'a mut [u32],
    /// Pixels of a row of the raster.
    stride: usize,
    /// First column of the rectangle.
    left: usize,
    /// Number of columns of the rectangle.
    pub width: usize,
    /// Number of the band.
    pub band: usize,
    /// Its number of rows.
    pub height: usize,
}

/// Where a disc meets a canvas: rows and columns of the canvas, and the first of both in the disc.
pub(crate) struct Overlap {
    pub rows: std::ops::Range<usize>,
    pub columns: std::ops::Range<usize>,
    pub disc_row: usize,
    pub disc_column: usize,
}

impl Canvas<'_> {
    /// What of a square of `size` pixels lies on the canvas, if anything does. Its first column and
    /// row are counted from the top left of the canvas.
    #[inline]
    pub fn meet(&self, column: i32, row: i32, size: usize) -> Option<Overlap> {
        let part = |first: i32, width: usize| {
            let from = first.max(0);
            let to = first.saturating_add(size as i32).min(width as i32);
            (from < to).then(|| (from as usize..to as usize, (from - first) as usize))
        };
        let (rows, disc_row) = part(row, self.height)?;
        let (columns, disc_column) = part(column, self.width)?;
        Some(Overlap {
            rows,
            columns,
            disc_row,
            disc_column,
        })
    }

    /// The pixels of a row.
    pub fn row(&mut self, row: usize) -> &mut [u32] {
        let start = row * self.stride + self.left;
        &mut self.pixels[start..start + self.width]
    }
}

/// Draws into a rectangle, band by band.
pub(crate) fn draw_bands(
    raster: &mut Pixels<'_>,
    rect: Rect,
    draw: impl Fn(&mut Canvas<'_>) + Sync,
) {
    let stride = raster.width();
    let rows = &mut raster.all()[rect.y * stride..(rect.y + rect.height) * stride];
    rows.par_chunks_mut(BAND * stride)
        .enumerate()
        .for_each(|(band, pixels)| {
            draw(&mut Canvas {
                height: pixels.len() / stride,
                pixels,
                stride,
                left: rect.x,
                width: rect.width,
                band,
            });
        });
}
