//! The std side of Loschmidt: executors, storage, simulations.

#![forbid(unsafe_code)]

mod executor;
pub mod frame;
pub mod saved;
pub mod simulation;
mod storage;

pub use executor::{ExecutorKind, Rayon};
pub use frame::Frame;
pub use saved::{ArithmeticKind, SavedState};
pub use simulation::{BuildError, ModelKind, Options, Particles, Simulation};
