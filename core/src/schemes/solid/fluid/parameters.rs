//! Parameters of a fluid whose distortion relaxes, in SI units.

use super::super::material::ShearEnergy;
use super::super::parameters::{Motion, Parameters};
use crate::model::SetupError;

/// How the distortion relaxes in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relaxation {
    /// One update whose steady viscosity is that of the parameters for every time step.
    Exact,
    /// The paper's (52d): one step of Runge and Kutta's fourth order. As printed, with the force
    /// taken of what has relaxed, it makes the fluid too thin: see [`Law`](super::Law).
    Paper,
}

/// Which velocity a wall particle pretends to have where velocity gradients are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WallVelocity {
    /// The velocity of the flow next to it, continued through the surface of the wall.
    Mirrored,
    /// The velocity of the wall.
    Plain,
}

/// Parameters of a fluid with the equations of solids in D dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidParameters<const D: usize> {
    /// What it has in common with solids. Held parts are walls.
    pub bodies: Parameters<D>,
    /// τ, s; the kinematic viscosity is c_s² τ/6.
    pub relaxation_time: f64,
    /// How the distortion relaxes.
    pub relaxation: Relaxation,
    /// What walls pretend.
    pub wall_velocity: WallVelocity,
    /// Until when moving walls are accelerated, s; 0: they move from the start.
    pub start: f64,
}

impl<const D: usize> FluidParameters<D> {
    /// Share of the walls' full speed at time t: 3 u² - 2 u³ of u = t/start, from 0 to 1.
    #[must_use]
    pub fn progress(&self, time: f64) -> f64 {
        if time >= self.start {
            return 1.0;
        }
        let u = time / self.start;
        u * u * (3.0 - 2.0 * u)
    }

    /// x = 6 dt/τ.
    #[must_use]
    pub fn steps_in_relaxation(&self) -> f64 {
        6.0 * self.bodies.time_step / self.relaxation_time
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
        let time = self.relaxation_time;
        accept("relaxation_time", time, time > 0.0)?;
        accept("start", self.start, self.start >= 0.0)?;
        for material in &self.bodies.materials {
            // The relaxation is that of this energy.
            let known = material.energy == ShearEnergy::Dpr;
            accept("energy", 0.0, known)?;
        }
        for part in &self.bodies.parts {
            let numbers = match part.motion {
                Motion::Still => [[0.0; 3]; 2],
                Motion::Slides(velocity) => [velocity, [0.0; 3]],
                Motion::Turns { rate, centre } => [rate, centre],
            };
            for x in numbers.as_flattened() {
                accept("motion", *x, true)?;
            }
        }
        if self.relaxation == Relaxation::Paper {
            let dt = self.bodies.time_step;
            accept("time_step", dt, dt < MOST_OF_PAPER * time)?;
        }
        Ok(())
    }
}

/// Above this share of τ the paper's relaxation grows instead of decaying: 6 dt/τ < 2.785, the
/// stability limit of Runge and Kutta's fourth order.
pub const MOST_OF_PAPER: f64 = 2.785 / 6.0;
