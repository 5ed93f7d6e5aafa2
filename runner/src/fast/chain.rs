//! Two sums in one sweep.
//!
//! Going up the strips, the first sum of strip s, which also adds to strip s + 1, is taken along with
//! the second sum of strip s - 2: by then the first sums of strips s - 2 and s - 1 are finished, and
//! the arguments of their terms (a square root for each pair) are still in the cache. The two are
//! interleaved pair by pair, so that the divider works on the roots of one while the multipliers
//! work on the other.
//!
//! Each part of the strips does that by itself. Its first strip lacks what the part before adds to
//! it, and its last strip meets the first one of the part after; so the second sums of these two
//! are taken afterwards, when the first sums are whole.

use super::backend::Work;
use super::lanes::{Quad, ROW, Reals};
use super::layout::{Layout, Strip};
use super::sweep::{Leg, Sums};
use super::{Crew, LIMIT, Memory, larger};
use loschmidt_core::chain::{Chain, ChainSet, SumsOf};
use loschmidt_core::number::{Accumulate, Quantity, Real};
use loschmidt_core::pairs::PairPass;
use loschmidt_core::{Arithmetic, Fault};
use std::marker::PhantomData;
use std::ops::Range;

/// Arguments of the terms of three strips in turn.
pub(super) type Arguments = [Vec<Reals>; 3];

/// What finishing first sums has shown.
struct Found<const READ: usize> {
    fault: Option<Fault>,
    /// Largest magnitudes of the words.
    largest: [f64; READ],
}

impl<const READ: usize> Found<READ> {
    fn nothing() -> Self {
        Self {
            fault: None,
            largest: [0.0; READ],
        }
    }
    #[inline(always)]
    fn fault(&mut self, fault: Fault) {
        self.fault = Some(self.fault.map_or(fault, |other| other.first(fault)));
    }
    fn and(mut self, other: Self) -> Self {
        if let Some(fault) = other.fault {
            self.fault(fault);
        }
        for (l, o) in self.largest.iter_mut().zip(other.largest) {
            *l = larger(*l, o);
        }
        self
    }
}

/// Strips whose second sums a part takes as it goes.
fn inner(strips: &Range<usize>, count: usize) -> Range<usize> {
    strips.start + usize::from(strips.start > 0)..strips.end - usize::from(strips.end < count)
}

impl Memory {
    /// The sums of a chain; false where the second terms could be out of range, and nothing that is
    /// in `sums` counts.
    ///
    /// # Errors
    /// What the chain finds.
    pub(super) fn chain<
        A,
        C,
        const D: usize,
        const READ: usize,
        const FIRST: usize,
        const SECOND: usize,
    >(
        &mut self,
        crew: Crew,
        chain: &C,
        set: &ChainSet<'_, A, D>,
        out: &mut SumsOf<'_, A, C, D, READ, FIRST, SECOND>,
    ) -> Result<bool, Fault>
    where
        A: Arithmetic,
        C: Chain<A, D, READ, FIRST, SECOND>,
    {
        debug_assert!(self.layout.is_of(set.position));
        let layout = &self.layout;
        if chain.first().bound(&[]) >= LIMIT {
            return Ok(false);
        }
        let parts = layout.parts.len();
        self.sums.resize_with(parts, Default::default);
        self.arguments.resize_with(parts, Default::default);
        self.words
            .resize(layout.all_rows() * READ, Reals::default());
        let found = {
            let first = layout.split_places(&mut *out.first);
            let words = layout.split_rows(&mut self.words, READ);
            let memory = self.sums.iter_mut().zip(&mut self.arguments);
            let items = first.into_iter().zip(words).zip(memory).collect();
            layout.for_parts(items, |strips, ((first, words), (sums, arguments))| {
                crew.backend.run(Going::<A, C, D, READ, FIRST, SECOND> {
                    chain,
                    layout,
                    strips,
                    first,
                    words,
                    sums,
                    arguments,
                    arithmetic: PhantomData,
                })
            })
        };
        let mut found = found.into_iter().fold(Found::nothing(), Found::and);
        for part in layout.parts.iter().filter(|p| !p.is_empty() && p.start > 0) {
            let strip = layout.strips[part.start];
            let sums: Vec<_> = self.sums.iter().map(|[first, _]| first).collect();
            let contributors = layout.contributors::<FIRST>(&sums, &strip);
            let first = &mut out.first[strip.places()];
            let words = &mut self.words[strip.rows().start * READ..][..strip.rows().len() * READ];
            finish::<A, C, D, READ, FIRST, SECOND>(
                chain,
                &contributors,
                strip,
                first,
                words,
                &mut found,
            );
        }
        if let Some(fault) = found.fault {
            return Err(fault);
        }
        if chain.second().bound(&found.largest.map(A::Real::from_f64)) >= LIMIT {
            return Ok(false);
        }
        let words = &self.words;
        if parts > 1 {
            layout.for_parts(self.sums.iter_mut().collect(), |strips, [_, sums]| {
                crew.backend.run(Rest::<A, C, D, READ, FIRST, SECOND> {
                    chain,
                    layout,
                    strips,
                    words,
                    sums,
                    arithmetic: PhantomData,
                });
            });
        }
        let sums: Vec<_> = self.sums.iter().map(|[_, second]| second).collect();
        let second = layout.split_places(&mut *out.second);
        let faults = layout.for_parts(second, |strips, second| {
            let mut found = Found::<0>::nothing();
            let from = layout.places_of(&strips).start;
            for strip in &layout.strips[strips] {
                let contributors = layout.contributors::<SECOND>(&sums, strip);
                for k in 0..strip.len {
                    let mut sum = match chain.resume(strip.place + k) {
                        Ok(sum) => sum,
                        Err(fault) => {
                            found.fault(fault);
                            continue;
                        }
                    };
                    add_received::<A::Real, _, SECOND>(&mut sum, &contributors, strip.slot + k);
                    second[strip.place + k - from] = sum;
                }
            }
            found
        });
        let found = faults.into_iter().fold(Found::nothing(), Found::and);
        found.fault.map_or(Ok(true), Err)
    }
}

/// Adds what a slot has received in all parts.
#[inline(always)]
pub(super) fn add_received<R, S: Accumulate<R>, const TERM: usize>(
    sum: &mut [S; TERM],
    contributors: &[&Sums],
    slot: usize,
) {
    for (k, sum) in sum.iter_mut().enumerate() {
        let mut received = 0i64;
        for sums in contributors {
            received = received.wrapping_add(sums.of::<TERM>(slot, k));
        }
        *sum = sum.plus_quanta(received);
    }
}

/// Finishes the first sums of a strip and makes the words of them. `first` and `words` are the strip's.
#[inline(always)]
fn finish<A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize>(
    chain: &C,
    contributors: &[&Sums],
    strip: Strip,
    first: &mut [[C::FirstSum; FIRST]],
    words: &mut [Reals],
    found: &mut Found<READ>,
) where
    A: Arithmetic,
    C: Chain<A, D, READ, FIRST, SECOND>,
{
    // Nobody is in the last slots, and nothing is read of them.
    if let Some(last) = words.len().checked_sub(READ) {
        words[last..].fill(Reals::default());
    }
    for (k, first) in first.iter_mut().enumerate() {
        let (place, slot) = (strip.place + k, strip.slot + k);
        let mut sum = chain.start(place);
        add_received::<A::Real, _, FIRST>(&mut sum, contributors, slot);
        *first = chain.finish(place, sum);
        match chain.between(place, first) {
            Ok(word) => {
                for (c, word) in word.iter().enumerate() {
                    let word = word.quanta();
                    words[k / ROW * READ + c].0[k % ROW] = word;
                    found.largest[c] = larger(found.largest[c], word);
                }
            }
            Err(fault) => found.fault(fault),
        }
    }
}

/// One part goes up its strips.
struct Going<'a, A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize>
where
    A: Arithmetic,
    C: Chain<A, D, READ, FIRST, SECOND>,
{
    chain: &'a C,
    layout: &'a Layout,
    strips: Range<usize>,
    /// Of the particles of the part.
    first: &'a mut [[C::FirstSum; FIRST]],
    /// Of the rows of the part.
    words: &'a mut [Reals],
    sums: &'a mut [Sums; 2],
    arguments: &'a mut Arguments,
    arithmetic: PhantomData<A>,
}

impl<A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize> Work
    for Going<'_, A, C, D, READ, FIRST, SECOND>
where
    A: Arithmetic,
    C: Chain<A, D, READ, FIRST, SECOND>,
{
    type Output = Found<READ>;
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) -> Found<READ> {
        let layout = self.layout;
        let mut found = Found::nothing();
        let reached = layout.rows_reached::<D>(&self.strips);
        let [firsts, seconds] = self.sums;
        firsts.prepare(reached.clone(), FIRST);
        seconds.prepare(reached.clone(), SECOND);
        firsts.clear_some(layout.strips[self.strips.start].rows(), FIRST);
        let inner = inner(&self.strips, layout.strips.len() - 1);
        let (row_from, place_from) = (reached.start, layout.places_of(&self.strips).start);
        for s in self.strips.start..self.strips.end + 2 {
            // Cleared shortly before they are added to, while they are in the cache anyway.
            if let Some(strip) = layout.strips.get(s) {
                seconds.clear_some(strip.rows(), SECOND);
            }
            if let Some(strip) = layout.strips.get(s + 1) {
                firsts.clear_some(strip.rows(), FIRST);
            }
            let now = self.strips.contains(&s).then_some(s);
            let past = s.checked_sub(2).filter(|past| inner.contains(past));
            let mut fresh = std::mem::take(&mut self.arguments[s % 3]);
            let known = std::mem::take(&mut self.arguments[(s + 1) % 3]);
            let words = (&*self.words, row_from);
            let mut first =
                Leg::<A, _, D, 0, FIRST>::new(self.chain.first(), layout, now, (&[], 0), firsts);
            let mut second = Leg::<A, _, D, READ, SECOND>::new(
                self.chain.second(),
                layout,
                past,
                words,
                seconds,
            );
            if fresh.len() < first.arguments() {
                fresh.resize(first.arguments(), Reals::default());
            }
            let known_ones = &known[..second.arguments()];
            first.along_with(simd, &mut fresh, &mut second, known_ones);
            self.arguments[s % 3] = fresh;
            self.arguments[(s + 1) % 3] = known;
            // The first sum of a part's first strip waits for the part before.
            if let Some(strip) = now.filter(|&s| s > self.strips.start || s == 0) {
                let strip = layout.strips[strip];
                let places = strip.place - place_from..strip.place - place_from + strip.len;
                let rows = strip.rows();
                let rows = (rows.start - row_from) * READ..(rows.end - row_from) * READ;
                let (out, words) = (&mut self.first[places], &mut self.words[rows]);
                finish::<A, C, D, READ, FIRST, SECOND>(
                    self.chain,
                    &[&*firsts],
                    strip,
                    out,
                    words,
                    &mut found,
                );
            }
        }
        found
    }
}

/// The second sums that a part could not take as it went.
struct Rest<'a, A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize> {
    chain: &'a C,
    layout: &'a Layout,
    strips: Range<usize>,
    words: &'a [Reals],
    sums: &'a mut Sums,
    arithmetic: PhantomData<A>,
}

impl<A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize> Work
    for Rest<'_, A, C, D, READ, FIRST, SECOND>
where
    A: Arithmetic,
    C: Chain<A, D, READ, FIRST, SECOND>,
{
    type Output = ();
    #[inline(always)]
    fn run<Q: Quad>(self, simd: Q) {
        let layout = self.layout;
        let inner = inner(&self.strips, layout.strips.len() - 1);
        for s in self.strips.filter(|s| !inner.contains(s)) {
            let words = (self.words, 0);
            let pass = self.chain.second();
            Leg::<A, _, D, READ, SECOND>::new(pass, layout, Some(s), words, self.sums).alone(simd);
        }
    }
}
