//! The parallel executor.
//!
//! Particles are split among the threads of a rayon pool; each is summed by the core's own
//! `gather`. The sums are integers in the fixed-point state, so their order could not matter; here
//! it is even the same.

use loschmidt_core::{Executor, Fault, Serial};
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Fewest particles worth a task of their own: about 50 µs of work.
const GRAIN: usize = 128;

/// rayon, on a pool of its own.
#[derive(Debug)]
pub struct Rayon {
    pool: rayon::ThreadPool,
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
        Ok(Self { pool })
    }

    /// Runs `work` on the pool, so that what it does in parallel need not be handed over each time.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.pool.install(work)
    }
}

impl Executor for Rayon {
    fn name(&self) -> &'static str {
        "rayon"
    }

    fn for_each<T: Send>(
        &self,
        items: &mut [T],
        f: impl Fn(usize, &mut T) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        let run = || {
            items
                .par_iter_mut()
                .with_min_len(GRAIN)
                .enumerate()
                .filter_map(|(i, item)| f(i, item).err())
                .reduce_with(Fault::first)
        };
        self.pool.install(run).map_or(Ok(()), Err)
    }
}

/// Which executor, by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExecutorKind {
    /// The core's reference, one thread.
    Serial,
    /// All threads asked for.
    #[default]
    Rayon,
}

impl ExecutorKind {
    /// The name used on the command line and in outputs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Rayon => "rayon",
        }
    }
}

/// An executor, ready to work.
#[derive(Debug)]
pub(crate) enum AnyExecutor {
    Serial(Serial),
    Rayon(Rayon),
}
