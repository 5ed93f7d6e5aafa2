//! Superfluid helium as one fluid with two motions (model C).
//!
//! [`Superfluid`] is the scheme that returns to its first bit, [`PaperSuperfluid`] the paper's own
//! integrator, with which it is compared. [`Helium`] holds the constitutive laws, [`Operators`] says
//! which gradients are taken.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124.

mod energy;
mod fields;
mod helium;
mod liquid;
mod paper;
mod parameters;
mod passes;
mod reversible;
mod updates;

pub use fields::{
    CARRIER, COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, DENSITY_CONSTANT, ENTROPY, ENTROPY_COPY,
    FLUXES, GRADIENT, INFLOW, INVERSE, PULL, RATES, SUMS,
};
pub use helium::Helium;
pub use liquid::Liquid;
pub use paper::PaperSuperfluid;
pub use parameters::{HeliumParameters, Operators};
pub use passes::{Carrier, FluxPass, Fluxes, GradientPass, Sums, SumsPass};
pub use reversible::Superfluid;
