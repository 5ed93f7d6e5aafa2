//! Sums over all pairs, for energies.

use crate::exact::ExactSum;
use crate::fault::Fault;
use crate::fields::Side;
use crate::number::Arithmetic;
use crate::pairs::{PairPass, Sources, Targets, gather};
use crate::system::System;

/// Adds to `sum` the terms of all particles that move with the particles of one side, `times` over.
/// Each pair of moving particles is met twice. Nothing is read of a particle but its position. The
/// particles must have been located for others ([`System::locate`]) since they moved.
///
/// # Errors
/// A particle with too many neighbours.
pub fn sum_over_pairs<A: Arithmetic, P: PairPass<D, Term<ExactSum> = ExactSum>, const D: usize>(
    system: &System<'_, A, D>,
    pass: &P,
    from: Side,
    times: usize,
    mut sum: ExactSum,
) -> Result<ExactSum, Fault> {
    let (particles, ..) = system.side(Side::Particles);
    let (others, cells, grid) = system.side(from);
    let to: Targets<'_, A, D> = Targets {
        position: particles.position(),
        read: &[],
        id: particles.id,
        same_set: from == Side::Particles,
    };
    let from: Sources<'_, A, D> = Sources {
        grid,
        cells,
        position: others.position(),
        read: &[],
    };
    for (i, id) in particles.id.iter().enumerate() {
        for _ in 0..times {
            gather::<A, P, ExactSum, D>(pass, &to, i, &from, &mut sum)
                .map_err(|kind| Fault::new(kind, *id))?;
        }
    }
    Ok(sum)
}
