//! Models: a folder each.

pub mod wcsph;
