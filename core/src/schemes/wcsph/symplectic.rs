//! The reversible scheme: density by summation, eq. (5), forces (1b), a symmetric integrator.
//!
//! ρ_a = Σ_b m W(r_ab) + C_a is a function of the positions, so the semi-discrete equations are
//! canonical, H = Σ m (v²/2 + ε(ρ) + gravity) + walls, and every row of the integrator table is
//! symplectic, symmetric and, in fixed point, exactly reversible. A step is the row:
//!
//! - kick(c):  ρ from the positions, J from ρ, v ← v + J
//! - drift(c): x ← x + R(c dt v)
//!
//! Source: Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, sections 2 to 4.

use super::energy;
use super::fields::{CONSTANT, DENSITY, fields};
use super::parameters::Parameters;
use super::updates::{AddConstant, FixedPart};
use super::water::Water;
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Field, Side};
use crate::integrator::Stage;
use crate::model::{MAX_ENERGIES, Measure, Model, Settings, SetupError};
use crate::number::Arithmetic;
use crate::set::SetView;
use crate::system::{Sum, System};

/// Reversible weakly compressible SPH ("model A").
#[derive(Clone, Debug)]
pub struct Symplectic<A: Arithmetic, const D: usize> {
    water: Water<A, D>,
}

impl<A: Arithmetic, const D: usize> Symplectic<A, D> {
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

    /// ρ = m W(0) + Σ m W + C of fluid and dummies.
    fn densities<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.water.locate(system, exec);
        self.water.bare_densities(system, exec)?;
        exec.points(&AddConstant, &mut system.particles)?;
        self.water.dummy_densities(system, exec)
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for Symplectic<A, D> {
    const FIELDS: &'static [Field] = &fields("density_constant");
    const ENERGIES: &'static [&'static str] = energy::NAMES;
    const COLUMNS: &'static [Measure] = energy::COLUMNS;

    fn settings(&self) -> &Settings<D> {
        self.water.settings()
    }

    /// Dummies do not move: what they add to each other's density is summed once.
    fn place_walls<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.prepare_walls();
        system.locate_walls(exec);
        if !self.water.has_dummies(system) {
            return Ok(());
        }
        exec.points(&self.water.own(), &mut system.walls)?;
        let of_walls = Sum::to_walls(Side::Walls, &[], DENSITY);
        system.sum(exec, &self.water.density_pass(), of_walls)?;
        exec.points(&FixedPart, &mut system.walls)
    }

    /// C_a ← ρ0 - Σ m W.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        system.walls.words_mut(CONSTANT).fill_with(Default::default);
        self.place_walls(system, exec)?;
        self.water.locate(system, exec);
        self.water.bare_densities(system, exec)?;
        exec.points(&self.water.constants(), &mut system.particles)?;
        if self.water.has_dummies(system) {
            self.water.dummy_densities(system, exec)?;
            exec.points(&self.water.constants(), &mut system.walls)?;
            self.place_walls(system, exec)?;
        }
        Ok(())
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.densities(system, exec)
    }

    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if let Stage::Kick(c) = stage {
            self.densities(system, exec)?;
            self.water.impulses(system, exec, c)?;
        }
        Ok(())
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        energy::energies(&self.water, system)
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        energy::column(&self.water, column, particles, place)
    }
}
