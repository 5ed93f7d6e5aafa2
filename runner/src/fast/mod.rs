//! The fast executor: the core's sums in vector instructions, each pair once.
//!
//! `strips` lays the particles out so that neighbours are contiguous, `sweep` walks the pairs with
//! the model's own pair terms written for rows, [`Backend`] chooses the instructions at run time.
//! Parts of the strips go to threads, each with sums of its own, which are added afterwards.
//!
//! A sweep does not look at single terms for their range; instead, before it starts, the pass
//! bounds all of them from the largest words ([`PairPass::bound`]). Where the bound does not hold, or
//! some particle has more candidates than an integer sum is guaranteed to hold, the sum is taken by
//! the plain traversal of the core, which decides exactly and names the particle. The same for
//! sums over walls and for floating-point states.

mod backend;
mod lanes;
mod strips;
mod sweep;

pub use backend::Backend;

use crate::executor::Rayon;
use loschmidt_core::executor::Targets;
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::{Accumulate, Quantity, Real};
use loschmidt_core::pairs::{PairPass, Sources};
use loschmidt_core::{Arithmetic, Executor, Fault};
use rayon::prelude::*;
use std::marker::PhantomData;
use std::num::NonZeroUsize;
use std::sync::{Mutex, MutexGuard, PoisonError};
use strips::{NOBODY, Strips};
use sweep::{Part, Sweep};

/// Vectorised half-pair sweeps on strips.
#[derive(Debug)]
pub struct Fast {
    rayon: Rayon,
    threads: usize,
    backend: Backend,
    memory: Mutex<Memory>,
}

/// What outlives a step.
#[derive(Debug, Default)]
struct Memory {
    strips: Strips,
    read: [Vec<f64>; 3],
    parts: Vec<Part>,
    /// Which positions the strips hold.
    located: (usize, usize),
}

/// Fewest particles worth a thread of their own.
const PARTICLES_PER_THREAD: usize = 2000;
/// Terms of this magnitude and more, in quanta, are out of range: 2^51.
const LIMIT: f64 = (1u64 << 51) as f64;

impl Memory {
    /// Divides the strips among `parts` parts of about as many particles.
    fn divide<const D: usize>(&mut self, parts: usize) {
        let strips = &self.strips;
        let (count, slots) = (strips.strips(), strips.slots());
        self.parts.resize_with(parts, Part::default);
        let mut first = 0;
        for (p, part) in self.parts.iter_mut().enumerate() {
            let goal = slots * (p + 1) / parts;
            let mut last = first;
            while last < count && (p + 1 == parts || strips.slots_of(first..last).end < goal) {
                last += 1;
            }
            part.strips = first..last;
            // The strips that receive reach beyond those that give.
            let beyond = (last + strips.farthest_forward::<D>()).min(count);
            part.slots = strips.slots_of(first..if first == last { last } else { beyond });
            first = last;
        }
    }

    /// Copies what the pass reads into slots; returns the largest magnitudes.
    fn load<Q: Quantity, const READ: usize>(&mut self, words: &[[Q; READ]]) -> [f64; READ] {
        let mut largest = [0.0; READ];
        for k in 0..READ {
            let column = &mut self.read[k];
            column.clear();
            column.extend(self.strips.order.iter().map(|&place| match place {
                NOBODY => 0.0,
                place => words[place as usize][k].quanta::<f64>(),
            }));
            // Written so that a NaN stays.
            largest[k] = column.iter().fold(0.0f64, |l, w| {
                if w.abs() <= l || l.is_nan() {
                    l
                } else {
                    w.abs()
                }
            });
        }
        largest
    }

    /// The sum of component k that a slot has received, over all parts.
    fn received(&self, k: usize, slot: usize) -> i64 {
        let parts = self.parts.iter().filter(|part| part.slots.contains(&slot));
        parts.fold(0i64, |sum, part| {
            sum.wrapping_add(part.sums[k][slot - part.slots.start])
        })
    }
}

/// Where a slice of positions is, to know it again.
fn key<T>(slice: &[T]) -> (usize, usize) {
    (slice.as_ptr() as usize, slice.len())
}

impl Fast {
    /// With at most so many threads.
    ///
    /// # Errors
    /// The threads could not be started.
    pub fn new(
        threads: NonZeroUsize,
        backend: Backend,
    ) -> Result<Self, rayon::ThreadPoolBuildError> {
        Ok(Self {
            rayon: Rayon::new(threads)?,
            threads: threads.get(),
            backend,
            memory: Mutex::default(),
        })
    }

    /// Runs `work` on the threads.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.rayon.install(work)
    }

    fn memory(&self) -> MutexGuard<'_, Memory> {
        // Nothing that is kept can be wrong after a panic: it is checked before it is used.
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The plain traversal, with cells of its own: rare, so their memory may be.
    fn plain<A, P, const D: usize, const READ: usize, const TERM: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, P::Word, D, READ>,
        from: &Sources<'_, A, P::Word, D, READ>,
        out: &mut [[P::Sum; TERM]],
    ) -> Result<(), Fault>
    where
        A: Arithmetic,
        P: PairPass<A, D, READ, TERM>,
    {
        let mut start = vec![0; from.grid.buckets() + 1];
        let mut order = vec![0; from.position.len()];
        let mut cells = Cells {
            start: &mut start,
            order: &mut order,
        };
        cells.sort(from.grid, from.position);
        let from = Sources {
            grid: from.grid,
            cells: cells.view(),
            position: from.position,
            read: from.read,
        };
        self.rayon.sum(pass, to, &from, out)
    }
}

impl Executor for Fast {
    fn name(&self) -> &'static str {
        "fast"
    }

    fn for_each<T: Send>(
        &self,
        items: &mut [T],
        f: impl Fn(usize, &mut T) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        if self.threads == 1 || items.len() < 2 * PARTICLES_PER_THREAD {
            loschmidt_core::Serial.for_each(items, f)
        } else {
            self.rayon.for_each(items, f)
        }
    }

    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        position: &[[A::Length; D]],
        cells: &mut Cells<'_>,
        for_others: bool,
    ) {
        if for_others || !A::EXACT {
            cells.sort(grid, position);
        }
        if A::EXACT {
            let mut memory = self.memory();
            memory.strips.update::<A, D>(grid.reach() as f64, position);
            let parts = (position.len() / PARTICLES_PER_THREAD).clamp(1, self.threads);
            memory.divide::<D>(parts);
            memory.located = key(position);
        }
    }

    fn sum<A, P, const D: usize, const READ: usize, const TERM: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, P::Word, D, READ>,
        from: &Sources<'_, A, P::Word, D, READ>,
        out: &mut [[P::Sum; TERM]],
    ) -> Result<(), Fault>
    where
        A: Arithmetic,
        P: PairPass<A, D, READ, TERM>,
    {
        let mut memory = self.memory();
        if !A::EXACT || !to.same_set || memory.located != key(from.position) {
            drop(memory);
            return self.rayon.sum(pass, to, from, out);
        }
        let largest = memory.load(to.read);
        let bound = pass.bound(&largest.map(A::Real::from_f64));
        let in_range = bound < LIMIT;
        if !in_range || memory.strips.most_candidates > MAX_NEIGHBOURS as usize {
            drop(memory);
            return self.plain(pass, to, from, out);
        }
        let Memory {
            strips,
            read,
            parts,
            ..
        } = &mut *memory;
        let backend = self.backend;
        let sweep = |part: &mut Part| {
            for sums in part.sums.iter_mut().take(TERM) {
                sums.clear();
                sums.resize(part.slots.len(), 0);
            }
            backend.run(Sweep::<A, P, D, READ, TERM> {
                pass,
                strips,
                read,
                part,
                arithmetic: PhantomData,
            });
        };
        if let [part] = &mut parts[..] {
            sweep(part);
        } else {
            parts.par_iter_mut().for_each(sweep);
        }
        let memory = &*memory;
        self.for_each(out, |place, sum| {
            let slot = memory.strips.slot[place] as usize;
            for (k, sum) in sum.iter_mut().enumerate() {
                *sum = sum.plus_quanta(memory.received(k, slot));
            }
            Ok(())
        })
    }
}
