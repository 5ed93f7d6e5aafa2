//! Models: what moves the particles.
//!
//! A model declares its fields, and its step as a list of [`Stage`]s. Every stage but one is an
//! exact shear: it adds to one half of the state integers that depend on the other half alone, so
//! its negative undoes it. First the integers are computed into the scratch ([`Model::prepare`]),
//! then they are added ([`Model::apply`]); whoever knows that nothing has moved in between may add
//! what was prepared a second time. The one that is not a shear, `Relax`, exists only for models
//! that [`Dissipative`] wraps, and its type says that there is no way back.

use crate::executor::Executor;
use crate::fault::{Fault, FaultKind};
use crate::fields::{Field, IMPULSE_FIELD, POSITION_FIELD, VELOCITY_FIELD};
use crate::integrator::{Integrator, Stage};
use crate::neighbours::Grid;
use crate::number::{Arithmetic, Scale};
use crate::set::SetView;
use crate::shears::{Drift, Kick};
use crate::system::System;
use thiserror::Error;

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

/// What can be measured of a particle, with its SI unit, as outputs and pictures name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    /// Name, in words.
    pub name: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
}

/// What every model says of itself in numbers.
#[derive(Clone, Debug)]
pub struct Settings<const D: usize> {
    /// Units of the state.
    pub scale: Scale,
    /// Mass of every particle, kg (per m of depth in 2D).
    pub mass: f64,
    /// dt, s.
    pub time_step: f64,
    /// The table of a step.
    pub integrator: &'static Integrator,
    /// Width of a bin of the histogram of speeds, m/s; there are [`BINS`](crate::observe::BINS).
    pub speed_bin: f64,
    /// Geometry of the cells of particles and of walls.
    pub grids: [Grid<D>; 2],
}

/// Most kinds of energy that a model may have.
pub const MAX_ENERGIES: usize = 8;

/// Most numbers that a model may say of the whole.
pub const MAX_TOTALS: usize = 4;

/// A scheme: what a particle consists of, how a system is set up, and its step.
pub trait Model<A: Arithmetic, const D: usize>: Send + Sync + Sized + 'static {
    /// State and scratch; the first three are these, or these with a role on walls.
    const FIELDS: &'static [Field] = &[POSITION_FIELD, VELOCITY_FIELD, IMPULSE_FIELD];
    /// Kinds of energy, in the order of [`Model::energies`]; the first is the kinetic one.
    const ENERGIES: &'static [&'static str];
    /// What is recorded and drawn of a particle besides position and velocity.
    const COLUMNS: &'static [Measure] = &[];
    /// What is recorded of the whole besides energies and momenta, in the order of
    /// [`Model::totals`].
    const TOTALS: &'static [Measure] = &[];
    /// The field that is 1 where a particle is held in its place: it is no part of momenta, of the kinetic energy, or of the histogram of speeds.
    const HELD: Option<usize> = None;
    /// Whether what is held is a wall around a flow, and is drawn and written as one, or a clamp of
    /// a body. Walls come after the flow in the order of ids.
    const HELD_IS_WALL: bool = false;
    /// Part of the type, so that whoever promises a way back can ask before promising. Reversing
    /// the velocities is allowed for every model.
    const REVERSIBILITY: Reversibility = if A::EXACT {
        Reversibility::BitExact
    } else {
        Reversibility::UpToRounding
    };

    /// What every model must say of itself in numbers.
    fn settings(&self) -> &Settings<D>;
    /// Units of the state.
    fn scale(&self) -> Scale {
        self.settings().scale
    }
    /// Geometry of the cells of particles and of walls.
    fn grids(&self) -> [&Grid<D>; 2] {
        self.settings().grids.each_ref()
    }

    /// What follows from the walls alone; after they were placed, and before anything else.
    ///
    /// # Errors
    /// As a step.
    fn place_walls<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.prepare_walls();
        system.locate_walls(exec);
        Ok(())
    }

    /// Sets up those fields of the state that follow from the initial positions. Called once at
    /// step 0; never again, neither on reversal nor on resumption. Whoever overrides it marks the
    /// clock as initialised and calls [`Model::place_walls`], as here.
    ///
    /// # Errors
    /// As a step.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        self.place_walls(system, exec)
    }

    /// Brings the scratch that diagnostics and pictures read up to date with the state. A prepared
    /// kick leaves no less.
    ///
    /// # Errors
    /// As a step.
    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        system.locate(exec, true);
        Ok(())
    }

    /// The stages of step number `step`, counted from 1.
    fn stages(&self, step: u64) -> impl Iterator<Item = Stage> {
        let _ = step;
        self.settings().integrator.stages.iter().copied()
    }

    /// Computes what a stage will add.
    ///
    /// # Errors
    /// The particle that left the number range or lost its density.
    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault>;

    /// The same integers, where no particle has moved since the model last had the particles
    /// located: sums that depend on positions alone may still be in the scratch, and a model that
    /// has such need not take them again. Whoever knows calls this one.
    ///
    /// # Errors
    /// As [`Model::prepare`].
    fn prepare_in_place<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.prepare(stage, system, exec)
    }

    /// Adds what was prepared: the impulses to the velocities, or the velocities to the positions.
    ///
    /// # Errors
    /// The particle that left the number range.
    fn apply<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Stage::Kick(_) => exec.points(&Kick, &mut system.particles),
            Stage::Drift(c) => {
                let drift = Drift::new(c * self.settings().time_step, &self.scale());
                exec.points(&drift, &mut system.particles)
            }
            Stage::Lift(_) | Stage::Counterkick(_) | Stage::Relax => Ok(()),
        }
    }

    /// One step.
    ///
    /// # Errors
    /// The particle and the step that left the number range or lost its density. The state is
    /// then somewhere within the step and of no use.
    fn step<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let step = system.clock.step + 1;
        if !system.clock.initialised {
            return Err(Fault::new(FaultKind::NotInitialised, 0).at_step(step));
        }
        for stage in self.stages(step) {
            self.prepare(stage, system, exec)
                .and_then(|()| self.apply(stage, system, exec))
                .map_err(|fault| fault.at_step(step))?;
        }
        system.clock.step = step;
        Ok(())
    }

    /// Energies by kind, J (per m of depth in 2D), of a system that was refreshed; the rest of the
    /// array is zero. The kinetic one is measured by the caller. Sums of doubles go through
    /// [`ExactSum`](crate::exact::ExactSum), so that they do not depend on the storage order.
    ///
    /// # Errors
    /// A particle without an energy.
    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault>;

    /// The numbers of [`Model::TOTALS`], in their units, of a system that was refreshed; the rest of
    /// the array is zero. As with energies, they must not depend on the storage order.
    fn totals(&self, system: &System<'_, A, D>) -> [f64; MAX_TOTALS] {
        let _ = system;
        [0.0; MAX_TOTALS]
    }

    /// How many particles have too few neighbours for what the model asks of them, of a system that
    /// was refreshed: parts that have torn off.
    fn lone_particles(&self, system: &System<'_, A, D>) -> u64 {
        let _ = system;
        0
    }

    /// Number `column` of [`Model::COLUMNS`], in its unit, of the particle in this place of a
    /// system that was refreshed.
    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        let _ = (column, particles, place);
        f64::NAN
    }
}

/// A model with a third verb: `relax`, after some of its steps.
pub trait Relax<A: Arithmetic, const D: usize>: Send + Sync + 'static {
    /// The model between two relaxations.
    type Scheme: Model<A, D>;
    /// The model between two relaxations.
    fn scheme(&self) -> &Self::Scheme;
    /// The stages of step number `step`, counted from 1, with a relaxation where one is due.
    fn stages(&self, step: u64) -> impl Iterator<Item = Stage>;
    /// Maps many states to one, and leaves the particles located.
    ///
    /// # Errors
    /// As a step.
    fn relax<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault>;
}

/// A model that relaxes. There is no other way to have [`Relax::relax`] called, and this type's
/// [`Model::REVERSIBILITY`] is [`Reversibility::Dissipative`].
#[derive(Clone, Debug)]
pub struct Dissipative<R>(pub R);

impl<A: Arithmetic, R: Relax<A, D>, const D: usize> Model<A, D> for Dissipative<R> {
    const FIELDS: &'static [Field] = R::Scheme::FIELDS;
    const ENERGIES: &'static [&'static str] = R::Scheme::ENERGIES;
    const COLUMNS: &'static [Measure] = R::Scheme::COLUMNS;
    const TOTALS: &'static [Measure] = R::Scheme::TOTALS;
    const HELD: Option<usize> = R::Scheme::HELD;
    const HELD_IS_WALL: bool = R::Scheme::HELD_IS_WALL;
    const REVERSIBILITY: Reversibility = Reversibility::Dissipative;

    fn settings(&self) -> &Settings<D> {
        self.0.scheme().settings()
    }
    fn place_walls<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.0.scheme().place_walls(system, exec)
    }
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.0.scheme().initialise(system, exec)
    }
    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.0.scheme().refresh(system, exec)
    }
    fn stages(&self, step: u64) -> impl Iterator<Item = Stage> {
        self.0.stages(step)
    }
    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Stage::Relax => Ok(()),
            shear => self.0.scheme().prepare(shear, system, exec),
        }
    }
    fn prepare_in_place<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Stage::Relax => Ok(()),
            shear => self.0.scheme().prepare_in_place(shear, system, exec),
        }
    }
    fn apply<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Stage::Relax => self.0.relax(system, exec),
            shear => self.0.scheme().apply(shear, system, exec),
        }
    }
    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        self.0.scheme().energies(system)
    }
    fn totals(&self, system: &System<'_, A, D>) -> [f64; MAX_TOTALS] {
        self.0.scheme().totals(system)
    }
    fn lone_particles(&self, system: &System<'_, A, D>) -> u64 {
        self.0.scheme().lone_particles(system)
    }
    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        self.0.scheme().column(column, particles, place)
    }
}

/// Parameters that no model can be built from.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum SetupError {
    /// A parameter is not a finite number in its range.
    #[error("{name} = {value} is out of range")]
    Parameter {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The kernel at r = 0 weighs more than one density term may.
    #[error(
        "the support radius {support_radius} m is too small for the mass of a particle: \
         m W(0) is out of range"
    )]
    Support {
        /// h, m.
        support_radius: f64,
    },
}
