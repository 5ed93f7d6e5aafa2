//! Sums of floating-point numbers that do not depend on their order.
//!
//! Each term is cut to a multiple of 2^-60 and added as a 128-bit integer. The result has the same
//! bits for any order and any partition of the terms, so energies on the way back equal those on
//! the way out to the last bit, on any number of threads.

use crate::number::{Accumulate, power_of_two};

const FRACTION_BITS: i32 = 60;

/// An order-free sum; terms should be of the order of 1 (range ±2^67, resolution 2^-60).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExactSum(i128);

impl Accumulate for ExactSum {
    #[inline]
    fn accumulate(self, term: f64) -> Option<Self> {
        Some(self.plus(term))
    }
}

impl ExactSum {
    /// The sum with one more term. A term beyond the range saturates; a NaN counts as zero.
    #[inline]
    #[must_use]
    pub fn plus(self, x: f64) -> Self {
        // 2^60 is a constant here: the multiplication is exact.
        const SCALE: f64 = (1u64 << FRACTION_BITS) as f64;
        Self(self.0.saturating_add((x * SCALE) as i128))
    }
    /// The sum of both.
    #[must_use]
    pub fn merged(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
    /// The nearest double.
    #[must_use]
    pub fn value(self) -> f64 {
        self.0 as f64 * power_of_two(-FRACTION_BITS)
    }
}
