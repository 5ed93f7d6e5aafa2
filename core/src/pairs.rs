//! Sums over pairs: the model says what a pair contributes, an executor says who walks the pairs.
//!
//! A pass declares the sum
//!
//! S_i = Σ_j R(term(x_i - x_j, read_i, read_j)),
//!
//! where R rounds to whole quanta. The terms are integers once they are rounded, so no order of
//! the j, no partition among threads and no SIMD width changes S_i. [`Parity`] tells an executor
//! that walks half of the pairs what the partner receives.

use crate::fault::{FaultKind, MAX_NEIGHBOURS};
use crate::neighbours::{CellsView, Grid};
use crate::number::{Accumulate, Arithmetic, Lanes, Quantity, Real};

/// How a term changes when the two particles are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// The partner receives the same (densities).
    Symmetric,
    /// The partner receives the negative (impulses): linear momentum is conserved exactly.
    Antisymmetric,
}

/// One sum over pairs, written once for every executor.
///
/// READ is the number of words the term needs of each particle besides its position, TERM the
/// number of components of the term.
pub trait PairPass<A: Arithmetic, const D: usize, const READ: usize, const TERM: usize>:
    Sync
{
    /// What is read of each particle.
    type Word: Quantity;
    /// The exact numbers that are summed.
    type Sum: Accumulate<A::Real>;
    /// Behaviour under exchange of the pair.
    const PARITY: Parity;
    /// Squared distance, in length quanta, from which on the term is zero.
    fn reach_squared(&self) -> A::Real;
    /// A number that no component of a term exceeds in magnitude where no word of either particle
    /// exceeds `largest`; infinite where there is none.
    fn bound(&self, largest: &[A::Real; READ]) -> f64;
    /// What the term needs of r² = |x_ij|² (length quanta squared); passes that need the same can
    /// share it.
    fn argument<L: Lanes<A::Real>>(&self, r2: L) -> L;
    /// The term, in quanta of the sum and not yet rounded, for x_ij = x_i - x_j (length quanta),
    /// the argument of |x_ij|² and the words of i and j in quanta.
    fn term<L: Lanes<A::Real>>(
        &self,
        x_ij: &[L; D],
        argument: L,
        i: &[L; READ],
        j: &[L; READ],
    ) -> [L; TERM];
}

/// The particles a sum runs over: positions, what the pass reads of them, and their cells.
#[derive(Debug)]
pub struct Sources<'a, A: Arithmetic, T, const D: usize, const READ: usize> {
    /// Cells of this set.
    pub grid: &'a Grid<D>,
    /// The set sorted into the cells.
    pub cells: CellsView<'a>,
    /// Positions.
    pub position: &'a [[A::Length; D]],
    /// What the pass reads.
    pub read: &'a [[T; READ]],
}

/// x_i - x_j in length quanta, and its square.
#[inline]
pub fn separation<A: Arithmetic, const D: usize>(
    x_i: &[A::Length; D],
    x_j: &[A::Length; D],
) -> ([A::Real; D], A::Real) {
    let x_ij: [A::Real; D] = core::array::from_fn(|d| x_i[d].difference(x_j[d]));
    let mut r2 = x_ij[0] * x_ij[0];
    for x in &x_ij[1..] {
        r2 = r2 + *x * *x;
    }
    (x_ij, r2)
}

/// Words as reals, in quanta.
#[inline]
pub fn read<R: Real, Q: Quantity, const READ: usize>(words: &[Q; READ]) -> [R; READ] {
    words.map(Quantity::quanta)
}

/// Adds a term to a sum, each component rounded by itself; false where one is out of range.
#[inline]
pub fn accumulate<S: Accumulate<R>, R: Copy, const TERM: usize>(
    sum: &mut [S; TERM],
    term: [R; TERM],
) -> bool {
    for (sum, term) in sum.iter_mut().zip(term) {
        match sum.accumulate(term) {
            Some(new) => *sum = new,
            None => return false,
        }
    }
    true
}

/// Adds to `sum` the terms of one particle at `x_i` with all `from` but index `skip`.
///
/// The plain traversal: every candidate of the 3^D cells, one after another. It is the reference
/// that faster ones must equal.
///
/// # Errors
/// [`FaultKind::TermRange`] and [`FaultKind::Crowded`]; the sum is then of no use.
pub fn gather<A, P, const D: usize, const READ: usize, const TERM: usize>(
    pass: &P,
    x_i: &[A::Length; D],
    read_i: &[P::Word; READ],
    from: &Sources<'_, A, P::Word, D, READ>,
    skip: Option<usize>,
    sum: &mut [P::Sum; TERM],
) -> Result<(), FaultKind>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    let mut gathering = Gathering::new(pass, x_i, read_i, from, skip, sum);
    from.cells.around(from.grid, x_i, |run| gathering.add(run));
    gathering.end()
}

/// One particle's sum while its candidates come in.
#[derive(Debug)]
pub struct Gathering<'a, A, P, const D: usize, const READ: usize, const TERM: usize>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    pass: &'a P,
    x_i: &'a [A::Length; D],
    read_i: [A::Real; READ],
    from: &'a Sources<'a, A, P::Word, D, READ>,
    skip: u32,
    sum: &'a mut [P::Sum; TERM],
    neighbours: u32,
    in_range: bool,
}

impl<'a, A, P, const D: usize, const READ: usize, const TERM: usize>
    Gathering<'a, A, P, D, READ, TERM>
where
    A: Arithmetic,
    P: PairPass<A, D, READ, TERM>,
{
    /// See [`gather`].
    #[inline]
    pub fn new(
        pass: &'a P,
        x_i: &'a [A::Length; D],
        read_i: &[P::Word; READ],
        from: &'a Sources<'a, A, P::Word, D, READ>,
        skip: Option<usize>,
        sum: &'a mut [P::Sum; TERM],
    ) -> Self {
        Self {
            pass,
            x_i,
            read_i: read(read_i),
            from,
            skip: skip.map_or(u32::MAX, |i| i as u32),
            sum,
            neighbours: 0,
            in_range: true,
        }
    }

    /// Adds the terms of those candidates that are within reach.
    #[inline]
    pub fn add(&mut self, candidates: &[u32]) {
        let reach_squared = self.pass.reach_squared();
        for &j in candidates {
            let (x_ij, r2) = separation::<A, D>(self.x_i, &self.from.position[j as usize]);
            if r2 < reach_squared && j != self.skip {
                self.neighbours += 1;
                let read_j = read(&self.from.read[j as usize]);
                let argument = self.pass.argument(r2);
                let term = self.pass.term(&x_ij, argument, &self.read_i, &read_j);
                self.in_range &= accumulate(self.sum, term);
            }
        }
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
