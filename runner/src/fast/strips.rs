//! The layout: particles in strips, sorted along the first axis.
//!
//! Strips run along x. Their height along the other axes is h + skin, so that a particle's neighbours
//! lie in its own strip and in those beside it. Within a strip particles are sorted into x-cells of
//! about h/8; the particles of a cell share the *windows* in which their neighbours can be. Strips
//! begin at multiples of the widest row and are filled up with particles far away, so that whole
//! rows can be read and added to.
//!
//! The layout outlives the step: it is made anew when twice the largest displacement since it was
//! made exceeds the skin. Particles outside the box that the strips cover are kept in the outermost
//! strips and cells: the clamping is monotone, neighbours stay neighbours. None of this can
//! change a bit, since sums of integers do not depend on who meets whom when.

use loschmidt_core::Arithmetic;
use loschmidt_core::number::Quantity;
use std::ops::Range;

/// Widest row, in particles.
pub(super) const WIDEST: usize = 8;
/// Skin over the reach.
const SKIN: f64 = 0.1;
/// x-cells per reach.
const CELLS: f64 = 8.0;
/// Where the particles that fill up a strip are: beyond every range of the state (2^51 quanta).
const FAR: f64 = (1u64 << 60) as f64;
/// No particle.
pub(super) const NOBODY: u32 = u32::MAX;

/// Strips and what is in them.
#[derive(Debug, Default)]
pub(super) struct Strips {
    reach: f64,
    skin: f64,
    origin: [f64; 3],
    height: f64,
    cell: f64,
    /// Cells along x.
    pub columns: usize,
    /// Strips along y and z.
    count: [usize; 2],
    /// First slot of each cell, strip after strip, `columns + 1` of them for each strip; the last is
    /// where the strip's particles end.
    cell_start: Vec<u32>,
    /// First slot of each strip, one more at the end.
    strip_start: Vec<u32>,
    /// Particle in each slot.
    pub order: Vec<u32>,
    /// Slot of each particle.
    pub slot: Vec<u32>,
    /// Coordinates by slot.
    pub x: [Vec<f64>; 3],
    /// Coordinates by slot when the layout was made.
    made_at: [Vec<f64>; 3],
    /// Most candidates that one particle meets.
    pub most_candidates: usize,
}

impl Strips {
    /// Brings the layout up to date with these positions.
    pub fn update<A: Arithmetic, const D: usize>(
        &mut self,
        reach: f64,
        position: &[[A::Length; D]],
    ) {
        let same =
            self.slot.len() == position.len() && self.reach == reach && !self.x[D - 1].is_empty();
        if same && self.follow::<A, D>(position) {
            return;
        }
        self.build::<A, D>(reach, position);
    }

    /// Copies the positions into their slots; false where the layout has become too old.
    fn follow<A: Arithmetic, const D: usize>(&mut self, position: &[[A::Length; D]]) -> bool {
        let mut largest = 0.0f64;
        let columns = self.x.iter_mut().zip(&self.made_at).take(D);
        for (d, (x, made_at)) in columns.enumerate() {
            for ((&place, x), made_at) in self.order.iter().zip(x).zip(made_at) {
                if place != NOBODY {
                    *x = position[place as usize][d].quanta();
                    largest = largest.max((*x - made_at).abs());
                }
            }
        }
        2.0 * largest * (D as f64).sqrt() <= self.skin
    }

    fn build<A: Arithmetic, const D: usize>(&mut self, reach: f64, position: &[[A::Length; D]]) {
        self.cover::<A, D>(reach, position);
        let strips = self.count[0] * self.count[1];
        let cells = self.columns + 1;
        // Count, with the extra cell of each strip left empty for now.
        let keys: Vec<u32> = position
            .iter()
            .map(|x| {
                let x = x.map(Quantity::quanta::<f64>);
                (self.strip_of(&x) * cells + self.column_of(x[0])) as u32
            })
            .collect();
        self.cell_start.clear();
        self.cell_start.resize(strips * cells, 0);
        for &key in &keys {
            self.cell_start[key as usize] += 1;
        }
        self.strip_start.clear();
        let mut slot = 0u32;
        for strip in 0..strips {
            self.strip_start.push(slot);
            for start in &mut self.cell_start[strip * cells..(strip + 1) * cells] {
                let count = *start;
                *start = slot;
                slot += count;
            }
            slot = slot.next_multiple_of(WIDEST as u32);
        }
        self.strip_start.push(slot);
        let slots = slot as usize;
        self.order.clear();
        self.order.resize(slots, NOBODY);
        self.slot.resize(position.len(), 0);
        let mut next = self.cell_start.clone();
        for (place, &key) in keys.iter().enumerate() {
            let slot = &mut next[key as usize];
            self.order[*slot as usize] = place as u32;
            self.slot[place] = *slot;
            *slot += 1;
        }
        let columns = self.x.iter_mut().zip(&mut self.made_at).take(D);
        for (d, (x, made_at)) in columns.enumerate() {
            x.clear();
            x.extend(self.order.iter().map(|&place| match place {
                NOBODY => FAR,
                place => position[place as usize][d].quanta(),
            }));
            made_at.clone_from(x);
        }
        self.most_candidates = self.count_candidates::<D>();
    }

    /// Chooses the box that the strips cover and the sizes of strips and cells.
    fn cover<A: Arithmetic, const D: usize>(&mut self, reach: f64, position: &[[A::Length; D]]) {
        let n = position.len().max(1) as f64;
        self.reach = reach;
        self.skin = SKIN * reach;
        self.height = reach + self.skin;
        let mut extent = [0.0f64; 3];
        let axes = extent.iter_mut().zip(&mut self.origin).take(D);
        for (d, (extent, origin)) in axes.enumerate() {
            let (low, high) = interval(position.iter().map(|x| x[d].quanta()), self.height);
            *origin = low;
            *extent = (high - low).max(0.0);
        }
        // At most as many strips as particles, at most four cells for each.
        let most = n;
        let strips = |d: usize| (extent[d] / self.height) as usize + 1;
        self.count = [strips(1), if D == 3 { strips(2) } else { 1 }];
        while (self.count[0] * self.count[1]) as f64 > most && self.count != [1, 1] {
            let widest = usize::from(self.count[1] > self.count[0]);
            self.count[widest] = self.count[widest].div_ceil(2);
        }
        let strips = (self.count[0] * self.count[1]) as f64;
        let columns = (extent[0] / (reach / CELLS) + 1.0).min(4.0 * n / strips + 1.0);
        self.columns = (columns as usize).max(1);
        self.cell = (extent[0] / self.columns as f64).max(reach / CELLS);
    }

    /// The strip that holds x.
    fn strip_of<const D: usize>(&self, x: &[f64; D]) -> usize {
        let mut strip = 0;
        for d in (1..D).rev() {
            // The cast saturates: what lies below is in strip 0.
            let s = ((x[d] - self.origin[d]) / self.height) as usize;
            strip = strip * self.count[0] + s.min(self.count[d - 1] - 1);
        }
        strip
    }

    fn column_of(&self, x: f64) -> usize {
        (((x - self.origin[0]) / self.cell) as usize).min(self.columns - 1)
    }

    /// Number of strips.
    pub fn strips(&self) -> usize {
        self.count[0] * self.count[1]
    }

    /// Number of slots.
    pub fn slots(&self) -> usize {
        self.order.len()
    }

    /// Slots of these strips, filling included.
    pub fn slots_of(&self, strips: Range<usize>) -> Range<usize> {
        self.strip_start[strips.start] as usize..self.strip_start[strips.end] as usize
    }

    /// Slots of a cell.
    pub fn cell(&self, strip: usize, column: usize) -> Range<usize> {
        self.window(strip, column, column)
    }

    /// Slots of the cells from `first` to `last` of a strip.
    fn window(&self, strip: usize, first: usize, last: usize) -> Range<usize> {
        let row = strip * (self.columns + 1);
        self.cell_start[row + first] as usize..self.cell_start[row + last + 1] as usize
    }

    /// Slots of a strip in which the neighbours of a column's particles are.
    pub fn around(&self, strip: usize, column: usize) -> Range<usize> {
        // One more for the place of the particle within its cell.
        let far = ((self.reach + self.skin) / self.cell) as usize + 1;
        let first = column.saturating_sub(far);
        let last = (column + far).min(self.columns - 1);
        self.window(strip, first, last)
    }

    /// The strips beside a strip that come after it, each pair of strips once.
    pub fn forward<const D: usize>(&self, strip: usize) -> impl Iterator<Item = usize> {
        let [ny, nz] = self.count;
        let (y, z) = ((strip % ny) as isize, (strip / ny) as isize);
        let offsets: &[(isize, isize)] = if D == 2 {
            &[(1, 0)]
        } else {
            &[(1, 0), (-1, 1), (0, 1), (1, 1)]
        };
        offsets.iter().filter_map(move |(dy, dz)| {
            let (y, z) = (y + dy, z + dz);
            let inside = y >= 0 && (y as usize) < ny && (z as usize) < nz;
            inside.then_some(z as usize * ny + y as usize)
        })
    }

    /// How much further on than itself the strips beside a strip can be.
    pub fn farthest_forward<const D: usize>(&self) -> usize {
        if D == 2 { 1 } else { self.count[0] + 1 }
    }

    fn count_candidates<const D: usize>(&self) -> usize {
        let strips = self.strips();
        let mut most = 0;
        let [ny, nz] = self.count;
        for strip in 0..strips {
            let (y, z) = (strip % ny, strip / ny);
            for column in 0..self.columns {
                if self.cell(strip, column).is_empty() {
                    continue;
                }
                let mut candidates = 0;
                for z in z.saturating_sub(1)..(z + 2).min(nz) {
                    for y in y.saturating_sub(1)..(y + 2).min(ny) {
                        candidates += self.around(z * ny + y, column).len();
                    }
                }
                most = most.max(candidates);
            }
        }
        most
    }
}

/// Where most of the values are: from the least to the greatest, but no farther than six standard
/// deviations and `margin` from the mean. A few particles that have flown far must not blow up the
/// box.
fn interval(values: impl Iterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut n, mut sum, mut squares) = (0.0f64, 0.0, 0.0);
    for x in values {
        low = low.min(x);
        high = high.max(x);
        n += 1.0;
        sum += x;
        squares += x * x;
    }
    let mean = sum / n.max(1.0);
    let spread = 6.0 * (squares / n.max(1.0) - mean * mean).max(0.0).sqrt() + margin;
    (low.max(mean - spread), high.min(mean + spread))
}
