//! The reversible scheme: density by summation, eq. (5), forces (1b), a symmetric integrator.
//!
//! ρ_a = Σ_b m W(r_ab) + C_a is a function of the positions, so the semi-discrete equations are
//! canonical, H = Σ m (v²/2 + ε(ρ) + gravity) + walls, and every row of the integrator table is
//! symplectic, symmetric and, in fixed point, exactly reversible.
//!
//! Source: Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, sections 2 to 4.

use super::{Forces, Model, Reversibility};
use crate::executor::Executor;
use crate::fault::{Fault, FaultKind};
use crate::integrator::Stage;
use crate::number::{Arithmetic, Quantity};
use crate::state::{DensityRole, System};

/// Reversible weakly compressible SPH ("model A").
#[derive(Clone, Debug)]
pub struct Symplectic<A: Arithmetic, const D: usize> {
    forces: Forces<A, D>,
}

/// Which kicks of a step are one with those of its neighbours.
#[derive(Clone, Copy)]
struct Joined {
    /// The first adds the last one of the step before too.
    opening: bool,
    /// The last is left to the step after.
    closing: bool,
}

impl<A: Arithmetic, const D: usize> Symplectic<A, D> {
    fn take<E: Executor>(
        &self,
        mut stages: &[Stage],
        joined: Joined,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let mut owed = joined.opening;
        loop {
            stages = match *stages {
                [Stage::Kick(kick), Stage::Drift(drift), ref rest @ ..] => {
                    self.update_for_kick(system, exec, kick)?;
                    self.forces
                        .kick_and_drift(system, exec, kick, owed, drift)?;
                    owed = false;
                    rest
                }
                [Stage::Kick(kick)] if joined.closing => {
                    self.update_for_kick(system, exec, kick)?;
                    break;
                }
                [Stage::Kick(kick), ref rest @ ..] => {
                    self.update_for_kick(system, exec, kick)?;
                    self.forces.kick(system, exec, kick)?;
                    rest
                }
                [Stage::Drift(drift), ref rest @ ..] => {
                    self.forces.drift(system, exec, drift)?;
                    rest
                }
                [] => break,
            };
        }
        Ok(())
    }

    /// Densities for a kick of `c` time steps, and where it can be had in one go its impulses.
    fn update_for_kick<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        if system.progress.density_current || self.forces.has_dummies(system) {
            return self.update_density(system, exec);
        }
        self.forces.sort(system, exec);
        self.forces.densities_and_impulses(system, exec, c)
    }

    fn update_wall_density<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if !self.forces.has_dummies(system) {
            return Ok(());
        }
        let density = core::mem::take(&mut system.scratch.wall_density);
        density.copy_from_slice(system.scratch.wall_density_fixed);
        let result = self.forces.add_fluid_to_walls(system, exec, density);
        system.scratch.wall_density = density;
        result
    }

    /// Σ over the walls themselves plus C_a: constant, since neither changes.
    fn fix_wall_density<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if !self.forces.has_dummies(system) {
            return Ok(());
        }
        let fixed = core::mem::take(&mut system.scratch.wall_density_fixed);
        let result = self.forces.sum_walls(system, exec, fixed);
        for (f, c) in fixed.iter_mut().zip(&*system.walls.density) {
            *f = f.plus(*c);
        }
        system.scratch.wall_density_fixed = fixed;
        result
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for Symplectic<A, D> {
    const NAME: &'static str = "symplectic";
    const REVERSIBILITY: Reversibility = if A::EXACT {
        Reversibility::BitExact
    } else {
        Reversibility::UpToRounding
    };
    const DENSITY_ROLE: DensityRole = DensityRole::Constant;

    fn new(forces: Forces<A, D>) -> Self {
        Self { forces }
    }

    fn forces(&self) -> &Forces<A, D> {
        &self.forces
    }

    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let forces = &self.forces;
        self.forces.check_capacity(system)?;
        system.progress.invalidate();
        system.progress.initialised = true;
        forces.sort(system, exec);
        let sum = core::mem::take(&mut system.scratch.density);
        let result = forces.sum_density(system, exec, sum);
        for (c, s) in system.state.density.iter_mut().zip(&*sum) {
            *c = forces.density_constant(*s);
        }
        system.scratch.density = sum;
        result?;
        system.walls.density.fill(A::Density::ZERO);
        if forces.has_dummies(system) {
            self.fix_wall_density(system, exec)?;
            self.update_wall_density(system, exec)?;
            let sums = &*system.scratch.wall_density;
            for (c, s) in system.walls.density.iter_mut().zip(sums) {
                *c = forces.density_constant(*s);
            }
        }
        // The fixed part of the walls' density still lacks C_a.
        system.progress.invalidate();
        Ok(())
    }

    fn update_density<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if system.progress.density_current {
            return Ok(());
        }
        let fresh = !system.progress.walls_sorted;
        self.forces.sort(system, exec);
        if fresh {
            self.fix_wall_density(system, exec)?;
        }
        let density = core::mem::take(&mut system.scratch.density);
        let result = self.forces.sum_density(system, exec, density);
        for (rho, c) in density.iter_mut().zip(&*system.state.density) {
            *rho = rho.plus(*c);
        }
        system.scratch.density = density;
        result?;
        self.update_wall_density(system, exec)?;
        system.progress.density_current = true;
        Ok(())
    }

    fn step<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.steps(system, exec, 1)
    }

    /// Where a step closes with the kick that the next one opens with, both are added in one go: the
    /// impulses are the same.
    fn steps<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        steps: u64,
    ) -> Result<(), Fault> {
        if steps > 0 && !system.progress.initialised {
            let step = system.progress.step + 1;
            return Err(Fault::new(FaultKind::NotInitialised, 0).at_step(step));
        }
        let stages = self.forces.parameters().integrator.stages;
        let same = match stages {
            [Stage::Kick(first), Stage::Drift(_), .., Stage::Kick(last)] => first == last,
            _ => false,
        };
        for n in 0..steps {
            let joined = Joined {
                opening: same && n > 0,
                closing: same && n + 1 < steps,
            };
            let step = system.progress.step + 1;
            self.take(stages, joined, system, exec)
                .map_err(|fault| fault.unless_known(step))?;
            system.progress.step = step;
        }
        Ok(())
    }
}
