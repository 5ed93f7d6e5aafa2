//! What happens to one particle between the sums over pairs.

use super::fields::{
    BODY, CLUMPING, CLUMPING_CONSTANT, DENSITY, DENSITY_CONSTANT, DISTORTION, GRADIENT, HELD,
    INVERSE, LOG_VOLUME, MOMENTS, ONE, ONE_RATE, STRESS,
};
use super::material::{Material, whole_metric};
use super::parameters::{MAX_BODIES, Parameters, material_of};
use super::passes::{Moments, Stressed};
use crate::fault::{Fault, FaultKind};
use crate::fields::IMPULSE;
use crate::lift::lift;
use crate::matrix::{Matrix, damped_inverse, identity, inverse, product, trace};
use crate::number::{Arithmetic, Quantity, Word};
use crate::points::PointPass;
use crate::values;
use crate::values::{Symmetric, Values};
use heapless::Vec;

values! {
    /// Sums begin with nothing.
    pub struct Summed {
        sums: Moments<T, D>,
    }

    /// What a particle is at first.
    pub struct Unstrained {
        distortion: [[T; D]; D],
        log_volume: T,
        body: T,
        held: T,
    }

    /// The constants of the densities.
    pub struct Constants {
        density: T,
        clumping: T,
    }

    /// Sums, and what is added to them.
    pub struct Corrected {
        sums: Moments<T, D>,
        constants: Constants<T, D>,
    }

    /// What sums mean.
    pub struct Resolved {
        density: T,
        clumping: T,
        inverse: Symmetric<T, D>,
        gradient: [[T; D]; D],
    }

    /// dt L, as its two factors.
    pub struct Flow {
        gradient: [[T; D]; D],
        inverse: Symmetric<T, D>,
    }

    /// What a lift changes.
    pub struct Shape {
        distortion: [[T; D]; D],
        log_volume: T,
    }

    /// What a stress follows from.
    pub struct Strained {
        shape: Shape<T, D>,
        inverse: Symmetric<T, D>,
        density: T,
        clumping: T,
        body: T,
    }

    /// A stress without the number of the body, which is a field of its own.
    pub struct Stress {
        shear: [[T; D]; D],
        pressure: T,
        clumping: T,
    }
}

/// Words as the doubles that they count, times a unit.
#[inline(always)]
fn scaled<W: Quantity, const D: usize>(words: &[[W; D]; D], unit: f64) -> Matrix<D> {
    words.map(|row| row.map(|word| word.quanta() * unit))
}

/// The moments of the first positions: nothing yet.
#[derive(Clone, Copy, Debug)]
pub struct NoMoments;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NoMoments {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = Summed<T, D>;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[MOMENTS];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], sums: &mut Summed<A::Word, D>) -> Result<(), Fault> {
        *sums = Summed::from_fn(|_| A::Word::ZERO);
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

/// A ← 1, θ ← 0; the body and whether it is held follow from the id.
#[derive(Clone, Debug)]
pub struct Begin<const D: usize> {
    pub(super) parameters: Parameters<D>,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Begin<D> {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = Unstrained<T, D>;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[DISTORTION, LOG_VOLUME, BODY, HELD];
    fn at(
        &self,
        id: u64,
        _: &[A::Word; 0],
        write: &mut Unstrained<A::Word, D>,
    ) -> Result<(), Fault> {
        let part = self.parameters.part_of(id);
        let one = ONE as i64;
        write.distortion = identity::<D>()
            .map(|row| row.map(|x| A::Word::from_whole_quanta(if x > 0.0 { one } else { 0 })));
        write.log_volume = A::Word::ZERO;
        write.body = A::Word::from_whole_quanta(i64::from(part.body));
        write.held = A::Word::from_whole_quanta(i64::from(part.held));
        Ok(())
    }
}

/// C_ρ ← 1 - Σ V0 W, C_λ ← -Σ V0 h dW/dh.
#[derive(Clone, Copy, Debug)]
pub struct SetConstants;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for SetConstants {
    type Read<T: Copy> = Moments<T, D>;
    type Write<T: Copy> = Constants<T, D>;
    const READ: &'static [usize] = &[MOMENTS];
    const WRITE: &'static [usize] = &[DENSITY_CONSTANT, CLUMPING_CONSTANT];
    #[inline(always)]
    fn at(
        &self,
        _: u64,
        sums: &Moments<A::Word, D>,
        write: &mut Constants<A::Word, D>,
    ) -> Result<(), Fault> {
        let one = A::Word::from_whole_quanta(ONE as i64);
        write.density = one.plus(sums.density.negated());
        write.clumping = sums.clumping.negated();
        Ok(())
    }
}

/// What sums mean: ρ/ρ0 and λ/ρ0 with their constants, H⁻¹, dt K.
#[derive(Clone, Copy, Debug)]
pub struct Resolve;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Resolve {
    type Read<T: Copy> = Corrected<T, D>;
    type Write<T: Copy> = Resolved<T, D>;
    const READ: &'static [usize] = &[MOMENTS, DENSITY_CONSTANT, CLUMPING_CONSTANT];
    const WRITE: &'static [usize] = &[DENSITY, CLUMPING, INVERSE, GRADIENT];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Corrected<A::Word, D>,
        write: &mut Resolved<A::Word, D>,
    ) -> Result<(), Fault> {
        let sums = &read.sums;
        write.density = sums.density.plus(read.constants.density);
        write.clumping = sums.clumping.plus(read.constants.clumping);
        let moment = Symmetric {
            rows: scaled(&sums.moment.rows, 1.0 / ONE),
        };
        let rows = damped_inverse(&moment).rows;
        let finite = rows.as_flattened().iter().all(|x| x.is_finite());
        write.inverse.rows = rows.map(|row| row.map(A::Word::of_real));
        write.gradient = sums.gradient;
        if finite {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::TermRange, id))
        }
    }
}

/// T and -c_p² λ from the distortion, the density and λ.
#[derive(Clone, Debug)]
pub struct Stresses {
    pub(super) materials: Vec<Material, MAX_BODIES>,
    /// κ V0 in units that make forces speed quanta.
    pub(super) factor: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Stresses {
    type Read<T: Copy> = Strained<T, D>;
    type Write<T: Copy> = Stress<T, D>;
    const READ: &'static [usize] = &[DISTORTION, LOG_VOLUME, INVERSE, DENSITY, CLUMPING, BODY];
    const WRITE: &'static [usize] = &[STRESS];
    #[inline(always)]
    fn at(
        &self,
        _: u64,
        read: &Strained<A::Word, D>,
        write: &mut Stress<A::Word, D>,
    ) -> Result<(), Fault> {
        let unit = 1.0 / ONE;
        let material = material_of(&self.materials, read.body.whole_quanta());
        let distortion = scaled(&read.shape.distortion, unit);
        let metric = whole_metric(&distortion, read.shape.log_volume.quanta() * unit);
        let inverse = read.inverse.rows.map(|row| row.map(Word::real));
        let shear = product(&material.shear_stress(&metric), &inverse);
        let pressure = material.bulk_stress(read.density.quanta() * unit);
        let squared = material.penalty_speed * material.penalty_speed;
        let clumping = squared * (read.clumping.quanta() * unit);
        let factor = self.factor;
        write.shear = shear.map(|row| row.map(|x| A::Word::of_real(factor * x)));
        write.pressure = A::Word::of_real(-(factor * pressure));
        write.clumping = A::Word::of_real(-(factor * clumping));
        Ok(())
    }
}

/// J ← 0 for what is held.
#[derive(Clone, Copy, Debug)]
pub struct Hold;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Hold {
    type Read<T: Copy> = T;
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[HELD];
    const WRITE: &'static [usize] = &[IMPULSE];
    #[inline(always)]
    fn at(&self, _: u64, held: &A::Word, impulse: &mut [A::Word; D]) -> Result<(), Fault> {
        if held.whole_quanta() != 0 {
            *impulse = [A::Word::ZERO; D];
        }
        Ok(())
    }
}

/// J ← R(κ g).
#[derive(Clone, Copy, Debug)]
pub struct Fall<W, const D: usize> {
    /// In speed quanta; none where it is out of range.
    pub(super) impulse: Option<[W; D]>,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Fall<A::Word, D> {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[IMPULSE];
    #[inline(always)]
    fn at(&self, id: u64, _: &[A::Word; 0], impulse: &mut [A::Word; D]) -> Result<(), Fault> {
        *impulse = self.impulse.ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}

/// -c dt L of a particle.
#[inline(always)]
pub(super) fn displacement<W: Word, const D: usize>(flow: &Flow<W, D>, c: f64) -> Matrix<D> {
    let gradient = scaled(&flow.gradient, -c / ONE_RATE);
    product(&gradient, &flow.inverse.rows.map(|row| row.map(Word::real)))
}

/// A ← A exp(-c dt (L - (tr L/D) 1)) by lifts of its rows, θ ← θ - c dt tr L/D.
#[derive(Clone, Copy, Debug)]
pub struct Advance {
    /// c.
    pub(super) share: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Advance {
    type Read<T: Copy> = Flow<T, D>;
    type Write<T: Copy> = Shape<T, D>;
    const READ: &'static [usize] = &[GRADIENT, INVERSE];
    const WRITE: &'static [usize] = &[DISTORTION, LOG_VOLUME];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Flow<A::Word, D>,
        write: &mut Shape<A::Word, D>,
    ) -> Result<(), Fault> {
        let mut m = displacement(read, self.share);
        let mean = trace(&m) / D as f64;
        for (i, row) in m.iter_mut().enumerate() {
            row[i] -= mean;
        }
        let mut inside = true;
        for row in &mut write.distortion {
            inside &= lift(row, &m);
        }
        let log_volume = write.log_volume.add_rounded(mean * ONE);
        inside &= log_volume.is_some_and(Quantity::in_range);
        write.log_volume = log_volume.unwrap_or(write.log_volume);
        if inside {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::DistortionRange, id))
        }
    }
}

/// (1 + m/2) (1 - m/2)⁻¹: Cayley's transformation, which is exp(m) up to terms of order m³.
#[inline(always)]
pub(super) fn cayley<const D: usize>(m: &Matrix<D>) -> Matrix<D> {
    let (mut forward, mut backward) = (*m, *m);
    for i in 0..D {
        for j in 0..D {
            let one = if i == j { 1.0 } else { 0.0 };
            let half = 0.5 * m[i][j];
            forward[i][j] = one + half;
            backward[i][j] = one - half;
        }
    }
    product(&forward, &inverse(&backward))
}

/// A ← A (1 - c dt L/2) (1 + c dt L/2)⁻¹, eq. (49), rounded.
#[derive(Clone, Copy, Debug)]
pub struct Midpoint {
    /// c.
    pub(super) share: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Midpoint {
    type Read<T: Copy> = Flow<T, D>;
    type Write<T: Copy> = Shape<T, D>;
    const READ: &'static [usize] = &[GRADIENT, INVERSE];
    const WRITE: &'static [usize] = &[DISTORTION, LOG_VOLUME];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Flow<A::Word, D>,
        write: &mut Shape<A::Word, D>,
    ) -> Result<(), Fault> {
        let factor = cayley(&displacement(read, self.share));
        let advanced = product(&scaled(&write.distortion, 1.0), &factor);
        for (words, values) in write.distortion.iter_mut().zip(&advanced) {
            for (word, value) in words.iter_mut().zip(values) {
                let rounded = A::Word::ZERO.add_rounded(*value);
                let fault = Fault::new(FaultKind::DistortionRange, id);
                *word = rounded.filter(|word| word.in_range()).ok_or(fault)?;
            }
        }
        Ok(())
    }
}

/// What a pass reads as [`Stressed`]: the stress, then the body.
pub(super) const READ_OF_FORCE: &[usize] = &[STRESS, BODY];

const _: () = {
    // A stress and a body are what a force reads.
    assert!(<Stress<f64, 2> as Values<f64>>::COUNT + 1 == <Stressed<f64, 2> as Values<f64>>::COUNT);
};
