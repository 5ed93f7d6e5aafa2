//! Sums over pairs: the model says what a pair contributes, an executor says who walks the pairs.
//!
//! A pass declares the sum
//!
//! S_i = Σ_j R(term(x_i - x_j, read_i, read_j)),
//!
//! where R rounds to whole quanta, of a floating-point state to whole [grains](Grain). The terms are
//! integers once they are rounded, so no order of the j, no partition among threads and no SIMD
//! width changes S_i. [`Parity`] tells an executor that walks half of the pairs what the partner
//! receives.

use crate::fault::{FaultKind, MAX_NEIGHBOURS};
use crate::neighbours::{CellsView, Grid};
use crate::number::{Accumulate, Arithmetic, Grain, Lanes, PairSum, Quantity, larger};
use crate::set::{Column, read};
use crate::values::Values;

/// How a term changes when the two particles are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// The partner receives the same (densities).
    Symmetric,
    /// The partner receives the negative (impulses): linear momentum is conserved exactly.
    Antisymmetric,
}

/// One sum over pairs, or several at once, written once for every executor.
///
/// `Read` and `Term` are small structs with named numbers ([`values!`](crate::values!)), vectors
/// `[T; D]` or single numbers; an executor evaluates the term for one pair or for a row of them.
pub trait PairPass<const D: usize>: Sync {
    /// What the term needs of each particle besides its position.
    type Read<T: Copy>: Values<T>;
    /// What a pair contributes; each number is a sum with a quantum of its own.
    type Term<T: Copy>: Values<T>;
    /// Behaviour of each number of the term under exchange of the pair.
    const PARITY: Self::Term<Parity>;
    /// Squared distance, in length quanta, from which on the term is zero. The expression of
    /// [`PairPass::term`] must give zero there by itself: executors evaluate it for more distant
    /// pairs too.
    fn reach_squared(&self) -> f64;
    /// A number that no number of a term exceeds in magnitude where nothing that is read of either
    /// particle exceeds `largest`; infinite where there is none. It is what allows an executor to
    /// leave out the check of the range of each term.
    fn bound(&self, largest: &Self::Read<f64>) -> f64 {
        let _ = largest;
        f64::INFINITY
    }
    /// The same for each number by itself, none above [`PairPass::bound`]: what floating-point sums
    /// are rounded to. Where a model sums some numbers of a pass by another one, or not at all while
    /// what they depend on stays, their bounds must depend on no more.
    fn bounds(&self, largest: &Self::Read<f64>) -> Self::Term<f64> {
        let bound = self.bound(largest);
        Self::Term::<f64>::from_fn(|_| bound)
    }
    /// What the term needs of r² = |x_ij|² (length quanta squared); passes that need the same can
    /// share it.
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        r2
    }
    /// The term, in quanta of its sums and not yet rounded, for x_ij = x_i - x_j (length quanta),
    /// the argument of |x_ij|², and what is read of i and j (in quanta of their fields). Two
    /// particles may be in one place: the term must be finite at a distance of zero.
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        argument: L,
        i: &Self::Read<L>,
        j: &Self::Read<L>,
    ) -> Self::Term<L>;
}

/// Numbers that a pass reads of each particle.
#[must_use]
pub const fn read_count<P: PairPass<D>, const D: usize>() -> usize {
    <P::Read<f64> as Values<f64>>::COUNT
}

/// Numbers of a term.
#[must_use]
pub const fn term_count<P: PairPass<D>, const D: usize>() -> usize {
    <P::Term<f64> as Values<f64>>::COUNT
}

/// The particles that receive a sum.
#[derive(Clone, Copy, Debug)]
pub struct Targets<'a, A: Arithmetic, const D: usize> {
    /// Positions.
    pub position: &'a [[A::Length; D]],
    /// What the pass reads of them.
    pub read: &'a [Column<'a, A::Word>],
    /// Ids, to name a particle that fails.
    pub id: &'a [u64],
    /// True where targets and sources are the same set: a particle is not its own neighbour.
    pub same_set: bool,
}

/// The particles a sum runs over: positions, what the pass reads of them, and their cells.
#[derive(Clone, Copy, Debug)]
pub struct Sources<'a, A: Arithmetic, const D: usize> {
    /// Cells of this set.
    pub grid: &'a Grid<D>,
    /// The set sorted into the cells.
    pub cells: CellsView<'a>,
    /// Positions.
    pub position: &'a [[A::Length; D]],
    /// What the pass reads.
    pub read: &'a [Column<'a, A::Word>],
}

/// The largest magnitude of each number that a pass reads of the targets; a NaN before all.
#[must_use]
pub fn largest<A: Arithmetic, P: PairPass<D>, const D: usize>(
    to: &Targets<'_, A, D>,
) -> P::Read<f64> {
    let mut largest = P::Read::<f64>::from_fn(|_| 0.0);
    for place in 0..to.position.len() {
        let values: P::Read<f64> = read(to.read, place);
        for c in 0..read_count::<P, D>() {
            largest.set(c, larger(largest.get(c), values.get(c)));
        }
    }
    largest
}

/// What a sum is rounded to where no term exceeds `bound`.
#[must_use]
pub fn grain_under<A: Arithmetic>(bound: f64) -> Grain {
    if A::EXACT {
        Grain::QUANTUM
    } else {
        Grain::under(bound)
    }
}

/// What the numbers of a term are rounded to where nothing that is read exceeds `largest`.
#[must_use]
pub fn grains_under<A: Arithmetic, P: PairPass<D>, const D: usize>(
    pass: &P,
    largest: &P::Read<f64>,
) -> P::Term<Grain> {
    let bounds = pass.bounds(largest);
    P::Term::<Grain>::from_fn(|k| grain_under::<A>(bounds.get(k)))
}

/// What the numbers of a term are rounded to, whoever takes the sum.
#[must_use]
pub fn grains<A: Arithmetic, P: PairPass<D>, const D: usize>(
    pass: &P,
    to: &Targets<'_, A, D>,
) -> P::Term<Grain> {
    // The particles of another set, walls, are near to few: their sums may take longer.
    if A::EXACT || !to.same_set {
        return P::Term::<Grain>::from_fn(|_| grain_under::<A>(f64::INFINITY));
    }
    grains_under::<A, P, D>(pass, &largest::<A, P, D>(to))
}

/// A term's sums without terms yet, number k of which is rounded to `grain(k)`.
#[inline]
#[must_use]
pub fn empty<A: Arithmetic, V: Values<A::Sum>>(grain: impl Fn(usize) -> Grain) -> V {
    V::from_fn(|k| A::Sum::empty(grain(k)))
}

/// Adds a term's sums to the words of a target.
#[inline]
pub fn add<A: Arithmetic, V: Values<A::Sum>>(sum: &V, out: &mut [A::Word]) {
    for (k, out) in out.iter_mut().enumerate() {
        *out = sum.get(k).added_to(*out);
    }
}

/// x_i - x_j in length quanta, and its square.
#[inline(always)]
pub fn separation<A: Arithmetic, const D: usize>(
    x_i: &[A::Length; D],
    x_j: &[A::Length; D],
) -> ([f64; D], f64) {
    let mut x_ij = [0.0; D];
    for d in 0..D {
        x_ij[d] = x_i[d].difference(x_j[d]);
    }
    let mut r2 = x_ij[0] * x_ij[0];
    for x in &x_ij[1..] {
        r2 += *x * *x;
    }
    (x_ij, r2)
}

/// Adds a term to a sum, each number rounded by itself; false where one is out of range.
#[inline(always)]
pub fn accumulate<S: Accumulate, V: Values<S>, T: Values<f64>>(sum: &mut V, term: &T) -> bool {
    for k in 0..T::COUNT {
        match sum.get(k).accumulate(term.get(k)) {
            Some(new) => sum.set(k, new),
            None => return false,
        }
    }
    true
}

/// Adds to `sum` the terms of target `i` with all `from` but itself.
///
/// The plain traversal: every candidate of the 3^D cells, one after another. It is the reference
/// that faster ones must equal.
///
/// # Errors
/// [`FaultKind::TermRange`] and [`FaultKind::Crowded`]; the sum is then of no use.
pub fn gather<A, P, S, const D: usize>(
    pass: &P,
    to: &Targets<'_, A, D>,
    i: usize,
    from: &Sources<'_, A, D>,
    sum: &mut P::Term<S>,
) -> Result<(), FaultKind>
where
    A: Arithmetic,
    P: PairPass<D>,
    S: Accumulate,
{
    let mut gathering = Gathering::new(pass, to, i, from, sum);
    from.cells
        .around(from.grid, &to.position[i], |run| gathering.add(run));
    gathering.end()
}

/// One particle's sum while its candidates come in.
pub struct Gathering<'a, A: Arithmetic, P: PairPass<D>, S: Copy, const D: usize> {
    pass: &'a P,
    x_i: &'a [A::Length; D],
    read_i: P::Read<f64>,
    from: &'a Sources<'a, A, D>,
    skip: u32,
    sum: &'a mut P::Term<S>,
    neighbours: u32,
    in_range: bool,
}

impl<'a, A: Arithmetic, P: PairPass<D>, S: Accumulate, const D: usize> Gathering<'a, A, P, S, D> {
    /// See [`gather`].
    #[inline]
    pub fn new(
        pass: &'a P,
        to: &Targets<'a, A, D>,
        i: usize,
        from: &'a Sources<'a, A, D>,
        sum: &'a mut P::Term<S>,
    ) -> Self {
        Self {
            pass,
            x_i: &to.position[i],
            read_i: read(to.read, i),
            from,
            skip: if to.same_set { i as u32 } else { u32::MAX },
            sum,
            neighbours: 0,
            in_range: true,
        }
    }

    /// Adds the terms of those candidates that are within reach.
    #[inline(always)]
    pub fn add(&mut self, candidates: &[u32]) {
        let (pass, from, skip) = (self.pass, self.from, self.skip);
        let (x_i, read_i) = (*self.x_i, self.read_i);
        let reach_squared = pass.reach_squared();
        let mut sum = *self.sum;
        for &j in candidates {
            let (x_ij, r2) = separation::<A, D>(&x_i, &from.position[j as usize]);
            if r2 < reach_squared && j != skip {
                self.neighbours += 1;
                let read_j = read(from.read, j as usize);
                let term = pass.term(&x_ij, pass.argument(r2), &read_i, &read_j);
                self.in_range &= accumulate(&mut sum, &term);
            }
        }
        *self.sum = sum;
    }

    /// # Errors
    /// See [`gather`].
    #[inline]
    pub fn end(self) -> Result<(), FaultKind> {
        if self.neighbours > MAX_NEIGHBOURS {
            Err(FaultKind::Crowded)
        } else if self.in_range {
            Ok(())
        } else {
            Err(FaultKind::TermRange)
        }
    }
}
