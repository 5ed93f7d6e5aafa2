//! Executors: who walks the particles and the pairs.
//!
//! [`Serial`] is the readable reference. The runner adds parallel ones; one conformance suite
//! holds them all to equal bits.

use crate::fault::{Fault, FaultKind};
use crate::number::Arithmetic;
use crate::pairs::{PairPass, Sources, gather};

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
        let mut first: Option<Fault> = None;
        for (i, item) in items.iter_mut().enumerate() {
            if let Err(fault) = f(i, item) {
                first = Some(first.map_or(fault, |other| other.first(fault)));
            }
        }
        first.map_or(Ok(()), Err)
    }
}
