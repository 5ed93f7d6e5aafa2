//! Executors: who walks the particles and the pairs.
//!
//! [`Serial`] is the readable reference. The runner adds parallel ones; one conformance suite
//! holds them all to equal bits.

use crate::fault::Fault;
use crate::neighbours::{Cells, Grid};
use crate::number::Arithmetic;
use crate::pairs::{PairPass, Sources, Targets, add, empty, gather, grains, term_count};
use crate::points::{PointPass, visit};
use crate::set::Set;
use crate::values::Values;

/// Owns the traversal of particles and pairs; never a number.
pub trait Executor {
    /// Makes the neighbours of the particles findable after they have moved: sorts them into
    /// `cells`, or into whatever the executor finds them in. `cells` are read by others than the
    /// executor's sums over particles: by walls that look for particles, and by
    /// [`sum_over_pairs`](crate::observe::sum_over_pairs); whoever needs them says so with
    /// `for_others`. The executor may change the storage order of the particles: ids travel along,
    /// and what the scratch held is of no use afterwards.
    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        particles: &mut Set<'_, A, D>,
        cells: &mut Cells<'_>,
        for_others: bool,
    );

    /// Makes the walls findable in `cells`: called before the first sum, and whenever they may have
    /// moved.
    fn locate_walls<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        walls: &Set<'_, A, D>,
        cells: &mut Cells<'_>,
    ) {
        cells.sort(grid, walls.position());
    }

    /// Does `pass` to every particle of the set, in any order, possibly at once.
    ///
    /// # Errors
    /// The fault of the smallest id among all that failed.
    fn points<A: Arithmetic, P: PointPass<A, D>, const D: usize>(
        &self,
        pass: &P,
        set: &mut Set<'_, A, D>,
    ) -> Result<(), Fault>;

    /// Adds to `out`, a term's numbers for each target, the terms of the target with all sources.
    ///
    /// # Errors
    /// [`FaultKind::TermRange`] and [`FaultKind::Crowded`], naming the target of the smallest id.
    ///
    /// [`FaultKind::TermRange`]: crate::FaultKind::TermRange
    /// [`FaultKind::Crowded`]: crate::FaultKind::Crowded
    fn sum<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, D>,
        from: &Sources<'_, A, D>,
        out: &mut [A::Word],
    ) -> Result<(), Fault>;
}

/// One particle after another.
#[derive(Clone, Copy, Debug, Default)]
pub struct Serial;

impl Executor for Serial {
    fn locate<A: Arithmetic, const D: usize>(
        &self,
        grid: &Grid<D>,
        particles: &mut Set<'_, A, D>,
        cells: &mut Cells<'_>,
        _: bool,
    ) {
        cells.sort(grid, particles.position());
    }

    fn points<A: Arithmetic, P: PointPass<A, D>, const D: usize>(
        &self,
        pass: &P,
        set: &mut Set<'_, A, D>,
    ) -> Result<(), Fault> {
        visit(pass, &mut set.operands(P::READ, P::WRITE))
    }

    fn sum<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &self,
        pass: &P,
        to: &Targets<'_, A, D>,
        from: &Sources<'_, A, D>,
        out: &mut [A::Word],
    ) -> Result<(), Fault> {
        let mut first: Option<Fault> = None;
        let grains = grains(pass, to);
        for (i, out) in out.chunks_exact_mut(term_count::<P, D>()).enumerate() {
            let mut sum: P::Term<A::Sum> = empty::<A, _>(|k| grains.get(k));
            let result = gather(pass, to, i, from, &mut sum);
            add::<A, _>(&sum, out);
            if let Err(kind) = result {
                let fault = Fault::new(kind, to.id[i]);
                first = Some(first.map_or(fault, |other| other.first(fault)));
            }
        }
        first.map_or(Ok(()), Err)
    }
}
