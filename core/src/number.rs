//! Number formats: fixed point for the state, doubles for one pair at a time.
//!
//! A coordinate is an integer multiple of a *quantum*, and the position of the binary point is
//! part of its type:
//!
//! | quantity | type | quantum | range kept |
//! |---|---|---|---|
//! | position | [`Length`] = `FixedI64<U46>` | 2^(k-46) m | 2^51 quanta = 2^(k+5) m |
//! | velocity, impulse | [`Speed`] = `FixedI64<U40>` | 2^(j-40) m/s | 2^51 quanta = 2^(j+11) m/s |
//! | density | [`Density`] = `FixedI64<U40>` | 2^(d-40) kg/m³ | one term: 2^51 quanta = 2^(d+11) kg/m³ |
//!
//! The exponents k, j, d belong to the scene and are chosen at run time ([`Scale`]); conversion by
//! a power of two is exact. The range is 2^51 quanta although 64 bits would hold more, because then
//! a *difference* of two positions stays below 2^53 quanta and is exact as an `f64`.
//!
//! # The one rounding rule, and why it is odd
//!
//! Every number that enters the state is computed in floating point and rounded once by
//! [`round`], to the nearest integer, ties to even:
//!
//! R(x) = (x + 3·2^51) - 3·2^51, for |x| < 2^51.
//!
//! In that range x + 3·2^51 lies in (2^52, 2^53), where the spacing of `f64` is one: the addition
//! itself rounds to an integer, ties to even, and the low bits of the sum hold it. R is odd,
//! R(-x) = -R(x): the integers nearest to -x are the negatives of those nearest to x, and a tie
//! goes to the even one of two neighbours, whose negative is even too. All of `+ - * / sqrt` are
//! odd in the same sense, so a pair term that is antisymmetric on paper is antisymmetric in its
//! bits, and a drift with the reversed velocity undoes a drift.
//!
//! The magnitude is tested *before* the conversion, and in a form that a NaN fails; a cast with
//! `as` would have turned it into 0.

use crate::rounding::{FineSum, LIMIT};
use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Sub};
use fixed::FixedI64;
use fixed::types::extra::{LeEqU64, U0, U40, U46, Unsigned};

pub use crate::rounding::{Accumulate, Grain, LIMIT_BITS, PairSum, larger, round};

/// A position or displacement component, in scene units of 2^k m.
pub type Length = FixedI64<U46>;
/// A velocity or impulse-per-mass component, in scene units of 2^j m/s.
pub type Speed = FixedI64<U40>;
/// A density, in scene units of 2^d kg/m³.
pub type Density = FixedI64<U40>;

/// Quanta of a field whose unit is declared elsewhere: the integers themselves.
pub type Whole = FixedI64<U0>;

/// Square root, correctly rounded: the standard library's where there is one, which the compiler
/// writes in place; `libm`'s elsewhere.
#[inline(always)]
#[must_use]
pub fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return libm::sqrt(x);
}

/// x^(1/D) for D = 2 and 3 and x > 0, from `+ * / sqrt` alone, in one written order. The cube root
/// is within 2e-16 of it, relatively, for x from 1/64 to 64.
#[inline(always)]
#[must_use]
pub fn root<const D: usize>(x: f64) -> f64 {
    if D == 2 {
        return sqrt(x);
    }
    // Newton's iteration, from a start that is exact at 1.
    let mut y = (2.0 + x) / 3.0;
    for _ in 0..ROOT_STEPS {
        y = (y + y + x / (y * y)) / 3.0;
    }
    y
}

/// From the starts for 1/64 and 64 these are enough.
const ROOT_STEPS: usize = 10;

/// 1/n! for n up to 12.
const INVERSE_FACTORIALS: [f64; 13] = {
    let (mut table, mut factorial, mut n) = ([1.0; 13], 1.0, 1);
    while n < 13 {
        factorial *= n as f64;
        table[n] = 1.0 / factorial;
        n += 1;
    }
    table
};

/// e^x from `+ *` alone, in one written order and so with the same bits everywhere: Taylor's series
/// of x/16, squared four times. Within 5e-15 of e^x, relatively, for |x| <= 4.
#[inline]
#[must_use]
pub fn exp(x: f64) -> f64 {
    let y = x * 0.0625;
    let [first @ .., last] = INVERSE_FACTORIALS;
    let mut sum = first.iter().rev().fold(last, |sum, c| sum * y + c);
    for _ in 0..4 {
        sum *= sum;
    }
    sum
}

/// Several doubles at once, or one: what a pair term is written in.
///
/// A term is one expression; for `f64` it is the plain reference, for a row of doubles it is what
/// an executor evaluates for a row of neighbours. Every lane goes through the operations of the
/// expression in its order, so it has the bits of the plain one.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// `value` in as many lanes as `self` has.
    fn splat(self, value: f64) -> Self;
    /// Square root, correctly rounded.
    fn root(self) -> Self;
    /// x where x > 0, else 0 (also for a NaN).
    fn positive_part(self) -> Self;
    /// This value where `x` < `limit`, else 0: for terms that do not vanish at their reach by
    /// themselves.
    fn where_below(self, x: Self, limit: Self) -> Self;
}

impl Lanes for f64 {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn root(self) -> Self {
        sqrt(self)
    }
    #[inline(always)]
    fn positive_part(self) -> Self {
        if self > 0.0 { self } else { 0.0 }
    }
    #[inline(always)]
    fn where_below(self, x: Self, limit: Self) -> Self {
        if x < limit { self } else { 0.0 }
    }
}

impl<Q: Quantity> Accumulate for Q {
    #[inline]
    fn accumulate(self, term: f64) -> Option<Self> {
        self.add_rounded(term)
    }
}

impl PairSum<Self> for Whole {
    #[inline]
    fn empty(_: Grain) -> Self {
        Self::ZERO
    }
    #[inline]
    fn added_to(self, word: Self) -> Self {
        word.wrapping_add(self)
    }
    #[inline(always)]
    fn grains_added_to(grains: i64, _: Grain, word: Self) -> Self {
        word.wrapping_add(Self::from_bits(grains))
    }
}

/// One component of the state: a fixed-point number, or the float it is compared with.
pub trait Quantity: Copy + Default + Debug + PartialEq + Send + Sync + bytemuck::Pod {
    /// Zero.
    const ZERO: Self;
    /// The value in quanta; exact within the state's range.
    fn quanta(self) -> f64;
    /// The nearest whole number of quanta, for exact diagnostics.
    fn whole_quanta(self) -> i64;
    /// So many quanta.
    fn from_whole_quanta(quanta: i64) -> Self;
    /// `self - other` in quanta, exact for fixed point within range.
    fn difference(self, other: Self) -> f64;
    /// `self + R(x)` with x in quanta; `None` where |x| >= 2^51 or x is a NaN.
    fn add_rounded(self, x: f64) -> Option<Self>;
    /// `self + other`; wraps at 2^63 quanta, which the range checks of the state keep out of reach.
    fn plus(self, other: Self) -> Self;
    /// `-self`.
    fn negated(self) -> Self;
    /// True within the range of the state, |x| < 2^51 quanta.
    fn in_range(self) -> bool;
    /// Index of the cell of `size` quanta that holds this coordinate: floor(x / size).
    fn cell(self, size: i64) -> i64;
    /// The 64 bits that snapshots store and digests hash; a negative zero counts as zero.
    fn to_word(self) -> i64;
    /// Inverse of [`Quantity::to_word`].
    fn from_word(word: i64) -> Self;
}

impl<Frac: Unsigned + LeEqU64 + Send + Sync + 'static> Quantity for FixedI64<Frac> {
    const ZERO: Self = FixedI64::ZERO;
    #[inline]
    fn quanta(self) -> f64 {
        self.to_bits() as f64
    }
    #[inline]
    fn whole_quanta(self) -> i64 {
        self.to_bits()
    }
    #[inline]
    fn from_whole_quanta(quanta: i64) -> Self {
        Self::from_bits(quanta)
    }
    #[inline]
    fn difference(self, other: Self) -> f64 {
        self.wrapping_sub(other).to_bits() as f64
    }
    #[inline]
    fn add_rounded(self, x: f64) -> Option<Self> {
        round(x).map(|bits| self.wrapping_add(Self::from_bits(bits)))
    }
    #[inline]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
    #[inline]
    fn negated(self) -> Self {
        self.wrapping_neg()
    }
    #[inline]
    fn in_range(self) -> bool {
        // One comparison for both signs: -2^51 < x < 2^51.
        self.to_bits().unsigned_abs() < LIMIT_BITS as u64
    }
    #[inline]
    fn cell(self, size: i64) -> i64 {
        self.to_bits().div_euclid(size)
    }
    #[inline]
    fn to_word(self) -> i64 {
        self.to_bits()
    }
    #[inline]
    fn from_word(word: i64) -> Self {
        Self::from_bits(word)
    }
}

/// The floating-point counterpart, in quanta: what the paper calls FloPA.
impl Quantity for f64 {
    const ZERO: Self = 0.0;
    #[inline]
    fn quanta(self) -> f64 {
        self
    }
    #[inline]
    fn whole_quanta(self) -> i64 {
        libm::rint(self) as i64
    }
    #[inline]
    fn from_whole_quanta(quanta: i64) -> Self {
        quanta as f64
    }
    #[inline]
    fn difference(self, other: Self) -> f64 {
        self - other
    }
    #[inline]
    fn add_rounded(self, x: f64) -> Option<Self> {
        (x.abs() < LIMIT).then_some(self + x)
    }
    #[inline]
    fn plus(self, other: Self) -> Self {
        self + other
    }
    #[inline]
    fn negated(self) -> Self {
        -self
    }
    #[inline]
    fn in_range(self) -> bool {
        self.abs() < LIMIT
    }
    #[inline]
    fn cell(self, size: i64) -> i64 {
        libm::floor(self / size as f64) as i64
    }
    #[inline]
    fn to_word(self) -> i64 {
        (self + 0.0).to_bits() as i64
    }
    #[inline]
    fn from_word(word: i64) -> Self {
        f64::from_bits(word as u64)
    }
}

/// A number of any kind in 64 bits: what the memory of a system is made of, before the binary
/// point of its field is known.
pub trait Word: Quantity {
    /// A word that holds this double.
    fn of_real(x: f64) -> Self;
    /// The double that it holds.
    fn real(self) -> f64;
}

impl Word for Whole {
    #[inline]
    fn of_real(x: f64) -> Self {
        Self::from_bits(x.to_bits() as i64)
    }
    #[inline]
    fn real(self) -> f64 {
        f64::from_bits(self.to_bits() as u64)
    }
}

impl Word for f64 {
    #[inline]
    fn of_real(x: f64) -> Self {
        x
    }
    #[inline]
    fn real(self) -> f64 {
        self
    }
}

/// Which numbers the state is made of.
pub trait Arithmetic: Copy + Debug + Send + Sync + 'static {
    /// Type of a position component.
    type Length: Quantity;
    /// Type of a velocity or impulse component.
    type Speed: Quantity;
    /// Type of a density.
    type Density: Quantity;
    /// Quanta of any field: all fields are stored as these.
    type Word: Word;
    /// What sums over pairs are made in, which no order changes; see [`mod@crate::rounding`].
    type Sum: PairSum<Self::Word>;
    /// True where what is added to the state is whole quanta, and so a step can be undone exactly.
    const EXACT: bool;
}

/// Fixed-point state: exact sums, exact reversal.
#[derive(Clone, Copy, Debug)]
pub struct Fixed;

impl Arithmetic for Fixed {
    type Length = Length;
    type Speed = Speed;
    type Density = Density;
    type Word = Whole;
    type Sum = Whole;
    const EXACT: bool = true;
}

/// Floating-point state with the same pair terms: the control experiment that does not return,
/// because what is added to a double is rounded to what the double has room for.
#[derive(Clone, Copy, Debug)]
pub struct Float;

impl Arithmetic for Float {
    type Length = f64;
    type Speed = f64;
    type Density = f64;
    type Word = f64;
    type Sum = FineSum;
    const EXACT: bool = false;
}

/// The scene's units as powers of two: lengths of 2^k m, speeds of 2^j m/s, densities of 2^d kg/m³.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// k: positions are kept for |x| < 2^(k+5) m.
    pub length_exponent: i32,
    /// j: velocities and impulses are kept for |v| < 2^(j+11) m/s.
    pub speed_exponent: i32,
    /// d: one term of a density sum is kept below 2^(d+11) kg/m³.
    pub density_exponent: i32,
}

/// 2^e, exactly.
#[must_use]
pub fn power_of_two(e: i32) -> f64 {
    libm::ldexp(1.0, e)
}

/// Smallest e with 2^e >= x, for finite x > 0.
fn exponent_at_least(x: f64) -> i32 {
    let (fraction, e) = libm::frexp(x);
    if fraction == 0.5 { e - 1 } else { e }
}

impl Scale {
    /// Units that leave headroom: positions up to 6 times `extent` (largest |coordinate|, m),
    /// speeds and impulses up to 16 times `speed` (of sound, m/s), density terms up to
    /// 2 times `density` (kg/m³). All three must be positive and finite.
    ///
    /// A dam break in a box of 4 m, with 120 m/s and 1000 kg/m³, gets k = j = d = 0.
    #[must_use]
    pub fn with_headroom(extent: f64, speed: f64, density: f64) -> Self {
        Self {
            length_exponent: exponent_at_least(6.0 * extent) - 5,
            speed_exponent: exponent_at_least(16.0 * speed) - 11,
            density_exponent: exponent_at_least(2.0 * density) - 11,
        }
    }
    /// Positions are kept for |x| below this, m.
    #[must_use]
    pub fn largest_length(&self) -> f64 {
        power_of_two(self.length_exponent + 5)
    }
    /// Metres per quantum of [`Length`].
    #[must_use]
    pub fn length_quantum(&self) -> f64 {
        power_of_two(self.length_exponent - 46)
    }
    /// Metres per second per quantum of [`Speed`].
    #[must_use]
    pub fn speed_quantum(&self) -> f64 {
        power_of_two(self.speed_exponent - 40)
    }
    /// kg/m³ per quantum of [`Density`].
    #[must_use]
    pub fn density_quantum(&self) -> f64 {
        power_of_two(self.density_exponent - 40)
    }
}
