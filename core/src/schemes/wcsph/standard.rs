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

use super::energy;
use super::fields::{CONSTANT, fields};
use super::parameters::Parameters;
use super::updates::Evolved;
use super::water::Water;
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Field, Side, VELOCITY};
use crate::integrator::Stage;
use crate::model::{MAX_ENERGIES, Measure, Model, Reversibility, Settings, SetupError};
use crate::number::Arithmetic;
use crate::set::SetView;
use crate::shears;
use crate::system::{Sum, System};

/// Weakly compressible SPH as usually discretised.
#[derive(Clone, Debug)]
pub struct Standard<A: Arithmetic, const D: usize> {
    water: Water<A, D>,
}

impl<A: Arithmetic, const D: usize> Standard<A, D> {
    /// The scheme with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn new(parameters: Parameters<D>) -> Result<Self, SetupError> {
        Water::new(parameters).map(|water| Self { water })
    }

    /// What the schemes share.
    #[must_use]
    pub fn water(&self) -> &Water<A, D> {
        &self.water
    }

    /// ρ ← ρ + R(c dt Σ m u_ab · ∇W), of fluid and dummies.
    fn continuity<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        let pass = self.water.continuity_pass(self.water.duration(c));
        self.water.locate(system, exec);
        let read = &[VELOCITY];
        self.water
            .sum_over_all(system, exec, &pass, read, CONSTANT)?;
        if self.water.has_dummies(system) {
            let of_fluid = Sum::to_walls(Side::Particles, read, CONSTANT);
            system.sum(exec, &pass, of_fluid)?;
        }
        Ok(())
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for Standard<A, D> {
    const FIELDS: &'static [Field] = &fields("density");
    const ENERGIES: &'static [&'static str] = energy::NAMES;
    const COLUMNS: &'static [Measure] = energy::COLUMNS;
    const REVERSIBILITY: Reversibility = Reversibility::Irreversible;

    fn settings(&self) -> &Settings<D> {
        self.water.settings()
    }

    /// ρ ← ρ0.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        let rho = self.water.reference_density();
        system.particles.words_mut(CONSTANT).fill(rho);
        let of_walls = if self.water.has_dummies(system) {
            rho
        } else {
            A::Word::default()
        };
        system.walls.words_mut(CONSTANT).fill(of_walls);
        self.place_walls(system, exec)
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.water.locate(system, exec);
        exec.points(&Evolved, &mut system.particles)?;
        exec.points(&Evolved, &mut system.walls)
    }

    fn stages(&self, _: u64) -> impl Iterator<Item = Stage> {
        use Stage::{Drift, Kick, Lift};
        [Kick(0.5), Drift(1.0), Lift(1.0), Kick(0.5)].into_iter()
    }

    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if let Stage::Kick(c) = stage {
            self.refresh(system, exec)?;
            self.water.impulses(system, exec, c)?;
        }
        Ok(())
    }

    fn apply<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Stage::Kick(_) => exec.points(&shears::Kick, &mut system.particles),
            Stage::Drift(c) => exec.points(&self.water.drift(c), &mut system.particles),
            Stage::Lift(c) => self.continuity(system, exec, c),
            Stage::Counterkick(_) | Stage::Relax => Ok(()),
        }
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        energy::energies(&self.water, system)
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        energy::column(&self.water, column, particles, place)
    }
}
