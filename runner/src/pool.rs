//! The parallel executor, and the pool of threads that others use too.
//!
//! Particles are split among the threads of a rayon pool. Each is summed in two passes over its
//! candidates: the first writes those within reach to a short list, without a branch that depends
//! on a distance (two candidates in three are out of reach, and nothing predicts which), the second
//! adds their terms. They are the terms of the core's plain `gather`, in the same order.

use crate::drive::Drive;
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::Grain;
use loschmidt_core::operands::Operands;
use loschmidt_core::pairs::{
    PairPass, Sources, Targets, accumulate, add, empty, grains, separation, term_count,
};
use loschmidt_core::points::{PointPass, visit};
use loschmidt_core::set::{Set, read};
use loschmidt_core::values::Values;
use loschmidt_core::{Arithmetic, Executor, Fault, FaultKind};
use rayon::prelude::*;
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, PoisonError};

/// Fewest particles worth a task of their own: about 50 µs of work.
const PARTICLES: usize = 128;

/// Length of the list of neighbours; a longer one is summed in pieces.
const LIST: usize = 128;

/// rayon, on a pool of its own; a clone is a handle to the same pool.
#[derive(Clone, Debug)]
pub struct Rayon {
    pool: Arc<rayon::ThreadPool>,
}

/// Of so many threads those that can be of use: twice as many as there are processors, and eight
/// in any case. More would only wait for one another.
#[must_use]
pub(crate) fn of_use(threads: NonZeroUsize) -> NonZeroUsize {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    NonZeroUsize::new((2 * processors).max(8)).map_or(threads, |most| threads.min(most))
}

impl Rayon {
    /// A pool of `threads` threads, but at most of twice as many as there are processors, or eight.
    ///
    /// # Errors
    /// The threads could not be started.
    pub fn new(threads: NonZeroUsize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(of_use(threads).get())
            .thread_name(|i| format!("sph-{i}"))
            .build()?;
        Ok(Self {
            pool: Arc::new(pool),
        })
    }

    /// Number of threads.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Runs `work` on the pool, so that what it does in parallel need not be handed over each time.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        let (mut work, mut result) = (Some(work), None);
        self.on_pool(&mut || result = work.take().map(|work| work()));
        match result {
            Some(result) => result,
            None => unreachable!("the pool has done the work, or passed on its panic"),
        }
    }

    /// Compiled once, where a pool that knew the type of the work would be compiled for each.
    fn on_pool(&self, task: Task<'_>) {
        self.pool.install(task);
    }
}

/// Work of any kind: rayon's own code is then compiled for this type alone.
type Task<'a> = &'a mut (dyn FnMut() + Send);

impl Rayon {
    /// Calls `work` with every number below `count`, on all threads. Passed on as `dyn`: rayon's
    /// machinery is then compiled once, and not for every pass.
    fn for_each(
        &self,
        count: usize,
        work: &(dyn Fn(usize) -> Result<(), Fault> + Sync),
    ) -> Result<(), Fault> {
        let results = (0..count).into_par_iter();
        let fault = results
            .filter_map(|n| work(n).err())
            .reduce_with(Fault::first);
        fault.map_or(Ok(()), Err)
    }

    /// Calls `work` with every item, on all threads.
    fn for_parts<T: Send>(
        &self,
        parts: Vec<T>,
        work: impl Fn(T) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        let count = parts.len();
        let parts: Vec<_> = parts
            .into_iter()
            .map(|part| Mutex::new(Some(part)))
            .collect();
        let one = |n: usize| {
            let part = parts[n]
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .take();
            part.map_or(Ok(()), &work)
        };
        self.pool.install(|| self.for_each(count, &one))
    }
}

impl Executor for Rayon {
    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        particles: &mut Set<'_, A, D>,
        cells: &mut Cells<'_>,
        _: bool,
    ) {
        cells.sort(grid, particles.position());
    }

    fn points<A: Arithmetic, P: PointPass<A, D>, const D: usize>(
        &self,
        pass: &P,
        set: &mut Set<'_, A, D>,
    ) -> Result<(), Fault> {
        let mut rest = set.operands(P::READ, P::WRITE);
        let mut parts: Vec<Operands<'_, A::Word>> = Vec::new();
        while !rest.is_empty() {
            let many = rest.len().min(PARTICLES);
            let (first, others) = rest.split_at(many);
            parts.push(first);
            rest = others;
        }
        self.for_parts(parts, |mut part| visit(pass, &mut part))
    }

    fn sum<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, D>,
        from: &Sources<'_, A, D>,
        out: &mut [A::Word],
    ) -> Result<(), Fault> {
        let term = term_count::<P, D>();
        let grains = listed::<P, D>(&grains(pass, to));
        let parts = out.chunks_mut(PARTICLES * term).enumerate().collect();
        self.for_parts(parts, |(n, out): (usize, &mut [A::Word])| {
            let mut first: Option<Fault> = None;
            for (k, out) in out.chunks_exact_mut(term).enumerate() {
                let i = n * PARTICLES + k;
                let mut sum: P::Term<A::Sum> = empty::<A, _>(|k| grains[k]);
                let result = gather_listed(pass, to, i, from, &mut sum);
                add::<A, _>(&sum, out);
                if let Err(kind) = result {
                    let fault = Fault::new(kind, to.id[i]);
                    first = Some(first.map_or(fault, |other| other.first(fault)));
                }
            }
            first.map_or(Ok(()), Err)
        })
    }
}

impl Drive for Rayon {}

/// Number after number, for many threads.
pub(crate) fn listed<P: PairPass<D>, const D: usize>(grains: &P::Term<Grain>) -> Vec<Grain> {
    (0..term_count::<P, D>()).map(|k| grains.get(k)).collect()
}

/// The core's `gather` with the branches taken out of the search.
fn gather_listed<A: Arithmetic, P: PairPass<D>, const D: usize>(
    pass: &P,
    to: &Targets<'_, A, D>,
    i: usize,
    from: &Sources<'_, A, D>,
    sum: &mut P::Term<A::Sum>,
) -> Result<(), FaultKind> {
    let x_i = &to.position[i];
    let read_i = read(to.read, i);
    let reach_squared = pass.reach_squared();
    let skip = if to.same_set { i as u32 } else { u32::MAX };
    let mut list = [0u32; LIST];
    let mut listed = 0;
    let mut neighbours = 0;
    let mut result = Ok(());
    let mut add = |list: &[u32]| {
        neighbours += list.len();
        for &j in list {
            let (x_ij, r2) = separation::<A, D>(x_i, &from.position[j as usize]);
            let read_j = read(from.read, j as usize);
            let argument = pass.argument(r2);
            if !accumulate(sum, &pass.term(&x_ij, argument, &read_i, &read_j)) {
                result = Err(FaultKind::TermRange);
            }
        }
    };
    from.cells.around(from.grid, x_i, |run| {
        for &j in run {
            let (_, r2) = separation::<A, D>(x_i, &from.position[j as usize]);
            list[listed] = j;
            listed += usize::from(r2 < reach_squared) & usize::from(j != skip);
            if listed == LIST {
                add(&list);
                listed = 0;
            }
        }
    });
    add(&list[..listed]);
    if neighbours > MAX_NEIGHBOURS as usize {
        return Err(FaultKind::Crowded);
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_threads_are_started_than_can_be_of_use() {
        for (asked, started) in [(1, 1..=1), (8, 8..=8), (100_000, 8..=4096)] {
            let asked = NonZeroUsize::new(asked).expect("a number");
            let pool = Rayon::new(asked).expect("threads");
            assert!(started.contains(&pool.threads()), "{}", pool.threads());
        }
    }
}
