//! The pair sums of a superfluid, of the paper's eqs. (19) and (24), divided by ρ0.
//!
//! | pass | sums over j | parity |
//! |---|---|---|
//! | [`GradientPass`] | dt K = Σ dt V0 (W'/r) v_ij x_ijᵀ | symmetric |
//! | [`SumsPass`] | Σ V0 W; H = Σ V0 (W'/r) x_ij x_ijᵀ; dt K | symmetric |
//! | [`FluxPass`] | κ times what follows | |
//! | - momentum | -½ Σ V0 (W'/r) (u_i q_i·x_ij/ϱ_i + u_j q_j·x_ij/ϱ_j) | antisymmetric |
//! | - entropy | -Σ V0 (W'/r) (j_i·x_ij + j_j·x_ij) | antisymmetric |
//! | - stretching | Σ V0 (W'/r) x_ij (c_i - c_j)ᵀ | symmetric |
//! | - warming | Σ V0 (W'/r) s0 (T_i - T_j) x_ij | symmetric |
//! | - pressure | -Σ V0 (W'/r) (P_i + P_j) x_ij | antisymmetric |
//!
//! V0 is the volume of a particle, κ the kick's share of the time step, u the counterflow,
//! q = (χ_s/χ_n) u, ϱ = ρ/ρ0, j = η H̃⁻¹ q/ϱ with η = s/s0, P = u_1² (ϱ - 1)/ϱ²; c is q, or v_n = v + q
//! with the paper's integrator. H̃ = -H/ϱ in the renormalised operators, whose gradient of T is
//! exact for linear fields; it stands in the entropy flux as well, so that energy is kept. In the
//! paper's operators it is 1.

use crate::kernel::Reach;
use crate::number::{Lanes, sqrt};
use crate::pairs::{PairPass, Parity};
use crate::values;
use crate::values::Symmetric;

values! {
    /// What is summed at once after a drift.
    pub struct Sums {
        /// Σ V0 W.
        density: T,
        /// H.
        moment: Symmetric<T, D>,
        /// dt K, row by row.
        gradient: [[T; D]; D],
    }

    /// What fluxes need of a particle.
    pub struct Carrier {
        /// u, in speed quanta.
        counterflow: [T; D],
        /// (χ_s/χ_n)/ϱ.
        weight: T,
        /// c, in speed quanta.
        carried: [T; D],
        /// j, in speed quanta.
        flux: [T; D],
        /// s0 (T - T0), m²/s².
        warmth: T,
        /// P, m²/s²; 0 where pressures are not asked for.
        pressure: T,
    }

    /// Sums of fluxes.
    pub struct Fluxes {
        /// Half of the momentum that the counterflow carries, in speed quanta.
        momentum: [T; D],
        /// η.
        entropy: T,
        /// Row i, column j: x component i, c component j, in rate quanta.
        stretching: [[T; D]; D],
        /// In speed quanta.
        warming: [T; D],
        /// In speed quanta.
        pressure: [T; D],
    }
}

/// dt K alone.
#[derive(Clone, Copy, Debug)]
pub struct GradientPass {
    pub(super) reach: Reach,
    /// dt V0 in units that make the result rate quanta.
    pub(super) rate: f64,
}

/// factor · a bᵀ.
#[inline(always)]
fn dyad<L: Lanes, const D: usize>(factor: L, a: &[L; D], b: &[L; D]) -> [[L; D]; D] {
    let mut rows = [*b; D];
    for (row, a) in rows.iter_mut().zip(a) {
        let a = factor * *a;
        for b in row {
            *b = a * *b;
        }
    }
    rows
}

#[inline(always)]
fn difference<L: Lanes, const D: usize>(a: &[L; D], b: &[L; D]) -> [L; D] {
    let mut c = *a;
    for (c, b) in c.iter_mut().zip(b) {
        *c = *c - *b;
    }
    c
}

#[inline(always)]
fn dot<L: Lanes, const D: usize>(a: &[L; D], b: &[L; D]) -> L {
    let mut sum = a[0] * b[0];
    for (a, b) in a.iter().zip(b).skip(1) {
        sum = sum + *a * *b;
    }
    sum
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |a: f64, x| a.max(*x))
}

impl<const D: usize> PairPass<D> for GradientPass {
    type Read<T: Copy> = [T; D];
    type Term<T: Copy> = [[T; D]; D];
    const PARITY: [[Parity; D]; D] = [[Parity::Symmetric; D]; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, velocity: &[f64; D]) -> f64 {
        // A little more, for roundings.
        2.001 * largest(velocity) * self.reach.largest_slope() * self.rate.abs()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &[L; D], j: &[L; D]) -> [[L; D]; D] {
        let slope = self.reach.kernel.derivative_over_r_at(q);
        dyad(slope * q.splat(self.rate), &difference(i, j), x_ij)
    }
}

/// Densities, H and dt K.
#[derive(Clone, Copy, Debug)]
pub struct SumsPass {
    pub(super) gradient: GradientPass,
    /// V0 in units that make H quanta of sums.
    pub(super) moment: f64,
    /// V0 in units that make densities quanta of sums.
    pub(super) volume: f64,
}

impl<const D: usize> PairPass<D> for SumsPass {
    type Read<T: Copy> = [T; D];
    type Term<T: Copy> = Sums<T, D>;
    const PARITY: Sums<Parity, D> = Sums {
        density: Parity::Symmetric,
        moment: Symmetric {
            rows: [[Parity::Symmetric; D]; D],
        },
        gradient: [[Parity::Symmetric; D]; D],
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.gradient.reach.squared
    }
    fn bound(&self, velocity: &[f64; D]) -> f64 {
        let reach = &self.gradient.reach;
        let gradient = self.gradient.bound(velocity);
        let moment = reach.largest_slope() * sqrt(reach.squared) * self.moment;
        let density = reach.largest_value() * self.volume;
        gradient.max(1.001 * moment).max(1.001 * density)
    }
    fn bounds(&self, velocity: &[f64; D]) -> Sums<f64, D> {
        // Only the gradient moves with the velocities.
        let still = self.bound(&[0.0; D]);
        Sums {
            density: still,
            moment: Symmetric {
                rows: [[still; D]; D],
            },
            gradient: self.gradient.bounds(velocity),
        }
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.gradient.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &[L; D], j: &[L; D]) -> Sums<L, D> {
        let kernel = &self.gradient.reach.kernel;
        let slope = kernel.derivative_over_r_at(q);
        let rate = slope * q.splat(self.gradient.rate);
        Sums {
            density: kernel.value_at(q) * q.splat(self.volume),
            moment: Symmetric {
                rows: dyad(slope * q.splat(self.moment), x_ij, x_ij),
            },
            gradient: dyad(rate, &difference(i, j), x_ij),
        }
    }
}

/// Fluxes of one copy, and pressures.
#[derive(Clone, Copy, Debug)]
pub struct FluxPass {
    pub(super) reach: Reach,
    /// -κ V0/2 in units that make it speed quanta.
    pub(super) momentum: f64,
    /// -κ V0 in units that make it quanta of η.
    pub(super) entropy: f64,
    /// κ V0 in units that make it rate quanta.
    pub(super) stretching: f64,
    /// κ V0 in units that make it speed quanta.
    pub(super) warming: f64,
}

impl<const D: usize> PairPass<D> for FluxPass {
    type Read<T: Copy> = Carrier<T, D>;
    type Term<T: Copy> = Fluxes<T, D>;
    const PARITY: Fluxes<Parity, D> = Fluxes {
        momentum: [Parity::Antisymmetric; D],
        entropy: Parity::Antisymmetric,
        stretching: [[Parity::Symmetric; D]; D],
        warming: [Parity::Symmetric; D],
        pressure: [Parity::Antisymmetric; D],
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, most: &Carrier<f64, D>) -> f64 {
        let u = largest(&most.counterflow);
        let d = D as f64;
        let momentum = u * u * most.weight * d * self.momentum.abs();
        let entropy = largest(&most.flux) * d * self.entropy.abs();
        let stretching = largest(&most.carried) * self.stretching.abs();
        let speeds = most.warmth.max(most.pressure) * self.warming.abs();
        let all = momentum.max(entropy).max(stretching).max(speeds);
        2.001 * all * self.reach.largest_slope()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        q: L,
        i: &Carrier<L, D>,
        j: &Carrier<L, D>,
    ) -> Fluxes<L, D> {
        let slope = self.reach.kernel.derivative_over_r_at(q);
        let of_i = i.weight * dot(&i.counterflow, x_ij);
        let of_j = j.weight * dot(&j.counterflow, x_ij);
        let (half, warming) = (
            slope * q.splat(self.momentum),
            slope * q.splat(self.warming),
        );
        let mut momentum = *x_ij;
        for (d, momentum) in momentum.iter_mut().enumerate() {
            *momentum = half * (i.counterflow[d] * of_i + j.counterflow[d] * of_j);
        }
        let flux = dot(&i.flux, x_ij) + dot(&j.flux, x_ij);
        let (mut warmed, mut pressed) = (*x_ij, *x_ij);
        let (warmth, pressure) = (
            warming * (i.warmth - j.warmth),
            warming * (i.pressure + j.pressure),
        );
        for (warmed, pressed) in warmed.iter_mut().zip(&mut pressed) {
            *warmed = warmth * *warmed;
            *pressed = (q.splat(0.0) - pressure) * *pressed;
        }
        Fluxes {
            momentum,
            entropy: slope * q.splat(self.entropy) * flux,
            stretching: dyad(
                slope * q.splat(self.stretching),
                x_ij,
                &difference(&i.carried, &j.carried),
            ),
            warming: warmed,
            pressure: pressed,
        }
    }
}
