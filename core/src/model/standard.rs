//! The standard scheme, for comparison: density advanced in time by (1a) instead of summed.
//!
//! A step is
//!
//! 1. kick(1/2)
//! 2. drift(1)
//! 3. ρ ← ρ + R(dt Σ m u_ab · ∇W), at the new positions with the half-step velocities
//! 4. kick(1/2), with the new densities
//!
//! The third line reads the velocities that the first changed and the positions that the second
//! moved, and is not matched by a line before them: the step read backwards is another step. So
//! the scheme is not reversible, in any arithmetic, and without artificial viscosity its energy
//! grows until the run ends (Fig. 2 of Kincl & Pavelka 2023). The integrator table is not used.

use super::{Forces, Model, Reversibility};
use crate::executor::{Executor, Ids, Targets};
use crate::fault::Fault;
use crate::number::{Arithmetic, Quantity};
use crate::state::{DensityRole, System};

/// Weakly compressible SPH as usually discretised.
#[derive(Clone, Debug)]
pub struct Standard<A: Arithmetic, const D: usize> {
    forces: Forces<A, D>,
}

impl<A: Arithmetic, const D: usize> Standard<A, D> {
    fn continuity<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.forces.sort(system);
        let density = core::mem::take(&mut system.state.density);
        let wall_density = core::mem::take(&mut system.walls.density);
        let result = self.continuity_sums(
            system,
            exec,
            density.as_chunks_mut().0,
            wall_density.as_chunks_mut().0,
        );
        system.state.density = density;
        system.walls.density = wall_density;
        system.progress.density_current = false;
        // The pressure changed at unchanged positions.
        system.progress.impulse_for = None;
        result
    }

    fn continuity_sums<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        density: &mut [[A::Density; 1]],
        wall_density: &mut [[A::Density; 1]],
    ) -> Result<(), Fault> {
        let forces = &self.forces;
        let pass = forces.continuity_pass(forces.parameters().time_step);
        let velocity = &*system.state.velocity;
        let wall_velocity = &*system.walls.velocity;
        let fluid = forces.fluid(system, velocity);
        let mut to = Targets {
            position: &*system.state.position,
            read: velocity,
            id: Ids::Listed(system.state.id),
            same_set: true,
        };
        exec.sum(&pass, &to, &fluid, density)?;
        if forces.has_dummies(system) {
            to.same_set = false;
            exec.sum(&pass, &to, &forces.walls(system, wall_velocity), density)?;
            let to = Targets {
                position: &*system.walls.position,
                read: wall_velocity,
                id: Ids::From(system.state.len() as u64),
                same_set: false,
            };
            exec.sum(&pass, &to, &fluid, wall_density)?;
        }
        Ok(())
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for Standard<A, D> {
    const NAME: &'static str = "standard";
    const REVERSIBILITY: Reversibility = Reversibility::Irreversible;
    const DENSITY_ROLE: DensityRole = DensityRole::Evolved;

    fn new(forces: Forces<A, D>) -> Self {
        Self { forces }
    }

    fn forces(&self) -> &Forces<A, D> {
        &self.forces
    }

    fn initialise<E: Executor>(&self, system: &mut System<'_, A, D>, _: &E) -> Result<(), Fault> {
        self.forces.check_capacity(system)?;
        system.progress.invalidate();
        let rho = self.forces.reference_density();
        system.state.density.fill(rho);
        let of_walls = if self.forces.has_dummies(system) {
            rho
        } else {
            A::Density::ZERO
        };
        system.walls.density.fill(of_walls);
        Ok(())
    }

    fn update_density<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        _: &E,
    ) -> Result<(), Fault> {
        if !system.progress.density_current {
            self.forces.sort(system);
            let System {
                state,
                walls,
                scratch,
                ..
            } = system;
            scratch.density.copy_from_slice(state.density);
            scratch.wall_density.copy_from_slice(walls.density);
            system.progress.density_current = true;
        }
        Ok(())
    }

    fn step<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let step = system.progress.step + 1;
        let mut stages = || {
            self.update_density(system, exec)?;
            self.forces.kick(system, exec, 0.5)?;
            self.forces.drift(system, exec, 1.0)?;
            self.continuity(system, exec)?;
            self.update_density(system, exec)?;
            self.forces.kick(system, exec, 0.5)
        };
        stages().map_err(|fault: Fault| fault.at_step(step))?;
        system.progress.step = step;
        Ok(())
    }
}
