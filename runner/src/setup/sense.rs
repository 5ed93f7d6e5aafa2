//! Whether the numbers of a scene of water belong to the flow that it describes.
//!
//! The fastest flow to be expected is that of free fall, v = (v_0² + 2 g H)^(1/2), with v_0 the speed
//! (m/s) of a particle at the start, and H (m) its height above the deepest place that it can come
//! to. It brings e = v²/2 (J/kg) to a wall.
//!
//! - The density of a weakly compressible fluid changes by about (v/c)²: c is to be ten times v.
//! - A conservative wall has the potential E (s - 1)²/4 for each of its particles, with
//!   s = (r_w² + ε²)/(r² + ε²) (see `loschmidt_core::schemes::wcsph`). It is lowest in the middle
//!   between two neighbours of its row, or of four in space; where it is lower than e there, the fluid
//!   passes. E is to be ten times e, so that particles stay about r_w away.

use super::reach::enclosure;
use crate::scene::{Dimension, InitialState, Scene, WallModel};

/// What a scene of water has, and what its flow wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sense {
    /// The fastest flow to be expected, m/s.
    pub speed: f64,
    /// What a conservative wall has.
    pub wall: Option<WallSense>,
}

/// Energies of a conservative wall, J/kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallSense {
    /// E.
    pub energy: f64,
    /// The potential where the wall is lowest.
    pub barrier: f64,
}

/// The speed of sound and the energy of the walls are to be so many times the speed and the energy of
/// the flow.
pub const WANTED: f64 = 10.0;

impl Sense {
    /// e, J/kg.
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.5 * self.speed * self.speed
    }
}

/// What a scene of water has, and what its flow wants; `None` for other scenes.
#[must_use]
pub fn sense(scene: &Scene, initial: &InitialState) -> Option<Sense> {
    scene.fluid?;
    // What goes around a centre is not compressed by its speed.
    if scene.gravity.central.is_some() {
        return None;
    }
    let gravity = scene.gravity.uniform;
    let walls = enclosure(scene, initial);
    // The potential of gravity is -g·x: the deepest place is where g·x is largest.
    let depth_of = |x: &[f64; 3]| gravity[0] * x[0] + gravity[1] * x[1] + gravity[2] * x[2];
    let deepest = walls.as_ref().map(|walls| walls.largest(depth_of));
    let energies = initial.fluid.iter().zip(&initial.fluid_velocity);
    let energies = energies.map(|(x, v)| {
        // Where nothing stops a fall, nothing is compressed by it.
        let fall = deepest.map_or(0.0, |deepest| (deepest - depth_of(x)).max(0.0));
        0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + fall
    });
    let most = energies.fold(0.0, f64::max);
    Some(Sense {
        speed: (2.0 * most).sqrt(),
        wall: wall(scene).filter(|_| walls.is_some()),
    })
}

fn wall(scene: &Scene) -> Option<WallSense> {
    let wall = scene.wall?;
    if scene.water.wall_model != WallModel::Conservative {
        return None;
    }
    let spacing = scene.particle_spacing;
    let softening = wall.softening * wall.softening;
    let radius = (wall.radius * spacing).powi(2);
    // From the middle of two or four neighbours.
    let (neighbours, squared) = match scene.dimension {
        Dimension::Two => (2.0, 0.25),
        Dimension::Three => (4.0, 0.5),
    };
    let s = (radius + softening) / (squared * spacing * spacing + softening);
    let barrier = if s > 1.0 {
        0.25 * neighbours * wall.energy * (s - 1.0) * (s - 1.0)
    } else {
        0.0
    };
    Some(WallSense {
        energy: wall.energy,
        barrier,
    })
}
