//! Std-side runner of Loschmidt.

pub mod scene;
