//! The sweep over a strip: every pair once, a row of neighbours at a time.
//!
//! Particle i meets those of its own row that come after it, and the rows of its list. Lanes beyond
//! the reach vanish by themselves: the kernel is zero there. What the neighbours receive is added
//! in place, for they are contiguous; what i receives is kept in a row of its own until the strip is
//! done. There is no branch whose outcome depends on the particles.

use super::backend::Work;
use super::lanes::{Pack, Quad, ROW, Reals, Words};
use super::layout::{Layout, Meeting, Strip};
use loschmidt_core::Arithmetic;
use loschmidt_core::pairs::{PairPass, Parity};
use std::marker::PhantomData;
use std::ops::Range;

/// Added to r² in an own row: what does not come after i is far away.
const AFTER: [Reals; ROW] = [
    Reals([1e36, 0.0, 0.0, 0.0]),
    Reals([1e36, 1e36, 0.0, 0.0]),
    Reals([1e36, 1e36, 1e36, 0.0]),
    Reals([1e36, 1e36, 1e36, 1e36]),
];

/// Sums by row of slots.
#[derive(Debug, Default)]
pub(super) struct Sums {
    /// Components of row `first_row`, then those of the next.
    pub rows: Vec<Words>,
    /// First row that has sums.
    pub first_row: usize,
    /// What the particles of the strip at hand have received as i, a row of components for each.
    received: Vec<Words>,
}

impl Sums {
    /// Zeroes for `components` in each of these rows.
    pub fn clear(&mut self, rows: Range<usize>, components: usize) {
        self.first_row = rows.start;
        self.rows.clear();
        self.rows.resize(rows.len() * components, Words::default());
    }

    /// Component k of a slot.
    #[inline(always)]
    pub fn of<const TERM: usize>(&self, slot: usize, k: usize) -> i64 {
        self.rows[(slot / ROW - self.first_row) * TERM + k].0[slot % ROW]
    }
}

/// A pass over one strip.
pub(super) struct Leg<'a, A, P, const D: usize, const READ: usize, const TERM: usize> {
    pass: &'a P,
    strip: Strip,
    x: &'a [Reals],
    words: &'a [Reals],
    words_from: usize,
    sums: &'a mut [Words],
    sums_from: usize,
    received: &'a mut [Words],
    arithmetic: PhantomData<A>,
}

/// Where the argument of a term comes from.
pub(super) trait Argument<Q: Quad> {
    fn get<A, P, const D: usize, const READ: usize, const TERM: usize>(
        &self,
        pass: &P,
        r2: Pack<A::Real, Q>,
    ) -> Pack<A::Real, Q>
    where
        A: Arithmetic,
        P: PairPass<A, D, READ, TERM>;
}

/// It is computed from r².
pub(super) struct Fresh;
/// It is known.
pub(super) struct Known(pub Reals);

impl<Q: Quad> Argument<Q> for Fresh {
    #[inline(always)]
    fn get<A, P, const D: usize, const READ: usize, const TERM: usize>(
        &self,
        pass: &P,
        r2: Pack<A::Real, Q>,
    ) -> Pack<A::Real, Q>
    where
        A: Arithmetic,
        P: PairPass<A, D, READ, TERM>,
    {
        pass.argument(r2)
    }
}

impl<Q: Quad> Argument<Q> for Known {
    #[inline(always)]
    fn get<A, P, const D: usize, const READ: usize, const TERM: usize>(
        &self,
        _: &P,
        r2: Pack<A::Real, Q>,
    ) -> Pack<A::Real, Q>
    where
        A: Arithmetic,
        P: PairPass<A, D, READ, TERM>,
    {
        Pack::new(r2.simd, r2.simd.load(self.0))
    }
}

impl<'a, A, P, const D: usize, const READ: usize, const TERM: usize> Leg<'a, A, P, D, READ, TERM>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    /// A pass over a strip. `words` are READ to a row, from row `words_from` on.
    #[inline(always)]
    pub fn new(
        pass: &'a P,
        strip: Strip,
        x: &'a [Reals],
        (words, words_from): (&'a [Reals], usize),
        sums: &'a mut Sums,
    ) -> Self {
        sums.received.resize(sums.received.len().max(strip.len * TERM), Words::default());
        Self {
            pass,
            strip,
            x,
            words,
            words_from,
            sums: &mut sums.rows,
            sums_from: sums.first_row,
            received: &mut sums.received,
            arithmetic: PhantomData,
        }
    }

    /// The particle in place k of the strip meets those that come after it in its row. Returns the
    /// arguments of the terms.
    #[inline(always)]
    pub fn own<Q: Quad>(&mut self, simd: Q, k: usize, argument: impl Argument<Q>) -> Reals {
        let i = self.strip.slot + k;
        self.meet::<Q, true>(simd, i, i / ROW, argument)
    }

    /// A particle meets a row of its list.
    #[inline(always)]
    pub fn other<Q: Quad>(&mut self, simd: Q, m: Meeting, argument: impl Argument<Q>) -> Reals {
        self.meet::<Q, false>(simd, m[0] as usize, m[1] as usize, argument)
    }

    #[inline(always)]
    fn meet<Q: Quad, const OWN: bool>(
        &mut self,
        simd: Q,
        i: usize,
        row: usize,
        argument: impl Argument<Q>,
    ) -> Reals {
        let x_i = &self.x[i / ROW * D..][..D];
        let x_j = &self.x[row * D..][..D];
        let zero = Pack::<A::Real, Q>::new(simd, simd.splat(0.0));
        let mut x_ij = [zero; D];
        for d in 0..D {
            let x_i = simd.splat(x_i[d].0[i % ROW]);
            x_ij[d] = Pack::new(simd, simd.sub(x_i, simd.load(x_j[d])));
        }
        let mut r2 = x_ij[0] * x_ij[0];
        for x in &x_ij[1..] {
            r2 = r2 + *x * *x;
        }
        if OWN {
            r2 = r2 + Pack::new(simd, simd.load(AFTER[i % ROW]));
        }
        let argument = argument.get::<A, P, D, READ, TERM>(self.pass, r2);
        let (mut read_i, mut read_j) = ([zero; READ], [zero; READ]);
        if READ > 0 {
            let words_i = &self.words[(i / ROW - self.words_from) * READ..][..READ];
            let words_j = &self.words[(row - self.words_from) * READ..][..READ];
            for k in 0..READ {
                read_i[k] = Pack::new(simd, simd.splat(words_i[k].0[i % ROW]));
                read_j[k] = Pack::new(simd, simd.load(words_j[k]));
            }
        }
        let term = self.pass.term(&x_ij, argument, &read_i, &read_j);
        let sums = &mut self.sums[(row - self.sums_from) * TERM..][..TERM];
        let received = &mut self.received[(i - self.strip.slot) * TERM..][..TERM];
        for k in 0..TERM {
            let rounded = simd.round(term[k].row);
            let old = simd.load_words(sums[k]);
            sums[k] = simd.store_words(match P::PARITY {
                Parity::Symmetric => simd.plus(old, rounded),
                Parity::Antisymmetric => simd.minus(old, rounded),
            });
            received[k] = simd.store_words(if OWN {
                // The first that i receives in this strip.
                rounded
            } else {
                simd.plus(simd.load_words(received[k]), rounded)
            });
        }
        simd.store(argument.row)
    }

    /// The whole strip.
    #[inline(always)]
    pub fn alone<Q: Quad>(&mut self, simd: Q, meets: &[Meeting]) {
        for k in 0..self.strip.len {
            self.own(simd, k, Fresh);
        }
        for meeting in meets {
            self.other(simd, *meeting, Fresh);
        }
        self.settle();
    }

    /// Adds what the particles have received as i.
    #[inline(always)]
    pub fn settle(&mut self) {
        for k in 0..self.strip.len {
            let slot = self.strip.slot + k;
            let sums = &mut self.sums[(slot / ROW - self.sums_from) * TERM..][..TERM];
            let received = &self.received[k * TERM..][..TERM];
            for (sum, row) in sums.iter_mut().zip(received) {
                let [a, b, c, d] = row.0;
                let total = a.wrapping_add(b).wrapping_add(c.wrapping_add(d));
                sum.0[slot % ROW] = sum.0[slot % ROW].wrapping_add(total);
            }
        }
    }
}

/// One pass over some strips.
pub(super) struct Sweep<'a, A, P, const D: usize, const READ: usize, const TERM: usize> {
    pub pass: &'a P,
    pub layout: &'a Layout,
    pub strips: Range<usize>,
    pub words: &'a [Reals],
    pub sums: &'a mut Sums,
    pub arithmetic: PhantomData<A>,
}

impl<A, P, const D: usize, const READ: usize, const TERM: usize> Work
    for Sweep<'_, A, P, D, READ, TERM>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    type Output = ();
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) {
        let layout = self.layout;
        for s in self.strips {
            let strip = layout.strips[s];
            let words = (self.words, 0);
            let mut leg = Leg::<A, P, D, READ, TERM>::new(self.pass, strip, &layout.x, words, self.sums);
            leg.alone(simd, &layout.meets[s]);
        }
    }
}
