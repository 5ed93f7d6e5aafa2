//! Models: a folder each.

pub mod solid;
pub mod wcsph;
