//! Rows of numbers: plain arrays that the compiler turns into vector instructions.

use loschmidt_core::number::{Lanes, Real};
use std::ops::{Add, Div, Mul, Sub};

/// L reals, one for each neighbour in a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<R, const L: usize>(pub [R; L]);

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<R: Real, const L: usize> $trait for Row<R, L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(std::array::from_fn(|l| self.0[l] $operator other.0[l]))
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<R: Real, const L: usize> Lanes<R> for Row<R, L> {
    #[inline(always)]
    fn splat(value: R) -> Self {
        Self([value; L])
    }
    /// The hardware's square root. It is correctly rounded, as libm's is, and so the same; a
    /// narrower real than a double is rounded twice here, which for a square root changes nothing.
    #[inline(always)]
    fn root(self) -> Self {
        Self(self.0.map(|x| R::from_f64(x.to_f64().sqrt())))
    }
    #[inline(always)]
    fn positive_part(self) -> Self {
        let zero = R::from_f64(0.0);
        Self(self.0.map(|x| if x > zero { x } else { zero }))
    }
}
