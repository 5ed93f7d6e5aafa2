//! Balls in space, one over the other.

use crate::bands::{self, Canvas, DiscBatch};
use crate::colour::Rgb;
use crate::stamp::{PARTS, Stamp};
use std::cell::Cell;

/// A ball to be drawn.
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

impl Disc {
    /// Lays it out by bands, where it lies on a rectangle of so many columns.
    pub fn lay(self, piece: &mut DiscBatch<Self>, width: usize, stamp: &Stamp) {
        let column = self.x.div_euclid(PARTS) - stamp.half;
        if column >= width as i32 || column + stamp.size() as i32 <= 0 {
            return;
        }
        let row = self.y.div_euclid(PARTS) - stamp.half;
        bands::of_rows(row, stamp.size() as i32, piece.bands.len(), |band| {
            piece.bands[band].push(self);
        });
    }
}

thread_local! {
    static SUMS: Cell<(Vec<u64>, Vec<u8>)> = const { Cell::new((Vec::new(), Vec::new())) };
}

/// Draws balls from the nearest to the farthest, so that a pixel that is fully covered is not mixed
/// again.
pub(crate) fn draw(canvas: &mut Canvas<'_>, pieces: &[DiscBatch<Disc>], stamps: &[Stamp]) {
    /// Bits of a channel in a sum; a sum of weights is at most 255, one of colours 255².
    const LANE: u32 = 21;
    let canvas_width = canvas.width;
    // How much of a pixel is still to be seen through, of 255, and the colours before that.
    let (mut sums, mut clear) = SUMS.take();
    clear.clear();
    clear.resize(canvas_width * canvas.height, 255);
    sums.clear();
    sums.resize(clear.len(), 0);
    let nearest = pieces.iter().rev();
    for disc in nearest.flat_map(|piece| piece.bands[canvas.band].iter().rev()) {
        let stamp = &stamps[usize::from(disc.stamp)];
        let column = disc.x.div_euclid(PARTS) - stamp.half;
        let row = disc.y.div_euclid(PARTS) - stamp.half - bands::top(canvas.band);
        let Some(meeting) = canvas.meet(column, row, stamp.size()) else {
            continue;
        };
        let width = meeting.columns.len();
        let (table, light) = (stamp.coverage(disc.x, disc.y), stamp.shade(disc.x, disc.y));
        for (k, row) in meeting.rows.enumerate() {
            let from = (meeting.disc_row + k) * stamp.size() + meeting.disc_column;
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
    SUMS.set((sums, clear));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;
    use proptest::prelude::*;

    /// Columns and rows around the picture, more than a disc of the tests reaches.
    const AROUND: usize = 128;
    const SIZE: [usize; 2] = [70, 40];

    /// Draws balls in a picture of this size, moved by so many pixels to the right and down.
    fn drawn(
        balls: &[(i32, i32, u32)],
        stamp: &Stamp,
        [width, height]: [usize; 2],
        by: usize,
    ) -> Raster {
        let mut piece = DiscBatch::default();
        piece.clear(bands::count(height));
        let by = by as i32 * PARTS;
        for &(x, y, colour) in balls {
            let disc = Disc {
                x: x.saturating_add(by),
                y: y.saturating_add(by),
                colour: Rgb(colour),
                stamp: 0,
                weight: 255,
            };
            disc.lay(&mut piece, width, stamp);
        }
        let mut raster = Raster::new(width, height, Rgb(0x10_2030));
        let rect = raster.rect();
        bands::draw_bands(&mut raster.draw(), rect, |canvas| {
            let stamps = std::slice::from_ref(stamp);
            draw(canvas, std::slice::from_ref(&piece), stamps);
        });
        raster
    }

    proptest! {
        #[test]
        fn a_picture_is_the_part_of_a_larger_one(
            radius in 0.5..20.0,
            balls in prop::collection::vec((-300..900, -300..700, 0_u32..1 << 24), 0..100),
        ) {
            let stamp = Stamp::new(radius, true);
            let small = drawn(&balls, &stamp, SIZE, 0);
            let large = drawn(&balls, &stamp, SIZE.map(|s| s + 2 * AROUND), AROUND);
            let width = SIZE[0] + 2 * AROUND;
            for (row, pixels) in small.pixels().chunks(SIZE[0]).enumerate() {
                let start = (row + AROUND) * width + AROUND;
                prop_assert!(pixels == &large.pixels()[start..start + SIZE[0]], "row {}", row);
            }
        }

        #[test]
        fn a_ball_may_be_anywhere(
            radius in 0.5..300.0,
            balls in prop::collection::vec((any::<i32>(), any::<i32>(), 0_u32..1 << 24), 0..20),
        ) {
            drawn(&balls, &Stamp::new(radius, true), SIZE, 0);
        }
    }
}
