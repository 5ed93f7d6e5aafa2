//! A scene, validated: every number finite, in range and in SI units.

use super::shape::{Point, Shape};
pub use super::words::{
    DensityCorrection, Dimension, EquationOfState, Integrator, LatticeKind, Model, RegionKind,
    WallModel,
};

/// A validated scene. Points have three coordinates; in two dimensions every z is 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Short name, fit for a folder: letters, digits, `-`, `_` and `.`.
    pub name: String,
    /// What happens in the scene; may be empty.
    pub description: String,
    /// Where the numbers come from; may be empty.
    pub source: String,
    /// Number of space dimensions.
    pub dimension: Dimension,
    /// Side of the square or cube of fluid that one particle stands for, m.
    pub particle_spacing: f64,
    /// Support radius in particle spacings.
    pub support: f64,
    /// How the time step is chosen.
    pub step: StepRule,
    /// Time at which all velocities are reversed, s; `None` is a one-way run.
    pub turnaround: Option<f64>,
    /// Time at which the run stops, s, both legs added, if the scene states one. Always
    /// stated without a turnaround.
    pub end: Option<f64>,
    /// Discretisation of the fluid.
    pub model: Model,
    /// Steps between two filterings of the model that filters.
    pub filter_every: u64,
    /// Composition of a step.
    pub integrator: Integrator,
    /// Correction of the summed density.
    pub density_correction: DensityCorrection,
    /// Action of walls on the fluid.
    pub wall_model: WallModel,
    /// The material.
    pub fluid: Fluid,
    /// Outside forces.
    pub gravity: Gravity,
    /// Potential of a conservative wall; always there when the scene needs it.
    pub wall: Option<WallPotential>,
    /// How much a run writes.
    pub output: Output,
    /// What is filled with particles, in the order of their ids.
    pub regions: Vec<Region>,
}

/// How much a run writes; it changes no bit of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// Rows of the series over both legs, at least.
    pub rows: u64,
    /// Particle frames over both legs, at least; 0 for none.
    pub frames: u64,
    /// Snapshots of the latest state.
    pub snapshots: u64,
}

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepRule {
    /// The Courant number: time step = number * support radius / sound speed.
    Cfl(f64),
    /// The time step itself, s.
    Seconds(f64),
}

/// The material of the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// Density at which the pressure is zero, kg/m³ (kg/m² in the plane).
    pub reference_density: f64,
    /// Numerical speed of sound, m/s.
    pub sound_speed: f64,
    /// Pressure as a function of density.
    pub equation_of_state: EquationOfState,
    /// Strength of the repulsion between particles that are very near, Pa; 0 for none.
    pub anti_clump_pressure: f64,
    /// Where it begins, in particle spacings.
    pub anti_clump_radius: f64,
}

/// Outside forces, per mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gravity {
    /// The same acceleration everywhere, m/s².
    pub uniform: Point,
    /// Attraction to a point.
    pub central: Option<CentralGravity>,
}

/// The acceleration -strength x / (|x|² + softening²)^(3/2), with x from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentralGravity {
    /// The attracting point, m.
    pub centre: Point,
    /// Gravitational constant times mass, m³/s².
    pub strength: f64,
    /// Softening length, m.
    pub softening: f64,
}

/// The potential of a conservative wall, per mass of fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallPotential {
    /// Depth, J/kg.
    pub energy: f64,
    /// Distance at which the wall begins to repel, in particle spacings.
    pub radius: f64,
    /// Softening length, m.
    pub softening: f64,
}

/// A part of the plane or space that is filled with particles.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Fluid or wall.
    pub kind: RegionKind,
    /// What is filled.
    pub shape: Shape,
    /// Arrangement of the particles of a fluid region; a wall has `None`, since it
    /// continues the lattice of the first fluid region.
    pub lattice: Option<LatticeKind>,
    /// First velocity; `None` is at rest. A wall has `None`.
    pub velocity: Option<Velocity>,
}

/// A velocity field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity {
    /// The same velocity everywhere, m/s.
    Uniform(Point),
    /// Rigid rotation: u = omega x (x - centre).
    Rotation {
        /// Angular velocity, rad/s; along z in the plane.
        omega: Point,
        /// A point on the axis, m.
        centre: Point,
    },
    /// Gresho's vortex: circles around the centre with speed peak r/R up to the radius R, then
    /// peak (2 - r/R) up to 2 R, then none. (Liska & Wendroff, SIAM J. Sci. Comput. 25 (2003) 995.)
    Gresho {
        /// Largest speed, m/s.
        peak: f64,
        /// R, m.
        radius: f64,
        /// The middle, m.
        centre: Point,
    },
    /// Circular orbits around the centre: speed (strength/r)^(1/2).
    Kepler {
        /// Gravitational constant times mass, m³/s².
        strength: f64,
        /// The middle, m.
        centre: Point,
    },
    /// A linear field: u = A x + b.
    Linear {
        /// The matrix A by rows, 1/s.
        matrix: [Point; 3],
        /// The vector b, m/s.
        offset: Point,
    },
}

impl Velocity {
    /// The velocity at `x`, m/s, from `+ - * / sqrt` in one written order.
    #[must_use]
    pub fn at(&self, x: Point) -> Point {
        match self {
            Self::Uniform(velocity) => *velocity,
            Self::Rotation {
                omega: w,
                centre: c,
            } => {
                let d = [x[0] - c[0], x[1] - c[1], x[2] - c[2]];
                [
                    w[1] * d[2] - w[2] * d[1],
                    w[2] * d[0] - w[0] * d[2],
                    w[0] * d[1] - w[1] * d[0],
                ]
            }
            Self::Gresho {
                peak,
                radius,
                centre,
            } => circling(x, *centre, |r| {
                let q = r / radius;
                // Divided by r where the speed is proportional to it: no 0/0 in the middle.
                if q < 1.0 {
                    peak / radius
                } else if q < 2.0 {
                    peak * (2.0 - q) / r
                } else {
                    0.0
                }
            }),
            Self::Kepler { strength, centre } => circling(x, *centre, |r| {
                if r > 0.0 {
                    (strength / r).sqrt() / r
                } else {
                    0.0
                }
            }),
            Self::Linear { matrix, offset } => std::array::from_fn(|i| {
                matrix[i][0] * x[0] + matrix[i][1] * x[1] + matrix[i][2] * x[2] + offset[i]
            }),
        }
    }
}

/// Counter-clockwise circles in the plane with the angular velocity of each radius.
fn circling(x: Point, centre: Point, omega: impl Fn(f64) -> f64) -> Point {
    let (dx, dy) = (x[0] - centre[0], x[1] - centre[1]);
    let omega = omega((dx * dx + dy * dy).sqrt());
    [-(omega * dy), omega * dx, 0.0]
}

impl Scene {
    /// The support radius of the kernel, m.
    #[must_use]
    pub fn support_radius(&self) -> f64 {
        self.support * self.particle_spacing
    }

    /// The mass of every particle, fluid and wall, kg (kg/m in the plane).
    #[must_use]
    pub fn particle_mass(&self) -> f64 {
        let area = self.particle_spacing * self.particle_spacing;
        let volume = match self.dimension {
            Dimension::Two => area,
            Dimension::Three => area * self.particle_spacing,
        };
        self.fluid.reference_density * volume
    }

    /// The time step, s.
    #[must_use]
    pub fn time_step(&self) -> f64 {
        match self.step {
            StepRule::Cfl(cfl) => cfl * self.support_radius() / self.fluid.sound_speed,
            StepRule::Seconds(seconds) => seconds,
        }
    }

    /// The time at which the run stops, s, both legs added.
    #[must_use]
    pub fn end_time(&self) -> f64 {
        match (self.end, self.turnaround) {
            (Some(end), _) => end,
            (None, Some(turnaround)) => 2.0 * turnaround,
            (None, None) => 0.0,
        }
    }

    /// Steps until the turnaround, or of the whole run when there is none; at least 1.
    #[must_use]
    pub fn steps_out(&self) -> u64 {
        let time = self.turnaround.unwrap_or_else(|| self.end_time());
        whole_steps(time, self.time_step()).max(1)
    }

    /// Steps of the return leg: at least 1 and at most [`steps_out`](Self::steps_out)
    /// with a turnaround, else 0.
    #[must_use]
    pub fn steps_back(&self) -> u64 {
        match (self.turnaround, self.end) {
            (None, _) => 0,
            (Some(_), None) => self.steps_out(),
            (Some(turnaround), Some(end)) => {
                whole_steps(end - turnaround, self.time_step()).clamp(1, self.steps_out())
            }
        }
    }
}

/// The number of steps nearest to a time; the conversion saturates.
pub(super) fn whole_steps(time: f64, time_step: f64) -> u64 {
    (time / time_step).round() as u64
}
