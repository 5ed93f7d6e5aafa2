//! The sweep: every pair once, a row of neighbours at a time.
//!
//! Particle i meets the rows of its own strip after itself, and the rows of the windows in the
//! strips that come after. Lanes beyond the reach vanish by themselves: the kernel is zero there.
//! What i receives is summed in a row of integers; what the neighbours receive is added in place,
//! for they are contiguous.

use super::backend::Work;
use super::lanes::Row;
use super::strips::Strips;
use loschmidt_core::Arithmetic;
use loschmidt_core::number::{Lanes, Real};
use loschmidt_core::pairs::{PairPass, Parity};
use std::marker::PhantomData;
use std::ops::Range;

/// 3·2^51: see [`loschmidt_core::number`].
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// A part of the strips with the sums it adds to: its own slots and those of the strips after it.
#[derive(Debug, Default)]
pub(super) struct Part {
    /// The strips whose particles meet others.
    pub strips: Range<usize>,
    /// The slots that receive.
    pub slots: Range<usize>,
    /// Sums by component and slot, from `slots.start` on.
    pub sums: [Vec<i64>; 3],
}

/// One part to be swept.
pub(super) struct Sweep<'a, A, P, const D: usize, const READ: usize, const TERM: usize> {
    pub pass: &'a P,
    pub strips: &'a Strips,
    pub read: &'a [Vec<f64>; 3],
    pub part: &'a mut Part,
    pub arithmetic: PhantomData<A>,
}

/// Views of the columns of numbers, in rows.
#[derive(Clone, Copy)]
struct Rows<'a, const D: usize, const READ: usize, const L: usize> {
    x: [&'a [[f64; L]]; D],
    read: [&'a [[f64; L]]; READ],
}

impl<A, P, const D: usize, const READ: usize, const TERM: usize> Work
    for Sweep<'_, A, P, D, READ, TERM>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    #[inline(always)]
    fn run<const L: usize>(self) {
        let strips = self.strips;
        let rows = Rows::<D, READ, L> {
            x: std::array::from_fn(|d| strips.x[d].as_chunks().0),
            read: std::array::from_fn(|k| self.read[k].as_chunks().0),
        };
        let base = self.part.slots.start;
        let [s0, s1, s2] = &mut self.part.sums;
        let mut all = [s0, s1, s2].into_iter();
        let mut sums: [&mut [i64]; TERM] = std::array::from_fn(|_| match all.next() {
            Some(sums) => &mut sums[..],
            None => &mut [],
        });
        for strip in self.part.strips.clone() {
            for column in 0..strips.columns {
                let cell = strips.cell(strip, column);
                if cell.is_empty() {
                    continue;
                }
                let own_end = strips.around(strip, column).end;
                let mut beside = [const { 0..0 }; 4];
                for (b, other) in beside.iter_mut().zip(strips.forward::<D>(strip)) {
                    *b = strips.around(other, column);
                }
                for i in cell {
                    let one = One::<A, P, D, READ, TERM, L>::new(self.pass, &rows, i, base);
                    let mut received = [[0i64; L]; TERM];
                    let first = (i + 1) / L;
                    if first * L <= i {
                        one.meet::<true>(first, &mut received, &mut sums);
                    } else if first * L < own_end {
                        one.meet::<false>(first, &mut received, &mut sums);
                    }
                    for row in first + 1..own_end.div_ceil(L) {
                        one.meet::<false>(row, &mut received, &mut sums);
                    }
                    for window in &beside {
                        if !window.is_empty() {
                            for row in window.start / L..window.end.div_ceil(L) {
                                one.meet::<false>(row, &mut received, &mut sums);
                            }
                        }
                    }
                    for (sums, received) in sums.iter_mut().zip(&received) {
                        let total = received.iter().fold(0i64, |t, q| t.wrapping_add(*q));
                        sums[i - base] = sums[i - base].wrapping_add(total);
                    }
                }
            }
        }
    }
}

/// One particle that meets rows.
struct One<
    'a,
    A: Arithmetic,
    P,
    const D: usize,
    const READ: usize,
    const TERM: usize,
    const L: usize,
> {
    pass: &'a P,
    rows: &'a Rows<'a, D, READ, L>,
    i: usize,
    base_row: usize,
    x: [Row<A::Real, L>; D],
    read: [Row<A::Real, L>; READ],
}

impl<'a, A, P, const D: usize, const READ: usize, const TERM: usize, const L: usize>
    One<'a, A, P, D, READ, TERM, L>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    #[inline(always)]
    fn new(pass: &'a P, rows: &'a Rows<'a, D, READ, L>, i: usize, base: usize) -> Self {
        let splat = |column: &[[f64; L]]| Row::splat(A::Real::from_f64(column[i / L][i % L]));
        Self {
            pass,
            rows,
            i,
            base_row: base / L,
            x: std::array::from_fn(|d| splat(rows.x[d])),
            read: std::array::from_fn(|k| splat(rows.read[k])),
        }
    }

    /// Meets a row; with OWN, only those of it that come after i.
    #[inline(always)]
    fn meet<const OWN: bool>(
        &self,
        row: usize,
        received: &mut [[i64; L]; TERM],
        sums: &mut [&mut [i64]; TERM],
    ) {
        let load = |column: &[[f64; L]]| Row(column[row].map(A::Real::from_f64));
        let x_ij: [Row<A::Real, L>; D] = std::array::from_fn(|d| self.x[d] - load(self.rows.x[d]));
        let mut r2 = x_ij[0] * x_ij[0];
        for x in &x_ij[1..] {
            r2 = r2 + *x * *x;
        }
        if OWN {
            for (l, r2) in r2.0.iter_mut().enumerate() {
                if row * L + l <= self.i {
                    // Far away.
                    *r2 = A::Real::from_f64(1e36);
                }
            }
        }
        let read_j: [Row<A::Real, L>; READ] = std::array::from_fn(|k| load(self.rows.read[k]));
        let term = self.pass.term(&x_ij, r2, &self.read, &read_j);
        for k in 0..TERM {
            let rounded: [i64; L] = term[k].0.map(|x| {
                ((x.to_f64() + ROUNDER).to_bits() as i64).wrapping_sub(ROUNDER.to_bits() as i64)
            });
            let Some(sums) = sums[k].as_chunks_mut::<L>().0.get_mut(row - self.base_row) else {
                continue;
            };
            for l in 0..L {
                received[k][l] = received[k][l].wrapping_add(rounded[l]);
                sums[l] = match P::PARITY {
                    Parity::Symmetric => sums[l].wrapping_add(rounded[l]),
                    Parity::Antisymmetric => sums[l].wrapping_sub(rounded[l]),
                };
            }
        }
    }
}
