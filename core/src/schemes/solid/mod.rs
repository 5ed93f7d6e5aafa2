//! Elastic solids and viscous fluids with a distortion that every particle carries (model B).
//!
//! [`Solid`] is the scheme that returns to its first bit, [`Midpoint`] the paper's own integrator,
//! with which it is compared; they share everything but the order of a step and how the distortion
//! is advanced. In [`Viscous`] fluids the distortion relaxes. [`Material`] holds the energies and the elastic constants.
//!
//! Source: Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579.

mod bodies;
mod elastic;
mod energy;
mod fields;
mod fluid;
mod material;
mod parameters;
mod passes;
mod updates;

pub use bodies::Bodies;
pub use elastic::{Composition, Elastic, Middle, Midpoint, Palindrome, Solid};
pub use fields::{
    BESIDE, BODY, CLUMPING, CLUMPING_CONSTANT, DENSITY, DENSITY_CONSTANT, DISTORTION, EXCHANGED,
    FORCES, GRADIENT, HELD, INVERSE, LOG_VOLUME, MOMENTS, STRESS, WALL_OFFSET,
};
pub use fluid::{
    Beholding, Beside, BesidePass, Flow, FluidParameters, Law, MOST_OF_PAPER, Relaxation, Relaxing,
    Viscous, WallVelocity,
};
pub use material::{ElasticConstants, Material, ShearEnergy, whole_metric};
pub use parameters::{MAX_BODIES, MAX_PARTS, Motion, Parameters, Part};
pub use passes::{
    ForcePass, GradientPass, Moments, MomentsPass, Moving, SplitForce, SplitForcePass, Stressed,
};
