//! The pair sums of solids, of the paper's eqs. (7), (10), (21a), (40) and (42), divided by ρ0.
//!
//! | pass | sums over j | parity |
//! |---|---|---|
//! | [`GradientPass`] | dt K = Σ dt V0 (W'/r) v_ij x_ijᵀ | symmetric |
//! | [`MomentsPass`] | H = Σ V0 (W'/r) x_ij x_ijᵀ; Σ V0 W; Σ V0 h dW/dh; dt K | symmetric |
//! | [`ForcePass`] | κ Σ V0 ((T_i + T_j) (W'/r) - (c_p²λ_i + c_p²λ_j) s) x_ij | antisymmetric |
//! | [`SplitForcePass`] | the same, what shear adds to it by itself | antisymmetric |
//!
//! V0 is the volume of a particle, s = (1/r) d(h dW/dh)/dr, and κ the kick's share of the time step:
//! terms of the force enter the state as impulses. H, K, λ and the shear part of T run over the
//! particles of the own body, the density and its part of T over all: bodies that touch push each
//! other, and slide.

use crate::kernel::Reach;
use crate::number::{Lanes, sqrt};
use crate::pairs::{PairPass, Parity};
use crate::values;
use crate::values::Symmetric;

values! {
    /// What velocity gradients need of a particle.
    pub struct Moving {
        /// v, in speed quanta.
        velocity: [T; D],
        /// Number of the body.
        body: T,
    }

    /// What is summed at once after a drift.
    pub struct Moments {
        /// H.
        moment: Symmetric<T, D>,
        /// Σ V0 W.
        density: T,
        /// Σ V0 h dW/dh.
        clumping: T,
        /// dt K, row by row.
        gradient: [[T; D]; D],
    }

    /// What forces need of a particle; all of it times κ V0 in units that make a term speed quanta.
    pub struct Stressed {
        /// S H⁻¹, row by row.
        shear: [[T; D]; D],
        /// -ρ0 ∂ε_0/∂ρ.
        pressure: T,
        /// -c_p² λ.
        clumping: T,
        /// Number of the body.
        body: T,
    }
}

/// 1 for particles of one body, else 0.
#[inline(always)]
fn in_one_body<L: Lanes>(i: L, j: L) -> L {
    let difference = i - j;
    i.splat(1.0)
        .where_below(difference * difference, i.splat(0.5))
}

/// factor · v_ij x_ijᵀ.
#[inline(always)]
fn gradient<L: Lanes, const D: usize>(
    factor: L,
    x_ij: &[L; D],
    i: &Moving<L, D>,
    j: &Moving<L, D>,
) -> [[L; D]; D] {
    let mut rows = [*x_ij; D];
    for (d, row) in rows.iter_mut().enumerate() {
        // Velocities stay below 2^51 quanta: they and their differences are exact.
        let v = factor * (i.velocity[d] - j.velocity[d]);
        for x in row {
            *x = v * *x;
        }
    }
    rows
}

/// What no entry of such a matrix exceeds.
fn largest_gradient<const D: usize>(reach: &Reach, factor: f64, largest: &Moving<f64, D>) -> f64 {
    let speed = largest.velocity.iter().fold(0.0, |a: f64, v| a.max(*v));
    2.0 * speed * reach.largest_slope() * factor.abs()
}

/// dt K alone.
#[derive(Clone, Copy, Debug)]
pub struct GradientPass {
    pub(super) reach: Reach,
    /// dt V0 in units that make the result rate quanta.
    pub(super) rate: f64,
}

impl<const D: usize> PairPass<D> for GradientPass {
    type Read<T: Copy> = Moving<T, D>;
    type Term<T: Copy> = [[T; D]; D];
    const PARITY: [[Parity; D]; D] = [[Parity::Symmetric; D]; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, largest: &Moving<f64, D>) -> f64 {
        // A little more, for roundings.
        1.001 * largest_gradient(&self.reach, self.rate, largest)
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
        i: &Moving<L, D>,
        j: &Moving<L, D>,
    ) -> [[L; D]; D] {
        let slope = self.reach.kernel.derivative_over_r_at(q) * in_one_body(i.body, j.body);
        gradient(slope * q.splat(self.rate), x_ij, i, j)
    }
}

/// H, densities, λ and dt K.
#[derive(Clone, Copy, Debug)]
pub struct MomentsPass {
    pub(super) gradient: GradientPass,
    /// V0 in units that make H quanta of sums.
    pub(super) moment: f64,
    /// V0 in units that make the other two quanta of sums.
    pub(super) volume: f64,
}

impl<const D: usize> PairPass<D> for MomentsPass {
    type Read<T: Copy> = Moving<T, D>;
    type Term<T: Copy> = Moments<T, D>;
    const PARITY: Moments<Parity, D> = Moments {
        moment: Symmetric {
            rows: [[Parity::Symmetric; D]; D],
        },
        density: Parity::Symmetric,
        clumping: Parity::Symmetric,
        gradient: [[Parity::Symmetric; D]; D],
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.gradient.reach.squared
    }
    fn bound(&self, largest: &Moving<f64, D>) -> f64 {
        let reach = &self.gradient.reach;
        let gradient = largest_gradient(reach, self.gradient.rate, largest);
        let moment = reach.largest_slope() * sqrt(reach.squared) * self.moment;
        // |h dW/dh| is largest at r = 0, where it is D W.
        let clumping = (reach.kernel.structural_at(0.0) * self.volume).abs();
        1.001 * gradient.max(moment).max(clumping)
    }
    fn bounds(&self, largest: &Moving<f64, D>) -> Moments<f64, D> {
        // Only the gradient moves with the velocities.
        let still = self.bound(&Moving {
            velocity: [0.0; D],
            ..*largest
        });
        Moments {
            moment: Symmetric {
                rows: [[still; D]; D],
            },
            density: still,
            clumping: still,
            gradient: self.gradient.bounds(largest),
        }
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.gradient.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        q: L,
        i: &Moving<L, D>,
        j: &Moving<L, D>,
    ) -> Moments<L, D> {
        let kernel = &self.gradient.reach.kernel;
        let same = in_one_body(i.body, j.body);
        let slope = kernel.derivative_over_r_at(q) * same;
        let moment = slope * q.splat(self.moment);
        let mut rows = [*x_ij; D];
        for (d, row) in rows.iter_mut().enumerate() {
            let x = moment * x_ij[d];
            for y in row {
                *y = x * *y;
            }
        }
        Moments {
            moment: Symmetric { rows },
            density: kernel.value_at(q) * q.splat(self.volume),
            clumping: (kernel.structural_at(q) * same) * q.splat(self.volume),
            gradient: gradient(slope * q.splat(self.gradient.rate), x_ij, i, j),
        }
    }
}

/// The impulse of stresses and of the tensile penalty.
#[derive(Clone, Copy, Debug)]
pub struct ForcePass {
    pub(super) reach: Reach,
}

impl<const D: usize> PairPass<D> for ForcePass {
    type Read<T: Copy> = Stressed<T, D>;
    type Term<T: Copy> = [T; D];
    const PARITY: [Parity; D] = [Parity::Antisymmetric; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, largest: &Stressed<f64, D>) -> f64 {
        let entries = largest.shear.as_flattened();
        let shear = entries.iter().fold(0.0, |a: f64, t| a.max(*t)) * D as f64;
        // r |s| does not exceed the slope of the kernel.
        let stress = shear + largest.pressure + largest.clumping;
        2.001 * stress * self.reach.largest_slope()
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
        i: &Stressed<L, D>,
        j: &Stressed<L, D>,
    ) -> [L; D] {
        let (own, radial) = factors(&self.reach, q, i, j);
        let mut term = *x_ij;
        for (d, term) in term.iter_mut().enumerate() {
            *term = own * traction(x_ij, &i.shear[d], &j.shear[d]) + radial * *term;
        }
        term
    }
}

/// What multiplies the tractions, and x_ij: the factors of shear, and of pressures and penalties.
#[inline(always)]
fn factors<L: Lanes, const D: usize>(
    reach: &Reach,
    q: L,
    i: &Stressed<L, D>,
    j: &Stressed<L, D>,
) -> (L, L) {
    let slope = reach.kernel.derivative_over_r_at(q);
    let structural = reach.kernel.structural_derivative_over_r_at(q);
    let same = in_one_body(i.body, j.body);
    let radial =
        (i.pressure + j.pressure) * slope + ((i.clumping + j.clumping) * structural) * same;
    (slope * same, radial)
}

/// (T_i + T_j) x_ij, of a row of T.
#[inline(always)]
fn traction<L: Lanes, const D: usize>(x_ij: &[L; D], i: &[L; D], j: &[L; D]) -> L {
    let mut traction = (i[0] + j[0]) * x_ij[0];
    for (c, x) in x_ij.iter().enumerate().skip(1) {
        traction = traction + (i[c] + j[c]) * *x;
    }
    traction
}

values! {
    /// An impulse in two parts.
    pub struct SplitForce {
        /// Of shear: what acts on the velocities that walls pretend to have.
        shear: [T; D],
        /// Of pressures and penalties: what acts on the velocities that particles have.
        rest: [T; D],
    }
}

/// [`ForcePass`], with the two parts kept apart: the work that walls do needs them.
#[derive(Clone, Copy, Debug)]
pub struct SplitForcePass {
    pub(super) whole: ForcePass,
}

impl<const D: usize> PairPass<D> for SplitForcePass {
    type Read<T: Copy> = Stressed<T, D>;
    type Term<T: Copy> = SplitForce<T, D>;
    const PARITY: SplitForce<Parity, D> = SplitForce {
        shear: [Parity::Antisymmetric; D],
        rest: [Parity::Antisymmetric; D],
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.whole.reach.squared
    }
    fn bound(&self, largest: &Stressed<f64, D>) -> f64 {
        self.whole.bound(largest)
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.whole.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        q: L,
        i: &Stressed<L, D>,
        j: &Stressed<L, D>,
    ) -> SplitForce<L, D> {
        let (own, radial) = factors(&self.whole.reach, q, i, j);
        let mut term = SplitForce {
            shear: *x_ij,
            rest: *x_ij,
        };
        for d in 0..D {
            term.shear[d] = own * traction(x_ij, &i.shear[d], &j.shear[d]);
            term.rest[d] = radial * x_ij[d];
        }
        term
    }
}
