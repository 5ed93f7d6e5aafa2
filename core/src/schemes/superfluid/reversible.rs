//! Superfluid helium that returns to its first bit.
//!
//! The counterflow and the entropy are held twice, (w, s) and (W, S), equal at the start, and each
//! is kicked by what follows from the other; w = u ϱ^(-1/D) is the reduced counterflow, which a
//! motion of the whole turns and shears, but does not change in volume. A step is
//!
//! - kick(½): v, w and s by pressures, gravity and half of the fluxes, of (W, S)
//! - counterkick(½): v, W and S by the other half of the fluxes, of (w, s)
//! - lift(½): w and W follow the velocity gradient
//! - drift(1)
//! - lift(½), counterkick(½), kick(½)
//!
//! Each adds to one part of the state integers that depend on the other parts alone, and they are
//! in a palindrome: so the step with all velocities reversed undoes a step. Σ v, Σ s and Σ S are
//! kept to the last bit.
//!
//! Kicking *each* copy by its own entropy would be reversible too, but the difference of the copies
//! then obeys an elliptic equation and grows without bound at short waves. Crosswise it grows only
//! in strong shear: it starts with the square of the time step, and how far the copies are apart
//! says how far the result can be trusted.
//!
//! Where there is no superfluid component, and never will be, a step is kick(½), drift(1), kick(½)
//! of pressures alone, and u stays as it is.
//!
//! Source of what is solved: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, whose own
//! integrator is [`PaperSuperfluid`](super::PaperSuperfluid). The two copies are after M. Tao,
//! Phys. Rev. E 94 (2016) 043303.

use super::energy;
use super::fields::{FIELDS, FIELDS_OF_FRICTION};
use super::liquid::Liquid;
use super::parameters::HeliumParameters;
use super::updates::{self, SetCopies, Stretch};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::Field;
use crate::integrator::Stage::{self, Counterkick, Drift, Kick, Lift};
use crate::model::{MAX_ENERGIES, MAX_TOTALS, Measure, Model, Settings, SetupError};
use crate::number::Arithmetic;
use crate::set::SetView;
use crate::system::System;
use core::marker::PhantomData;

/// Superfluid helium ("model C"), reversible.
pub type Superfluid<A, const D: usize> = Doubled<A, D, false>;

/// Superfluid helium whose state is held twice; with `FRICTION` its particles have room for what
/// friction needs, and its energies count the heat.
#[derive(Clone, Debug)]
pub struct Doubled<A: Arithmetic, const D: usize, const FRICTION: bool> {
    liquid: Liquid<D>,
    of: PhantomData<A>,
}

impl<A: Arithmetic, const D: usize, const FRICTION: bool> Doubled<A, D, FRICTION> {
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

    /// Kicks and counterkicks, where the sums over positions are there.
    fn fluxes<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Kick(c) => self
                .liquid
                .fluxes::<A, E, true, false>(system, exec, c, true),
            Counterkick(c) => self
                .liquid
                .fluxes::<A, E, false, false>(system, exec, c, false),
            Lift(_) | Drift(_) | Stage::Relax => Ok(()),
        }
    }
}

impl<A: Arithmetic, const D: usize, const FRICTION: bool> Model<A, D> for Doubled<A, D, FRICTION> {
    const FIELDS: &'static [Field] = if FRICTION {
        &FIELDS_OF_FRICTION
    } else {
        &FIELDS
    };
    const ENERGIES: &'static [&'static str] = if FRICTION {
        energy::NAMES_WITH_HEAT
    } else {
        energy::NAMES
    };
    const COLUMNS: &'static [Measure] = energy::COLUMNS;
    const TOTALS: &'static [Measure] = energy::TOTALS;

    fn settings(&self) -> &Settings<D> {
        self.liquid.settings()
    }

    /// Both copies are as the scene has the first, and the first density is ρ0.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        self.place_walls(system, exec)?;
        self.liquid.begin(system, exec)?;
        // What the scene gives is u, and where ϱ is 1 that is w.
        exec.points(&SetCopies, &mut system.particles)
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.liquid.sums(system, exec)
    }

    fn stages(&self, _: u64) -> impl Iterator<Item = Stage> {
        const STAGES: [Stage; 7] = [
            Kick(0.5),
            Counterkick(0.5),
            Lift(0.5),
            Drift(1.0),
            Lift(0.5),
            Counterkick(0.5),
            Kick(0.5),
        ];
        let normal = self.liquid.parameters().is_normal();
        let needed = move |stage: &Stage| !normal || matches!(stage, Kick(_) | Drift(_));
        STAGES.into_iter().filter(needed)
    }

    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if !matches!(stage, Drift(_)) {
            self.liquid.sums(system, exec)?;
        }
        self.fluxes(stage, system, exec)
    }

    fn prepare_in_place<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if let Lift(_) = stage {
            return self.liquid.gradients(system, exec);
        }
        self.fluxes(stage, system, exec)
    }

    fn apply<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let particles = &mut system.particles;
        match stage {
            Kick(c) => {
                exec.points(&updates::Kick::<false>, particles)?;
                match self.liquid.hold(c) {
                    Some(hold) if FRICTION => exec.points(&hold, particles),
                    _ => Ok(()),
                }
            }
            Counterkick(_) => exec.points(&updates::Kick::<true>, particles),
            Drift(c) => exec.points(&self.liquid.drift(c), particles),
            Lift(share) => {
                let p = self.liquid.parameters();
                let most = p.most_separation / p.scale.speed_quantum();
                let most_squared = most * most;
                exec.points(
                    &Stretch {
                        share,
                        most_squared,
                    },
                    particles,
                )
            }
            Stage::Relax => Ok(()),
        }
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        let p = self.liquid.parameters();
        let mut energies = energy::energies::<A, true, D>(p, system)?;
        if FRICTION {
            energies[energy::HEAT] = energy::heat(p, system);
            energies[energy::HEAT + 1] = energy::taken(p, system);
        }
        Ok(energies)
    }

    fn totals(&self, system: &System<'_, A, D>) -> [f64; MAX_TOTALS] {
        energy::totals::<A, true, D>(self.liquid.parameters(), system)
    }

    fn lone_particles(&self, system: &System<'_, A, D>) -> u64 {
        energy::lone_particles(self.liquid.parameters(), system)
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        energy::column::<A, true, D>(self.liquid.parameters(), column, particles, place)
    }
}
