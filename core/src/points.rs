//! Point passes: what happens to one particle, whatever the others do.
//!
//! A kick adds an impulse to a velocity, a drift adds a velocity to a position. Like a pair pass, a
//! point pass is a named struct of a few numbers that says which fields it reads and which it
//! writes; an executor calls it for every particle, in any order, on any number of threads.

use crate::fault::Fault;
use crate::number::Arithmetic;
use crate::operands::Operands;
use crate::values::Values;

/// What happens to one particle.
pub trait PointPass<A: Arithmetic, const D: usize>: Sync {
    /// What is read of it.
    type Read<T: Copy>: Values<T>;
    /// What is changed of it.
    type Write<T: Copy>: Values<T>;
    /// Fields that are read, by their places in the model's list.
    const READ: &'static [usize];
    /// Fields that are changed.
    const WRITE: &'static [usize];
    /// Does it, to the particle with this id.
    ///
    /// # Errors
    /// A number out of range, naming the particle.
    fn at(
        &self,
        id: u64,
        read: &Self::Read<A::Word>,
        write: &mut Self::Write<A::Word>,
    ) -> Result<(), Fault>;
}

/// Does it to all these particles, one after another.
///
/// # Errors
/// The fault of the smallest id.
pub fn visit<A: Arithmetic, P: PointPass<A, D>, const D: usize>(
    pass: &P,
    particles: &mut Operands<'_, A::Word>,
) -> Result<(), Fault> {
    let mut first: Option<Fault> = None;
    for place in 0..particles.len() {
        let read = particles.read(place);
        let mut write = particles.load(place);
        let result = pass.at(particles.id(place), &read, &mut write);
        particles.store(place, write);
        if let Err(fault) = result {
            first = Some(first.map_or(fault, |other| other.first(fault)));
        }
    }
    first.map_or(Ok(()), Err)
}
