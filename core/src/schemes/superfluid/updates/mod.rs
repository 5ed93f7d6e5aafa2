//! What happens to one particle between the sums over pairs.

mod kicks;
mod sums;

pub use kicks::{Add, Carry, Flow, KeepRates, Kick, Stretch, TakeRates};
pub use sums::{NoFluxes, NoGradient, NoSums, Resolve, SetConstant, SetCopies};
