//! The core of Loschmidt: smoothed particle hydrodynamics that can be run backwards, bit for bit.
//!
//! No `std` (but for a feature that takes its square root), no allocator, no `unsafe`: the same
//! step runs on a microcontroller and on a server and leaves the same bits. Read it in layers, each
//! standing on those before it:
//!
//! 1. [`rounding`]: the one odd rounding, and sums that have no order. [`number`]: fixed-point types
//!    of the state, doubles of a pair term. [`mod@values`]: numbers with names.
//! 2. [`fields`]: what a particle consists of, declared once. [`set`], [`operands`]: particles on
//!    memory lent by the caller.
//! 3. [`kernel`], [`neighbours`], [`pairs`], [`points`]: the smoothing kernel, cells, sums over
//!    pairs as integers, which no order can change, and what happens to one particle.
//! 4. [`executor`]: who walks particles and pairs; [`Serial`] is the reference. [`system`]: all
//!    that a step works on.
//! 5. [`model`]: what a scheme declares. [`shears`], [`mod@lift`], [`integrator`]: kicks, drifts and
//!    lifts of a matrix, and symmetric tables of them. [`schemes`]: the schemes, a folder each.
//! 6. [`observe`] (energies, momenta, entropy) and [`digest`] (equality of states): they read.
//! 7. [`owned`]: all of it in memory of fixed size, for targets without an allocator.
//!
//! The contract: a run is a function of its parameters and initial state alone, and n steps, a
//! reversal and n steps give back the first state, for as long as the numbers stay in range.
//! Leaving the range is a typed [`Fault`] that names the particle and the step.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

pub mod digest;
pub mod exact;
pub mod executor;
pub mod fault;
pub mod fields;
pub mod integrator;
pub mod kernel;
pub mod lift;
mod matrix;
pub mod model;
pub mod neighbours;
pub mod number;
pub mod observe;
pub mod operands;
pub mod owned;
pub mod pairs;
pub mod points;
pub mod prelude;
pub mod rounding;
pub mod schemes;
pub mod set;
pub mod shears;
pub mod system;
pub mod values;

pub use digest::Digest;
pub use executor::{Executor, Serial};
pub use fault::{CapacityError, Fault, FaultKind};
pub use model::{Model, Reversibility};
pub use number::{Arithmetic, Fixed, Float, Scale};
pub use observe::{Diagnostics, Energies};
pub use schemes::wcsph::{Filtered, Parameters, Standard, Symplectic};
pub use system::{Clock, System};
