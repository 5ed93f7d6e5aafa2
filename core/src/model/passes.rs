//! The pair sums of weakly compressible SPH.
//!
//! | pass | sum | equation | parity |
//! |---|---|---|---|
//! | [`DensityPass`] | Σ m W(r) | (5) | symmetric |
//! | [`PressurePass`] | -κ Σ m (p_i/ρ_i² + p_j/ρ_j²) (W'/r) x_ij | (1b) | antisymmetric |
//! | [`ContinuityPass`] | κ Σ m (W'/r) u_ij · x_ij | (1a) | symmetric |
//! | [`WallPass`] | κ Σ E (s² - s)/(r² + ε²) x_ij | section 3.3 | walls stand still |
//! | [`WallEnergyPass`] | Σ (s - 1)²/4, in units of E | (7) | diagnostics only |
//!
//! κ is the kick's share of the time step: terms enter the state as impulses, rounded after the
//! multiplication, so that equal masses exchange momentum exactly. All lengths are in quanta and
//! all factors that do not depend on the pair are multiplied together once.

use crate::exact::ExactSum;
use crate::kernel::WendlandC2;
use crate::number::{Arithmetic, Quantity, Real};
use crate::pairs::{PairPass, Parity, add_scalar, add_vector};

/// Σ_j m W(r_ij), without the particle itself.
#[derive(Clone, Copy, Debug)]
pub struct DensityPass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// m in density quanta times m³ (2D: m²).
    pub(super) mass: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D> for DensityPass<A::Real> {
    type Read = ();
    type Term = A::Real;
    type Sum = A::Density;
    const PARITY: Parity = Parity::Symmetric;
    #[inline]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    #[inline]
    fn term(&self, _: &[A::Real; D], r2: A::Real, (): (), (): ()) -> A::Real {
        self.kernel.value(r2.sqrt()) * self.mass
    }
    #[inline]
    fn add(sum: &A::Density, term: A::Real) -> Option<A::Density> {
        add_scalar(sum, term)
    }
}

/// The pressure impulse. `Read` is -κ m p/ρ² in units that make the result speed quanta.
#[derive(Clone, Copy, Debug)]
pub struct PressurePass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D> for PressurePass<A::Real> {
    type Read = A::Real;
    type Term = [A::Real; D];
    type Sum = [A::Speed; D];
    const PARITY: Parity = Parity::Antisymmetric;
    #[inline]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    #[inline]
    fn term(&self, x_ij: &[A::Real; D], r2: A::Real, p_i: A::Real, p_j: A::Real) -> Self::Term {
        let factor = (p_i + p_j) * self.kernel.derivative_over_r(r2.sqrt());
        x_ij.map(|x| factor * x)
    }
    #[inline]
    fn add(sum: &Self::Sum, term: Self::Term) -> Option<Self::Sum> {
        add_vector(sum, term)
    }
}

/// The change of density by the relative motion; `Read` is the velocity.
#[derive(Clone, Copy, Debug)]
pub struct ContinuityPass<R> {
    pub(super) kernel: WendlandC2<R>,
    pub(super) reach_squared: R,
    /// dt m in units that make the result density quanta.
    pub(super) factor: R,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D> for ContinuityPass<A::Real> {
    type Read = [A::Speed; D];
    type Term = A::Real;
    type Sum = A::Density;
    const PARITY: Parity = Parity::Symmetric;
    #[inline]
    fn reach_squared(&self) -> A::Real {
        self.reach_squared
    }
    #[inline]
    fn term(&self, x_ij: &[A::Real; D], r2: A::Real, u_i: Self::Read, u_j: Self::Read) -> A::Real {
        let mut dot = u_i[0].difference::<A::Real>(u_j[0]) * x_ij[0];
        for d in 1..D {
            dot = dot + u_i[d].difference::<A::Real>(u_j[d]) * x_ij[d];
        }
        (dot * self.kernel.derivative_over_r(r2.sqrt())) * self.factor
    }
    #[inline]
    fn add(sum: &A::Density, term: A::Real) -> Option<A::Density> {
        add_scalar(sum, term)
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
    #[inline]
    fn s(&self, r2: R) -> (R, R) {
        let softened = r2 + self.softening_squared;
        let s = (self.radius_squared + self.softening_squared) / softened;
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

impl<A: Arithmetic, const D: usize> PairPass<A, D> for WallPass<A::Real> {
    type Read = ();
    type Term = [A::Real; D];
    type Sum = [A::Speed; D];
    const PARITY: Parity = Parity::Antisymmetric;
    #[inline]
    fn reach_squared(&self) -> A::Real {
        self.geometry.radius_squared
    }
    #[inline]
    fn term(&self, x_ij: &[A::Real; D], r2: A::Real, (): (), (): ()) -> Self::Term {
        let (s, softened) = self.geometry.s(r2);
        let factor = ((s * s - s) / softened) * self.factor;
        x_ij.map(|x| factor * x)
    }
    #[inline]
    fn add(sum: &Self::Sum, term: Self::Term) -> Option<Self::Sum> {
        add_vector(sum, term)
    }
}

/// The energy of the conservative wall, in units of E per mass.
#[derive(Clone, Copy, Debug)]
pub struct WallEnergyPass<R> {
    pub(super) geometry: WallGeometry<R>,
}

impl<A: Arithmetic, const D: usize> PairPass<A, D> for WallEnergyPass<A::Real> {
    type Read = ();
    type Term = A::Real;
    type Sum = ExactSum;
    const PARITY: Parity = Parity::Symmetric;
    #[inline]
    fn reach_squared(&self) -> A::Real {
        self.geometry.radius_squared
    }
    #[inline]
    fn term(&self, _: &[A::Real; D], r2: A::Real, (): (), (): ()) -> A::Real {
        let (s, _) = self.geometry.s(r2);
        let y = s - A::Real::from_f64(1.0);
        A::Real::from_f64(0.25) * (y * y)
    }
    #[inline]
    fn add(sum: &ExactSum, term: A::Real) -> Option<ExactSum> {
        Some(sum.plus(term.to_f64()))
    }
}
