//! The layout: particles in strips, sorted along the first axis, and who can meet whom.
//!
//! Strips run along x. Their height along the other axes is h + skin, so that a particle's neighbours
//! lie in its own strip and in those beside it. Within a strip particles are sorted into x-cells of
//! about h/8. The state itself is stored in this order; each strip begins a new *row* of four *slots*
//! and its last row is filled up with particles far away, so that whole rows can be read and added
//! to.
//!
//! For each particle, `meets` lists the rows that hold a particle within h + skin: those of its own
//! strip after its own row, and those of the strips that come after. Each pair is in one list.
//!
//! The layout outlives the step: it is made anew when twice the largest displacement since it was
//! made could exceed the skin. Particles outside the box that the strips cover are kept in the outermost
//! strips and cells: the clamping is monotone, neighbours stay neighbours. None of this can
//! change a bit, since sums of integers do not depend on who meets whom when.

use super::backend::{Backend, Work};
use super::lanes::{Quad, ROW, Reals};
use super::meets::{Meeting, Meets};
use super::sweep::Sums;
use loschmidt_core::Arithmetic;
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::number::Quantity;
use loschmidt_core::state::State;
use rayon::prelude::*;
use std::ops::Range;

/// Skin over the reach. Thicker, there are more candidates; thinner, the layout is made more often.
const SKIN: f64 = 0.1;
/// x-cells per reach.
const CELLS: f64 = 8.0;
/// Where the particles that fill up a strip are: beyond every range of the state (2^51 quanta).
const FAR: f64 = (1u64 << 60) as f64;
/// How many times a layout is made in the same box.
const BOX_LASTS: u32 = 16;

/// Fewest particles worth a thread of their own.
const PARTICLES_PER_THREAD: usize = 2000;
/// Fewest strips: the first and the last of a part wait for others.
const STRIPS_PER_THREAD: usize = 4;
/// Fewest particles worth a task of their own.
const GRAIN: usize = 2048;

/// A strip: its slots begin with a row; its particles are stored one after another.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strip {
    /// First slot.
    pub slot: usize,
    /// Place of the first particle in the state.
    pub place: usize,
    /// Number of particles.
    pub len: usize,
}

impl Strip {
    /// Rows of its slots.
    pub fn rows(&self) -> Range<usize> {
        self.slot / ROW..(self.slot + self.len).div_ceil(ROW)
    }
    /// Places of its particles.
    pub fn places(&self) -> Range<usize> {
        self.place..self.place + self.len
    }
}

/// Strips and what is in them.
#[derive(Debug, Default)]
pub(super) struct Layout {
    /// h in length quanta, rounded up.
    pub reach: f64,
    /// In length quanta.
    pub skin: f64,
    origin: [f64; 3],
    inverse_height: f64,
    inverse_cell: f64,
    /// Cells along x.
    columns: usize,
    /// Columns to either side in which neighbours of a column's particles can be.
    far: usize,
    /// Strips along y and z.
    count: [usize; 2],
    /// Place of the first particle of each cell, strip after strip; one more at the end.
    cell_start: Vec<u32>,
    /// The strips, and one without particles after the last.
    pub strips: Vec<Strip>,
    /// Ranges of strips, one for each thread.
    pub parts: Vec<Range<usize>>,
    /// Coordinates by row, D for each.
    pub x: Vec<Reals>,
    /// Who can meet whom, by strip.
    pub meets: Vec<Meets>,
    /// Upper bound of the displacement since the layout was made, quanta.
    travelled: f64,
    /// No particle has more candidates than this.
    pub most_candidates: usize,
    /// Counts the layouts.
    pub version: u64,
    box_for: u32,
    keys: Vec<u32>,
    order: Vec<u32>,
    /// Positions that the layout is of.
    located: (usize, usize),
}

/// Where a slice is, to know it again.
pub(super) fn key<T>(slice: &[T]) -> (usize, usize) {
    (slice.as_ptr() as usize, slice.len())
}

/// How the work is shared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crew {
    pub threads: usize,
    pub backend: Backend,
}

impl Layout {
    /// True where the layout is one of these positions.
    pub fn is_of<T>(&self, position: &[T]) -> bool {
        self.located == key(position)
    }

    /// Brings the layout up to date with the state, and the storage order of the state up to date with
    /// the layout.
    pub fn update<A: Arithmetic, const D: usize>(
        &mut self,
        reach: f64,
        state: &mut State<'_, A, D>,
        crew: Crew,
    ) {
        let same = self.is_of(state.position) && reach == self.reach;
        if !(same && self.follow::<A, D>(state.position, crew)) {
            self.make(reach, state, crew);
        }
    }

    /// Copies the positions; false where the layout has become too old.
    fn follow<A: Arithmetic, const D: usize>(
        &mut self,
        position: &[[A::Length; D]],
        crew: Crew,
    ) -> bool {
        let mut x = std::mem::take(&mut self.x);
        let layout = &*self;
        let step = layout.for_parts(layout.split_rows(&mut x, D), |strips, x| {
            crew.backend.run(Following::<A, D> {
                layout,
                strips,
                position,
                x,
            })
        });
        self.x = x;
        // A step of zero in rounding up is no step at all.
        self.travelled += step.into_iter().fold(0.0, f64::max) * (D as f64).sqrt() * 1.000_001;
        2.0 * self.travelled <= self.skin
    }

    fn make<A: Arithmetic, const D: usize>(
        &mut self,
        reach: f64,
        state: &mut State<'_, A, D>,
        crew: Crew,
    ) {
        if !self.is_of(state.position) || reach != self.reach || self.box_for == 0 {
            self.cover::<A, D>(reach, state.position);
            self.box_for = BOX_LASTS;
        }
        self.box_for -= 1;
        self.sort::<A, D>(state);
        self.divide::<D>(crew.threads);
        self.fill::<A, D>(state.position);
        self.list_meetings::<D>(crew);
        self.travelled = 0.0;
        self.version += 1;
        self.located = key(state.position);
    }

    /// Chooses the box that the strips cover and the sizes of strips and cells.
    fn cover<A: Arithmetic, const D: usize>(&mut self, reach: f64, position: &[[A::Length; D]]) {
        let n = position.len().max(1) as f64;
        self.reach = reach;
        self.skin = SKIN * reach;
        // A little more than the sum, so that no rounding below can put neighbours two strips apart.
        let height = (reach + self.skin) * 1.000_001;
        let mut extent = [0.0f64; 3];
        let axes = extent.iter_mut().zip(&mut self.origin).take(D);
        for (d, (extent, origin)) in axes.enumerate() {
            let (low, high) = interval(position.iter().map(|x| x[d].quanta()), height);
            *origin = low;
            *extent = (high - low).max(0.0);
        }
        // At most as many strips as particles, at most four cells for each.
        let strips = |d: usize| (extent[d] / height) as usize + 1;
        self.count = [strips(1), if D == 3 { strips(2) } else { 1 }];
        while (self.count[0] * self.count[1]) as f64 > n && self.count != [1, 1] {
            let widest = usize::from(self.count[1] > self.count[0]);
            self.count[widest] = self.count[widest].div_ceil(2);
        }
        let strips = (self.count[0] * self.count[1]) as f64;
        let columns = (extent[0] / (reach / CELLS) + 1.0).min(4.0 * n / strips + 1.0);
        self.columns = (columns as usize).max(1);
        let cell = (extent[0] / self.columns as f64).max(reach / CELLS);
        self.inverse_height = 1.0 / height;
        self.inverse_cell = 1.0 / cell;
        // One more for the place of the particle within its cell.
        self.far = ((reach + self.skin) * self.inverse_cell * 1.000_001) as usize + 1;
    }

    /// The strip that holds x.
    fn strip_of<const D: usize>(&self, x: &[f64; D]) -> usize {
        let mut strip = 0;
        for d in (1..D).rev() {
            // The cast saturates: what lies below is in strip 0.
            let s = ((x[d] - self.origin[d]) * self.inverse_height) as usize;
            strip = strip * self.count[0] + s.min(self.count[d - 1] - 1);
        }
        strip
    }

    fn column_of(&self, x: f64) -> usize {
        (((x - self.origin[0]) * self.inverse_cell) as usize).min(self.columns - 1)
    }

    /// Sorts the state into cells, strip after strip.
    fn sort<A: Arithmetic, const D: usize>(&mut self, state: &mut State<'_, A, D>) {
        let mut keys = std::mem::take(&mut self.keys);
        keys.resize(state.len(), 0);
        keys.par_iter_mut()
            .with_min_len(GRAIN)
            .zip(&*state.position)
            .for_each(|(key, x)| {
                let x = x.map(Quantity::quanta::<f64>);
                *key = (self.strip_of(&x) * self.columns + self.column_of(x[0])) as u32;
            });
        let strips = self.count[0] * self.count[1];
        self.cell_start.clear();
        self.cell_start.resize(strips * self.columns + 1, 0);
        for &key in &keys {
            self.cell_start[key as usize] += 1;
        }
        // Each count becomes the end of its cell; filling from the back leaves the start there.
        let (mut end, mut most) = (0, 0);
        for start in &mut self.cell_start {
            most = most.max(*start);
            end += *start;
            *start = end;
        }
        self.order.resize(state.len(), 0);
        let mut sorted = true;
        for (place, &key) in keys.iter().enumerate().rev() {
            let new = &mut self.cell_start[key as usize];
            *new -= 1;
            self.order[*new as usize] = place as u32;
            sorted &= *new as usize == place;
        }
        self.keys = keys;
        if !sorted {
            reorder(state, &self.order);
        }
        self.number_slots(strips);
        self.most_candidates = self.count_candidates::<D>(most as usize);
    }

    fn number_slots(&mut self, strips: usize) {
        self.strips.clear();
        let mut slot = 0;
        for strip in 0..strips {
            let places = self.window(strip, 0, self.columns - 1);
            self.strips.push(Strip {
                slot,
                place: places.start,
                len: places.len(),
            });
            slot = (slot + places.len()).next_multiple_of(ROW);
        }
        self.strips.push(Strip {
            slot,
            place: self.order.len(),
            len: 0,
        });
    }

    /// Divides the strips among the threads, about as many particles for each.
    fn divide<const D: usize>(&mut self, threads: usize) {
        let (count, particles) = (self.strips.len() - 1, self.order.len());
        let parts = (particles / PARTICLES_PER_THREAD)
            .min(count / STRIPS_PER_THREAD)
            .clamp(1, threads);
        self.parts.clear();
        let mut first = 0;
        for p in 1..=parts {
            let goal = particles * p / parts;
            let mut last = first;
            while last < count && (p == parts || self.strips[last].places().end <= goal) {
                last += 1;
            }
            self.parts.push(first..last);
            first = last;
        }
    }

    /// Rows of these strips.
    pub fn rows_of(&self, strips: &Range<usize>) -> Range<usize> {
        self.strips[strips.start].rows().start..self.strips[strips.end].rows().start
    }

    /// Places of the particles of these strips.
    pub fn places_of(&self, strips: &Range<usize>) -> Range<usize> {
        self.strips[strips.start].place..self.strips[strips.end].place
    }

    /// Number of all rows.
    pub fn all_rows(&self) -> usize {
        self.strips.last().map_or(0, |end| end.rows().start)
    }

    /// Rows that receive something when these strips are swept.
    pub fn rows_reached<const D: usize>(&self, strips: &Range<usize>) -> Range<usize> {
        if strips.is_empty() {
            return 0..0;
        }
        let end = strips.end + self.farthest_forward::<D>();
        self.rows_of(&(strips.start..end.min(self.strips.len() - 1)))
    }

    /// Those of the sums, one for each part, to which this strip belongs.
    pub fn contributors<'a, const TERM: usize>(
        &self,
        sums: &[&'a Sums],
        strip: &Strip,
    ) -> Vec<&'a Sums> {
        let row = strip.slot / ROW;
        let covers = |sums: &&&Sums| {
            row.checked_sub(sums.first_row)
                .is_some_and(|row| row * TERM < sums.rows.len())
        };
        sums.iter().filter(covers).copied().collect()
    }

    /// Splits something with `each` items a row among the parts.
    pub fn split_rows<'a, T>(&self, mut items: &'a mut [T], each: usize) -> Vec<&'a mut [T]> {
        let split = |part| {
            let (first, rest) =
                std::mem::take(&mut items).split_at_mut(self.rows_of(part).len() * each);
            items = rest;
            first
        };
        self.parts.iter().map(split).collect()
    }

    /// Splits something with one item a particle among the parts.
    pub fn split_places<'a, T>(&self, mut items: &'a mut [T]) -> Vec<&'a mut [T]> {
        let split = |part| {
            let (first, rest) = std::mem::take(&mut items).split_at_mut(self.places_of(part).len());
            items = rest;
            first
        };
        self.parts.iter().map(split).collect()
    }

    /// Does the work of all parts, each with its own item.
    pub fn for_parts<I: Send, O: Send>(
        &self,
        items: Vec<I>,
        work: impl Fn(Range<usize>, I) -> O + Sync,
    ) -> Vec<O> {
        if items.len() == 1 {
            let parts = self.parts.iter().zip(items);
            return parts.map(|(part, item)| work(part.clone(), item)).collect();
        }
        let parts = self.parts.par_iter().zip(items);
        parts.map(|(part, item)| work(part.clone(), item)).collect()
    }

    /// Writes all coordinates.
    fn fill<A: Arithmetic, const D: usize>(&mut self, position: &[[A::Length; D]]) {
        let mut x = std::mem::take(&mut self.x);
        x.resize(self.all_rows() * D, Reals::default());
        self.for_parts(self.split_rows(&mut x, D), |strips, x| {
            let first_row = self.rows_of(&strips).start;
            x.fill(Reals([FAR; ROW]));
            for strip in &self.strips[strips] {
                let rows = &mut x[(strip.rows().start - first_row) * D..];
                let places = position[strip.places()].chunks(ROW);
                for (row, places) in rows.chunks_exact_mut(D).zip(places) {
                    for (l, place) in places.iter().enumerate() {
                        for d in 0..D {
                            row[d].0[l] = place[d].quanta();
                        }
                    }
                }
            }
        });
        self.x = x;
    }

    /// Lists who can meet whom.
    fn list_meetings<const D: usize>(&mut self, crew: Crew) {
        let mut meets = std::mem::take(&mut self.meets);
        meets.resize_with(self.strips.len() - 1, Meets::default);
        let mut rest = &mut meets[..];
        let split = |part: &Range<usize>| {
            let (first, others) = std::mem::take(&mut rest).split_at_mut(part.len());
            rest = others;
            first
        };
        let parts = self.parts.iter().map(split).collect();
        let layout = &*self;
        layout.for_parts(parts, |strips, meets| {
            for (strip, meets) in strips.zip(meets) {
                meets.renew(|list| {
                    crew.backend.run(Listing::<D> {
                        layout,
                        strip,
                        list,
                    })
                });
            }
        });
        self.meets = meets;
    }

    /// Places of the cells from `first` to `last` of a strip.
    fn window(&self, strip: usize, first: usize, last: usize) -> Range<usize> {
        let row = strip * self.columns;
        self.cell_start[row + first] as usize..self.cell_start[row + last + 1] as usize
    }

    /// Places of the particles of a cell.
    pub fn cell(&self, strip: usize, column: usize) -> Range<usize> {
        self.window(strip, column, column)
    }

    /// Places in a strip at which particles within h + skin of a column can be.
    pub fn around(&self, strip: usize, column: usize) -> Range<usize> {
        let first = column.saturating_sub(self.far);
        let last = (column + self.far).min(self.columns - 1);
        self.window(strip, first, last)
    }

    /// The strips beside a strip, offsets along y and z.
    fn beside<'a>(
        &self,
        strip: usize,
        offsets: &'a [(isize, isize)],
    ) -> impl Iterator<Item = usize> + use<'a> {
        let [ny, nz] = self.count;
        let (y, z) = ((strip % ny) as isize, (strip / ny) as isize);
        offsets.iter().filter_map(move |(dy, dz)| {
            let (y, z) = (y + dy, z + dz);
            let inside = y >= 0 && (y as usize) < ny && z >= 0 && (z as usize) < nz;
            inside.then_some(z as usize * ny + y as usize)
        })
    }

    /// The strips beside a strip that come after it, each pair of strips once.
    pub fn forward<const D: usize>(&self, strip: usize) -> impl Iterator<Item = usize> + use<D> {
        const SPACE: [(isize, isize); 4] = [(1, 0), (-1, 1), (0, 1), (1, 1)];
        self.beside(strip, if D == 2 { &SPACE[..1] } else { &SPACE })
    }

    /// How much further on than itself the strips beside a strip can be.
    pub fn farthest_forward<const D: usize>(&self) -> usize {
        if D == 2 { 1 } else { self.count[0] + 1 }
    }

    /// An upper bound of the candidates of any particle, `most` being in the fullest cell.
    fn count_candidates<const D: usize>(&self, most: usize) -> usize {
        const ALL: [(isize, isize); 9] = [
            (0, 0),
            (1, 0),
            (-1, 0),
            (0, 1),
            (1, 1),
            (-1, 1),
            (0, -1),
            (1, -1),
            (-1, -1),
        ];
        let offsets = if D == 2 { &ALL[..3] } else { &ALL };
        let rough = offsets.len() * (2 * self.far + 1) * most;
        if rough <= MAX_NEIGHBOURS as usize {
            return rough;
        }
        let mut most = 0;
        for strip in 0..self.strips.len() - 1 {
            for column in (0..self.columns).filter(|&c| !self.cell(strip, c).is_empty()) {
                let beside = self.beside(strip, offsets);
                most = most.max(beside.map(|s| self.around(s, column).len()).sum());
            }
        }
        most
    }

    /// The strips and their cells that can hold particles within `radius` of x.
    pub fn near<const D: usize>(
        &self,
        x: &[f64; D],
        radius: f64,
    ) -> impl Iterator<Item = Range<usize>> {
        let corner = |sign: f64| {
            let x = x.map(|x| x + sign * radius * 1.000_001);
            let strip = self.strip_of(&x);
            (
                strip % self.count[0],
                strip / self.count[0],
                self.column_of(x[0]),
            )
        };
        let ((y0, z0, c0), (y1, z1, c1)) = (corner(-1.0), corner(1.0));
        (z0..=z1)
            .flat_map(move |z| (y0..=y1).map(move |y| self.window(z * self.count[0] + y, c0, c1)))
    }
}

/// Some strips, whose coordinates are to be copied.
struct Following<'a, A: Arithmetic, const D: usize> {
    layout: &'a Layout,
    strips: Range<usize>,
    position: &'a [[A::Length; D]],
    /// Rows of these strips.
    x: &'a mut [Reals],
}

impl<A: Arithmetic, const D: usize> Work for Following<'_, A, D> {
    /// The largest displacement along an axis.
    type Output = f64;
    #[inline(always)]
    fn run<Q: Quad>(self, _: Q) -> f64 {
        let first_row = self.layout.rows_of(&self.strips).start;
        let mut largest = [0.0f64; ROW];
        for strip in &self.layout.strips[self.strips] {
            let rows = &mut self.x[(strip.rows().start - first_row) * D..];
            let (whole, rest) = self.position[strip.places()].as_chunks::<ROW>();
            let (rows, last) = rows.split_at_mut(whole.len() * D);
            for (row, places) in rows.chunks_exact_mut(D).zip(whole) {
                for (d, row) in row.iter_mut().enumerate() {
                    for l in 0..ROW {
                        let new: f64 = places[l][d].quanta();
                        let moved = (new - row.0[l]).abs();
                        largest[l] = if moved > largest[l] {
                            moved
                        } else {
                            largest[l]
                        };
                        row.0[l] = new;
                    }
                }
            }
            for (l, place) in rest.iter().enumerate() {
                for (row, x) in last.iter_mut().zip(place) {
                    let new: f64 = x.quanta();
                    largest[l] = largest[l].max((new - row.0[l]).abs());
                    row.0[l] = new;
                }
            }
        }
        largest.into_iter().fold(0.0, f64::max)
    }
}

/// One strip, whose meetings are to be listed.
struct Listing<'a, const D: usize> {
    layout: &'a Layout,
    strip: usize,
    list: &'a mut Vec<Meeting>,
}

impl<const D: usize> Work for Listing<'_, D> {
    /// How many meetings of the list count.
    type Output = usize;
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) -> usize {
        let layout = self.layout;
        let strip = layout.strips[self.strip];
        let within = (layout.reach + layout.skin) * (layout.reach + layout.skin);
        let within = simd.splat(within);
        let first_row = strip.rows().start;
        let mut length = 0;
        for column in 0..layout.columns {
            let cell = layout.cell(self.strip, column);
            if cell.is_empty() {
                continue;
            }
            let rows_of = |s: usize| {
                let (places, strip) = (layout.around(s, column), &layout.strips[s]);
                let slot = |place| place - strip.place + strip.slot;
                if places.is_empty() {
                    0..0
                } else {
                    slot(places.start) / ROW..slot(places.end).div_ceil(ROW)
                }
            };
            let own_end = rows_of(self.strip).end;
            let mut windows = [const { 0..0 }; 5];
            let mut candidates = own_end;
            for (window, s) in windows[1..].iter_mut().zip(layout.forward::<D>(self.strip)) {
                *window = rows_of(s);
                candidates += window.len();
            }
            for place in cell {
                let slot = place - strip.place + strip.slot;
                windows[0] = slot / ROW + 1..own_end;
                if self.list.len() < length + candidates {
                    self.list.resize(length + candidates, [0, 0]);
                }
                let k = (place - strip.place) as u32;
                let x_i = &layout.x[slot / ROW * D..][..D];
                for window in &windows {
                    for row in window.clone() {
                        let x_j = &layout.x[row * D..][..D];
                        let mut r2 = simd.splat(0.0);
                        for d in 0..D {
                            let x = simd.splat(x_i[d].0[slot % ROW]);
                            let x_ij = simd.sub(x, simd.load(x_j[d]));
                            r2 = simd.add(r2, simd.mul(x_ij, x_ij));
                        }
                        // Written in any case, and kept where it counts: no branch to predict.
                        self.list[length] = [k, (row - first_row) as u32];
                        length += usize::from(simd.any_below(r2, within));
                    }
                }
            }
        }
        length
    }
}

/// Puts into every place what was in the place that `order` names.
fn reorder<A: Arithmetic, const D: usize>(state: &mut State<'_, A, D>, order: &[u32]) {
    fn one<T: Copy + Send + Sync>(items: &mut [T], order: &[u32]) {
        let sorted: Vec<T> = order.iter().map(|&place| items[place as usize]).collect();
        items.copy_from_slice(&sorted);
    }
    let State {
        id,
        position,
        velocity,
        density,
        ..
    } = state;
    rayon::join(
        || rayon::join(|| one(id, order), || one(position, order)),
        || rayon::join(|| one(velocity, order), || one(density, order)),
    );
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
