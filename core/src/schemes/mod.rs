//! Models: a folder each.

pub mod solid;
pub mod superfluid;
pub mod wcsph;
