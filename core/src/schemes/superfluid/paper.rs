//! The paper's own integrator for superfluid helium, to be compared with the reversible one.
//!
//! Section II E, with the entropy advanced by a whole step (the paper prints a half, with which
//! second sound does not run):
//!
//! 1. v and u advance by the rates of the last step, half a step
//! 2. drift(½)
//! 3. s advances by a whole step, with the rate at the midpoint
//! 4. drift(½)
//! 5. rates of v and u, and v and u advance by them, half a step
//!
//! The rate of s follows from an s of half a step earlier, and those of v and u from velocities of
//! half a step earlier: the scheme is of first order where helium flows, and it does not return.
//! The state has u = v - v_s for the paper's v_s, and the rates, which the next step begins with.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124.

use super::energy;
use super::fields::FIELDS_OF_PAPER;
use super::liquid::Liquid;
use super::parameters::HeliumParameters;
use super::updates::{Flow, KeepRates, TakeRates};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::Field;
use crate::integrator::Stage::{self, Counterkick, Drift, Kick, Lift};
use crate::model::{MAX_ENERGIES, MAX_TOTALS, Measure, Model, Reversibility, Settings, SetupError};
use crate::number::Arithmetic;
use crate::set::SetView;
use crate::system::System;
use core::marker::PhantomData;

/// Superfluid helium with the integrator of the paper.
#[derive(Clone, Debug)]
pub struct PaperSuperfluid<A: Arithmetic, const D: usize> {
    liquid: Liquid<D>,
    of: PhantomData<A>,
}

impl<A: Arithmetic, const D: usize> PaperSuperfluid<A, D> {
    /// Helium with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn new(parameters: HeliumParameters<D>) -> Result<Self, SetupError> {
        Ok(Self {
            liquid: Liquid::new(parameters)?,
            of: PhantomData,
        })
    }

    /// What both schemes share.
    #[must_use]
    pub fn liquid(&self) -> &Liquid<D> {
        &self.liquid
    }

    /// What half a kick, or the whole of a flow of entropy, adds.
    fn rates<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        self.liquid.sums(system, exec)?;
        self.liquid
            .fluxes::<A, E, false, true>(system, exec, c, true)
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for PaperSuperfluid<A, D> {
    const FIELDS: &'static [Field] = &FIELDS_OF_PAPER;
    const ENERGIES: &'static [&'static str] = energy::NAMES;
    const COLUMNS: &'static [Measure] = energy::COLUMNS;
    const TOTALS: &'static [Measure] = energy::TOTALS;
    const REVERSIBILITY: Reversibility = Reversibility::Irreversible;

    fn settings(&self) -> &Settings<D> {
        self.liquid.settings()
    }

    /// The first density is ρ0, and the first rates are there.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        self.place_walls(system, exec)?;
        self.liquid.begin(system, exec)?;
        self.rates(system, exec, 0.5)?;
        exec.points(&KeepRates, &mut system.particles)
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.liquid.sums(system, exec)
    }

    fn stages(&self, _: u64) -> impl Iterator<Item = Stage> {
        // The first stage takes what the last one has kept, and prepares nothing.
        [
            Counterkick(0.5),
            Drift(0.5),
            Lift(1.0),
            Drift(0.5),
            Kick(0.5),
        ]
        .into_iter()
    }

    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Kick(c) => {
                self.rates(system, exec, c)?;
                exec.points(&KeepRates, &mut system.particles)
            }
            Lift(c) => self.rates(system, exec, c),
            Counterkick(_) | Drift(_) | Stage::Relax => Ok(()),
        }
    }

    fn apply<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let particles = &mut system.particles;
        match stage {
            Counterkick(_) | Kick(_) => exec.points(&TakeRates, particles),
            Lift(_) => exec.points(&Flow, particles),
            Drift(c) => exec.points(&self.liquid.drift(c), particles),
            Stage::Relax => Ok(()),
        }
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        energy::energies::<A, false, D>(self.liquid.parameters(), system)
    }

    fn totals(&self, system: &System<'_, A, D>) -> [f64; MAX_TOTALS] {
        energy::totals::<A, false, D>(self.liquid.parameters(), system)
    }

    fn lone_particles(&self, system: &System<'_, A, D>) -> u64 {
        energy::lone_particles(self.liquid.parameters(), system)
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        energy::column::<A, false, D>(self.liquid.parameters(), column, particles, place)
    }
}
