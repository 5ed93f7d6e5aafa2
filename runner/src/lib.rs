//! Std-side runner of Loschmidt.

pub mod frame;
pub mod output;
