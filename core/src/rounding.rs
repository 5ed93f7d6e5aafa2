//! The one rounding rule, and sums that have no order because of it.
//!
//! R(x) = (x + 3·2^51) - 3·2^51, for |x| < 2^51; why it is what it is says [`mod@crate::number`].
//!
//! A sum over pairs is one of integers in either arithmetic. In fixed point the terms t_j, in quanta
//! of the sum, are rounded to whole ones. Doubles that are added one after another are rounded
//! after every addition, and what comes out depends on who comes first. So a floating-point sum
//! takes its terms in *grains* of 2^-k quanta,
//!
//! S = 2^-k Σ_j R(2^k t_j),
//!
//! and is rounded once more, when it is added to the double it belongs to (Demmel & Nguyen, *Fast
//! reproducible floating-point summation*, ARITH 2013). k follows from the largest magnitude that
//! this number of a term can have ([bounds](crate::pairs::PairPass::bounds)), which has no order
//! either. The largest has up to 51 bits, of the 53 of a double, and a grain is never larger than a
//! quantum, so that no floating-point sum is less exact than the fixed-point one. The terms with
//! walls, and of passes without a bound, are few; they are taken in grains of 2^-60 quanta, in
//! integers of 128 bits.

use core::fmt::Debug;

/// Bound, in quanta, of what rounding accepts and of what the state may hold: magnitudes below
/// 2^51. (The last accepted ones, from 2^51 - 1/2 on, round to 2^51 itself.)
pub const LIMIT_BITS: i64 = 1 << 51;
pub(crate) const LIMIT: f64 = LIMIT_BITS as f64;
/// 3·2^51: adding it rounds any |x| < 2^51 to an integer.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// R(x), the only way into the state; `None` for |x| >= 2^51 and for a NaN.
#[inline]
#[must_use]
pub fn round(x: f64) -> Option<i64> {
    // Written so that a NaN fails it.
    if x.abs() < LIMIT {
        let shifted = (x + ROUNDER).to_bits();
        Some(shifted.wrapping_sub(ROUNDER.to_bits()) as i64)
    } else {
        None
    }
}

/// The larger magnitude, and a NaN before all: as integers the bits of magnitudes are in order.
#[inline(always)]
#[must_use]
pub fn larger(largest: f64, number: f64) -> f64 {
    f64::from_bits(largest.to_bits().max(number.abs().to_bits()))
}

/// To what the terms of a sum are rounded: whole quanta, or 2^-k of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// 2^k.
    per_quantum: f64,
    /// 2^-k.
    quanta: f64,
}

impl Grain {
    /// A whole quantum.
    pub const QUANTUM: Self = Self {
        per_quantum: 1.0,
        quanta: 1.0,
    };
    /// The largest k.
    const FINEST: i32 = 60;

    /// 2^-k quanta.
    fn fine(k: i32) -> Self {
        Self {
            per_quantum: libm::ldexp(1.0, k),
            quanta: libm::ldexp(1.0, -k),
        }
    }

    /// The grain of floating-point sums of terms that do not exceed `bound`, in quanta. Below 2^51
    /// of them all terms are below 2^51 grains.
    #[must_use]
    pub fn under(bound: f64) -> Self {
        // Written so that a NaN fails it.
        if bound < LIMIT {
            let (_, e) = libm::frexp(bound);
            Self::fine((51 - e).clamp(0, Self::FINEST))
        } else {
            Self::fine(Self::FINEST)
        }
    }

    /// 3·2^51 grains: adding it rounds any smaller number of quanta than 2^51 grains to whole
    /// grains, and what the bits of the sum are more than its own is their number.
    #[inline]
    #[must_use]
    pub fn rounder(self) -> f64 {
        ROUNDER * self.quanta
    }
}

/// What integers or other exact numbers a sum is made of.
pub trait Accumulate: Copy + Send + Sync {
    /// The sum with one more term, rounded once; `None` where the term is out of range.
    fn accumulate(self, term: f64) -> Option<Self>;
}

/// A sum over pairs in the making, of a word of the state.
pub trait PairSum<W>: Accumulate {
    /// No terms yet; they will be rounded to this grain.
    fn empty(grain: Grain) -> Self;
    /// The word with all of it added.
    fn added_to(self, word: W) -> W;
    /// The word with grains that were counted elsewhere added: what [`PairSum::added_to`] gives of
    /// the same terms.
    fn grains_added_to(grains: i64, grain: Grain, word: W) -> W;
}

/// A sum over pairs of a floating-point state.
#[derive(Clone, Copy, Debug)]
pub struct FineSum {
    grains: i128,
    grain: Grain,
}

impl Accumulate for FineSum {
    #[inline]
    fn accumulate(self, term: f64) -> Option<Self> {
        // The range is that of fixed point; written so that a NaN fails it.
        if term.abs() < LIMIT {
            let fine = term * self.grain.per_quantum;
            let grains = match round(fine) {
                Some(grains) => i128::from(grains),
                None => libm::rint(fine) as i128,
            };
            Some(Self {
                grains: self.grains.wrapping_add(grains),
                ..self
            })
        } else {
            None
        }
    }
}

impl PairSum<f64> for FineSum {
    #[inline]
    fn empty(grain: Grain) -> Self {
        Self { grains: 0, grain }
    }
    #[inline]
    fn added_to(self, word: f64) -> f64 {
        word + self.grains as f64 * self.grain.quanta
    }
    #[inline(always)]
    fn grains_added_to(grains: i64, grain: Grain, word: f64) -> f64 {
        word + grains as f64 * grain.quanta
    }
}
