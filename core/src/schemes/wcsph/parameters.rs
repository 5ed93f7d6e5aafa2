//! Parameters of the weakly compressible models, in SI units.

use super::StateEquation;
use crate::integrator::Integrator;
use crate::model::{Settings, SetupError};
use crate::neighbours::Grid;
use crate::number::{Scale, round};

/// Attraction by a fixed mass: a = -GM x/(|x|² + s²)^(3/2), x measured from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Central<const D: usize> {
    /// Position of the mass, m.
    pub centre: [f64; D],
    /// GM, m³/s².
    pub strength: f64,
    /// s, m.
    pub softening: f64,
}

/// External forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity<const D: usize> {
    /// Uniform acceleration, m/s².
    pub uniform: [f64; D],
    /// A fixed attracting mass.
    pub central: Option<Central<D>>,
}

/// How walls act on the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wall {
    /// Not at all.
    None,
    /// The repulsion of section 3.3: per fluid mass, with s = (r_w² + ε²)/(r² + ε²) for r < r_w,
    /// energy E (s - 1)²/4 and acceleration E (s² - s) x_ij/(r² + ε²). Footnote 3 gives E per mass.
    Conservative {
        /// E, J/kg.
        energy: f64,
        /// r_w, m.
        radius: f64,
        /// ε, m.
        softening: f64,
    },
    /// Fixed particles that take part in density and pressure like the fluid.
    Dummy,
}

/// A short-range repulsion that keeps particles from sticking together: per mass, acceleration
/// -(2 p0/ρ0²) Σ m W̃'(r) e and energy (p0/ρ0²) Σ m W̃(r), with W̃ the kernel of a support radius of
/// its own. The paper has p0/ρ_a² + p0/ρ_b²; with the reference density the force has a potential,
/// and the difference is of the order of the square of the Mach number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntiClump {
    /// p0, Pa.
    pub pressure: f64,
    /// Support radius of W̃, m.
    pub support_radius: f64,
}

/// What makes up for the missing neighbours at a free surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DensityCorrection {
    /// C_a = ρ0 - Σ m W at step 0, eq. (5).
    Constant,
    /// C_a = 0, eq. (4): also where the initial state was corrected instead.
    None,
}

/// Parameters of a model in D dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters<const D: usize> {
    /// h, where the kernel vanishes, m.
    pub support_radius: f64,
    /// dt, s.
    pub time_step: f64,
    /// Mass of every particle, kg (per m of depth in 2D).
    pub mass: f64,
    /// ρ0, kg/m³.
    pub reference_density: f64,
    /// c, m/s.
    pub sound_speed: f64,
    /// p(ρ).
    pub state_equation: StateEquation,
    /// Treatment of the free surface.
    pub density_correction: DensityCorrection,
    /// External forces.
    pub gravity: Gravity<D>,
    /// Walls.
    pub wall: Wall,
    /// The repulsion of particles that are very near to each other.
    pub anti_clump: Option<AntiClump>,
    /// M: steps between two filterings of [`Filtered`](super::Filtered), 0 for none; other models
    /// do not look at it.
    pub filter_every: u64,
    /// Row of the integrator table.
    pub integrator: &'static Integrator,
    /// Units of the state.
    pub scale: Scale,
    /// Size of the region where particles are expected, m: it sizes the grid, nothing else.
    pub extent: [f64; D],
    /// Most buckets for the fluid's cells, and for the walls' cells.
    pub max_buckets: usize,
}

impl<const D: usize> Parameters<D> {
    /// What every model says of itself, for sums that reach so far (m, each with the name of the
    /// parameter it comes from) between particles and to walls, and bins of speeds of this width
    /// (m/s).
    ///
    /// # Errors
    /// A reach out of the number range.
    pub fn settings(
        &self,
        reaches: [(&'static str, f64); 2],
        speed_bin: f64,
    ) -> Result<Settings<D>, SetupError> {
        let length = self.scale.length_quantum();
        let extent = self.extent.map(|e| (e / length) as i64);
        let grid = |(name, value): (&'static str, f64)| {
            let reach = round(value / length).ok_or(SetupError::Parameter { name, value })?;
            Ok(Grid::new(reach, extent, self.max_buckets))
        };
        Ok(Settings {
            scale: self.scale,
            mass: self.mass,
            time_step: self.time_step,
            integrator: self.integrator,
            speed_bin,
            grids: [grid(reaches[0])?, grid(reaches[1])?],
        })
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first parameter that is not finite or not in its range.
    pub fn check(&self) -> Result<(), SetupError> {
        let positive = |name, value: f64| accept(name, value, value > 0.0);
        let not_negative = |name, value: f64| accept(name, value, value >= 0.0);
        let any = |name, value: f64| accept(name, value, true);
        positive("support_radius", self.support_radius)?;
        positive("time_step", self.time_step)?;
        positive("mass", self.mass)?;
        positive("reference_density", self.reference_density)?;
        positive("sound_speed", self.sound_speed)?;
        if let Wall::Conservative {
            energy,
            radius,
            softening,
        } = self.wall
        {
            positive("wall.energy", energy)?;
            positive("wall.radius", radius)?;
            not_negative("wall.softening", softening)?;
        }
        if let Some(clump) = &self.anti_clump {
            not_negative("anti_clump.pressure", clump.pressure)?;
            positive("anti_clump.support_radius", clump.support_radius)?;
            // The neighbours are found within the fluid's own reach.
            accept(
                "anti_clump.support_radius",
                clump.support_radius,
                clump.support_radius <= self.support_radius,
            )?;
        }
        for g in self.gravity.uniform {
            any("gravity.uniform", g)?;
        }
        if let Some(central) = &self.gravity.central {
            for x in central.centre {
                any("gravity.central.centre", x)?;
            }
            any("gravity.central.strength", central.strength)?;
            not_negative("gravity.central.softening", central.softening)?;
        }
        for size in self.extent {
            not_negative("extent", size)?;
        }
        Ok(())
    }
}

fn accept(name: &'static str, value: f64, in_range: bool) -> Result<(), SetupError> {
    if in_range && value.is_finite() {
        Ok(())
    } else {
        Err(SetupError::Parameter { name, value })
    }
}
