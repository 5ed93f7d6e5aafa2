//! The pair sums of weakly compressible SPH.
//!
//! | pass | sum | equation | parity |
//! |---|---|---|---|
//! | [`DensityPass`] | Σ m W(r) | (5) | symmetric |
//! | [`PressurePass`] | -κ Σ m (p_i/ρ_i² + p_j/ρ_j²) (W'/r) x_ij | (1b) | antisymmetric |
//! | [`ContinuityPass`] | κ Σ m (W'/r) u_ij · x_ij | (1a) | symmetric |
//! | [`AntiClumpPass`] | -κ Σ m (2 p0/ρ0²) (W̃'/r) x_ij | appendix A | antisymmetric |
//! | [`AntiClumpEnergyPass`] | Σ W̃(r)/W̃(0) | appendix A | diagnostics only |
//! | [`FilterPass`] | Σ (m/ρ0) W (u_j - u_i) | appendix A | antisymmetric |
//! | [`WallPass`] | κ Σ E (s² - s)/(r² + ε²) x_ij | section 3.3 | walls stand still |
//! | [`WallEnergyPass`] | Σ (s - 1)²/4, in units of E | (7) | diagnostics only |
//!
//! κ is the kick's share of the time step: terms enter the state as impulses, rounded after the
//! multiplication, so that equal masses exchange momentum exactly. All lengths are in quanta and
//! all factors that do not depend on the pair are multiplied together once.

use crate::exact::ExactSum;
use crate::kernel::WendlandC2;
use crate::number::{Arithmetic, Lanes, Real};
use crate::pairs::{PairPass, Parity};

/// factor · x, by components.
#[inline(always)]
fn scaled<L: Copy + core::ops::Mul<Output = L>, const D: usize>(x: &[L; D], factor: L) -> [L; D] {
    // A loop, which the compiler takes apart in any number of lanes; a closure it may leave whole.
    let mut out = *x;
    for x in &mut out {
        *x = factor * *x;
    }
    out
}

/// Σ_j m W(r_ij), without the particle itself.
#[derive(Clone, Copy, Debug)]
pub struct DensityPass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// m in density quanta times m³ (2D: m²).
    pub(super) mass: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, 0, 1> for DensityPass<A::Real> {
    type Word = A::Real;
    type Sum = A::Density;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    fn bound(&self, _: &[A::Real; 0]) -> f64 {
        let zero = A::Real::from_f64(0.0);
        (self.kernel.value(zero) * self.mass).to_f64().abs()
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        self.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, _: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> [L; 1] {
        [self.kernel.value_at(q) * q.splat(self.mass)]
    }
}

/// The pressure impulse. The word is -κ m p/ρ² in units that make the result speed quanta.
#[derive(Clone, Copy, Debug)]
pub struct PressurePass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, 1, D> for PressurePass<A::Real> {
    type Word = A::Real;
    type Sum = A::Speed;
    const PARITY: Parity = Parity::Antisymmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    fn bound(&self, largest: &[A::Real; 1]) -> f64 {
        let zero = A::Real::from_f64(0.0);
        let slope = (self.kernel.derivative_over_r(zero) * self.reach_squared.sqrt()).to_f64();
        // Twice for the pair, and a little for roundings.
        2.001 * largest[0].to_f64() * slope.abs()
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        self.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, x_ij: &[L; D], q: L, i: &[L; 1], j: &[L; 1]) -> [L; D] {
        scaled(x_ij, (i[0] + j[0]) * self.kernel.derivative_over_r_at(q))
    }
}

/// The change of density by the relative motion; the words are the velocity.
#[derive(Clone, Copy, Debug)]
pub struct ContinuityPass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// dt m in units that make the result density quanta.
    pub(super) factor: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, D, 1> for ContinuityPass<A::Real> {
    type Word = A::Speed;
    type Sum = A::Density;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    fn bound(&self, largest: &[A::Real; D]) -> f64 {
        let zero = A::Real::from_f64(0.0);
        let slope = (self.kernel.derivative_over_r(zero) * self.reach_squared.sqrt()).to_f64();
        let speed = largest.iter().fold(0.0, |sum, v| sum + 2.0 * v.to_f64());
        1.001 * speed * slope.abs() * self.factor.to_f64().abs()
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        self.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, x_ij: &[L; D], q: L, i: &[L; D], j: &[L; D]) -> [L; 1] {
        // Velocities stay below 2^51 quanta: they and their differences are exact.
        let mut dot = (i[0] - j[0]) * x_ij[0];
        for d in 1..D {
            dot = dot + (i[d] - j[d]) * x_ij[d];
        }
        [(dot * self.kernel.derivative_over_r_at(q)) * q.splat(self.factor)]
    }
}

/// The impulse between particles that are very near to each other.
#[derive(Clone, Copy, Debug)]
pub struct AntiClumpPass<R> {
    /// W̃.
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// -κ m 2 p0/ρ0² in units that make the result speed quanta.
    pub(super) factor: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, 0, D> for AntiClumpPass<A::Real> {
    type Word = A::Real;
    type Sum = A::Speed;
    const PARITY: Parity = Parity::Antisymmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    fn bound(&self, _: &[A::Real; 0]) -> f64 {
        let zero = A::Real::from_f64(0.0);
        let slope = (self.kernel.derivative_over_r(zero) * self.reach_squared.sqrt()).to_f64();
        1.001 * slope.abs() * self.factor.to_f64().abs()
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        self.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, x_ij: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> [L; D] {
        scaled(
            x_ij,
            q.splat(self.factor) * self.kernel.derivative_over_r_at(q),
        )
    }
}

/// The energy of that, in units of its largest value.
#[derive(Clone, Copy, Debug)]
pub struct AntiClumpEnergyPass<R> {
    /// W̃.
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// 1/W̃(0).
    pub(super) factor: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, 0, 1> for AntiClumpEnergyPass<A::Real> {
    type Word = A::Real;
    type Sum = ExactSum;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    fn bound(&self, _: &[A::Real; 0]) -> f64 {
        f64::INFINITY
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        self.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, _: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> [L; 1] {
        [self.kernel.value_at(q) * q.splat(self.factor)]
    }
}

/// The weighted differences of the velocities, for the Shepard average; the words are the velocity.
#[derive(Clone, Copy, Debug)]
pub struct FilterPass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// m/ρ0, m³ (2D: m²).
    pub(super) volume: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, D, D> for FilterPass<A::Real> {
    type Word = A::Speed;
    type Sum = A::Speed;
    const PARITY: Parity = Parity::Antisymmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    fn bound(&self, largest: &[A::Real; D]) -> f64 {
        let zero = A::Real::from_f64(0.0);
        let weight = (self.kernel.value(zero) * self.volume).to_f64().abs();
        let speed = largest.iter().fold(0.0, |sum, v| sum + 2.0 * v.to_f64());
        1.001 * speed * weight
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        self.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, _: &[L; D], q: L, i: &[L; D], j: &[L; D]) -> [L; D] {
        let mut difference = *j;
        for d in 0..D {
            difference[d] = j[d] - i[d];
        }
        scaled(&difference, self.kernel.value_at(q) * q.splat(self.volume))
    }
}

/// Geometry of the conservative wall, in length quanta.
#[derive(Clone, Copy, Debug)]
pub struct WallGeometry<R> {
    /// r_w².
    pub(super) radius_squared: R,
    /// ε².
    pub(super) softening_squared: R,
}

impl<R: Real> WallGeometry<R> {
    /// s and r² + ε².
    #[inline(always)]
    fn s<L: Lanes<R>>(&self, r2: L) -> (L, L) {
        let softened = r2 + r2.splat(self.softening_squared);
        let s = r2.splat(self.radius_squared + self.softening_squared) / softened;
        (s, softened)
    }
}

/// The impulse of the conservative wall on a fluid particle.
#[derive(Clone, Copy, Debug)]
pub struct WallPass<R> {
    pub(super) geometry: WallGeometry<R>,
    /// κ E in units that make the result speed quanta.
    pub(super) factor: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, 0, D> for WallPass<A::Real> {
    type Word = A::Real;
    type Sum = A::Speed;
    const PARITY: Parity = Parity::Antisymmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.geometry.radius_squared
    }
    fn bound(&self, _: &[A::Real; 0]) -> f64 {
        f64::INFINITY
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        r2
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, x_ij: &[L; D], r2: L, _: &[L; 0], _: &[L; 0]) -> [L; D] {
        let (s, softened) = self.geometry.s(r2);
        scaled(x_ij, ((s * s - s) / softened) * r2.splat(self.factor))
    }
}

/// The energy of the conservative wall, in units of E per mass.
#[derive(Clone, Copy, Debug)]
pub struct WallEnergyPass<R> {
    pub(super) geometry: WallGeometry<R>,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D, 0, 1> for WallEnergyPass<A::Real> {
    type Word = A::Real;
    type Sum = ExactSum;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> A::Real {
        self.geometry.radius_squared
    }
    fn bound(&self, _: &[A::Real; 0]) -> f64 {
        f64::INFINITY
    }
    #[inline(always)]
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L {
        r2
    }
    #[inline(always)]
    fn term<L: Lanes<A::Real>>(&self, _: &[L; D], r2: L, _: &[L; 0], _: &[L; 0]) -> [L; 1] {
        let (s, _) = self.geometry.s(r2);
        let y = s - r2.splat(A::Real::from_f64(1.0));
        [r2.splat(A::Real::from_f64(0.25)) * (y * y)]
    }
}
