//! Four numbers at once.
//!
//! Four doubles fill a register of AVX2. AVX-512 has registers of eight, but rows of eight
//! particles hold more that are out of reach than the wider arithmetic makes up for (measured at 28
//! neighbours: 36 lanes a particle instead of 28, and the square root takes the same time a lane);
//! what it adds here is the conversion to integers in one instruction, which whole quanta need no
//! more than, and twice the registers. The
//! baseline is plain arrays, which the compiler turns into pairs of SSE2.

use loschmidt_core::number::{Grain, Lanes};
use std::ops::{Add, Div, Mul, Sub};

/// Particles in a row.
pub(super) const ROW: usize = 4;

/// Four doubles in memory.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(32))]
pub(super) struct Reals(pub [f64; ROW]);

/// Four integers in memory.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(32))]
pub(super) struct Words(pub [i64; ROW]);

/// The operations of an instruction set on four numbers.
pub(super) trait Quad: Copy + Send + Sync {
    /// Four doubles.
    type R: Copy;
    /// Four integers.
    type I: Copy;
    fn load(self, row: Reals) -> Self::R;
    fn store(self, row: Self::R) -> Reals;
    fn load_words(self, row: Words) -> Self::I;
    fn store_words(self, row: Self::I) -> Words;
    fn splat(self, value: f64) -> Self::R;
    fn add(self, a: Self::R, b: Self::R) -> Self::R;
    fn sub(self, a: Self::R, b: Self::R) -> Self::R;
    fn mul(self, a: Self::R, b: Self::R) -> Self::R;
    fn div(self, a: Self::R, b: Self::R) -> Self::R;
    /// Square root. It is correctly rounded, as libm's is, and so the same.
    fn sqrt(self, a: Self::R) -> Self::R;
    /// x where x > 0, else 0 (also for a NaN).
    fn positive_part(self, a: Self::R) -> Self::R;
    /// Lanes of a where that of x is below that of the limit, else 0.
    fn where_below(self, a: Self::R, x: Self::R, limit: Self::R) -> Self::R;
    /// Whether [`Quad::convert`] is an instruction of its own.
    const CONVERTS: bool;
    /// The nearest integers, ties to even, for magnitudes below 2^51.
    #[inline(always)]
    fn convert(self, a: Self::R) -> Self::I {
        self.round(a, self.splat(Grain::QUANTUM.rounder()))
    }
    /// The nearest numbers of grains, ties to even, for magnitudes below 2^51 of them; `rounder` is
    /// that of the [`Grain`].
    fn round(self, a: Self::R, rounder: Self::R) -> Self::I;
    fn plus(self, a: Self::I, b: Self::I) -> Self::I;
    fn minus(self, a: Self::I, b: Self::I) -> Self::I;
    /// True where some lane of a is below its lane of b.
    fn any_below(self, a: Self::R, b: Self::R) -> bool;
}

/// No instruction set in particular.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plain;

macro_rules! lanewise {
    ($a:expr, $b:expr, $f:expr) => {{
        let (a, b) = ($a, $b);
        [
            $f(a[0], b[0]),
            $f(a[1], b[1]),
            $f(a[2], b[2]),
            $f(a[3], b[3]),
        ]
    }};
}

impl Quad for Plain {
    type R = [f64; ROW];
    type I = [i64; ROW];
    const CONVERTS: bool = false;
    #[inline(always)]
    fn load(self, row: Reals) -> Self::R {
        row.0
    }
    #[inline(always)]
    fn store(self, row: Self::R) -> Reals {
        Reals(row)
    }
    #[inline(always)]
    fn load_words(self, row: Words) -> Self::I {
        row.0
    }
    #[inline(always)]
    fn store_words(self, row: Self::I) -> Words {
        Words(row)
    }
    #[inline(always)]
    fn splat(self, value: f64) -> Self::R {
        [value; ROW]
    }
    #[inline(always)]
    fn add(self, a: Self::R, b: Self::R) -> Self::R {
        lanewise!(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, a: Self::R, b: Self::R) -> Self::R {
        lanewise!(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, a: Self::R, b: Self::R) -> Self::R {
        lanewise!(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, a: Self::R, b: Self::R) -> Self::R {
        lanewise!(a, b, |a, b| a / b)
    }
    #[inline(always)]
    fn sqrt(self, a: Self::R) -> Self::R {
        lanewise!(a, a, |a: f64, _| a.sqrt())
    }
    #[inline(always)]
    fn positive_part(self, a: Self::R) -> Self::R {
        lanewise!(a, a, |a, _| if a > 0.0 { a } else { 0.0 })
    }
    #[inline(always)]
    fn where_below(self, a: Self::R, x: Self::R, limit: Self::R) -> Self::R {
        let keep = lanewise!(x, limit, |x, limit| x < limit);
        lanewise!(a, keep, |a, keep| if keep { a } else { 0.0 })
    }
    #[inline(always)]
    fn round(self, a: Self::R, rounder: Self::R) -> Self::I {
        lanewise!(a, rounder, |a: f64, rounder: f64| {
            ((a + rounder).to_bits() as i64).wrapping_sub(rounder.to_bits() as i64)
        })
    }
    #[inline(always)]
    fn plus(self, a: Self::I, b: Self::I) -> Self::I {
        lanewise!(a, b, i64::wrapping_add)
    }
    #[inline(always)]
    fn minus(self, a: Self::I, b: Self::I) -> Self::I {
        lanewise!(a, b, i64::wrapping_sub)
    }
    #[inline(always)]
    fn any_below(self, a: Self::R, b: Self::R) -> bool {
        (a[0] < b[0]) | (a[1] < b[1]) | (a[2] < b[2]) | (a[3] < b[3])
    }
}

/// The operations of AVX2, which AVX-512 includes, and what else there is.
#[cfg(target_arch = "x86_64")]
macro_rules! quad_of_avx {
    ($token:ty, $converts:literal $(, $conversion:item)?) => {
        impl Quad for $token {
            type R = pulp::f64x4;
            type I = pulp::i64x4;
            const CONVERTS: bool = $converts;
            $(#[inline(always)]
            $conversion)?
            #[inline(always)]
            fn load(self, row: Reals) -> Self::R {
                pulp::cast(row.0)
            }
            #[inline(always)]
            fn store(self, row: Self::R) -> Reals {
                Reals(pulp::cast(row))
            }
            #[inline(always)]
            fn load_words(self, row: Words) -> Self::I {
                pulp::cast(row.0)
            }
            #[inline(always)]
            fn store_words(self, row: Self::I) -> Words {
                Words(pulp::cast(row))
            }
            #[inline(always)]
            fn splat(self, value: f64) -> Self::R {
                self.splat_f64x4(value)
            }
            #[inline(always)]
            fn add(self, a: Self::R, b: Self::R) -> Self::R {
                self.add_f64x4(a, b)
            }
            #[inline(always)]
            fn sub(self, a: Self::R, b: Self::R) -> Self::R {
                self.sub_f64x4(a, b)
            }
            #[inline(always)]
            fn mul(self, a: Self::R, b: Self::R) -> Self::R {
                self.mul_f64x4(a, b)
            }
            #[inline(always)]
            fn div(self, a: Self::R, b: Self::R) -> Self::R {
                self.div_f64x4(a, b)
            }
            #[inline(always)]
            fn sqrt(self, a: Self::R) -> Self::R {
                self.sqrt_f64x4(a)
            }
            #[inline(always)]
            fn positive_part(self, a: Self::R) -> Self::R {
                // maxpd returns its second operand where one of them is a NaN.
                self.max_f64x4(a, self.splat_f64x4(0.0))
            }
            #[inline(always)]
            fn where_below(self, a: Self::R, x: Self::R, limit: Self::R) -> Self::R {
                const LESS: i32 = std::arch::x86_64::_CMP_LT_OQ;
                let keep = self
                    .avx
                    ._mm256_cmp_pd::<LESS>(pulp::cast(x), pulp::cast(limit));
                pulp::cast(self.avx._mm256_and_pd(pulp::cast(a), keep))
            }
            #[inline(always)]
            fn round(self, a: Self::R, rounder: Self::R) -> Self::I {
                let sum = self.add_f64x4(a, rounder);
                self.wrapping_sub_i64x4(pulp::cast(sum), pulp::cast(rounder))
            }
            #[inline(always)]
            fn plus(self, a: Self::I, b: Self::I) -> Self::I {
                self.wrapping_add_i64x4(a, b)
            }
            #[inline(always)]
            fn minus(self, a: Self::I, b: Self::I) -> Self::I {
                self.wrapping_sub_i64x4(a, b)
            }
            #[inline(always)]
            fn any_below(self, a: Self::R, b: Self::R) -> bool {
                // Ordered, quiet less-than; one bit a lane.
                const LESS: i32 = std::arch::x86_64::_CMP_LT_OQ;
                let below = self.avx._mm256_cmp_pd::<LESS>(pulp::cast(a), pulp::cast(b));
                self.avx._mm256_movemask_pd(below) != 0
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
quad_of_avx!(pulp::x86::V3, false);

// Rounds as the processor is set to: to nearest, ties to even, as every Rust program runs.
#[cfg(target_arch = "x86_64")]
quad_of_avx!(
    pulp::x86::V4,
    true,
    fn convert(self, a: Self::R) -> Self::I {
        pulp::cast(self.avx512dq._mm256_cvtpd_epi64(pulp::cast(a)))
    }
);

/// Four doubles with the instructions that work on them: what a pair term is evaluated in.
#[derive(Clone, Copy)]
pub(super) struct Pack<Q: Quad> {
    pub simd: Q,
    pub row: Q::R,
}

impl<Q: Quad> Pack<Q> {
    #[inline(always)]
    pub fn new(simd: Q, row: Q::R) -> Self {
        Self { simd, row }
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<Q: Quad> $trait for Pack<Q> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self::new(self.simd, self.simd.$method(self.row, other.row))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<Q: Quad> Lanes for Pack<Q> {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self::new(self.simd, self.simd.splat(value))
    }
    #[inline(always)]
    fn root(self) -> Self {
        Self::new(self.simd, self.simd.sqrt(self.row))
    }
    #[inline(always)]
    fn positive_part(self) -> Self {
        Self::new(self.simd, self.simd.positive_part(self.row))
    }
    #[inline(always)]
    fn where_below(self, x: Self, limit: Self) -> Self {
        Self::new(self.simd, self.simd.where_below(self.row, x.row, limit.row))
    }
}
