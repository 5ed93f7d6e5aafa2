//! Superfluid helium as one fluid with two motions (model C).
//!
//! [`Superfluid`] is the scheme that returns to its first bit, [`PaperSuperfluid`] the paper's own
//! integrator, with which it is compared. In a [`DissipativeSuperfluid`] the normal component has
//! friction. [`Helium`] holds the constitutive laws, [`Operators`] says
//! which gradients are taken.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124.

mod devices;
mod energy;
mod fields;
mod friction;
mod helium;
mod liquid;
mod paper;
mod parameters;
mod passes;
mod reversible;
mod updates;
mod walls;

pub use fields::{
    CARRIER, COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, DENSITY_CONSTANT, ENTROPY, ENTROPY_COPY,
    FLUXES, GRADIENT, HEAT, HEATING, INFLOW, INVERSE, NORMAL, PULL, RATES, RUBBED, RUBBING, SUMS,
    TAKEN,
};
pub use friction::{
    DissipativeSuperfluid, Friction, FrictionPass, HeatPass, Normal, Rubbed, Rubbing,
};
pub use helium::Helium;
pub use liquid::Liquid;
pub use paper::PaperSuperfluid;
pub use parameters::{Heater, HeliumParameters, MAX_WALLS, Operators, Superleak, WallPart};
pub use passes::{Carrier, FluxPass, Fluxes, GradientPass, Sums, SumsPass};
pub use reversible::{Doubled, Superfluid};
pub use walls::{DensityPass, PressurePass};
