//! Neighbours by counting sort into square cells, on lent memory.
//!
//! The cells tile a torus: cell (cx, cy, …) of the plane goes to bucket (cx mod nx, cy mod ny, …).
//! Two particles closer than the reach lie in the same or in adjacent cells, hence in the same or
//! in adjacent buckets, and with at least three buckets along each axis the 3^D buckets around a
//! particle are distinct, so no pair is met twice. Particles that share a bucket from far away are
//! rejected by their distance like any other candidate. So the memory is fixed when the grid is
//! made, and one particle that flies off costs nothing.
//!
//! Which candidates are met, and in which order, changes no bit of a fixed-point state.

use crate::number::Quantity;

/// Geometry of the torus of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid<const D: usize> {
    /// Edge of a cell in length quanta, a little larger than the reach.
    cell: i64,
    /// Buckets along each axis, at least 3.
    count: [i64; D],
}

impl<const D: usize> Grid<D> {
    /// Cells for pairs closer than `reach` quanta. `extent` is the size in quanta of the region
    /// where particles are expected; at most `max_buckets` (but at least 3^D) buckets are used.
    #[must_use]
    pub fn new(reach: i64, extent: [i64; D], max_buckets: usize) -> Self {
        let cell = reach + 2;
        let mut count = extent.map(|e| (e / cell + 1).max(3));
        let budget = i64::try_from(max_buckets).unwrap_or(i64::MAX);
        loop {
            let product = count.iter().fold(1i64, |p, &c| p.saturating_mul(c));
            let widest = (0..D).max_by_key(|&d| count[d]).unwrap_or(0);
            if product <= budget || count[widest] == 3 {
                return Self { cell, count };
            }
            count[widest] = (count[widest] / 2).max(3);
        }
    }

    /// The reach, in quanta, rounded up.
    #[must_use]
    pub fn reach(&self) -> i64 {
        self.cell - 1
    }

    /// Number of buckets.
    #[must_use]
    pub fn buckets(&self) -> usize {
        self.count.iter().product::<i64>() as usize
    }

    #[inline]
    fn cell_of<Q: Quantity>(&self, x: &[Q; D]) -> [i64; D] {
        x.map(|x| x.cell(self.cell))
    }

    /// The cell's place on the torus.
    #[inline]
    fn wrapped(&self, cell: &[i64; D]) -> [i64; D] {
        core::array::from_fn(|d| cell[d].rem_euclid(self.count[d]))
    }

    /// The place `offset` (-1, 0 or 1) further along axis d: no division.
    #[inline]
    fn step(&self, d: usize, place: i64, offset: i64) -> i64 {
        let next = place + offset;
        if next < 0 {
            next + self.count[d]
        } else if next >= self.count[d] {
            next - self.count[d]
        } else {
            next
        }
    }

    #[inline]
    fn bucket<Q: Quantity>(&self, x: &[Q; D]) -> usize {
        let place = self.wrapped(&self.cell_of(x));
        let mut index = 0;
        for d in (0..D).rev() {
            index = index * self.count[d] + place[d];
        }
        index as usize
    }
}

/// Particle indices sorted by bucket; the memory is lent.
#[derive(Debug)]
pub struct Cells<'a> {
    /// `start[b]..start[b + 1]` are the places of bucket b in `order`; one longer than buckets.
    pub start: &'a mut [u32],
    /// Particle indices, bucket after bucket.
    pub order: &'a mut [u32],
}

impl<'a> Cells<'a> {
    /// A read-only view that keeps the memory for as long as it was lent.
    #[must_use]
    pub fn into_view(self) -> CellsView<'a> {
        CellsView {
            start: self.start,
            order: self.order,
        }
    }

    /// Sorts the particles at `position`. `start` must have `grid.buckets() + 1` elements and
    /// `order` as many as there are particles.
    pub fn sort<Q: Quantity, const D: usize>(&mut self, grid: &Grid<D>, position: &[[Q; D]]) {
        self.start.fill(0);
        for x in position {
            self.start[grid.bucket(x)] += 1;
        }
        // Each count becomes the end of its bucket; filling from the back leaves the start there.
        let mut end = 0;
        for s in self.start.iter_mut() {
            end += *s;
            *s = end;
        }
        for (i, x) in position.iter().enumerate().rev() {
            let place = &mut self.start[grid.bucket(x)];
            *place -= 1;
            self.order[*place as usize] = i as u32;
        }
    }

    /// A read-only view.
    #[must_use]
    pub fn view(&self) -> CellsView<'_> {
        CellsView {
            start: self.start,
            order: self.order,
        }
    }
}

/// Sorted cells, to be read.
#[derive(Clone, Copy, Debug)]
pub struct CellsView<'a> {
    start: &'a [u32],
    order: &'a [u32],
}

impl<'a> CellsView<'a> {
    /// Calls `visit` with runs of candidate indices that together hold every particle of the
    /// sorted set within reach of `x` exactly once (and others).
    #[inline]
    pub fn around<Q: Quantity, const D: usize>(
        &self,
        grid: &Grid<D>,
        x: &[Q; D],
        mut visit: impl FnMut(&'a [u32]),
    ) {
        let home = grid.wrapped(&grid.cell_of(x));
        let rows = 3usize.pow(D as u32 - 1);
        for row in 0..rows {
            // The row of buckets at offsets -1, 0, 1 along every axis but the first.
            let mut first = 0;
            let mut rest = row;
            let mut stride = grid.count[0];
            for (d, &place) in home.iter().enumerate().skip(1) {
                let c = grid.step(d, place, (rest % 3) as i64 - 1);
                rest /= 3;
                first += c * stride;
                stride *= grid.count[d];
            }
            let range = |c: i64| self.bucket_range((first + c) as usize);
            let left = range(grid.step(0, home[0], -1));
            let middle = range(home[0]);
            let right = range(grid.step(0, home[0], 1));
            if left.1 == middle.0 && middle.1 == right.0 {
                visit(&self.order[left.0..right.1]);
            } else {
                visit(&self.order[left.0..left.1]);
                visit(&self.order[middle.0..middle.1]);
                visit(&self.order[right.0..right.1]);
            }
        }
    }

    #[inline]
    fn bucket_range(&self, b: usize) -> (usize, usize) {
        (self.start[b] as usize, self.start[b + 1] as usize)
    }
}
