//! The sweep over a strip: every pair once, a row of neighbours at a time.
//!
//! Particle i meets those of its own row that come after it, and the rows of its list. Lanes beyond
//! the reach vanish by themselves: the kernel is zero there. What the neighbours receive is added
//! in place, for they are contiguous; what i receives is kept in a row of its own until the strip is
//! done. There is no branch whose outcome depends on the particles.
//!
//! This is the one module with `unsafe`: rows are read and written without looking at their bounds
//! for each pair, which took a third of the time. The bounds of a strip are compared once, in
//! [`Leg::new`].
#![allow(unsafe_code)]

use super::backend::Work;
use super::lanes::{Pack, Quad, ROW, Reals, Words};
use super::layout::{Layout, Strip};
use super::meets::{Meeting, Meets, step};
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
    /// Records of the particles of the strip at hand, see [`Leg`].
    records: Vec<Words>,
}

impl Sums {
    /// Zeroes for `components` in each of these rows.
    pub fn clear(&mut self, rows: Range<usize>, components: usize) {
        self.first_row = rows.start;
        self.rows.clear();
        self.rows.resize(rows.len() * components, Words::default());
    }

    /// Room for `components` in each of these rows, whatever is in it.
    pub fn prepare(&mut self, rows: Range<usize>, components: usize) {
        self.first_row = rows.start;
        self.rows.resize(rows.len() * components, Words::default());
    }

    /// Zeroes in these rows, as far as there is room for them.
    pub fn clear_some(&mut self, rows: Range<usize>, components: usize) {
        let place = |row: usize| ((row - self.first_row) * components).min(self.rows.len());
        let rows = place(rows.start)..place(rows.end);
        self.rows[rows].fill(Words::default());
    }

    /// Component k of a slot.
    #[inline(always)]
    pub fn of<const TERM: usize>(&self, slot: usize, k: usize) -> i64 {
        self.rows[(slot / ROW - self.first_row) * TERM + k].0[slot % ROW]
    }
}

/// A pass over one strip. All slices begin with its first row.
///
/// Each particle of the strip has a *record* for its part as i: a row or more with its coordinates and
/// words (as bits), and a row for what each lane has given it, for each component. All of it is at one address; with separate
/// arrays a third of the instructions of a pair computed addresses.
pub(super) struct Leg<'a, A, P, const D: usize, const READ: usize, const TERM: usize> {
    pass: &'a P,
    strip: Strip,
    meets: &'a [Meeting],
    x: &'a [Reals],
    words: &'a [Reals],
    sums: &'a mut [Words],
    records: &'a mut [Words],
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
    /// Rows of a record with coordinates and words.
    const HEAD: usize = (D + READ).div_ceil(ROW);
    /// Rows of a record.
    const RECORD: usize = Self::HEAD + TERM;

    /// A pass over strip number `s`. `words` are READ to a row, from row `words_from` on.
    ///
    /// # Panics
    /// Rows that the strip meets lie outside the words or the sums.
    #[inline(always)]
    pub fn new(
        pass: &'a P,
        layout: &'a Layout,
        s: Option<usize>,
        (words, words_from): (&'a [Reals], usize),
        sums: &'a mut Sums,
    ) -> Self {
        let nobody = (Strip::default(), const { &Meets::new() });
        let (strip, meets) = s.map_or(nobody, |s| (layout.strips[s], &layout.meets[s]));
        let rows = strip.rows();
        let reached = meets.rows().max(rows.len());
        if sums.records.len() < strip.len * Self::RECORD {
            sums.records
                .resize(strip.len * Self::RECORD, Words::default());
        }
        let x = &layout.x[rows.start * D..];
        let words = match READ {
            0 => &[],
            _ if reached == 0 => &[],
            _ => &words[(rows.start - words_from) * READ..],
        };
        let sums_of = match reached {
            0 => &mut [],
            _ => &mut sums.rows[(rows.start - sums.first_row) * TERM..],
        };
        // What `meet` relies on.
        assert!(meets.particles() <= strip.len && strip.len <= rows.len() * ROW);
        assert!(reached * D <= x.len());
        assert!(reached * READ <= words.len());
        assert!(reached * TERM <= sums_of.len());
        let records = &mut sums.records[..strip.len * Self::RECORD];
        for (k, record) in records.chunks_exact_mut(Self::RECORD).enumerate() {
            let (row, lane) = (k / ROW, k % ROW);
            for d in 0..D {
                set(record, d, x[row * D + d].0[lane]);
            }
            for c in 0..READ {
                set(record, D + c, words[row * READ + c].0[lane]);
            }
        }
        Self {
            pass,
            strip,
            meets: meets.list(),
            x,
            words,
            sums: sums_of,
            records,
            arithmetic: PhantomData,
        }
    }

    /// Particle k meets the row that begins `at` steps from the first. With OWN, it is its own row, and
    /// only those that come after k count. Returns the argument of the terms.
    ///
    /// # Safety
    /// k is below the number of particles of the strip; the row is one of the strip's own or of its
    /// meetings.
    #[inline(always)]
    unsafe fn meet<Q: Quad, const OWN: bool>(
        &mut self,
        simd: Q,
        k: usize,
        at: usize,
        argument: impl Argument<Q>,
    ) -> Reals {
        debug_assert!(k < self.strip.len);
        // SAFETY: `new` has made sure that all rows of the strip and of its meetings are in these
        // slices, and that there are records for all particles of the strip.
        let (record, x_j, words_j, sums) = unsafe {
            (
                self.records.as_mut_ptr().add(k * Self::RECORD),
                rows_at::<_, D, D>(self.x, at),
                rows_at::<_, READ, D>(self.words, at),
                rows_at_mut::<_, TERM, D>(self.sums, at),
            )
        };
        // SAFETY: a record has HEAD rows with D + READ numbers in them, and then TERM rows.
        let of_i = |n: usize| unsafe { f64::from_bits((*record.add(n / ROW)).0[n % ROW] as u64) };
        let zero = Pack::<A::Real, Q>::new(simd, simd.splat(0.0));
        let mut x_ij = [zero; D];
        for d in 0..D {
            x_ij[d] = Pack::new(simd, simd.sub(simd.splat(of_i(d)), simd.load(x_j[d])));
        }
        let mut r2 = x_ij[0] * x_ij[0];
        for x in &x_ij[1..] {
            r2 = r2 + *x * *x;
        }
        if OWN {
            r2 = r2 + Pack::new(simd, simd.load(AFTER[k % ROW]));
        }
        let argument = argument.get::<A, P, D, READ, TERM>(self.pass, r2);
        let (mut read_i, mut read_j) = ([zero; READ], [zero; READ]);
        for c in 0..READ {
            read_i[c] = Pack::new(simd, simd.splat(of_i(D + c)));
            read_j[c] = Pack::new(simd, simd.load(words_j[c]));
        }
        let term = self.pass.term(&x_ij, argument, &read_i, &read_j);
        for c in 0..TERM {
            let rounded = simd.round(term[c].row);
            let old = simd.load_words(sums[c]);
            sums[c] = simd.store_words(match P::PARITY {
                Parity::Symmetric => simd.plus(old, rounded),
                Parity::Antisymmetric => simd.minus(old, rounded),
            });
            // SAFETY: as above.
            let received = unsafe { &mut *record.add(Self::HEAD + c) };
            *received = simd.store_words(if OWN {
                // The first that i receives in this strip.
                rounded
            } else {
                simd.plus(simd.load_words(*received), rounded)
            });
        }
        simd.store(argument.row)
    }

    /// Every particle meets those that come after it in its own row.
    #[inline(always)]
    fn own<Q: Quad>(&mut self, simd: Q, k: usize, argument: impl Argument<Q>) -> Reals {
        assert!(k < self.strip.len);
        // SAFETY: k is a particle of the strip and k / ROW its row.
        unsafe { self.meet::<Q, true>(simd, k, k / ROW * step(D), argument) }
    }

    /// Meeting number m of the list.
    #[inline(always)]
    fn other<Q: Quad>(&mut self, simd: Q, m: usize, argument: impl Argument<Q>) -> Reals {
        let meeting = self.meets[m];
        // SAFETY: the bounds of the meetings are those that `new` has compared.
        unsafe { self.meet::<Q, false>(simd, meeting.particle(), meeting.at(), argument) }
    }

    /// The whole strip.
    #[inline(always)]
    pub fn alone<Q: Quad>(&mut self, simd: Q) {
        for k in 0..self.strip.len {
            self.own(simd, k, Fresh);
        }
        for m in 0..self.meets.len() {
            self.other(simd, m, Fresh);
        }
        self.settle();
    }

    /// Number of arguments of terms.
    #[inline(always)]
    pub fn arguments(&self) -> usize {
        self.strip.len + self.meets.len()
    }

    /// The whole strip along with that of another pass, pair by pair. The arguments of the terms are
    /// written to `fresh`; those of the other's are `known`.
    ///
    /// # Panics
    /// There are not as many as [`Leg::arguments`].
    #[inline(always)]
    pub fn along_with<Q, P2, const READ2: usize, const TERM2: usize>(
        &mut self,
        simd: Q,
        fresh: &mut [Reals],
        second: &mut Leg<'_, A, P2, D, READ2, TERM2>,
        known: &[Reals],
    ) where
        Q: Quad,
        P2: PairPass<A, D, READ2, TERM2>,
    {
        let (own, others) = fresh.split_at_mut(self.strip.len);
        let (known_own, known_others) = known.split_at(second.strip.len);
        let both = own.len().min(known_own.len());
        for k in 0..both {
            own[k] = self.own(simd, k, Fresh);
            second.own(simd, k, Known(known_own[k]));
        }
        for (k, fresh) in own.iter_mut().enumerate().skip(both) {
            *fresh = self.own(simd, k, Fresh);
        }
        for (k, known) in known_own.iter().enumerate().skip(both) {
            second.own(simd, k, Known(*known));
        }
        let others = &mut others[..self.meets.len()];
        let known_others = &known_others[..second.meets.len()];
        let both = others.len().min(known_others.len());
        for m in 0..both {
            others[m] = self.other(simd, m, Fresh);
            second.other(simd, m, Known(known_others[m]));
        }
        for (m, fresh) in others.iter_mut().enumerate().skip(both) {
            *fresh = self.other(simd, m, Fresh);
        }
        for (m, known) in known_others.iter().enumerate().skip(both) {
            second.other(simd, m, Known(*known));
        }
        self.settle();
        second.settle();
    }

    /// Adds what the particles have received as i.
    #[inline(always)]
    fn settle(&mut self) {
        let sums = self.sums.chunks_exact_mut(TERM);
        let records = self.records.chunks(ROW * Self::RECORD);
        for (sums, records) in sums.zip(records) {
            for (l, record) in records.chunks_exact(Self::RECORD).enumerate() {
                for (sum, row) in sums.iter_mut().zip(&record[Self::HEAD..]) {
                    let [a, b, c, d] = row.0;
                    let total = a.wrapping_add(b).wrapping_add(c.wrapping_add(d));
                    sum.0[l] = sum.0[l].wrapping_add(total);
                }
            }
        }
    }
}

/// Writes number n of a record.
#[inline(always)]
fn set(record: &mut [Words], n: usize, value: f64) {
    record[n / ROW].0[n % ROW] = value.to_bits() as i64;
}

/// The row that begins `at` steps of dimension D from the first, of an array with N items to a row.
///
/// # Safety
/// The array has such a row.
#[inline(always)]
unsafe fn rows_at<T, const N: usize, const D: usize>(items: &[T], at: usize) -> &[T; N] {
    debug_assert!((at / step(D) + 1) * N <= items.len() && at.is_multiple_of(step(D)));
    // SAFETY: an array of N has the layout of N items, and the caller vouches for their being there.
    unsafe { &*items.as_ptr().byte_add(at * bytes::<T, N, D>()).cast() }
}

/// As [`rows_at`].
///
/// # Safety
/// The array has such a row.
#[inline(always)]
unsafe fn rows_at_mut<T, const N: usize, const D: usize>(
    items: &mut [T],
    at: usize,
) -> &mut [T; N] {
    debug_assert!((at / step(D) + 1) * N <= items.len() && at.is_multiple_of(step(D)));
    // SAFETY: as in `rows_at`; the array is borrowed for as long as the row.
    unsafe { &mut *items.as_mut_ptr().byte_add(at * bytes::<T, N, D>()).cast() }
}

/// Bytes of a step where N items of 32 bytes make a row.
#[inline(always)]
const fn bytes<T, const N: usize, const D: usize>() -> usize {
    const { assert!(size_of::<T>().is_multiple_of(step(D))) };
    N * (size_of::<T>() / step(D))
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
            let words = (self.words, 0);
            Leg::<A, P, D, READ, TERM>::new(self.pass, layout, Some(s), words, self.sums)
                .alone(simd);
        }
    }
}
