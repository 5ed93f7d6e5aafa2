//! What sums over positions begin with, and what they mean.

use super::super::fields::{
    COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, DENSITY_CONSTANT, ENTROPY, ENTROPY_COPY, FLUXES,
    GRADIENT, INVERSE, ONE, SUMS,
};
use super::super::parameters::{HeliumParameters, Operators};
use super::super::passes::{Fluxes, Sums};
use super::super::walls::metres;
use crate::fault::{Fault, FaultKind};
use crate::fields::POSITION;
use crate::matrix::{damped_inverse, identity};
use crate::number::{Arithmetic, Quantity, Word};
use crate::points::PointPass;
use crate::values;
use crate::values::{Symmetric, Values};

values! {
    /// Sums, and the constant that is added to a density.
    pub struct Corrected {
        sums: Sums<T, D>,
        constant: T,
    }

    /// What sums mean.
    pub struct Resolved {
        density: T,
        inverse: Symmetric<T, D>,
        gradient: [[T; D]; D],
    }

    /// One copy.
    pub struct OneCopy {
        counterflow: [T; D],
        entropy: T,
    }
}

/// Sums begin with nothing.
#[derive(Clone, Copy, Debug)]
pub struct NoSums;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NoSums {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = Sums<T, D>;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[SUMS];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], sums: &mut Sums<A::Word, D>) -> Result<(), Fault> {
        *sums = Sums::from_fn(|_| A::Word::ZERO);
        Ok(())
    }
}

/// dt K of nobody.
#[derive(Clone, Copy, Debug)]
pub struct NoGradient;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NoGradient {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = [[T; D]; D];
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[GRADIENT];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], k: &mut [[A::Word; D]; D]) -> Result<(), Fault> {
        *k = [[A::Word::ZERO; D]; D];
        Ok(())
    }
}

/// No fluxes.
#[derive(Clone, Copy, Debug)]
pub struct NoFluxes;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NoFluxes {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = Fluxes<T, D>;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[FLUXES];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], sums: &mut Fluxes<A::Word, D>) -> Result<(), Fault> {
        *sums = Fluxes::from_fn(|_| A::Word::ZERO);
        Ok(())
    }
}

values! {
    /// Sums over the neighbours of a place.
    pub struct PlacedSums {
        sums: Sums<T, D>,
        position: [T; D],
    }
}

/// C_a ← 1 + p/(ρ0 u_1²) - Σ V0 W, with the first pressure p.
#[derive(Clone, Debug)]
pub struct SetConstant<const D: usize> {
    pub(in super::super) parameters: HeliumParameters<D>,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for SetConstant<D> {
    type Read<T: Copy> = PlacedSums<T, D>;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[SUMS, POSITION];
    const WRITE: &'static [usize] = &[DENSITY_CONSTANT];
    fn at(
        &self,
        id: u64,
        read: &PlacedSums<A::Word, D>,
        constant: &mut A::Word,
    ) -> Result<(), Fault> {
        let p = &self.parameters;
        let x = metres(&read.position, p.scale.length_quantum());
        let one = A::Word::from_whole_quanta(ONE as i64);
        let first = one.add_rounded(p.first_compression(&x) * ONE);
        let first = first.ok_or(Fault::new(FaultKind::TermRange, id))?;
        *constant = first.plus(read.sums.density.negated());
        Ok(())
    }
}

/// W ← w, S ← s.
#[derive(Clone, Copy, Debug)]
pub struct SetCopies;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for SetCopies {
    type Read<T: Copy> = OneCopy<T, D>;
    type Write<T: Copy> = OneCopy<T, D>;
    const READ: &'static [usize] = &[COUNTERFLOW, ENTROPY];
    const WRITE: &'static [usize] = &[COUNTERFLOW_COPY, ENTROPY_COPY];
    #[inline(always)]
    fn at(
        &self,
        _: u64,
        read: &OneCopy<A::Word, D>,
        write: &mut OneCopy<A::Word, D>,
    ) -> Result<(), Fault> {
        *write = *read;
        Ok(())
    }
}

/// What sums mean: ϱ with its constant, H⁻¹, dt K.
#[derive(Clone, Copy, Debug)]
pub struct Resolve {
    pub(in super::super) operators: Operators,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Resolve {
    type Read<T: Copy> = Corrected<T, D>;
    type Write<T: Copy> = Resolved<T, D>;
    const READ: &'static [usize] = &[SUMS, DENSITY_CONSTANT];
    const WRITE: &'static [usize] = &[DENSITY, INVERSE, GRADIENT];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Corrected<A::Word, D>,
        write: &mut Resolved<A::Word, D>,
    ) -> Result<(), Fault> {
        let sums = &read.sums;
        write.density = sums.density.plus(read.constant);
        write.gradient = sums.gradient;
        let density = write.density.quanta() / ONE;
        if density <= 0.0 || density.is_nan() {
            return Err(Fault::new(FaultKind::DensityNotPositive, id));
        }
        let rows = match self.operators {
            Operators::Paper => identity(),
            Operators::Renormalised => {
                let rows = sums.moment.rows.map(|row| row.map(|x| x.quanta() / ONE));
                let inverse = damped_inverse(&Symmetric { rows }).rows;
                inverse.map(|row| row.map(|x| -(density * x)))
            }
        };
        write.inverse.rows = rows.map(|row| row.map(A::Word::of_real));
        if rows.as_flattened().iter().all(|x| x.is_finite()) {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::TermRange, id))
        }
    }
}
