//! Wendland's C2 kernel.
//!
//! With q = r/h, h the support radius, and t = max(0, 1 - q):
//!
//! - W(r) = α t⁴ (1 + 4q)                  \[1/m^D\]
//! - W'(r)/r = -(20 α/h²) t³               \[1/m^(D+2)\]
//! - h dW/dh = -D W - r W' = α t³ (20 q² - D (1 + 3q - 4q²))   \[1/m^D\]
//! - (h/r) d²W/dr dh = (20 α/h²) t² ((D + 2) - (D + 5) q)      \[1/m^(D+2)\]
//! - α = 7/(π h²) in 2D, 21/(2 π h³) in 3D
//!
//! Source: H. Wendland, Adv. Comput. Math. 4 (1995) 389. W'/r has no singularity at r = 0, so two
//! particles on one point exert no force on each other. Both vanish at q = 1 faster than any
//! rounding can see: whether a pair at the very edge is visited or not changes no bit.
//!
//! The last two say how a sum of W changes with the width of the kernel: Kincl, Peshkov, Pavelka &
//! Klika, Appl. Math. Comput. 439 (2023) 127579, eqs. (43) to (46), whose h is half of this one;
//! (44) is printed twice too large.
//!
//! Only `+ - * /` occur, in one written order; no power, no exponential.

use crate::number::{Lanes, sqrt};
use core::f64::consts::PI;

/// The kernel for a support radius, with the unit of r chosen by the caller.
#[derive(Clone, Copy, Debug)]
pub struct WendlandC2 {
    /// 1/h, in 1/(unit of r).
    inverse_support: f64,
    /// α, 1/m^D.
    value_factor: f64,
    /// -20 α/h², 1/m^(D+2).
    derivative_factor: f64,
    /// D.
    dimension: f64,
}

impl WendlandC2 {
    /// Kernel in `dimension` 2 or 3 with `support_radius` in m; distances will be given in units of
    /// `unit` metres (a length quantum inside a step, 1 for a physicist).
    #[must_use]
    pub fn new(dimension: usize, support_radius: f64, unit: f64) -> Self {
        let h = support_radius;
        let alpha = match dimension {
            2 => 7.0 / (PI * h * h),
            _ => 21.0 / (2.0 * PI * h * h * h),
        };
        Self {
            inverse_support: unit / h,
            value_factor: alpha,
            derivative_factor: -20.0 * alpha / (h * h),
            dimension: dimension as f64,
        }
    }

    /// W(r), 1/m^D.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, r: L) -> L {
        self.value_at(self.q(r))
    }

    /// W'(r)/r, 1/m^(D+2), never positive.
    #[inline(always)]
    pub fn derivative_over_r<L: Lanes>(&self, r: L) -> L {
        self.derivative_over_r_at(self.q(r))
    }

    /// q = r/h, from which W and W'/r follow without a root or a division.
    #[inline(always)]
    pub fn q<L: Lanes>(&self, r: L) -> L {
        r * r.splat(self.inverse_support)
    }

    /// W at this q, 1/m^D.
    #[inline(always)]
    pub fn value_at<L: Lanes>(&self, q: L) -> L {
        let t = Self::t(q);
        let t2 = t * t;
        let four = q.splat(4.0);
        let one = q.splat(1.0);
        q.splat(self.value_factor) * ((t2 * t2) * (one + four * q))
    }

    /// W'/r at this q, 1/m^(D+2), never positive.
    #[inline(always)]
    pub fn derivative_over_r_at<L: Lanes>(&self, q: L) -> L {
        let t = Self::t(q);
        q.splat(self.derivative_factor) * (t * t * t)
    }

    /// h dW/dh at this q, 1/m^D: how W changes where the kernel becomes wider.
    #[inline(always)]
    pub fn structural_at<L: Lanes>(&self, q: L) -> L {
        let t = Self::t(q);
        let squares = q.splat(20.0 + 4.0 * self.dimension) * (q * q);
        let rest = q.splat(self.dimension) + q.splat(3.0 * self.dimension) * q;
        q.splat(self.value_factor) * ((t * t * t) * (squares - rest))
    }

    /// The derivative of h dW/dh with respect to r, over r, at this q, 1/m^(D+2).
    #[inline(always)]
    pub fn structural_derivative_over_r_at<L: Lanes>(&self, q: L) -> L {
        let t = Self::t(q);
        let slope = q.splat(self.dimension + 2.0) - q.splat(self.dimension + 5.0) * q;
        q.splat(-self.derivative_factor) * ((t * t) * slope)
    }

    #[inline(always)]
    fn t<L: Lanes>(q: L) -> L {
        (q.splat(1.0) - q).positive_part()
    }
}

/// The kernel, and the square of its reach in length quanta.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    pub(crate) kernel: WendlandC2,
    pub(crate) squared: f64,
}

impl Reach {
    /// The kernel of this support radius (m), its argument in quanta of so many metres.
    pub(crate) fn new(dimension: usize, support_radius: f64, quantum: f64) -> Self {
        let reach = support_radius / quantum;
        Self {
            kernel: WendlandC2::new(dimension, support_radius, quantum),
            squared: reach * reach,
        }
    }
    /// W(0), which W does not exceed.
    pub(crate) fn largest_value(&self) -> f64 {
        self.kernel.value(0.0)
    }
    /// What |W'| does not exceed, times a quantum: |W'/r| at 0 times the reach.
    pub(crate) fn largest_slope(&self) -> f64 {
        (self.kernel.derivative_over_r(0.0) * sqrt(self.squared)).abs()
    }
}
