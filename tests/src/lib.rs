//! The claims of Loschmidt, as tests: see `tests/`. Here is what they share.
//!
//! - [`mod@conformance`]: every executor against the core's plain step, for any model.
//! - [`permitted`]: every error that a test allows, in one place, each with its reason. A test that
//!   is not listed there compares bits.
//! - [`bodies`]: small elastic bodies.
//! - [`small`]: small systems in `heapless` vectors, the same recipe for every scheme, dimension
//!   and arithmetic.
//! - [`helium`]: small drops of helium.
//! - [`generator`]: numbers that look random and are the same everywhere.
//! - [`program`]: scenes, players and runs in a line each.

pub mod bodies;
pub mod conformance;
pub mod generator;
pub mod helium;
pub mod permitted;
pub mod program;
pub mod small;
