//! How far and how fast the particles of a scene are expected to go: what its numbers must hold.
//!
//! What walls hold on every side, but for the one against gravity, stays about where it is. What
//! nothing holds goes in the time t of the way out, which is also that of the way back, at most by
//! about
//!
//! (v + c/10) t + g t²/2
//!
//! with v the largest first speed (m/s; of elastic bodies, the fastest mean of one, since what turns
//! does not travel), c the speed of sound, a tenth of which a weakly compressible fluid may gain by
//! expanding (helium begins without a pressure), and g the uniform gravity (m/s²). Bound by a centre of strength S (m³/s²), a particle
//! of the energy E < 0 per mass (m²/s²) comes to S/|E| at most. A body that is held somewhere does
//! not travel.

use super::{Bounds, fastest};
use crate::enclosure::Enclosure;
use crate::scene::{CentralGravity, InitialState, Scene, Vector3};
use loschmidt_core::Scale;

/// How far, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Largest |coordinate| at the start, m.
    pub first: f64,
    /// Largest |coordinate| to be expected, m.
    pub expected: f64,
    /// Largest speed to be expected of the particles as a whole, m/s.
    pub speed: f64,
}

/// What is expected may be exceeded so many times.
const MARGIN: f64 = 2.0;

/// [`Scale::with_headroom`] leaves so much room for lengths.
const ROOM_OF_LENGTHS: f64 = 6.0;

/// And so much for speeds.
const ROOM_OF_SPEEDS: f64 = 16.0;

/// A spacing has at least so many quanta, 2^24, however far particles may go.
const QUANTA_OF_SPACING: f64 = 16_777_216.0;

/// The numbers of a scene that is measured in units of this speed (m/s) and density (kg/m³), and
/// has these first states.
pub(super) fn scale(scene: &Scene, initial: &InitialState, speed: f64, density: f64) -> Scale {
    let reach = reach(scene, initial);
    // A drop that is smaller than its kernel must still leave room for the kernel.
    let least = scene.support_radius();
    let extent = match scene.domain {
        Some(domain) => least.max(domain.max(reach.first) / ROOM_OF_LENGTHS),
        None => {
            let most = scene.particle_spacing / QUANTA_OF_SPACING * 2_f64.powi(51);
            let expected = (MARGIN * reach.expected).min(most);
            least.max(reach.first).max(expected / ROOM_OF_LENGTHS)
        }
    };
    Scale::with_headroom(
        extent,
        speed.max(MARGIN * reach.speed / ROOM_OF_SPEEDS),
        density,
    )
}

/// Positions of a scene are kept below this |coordinate|, m.
#[must_use]
pub fn length_range(scene: &Scene, initial: &InitialState) -> f64 {
    // Speeds and densities have exponents of their own.
    scale(scene, initial, 1.0, 1.0).largest_length()
}

/// How far and how fast the particles of a scene are expected to go.
#[must_use]
pub fn reach(scene: &Scene, initial: &InitialState) -> Reach {
    let first = Bounds::of(initial).farthest;
    let still = Reach {
        first,
        expected: first,
        speed: 0.0,
    };
    if scene.domain.is_some() || is_held(scene, initial) {
        return still;
    }
    let time = scene.steps_out() as f64 * scene.time_step();
    let length = |x: &Vector3| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
    let gravity = length(&scene.gravity.uniform);
    let bound = scene
        .gravity
        .central
        .and_then(|central| bound_by(&central, initial));
    let speed = match (bound, scene.solid) {
        (Some(_), _) => 0.0,
        (None, Some(_)) => fastest_body(initial),
        (None, None) if scene.superfluid.is_some() => fastest(initial),
        (None, None) => fastest(initial) + 0.1 * scene.sound_speed(),
    };
    Reach {
        first,
        expected: bound.unwrap_or(first).max(first) + speed * time + 0.5 * gravity * time * time,
        speed: speed + gravity * time,
    }
}

/// The largest |coordinate| of particles that a centre holds, m; `None` where one can escape.
fn bound_by(central: &CentralGravity, initial: &InitialState) -> Option<f64> {
    let middle = central
        .centre
        .iter()
        .fold(0.0, |far: f64, x| far.max(x.abs()));
    let mut farthest = 0.0_f64;
    for (x, v) in initial.fluid.iter().zip(&initial.fluid_velocity) {
        let d: Vector3 = std::array::from_fn(|k| x[k] - central.centre[k]);
        let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        let distance = (squared + central.softening * central.softening).sqrt();
        let energy = 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) - central.strength / distance;
        if energy.is_nan() || energy >= 0.0 {
            return None;
        }
        farthest = farthest.max(central.strength / -energy);
    }
    Some(middle + farthest)
}

/// The speed of the fastest body as a whole, m/s; of those that are held somewhere, none.
fn fastest_body(initial: &InitialState) -> f64 {
    let ends = initial.parts.iter().skip(1).map(|part| part.first);
    let ends = ends.chain([initial.fluid.len() as u64]);
    let count = initial.parts.iter().map(|part| part.body + 1).max();
    let mut bodies = vec![(0.0, [0.0; 3], false); count.unwrap_or(0)];
    for (part, end) in initial.parts.iter().zip(ends) {
        let (number, sum, held) = &mut bodies[part.body];
        *held |= part.held;
        *number += (end - part.first) as f64;
        for v in &initial.fluid_velocity[part.first as usize..end as usize] {
            for k in 0..3 {
                sum[k] += v[k];
            }
        }
    }
    let free = bodies.iter().filter(|(_, _, held)| !held);
    let speed = |sum: &Vector3| (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    free.map(|(number, sum, _)| speed(sum) / number.max(1.0))
        .fold(0.0, f64::max)
}

/// Whether walls hold the particles on every side but the one against gravity, or every body is held
/// somewhere.
fn is_held(scene: &Scene, initial: &InitialState) -> bool {
    if scene.solid.is_some() {
        let held = |body: usize| {
            initial
                .parts
                .iter()
                .any(|part| part.body == body && part.held)
        };
        return initial.parts.iter().all(|part| held(part.body));
    }
    let Some(enclosure) = enclosure(scene, initial) else {
        // Walls whose box is too large to be searched are trusted.
        return !initial.wall.is_empty() || initial.parts.iter().any(|part| part.held);
    };
    let open = enclosure.open_sides();
    let gravity = scene.gravity.uniform;
    (0..3).all(|k| {
        [-1.0, 1.0].iter().zip(open[k]).all(|(side, is_open)| {
            // Upwards is where gravity is not.
            let up = gravity[k] * side < 0.0;
            !is_open || up
        })
    })
}

/// What the walls of a scene enclose of its first particles; `None` without walls, and where that
/// would take too long.
#[must_use]
pub fn enclosure(scene: &Scene, initial: &InitialState) -> Option<Enclosure> {
    if scene.viscous.is_none() {
        return Enclosure::of(&initial.fluid, &initial.wall, scene.particle_spacing);
    }
    // The walls of a viscous fluid come last among its particles.
    let first = initial.parts.iter().find(|part| part.held)?;
    let (fluid, wall) = initial.fluid.split_at(first.first as usize);
    Enclosure::of(fluid, wall, scene.particle_spacing)
}
