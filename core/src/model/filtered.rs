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

use super::{Forces, Model, Reversibility, Symplectic};
use crate::executor::{Executor, Ids, Targets};
use crate::fault::{Fault, FaultKind};
use crate::number::{Arithmetic, Quantity};
use crate::state::{DensityRole, System};

/// [`Symplectic`] with `relax` after every M-th step.
#[derive(Clone, Debug)]
pub struct Filtered<A: Arithmetic, const D: usize> {
    scheme: Symplectic<A, D>,
}

impl<A: Arithmetic, const D: usize> Filtered<A, D> {
    /// Replaces the velocities by their averages.
    fn relax<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.update_density(system, exec)?;
        // The memory of the impulses is used for the sums: they are computed anew by the next kick.
        system.progress.impulse_for = None;
        let sums = core::mem::take(&mut system.scratch.impulse);
        let result = self
            .sum_differences(system, exec, sums)
            .and_then(|()| self.average(system, exec, sums));
        system.scratch.impulse = sums;
        result
    }

    /// Σ (m/ρ0) W (u_b - u_a), into `sums`.
    fn sum_differences<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        sums: &mut [[A::Speed; D]],
    ) -> Result<(), Fault> {
        let forces = self.scheme.forces();
        sums.fill([A::Speed::ZERO; D]);
        let pass = forces.filter_pass();
        let velocity = &*system.state.velocity;
        let mut to = Targets {
            position: &*system.state.position,
            read: velocity,
            id: Ids::Listed(system.state.id),
            same_set: true,
        };
        exec.sum(&pass, &to, &forces.fluid(system, velocity), sums)?;
        if forces.has_dummies(system) {
            to.same_set = false;
            let walls = forces.walls(system, &*system.walls.velocity);
            exec.sum(&pass, &to, &walls, sums)?;
        }
        Ok(())
    }

    /// u ← u + R(sum / γ).
    fn average<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        sums: &[[A::Speed; D]],
    ) -> Result<(), Fault> {
        let forces = self.scheme.forces();
        let density = &*system.scratch.density;
        let (constant, id) = (&*system.state.density, &*system.state.id);
        exec.for_each(system.state.velocity, |i, v| {
            let bare = density[i].plus(constant[i].negated());
            let gamma = forces.relative_density(bare);
            for (v, sum) in v.iter_mut().zip(sums[i]) {
                let moved = v.add_rounded(sum.quanta::<A::Real>() / gamma);
                *v = moved
                    .filter(|v| v.in_range())
                    .ok_or(Fault::new(FaultKind::VelocityRange, id[i]))?;
            }
            Ok(())
        })
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for Filtered<A, D> {
    const NAME: &'static str = "filtered";
    const REVERSIBILITY: Reversibility = Reversibility::Dissipative;
    const DENSITY_ROLE: DensityRole = DensityRole::Constant;

    fn new(forces: Forces<A, D>) -> Self {
        Self {
            scheme: Symplectic::new(forces),
        }
    }

    fn forces(&self) -> &Forces<A, D> {
        self.scheme.forces()
    }

    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.scheme.initialise(system, exec)
    }

    fn update_density<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.scheme.update_density(system, exec)
    }

    fn step<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.scheme.step(system, exec)?;
        let step = system.progress.step;
        let every = self.forces().parameters().filter_every;
        if every > 0 && step.is_multiple_of(every) {
            self.relax(system, exec)
                .map_err(|fault| fault.at_step(step))?;
        }
        Ok(())
    }
}
