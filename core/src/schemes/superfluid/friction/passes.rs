//! The pair sums of friction and conduction.

use crate::kernel::Reach;
use crate::number::Lanes;
use crate::pairs::{PairPass, Parity};
use crate::values;

values! {
    /// What friction needs of a particle.
    pub struct Normal {
        /// v_n, in speed quanta.
        velocity: [T; D],
        /// T², K².
        square: T,
        /// 1/ϱ where it rubs, of a smooth wall 0.
        inverse: T,
        /// 1/ϱ, of a wall times its β.
        conducting: T,
    }

    /// What it gives.
    pub struct Rubbed {
        /// Δv, in speed quanta.
        impulse: [T; D],
        /// Conducted heat.
        heat: T,
    }

    /// What its heat needs.
    pub struct Rubbing {
        /// v_n before, in speed quanta.
        before: [T; D],
        /// The mean of v_n before and after.
        middle: [T; D],
        /// 1/ϱ.
        inverse: T,
    }
}

/// Impulses of friction and conducted heat.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPass {
    pub(super) reach: Reach,
    /// η², in squared length quanta.
    pub(super) softening: f64,
    /// dt V0 2 (D + 2) μ/ρ0.
    pub(super) friction: f64,
    /// dt V0 β/ρ0 in units that make heats their quanta.
    pub(super) conduction: f64,
}

/// Heat of friction.
#[derive(Clone, Copy, Debug)]
pub struct HeatPass {
    pub(super) of: FrictionPass,
    /// -dt V0 (D + 2) μ/ρ0 in units that make heats their quanta.
    pub(super) heat: f64,
}

impl FrictionPass {
    /// W'/(r (r² + η²) ϱ_i ϱ_j), and the difference of two velocities along x_ij.
    #[inline(always)]
    fn factor<L: Lanes, const D: usize>(&self, x_ij: &[L; D], q: L, i: L, j: L) -> L {
        let mut r2 = x_ij[0] * x_ij[0];
        for x in &x_ij[1..] {
            r2 = r2 + *x * *x;
        }
        let slope = self.reach.kernel.derivative_over_r_at(q);
        slope * (i * j) / (r2 + q.splat(self.softening))
    }
}

/// (a - b)·x.
#[inline(always)]
fn along<L: Lanes, const D: usize>(x: &[L; D], a: &[L; D], b: &[L; D]) -> L {
    let mut sum = (a[0] - b[0]) * x[0];
    for d in 1..D {
        sum = sum + (a[d] - b[d]) * x[d];
    }
    sum
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |a: f64, x| a.max(*x))
}

impl<const D: usize> PairPass<D> for FrictionPass {
    type Read<T: Copy> = Normal<T, D>;
    type Term<T: Copy> = Rubbed<T, D>;
    const PARITY: Rubbed<Parity, D> = Rubbed {
        impulse: [Parity::Antisymmetric; D],
        heat: Parity::Antisymmetric,
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, most: &Normal<f64, D>) -> f64 {
        // (v·x) x/(r² + η²) does not exceed D v.
        let slope = self.reach.kernel.derivative_over_r_at(0.0).abs();
        let rubs = slope * most.inverse * most.inverse;
        let velocity = 2.0 * rubs * largest(&most.velocity) * D as f64 * self.friction;
        let conducts = slope * most.conducting * most.conducting;
        let heat = conducts * most.square * self.conduction;
        1.001 * velocity.max(heat)
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
        i: &Normal<L, D>,
        j: &Normal<L, D>,
    ) -> Rubbed<L, D> {
        let factor = self.factor(x_ij, q, i.inverse, j.inverse);
        let push = factor * along(x_ij, &i.velocity, &j.velocity) * q.splat(self.friction);
        let mut impulse = *x_ij;
        for x in &mut impulse {
            *x = push * *x;
        }
        let conducting = i.conducting * j.conducting;
        let slope = self.reach.kernel.derivative_over_r_at(q) * conducting;
        Rubbed {
            impulse,
            heat: slope * (i.square - j.square) * q.splat(self.conduction),
        }
    }
}

impl<const D: usize> PairPass<D> for HeatPass {
    type Read<T: Copy> = Rubbing<T, D>;
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.of.reach.squared
    }
    fn bound(&self, most: &Rubbing<f64, D>) -> f64 {
        let slope = self.of.reach.kernel.derivative_over_r_at(0.0).abs();
        let speeds = 4.0 * largest(&most.before) * largest(&most.middle) * (D * D) as f64;
        1.001 * slope * most.inverse * most.inverse * speeds * self.heat.abs()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.of.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &Rubbing<L, D>, j: &Rubbing<L, D>) -> L {
        let factor = self.of.factor(x_ij, q, i.inverse, j.inverse);
        let before = along(x_ij, &i.before, &j.before);
        let middle = along(x_ij, &i.middle, &j.middle);
        factor * (before * middle) * q.splat(self.heat)
    }
}
