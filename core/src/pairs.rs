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
use crate::number::{Arithmetic, Quantity, Real};

/// How a term changes when the two particles are exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// The partner receives the same (densities).
    Symmetric,
    /// The partner receives the negative (impulses): linear momentum is conserved exactly.
    Antisymmetric,
}

/// One sum over pairs, written once for every executor.
pub trait PairPass<A: Arithmetic, const D: usize>: Sync {
    /// What the term needs of each particle besides its position.
    type Read: Copy + Sync;
    /// The term before rounding, in quanta of the sum.
    type Term: Copy;
    /// The integers that are summed.
    type Sum: Copy + Send + Sync;
    /// Behaviour under exchange of the pair.
    const PARITY: Parity;
    /// Squared distance, in length quanta, from which on the term is zero.
    fn reach_squared(&self) -> A::Real;
    /// The term for x_ij = x_i - x_j (length quanta) and r² = |x_ij|².
    fn term(&self, x_ij: &[A::Real; D], r2: A::Real, i: Self::Read, j: Self::Read) -> Self::Term;
    /// Rounds the term into the sum; `None` where a component is out of range.
    fn add(sum: &Self::Sum, term: Self::Term) -> Option<Self::Sum>;
}

/// The particles a sum runs over: positions, what the pass reads of them, and their cells.
#[derive(Debug)]
pub struct Sources<'a, A: Arithmetic, T, const D: usize> {
    /// Cells of this set.
    pub grid: &'a Grid<D>,
    /// The set sorted into the cells.
    pub cells: CellsView<'a>,
    /// Positions.
    pub position: &'a [[A::Length; D]],
    /// What the pass reads.
    pub read: &'a [T],
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

/// Adds to `sum` the terms of one particle at `x_i` with all `from` but index `skip`.
///
/// The plain traversal: every candidate of the 3^D cells, one after another. It is the reference
/// that faster ones must equal.
pub fn gather<A, P, const D: usize>(
    pass: &P,
    x_i: &[A::Length; D],
    read_i: P::Read,
    from: &Sources<'_, A, P::Read, D>,
    skip: Option<usize>,
    sum: &mut P::Sum,
) -> Result<(), FaultKind>
where
    A: Arithmetic,
    P: PairPass<A, D>,
{
    let reach_squared = pass.reach_squared();
    let skip = skip.map_or(u32::MAX, |i| i as u32);
    let mut neighbours = 0u32;
    let mut result = Ok(());
    from.cells.around(from.grid, x_i, |run| {
        for &j in run {
            let (x_ij, r2) = separation::<A, D>(x_i, &from.position[j as usize]);
            if r2 < reach_squared && j != skip {
                neighbours += 1;
                let term = pass.term(&x_ij, r2, read_i, from.read[j as usize]);
                match P::add(sum, term) {
                    Some(new) => *sum = new,
                    None => result = Err(FaultKind::TermRange),
                }
            }
        }
    });
    if neighbours > MAX_NEIGHBOURS {
        return Err(FaultKind::Crowded);
    }
    result
}

/// Σ of one rounded scalar.
#[inline]
pub(crate) fn add_scalar<Q: Quantity, R: Real>(sum: &Q, term: R) -> Option<Q> {
    sum.add_rounded(term)
}

/// Σ of a vector, each component rounded by itself.
#[inline]
pub(crate) fn add_vector<Q: Quantity, R: Real, const D: usize>(
    sum: &[Q; D],
    term: [R; D],
) -> Option<[Q; D]> {
    let mut new = *sum;
    for d in 0..D {
        new[d] = sum[d].add_rounded(term[d])?;
    }
    Some(new)
}
