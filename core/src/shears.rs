//! The two shears that every model shares.
//!
//! - kick:  v ← v + J, with the impulses J that were prepared
//! - drift: x ← x + R(c dt v)
//!
//! dt is the time step, c the entry of the integrator's table.

use crate::fault::{Fault, FaultKind};
use crate::fields::{IMPULSE, POSITION, VELOCITY};
use crate::number::{Arithmetic, Quantity, Scale};
use crate::points::PointPass;

/// v ← v + J.
#[derive(Clone, Copy, Debug)]
pub struct Kick;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Kick {
    type Read<T: Copy> = [T; D];
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[IMPULSE];
    const WRITE: &'static [usize] = &[VELOCITY];
    #[inline(always)]
    fn at(&self, id: u64, j: &[A::Word; D], v: &mut [A::Word; D]) -> Result<(), Fault> {
        let mut inside = true;
        for d in 0..D {
            v[d] = v[d].plus(j[d]);
            inside &= v[d].in_range();
        }
        if inside {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::VelocityRange, id))
        }
    }
}

/// J ← 0: what the sums of a kick begin with where nothing else pulls.
#[derive(Clone, Copy, Debug)]
pub struct NoImpulse;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NoImpulse {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[IMPULSE];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], impulse: &mut [A::Word; D]) -> Result<(), Fault> {
        *impulse = [A::Word::ZERO; D];
        Ok(())
    }
}

/// x ← x + R(c dt v).
#[derive(Clone, Copy, Debug)]
pub struct Drift {
    /// Length quanta for one speed quantum.
    factor: f64,
}

impl Drift {
    /// A drift of `duration` seconds.
    #[must_use]
    pub fn new(duration: f64, scale: &Scale) -> Self {
        let units = scale.speed_quantum() / scale.length_quantum();
        Self {
            factor: duration * units,
        }
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Drift {
    type Read<T: Copy> = [T; D];
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[VELOCITY];
    const WRITE: &'static [usize] = &[POSITION];
    #[inline(always)]
    fn at(&self, id: u64, v: &[A::Word; D], x: &mut [A::Word; D]) -> Result<(), Fault> {
        let mut inside = true;
        for d in 0..D {
            let moved = x[d].add_rounded(v[d].quanta() * self.factor);
            inside &= moved.is_some_and(Quantity::in_range);
            x[d] = moved.unwrap_or(x[d]);
        }
        if inside {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::PositionRange, id))
        }
    }
}
