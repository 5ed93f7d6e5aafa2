//! Weakly compressible SPH (model A).
//!
//! [`Water`] holds what the schemes share: kernel, state equation, gravity, walls. [`Symplectic`]
//! is the reversible scheme of Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593;
//! [`Standard`] is the usual one that it is compared with; [`Filtered`] is the first with its noise
//! filtered out, which no reversal brings back.

mod energy;
mod fields;
mod filtered;
mod gravity;
mod parameters;
mod passes;
mod standard;
mod state_equation;
mod symplectic;
mod updates;
mod water;

pub use fields::{CONSTANT, DENSITY, FIXED_DENSITY, PRESSURE};
pub use filtered::{Filter, Filtered};
pub use gravity::Pull;
pub use parameters::{AntiClump, Central, DensityCorrection, Gravity, Parameters, Wall};
pub use passes::{
    AntiClumpEnergyPass, AntiClumpPass, ContinuityPass, DensityPass, FilterPass, Moving, Pressed,
    PressurePass, WallEnergyPass, WallPass,
};
pub use standard::Standard;
pub use state_equation::StateEquation;
pub use symplectic::Symplectic;
pub use updates::PressureFactor;
pub use water::Water;
