//! The parallel executor.
//!
//! Particles are split among the threads of a rayon pool. Each is summed in two passes over its
//! candidates: the first writes those within reach to a short list, without a branch that depends
//! on a distance (two candidates in three are out of reach, and nothing predicts which), the second
//! adds their terms. They are the terms of the core's plain `gather`, in the same order.

use crate::fast::Fast;
use loschmidt_core::executor::Targets;
use loschmidt_core::fault::MAX_NEIGHBOURS;
use loschmidt_core::pairs::{PairPass, Sources, accumulate, read, separation};
use loschmidt_core::{Arithmetic, Executor, Fault, FaultKind, Serial};
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Fewest particles worth a task of their own: about 50 µs of work.
const GRAIN: usize = 128;

/// Parts for each thread: enough that none waits long for the last.
const PARTS: usize = 8;

/// Length of the list of neighbours; a longer one is summed in pieces.
const LIST: usize = 128;

/// rayon, on a pool of its own; a clone is a handle to the same pool.
#[derive(Clone, Debug)]
pub struct Rayon {
    pool: Arc<rayon::ThreadPool>,
}

impl Rayon {
    /// A pool of `threads` threads.
    ///
    /// # Errors
    /// The threads could not be started.
    pub fn new(threads: NonZeroUsize) -> Result<Self, rayon::ThreadPoolBuildError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.get())
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

/// Does both, on two threads if there is one without work.
fn join(a: Task<'_>, b: Task<'_>) {
    rayon::join(a, b);
}

/// Calls `f` with the items of two slices of one length, in parts of at most `part` that any
/// thread may take; the first of them has the index `first`.
fn in_parts<T: Send, U: Send>(
    (first, part): (usize, usize),
    a: &mut [T],
    b: &mut [U],
    f: &(impl Fn(usize, &mut T, &mut U) -> Result<(), Fault> + Sync),
) -> Option<Fault> {
    if a.len() <= part {
        let each = (first..).zip(a.iter_mut().zip(b));
        return each
            .filter_map(|(i, (a, b))| f(i, a, b).err())
            .reduce(Fault::first);
    }
    let middle = a.len() / 2;
    let ((a, a_late), (b, b_late)) = (a.split_at_mut(middle), b.split_at_mut(middle));
    let (mut early, mut late) = (None, None);
    join(
        &mut || early = in_parts((first, part), a, b, f),
        &mut || late = in_parts((first + middle, part), a_late, b_late, f),
    );
    early.into_iter().chain(late).reduce(Fault::first)
}

impl Executor for Rayon {
    fn name(&self) -> &'static str {
        "rayon"
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
        self.for_each(out, |i, sum| {
            let skip = to.same_set.then_some(i);
            gather_listed(pass, &to.position[i], &to.read[i], from, skip, sum)
                .map_err(|kind| Fault::new(kind, to.id.get(i)))
        })
    }

    fn for_each<T: Send>(
        &self,
        items: &mut [T],
        f: impl Fn(usize, &mut T) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        // A unit takes no memory.
        let mut units = vec![(); items.len()];
        self.for_both(items, &mut units, |i, item, ()| f(i, item))
    }

    fn for_both<T: Send, U: Send>(
        &self,
        a: &mut [T],
        b: &mut [U],
        f: impl Fn(usize, &mut T, &mut U) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        let length = a.len().min(b.len());
        let part = length.div_ceil(PARTS * self.threads()).max(GRAIN);
        let run = || in_parts((0, part), &mut a[..length], &mut b[..length], &f);
        self.install(run).map_or(Ok(()), Err)
    }
}

/// The core's `gather` with the branches taken out of the search.
fn gather_listed<A, P, const D: usize, const READ: usize, const TERM: usize>(
    pass: &P,
    x_i: &[A::Length; D],
    read_i: &[P::Word; READ],
    from: &Sources<'_, A, P::Word, D, READ>,
    skip: Option<usize>,
    sum: &mut [P::Sum; TERM],
) -> Result<(), FaultKind>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    let read_i = read(read_i);
    let reach_squared = pass.reach_squared();
    let skip = skip.map_or(u32::MAX, |i| i as u32);
    let mut list = [0u32; LIST];
    let mut listed = 0;
    let mut neighbours = 0;
    let mut result = Ok(());
    let mut add = |list: &[u32]| {
        neighbours += list.len();
        for &j in list {
            let (x_ij, r2) = separation::<A, D>(x_i, &from.position[j as usize]);
            let read_j = read(&from.read[j as usize]);
            let argument = pass.argument(r2);
            if !accumulate(sum, pass.term(&x_ij, argument, &read_i, &read_j)) {
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

/// Which executor, by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExecutorKind {
    /// The core's reference, one thread.
    Serial,
    /// The reference's traversal on all threads asked for.
    Rayon,
    /// Vectorised half-pair sweeps on all threads asked for.
    #[default]
    Fast,
}

impl ExecutorKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Serial, Self::Rayon, Self::Fast];

    /// The name used on the command line and in outputs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Rayon => "rayon",
            Self::Fast => "fast",
        }
    }

    /// The executor of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// An executor, ready to work.
#[derive(Debug)]
pub(crate) enum AnyExecutor {
    Serial(Serial),
    Rayon(Rayon),
    Fast(Box<Fast>),
}
