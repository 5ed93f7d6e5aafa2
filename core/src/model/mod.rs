//! Models: what moves the particles.
//!
//! [`Forces`] holds what the schemes of weakly compressible SPH share: kernel, state equation,
//! gravity, walls. [`Symplectic`] is the reversible scheme of Kincl & Pavelka, Comput. Phys.
//! Commun. 284 (2023) 108593; [`Standard`] is the usual one that it is compared with; [`Filtered`] is
//! the first with its noise filtered out, which no reversal brings back. Each writes its own short
//! step.

mod filtered;
mod forces;
mod kick_drift;
mod parameters;
mod passes;
mod standard;
mod state_equation;
mod symplectic;

pub use filtered::Filtered;
pub use forces::Forces;
pub use parameters::{
    AntiClump, Central, DensityCorrection, Gravity, Parameters, SetupError, Wall,
};
pub use passes::{
    AntiClumpEnergyPass, AntiClumpPass, ContinuityPass, DensityPass, FilterPass, PressurePass,
    WallEnergyPass, WallPass,
};
pub use standard::Standard;
pub use state_equation::StateEquation;
pub use symplectic::Symplectic;

use crate::executor::Executor;
use crate::fault::Fault;
use crate::number::Arithmetic;
use crate::state::{DensityRole, System};

/// What reversing the velocities does to a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reversibility {
    /// n steps, reversed, n steps: the first state, to the last bit.
    BitExact,
    /// A symmetric scheme whose sums are rounded differently on the way back.
    UpToRounding,
    /// The scheme itself is not symmetric in time.
    Irreversible,
    /// The scheme takes energy and information out of the flow: there is no way back at all.
    Dissipative,
}

/// A scheme: how a system is set up and advanced by one step.
pub trait Model<A: Arithmetic, const D: usize>: Sync + Sized {
    /// Name used in scenes and snapshots.
    const NAME: &'static str;
    /// Part of the type, so that whoever promises a way back can ask before promising. Reversing
    /// the velocities is allowed for every model.
    const REVERSIBILITY: Reversibility;
    /// Meaning of the state's density field.
    const DENSITY_ROLE: DensityRole;

    /// The model with these forces.
    fn new(forces: Forces<A, D>) -> Self;

    /// What the schemes share.
    fn forces(&self) -> &Forces<A, D>;

    /// Fills the density fields of fluid and walls from the initial positions. Called once at
    /// step 0; never again, neither on reversal nor on resumption.
    ///
    /// # Errors
    /// Slices of the wrong length, density terms out of range, too many neighbours.
    fn initialise<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E)
    -> Result<(), Fault>;

    /// Brings the densities in the scratch up to date with the positions.
    ///
    /// # Errors
    /// As a step.
    fn update_density<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault>;

    /// One step.
    ///
    /// # Errors
    /// The particle and the step that left the number range or lost its density. The state is
    /// then somewhere within the step and of no use.
    fn step<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault>;

    /// So many steps: the same bits as one after another, and the same fault.
    ///
    /// # Errors
    /// As a step.
    fn steps<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        steps: u64,
    ) -> Result<(), Fault> {
        (0..steps).try_for_each(|_| self.step(system, exec))
    }
}
