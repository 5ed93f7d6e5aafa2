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

use crate::kernel::Reach;
use crate::number::Lanes;
use crate::pairs::{PairPass, Parity};
use crate::values;

/// factor · x, by components.
#[inline(always)]
fn scaled<L: Lanes, const D: usize>(x: &[L; D], factor: L) -> [L; D] {
    // A loop, which the compiler takes apart in any number of lanes; a closure it may leave whole.
    let mut out = *x;
    for x in &mut out {
        *x = factor * *x;
    }
    out
}

/// Σ_j m W(r_ij), without the particle itself.
#[derive(Clone, Copy, Debug)]
pub struct DensityPass {
    pub(super) reach: Reach,
    /// m in density quanta times m³ (2D: m²).
    pub(super) mass: f64,
}

impl<const D: usize> PairPass<D> for DensityPass {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, _: &[f64; 0]) -> f64 {
        // A little more, for roundings.
        1.001 * (self.reach.largest_value() * self.mass).abs()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, _: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> L {
        self.reach.kernel.value_at(q) * q.splat(self.mass)
    }
}

values! {
    /// What the pressure force needs of a particle.
    pub struct Pressed {
        /// -κ m p/ρ², in units that make the term speed quanta.
        pressure: T,
    }
}

/// The pressure impulse.
#[derive(Clone, Copy, Debug)]
pub struct PressurePass {
    pub(super) reach: Reach,
}

impl<const D: usize> PairPass<D> for PressurePass {
    type Read<T: Copy> = Pressed<T, D>;
    type Term<T: Copy> = [T; D];
    const PARITY: [Parity; D] = [Parity::Antisymmetric; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, largest: &Pressed<f64, D>) -> f64 {
        // Twice for the pair, and a little for roundings.
        2.001 * largest.pressure * self.reach.largest_slope()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &Pressed<L, D>, j: &Pressed<L, D>) -> [L; D] {
        scaled(
            x_ij,
            (i.pressure + j.pressure) * self.reach.kernel.derivative_over_r_at(q),
        )
    }
}

values! {
    /// What the continuity equation and the filter need of a particle.
    pub struct Moving {
        /// u, in speed quanta.
        velocity: [T; D],
    }
}

impl<const D: usize> Moving<f64, D> {
    /// What no component of a velocity difference exceeds, summed over the components.
    fn largest_difference(&self) -> f64 {
        self.velocity.iter().fold(0.0, |sum, v| sum + 2.0 * v)
    }
}

/// The change of density by the relative motion.
#[derive(Clone, Copy, Debug)]
pub struct ContinuityPass {
    pub(super) reach: Reach,
    /// dt m in units that make the result density quanta.
    pub(super) factor: f64,
}

impl<const D: usize> PairPass<D> for ContinuityPass {
    type Read<T: Copy> = Moving<T, D>;
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, largest: &Moving<f64, D>) -> f64 {
        1.001 * largest.largest_difference() * self.reach.largest_slope() * self.factor.abs()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &Moving<L, D>, j: &Moving<L, D>) -> L {
        // Velocities stay below 2^51 quanta: they and their differences are exact.
        let mut dot = (i.velocity[0] - j.velocity[0]) * x_ij[0];
        for (d, x) in x_ij.iter().enumerate().skip(1) {
            dot = dot + (i.velocity[d] - j.velocity[d]) * *x;
        }
        (dot * self.reach.kernel.derivative_over_r_at(q)) * q.splat(self.factor)
    }
}

/// The impulse between particles that are very near to each other.
#[derive(Clone, Copy, Debug)]
pub struct AntiClumpPass {
    /// Of W̃.
    pub(super) reach: Reach,
    /// -κ m 2 p0/ρ0² in units that make the result speed quanta.
    pub(super) factor: f64,
}

impl<const D: usize> PairPass<D> for AntiClumpPass {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = [T; D];
    const PARITY: [Parity; D] = [Parity::Antisymmetric; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, _: &[f64; 0]) -> f64 {
        1.001 * self.reach.largest_slope() * self.factor.abs()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> [L; D] {
        scaled(
            x_ij,
            q.splat(self.factor) * self.reach.kernel.derivative_over_r_at(q),
        )
    }
}

/// The energy of that, in units of its largest value.
#[derive(Clone, Copy, Debug)]
pub struct AntiClumpEnergyPass {
    /// Of W̃.
    pub(super) reach: Reach,
    /// 1/W̃(0).
    pub(super) factor: f64,
}

impl<const D: usize> PairPass<D> for AntiClumpEnergyPass {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, _: &[f64; 0]) -> f64 {
        1.001
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, _: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> L {
        self.reach.kernel.value_at(q) * q.splat(self.factor)
    }
}

/// The weighted differences of the velocities, for the Shepard average.
#[derive(Clone, Copy, Debug)]
pub struct FilterPass {
    pub(super) reach: Reach,
    /// m/ρ0, m³ (2D: m²).
    pub(super) volume: f64,
}

impl<const D: usize> PairPass<D> for FilterPass {
    type Read<T: Copy> = Moving<T, D>;
    type Term<T: Copy> = [T; D];
    const PARITY: [Parity; D] = [Parity::Antisymmetric; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, largest: &Moving<f64, D>) -> f64 {
        let weight = (self.reach.largest_value() * self.volume).abs();
        1.001 * largest.largest_difference() * weight
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, _: &[L; D], q: L, i: &Moving<L, D>, j: &Moving<L, D>) -> [L; D] {
        let mut difference = j.velocity;
        for (difference, i) in difference.iter_mut().zip(&i.velocity) {
            *difference = *difference - *i;
        }
        scaled(
            &difference,
            self.reach.kernel.value_at(q) * q.splat(self.volume),
        )
    }
}

/// Geometry of the conservative wall, in length quanta.
#[derive(Clone, Copy, Debug)]
pub struct WallGeometry {
    /// r_w².
    pub(super) radius_squared: f64,
    /// ε².
    pub(super) softening_squared: f64,
}

impl WallGeometry {
    /// s and r² + ε².
    #[inline(always)]
    fn s<L: Lanes>(&self, r2: L) -> (L, L) {
        let softened = r2 + r2.splat(self.softening_squared);
        let s = r2.splat(self.radius_squared + self.softening_squared) / softened;
        (s, softened)
    }
}

/// The impulse of the conservative wall on a fluid particle. It does not vanish beyond r_w by
/// itself: only the plain traversal, which looks at every distance, may sum it, and its bound says
/// so.
#[derive(Clone, Copy, Debug)]
pub struct WallPass {
    pub(super) geometry: WallGeometry,
    /// κ E in units that make the result speed quanta.
    pub(super) factor: f64,
}

impl<const D: usize> PairPass<D> for WallPass {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = [T; D];
    const PARITY: [Parity; D] = [Parity::Antisymmetric; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.geometry.radius_squared
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], r2: L, _: &[L; 0], _: &[L; 0]) -> [L; D] {
        let (s, softened) = self.geometry.s(r2);
        scaled(x_ij, ((s * s - s) / softened) * r2.splat(self.factor))
    }
}

/// The energy of the conservative wall, in units of E per mass; see [`WallPass`].
#[derive(Clone, Copy, Debug)]
pub struct WallEnergyPass {
    pub(super) geometry: WallGeometry,
}

impl<const D: usize> PairPass<D> for WallEnergyPass {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.geometry.radius_squared
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, _: &[L; D], r2: L, _: &[L; 0], _: &[L; 0]) -> L {
        let (s, _) = self.geometry.s(r2);
        let y = s - r2.splat(1.0);
        r2.splat(0.25) * (y * y)
    }
}
