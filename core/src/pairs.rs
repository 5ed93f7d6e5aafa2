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
    /// The term, in quanta of the sum and not yet rounded, for x_ij = x_i - x_j (length quanta),
    /// r² = |x_ij|² and the words of i and j in quanta.
    fn term<L: Lanes<A::Real>>(
        &self,
        x_ij: &[L; D],
        r2: L,
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
    let reach_squared = pass.reach_squared();
    let skip = skip.map_or(u32::MAX, |i| i as u32);
    let read_i = read(read_i);
    let mut neighbours = 0u32;
    let mut result = Ok(());
    from.cells.around(from.grid, x_i, |run| {
        for &j in run {
            let (x_ij, r2) = separation::<A, D>(x_i, &from.position[j as usize]);
            if r2 < reach_squared && j != skip {
                neighbours += 1;
                let read_j = read(&from.read[j as usize]);
                if !accumulate(sum, pass.term(&x_ij, r2, &read_i, &read_j)) {
                    result = Err(FaultKind::TermRange);
                }
            }
        }
    });
    if neighbours > MAX_NEIGHBOURS {
        return Err(FaultKind::Crowded);
    }
    result
}
