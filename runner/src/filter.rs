//! The passive noise filter: the Shepard average of the velocities of a frame, on a copy.
//!
//! ũ_a = (1/γ_a) Σ_b V_b u_b W_ab,  γ_a = Σ_b V_b W_ab,  V_b = m/ρ_b,
//!
//! over the fluid, the particle itself included, and where walls are dummies over them too, at rest
//! and with the volume m/ρ0. The state that the frame was taken of is not touched. (The active
//! filter is the core's model `filtered`.)
//!
//! Source: Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, appendix A.

use crate::frame::Frame;
use crate::scene::{Scene, WallModel};
use loschmidt_core::kernel::WendlandC2;
use loschmidt_core::neighbours::{Cells, Grid};
use rayon::prelude::*;

/// Units in a support radius: the cells of the core count in whole units.
const UNITS: f64 = (1_u64 << 30) as f64;

/// The filtered velocities of the fluid, m/s, in the order of the frame.
#[must_use]
pub fn shepard(scene: &Scene, frame: &Frame) -> Vec<[f64; 3]> {
    match frame.dimension {
        2 => shepard_in::<2>(scene, frame),
        _ => shepard_in::<3>(scene, frame),
    }
}

fn shepard_in<const D: usize>(scene: &Scene, frame: &Frame) -> Vec<[f64; 3]> {
    let h = scene.support_radius();
    let fluid = frame.position.iter().zip(&frame.velocity);
    let mut sources: Vec<([f64; D], f64, [f64; 3])> = fluid
        .zip(frame.column("density").unwrap_or_default())
        .map(|((x, u), rho)| (first(x), frame.particle_mass / rho, *u))
        .collect();
    if scene.water.wall_model == WallModel::Dummy {
        let volume = frame.particle_mass / scene.reference_density();
        let walls = frame.wall_position.iter();
        sources.extend(walls.map(|x| (first(x), volume, [0.0; 3])));
    }
    let unit = h / UNITS;
    let units: Vec<[f64; D]> = sources.iter().map(|(x, ..)| x.map(|x| x / unit)).collect();
    let grid = Grid::<D>::new(UNITS as i64, [i64::MAX / 4; D], 2 * sources.len());
    let (mut start, mut order) = (vec![0; grid.buckets() + 1], vec![0; sources.len()]);
    let mut cells = Cells {
        start: &mut start,
        order: &mut order,
    };
    cells.sort(&grid, &units);
    let cells = cells.into_view();
    let kernel = WendlandC2::new(D, h, 1.0);
    (0..frame.position.len())
        .into_par_iter()
        .map(|i| {
            let x = &sources[i].0;
            let (mut sum, mut gamma) = ([0.0; 3], 0.0);
            cells.around(&grid, &units[i], |run| {
                for &j in run {
                    let (y, volume, u) = &sources[j as usize];
                    let mut r2 = 0.0;
                    for (x, y) in x.iter().zip(y) {
                        r2 += (x - y) * (x - y);
                    }
                    let weight = volume * kernel.value(r2.sqrt());
                    gamma += weight;
                    for (sum, u) in sum.iter_mut().zip(u) {
                        *sum += weight * u;
                    }
                }
            });
            // The particle itself is among them: γ is not zero.
            sum.map(|sum| sum / gamma)
        })
        .collect()
}

fn first<const D: usize>(x: &[f64; 3]) -> [f64; D] {
    std::array::from_fn(|d| x[d])
}
