//! Lifts: a row of integers u goes to u e^M, for a traceless matrix M, by shears that can be undone.
//!
//! Each operation adds to some components of u one integer, rounded oddly from the other components,
//! or from differences and sums that it does not change. So its negative undoes it, and the
//! palindrome of all of them with -M undoes the palindrome with M: exactly, although u e^M itself
//! is only approximated, to third order in M. A matrix of integers whose rows are all lifted by one
//! M keeps its determinant up to rounding.
//!
//! In the plane, with p = M₁₁:
//!
//! - U(s): u₂ += R(s (M₁₂ + p) u₁)
//! - V(s): u₁ += R(s (M₂₁ - p) u₂)
//! - W: k = R(p (u₁ + u₂)), u₁ += k, u₂ -= k
//! - U(½) V(½) W V(½) U(½)
//!
//! In space, with d = (M₁₁, M₂₂, -(M₁₁ + M₂₂)):
//!
//! - X(s): u₁ += R(s ((M₂₁ - d₂) u₂ + (M₃₁ - d₃) u₃)), and Y, Z likewise for u₂ and u₃
//! - W(s): k = R(s (d₁ (u₁ - u₃) + d₂ (u₂ - u₃))), added to all three
//! - X(½) W(½) Y(½) Z(1) Y(½) W(½) X(½)
//!
//! W is the generator d (1, 1, 1)ᵀ, and d·(1, 1, 1) = 0; the others make up for what it puts beside
//! the diagonal. Shears of single pairs of components would do in the plane; in space a palindrome
//! of them turns a steady rotation about an oblique axis into a strain that grows with time, since
//! the trace of their product is not even in M. That of these seven operations is, for M of a
//! rotation, so its eigenvalues stay 1, e^(±iφ).
//!
//! The entries of M must be exactly odd in the velocities, as products, sums and halves of them are.

use crate::number::Quantity;

/// Takes u to about u e^M; false where a component left the range of a state, or an addition did.
#[inline(always)]
pub fn lift<W: Quantity, const D: usize>(row: &mut [W; D], m: &[[f64; D]; D]) -> bool {
    let mut lift = Lift {
        row,
        m,
        inside: true,
    };
    if D == 2 {
        lift.in_the_plane();
    } else {
        lift.in_space();
    }
    let inside = lift.inside;
    row.iter().fold(inside, |inside, u| inside & u.in_range())
}

struct Lift<'a, W, const D: usize> {
    row: &'a mut [W; D],
    m: &'a [[f64; D]; D],
    inside: bool,
}

impl<W: Quantity, const D: usize> Lift<'_, W, D> {
    #[inline(always)]
    fn in_the_plane(&mut self) {
        let p = self.m[0][0];
        let to_second = 0.5 * (self.m[0][1] + p);
        let to_first = 0.5 * (self.m[1][0] - p);
        self.add(1, to_second * self.value(0));
        self.add(0, to_first * self.value(1));
        let k = self.rounded(p * self.row[0].plus(self.row[1]).quanta());
        self.row[0] = self.row[0].plus(k);
        self.row[1] = self.row[1].plus(k.negated());
        self.add(0, to_first * self.value(1));
        self.add(1, to_second * self.value(0));
    }

    #[inline(always)]
    fn in_space(&mut self) {
        let (d1, d2) = (self.m[0][0], self.m[1][1]);
        let d = [d1, d2, -(d1 + d2)];
        self.add_others(0, 0.5, &d);
        self.shift_all(0.5, &d);
        self.add_others(1, 0.5, &d);
        self.add_others(2, 1.0, &d);
        self.add_others(1, 0.5, &d);
        self.shift_all(0.5, &d);
        self.add_others(0, 0.5, &d);
    }

    /// X, Y or Z.
    #[inline(always)]
    fn add_others(&mut self, c: usize, s: f64, d: &[f64; 3]) {
        let (a, b) = ([1, 0, 0][c], [2, 2, 1][c]);
        let of_a = (self.m[a][c] - d[a]) * self.value(a);
        let of_b = (self.m[b][c] - d[b]) * self.value(b);
        self.add(c, s * (of_a + of_b));
    }

    /// W.
    #[inline(always)]
    fn shift_all(&mut self, s: f64, d: &[f64; 3]) {
        let of_first = d[0] * self.row[0].difference(self.row[2]);
        let of_second = d[1] * self.row[1].difference(self.row[2]);
        let k = self.rounded(s * (of_first + of_second));
        for u in &mut *self.row {
            *u = u.plus(k);
        }
    }

    #[inline(always)]
    fn value(&self, c: usize) -> f64 {
        self.row[c].quanta()
    }

    #[inline(always)]
    fn add(&mut self, c: usize, x: f64) {
        let k = self.rounded(x);
        self.row[c] = self.row[c].plus(k);
    }

    #[inline(always)]
    fn rounded(&mut self, x: f64) -> W {
        let k = W::ZERO.add_rounded(x);
        self.inside &= k.is_some();
        k.unwrap_or(W::ZERO)
    }
}
