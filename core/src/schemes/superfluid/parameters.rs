//! Parameters of the superfluid models, in SI units.

use super::helium::Helium;
use crate::integrator::STORMER_VERLET;
use crate::model::{Settings, SetupError};
use crate::neighbours::Grid;
use crate::number::{Scale, round, sqrt};
use heapless::Vec;

/// Most parts that the walls consist of.
pub const MAX_WALLS: usize = 32;

/// Which gradient of the temperature and which divergence of the entropy flux are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Operators {
    /// Those of eq. (19): simple sums, which lack what would lie beyond a free surface.
    Paper,
    /// The gradient that is exact for linear fields, and its dual for the flux.
    #[default]
    Renormalised,
}

/// A part of the walls, of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallPart<const D: usize> {
    /// Place of its first particle among those of all walls.
    pub first: u64,
    /// Whether the normal component rubs against it.
    pub rough: bool,
    /// β of the conduction between the liquid and this wall, which stays at T0, W/(m K²); 0 of an
    /// adiabatic one.
    pub conduction: f64,
    /// The velocity with which it rubs, m/s: that of a lid, whose particles stay where they are.
    pub velocity: [f64; D],
}

impl<const D: usize> Default for WallPart<D> {
    fn default() -> Self {
        Self {
            first: 0,
            rough: true,
            conduction: 0.0,
            velocity: [0.0; D],
        }
    }
}

/// A source of heat at a point, spread by the kernel and normalised. With friction alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heater<const D: usize> {
    /// m.
    pub place: [f64; D],
    /// W (in 2D W for each metre of depth).
    pub power: f64,
    /// Where the kernel that spreads it vanishes, m: twice the H of the paper.
    pub radius: f64,
}

/// A porous plug, which holds the normal component and lets the other one pass. With friction alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Superleak<const D: usize> {
    /// Middle of a plate, m.
    pub centre: [f64; D],
    /// Half of its lengths along each axis, m; one of them may be 0.
    pub half: [f64; D],
    /// The distance from the plate at which it is felt no more, m: twice the H of the paper.
    pub radius: f64,
    /// τ: the time in which it holds the normal component in the plate, s.
    pub time: f64,
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
    /// A of the mutual friction, m s/kg, whose force is A ρ_s ρ_n |v_n - v_s|² (v_n - v_s) per
    /// volume. With friction alone.
    pub mutual_friction: f64,
    /// The mean of (s - s0)/s0 at the start, from which heat is counted. With friction alone.
    pub first_excess: f64,
    /// The distance |w - W|, m/s, at which the two copies of the counterflow are too far apart to
    /// mean anything; infinite where that is no error.
    pub most_separation: f64,
    /// Uniform acceleration, m/s².
    pub gravity: [f64; D],
    /// The height, against gravity, of the surface above which the first pressure is 0, m; the
    /// first pressure is 0 everywhere where there is none.
    pub surface: Option<f64>,
    /// The parts of the walls, in the order of their first particles.
    pub walls: Vec<WallPart<D>, MAX_WALLS>,
    /// Whether walls pull where the liquid beside them is stretched.
    pub suction: bool,
    /// A heater.
    pub heater: Option<Heater<D>>,
    /// A superleak.
    pub superleak: Option<Superleak<D>>,
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
    /// superfluid component is missing a twentieth of first sound.
    #[must_use]
    pub fn heat_speed(&self) -> f64 {
        let helium = &self.helium;
        helium.second_sound().max(helium.sound_speed / 20.0)
    }

    /// The first pressure at a place (m) over ρ0 u_1²: that of the liquid above it.
    #[must_use]
    pub fn first_compression(&self, x: &[f64; D]) -> f64 {
        let Some(surface) = self.surface else {
            return 0.0;
        };
        let (mut squared, mut fallen) = (0.0, 0.0);
        for (g, x) in self.gravity.iter().zip(x) {
            squared += g * g;
            fallen += g * x;
        }
        // Height is counted against gravity: g times it is -g·x.
        let above = sqrt(squared) * surface + fallen;
        let sound = self.helium.sound_speed;
        above.max(0.0) / (sound * sound)
    }

    /// The part of the walls that a particle in this place among theirs belongs to.
    #[must_use]
    pub fn wall_of(&self, place: u64) -> WallPart<D> {
        let before = |part: &&WallPart<D>| part.first <= place;
        let part = self.walls.iter().rev().find(before);
        part.copied().unwrap_or_default()
    }

    /// Whether there is no superfluid component, and never will be.
    #[must_use]
    pub fn is_normal(&self) -> bool {
        let helium = &self.helium;
        helium.normal_fraction == 1.0 && helium.fraction_slope == 0.0
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
        let mutual = self.mutual_friction;
        accept("mutual_friction", mutual, mutual >= 0.0)?;
        self.check_devices(accept)?;
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

    /// Checks walls, heater and superleak.
    fn check_devices(
        &self,
        accept: impl Fn(&'static str, f64, bool) -> Result<(), SetupError>,
    ) -> Result<(), SetupError> {
        let positive = |name, value: f64| accept(name, value, value > 0.0);
        accept("surface", self.surface.unwrap_or_default(), true)?;
        for part in &self.walls {
            accept("conduction", part.conduction, part.conduction >= 0.0)?;
            for v in part.velocity {
                accept("velocity of a wall", v, true)?;
            }
        }
        if let Some(heater) = &self.heater {
            accept("heater.power", heater.power, heater.power >= 0.0)?;
            positive("heater.radius", heater.radius)?;
            for x in heater.place {
                accept("heater.place", x, true)?;
            }
        }
        if let Some(leak) = &self.superleak {
            positive("superleak.radius", leak.radius)?;
            positive("superleak.time", leak.time)?;
            for (x, half) in leak.centre.iter().zip(leak.half) {
                accept("superleak.centre", *x, true)?;
                accept("superleak.half", half, half >= 0.0)?;
            }
        }
        Ok(())
    }
}
