//! Two sums in a row: densities, then the impulses of their pressures.
//!
//! A chain is
//!
//! S_i = start_i + Σ_j R(first(x_ij)), finished;  w_i = between(S_i);
//! T_i = resume_i + Σ_j R(second(x_ij, w_i, w_j)).
//!
//! Both sums run over the same pairs, and their terms need the same function of the distance
//! ([`PairPass::argument`]). [`chain_in_turn`] is what a chain means; an executor may walk the pairs
//! once for both.

use crate::executor::{Executor, Ids, Targets};
use crate::fault::Fault;
use crate::neighbours::{CellsView, Grid};
use crate::number::{Accumulate, Arithmetic, Quantity};
use crate::pairs::{PairPass, Sources};

/// What the chain is made of. FIRST and SECOND are the numbers of components of the sums, READ
/// that of the words read in between.
pub trait Chain<
    A: Arithmetic,
    const D: usize,
    const READ: usize,
    const FIRST: usize,
    const SECOND: usize,
>: Sync
{
    /// Number of the first sum.
    type FirstSum: Accumulate<A::Real>;
    /// What the second pass reads.
    type Word: Quantity;
    /// Number of the second sum.
    type SecondSum: Accumulate<A::Real>;
    /// The pass of the first sum, of positions alone.
    type First: PairPass<A, D, 0, FIRST, Sum = Self::FirstSum>;
    /// The pass of the second sum; its argument is that of the first.
    type Second: PairPass<A, D, READ, SECOND, Word = Self::Word, Sum = Self::SecondSum>;

    /// The first pass.
    fn first(&self) -> &Self::First;
    /// The second pass.
    fn second(&self) -> &Self::Second;
    /// What the first sum of the particle in place `i` begins with.
    fn start(&self, i: usize) -> [Self::FirstSum; FIRST];
    /// The first sum when all terms are in.
    fn finish(&self, i: usize, sum: [Self::FirstSum; FIRST]) -> [Self::FirstSum; FIRST];
    /// What is read of the particle, from its finished first sum.
    ///
    /// # Errors
    /// A sum of which nothing can be made, naming the particle.
    fn between(&self, i: usize, sum: &[Self::FirstSum; FIRST])
    -> Result<[Self::Word; READ], Fault>;
    /// What the second sum of the particle begins with.
    ///
    /// # Errors
    /// A number out of range, naming the particle.
    fn resume(&self, i: usize) -> Result<[Self::SecondSum; SECOND], Fault>;
}

/// The particles of a chain, each other's neighbours.
#[derive(Debug)]
pub struct ChainSet<'a, A: Arithmetic, const D: usize> {
    /// Cells of the set.
    pub grid: &'a Grid<D>,
    /// The set sorted into the cells.
    pub cells: CellsView<'a>,
    /// Positions.
    pub position: &'a [[A::Length; D]],
    /// Ids.
    pub id: &'a [u64],
}

impl<'a, A: Arithmetic, const D: usize> ChainSet<'a, A, D> {
    /// As targets and sources of one sum.
    #[must_use]
    pub fn with<T, const READ: usize>(
        &self,
        read: &'a [[T; READ]],
    ) -> (Targets<'a, A, T, D, READ>, Sources<'a, A, T, D, READ>) {
        let to = Targets {
            position: self.position,
            read,
            id: Ids::Listed(self.id),
            same_set: true,
        };
        let from = Sources {
            grid: self.grid,
            cells: self.cells,
            position: self.position,
            read,
        };
        (to, from)
    }
}

/// Memory for the sums of a chain and for what is read in between, by particle; its contents do
/// not matter.
#[derive(Debug)]
pub struct ChainSums<'a, S, W, T, const READ: usize, const FIRST: usize, const SECOND: usize> {
    /// First sums.
    pub first: &'a mut [[S; FIRST]],
    /// What is read; an executor with memory of its own need not fill it.
    pub words: &'a mut [[W; READ]],
    /// Second sums.
    pub second: &'a mut [[T; SECOND]],
}

/// The memory for a chain C.
pub type SumsOf<
    'a,
    A,
    C,
    const D: usize,
    const READ: usize,
    const FIRST: usize,
    const SECOND: usize,
> = ChainSums<
    'a,
    <C as Chain<A, D, READ, FIRST, SECOND>>::FirstSum,
    <C as Chain<A, D, READ, FIRST, SECOND>>::Word,
    <C as Chain<A, D, READ, FIRST, SECOND>>::SecondSum,
    READ,
    FIRST,
    SECOND,
>;

/// A chain as what it means: one sum, then the other.
///
/// # Errors
/// As [`Executor::chain`].
pub fn chain_in_turn<
    E,
    A,
    C,
    const D: usize,
    const READ: usize,
    const FIRST: usize,
    const SECOND: usize,
>(
    executor: &E,
    chain: &C,
    set: &ChainSet<'_, A, D>,
    sums: SumsOf<'_, A, C, D, READ, FIRST, SECOND>,
) -> Result<(), Fault>
where
    E: Executor + ?Sized,
    A: Arithmetic,
    C: Chain<A, D, READ, FIRST, SECOND>,
{
    let ChainSums {
        first,
        words,
        second,
    } = sums;
    executor.for_each(first, |i, sum| {
        *sum = chain.start(i);
        Ok(())
    })?;
    let (to, from) = set.with(nothing());
    executor.sum(chain.first(), &to, &from, first)?;
    executor.for_each(first, |i, sum| {
        *sum = chain.finish(i, *sum);
        Ok(())
    })?;
    let first = &*first;
    executor.for_each(words, |i, words| {
        *words = chain.between(i, &first[i])?;
        Ok(())
    })?;
    executor.for_each(second, |i, sum| {
        *sum = chain.resume(i)?;
        Ok(())
    })?;
    let (to, from) = set.with(&*words);
    executor.sum(chain.second(), &to, &from, second)
}

/// As many empty arrays as anyone needs: what a pass reads that needs no more than positions.
#[must_use]
pub fn nothing<R>() -> &'static [[R; 0]] {
    const { &[const { [] }; u32::MAX as usize] }
}
