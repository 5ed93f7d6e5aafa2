//! The layout: particles in strips, sorted along the first axis, and who can meet whom.
//!
//! Strips run along x. Their height along the other axes is h + skin, so that a particle's
//! neighbours lie in its own strip and in those beside it. Within a strip particles are sorted into
//! x-cells of about h/8. The state itself is stored in this order; each strip begins a new *row* of
//! four *slots* and its last row is filled up with particles far away, so that whole rows can be
//! read and added to.
//!
//! For each particle, `meets` lists the rows that hold a particle within h + skin: those of its own
//! strip after its own row, and those of the strips that come after. Each pair is in one list.
//!
//! The layout outlives the step: it is made anew when twice the largest displacement since it was
//! made could exceed the skin. Particles outside the box that the strips cover are kept in the
//! outermost strips and cells: the clamping is monotone, neighbours stay neighbours. None of this
//! can change a bit, since sums of integers do not depend on who meets whom when.

use super::awake::each;
use super::backend::{Backend, Work};
use super::lanes::{Quad, ROW, Reals};
use super::meets::Meets;
use loschmidt_core::Arithmetic;
use loschmidt_core::fields::words_each;
use loschmidt_core::number::Quantity;
use loschmidt_core::set::Set;
use std::ops::Range;

/// How many times a layout is made in the same box.
const BOX_LASTS: u32 = 16;
/// Words of a particle for which a thread is worth its trouble: 2,000 particles of water in the
/// plane, of nine words each.
const WORDS_PER_THREAD: usize = 18_000;

/// How many times as many neighbours as in the plane a particle has in space, about.
const NEIGHBOURS_IN_SPACE: usize = 6;

/// Fewest particles worth a thread of their own, for particles of so many words: a model works on
/// each of them, and with each neighbour.
fn particles_per_thread(dimension: usize, words: usize) -> usize {
    let in_the_plane = WORDS_PER_THREAD / words.max(1);
    let least = match dimension {
        2 => in_the_plane,
        _ => in_the_plane / NEIGHBOURS_IN_SPACE,
    };
    least.max(1)
}
/// Fewest strips: the first and the last of a part wait for others.
const STRIPS_PER_THREAD: usize = 4;
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
    pub(super) origin: [f64; 3],
    pub(super) inverse_height: f64,
    pub(super) inverse_cell: f64,
    /// Cells along x.
    pub(super) columns: usize,
    /// Columns to either side in which neighbours of a column's particles can be.
    pub(super) far: usize,
    /// Strips along y and z.
    pub(super) count: [usize; 2],
    /// Place of the first particle of each cell, strip after strip; one more at the end.
    pub(super) cell_start: Vec<u32>,
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
    pub(super) keys: Vec<u32>,
    pub(super) order: Vec<u32>,
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

    /// Brings the layout up to date with the particles, and their storage order up to date with the
    /// layout.
    pub fn update<A: Arithmetic, const D: usize>(
        &mut self,
        reach: f64,
        particles: &mut Set<'_, A, D>,
        crew: Crew,
    ) {
        let same = self.is_of(particles.position()) && reach == self.reach;
        if !(same && self.follow::<A, D>(particles.position(), crew)) {
            self.make(reach, particles, crew);
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
        particles: &mut Set<'_, A, D>,
        crew: Crew,
    ) {
        if !self.is_of(particles.position()) || reach != self.reach || self.box_for == 0 {
            self.cover::<A, D>(reach, particles.position());
            self.box_for = BOX_LASTS;
        }
        self.box_for -= 1;
        self.sort::<A, D>(particles);
        let words = words_each(particles.fields(), particles.side(), D);
        self.divide(crew.threads, particles_per_thread(D, words));
        self.fill::<A, D>(particles.position());
        self.list_meetings::<D>(crew);
        self.travelled = 0.0;
        self.version += 1;
        self.located = key(particles.position());
    }

    /// The strip that holds x.
    pub(super) fn strip_of<const D: usize>(&self, x: &[f64; D]) -> usize {
        let mut strip = 0;
        for d in (1..D).rev() {
            // The cast saturates: what lies below is in strip 0.
            let s = ((x[d] - self.origin[d]) * self.inverse_height) as usize;
            strip = strip * self.count[0] + s.min(self.count[d - 1] - 1);
        }
        strip
    }

    pub(super) fn column_of(&self, x: f64) -> usize {
        (((x - self.origin[0]) * self.inverse_cell) as usize).min(self.columns - 1)
    }

    /// Divides the strips among the threads, about as many particles for each, and not fewer than
    /// `least`.
    fn divide(&mut self, threads: usize, least: usize) {
        let (count, particles) = (self.strips.len() - 1, self.order.len());
        let parts = (particles / least)
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

    /// Number of particles; the storage order of all that has as many is the layout's.
    pub fn particles(&self) -> usize {
        self.strips.last().map_or(0, |end| end.place)
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

    /// Splits something with `each` items a particle among the parts.
    pub fn split_places<'a, T>(&self, mut items: &'a mut [T], each: usize) -> Vec<&'a mut [T]> {
        let split = |part| {
            let (first, rest) =
                std::mem::take(&mut items).split_at_mut(self.places_of(part).len() * each);
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
        let parts = self.parts.iter().zip(items);
        if self.parts.len() == 1 {
            return parts.map(|(part, item)| work(part.clone(), item)).collect();
        }
        each(parts, |(part, item)| work(part.clone(), item))
    }

    /// Places of the cells from `first` to `last` of a strip.
    pub(super) fn window(&self, strip: usize, first: usize, last: usize) -> Range<usize> {
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
    pub(super) fn beside<'a>(
        &self,
        strip: usize,
        offsets: &'a [(isize, isize)],
    ) -> impl Iterator<Item = usize> + use<'a> {
        let [ny, nz] = self.count;
        let (y, z) = ((strip % ny) as isize, (strip / ny) as isize);
        offsets.iter().filter_map(move |(dy, dz)| {
            let (y, z) = (y + dy, z + dz);
            let inside = y >= 0 && (y as usize) < ny && z >= 0 && (z as usize) < nz;
            inside.then(|| z as usize * ny + y as usize)
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
                        let new = places[l][d].quanta();
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
                    let new = x.quanta();
                    largest[l] = largest[l].max((new - row.0[l]).abs());
                    row.0[l] = new;
                }
            }
        }
        largest.into_iter().fold(0.0, f64::max)
    }
}
