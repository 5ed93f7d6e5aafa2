//! What is looked at: frames and points of a state whose densities are known.

use super::{AnyExecutor, on_threads};
use crate::frame::Frame;
use crate::points::{Part, Points, speed};
use loschmidt_core::number::Quantity;
use loschmidt_core::{Arithmetic, Parameters, System};
use rayon::prelude::*;

/// Fewest particles of a picture worth a thread of their own.
const PART: usize = 4096;

/// The state in SI units, the particles at these places.
pub(super) fn frame<A: Arithmetic, const D: usize>(
    system: &System<'_, A, D>,
    p: &Parameters<D>,
    places: &[usize],
) -> Frame {
    let (state, density) = (&system.state, &system.scratch.density);
    let (lq, sq) = (p.scale.length_quantum(), p.scale.speed_quantum());
    let density: Vec<f64> = places.iter().map(|&i| si_density(density[i], p)).collect();
    Frame {
        dimension: D,
        step: system.progress.step,
        particle_mass: p.mass,
        id: places.iter().map(|&i| state.id[i]).collect(),
        position: places.iter().map(|&i| si(&state.position[i], lq)).collect(),
        velocity: places.iter().map(|&i| si(&state.velocity[i], sq)).collect(),
        pressure: density.iter().map(|&rho| si_pressure(rho, p)).collect(),
        density,
        wall_position: system.walls.position.iter().map(|x| si(x, lq)).collect(),
        ..Frame::default()
    }
}

/// The same as it is drawn, the particles as they are stored. Pictures are taken while a run goes on, many a
/// second: every thread of the executor takes its part.
pub(super) fn points<A: Arithmetic, const D: usize>(
    system: &System<'_, A, D>,
    p: &Parameters<D>,
    executor: &AnyExecutor,
    points: &mut Points,
) {
    let lq = p.scale.length_quantum();
    points.resize(D, system.state.len());
    points.step = system.progress.step;
    let walls = system.walls.position.iter();
    points.wall_position.clear();
    points
        .wall_position
        .extend(walls.map(|x| si(x, lq).map(|x| x as f32)));
    let parts = points.parts(PART);
    on_threads(executor, || {
        parts.into_par_iter().for_each(|part| {
            pulp::Arch::new().dispatch(
                #[inline(always)]
                || fill(part, system, p),
            )
        });
    });
}

/// Compiled for the vectors that the processor has; every operation is rounded by itself in all of them.
#[inline(always)]
fn fill<A: Arithmetic, const D: usize>(
    part: Part<'_>,
    system: &System<'_, A, D>,
    p: &Parameters<D>,
) {
    let (state, scratch) = (&system.state, &system.scratch);
    let (lq, sq) = (p.scale.length_quantum(), p.scale.speed_quantum());
    let range = part.first..part.first + part.id.len();
    part.id.copy_from_slice(&state.id[range.clone()]);
    let positions = &state.position[range.clone()];
    for (axis, list) in part.position.into_iter().take(D).enumerate() {
        for (to, x) in list.iter_mut().zip(positions) {
            *to = (x[axis].quanta::<f64>() * lq) as f32;
        }
    }
    for (to, v) in part.speed.iter_mut().zip(&state.velocity[range.clone()]) {
        *to = speed(si(v, sq));
    }
    let lists = part.density.iter_mut().zip(part.pressure);
    for ((density, pressure), &rho) in lists.zip(&scratch.density[range]) {
        let rho = si_density(rho, p);
        *density = rho as f32;
        *pressure = si_pressure(rho, p) as f32;
    }
}

#[inline(always)]
fn si<Q: Quantity, const D: usize>(x: &[Q; D], quantum: f64) -> [f64; 3] {
    let mut out = [0.0; 3];
    for (o, x) in out.iter_mut().zip(x) {
        *o = x.quanta::<f64>() * quantum;
    }
    out
}

#[inline(always)]
fn si_density<const D: usize>(density: impl Quantity, p: &Parameters<D>) -> f64 {
    density.quanta::<f64>() * p.scale.density_quantum()
}

/// Pressure (Pa) at a density in kg/m³.
#[inline(always)]
fn si_pressure<const D: usize>(density: f64, p: &Parameters<D>) -> f64 {
    let stiffness = p.sound_speed * p.sound_speed * p.reference_density;
    stiffness * p.state_equation.pressure(density / p.reference_density)
}
