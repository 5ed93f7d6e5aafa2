//! The keys of the viscous model: what the fluid is, and how its walls are seen.

use super::declare::keys;
use super::schema::Family;
use super::schema::IfAbsent::{Number, Required, Word};
use super::schema::Range::{Above, Any, AtLeast};
use super::words::words;
use loschmidt_core::schemes::solid as core;
use loschmidt_core::schemes::solid::{Material, ShearEnergy};

/// The models that have these keys.
pub(super) const FAMILY: Family = "viscous";
/// The same, for declarations.
pub(super) const VISCOUS: Option<Family> = Some(FAMILY);

keys! {
    /// The material of a viscous fluid. In the plane a density is per area, kg/m².
    #[derive(Copy)]
    Viscous of VISCOUS, table Header "`[viscous]`" {
        reference_density: f64 = Required, Above(0.0),
            "density of the fluid at rest", "kg/m³";
        bulk_speed: f64 = Required, Above(0.0),
            "c_0, the speed of sound; 10 times that of the flow keeps it nearly incompressible",
            "m/s";
        shear_speed: f64 = Required, Above(0.0),
            "c_s, the speed of shear waves before they relax; 10 times that of the flow or more",
            "m/s";
        viscosity: f64 = Required, Above(0.0),
            "nu, the kinematic viscosity: the distortion relaxes in 6 nu/c_s²", "m²/s";
        penalty: f64 = Number(0.0), AtLeast(0.0),
            "c_p/c_0, the strength of the penalty that keeps particles from pairing; it stiffens \
             the fluid and slows the flow";
        relaxation: Relaxation = Word(Relaxation::Exact.word()), Any,
            "how the distortion relaxes: with the viscosity of `viscosity` for every time step, or \
             as the paper has it, which makes the fluid too thin";
        wall_velocity: WallVelocity = Word(WallVelocity::Mirrored.word()), Any,
            "velocity of walls in velocity gradients: the flow's, continued through the surface that \
             they have with the fluid at the start or inside a layer, or their own";
        start: f64 = Number(0.0), AtLeast(0.0),
            "until when moving walls are accelerated, smoothly", "s";
    }
}

words! {
    /// How the distortion relaxes in a step.
    Relaxation {
        /// One update, with the exact steady viscosity.
        Exact = "exact",
        /// Runge and Kutta's fourth order, as printed.
        Paper = "paper",
    }
}

words! {
    /// Which velocity walls have in velocity gradients.
    WallVelocity {
        /// That of the flow, continued through the surface.
        Mirrored = "mirrored",
        /// Their own.
        Plain = "plain",
    }
}

impl Viscous {
    /// The material as the core has it.
    #[must_use]
    pub fn material(&self) -> Material {
        Material {
            bulk_speed: self.bulk_speed,
            shear_speed: self.shear_speed,
            penalty_speed: self.penalty * self.bulk_speed,
            energy: ShearEnergy::Dpr,
        }
    }

    /// τ = 6 ν/c_s², s.
    #[must_use]
    pub fn relaxation_time(&self) -> f64 {
        6.0 * self.viscosity / (self.shear_speed * self.shear_speed)
    }

    /// How the core lets it relax.
    #[must_use]
    pub fn law(&self) -> core::Relaxation {
        match self.relaxation {
            Relaxation::Exact => core::Relaxation::Exact,
            Relaxation::Paper => core::Relaxation::Paper,
        }
    }

    /// What walls pretend in the core.
    #[must_use]
    pub fn pretended(&self) -> core::WallVelocity {
        match self.wall_velocity {
            WallVelocity::Mirrored => core::WallVelocity::Mirrored,
            WallVelocity::Plain => core::WallVelocity::Plain,
        }
    }
}
