//! The fast executor: the core's sums in vector instructions, each pair once.
//!
//! `layout` keeps the state sorted into strips, so that neighbours are contiguous, and lists of who
//! can meet whom (`making`, `meets`); `sweep` walks the pairs with the model's own pair terms written
//! for rows of four; `chain` does two sums in one go; `walls` keeps the few particles that are near
//! walls; [`Backend`] chooses the instructions at run time. Parts of the strips go to threads
//! (`awake`), each with sums of its own, which are added afterwards.
//!
//! A sweep does not look at single terms for their range; instead the pass bounds all of them from
//! the largest words ([`PairPass::bound`]). Where the bound does not hold, or some particle has more
//! candidates than an integer sum is guaranteed to hold, the sum is taken by the plain traversal of
//! the core, which decides exactly and names the particle. The same for floating-point states, and
//! for strips of more particles than a list can name (16,000 in the plane).

mod awake;
mod backend;
mod chain;
mod lanes;
mod layout;
mod making;
mod meets;
mod sweep;
mod walls;

pub use backend::Backend;

use crate::executor::Rayon;
use chain::{Arguments, add_received};
use lanes::{ROW, Reals};
use layout::{Crew, Layout};
use loschmidt_core::chain::{Chain, ChainSet, SumsOf, chain_in_turn};
use loschmidt_core::executor::Targets;
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::{Quantity, Real};
use loschmidt_core::pairs::{PairPass, Sources};
use loschmidt_core::state::State;
use loschmidt_core::{Arithmetic, Executor, Fault};
use std::any::TypeId;
use std::marker::PhantomData;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use sweep::{Sums, Sweep};
use walls::NearWalls;

/// Vectorised half-pair sweeps on strips.
#[derive(Debug)]
pub struct Fast {
    rayon: Rayon,
    crew: Crew,
    memory: Mutex<Memory>,
    /// Whether particles were summed over each other by sweeps, and by the plain traversal.
    swept: AtomicBool,
    plain: AtomicBool,
}

/// What outlives a step.
#[derive(Debug, Default)]
struct Memory {
    layout: Layout,
    /// What a pass reads, by row.
    words: Vec<Reals>,
    /// First and second sums of each part.
    sums: Vec<[Sums; 2]>,
    /// Arguments of the terms of three strips, for each part.
    arguments: Vec<Arguments>,
    walls: NearWalls,
}

/// Fewest items worth a thread of their own.
const ITEMS_PER_THREAD: usize = 4000;
/// Terms of this magnitude and more, in quanta, are out of range: 2^51.
const LIMIT: f64 = (1u64 << 51) as f64;

/// The larger magnitude, and a NaN before all: as integers the bits of magnitudes are in order.
#[inline(always)]
fn larger(largest: f64, word: f64) -> f64 {
    f64::from_bits(largest.to_bits().max(word.abs().to_bits()))
}

impl Memory {
    /// Copies what the pass reads into rows; returns the largest magnitudes.
    fn load<Q: Quantity, const READ: usize>(&mut self, words: &[[Q; READ]]) -> [f64; READ] {
        if READ == 0 {
            return [0.0; READ];
        }
        let layout = &self.layout;
        self.words
            .resize(layout.all_rows() * READ, Reals::default());
        let parts = layout.split_rows(&mut self.words, READ);
        let largest = layout.for_parts(parts, |strips, rows| {
            let mut largest = [0.0; READ];
            let first_row = layout.rows_of(&strips).start;
            for strip in &layout.strips[strips] {
                let rows = &mut rows[(strip.rows().start - first_row) * READ..];
                let rows = &mut rows[..strip.rows().len() * READ];
                // Nobody is in the last slots, and nothing is read of them.
                if let Some(last) = rows.len().checked_sub(READ) {
                    rows[last..].fill(Reals::default());
                }
                let places = words[strip.places()].chunks(ROW);
                for (row, places) in rows.chunks_exact_mut(READ).zip(places) {
                    for (l, place) in places.iter().enumerate() {
                        for k in 0..READ {
                            row[k].0[l] = place[k].quanta();
                            largest[k] = larger(largest[k], row[k].0[l]);
                        }
                    }
                }
            }
            largest
        });
        largest.into_iter().fold([0.0; READ], |mut all, part| {
            for (all, part) in all.iter_mut().zip(part) {
                *all = larger(*all, part);
            }
            all
        })
    }
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
            crew: Crew {
                threads: threads.get(),
                backend,
            },
            memory: Mutex::default(),
            swept: AtomicBool::new(false),
            plain: AtomicBool::new(false),
        })
    }

    /// What the sums so far were made with: the instruction set, `serial` for the plain traversal, or
    /// both where some of them were left to it.
    pub fn backend_at_work(&self) -> String {
        let swept = self.swept.load(Ordering::Relaxed);
        let name = self.crew.backend.name();
        match (swept, self.plain.load(Ordering::Relaxed)) {
            (true, true) => format!("{name}, serial"),
            (false, true) => "serial".to_owned(),
            _ => name.to_owned(),
        }
    }

    /// Gives back the memory that outlives a step; it is made anew when it is needed. What the scratch
    /// of a system holds is of no use afterwards.
    pub fn release(&self) {
        *self.memory() = Memory::default();
    }

    /// The threads.
    pub fn threads(&self) -> &Rayon {
        &self.rayon
    }

    /// Runs `work` on the threads.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.rayon.install(|| awake::together(work))
    }

    /// True for so few items that other threads are not worth their trouble.
    fn is_little(&self, items: usize) -> bool {
        self.crew.threads == 1 || items < 2 * ITEMS_PER_THREAD
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

/// The fault of the smallest id.
fn first_fault(results: Vec<Result<(), Fault>>) -> Result<(), Fault> {
    let faults = results.into_iter().filter_map(Result::err);
    faults.reduce(Fault::first).map_or(Ok(()), Err)
}

/// True for the arithmetic that the sweeps are written for.
fn is_swept<A: Arithmetic>() -> bool {
    A::EXACT && TypeId::of::<A::Real>() == TypeId::of::<f64>()
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
        let memory = self.memory();
        let layout = &memory.layout;
        if items.len() != layout.particles() {
            drop(memory);
            return if self.is_little(items.len()) {
                loschmidt_core::Serial.for_each(items, f)
            } else {
                self.rayon.for_each(items, f)
            };
        }
        // The same particles for a thread as in the sums: what it wrote is in its cache.
        let faults = layout.for_parts(layout.split_places(items), |strips, items| {
            let first = layout.places_of(&strips).start;
            loschmidt_core::Serial.for_each(items, |i, item| f(first + i, item))
        });
        first_fault(faults)
    }

    fn for_both<T: Send, U: Send>(
        &self,
        a: &mut [T],
        b: &mut [U],
        f: impl Fn(usize, &mut T, &mut U) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        let memory = self.memory();
        let layout = &memory.layout;
        if a.len() != layout.particles() {
            drop(memory);
            return if self.is_little(a.len()) {
                loschmidt_core::Serial.for_both(a, b, f)
            } else {
                self.rayon.for_both(a, b, f)
            };
        }
        let items = layout
            .split_places(a)
            .into_iter()
            .zip(layout.split_places(b))
            .collect();
        let faults = layout.for_parts(items, |strips, (a, b): (&mut [T], &mut [U])| {
            let first = layout.places_of(&strips).start;
            loschmidt_core::Serial.for_both(a, b, |i, a, b| f(first + i, a, b))
        });
        first_fault(faults)
    }

    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        state: &mut State<'_, A, D>,
        cells: &mut Cells<'_>,
        for_others: bool,
    ) {
        if is_swept::<A>() {
            let reach = grid.reach() as f64;
            self.memory().layout.update(reach, state, self.crew);
        }
        if for_others || !is_swept::<A>() {
            cells.sort(grid, state.position);
        }
    }

    fn locate_walls<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        position: &[[A::Length; D]],
        cells: &mut Cells<'_>,
    ) {
        cells.sort(grid, position);
        self.memory().walls.forget();
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
        let memory = &mut *memory;
        if !is_swept::<A>() || !memory.layout.is_of(to.position) {
            self.plain.fetch_or(to.same_set, Ordering::Relaxed);
            return self.rayon.sum(pass, to, from, out);
        }
        if !to.same_set {
            let Memory { layout, walls, .. } = memory;
            return walls.sum(layout, pass, to, from, out);
        }
        let largest = memory.load(to.read);
        let in_range = pass.bound(&largest.map(A::Real::from_f64)) < LIMIT;
        if !in_range || memory.layout.most_candidates > MAX_NEIGHBOURS as usize {
            self.plain.store(true, Ordering::Relaxed);
            return self.plain(pass, to, from, out);
        }
        self.swept.store(true, Ordering::Relaxed);
        let Memory {
            layout,
            words,
            sums,
            ..
        } = memory;
        let (layout, words) = (&*layout, &words[..]);
        sums.resize_with(layout.parts.len(), Default::default);
        layout.for_parts(sums.iter_mut().collect(), |strips, [sums, _]| {
            sums.clear(layout.rows_reached::<D>(&strips), TERM);
            self.crew.backend.run(Sweep::<A, P, D, READ, TERM> {
                pass,
                layout,
                strips,
                words,
                sums,
                arithmetic: PhantomData,
            });
        });
        let sums: Vec<_> = sums.iter().map(|[sums, _]| sums).collect();
        layout.for_parts(layout.split_places(out), |strips, out| {
            let mut out = out.iter_mut();
            for strip in &layout.strips[strips] {
                let contributors = layout.contributors::<TERM>(&sums, strip);
                for (slot, out) in (strip.slot..strip.slot + strip.len).zip(&mut out) {
                    add_received::<A::Real, _, TERM>(out, &contributors, slot);
                }
            }
        });
        Ok(())
    }

    fn chain<A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize>(
        &self,
        chain: &C,
        set: &ChainSet<'_, A, D>,
        sums: SumsOf<'_, A, C, D, READ, FIRST, SECOND>,
    ) -> Result<(), Fault>
    where
        A: Arithmetic,
        C: Chain<A, D, READ, FIRST, SECOND>,
    {
        let mut sums = sums;
        let mut memory = self.memory();
        // In space the arguments of a strip's neighbourhood are too many to be kept in a cache.
        let fits = D == 2
            && is_swept::<A>()
            && memory.layout.is_of(set.position)
            && memory.layout.most_candidates <= MAX_NEIGHBOURS as usize;
        if fits && memory.chain(self.crew, chain, set, &mut sums)? {
            self.swept.store(true, Ordering::Relaxed);
            return Ok(());
        }
        drop(memory);
        chain_in_turn(self, chain, set, sums)
    }
}
