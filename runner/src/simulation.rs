//! A simulation without type parameters: any dimension, arithmetic, model and executor.

use crate::executor::ExecutorKind;
use crate::fast::Backend;
use crate::frame::Frame;
use crate::points::Points;
use crate::pool::{Rayon, of_use};
use crate::saved::{ArithmeticKind, SavedState};
use loschmidt_core::{Diagnostics, Digest, Fault, Reversibility};
use std::num::NonZeroUsize;
use thiserror::Error;

/// How a scene is run; none of it changes a bit of a fixed-point state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Who walks the particles.
    pub executor: ExecutorKind,
    /// Instructions of the fast executor.
    pub backend: Backend,
    /// Threads of a parallel executor; it starts at most twice as many as there are processors, or
    /// eight.
    pub threads: NonZeroUsize,
    /// Numbers of the state.
    pub arithmetic: ArithmeticKind,
    /// Seed of a permutation of the storage; `None` keeps the lattice order.
    pub shuffle: Option<u64>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            executor: ExecutorKind::default(),
            backend: Backend::best(),
            threads: std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN),
            arithmetic: ArithmeticKind::default(),
            shuffle: None,
        }
    }
}

impl Options {
    /// Threads that the executor uses: one if it is serial.
    #[must_use]
    pub fn threads_at_work(&self) -> usize {
        match self.executor {
            ExecutorKind::Serial => 1,
            ExecutorKind::Rayon | ExecutorKind::Fast => of_use(self.threads).get(),
        }
    }
}

/// Why a simulation could not be set up.
#[derive(Debug, Error)]
pub enum BuildError {
    /// A parameter out of range.
    #[error("the scene cannot be simulated: {0}")]
    Setup(#[from] loschmidt_core::model::SetupError),
    /// A particle outside the number range.
    #[error("particle {particle} starts outside the number range")]
    Range {
        /// Its id.
        particle: u64,
    },
    /// The initial state cannot be evaluated.
    #[error("the initial state cannot be evaluated: {0}")]
    Fault(#[from] Fault),
    /// No threads.
    #[error("cannot start the threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A scene whose model this program has not registered.
    #[error("this program does not know the model `{0}` of the scene")]
    UnknownModel(&'static str),
    /// A registered model that cannot do what scene or options ask for.
    #[error("the model `{model}` is not written for {what}")]
    Unsuited {
        /// Its name.
        model: &'static str,
        /// What is asked for.
        what: &'static str,
    },
    /// A saved state of another scene.
    #[error("the saved state does not belong to this scene: {0}")]
    Foreign(&'static str),
}

/// A run in progress.
pub trait Simulation: Send {
    /// Steps taken over all legs.
    fn step(&self) -> u64;
    /// Takes `steps` steps.
    ///
    /// # Errors
    /// The particle and the step where the numbers ended. The state is then of no use.
    fn advance(&mut self, steps: u64) -> Result<(), Fault>;
    /// Turns time round.
    fn reverse(&mut self);
    /// What turning round can promise.
    fn reversibility(&self) -> Reversibility;
    /// Energies, momenta, speeds.
    ///
    /// # Errors
    /// As a step.
    fn measure(&mut self) -> Result<Diagnostics, Fault>;
    /// The digest of the state.
    fn digest(&mut self) -> Digest;
    /// A copy of the state.
    fn save(&mut self) -> SavedState;
    /// Puts a saved state back.
    ///
    /// # Errors
    /// It has other particles, units or fields.
    fn restore(&mut self, saved: &SavedState) -> Result<(), BuildError>;
    /// A picture of the state; its times are left to the caller.
    ///
    /// # Errors
    /// As a step.
    fn frame(&mut self) -> Result<Frame, Fault>;
    /// What is drawn of it, in the memory of earlier points.
    ///
    /// # Errors
    /// As a step.
    fn points(&mut self, points: &mut Points) -> Result<(), Fault>;
    /// Gives back memory that only steps need. The next step makes it anew, at the cost of a step
    /// or two; no bit depends on it.
    fn release(&mut self);
    /// What the pair sums so far were made with: an instruction set, `serial` for the plain
    /// traversal (in the other executors, and where a sweep could not hold its range), or both.
    fn backend(&self) -> String;
    /// The threads that take the steps, where there are others than the caller's.
    fn pool(&self) -> Option<Rayon>;
    /// Flips the lowest bit of the first coordinate of the particle with this id.
    fn flip_last_bit(&mut self, id: u64);
}
