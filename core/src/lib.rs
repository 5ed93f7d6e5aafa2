//! The core of Loschmidt: smoothed particle hydrodynamics that can be run backwards, bit for bit.
//!
//! No `std`, no allocator, no `unsafe`: the same step runs on a microcontroller and on a server
//! and leaves the same bits. Read it in layers, each standing on those before it:
//!
//! 1. [`number`]: fixed-point types of the state, the one odd rounding, the floats of a pair term.
//! 2. [`kernel`], [`neighbours`], [`pairs`], [`chain`]: the smoothing kernel, cells, and sums over
//!    pairs as integers, which no order can change.
//! 3. [`state`]: the fields a run consists of, on memory lent by the caller, and the scratch.
//! 4. [`model`]: forces; the reversible scheme and the standard one it is compared with.
//!    [`integrator`]: symmetric tables of kicks and drifts.
//! 5. [`executor`]: who walks the pairs; [`Serial`] is the reference.
//! 6. [`diagnostics`] (energies, momenta, entropy) and [`digest`] (equality of states): they read.
//! 7. [`owned`]: all of it in `heapless` vectors, for targets without an allocator.
//!
//! The contract: a run is a function of its parameters and initial state alone, and n steps, a
//! reversal and n steps give back the first state, for as long as the numbers stay in range.
//! Leaving the range is a typed [`Fault`] that names the particle and the step.

#![no_std]
#![forbid(unsafe_code)]

pub mod chain;
pub mod diagnostics;
pub mod digest;
pub mod exact;
pub mod executor;
pub mod fault;
pub mod integrator;
pub mod kernel;
pub mod model;
pub mod neighbours;
pub mod number;
pub mod owned;
pub mod pairs;
pub mod state;

pub use diagnostics::{Diagnostics, Energies};
pub use digest::Digest;
pub use executor::{Executor, Serial};
pub use fault::{CapacityError, Fault, FaultKind};
pub use model::{Filtered, Forces, Model, Parameters, Reversibility, Standard, Symplectic};
pub use number::{Arithmetic, Fixed, Float, Scale};
pub use state::{Progress, Scratch, State, System, Walls};
