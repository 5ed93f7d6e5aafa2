//! Gravity: the impulse with which every kick begins.
//!
//! J = R(c dt g) + R(-c dt GM x/(|x|² + s²)^(3/2)), x measured from the centre of the mass.

use super::parameters::{Central, Parameters};
use crate::fault::{Fault, FaultKind};
use crate::fields::{IMPULSE, POSITION};
use crate::number::{Arithmetic, Quantity, sqrt};
use crate::points::PointPass;

/// The impulse of uniform gravity and of a fixed mass.
#[derive(Clone, Copy, Debug)]
pub struct Pull<A: Arithmetic, const D: usize> {
    /// Of uniform gravity; `None` out of range.
    uniform: Option<[A::Word; D]>,
    /// The attracting mass.
    central: Option<Attraction<A, D>>,
}

/// Attraction by a fixed mass, in quanta.
#[derive(Clone, Copy, Debug)]
struct Attraction<A: Arithmetic, const D: usize> {
    centre: [A::Word; D],
    /// s².
    softening_squared: f64,
    /// c dt GM.
    strength: f64,
}

impl<A: Arithmetic, const D: usize> Pull<A, D> {
    /// Over `duration` seconds, towards `centre` (length quanta).
    pub(super) fn new(p: &Parameters<D>, centre: &[A::Word; D], duration: f64) -> Self {
        let (length, speed) = (p.scale.length_quantum(), p.scale.speed_quantum());
        let mut uniform = Some([A::Word::ZERO; D]);
        for (d, g) in p.gravity.uniform.iter().enumerate() {
            uniform = uniform.and_then(|mut impulse| {
                impulse[d] = impulse[d].add_rounded(duration * g / speed)?;
                Some(impulse)
            });
        }
        let attraction = |central: &Central<D>| {
            let soft = central.softening / length;
            let units = length * length * speed;
            Attraction {
                centre: *centre,
                softening_squared: soft * soft,
                strength: duration * central.strength / units,
            }
        };
        Self {
            uniform,
            central: p.gravity.central.as_ref().map(attraction),
        }
    }

    /// The impulse of a particle at x; `None` out of range.
    #[inline]
    pub fn at(&self, x: &[A::Word; D]) -> Option<[A::Word; D]> {
        match &self.central {
            None => self.uniform,
            Some(central) => central.added_to(self.uniform?, x),
        }
    }
}

impl<A: Arithmetic, const D: usize> Attraction<A, D> {
    fn added_to(&self, mut impulse: [A::Word; D], x: &[A::Word; D]) -> Option<[A::Word; D]> {
        let x_ic: [f64; D] = core::array::from_fn(|d| x[d].difference(self.centre[d]));
        let mut r2 = x_ic[0] * x_ic[0];
        for x in &x_ic[1..] {
            r2 += *x * *x;
        }
        r2 += self.softening_squared;
        let factor = self.strength / (r2 * sqrt(r2));
        for (i, x) in impulse.iter_mut().zip(x_ic) {
            *i = i.add_rounded(-(factor * x))?;
        }
        Some(impulse)
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Pull<A, D> {
    type Read<T: Copy> = [T; D];
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[POSITION];
    const WRITE: &'static [usize] = &[IMPULSE];
    #[inline(always)]
    fn at(&self, id: u64, x: &[A::Word; D], impulse: &mut [A::Word; D]) -> Result<(), Fault> {
        *impulse = Self::at(self, x).ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}
