//! The std side of Loschmidt: from a scene file to the outcome of a run.
//!
//! ```text
//! scene file -> Scene -> InitialState -> Simulation (core, any type) -> Player -> Run -> files
//! ```
//!
//! 1. [`scene`]: the scene language, its errors, the catalogue.
//!    [`isc`] corrects the initial state so that no density constants are needed.
//! 2. [`setup`]: a scene's parameters for the core, and the memory it takes.
//!    [`own`]: models of one's own.
//! 3. [`simulation`]: a simulation without type parameters; [`Rayon`] and [`fast`], the parallel
//!    executors.
//! 4. [`player`]: moves along time in both directions. Going back is integrating back.
//! 5. [`run`]: out, turn, back, and what is recorded; [`output`]: the files.
//! 6. [`deck`]: a player on a thread of its own, for faces that must never wait for a step.

// Allowed in one module, `fast::sweep`, which says why.
#![deny(unsafe_code)]

pub mod deck;
mod drive;
pub mod enclosure;
mod engine;
mod executor;
pub mod fast;
pub mod figures;
pub mod filter;
pub mod frame;
mod given;
pub mod isc;
mod memory;
mod model_list;
pub mod output;
pub mod own;
pub mod plain;
pub mod player;
pub mod points;
mod pool;
mod random;
pub mod ranged_fault;
pub mod run;
pub mod saved;
pub mod scene;
pub mod setup;
pub mod simulation;
mod storage;
pub mod totals;

pub use deck::Deck;
pub use engine::simulate;
pub use executor::ExecutorKind;
pub use frame::Frame;
pub use player::{Arrow, Player};
pub use points::Points;
pub use pool::Rayon;
pub use run::{Outcome, Plan, Run, RunError};
pub use saved::{ArithmeticKind, SavedState};
pub use simulation::{BuildError, Options, Simulation};
