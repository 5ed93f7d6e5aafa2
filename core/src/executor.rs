//! Executors: who walks the particles and the pairs.
//!
//! [`Serial`] is the readable reference. The runner adds parallel ones; one conformance suite
//! holds them all to equal bits.

use crate::chain::{Chain, ChainSet, SumsOf, chain_in_turn};
use crate::fault::{Fault, FaultKind};
use crate::neighbours::{Cells, Grid};
use crate::number::Arithmetic;
use crate::pairs::{PairPass, Sources, gather};
use crate::state::State;

/// The particles that receive a sum.
#[derive(Debug)]
pub struct Targets<'a, A: Arithmetic, T, const D: usize, const READ: usize> {
    /// Positions.
    pub position: &'a [[A::Length; D]],
    /// What the pass reads of them.
    pub read: &'a [[T; READ]],
    /// Ids, to name a particle that fails.
    pub id: Ids<'a>,
    /// True where targets and sources are the same set: a particle is not its own neighbour.
    pub same_set: bool,
}

/// Ids of a set of particles.
#[derive(Clone, Copy, Debug)]
pub enum Ids<'a> {
    /// Read from the state.
    Listed(&'a [u64]),
    /// Counted up from a first one (walls).
    From(u64),
}

impl Ids<'_> {
    /// The id at this place.
    #[must_use]
    pub fn get(&self, i: usize) -> u64 {
        match self {
            Self::Listed(id) => id[i],
            Self::From(first) => first + i as u64,
        }
    }
}

/// Owns the traversal of particles and pairs; never a number.
pub trait Executor {
    /// Name shown to people.
    fn name(&self) -> &'static str;

    /// Calls `f(i, &mut items[i])` for every i, in any order, possibly at once.
    ///
    /// # Errors
    /// The fault of the smallest id among all that failed.
    fn for_each<T: Send>(
        &self,
        items: &mut [T],
        f: impl Fn(usize, &mut T) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault>;

    /// Calls `f(i, &mut a[i], &mut b[i])` for every i, in any order, possibly at once.
    ///
    /// # Errors
    /// The fault of the smallest id among all that failed.
    fn for_both<T: Send, U: Send>(
        &self,
        a: &mut [T],
        b: &mut [U],
        f: impl Fn(usize, &mut T, &mut U) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault>;

    /// Makes the neighbours of the fluid findable after it has moved: sorts it into `cells`, or into
    /// whatever the executor finds them in. With `for_others`, particles of another set (walls) will
    /// look for the fluid too, in `cells`. The executor may change the storage order of the state:
    /// ids travel along, and what the scratch held is of no use afterwards.
    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        state: &mut State<'_, A, D>,
        cells: &mut Cells<'_>,
        for_others: bool,
    ) {
        let _ = for_others;
        cells.sort(grid, state.position);
    }

    /// Makes particles of the walls findable in `cells`: called before the first sum, and whenever
    /// they may have moved.
    fn locate_walls<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        position: &[[A::Length; D]],
        cells: &mut Cells<'_>,
    ) {
        cells.sort(grid, position);
    }

    /// Adds to every `out[i]` the terms of target i with all sources.
    ///
    /// # Errors
    /// [`FaultKind::TermRange`] and [`FaultKind::Crowded`], naming the target.
    fn sum<A, P, const D: usize, const READ: usize, const TERM: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, P::Word, D, READ>,
        from: &Sources<'_, A, P::Word, D, READ>,
        out: &mut [[P::Sum; TERM]],
    ) -> Result<(), Fault>
    where
        A: Arithmetic,
        P: PairPass<A, D, READ, TERM>,
    {
        self.for_each(out, |i, sum| {
            let skip = to.same_set.then_some(i);
            gather(pass, &to.position[i], &to.read[i], from, skip, sum)
                .map_err(|kind: FaultKind| Fault::new(kind, to.id.get(i)))
        })
    }

    /// The two sums of a chain, over a set and itself; `sums` are overwritten.
    ///
    /// # Errors
    /// As [`Executor::sum`], and what the chain finds.
    fn chain<A, C, const D: usize, const READ: usize, const FIRST: usize, const SECOND: usize>(
        &self,
        chain: &C,
        set: &ChainSet<'_, A, D>,
        sums: SumsOf<'_, A, C, D, READ, FIRST, SECOND>,
    ) -> Result<(), Fault>
    where
        A: Arithmetic,
        C: Chain<A, D, READ, FIRST, SECOND>,
    {
        chain_in_turn(self, chain, set, sums)
    }
}

/// One particle after another.
#[derive(Clone, Copy, Debug, Default)]
pub struct Serial;

impl Executor for Serial {
    fn name(&self) -> &'static str {
        "serial"
    }

    fn for_each<T: Send>(
        &self,
        items: &mut [T],
        f: impl Fn(usize, &mut T) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        first_fault(items.iter_mut().enumerate(), |(i, item)| f(i, item))
    }

    fn for_both<T: Send, U: Send>(
        &self,
        a: &mut [T],
        b: &mut [U],
        f: impl Fn(usize, &mut T, &mut U) -> Result<(), Fault> + Sync,
    ) -> Result<(), Fault> {
        first_fault(a.iter_mut().zip(b).enumerate(), |(i, (a, b))| f(i, a, b))
    }
}

/// Does all, and returns the fault of the smallest id.
fn first_fault<T>(
    items: impl Iterator<Item = T>,
    f: impl Fn(T) -> Result<(), Fault>,
) -> Result<(), Fault> {
    let mut first: Option<Fault> = None;
    for item in items {
        if let Err(fault) = f(item) {
            first = Some(first.map_or(fault, |other| other.first(fault)));
        }
    }
    first.map_or(Ok(()), Err)
}
