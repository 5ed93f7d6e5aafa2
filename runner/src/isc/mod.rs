//! Initial state correction: positions at which the summed density is the reference density.
//!
//! The density sum without constants, eq. (4), is far below ρ0 at a free surface. Instead of adding
//! the difference back as a constant (C_a, eq. 5), the particles are moved until
//!
//! F_a(x) = ρ0 - Σ_b m W(x_a - x_b) = 0 for every particle a,
//!
//! where b runs over all particles, a itself included. Newton's method, with
//! the displacement restricted to a discrete gradient, eq. (6b), makes each step the shortest one
//! that solves the linearised equations (6a): with g_ab = m W'(r_ab) e_ab and G_a = Σ_b g_ab,
//!
//! - (D δx)_a = G_a · δx_a - Σ_b g_ab · δx_b        the linearised density
//! - (Dᵀψ)_a  = G_a ψ_a + Σ_b g_ab ψ_b              since g_ba = -g_ab; ψ = φ/ρ² of eq. (6b)
//! - D Dᵀ ψ = F, δx = Dᵀψ                           the Schur complement of the system (6)
//!
//! D Dᵀ is symmetric and positive semi-definite; it is applied pair by pair and never formed, and
//! conjugate gradients with its diagonal as preconditioner invert it (`solve`). They are stopped
//! early while the density is still far off: the error after a Newton step is of the order of its
//! square, and no solution needs to be better than that.
//!
//! A lattice is too symmetric (D Dᵀ is singular for the mode that alternates from node to node), so
//! the positions are first disturbed by up to a tenth of a spacing, from a seeded generator.
//!
//! What comes out has the same bits on every machine and for every number of threads:
//! `+ - * / sqrt` in a written order, neighbours in an order that follows from the positions, and
//! inner products in blocks of a fixed length.
//!
//! Source: Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, section 3.2, where the
//! solution of the Schur complement without a matrix is named as a future possibility.

mod pairs;
mod settings;
mod solve;

pub use settings::CorrectionSettings;

use crate::random::SplitMix64;
use pairs::Pairs;
use rayon::prelude::*;
use solve::Solver;
use thiserror::Error;

/// One Newton step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Largest |ρ - ρ0|/ρ0 before it.
    pub error: f64,
    /// Root mean square of (ρ - ρ0)/ρ0 before it.
    pub rms_error: f64,
    /// Conjugate gradient iterations.
    pub iterations: usize,
    /// Largest displacement of a particle, m.
    pub displacement: f64,
}

/// What a correction did.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// The Newton steps.
    pub steps: Vec<Step>,
    /// Largest |ρ - ρ0|/ρ0 at the end.
    pub error: f64,
    /// Largest distance of a particle from where it was, m.
    pub displacement: f64,
}

/// The densities could not be made equal.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "the initial state correction did not converge: after {steps} Newton steps the density of \
     a particle is still {error:.1e} of the reference density away from it"
)]
pub struct NotConverged {
    /// Newton steps taken.
    pub steps: usize,
    /// The smallest largest error that was reached.
    pub error: f64,
}

/// A Newton step that makes the error this much larger has lost its way.
const DIVERGED: f64 = 1e3;

/// Moves the particles until all of their densities are the reference density. With `observe` one
/// can look at the positions and densities (kg/m³) before each step and at the end.
///
/// # Errors
/// [`NotConverged`]; the positions are then of no use.
pub fn correct<const D: usize>(
    fluid: &mut [[f64; D]],
    settings: &CorrectionSettings,
    mut observe: impl FnMut(&[[f64; D]], &[f64]),
) -> Result<Convergence, NotConverged> {
    let home = fluid.to_vec();
    let rho0 = settings.reference_density;
    let mut random = SplitMix64::new(settings.seed);
    for x in fluid.iter_mut() {
        let shift = random.in_ball::<D>();
        for (x, s) in x.iter_mut().zip(shift) {
            *x += settings.jitter * settings.spacing * s;
        }
    }
    let mut solver = Solver::new(fluid.len());
    let mut steps: Vec<Step> = Vec::new();
    let mut best = f64::INFINITY;
    loop {
        let pairs = Pairs::new(fluid, settings);
        observe(fluid, &pairs.density);
        let missing: Vec<f64> = pairs.density.par_iter().map(|rho| rho0 - rho).collect();
        let error = largest(missing.par_iter().map(|f| f.abs())) / rho0;
        if error <= settings.tolerance {
            let displacement = largest(fluid.par_iter().zip(&home).map(|(a, b)| distance(a, b)));
            return Ok(Convergence {
                steps,
                error,
                displacement,
            });
        }
        best = best.min(error);
        let lost = error > DIVERGED * best || error.is_infinite();
        if lost || steps.len() == settings.most_steps {
            return Err(NotConverged {
                steps: steps.len(),
                error: best,
            });
        }
        let rms_error = (solve::dot(&missing, &missing) / missing.len() as f64).sqrt() / rho0;
        // Half of the digits that the step can gain at best.
        let relative = (0.1 * rms_error).clamp(1e-8, 1e-2);
        let (mut shift, iterations) = solver.shortest(&pairs, &missing, relative);
        let longest = largest(shift.par_iter().map(|s| distance(s, &[0.0; D])));
        let scale = (settings.longest * settings.spacing / longest).min(1.0);
        for (x, s) in fluid.iter_mut().zip(&mut shift) {
            for (x, s) in x.iter_mut().zip(s) {
                *x += scale * *s;
            }
        }
        steps.push(Step {
            error,
            rms_error,
            iterations,
            displacement: scale * longest,
        });
    }
}

/// Bytes that [`correct`] takes for so many particles with `support` spacings of support: the pairs
/// are for a moment there twice.
#[must_use]
pub fn estimated_bytes(dimension: u64, support: f64, particles: u64) -> u64 {
    let ball = match dimension {
        2 => 3.15 * support * support,
        _ => 4.19 * support * support * support,
    };
    let per_pair = 4 + 8 * dimension;
    let per_particle = 8 * (8 + 6 * dimension);
    particles * (2 * ball as u64 * per_pair + per_particle)
}

/// The largest of the numbers, which no order changes; infinite if one of them is not a number.
fn largest(numbers: impl ParallelIterator<Item = f64>) -> f64 {
    numbers
        .map(|x| if x.is_nan() { f64::INFINITY } else { x })
        .reduce(|| 0.0, f64::max)
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        sum += (a - b) * (a - b);
    }
    sum.sqrt()
}
