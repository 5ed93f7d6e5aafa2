//! The sweep over a strip: every pair once, a row of neighbours at a time.
//!
//! Particle i meets those of its own row that come after it, and the rows of its list. Lanes beyond
//! the reach vanish by themselves: the kernel is zero there. What the neighbours receive is added
//! in place, for they are contiguous; what i receives is kept in a row of its own until the strip
//! is done. There is no branch whose outcome depends on the particles.
//!
//! This is the one module with `unsafe`: rows are read and written without looking at their bounds
//! for each pair, which took a third of the time. The bounds of a strip are compared once, in
//! [`Leg::new`].
#![allow(unsafe_code)]

use super::backend::Work;
use super::lanes::{Pack, Quad, ROW, Reals, Words};
use super::layout::{Layout, Strip};
use super::meets::{Meeting, Meets, step};
use super::sums::Sums;
use loschmidt_core::number::Grain;
use loschmidt_core::pairs::{PairPass, Parity, read_count, term_count};
use loschmidt_core::values::Values;
use std::ops::Range;

/// Added to r² in an own row: what does not come after i is far away.
const AFTER: [Reals; ROW] = [
    Reals([1e36, 0.0, 0.0, 0.0]),
    Reals([1e36, 1e36, 0.0, 0.0]),
    Reals([1e36, 1e36, 1e36, 0.0]),
    Reals([1e36, 1e36, 1e36, 1e36]),
];

/// A pass over one strip. All slices begin with its first row. FINE where grains may be finer than
/// quanta.
///
/// Each particle of the strip has a *record* for its part as i: a row or more with its coordinates
/// and what is read of it (as bits), and a row for what each lane has given it, for each number of
/// the term. All of it is at one address; with separate arrays a third of the instructions of a
/// pair computed addresses.
pub(super) struct Leg<'a, P: PairPass<D>, const D: usize, const FINE: bool> {
    pass: &'a P,
    /// Round each number to its grain.
    rounders: P::Term<f64>,
    strip: Strip,
    meets: &'a [Meeting],
    x: &'a [Reals],
    words: &'a [Reals],
    sums: &'a mut [Words],
    records: &'a mut [Words],
}

/// Where the argument of a term comes from.
pub(super) trait Argument<Q: Quad> {
    fn get<P: PairPass<D>, const D: usize>(&self, pass: &P, r2: Pack<Q>) -> Pack<Q>;
}

/// It is computed from r².
pub(super) struct Fresh;
/// It is known.
pub(super) struct Known(pub Reals);

impl<Q: Quad> Argument<Q> for Fresh {
    #[inline(always)]
    fn get<P: PairPass<D>, const D: usize>(&self, pass: &P, r2: Pack<Q>) -> Pack<Q> {
        pass.argument(r2)
    }
}

impl<Q: Quad> Argument<Q> for Known {
    #[inline(always)]
    fn get<P: PairPass<D>, const D: usize>(&self, _: &P, r2: Pack<Q>) -> Pack<Q> {
        Pack::new(r2.simd, r2.simd.load(self.0))
    }
}

impl<'a, P: PairPass<D>, const D: usize, const FINE: bool> Leg<'a, P, D, FINE> {
    /// Numbers read of each particle, and numbers of a term.
    const READ: usize = read_count::<P, D>();
    const TERM: usize = term_count::<P, D>();
    /// Rows of a record with coordinates and what is read.
    const HEAD: usize = (D + Self::READ).div_ceil(ROW);
    /// Rows of a record.
    const RECORD: usize = Self::HEAD + Self::TERM;

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
        (sums, grains): (&'a mut Sums, &[Grain]),
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
        let words = match Self::READ {
            0 => &[],
            _ if reached == 0 => &[],
            _ => &words[(rows.start - words_from) * Self::READ..],
        };
        let sums_of = match reached {
            0 => &mut [],
            _ => &mut sums.rows[(rows.start - sums.first_row) * Self::TERM..],
        };
        // What `meet` relies on.
        assert!(meets.particles() <= strip.len && strip.len <= rows.len() * ROW);
        assert!(reached * D <= x.len());
        assert!(reached * Self::READ <= words.len());
        assert!(reached * Self::TERM <= sums_of.len());
        let records = &mut sums.records[..strip.len * Self::RECORD];
        for (k, record) in records.chunks_exact_mut(Self::RECORD).enumerate() {
            let (row, lane) = (k / ROW, k % ROW);
            for d in 0..D {
                set(record, d, x[row * D + d].0[lane]);
            }
            for c in 0..Self::READ {
                set(record, D + c, words[row * Self::READ + c].0[lane]);
            }
        }
        Self {
            pass,
            rounders: P::Term::<f64>::from_fn(
                #[inline(always)]
                |k| grains[k].rounder(),
            ),
            strip,
            meets: meets.list(),
            x,
            words,
            sums: sums_of,
            records,
        }
    }

    /// Particle k meets the row that begins `at` steps from the first. With OWN, it is its own row,
    /// and only those that come after k count. Returns the argument of the terms.
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
                row_at::<_, D>(self.x, D, at),
                row_at::<_, D>(self.words, Self::READ, at),
                row_at_mut::<_, D>(self.sums, Self::TERM, at),
            )
        };
        let mut x_ij = [Pack::new(simd, simd.splat(0.0)); D];
        for (d, x_ij) in x_ij.iter_mut().enumerate() {
            // SAFETY: there are D rows of coordinates.
            let x_j = Pack::new(simd, simd.load(unsafe { *x_j.add(d) }));
            // SAFETY: a record has D + READ numbers.
            *x_ij = unsafe { number(simd, record, d) } - x_j;
        }
        let mut r2 = x_ij[0] * x_ij[0];
        for x in &x_ij[1..] {
            r2 = r2 + *x * *x;
        }
        if OWN {
            r2 = r2 + Pack::new(simd, simd.load(AFTER[k % ROW]));
        }
        let argument = argument.get(self.pass, r2);
        let read_i = P::Read::<Pack<Q>>::from_fn(
            #[inline(always)]
            // SAFETY: a record has D + READ numbers.
            |c| unsafe { number(simd, record, D + c) },
        );
        let read_j = P::Read::<Pack<Q>>::from_fn(
            #[inline(always)]
            // SAFETY: there are READ rows of words.
            |c| Pack::new(simd, simd.load(unsafe { *words_j.add(c) })),
        );
        let term = self.pass.term(&x_ij, argument, &read_i, &read_j);
        for c in 0..Self::TERM {
            let number = term.get(c).row;
            let rounded = if FINE || !Q::CONVERTS {
                simd.round(number, simd.splat(self.rounders.get(c)))
            } else {
                simd.convert(number)
            };
            // SAFETY: there are TERM rows of sums, and as many in a record after its head. No other
            // reference to either is in use.
            let (sum, received) = unsafe { (&mut *sums.add(c), &mut *record.add(Self::HEAD + c)) };
            let old = simd.load_words(*sum);
            *sum = simd.store_words(match P::PARITY.get(c) {
                Parity::Symmetric => simd.plus(old, rounded),
                Parity::Antisymmetric => simd.minus(old, rounded),
            });
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

    /// The whole strip along with that of another pass, pair by pair. The arguments of the terms
    /// are written to `fresh`; those of the other's are `known`.
    ///
    /// # Panics
    /// There are not as many as [`Leg::arguments`].
    #[inline(always)]
    pub fn along_with<Q: Quad, P2: PairPass<D>>(
        &mut self,
        simd: Q,
        fresh: &mut [Reals],
        second: &mut Leg<'_, P2, D, FINE>,
        known: &[Reals],
    ) {
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
        let sums = self.sums.chunks_exact_mut(Self::TERM);
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

/// Number n of a record, in every lane.
///
/// # Safety
/// The record has such a number.
#[inline(always)]
unsafe fn number<Q: Quad>(simd: Q, record: *const Words, n: usize) -> Pack<Q> {
    // SAFETY: the caller vouches for it.
    let bits = unsafe { (*record.add(n / ROW)).0[n % ROW] };
    Pack::new(simd, simd.splat(f64::from_bits(bits as u64)))
}

/// The row that begins `at` steps of dimension D from the first, of an array with `each` items to a
/// row.
///
/// # Safety
/// The array has such a row.
#[inline(always)]
unsafe fn row_at<T, const D: usize>(items: &[T], each: usize, at: usize) -> *const T {
    debug_assert!((at / step(D) + 1) * each <= items.len() && at.is_multiple_of(step(D)));
    // SAFETY: the caller vouches for the row's being there.
    unsafe { items.as_ptr().byte_add(at * bytes::<T, D>(each)) }
}

/// As [`row_at`].
///
/// # Safety
/// The array has such a row.
#[inline(always)]
unsafe fn row_at_mut<T, const D: usize>(items: &mut [T], each: usize, at: usize) -> *mut T {
    debug_assert!((at / step(D) + 1) * each <= items.len() && at.is_multiple_of(step(D)));
    // SAFETY: as in `row_at`.
    unsafe { items.as_mut_ptr().byte_add(at * bytes::<T, D>(each)) }
}

/// Bytes of a step where so many items of 32 bytes make a row.
#[inline(always)]
const fn bytes<T, const D: usize>(each: usize) -> usize {
    const { assert!(size_of::<T>().is_multiple_of(step(D))) };
    each * (size_of::<T>() / step(D))
}

/// One pass over some strips.
pub(super) struct Sweep<'a, P: PairPass<D>, const D: usize> {
    pub pass: &'a P,
    pub layout: &'a Layout,
    pub strips: Range<usize>,
    pub words: &'a [Reals],
    pub sums: &'a mut Sums,
    pub grains: &'a [Grain],
}

impl<P: PairPass<D>, const D: usize> Sweep<'_, P, D> {
    #[inline(always)]
    fn go<Q: Quad, const FINE: bool>(self, simd: Q) {
        let layout = self.layout;
        for s in self.strips {
            let words = (self.words, 0);
            let sums = (&mut *self.sums, self.grains);
            Leg::<P, D, FINE>::new(self.pass, layout, Some(s), words, sums).alone(simd);
        }
    }
}

impl<P: PairPass<D>, const D: usize> Work for Sweep<'_, P, D> {
    type Output = ();
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) {
        // Compiled once where there is no other way to round whole quanta.
        if Q::CONVERTS && self.grains.iter().all(|grain| *grain == Grain::QUANTUM) {
            self.go::<Q, false>(simd);
        } else {
            self.go::<Q, true>(simd);
        }
    }
}
