//! The symplectic scheme with an active noise filter: dissipative, on purpose.
//!
//! Every M steps the velocities are replaced by their Shepard average over the neighbours,
//!
//! ũ_a = (1/γ_a) Σ_b V_b u_b W_ab,  γ_a = Σ_b V_b W_ab,
//!
//! the particle itself and dummy walls (at rest) included. All volumes are taken to be m/ρ0; those
//! of a weakly compressible fluid differ by the square of its Mach number. So γ_a = (ρ_a - C_a)/ρ0,
//! and
//!
//! ũ_a = u_a + R((1/γ_a) Σ_b R((m/ρ0) W_ab (u_b - u_a))).
//!
//! The sum is one of integers like any other, the same for every executor. But many velocities have
//! one average: the filter cannot be undone, and kinetic energy goes where nothing comes back from.
//!
//! Source: Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, appendix A.

use super::parameters::Parameters;
use super::symplectic::Symplectic;
use super::updates::Average;
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{IMPULSE, VELOCITY};
use crate::integrator::Stage;
use crate::model::{Dissipative, Model, Relax, SetupError};
use crate::number::Arithmetic;
use crate::shears::NoImpulse;
use crate::system::System;

/// [`Symplectic`] with a filter after every M-th step.
pub type Filtered<A, const D: usize> = Dissipative<Filter<A, D>>;

/// The filter and the scheme between its turns.
#[derive(Clone, Debug)]
pub struct Filter<A: Arithmetic, const D: usize> {
    scheme: Symplectic<A, D>,
}

impl<A: Arithmetic, const D: usize> Filter<A, D> {
    /// The scheme with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn filtered(parameters: Parameters<D>) -> Result<Filtered<A, D>, SetupError> {
        let scheme = Symplectic::new(parameters)?;
        Ok(Dissipative(Self { scheme }))
    }
}

impl<A: Arithmetic, const D: usize> Relax<A, D> for Filter<A, D> {
    type Scheme = Symplectic<A, D>;

    fn scheme(&self) -> &Symplectic<A, D> {
        &self.scheme
    }

    /// Those of the scheme, and the filter after every M-th step.
    fn stages(&self, step: u64) -> impl Iterator<Item = Stage> {
        let every = self.scheme.water().parameters().filter_every;
        let due = every > 0 && step.is_multiple_of(every);
        self.scheme.stages(step).chain(due.then_some(Stage::Relax))
    }

    /// Replaces the velocities by their averages. The memory of the impulses is used for the sums.
    fn relax<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let water = self.scheme.water();
        self.scheme.refresh(system, exec)?;
        exec.points(&NoImpulse, &mut system.particles)?;
        water.sum_over_all(system, exec, &water.filter_pass(), &[VELOCITY], IMPULSE)?;
        let average = Average {
            inverse_reference: water.inverse_reference(),
        };
        exec.points(&average, &mut system.particles)
    }
}
