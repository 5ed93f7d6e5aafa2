//! The distortion forgets: dA/dt = -(3/τ) A dev(AᵀA), and what it loses is heat.
//!
//! A small strain e decays as exp(-6 t/τ), and the stress is 2 ρ0 c_s² e. With x = 6 dt/τ, let a
//! relaxation multiply e by q. In steady shear the strain after it is e = q (e + γ dt): the force
//! that is taken of it is that of the viscosity
//!
//! ν_eff/ν = x q/(1 - q),  ν = c_s² τ/6                                                   (65)
//!
//! - [`Relaxation::Exact`]: A ← A (1 - κ dev(AᵀA)), κ = x/(2 (1 + x)). Then q = 1/(1 + x) but for
//!   terms of order e², and ν_eff = ν for every time step. In space, where such terms do not vanish
//!   in every flow, the bracket is the series of (AᵀA)^(-κ) up to the third power.
//! - [`Relaxation::Paper`]: Runge and Kutta's fourth order with the nodes (0, ½, ½, 1), (52d). Then
//!   q is nearly exp(-x), and ν_eff = 0.73 ν at dt = 0.1 τ, the paper's own.
//!
//! The heat is what the forces have put in and the distortion has not kept. Over a step that leads
//! from A to A', with the gradients L and L' at its two ends,
//!
//! q = ε(A) - ε(A') - (dt/2) (S(A) : L + S(A') : L'),  S = Aᵀ ∂ε/∂A,
//!
//! for -m S : L is the power of the forces that kicks take of A: in steady shear this is the fall of
//! the energy over a relaxation, 2 q/(1 + q) of it, and it is the balance too where the flow is
//! not steady. A half lift adds the first half of the terms, the half lift with the relaxation the
//! second.
//!
//! In the plane the third diagonal entry of A stays 1, and relaxation pulls det A to 1. In space
//! nothing would restore it: A is divided by the cube root of its determinant.
//!
//! Source: Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, section 3.7. The
//! splitting (52) is a plain composition, whence the two sentences on viscosity and heat.

use super::super::fields::{BODY, DISTORTION, EXCHANGED, GRADIENT, INVERSE, ONE, ONE_ENERGY};
use super::super::material::{Material, deviator};
use super::super::parameters::{MAX_BODIES, material_of};
use super::super::updates::{Flow, cayley, displacement};
use super::parameters::{FluidParameters, Relaxation};
use crate::fault::{Fault, FaultKind};
use crate::matrix::{Matrix, determinant_of, identity, metric, product};
use crate::number::{Arithmetic, Quantity};
use crate::points::PointPass;
use crate::values;
use heapless::Vec;

/// Half a lift, with a relaxation behind it or without.
#[derive(Clone, Debug)]
pub struct HalfStep {
    materials: Vec<Material, MAX_BODIES>,
    /// Quanta of exchanged energy for each J/kg.
    unit: f64,
    law: Law,
    relaxes: bool,
}

/// What becomes of a distortion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// A (1 - κ dev(AᵀA)).
    Exact {
        /// κ.
        share: f64,
    },
    /// (52d).
    Paper {
        /// 3 dt/τ.
        step: f64,
    },
}

impl Law {
    /// That of these parameters.
    #[must_use]
    pub fn of<const D: usize>(parameters: &FluidParameters<D>) -> Self {
        let x = parameters.steps_in_relaxation();
        match parameters.relaxation {
            Relaxation::Exact => Self::Exact {
                share: x / (2.0 * (1.0 + x)),
            },
            Relaxation::Paper => Self::Paper { step: 0.5 * x },
        }
    }

    /// A after it.
    #[inline(always)]
    #[must_use]
    pub fn relaxed<const D: usize>(self, a: &Matrix<D>) -> Matrix<D> {
        let mut relaxed = match self {
            Self::Exact { share } if D == 2 => plus(a, &slope(a, share), 1.0),
            Self::Exact { share } => product(a, &power(a, share)),
            Self::Paper { step } => {
                let k1 = slope(a, step);
                let k2 = slope(&plus(a, &k1, 0.5), step);
                let k3 = slope(&plus(a, &k2, 0.5), step);
                let k4 = slope(&plus(a, &k3, 1.0), step);
                let middle = plus(&k2, &k3, 1.0);
                plus(a, &plus(&plus(&k1, &k4, 1.0), &middle, 2.0), 1.0 / 6.0)
            }
        };
        if D == 3 {
            let factor = 1.0 / libm::cbrt(determinant_of(&relaxed));
            for x in relaxed.as_flattened_mut() {
                *x *= factor;
            }
        }
        relaxed
    }
}

/// (AᵀA)^(-κ) by its series in E = AᵀA - 1, up to the third power.
#[inline(always)]
fn power<const D: usize>(a: &Matrix<D>, share: f64) -> Matrix<D> {
    let mut e = metric(a);
    for (i, row) in e.iter_mut().enumerate() {
        row[i] -= 1.0;
    }
    // 1 - κ E (1 - (κ + 1)/2 E (1 - (κ + 2)/3 E)).
    let mut sum = identity::<D>();
    for n in [3.0, 2.0, 1.0] {
        let factor = -(share + (n - 1.0)) / n;
        sum = plus(&identity::<D>(), &product(&e, &sum), factor);
    }
    sum
}

/// -c A dev(AᵀA).
#[inline(always)]
fn slope<const D: usize>(a: &Matrix<D>, c: f64) -> Matrix<D> {
    let (dev, _) = deviator(&metric(a));
    let mut slope = product(a, &dev);
    for x in slope.as_flattened_mut() {
        *x *= -c;
    }
    slope
}

/// a + c b.
#[inline(always)]
fn plus<const D: usize>(a: &Matrix<D>, b: &Matrix<D>, c: f64) -> Matrix<D> {
    let mut sum = *a;
    for (x, y) in sum.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *x += c * *y;
    }
    sum
}

impl HalfStep {
    /// That of these parameters, with energies in this unit, J/kg.
    pub(super) fn new<const D: usize>(
        parameters: &FluidParameters<D>,
        unit: f64,
        relaxes: bool,
    ) -> Self {
        Self {
            materials: parameters.bodies.materials.clone(),
            unit: ONE_ENERGY / unit,
            law: Law::of(parameters),
            relaxes,
        }
    }
}

values! {
    /// What half a step reads.
    pub struct Moved {
        flow: Flow<T, D>,
        body: T,
    }

    /// What half a step changes.
    pub struct Relaxed {
        distortion: [[T; D]; D],
        /// Heat, then work.
        exchanged: [T; 2],
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for HalfStep {
    type Read<T: Copy> = Moved<T, D>;
    type Write<T: Copy> = Relaxed<T, D>;
    const READ: &'static [usize] = &[GRADIENT, INVERSE, BODY];
    const WRITE: &'static [usize] = &[DISTORTION, EXCHANGED];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Moved<A::Word, D>,
        write: &mut Relaxed<A::Word, D>,
    ) -> Result<(), Fault> {
        let material = material_of(&self.materials, read.body.whole_quanta());
        let before = write.distortion.map(|row| row.map(|x| x.quanta() / ONE));
        // -(dt/2) L.
        let m = displacement(&read.flow, 0.5);
        let lifted = product(&before, &cayley(&m));
        // The forces of the kick at this end are taken of A, or of what it relaxes to.
        let (after, stressed) = if self.relaxes {
            let relaxed = self.law.relaxed(&lifted);
            (relaxed, relaxed)
        } else {
            (lifted, before)
        };
        let mut work = 0.0;
        let stress = material.shear_stress(&metric(&stressed));
        for (s, m) in stress.as_flattened().iter().zip(m.as_flattened()) {
            work += *s * *m;
        }
        let energy = |a: &Matrix<D>| material.shear_energy(&metric(a), 0.0);
        let heat = work + (energy(&before) - energy(&after));
        let fault = Fault::new(FaultKind::DistortionRange, id);
        let entries = after.as_flattened().iter();
        for (word, x) in write.distortion.as_flattened_mut().iter_mut().zip(entries) {
            let rounded = A::Word::ZERO.add_rounded(x * ONE);
            *word = rounded.filter(|word| word.in_range()).ok_or(fault)?;
        }
        let sum = write.exchanged[0].add_rounded(self.unit * heat);
        write.exchanged[0] = sum.filter(|sum| sum.in_range()).ok_or(fault)?;
        Ok(())
    }
}
