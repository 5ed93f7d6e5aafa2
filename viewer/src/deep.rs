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
    /// Lays it out by bands.
    pub fn lay(self, piece: &mut DiscBatch<Self>, stamp: &Stamp) {
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
        let meeting = canvas.meet(column, row, stamp.size());
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
