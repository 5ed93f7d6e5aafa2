//! The fast executor: the core's sums in vector instructions, each pair once.
//!
//! `layout` keeps the state sorted into strips, so that neighbours are contiguous, and lists of who
//! can meet whom (`making`, `meets`); `sweep` walks the pairs with the model's own pair terms
//! written for rows of four; `fused` does the two sums of water in one go; `walls` keeps the few
//! particles that are near walls; [`Backend`] chooses the instructions at run time. Parts of the
//! strips go to threads (`awake`), each with sums of its own, which are added afterwards.
//!
//! A sweep does not look at single terms for their range; instead the pass bounds all of them from
//! the largest words ([`PairPass::bound`]). Where the bound does not hold, or some particle has
//! more candidates than an integer sum is guaranteed to hold, the sum is taken by the plain
//! traversal of the core, which decides exactly and names the particle. The same for strips of more
//! particles than a list can name (16,000 in the plane).
//!
//! Floating-point states take the same way: their sums are integers too, of
//! [finer grains](loschmidt_core::rounding), and so have the same bits as those of the reference.

mod awake;
mod backend;
mod fused;
mod lanes;
mod layout;
mod making;
mod meets;
mod memory;
mod sums;
mod sweep;
mod walls;

pub use backend::Backend;

use crate::drive::{Drive, Group};
use crate::pool::{Rayon, listed};
use layout::{Crew, Layout};
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::fields::{IMPULSE, POSITION, VELOCITY};
use loschmidt_core::integrator::Stage;
use loschmidt_core::model::{Model, Relax};
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::Grain;
use loschmidt_core::operands::Operands;
use loschmidt_core::pairs::{PairPass, Sources, Targets, grains_under, term_count};
use loschmidt_core::points::{PointPass, visit};
use loschmidt_core::schemes::wcsph::{Filtered, Symplectic};
use loschmidt_core::set::Set;
use loschmidt_core::shears;
use loschmidt_core::{Arithmetic, Executor, Fault, System};
use memory::{LIMIT, Memory};
use std::any::Any;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use sums::{add_received, contributors};
use sweep::Sweep;

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

/// Fewest items worth a thread of their own.
const ITEMS_PER_THREAD: usize = 4000;
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

    /// What the sums so far were made with: the instruction set, `serial` for the plain traversal,
    /// or both where some of them were left to it.
    pub fn backend_at_work(&self) -> String {
        let swept = self.swept.load(Ordering::Relaxed);
        let name = self.crew.backend.name();
        match (swept, self.plain.load(Ordering::Relaxed)) {
            (true, true) => format!("{name}, serial"),
            (false, true) => "serial".to_owned(),
            _ => name.to_owned(),
        }
    }

    /// Gives back the memory that outlives a step; it is made anew when it is needed. What the
    /// scratch of a system holds is of no use afterwards.
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
    fn plain<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, D>,
        from: &Sources<'_, A, D>,
        out: &mut [A::Word],
    ) -> Result<(), Fault> {
        let mut start = vec![0; from.grid.buckets() + 1];
        let mut order = vec![0; from.position.len()];
        let mut cells = Cells {
            start: &mut start,
            order: &mut order,
        };
        cells.sort(from.grid, from.position);
        let from = Sources {
            cells: cells.view(),
            ..*from
        };
        self.rayon.sum(pass, to, &from, out)
    }

    /// Sums over a set and itself, by sweeps.
    fn sweep<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &self,
        memory: &mut Memory,
        pass: &P,
        grains: &[Grain],
        out: &mut [A::Word],
    ) {
        let term = term_count::<P, D>();
        let Memory {
            layout,
            words,
            sums,
            ..
        } = memory;
        let (layout, words) = (&*layout, &words[..]);
        sums.resize_with(layout.parts.len(), Default::default);
        layout.for_parts(sums.iter_mut().collect(), |strips, [sums, _]| {
            sums.clear(layout.rows_reached::<D>(&strips), term);
            self.crew.backend.run(Sweep::<P, D> {
                pass,
                layout,
                strips,
                words,
                sums,
                grains,
            });
        });
        let sums: Vec<_> = sums.iter().map(|[sums, _]| sums).collect();
        layout.for_parts(layout.split_places(out, term), |strips, out| {
            let mut out = out.chunks_exact_mut(term);
            for strip in &layout.strips[strips] {
                let from_parts = contributors(term, &sums, strip);
                for (slot, out) in (strip.slot..strip.slot + strip.len).zip(&mut out) {
                    add_received::<A>(out, grains, &from_parts, slot);
                }
            }
        });
    }
}

/// The fault of the smallest id.
fn first_fault(results: Vec<Result<(), Fault>>) -> Result<(), Fault> {
    let faults = results.into_iter().filter_map(Result::err);
    faults.reduce(Fault::first).map_or(Ok(()), Err)
}

impl Executor for Fast {
    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        particles: &mut Set<'_, A, D>,
        cells: &mut Cells<'_>,
        for_others: bool,
    ) {
        let reach = grid.reach() as f64;
        self.memory().layout.update(reach, particles, self.crew);
        if for_others {
            cells.sort(grid, particles.position());
        }
    }

    fn locate_walls<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        walls: &Set<'_, A, D>,
        cells: &mut Cells<'_>,
    ) {
        cells.sort(grid, walls.position());
        self.memory().walls.forget();
    }

    fn points<A: Arithmetic, P: PointPass<A, D>, const D: usize>(
        &self,
        pass: &P,
        set: &mut Set<'_, A, D>,
    ) -> Result<(), Fault> {
        let memory = self.memory();
        let layout = &memory.layout;
        if set.len() != layout.particles() {
            drop(memory);
            return if self.is_little(set.len()) {
                loschmidt_core::Serial.points(pass, set)
            } else {
                self.rayon.points(pass, set)
            };
        }
        // The same particles for a thread as in the sums: what it wrote is in its cache.
        let mut rest = set.operands(P::READ, P::WRITE);
        let mut parts: Vec<Operands<'_, A::Word>> = Vec::with_capacity(layout.parts.len());
        for part in &layout.parts {
            let (first, others) = rest.split_at(layout.places_of(part).len());
            parts.push(first);
            rest = others;
        }
        first_fault(layout.for_parts(parts, |_, mut part| visit(pass, &mut part)))
    }

    fn sum<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, D>,
        from: &Sources<'_, A, D>,
        out: &mut [A::Word],
    ) -> Result<(), Fault> {
        let mut memory = self.memory();
        let memory = &mut *memory;
        if !memory.layout.is_of(to.position) {
            self.plain.fetch_or(to.same_set, Ordering::Relaxed);
            return self.rayon.sum(pass, to, from, out);
        }
        if !to.same_set {
            let Memory { layout, walls, .. } = memory;
            return walls.sum(layout, pass, to, from, out);
        }
        let largest = memory.load::<A, P, D>(to);
        let in_range = pass.bound(&largest) < LIMIT;
        if !in_range || memory.layout.most_candidates > MAX_NEIGHBOURS as usize {
            self.plain.store(true, Ordering::Relaxed);
            return self.plain(pass, to, from, out);
        }
        self.swept.store(true, Ordering::Relaxed);
        let grains = listed::<P, D>(&grains_under::<A, P, D>(pass, &largest));
        self.sweep::<A, P, D>(memory, pass, &grains, out);
        Ok(())
    }
}

/// The reversible scheme of water, where a model is or contains it.
fn symplectic<A: Arithmetic, M: Model<A, D>, const D: usize>(
    model: &M,
) -> Option<&Symplectic<A, D>> {
    let model: &dyn Any = model;
    let filtered = || model.downcast_ref::<Filtered<A, D>>().map(|f| f.0.scheme());
    model.downcast_ref().or_else(filtered)
}

impl Drive for Fast {
    fn prepare<A: Arithmetic, M: Model<A, D>, const D: usize>(
        &self,
        model: &M,
        stage: Stage,
        in_place: bool,
        system: &mut System<'_, A, D>,
    ) -> Result<(), Fault> {
        // In space the arguments of a strip's neighbourhood are too many to be kept in a cache.
        if D == 2
            && let (Stage::Kick(c), Some(scheme)) = (stage, symplectic::<A, M, D>(model))
            && !scheme.water().has_dummies(system)
        {
            let water = scheme.water();
            water.locate(system, self);
            let duration = water.duration(c);
            let mut memory = self.memory();
            let particles = &mut system.particles;
            if memory.layout.most_candidates <= MAX_NEIGHBOURS as usize
                && memory.densities_and_impulses(self.crew, water, duration, particles)?
            {
                drop(memory);
                self.swept.store(true, Ordering::Relaxed);
                return water.short_impulses(system, self, duration);
            }
        }
        if in_place {
            model.prepare_in_place(stage, system, self)
        } else {
            model.prepare(stage, system, self)
        }
    }

    fn apply<A: Arithmetic, M: Model<A, D>, const D: usize>(
        &self,
        model: &M,
        group: Group,
        system: &mut System<'_, A, D>,
    ) -> Result<(), Fault> {
        match (group.drift, symplectic::<A, M, D>(model)) {
            (Some((step, c)), Some(scheme)) => {
                let pass = KicksAndDrift {
                    first_step: group.step,
                    twice: group.again,
                    drift: scheme.water().drift(c),
                    step,
                };
                let memory = self.memory();
                if system.particles.len() == memory.layout.particles() {
                    return pass.of_all(&memory.layout, &mut system.particles);
                }
                drop(memory);
                group.in_turn(model, system, self)
            }
            _ => group.in_turn(model, system, self),
        }
    }
}

/// A kick, once or twice, and the drift after it, in one go through the particles.
struct KicksAndDrift {
    /// The step that the first kick belongs to, and that of what comes after it.
    first_step: u64,
    step: u64,
    twice: bool,
    drift: shears::Drift,
}

impl KicksAndDrift {
    /// Does it to all particles of a layout.
    fn of_all<A: Arithmetic, const D: usize>(
        &self,
        layout: &Layout,
        particles: &mut Set<'_, A, D>,
    ) -> Result<(), Fault> {
        let (view, [x, v]) = particles.lend([POSITION, VELOCITY]);
        let (ids, impulses) = (view.id, view.vectors::<A::Word, D>(IMPULSE));
        let x = layout.split_places(x.as_chunks_mut::<D>().0, 1);
        let v = layout.split_places(v.as_chunks_mut::<D>().0, 1);
        let parts = x.into_iter().zip(v).collect();
        let faults = layout.for_parts(parts, |strips, (x, v)| {
            let places = layout.places_of(&strips);
            let (ids, impulses) = (&ids[places.clone()], &impulses[places]);
            let mut first = [None; 3];
            for (((x, v), impulse), id) in x.iter_mut().zip(v).zip(impulses).zip(ids) {
                if let Err((stage, fault)) = self.at::<A, D>(*id, impulse, x, v) {
                    first[stage] = earlier(first[stage], Some(fault));
                }
            }
            first
        });
        // The reference does all of one stage before the next: so the earliest stage has the word.
        let of_stage = |stage: usize| faults.iter().map(move |of_part| of_part[stage]);
        let mut stages = (0..3).filter_map(|stage| of_stage(stage).fold(None, earlier));
        stages.next().map_or(Ok(()), Err)
    }

    /// Does it to one particle; a fault comes with the number of its stage.
    #[inline(always)]
    fn at<A: Arithmetic, const D: usize>(
        &self,
        id: u64,
        impulse: &[A::Word; D],
        x: &mut [A::Word; D],
        v: &mut [A::Word; D],
    ) -> Result<(), (usize, Fault)> {
        let kick = shears::Kick;
        let mut add = || PointPass::<A, D>::at(&kick, id, impulse, v);
        add().map_err(|fault| (0, fault.at_step(self.first_step)))?;
        if self.twice {
            add().map_err(|fault| (1, fault.at_step(self.step)))?;
        }
        let drifted = PointPass::<A, D>::at(&self.drift, id, v, x);
        drifted.map_err(|fault| (2, fault.at_step(self.step)))
    }
}

/// Of two faults the first, if there is one.
fn earlier(a: Option<Fault>, b: Option<Fault>) -> Option<Fault> {
    a.into_iter().chain(b).reduce(Fault::first)
}
