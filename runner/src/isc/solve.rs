//! Conjugate gradients for D Dᵀ ψ = F, with the diagonal as preconditioner.
//!
//! What is returned is not ψ but δx = Dᵀψ, summed up along the way. Vectors are worked on in blocks
//! of a fixed length, whose sums are added in their order: the same bits for any number of threads.

use super::pairs::{GRAIN, Pairs};
use rayon::prelude::*;

/// Most iterations of one solution. The iteration is also ended where it no longer gains anything.
const MOST_ITERATIONS: usize = 20_000;

/// Memory for solutions of one size.
pub(super) struct Solver {
    residual: Vec<f64>,
    scaled: Vec<f64>,
    direction: Vec<f64>,
    applied: Vec<f64>,
}

/// Σ a b, block by block.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let blocks: Vec<f64> = a
        .par_chunks(GRAIN)
        .zip(b.par_chunks(GRAIN))
        .map(|(a, b)| a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b))
        .collect();
    blocks.iter().fold(0.0, |sum, block| sum + block)
}

/// Does something with each pair of elements, in parallel.
fn both<T: Send, F: Sync>(to: &mut [T], from: &[F], each: impl Fn(&mut T, &F) + Sync) {
    to.par_chunks_mut(GRAIN)
        .zip(from.par_chunks(GRAIN))
        .for_each(|(to, from)| {
            for (to, from) in to.iter_mut().zip(from) {
                each(to, from);
            }
        });
}

impl Solver {
    pub fn new(n: usize) -> Self {
        Self {
            residual: vec![0.0; n],
            scaled: vec![0.0; n],
            direction: vec![0.0; n],
            applied: vec![0.0; n],
        }
    }

    /// The shortest δx with D δx = F up to `relative` |F|, and the number of iterations.
    pub fn shortest<const D: usize>(
        &mut self,
        pairs: &Pairs<D>,
        missing: &[f64],
        relative: f64,
    ) -> (Vec<[f64; D]>, usize) {
        let n = missing.len();
        let mut shift = vec![[0.0; D]; n];
        let mut gradient = vec![[0.0; D]; n];
        let inverse: Vec<f64> = pairs
            .diagonal
            .iter()
            // A particle without neighbours: its density cannot be changed.
            .map(|&d| if d > 0.0 { 1.0 / d } else { 0.0 })
            .collect();
        self.residual.copy_from_slice(missing);
        let goal = dot(missing, missing) * (relative * relative);
        self.precondition(&inverse);
        self.direction.copy_from_slice(&self.scaled);
        let mut gain = dot(&self.residual, &self.scaled);
        for iteration in 0..MOST_ITERATIONS {
            if gain <= 0.0 || dot(&self.residual, &self.residual) <= goal {
                return (shift, iteration);
            }
            pairs.gradient(&self.direction, &mut gradient);
            pairs.divergence(&gradient, &mut self.applied);
            let curvature = dot(&self.direction, &self.applied);
            if curvature <= 0.0 {
                return (shift, iteration);
            }
            let step = gain / curvature;
            both(&mut shift, &gradient, |shift, g| {
                for (shift, g) in shift.iter_mut().zip(g) {
                    *shift += step * g;
                }
            });
            both(&mut self.residual, &self.applied, |r, q| *r -= step * q);
            self.precondition(&inverse);
            let next = dot(&self.residual, &self.scaled);
            let keep = next / gain;
            both(&mut self.direction, &self.scaled, |p, z| *p = z + keep * *p);
            gain = next;
        }
        (shift, MOST_ITERATIONS)
    }

    fn precondition(&mut self, inverse: &[f64]) {
        self.scaled.copy_from_slice(inverse);
        both(&mut self.scaled, &self.residual, |z, r| *z *= r);
    }
}
