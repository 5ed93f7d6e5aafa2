//! Parameters of the solids, in SI units.

use super::material::Material;
use crate::integrator::STORMER_VERLET;
use crate::model::{Settings, SetupError};
use crate::neighbours::Grid;
use crate::number::{Scale, round};
use crate::observe::BINS;
use heapless::Vec;

/// Most bodies of a system.
pub const MAX_BODIES: usize = 8;
/// Most parts that the bodies consist of.
pub const MAX_PARTS: usize = 16;

/// Particles with consecutive ids that belong to one body and are all held, or all free.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Part {
    /// Id of its first particle; it ends where the next part begins.
    pub first: u64,
    /// Number of the body.
    pub body: u8,
    /// Whether its particles never move but by their motion.
    pub held: bool,
    /// How held particles move, once at full speed. Fluids alone: those of solids stand still.
    pub motion: Motion,
}

/// The motion of a wall; in the plane the third components do not count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Motion {
    /// It stands still.
    #[default]
    Still,
    /// It slides along itself, as a lid does: its particles stay where they are and pretend to have
    /// this velocity, m/s.
    Slides([f64; 3]),
    /// It turns about an axis, and its particles with it.
    Turns {
        /// Angular velocity, rad/s; in the plane along the third axis.
        rate: [f64; 3],
        /// A point on the axis, m.
        centre: [f64; 3],
    },
}

/// The material of a body. Its number comes with a state, which may have been written by anybody.
#[inline(always)]
pub(super) fn material_of(materials: &[Material], body: i64) -> Material {
    let known = usize::try_from(body)
        .ok()
        .and_then(|body| materials.get(body));
    // Parameters without a material are refused before.
    *known.unwrap_or(&materials[0])
}

/// Parameters of a model of solids in D dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters<const D: usize> {
    /// Where the kernel vanishes, m: twice the h of the paper.
    pub support_radius: f64,
    /// δr: a particle stands for a square or cube of this side, m.
    pub particle_spacing: f64,
    /// dt, s.
    pub time_step: f64,
    /// ρ0 of every body, kg/m³: all particles have one mass, so that they exchange momentum
    /// exactly.
    pub reference_density: f64,
    /// What each body is made of.
    pub materials: Vec<Material, MAX_BODIES>,
    /// The parts of the bodies, in the order of their first ids; the first one begins with id 0.
    pub parts: Vec<Part, MAX_PARTS>,
    /// Uniform acceleration, m/s².
    pub gravity: [f64; D],
    /// Units of the state.
    pub scale: Scale,
    /// Size of the region where particles are expected, m: it sizes the grid, nothing else.
    pub extent: [f64; D],
    /// Most buckets for the cells.
    pub max_buckets: usize,
}

impl<const D: usize> Parameters<D> {
    /// V0 = δr^D, m³ (2D: m²).
    #[must_use]
    pub fn volume(&self) -> f64 {
        (0..D).fold(1.0, |volume, _| volume * self.particle_spacing)
    }

    /// The mass of a particle, kg (per m of depth in 2D).
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.reference_density * self.volume()
    }

    /// The fastest longitudinal waves of all bodies, m/s.
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        let speeds = self.materials.iter().map(Material::longitudinal_speed);
        speeds.fold(0.0, f64::max)
    }

    /// The part that a particle belongs to.
    #[must_use]
    pub fn part_of(&self, id: u64) -> Part {
        let before = |part: &&Part| part.first <= id;
        let part = self.parts.iter().rev().find(before);
        part.copied().unwrap_or_default()
    }

    /// What the body of this number is made of; one that does not exist, of the first material.
    #[must_use]
    pub fn material(&self, body: i64) -> Material {
        material_of(&self.materials, body)
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
            // Bodies move much slower than sound: the bins end at a sixth of it.
            speed_bin: self.sound_speed() / (6.0 * BINS as f64),
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
        positive("support_radius", self.support_radius)?;
        positive("particle_spacing", self.particle_spacing)?;
        positive("time_step", self.time_step)?;
        positive("reference_density", self.reference_density)?;
        accept("materials", 0.0, !self.materials.is_empty())?;
        for material in &self.materials {
            positive("bulk_speed", material.bulk_speed)?;
            positive("shear_speed", material.shear_speed)?;
            let penalty = material.penalty_speed;
            accept("penalty_speed", penalty, penalty >= 0.0)?;
        }
        for part in &self.parts {
            let known = usize::from(part.body) < self.materials.len();
            accept("body", f64::from(part.body), known)?;
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
