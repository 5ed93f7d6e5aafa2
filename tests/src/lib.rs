//! The claims of Loschmidt, as tests: see `tests/`. Here is what they share.
//!
//! - [`program`]: scenes, players and runs in a line each.

pub mod program;
