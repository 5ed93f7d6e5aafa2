//! What happens to one particle between the sums over pairs.

use super::fields::{CONSTANT, DENSITY, FIXED_DENSITY, PRESSURE};
use super::state_equation::StateEquation;
use crate::fault::{Fault, FaultKind};
use crate::fields::{IMPULSE, VELOCITY};
use crate::number::{Arithmetic, Quantity, Word};
use crate::points::PointPass;
use crate::values;

/// A density begins with the particle's own term, m W(0).
#[derive(Clone, Copy, Debug)]
pub struct OwnDensity<W> {
    /// In density quanta.
    pub(super) own: W,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for OwnDensity<A::Word> {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[DENSITY];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], density: &mut A::Word) -> Result<(), Fault> {
        *density = self.own;
        Ok(())
    }
}

/// ρ ← ρ + C_a.
#[derive(Clone, Copy, Debug)]
pub struct AddConstant;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for AddConstant {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[CONSTANT];
    const WRITE: &'static [usize] = &[DENSITY];
    #[inline(always)]
    fn at(&self, _: u64, constant: &A::Word, density: &mut A::Word) -> Result<(), Fault> {
        *density = density.plus(*constant);
        Ok(())
    }
}

/// C_a ← ρ0 - Σ m W, or 0 where there is no correction.
#[derive(Clone, Copy, Debug)]
pub struct Constants<W> {
    /// In density quanta.
    pub(super) reference: Option<W>,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Constants<A::Word> {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[DENSITY];
    const WRITE: &'static [usize] = &[CONSTANT];
    #[inline(always)]
    fn at(&self, _: u64, sum: &A::Word, constant: &mut A::Word) -> Result<(), Fault> {
        *constant = match self.reference {
            Some(reference) => reference.plus(sum.negated()),
            None => A::Word::ZERO,
        };
        Ok(())
    }
}

/// One density field becomes another, plus C_a or not.
#[derive(Clone, Copy, Debug)]
pub struct FixedPart;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for FixedPart {
    type Read<T: Copy> = [T; 2];
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[DENSITY, CONSTANT];
    const WRITE: &'static [usize] = &[FIXED_DENSITY];
    #[inline(always)]
    fn at(&self, _: u64, [sum, c]: &[A::Word; 2], fixed: &mut A::Word) -> Result<(), Fault> {
        *fixed = sum.plus(*c);
        Ok(())
    }
}

/// ρ ← the part of a dummy's density that does not change.
#[derive(Clone, Copy, Debug)]
pub struct FromFixed;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for FromFixed {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[FIXED_DENSITY];
    const WRITE: &'static [usize] = &[DENSITY];
    #[inline(always)]
    fn at(&self, _: u64, fixed: &A::Word, density: &mut A::Word) -> Result<(), Fault> {
        *density = *fixed;
        Ok(())
    }
}

/// ρ ← the density of the state, where that is a field of its own.
#[derive(Clone, Copy, Debug)]
pub struct Evolved;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Evolved {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[CONSTANT];
    const WRITE: &'static [usize] = &[DENSITY];
    #[inline(always)]
    fn at(&self, _: u64, evolved: &A::Word, density: &mut A::Word) -> Result<(), Fault> {
        *density = *evolved;
        Ok(())
    }
}

/// -κ m p/ρ² as a function of the density, in the units of [`PressurePass`].
///
/// [`PressurePass`]: super::PressurePass
#[derive(Clone, Copy, Debug)]
pub struct PressureFactor {
    pub(super) factor: f64,
    pub(super) state_equation: StateEquation,
    /// 1/ρ0 in 1/quanta of density.
    pub(super) inverse_reference: f64,
}

impl PressureFactor {
    /// For a density in quanta.
    ///
    /// # Errors
    /// The density is not positive.
    #[inline]
    pub fn of<Q: Quantity>(&self, density: Q, id: u64) -> Result<f64, Fault> {
        let relative_density = density.quanta() * self.inverse_reference;
        if relative_density > 0.0 {
            let equation = self.state_equation;
            Ok(self.factor * equation.pressure_over_density_squared(relative_density))
        } else {
            Err(Fault::new(FaultKind::DensityNotPositive, id))
        }
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for PressureFactor {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[DENSITY];
    const WRITE: &'static [usize] = &[PRESSURE];
    #[inline(always)]
    fn at(&self, id: u64, density: &A::Word, pressure: &mut A::Word) -> Result<(), Fault> {
        *pressure = A::Word::of_real(self.of(*density, id)?);
        Ok(())
    }
}

values! {
    /// What the filter's average needs of a particle.
    pub struct Smoothed {
        /// Σ R((m/ρ0) W (u_b - u_a)), in speed quanta.
        sum: [T; D],
        /// ρ, in density quanta.
        density: T,
        /// C_a, in density quanta.
        constant: T,
    }
}

/// u ← u + R(sum/γ), γ = (ρ - C_a)/ρ0.
#[derive(Clone, Copy, Debug)]
pub struct Average {
    /// 1/ρ0 in 1/quanta of density.
    pub(super) inverse_reference: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Average {
    type Read<T: Copy> = Smoothed<T, D>;
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[IMPULSE, DENSITY, CONSTANT];
    const WRITE: &'static [usize] = &[VELOCITY];
    fn at(&self, id: u64, of: &Smoothed<A::Word, D>, v: &mut [A::Word; D]) -> Result<(), Fault> {
        let bare = of.density.plus(of.constant.negated());
        let gamma = bare.quanta() * self.inverse_reference;
        for (v, sum) in v.iter_mut().zip(of.sum) {
            let moved = v.add_rounded(sum.quanta() / gamma);
            *v = moved
                .filter(|v| v.in_range())
                .ok_or(Fault::new(FaultKind::VelocityRange, id))?;
        }
        Ok(())
    }
}
