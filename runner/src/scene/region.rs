//! What a scene is filled with, and how it moves at first.

use super::geometry::Vector3;
use super::shape::Shape;
use super::solid::{ElasticEnergy, Solid};
use super::superfluid::{Counterflow, FirstEntropy};
use super::words::{Dimension, LatticeKind, RegionKind};
use loschmidt_core::schemes::solid::Motion;
use std::f64::consts::PI;

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
    /// First velocity, the sum of these fields; none is at rest. Of a wall, how it slides or turns,
    /// in scenes of a viscous fluid, or the velocity with which it rubs, in those of a superfluid:
    /// one field at most.
    pub velocity: Vec<Velocity>,
    /// First counterflow of a superfluid; `None` is none.
    pub counterflow: Option<Counterflow>,
    /// First entropy of a superfluid; `None` is that of the reference temperature.
    pub entropy: Option<FirstEntropy>,
    /// Whether a wall of a superfluid has no friction.
    pub smooth: bool,
    /// β between a superfluid and a wall, W/(m K²); `None`: no heat passes.
    pub conduction: Option<f64>,
    /// Name of the body that a solid region belongs to; `None`: a body of its own.
    pub body: Option<String>,
    /// In what its body differs from the table `[solid]`.
    pub material: MaterialOfBody,
    /// Whether the particles of a solid region never move.
    pub held: bool,
}

/// What a body is made of, as far as it differs from the scene's solid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaterialOfBody {
    /// c_0, m/s.
    pub bulk_speed: Option<f64>,
    /// c_s, m/s.
    pub shear_speed: Option<f64>,
    /// c_p/c_0.
    pub penalty: Option<f64>,
    /// Energy of shear.
    pub energy: Option<ElasticEnergy>,
}

impl MaterialOfBody {
    /// The solid that it is, where the scene's is this.
    #[must_use]
    pub fn of(&self, solid: Solid) -> Solid {
        Solid {
            reference_density: solid.reference_density,
            bulk_speed: self.bulk_speed.unwrap_or(solid.bulk_speed),
            shear_speed: self.shear_speed.unwrap_or(solid.shear_speed),
            penalty: self.penalty.unwrap_or(solid.penalty),
            energy: self.energy.unwrap_or(solid.energy),
        }
    }
}

impl Region {
    /// The region in a few words, such as "fluid, shape `circle`".
    pub(super) fn in_words(&self, dimension: Dimension) -> String {
        format!(
            "{}, shape `{}`",
            self.kind.word(),
            self.shape.word(dimension)
        )
    }

    /// First velocity at `x`, m/s: the fields are added in their order.
    #[must_use]
    pub fn velocity_at(&self, x: Vector3) -> Vector3 {
        let mut fields = self.velocity.iter().map(|field| field.at(x));
        // Nothing is added to a single field: its zeros keep their signs.
        let first = fields.next().unwrap_or([0.0; 3]);
        fields.fold(first, |sum, u| std::array::from_fn(|k| sum[k] + u[k]))
    }

    /// How a wall moves; others stand still.
    pub(super) fn motion(&self) -> Motion {
        match (self.kind, &self.velocity[..]) {
            (RegionKind::Wall, [Velocity::Uniform(velocity)]) => Motion::Slides(*velocity),
            (RegionKind::Wall, [Velocity::Rotation { omega, centre }]) => Motion::Turns {
                rate: *omega,
                centre: *centre,
            },
            _ => Motion::Still,
        }
    }
}

/// A velocity field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Velocity {
    /// The same velocity everywhere, m/s.
    Uniform(Vector3),
    /// Rigid rotation: u = omega x (x - centre).
    Rotation {
        /// Angular velocity, rad/s; along z in the plane.
        omega: Vector3,
        /// A point on the axis, m.
        centre: Vector3,
    },
    /// Gresho's vortex: circles around the centre with speed peak r/R up to the radius R, then
    /// peak (2 - r/R) up to 2 R, then none.
    /// (Liska & Wendroff, SIAM J. Sci. Comput. 25 (2003) 995.)
    Gresho {
        /// Largest speed, m/s.
        peak: f64,
        /// R, m.
        radius: f64,
        /// The middle, m.
        centre: Vector3,
    },
    /// Circular orbits around the centre: speed (strength/r)^(1/2).
    Kepler {
        /// Gravitational constant times mass, m³/s².
        strength: f64,
        /// The middle, m.
        centre: Vector3,
    },
    /// Bending of a beam along x that begins at `start`, its first mode with free ends:
    /// u_y = peak (a1 (sinh s + sin s) - a2 (cosh s + cos s)), s = wave_number (x - start).
    /// (Kincl et al., Appl. Math. Comput. 439 (2023) 127579, eq. (55).)
    Bending {
        /// Amplitude times angular frequency, m/s.
        peak: f64,
        /// 1/m.
        wave_number: f64,
        /// a1 and a2.
        shape: [f64; 2],
        /// Where s is 0, m.
        start: f64,
    },
    /// Torsion of a column along z: u = rate sin(π z/(2 height)) (y, -x, 0).
    /// (The same, eq. (60).)
    Twist {
        /// Largest angular velocity, rad/s.
        rate: f64,
        /// m.
        height: f64,
    },
    /// A linear field: u = A x + b.
    Linear {
        /// The matrix A by rows, 1/s.
        matrix: [Vector3; 3],
        /// The vector b, m/s.
        offset: Vector3,
    },
}

impl Velocity {
    /// The velocity at `x`, m/s, from `+ - * / sqrt` in one written order, and from `libm`'s
    /// functions, which have the same bits everywhere.
    #[must_use]
    pub fn at(&self, x: Vector3) -> Vector3 {
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
            Self::Bending {
                peak,
                wave_number,
                shape: [a1, a2],
                start,
            } => {
                let s = wave_number * (x[0] - start);
                let odd = libm::sinh(s) + libm::sin(s);
                let even = libm::cosh(s) + libm::cos(s);
                [0.0, peak * (a1 * odd - a2 * even), 0.0]
            }
            Self::Twist { rate, height } => {
                let omega = rate * libm::sin(PI * x[2] / (2.0 * height));
                [omega * x[1], -(omega * x[0]), 0.0]
            }
            Self::Linear { matrix, offset } => std::array::from_fn(|i| {
                matrix[i][0] * x[0] + matrix[i][1] * x[1] + matrix[i][2] * x[2] + offset[i]
            }),
        }
    }
}

/// Counter-clockwise circles in the plane with the angular velocity of each radius.
fn circling(x: Vector3, centre: Vector3, omega: impl Fn(f64) -> f64) -> Vector3 {
    let (dx, dy) = (x[0] - centre[0], x[1] - centre[1]);
    let omega = omega((dx * dx + dy * dy).sqrt());
    [-(omega * dy), omega * dx, 0.0]
}
