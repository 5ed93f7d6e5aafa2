//! The claims of Loschmidt, as tests: see `tests/`. Here is what they share.
//!
//! - [`permitted_runs`]: what whole runs are permitted, with reasons.
//! - [`program`]: scenes, players and runs in a line each.

pub mod permitted_runs;
pub mod program;
