//! Parameters of the superfluid models, in SI units.

use super::helium::Helium;
use crate::integrator::STORMER_VERLET;
use crate::model::{Settings, SetupError};
use crate::neighbours::Grid;
use crate::number::{Scale, round};

/// Which gradient of the temperature and which divergence of the entropy flux are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Operators {
    /// Those of eq. (19): simple sums, which lack what would lie beyond a free surface.
    Paper,
    /// The gradient that is exact for linear fields, and its dual for the flux.
    #[default]
    Renormalised,
}

/// Parameters of a superfluid in D dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct HeliumParameters<const D: usize> {
    /// Where the kernel vanishes, m: twice the h of the paper.
    pub support_radius: f64,
    /// δr: a particle stands for a square or cube of this side, m.
    pub particle_spacing: f64,
    /// dt, s.
    pub time_step: f64,
    /// The constitutive laws.
    pub helium: Helium,
    /// The operators.
    pub operators: Operators,
    /// μ, the viscosity of the normal component, Pa s. With friction alone.
    pub viscosity: f64,
    /// β, the diffusion of heat, W/(m K²): entropy diffuses by β ΔT/ρ. With friction alone.
    pub diffusion: f64,
    /// The mean of (s - s0)/s0 at the start, from which heat is counted. With friction alone.
    pub first_excess: f64,
    /// The distance |w - W|, m/s, at which the two copies of the counterflow are too far apart to
    /// mean anything; infinite where that is no error.
    pub most_separation: f64,
    /// Uniform acceleration, m/s².
    pub gravity: [f64; D],
    /// Width of a bin of the histogram of speeds, m/s.
    pub speed_bin: f64,
    /// Units of the state.
    pub scale: Scale,
    /// Size of the region where particles are expected, m: it sizes the grid, nothing else.
    pub extent: [f64; D],
    /// Most buckets for the cells.
    pub max_buckets: usize,
}

impl<const D: usize> HeliumParameters<D> {
    /// V0 = δr^D, m³ (2D: m²).
    #[must_use]
    pub fn volume(&self) -> f64 {
        (0..D).fold(1.0, |volume, _| volume * self.particle_spacing)
    }

    /// The mass of a particle, kg (per m of depth in 2D).
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.helium.reference_density * self.volume()
    }

    /// The speed whose square is the unit of heats, m/s: that of second sound, or where the
    /// superfluid component is missing a thousandth of first sound.
    #[must_use]
    pub fn heat_speed(&self) -> f64 {
        let helium = &self.helium;
        helium.second_sound().max(1e-3 * helium.sound_speed)
    }

    /// What every model says of itself.
    ///
    /// # Errors
    /// A reach out of the number range.
    pub(super) fn settings(&self) -> Result<Settings<D>, SetupError> {
        let length = self.scale.length_quantum();
        let extent = self.extent.map(|e| (e / length) as i64);
        let reach = round(self.support_radius / length).ok_or(SetupError::Parameter {
            name: "support_radius",
            value: self.support_radius,
        })?;
        let grid = Grid::new(reach, extent, self.max_buckets);
        Ok(Settings {
            scale: self.scale,
            mass: self.mass(),
            time_step: self.time_step,
            integrator: &STORMER_VERLET,
            speed_bin: self.speed_bin,
            grids: [grid; 2],
        })
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first parameter that is not finite or not in its range.
    pub fn check(&self) -> Result<(), SetupError> {
        let accept = |name, value: f64, in_range: bool| {
            if in_range && value.is_finite() {
                Ok(())
            } else {
                Err(SetupError::Parameter { name, value })
            }
        };
        let positive = |name, value: f64| accept(name, value, value > 0.0);
        let helium = &self.helium;
        positive("support_radius", self.support_radius)?;
        positive("particle_spacing", self.particle_spacing)?;
        positive("time_step", self.time_step)?;
        positive("temperature", helium.temperature)?;
        positive("reference_density", helium.reference_density)?;
        positive("entropy", helium.entropy)?;
        positive("sound_speed", helium.sound_speed)?;
        positive("heat_capacity", helium.heat_capacity)?;
        let fraction = helium.normal_fraction;
        accept(
            "normal_fraction",
            fraction,
            fraction > 0.0 && fraction <= 1.0,
        )?;
        accept("fraction_slope", helium.fraction_slope, true)?;
        positive("speed_bin", self.speed_bin)?;
        accept(
            "first_excess",
            self.first_excess,
            self.first_excess.abs() < 8.0,
        )?;
        accept("viscosity", self.viscosity, self.viscosity >= 0.0)?;
        accept("diffusion", self.diffusion, self.diffusion >= 0.0)?;
        // An infinite bound is none.
        let separation = self.most_separation;
        if separation.is_nan() || separation <= 0.0 {
            return accept("separation", separation, false);
        }
        for g in self.gravity {
            accept("gravity.uniform", g, true)?;
        }
        for size in self.extent {
            accept("extent", size, size >= 0.0)?;
        }
        Ok(())
    }
}
