//! Std-side runner of Loschmidt.
