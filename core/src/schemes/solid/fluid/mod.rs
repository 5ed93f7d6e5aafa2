//! Viscous fluids with the equations of solids: the distortion relaxes.
//!
//! A step is that of the solids, with a relaxation after its second half lift,
//!
//! - kick(½), lift(½), drift(1), relax (a lift(½) and the relaxation), kick(½),
//!
//! where the lift is Cayley's transformation of the whole distortion (θ stays 0): what relaxes is
//! not to be undone, and the type says so. [`Law`] is the relaxation, with its
//! viscosity and heat; [`BesidePass`] begins what holds and drives the flow. Besides the energies of solids there are the heat that
//! the flow has received and, as `drive`, what its walls have taken out of it less what they have
//! put in: the sum of all is constant. What walls heat among themselves they have taken.
//!
//! Source: Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, sections 3.7,
//! 4.3 and 4.4.

mod parameters;
mod relaxation;
mod walls;

pub use parameters::{FluidParameters, MOST_OF_PAPER, Relaxation, WallVelocity};
use relaxation::HalfStep;
pub use relaxation::Law;
pub use walls::{Beholding, Beside, BesidePass};

use super::bodies::Bodies;
use super::energy;
use super::fields::{BESIDE, EXCHANGED, FIELDS_OF_FLUIDS, FORCES, HELD, ONE, ONE_ENERGY};
use super::parameters::Motion;
use super::passes::{ForcePass, SplitForcePass};
use super::updates::READ_OF_FORCE;
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Field, Side};
use crate::integrator::Stage::{self, Drift, Kick, Lift};
use crate::model::{
    Dissipative, MAX_ENERGIES, Measure, Model, Relax, Reversibility, Settings, SetupError,
};
use crate::number::{Arithmetic, Quantity};
use crate::set::SetView;
use crate::shears;
use crate::system::{Sum, System};
use core::marker::PhantomData;
use walls::{Carry, Collect, NoForces, NothingBeside, Pretend, READ_OF_BESIDE, Work};

/// A viscous fluid.
pub type Viscous<A, const D: usize> = Dissipative<Relaxing<A, D>>;

/// The relaxation, and the scheme between two of them.
#[derive(Clone, Debug)]
pub struct Relaxing<A: Arithmetic, const D: usize> {
    flow: Flow<A, D>,
    relaxation: HalfStep,
}

/// What a fluid does but relax: by itself an elastic body, whose distortion is lifted in halves.
#[derive(Clone, Debug)]
pub struct Flow<A: Arithmetic, const D: usize> {
    bodies: Bodies<D>,
    parameters: FluidParameters<D>,
    /// Whether anything turns.
    turns: bool,
    of: PhantomData<A>,
}

impl<A: Arithmetic, const D: usize> Relaxing<A, D> {
    /// A fluid with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn viscous(parameters: FluidParameters<D>) -> Result<Viscous<A, D>, SetupError> {
        parameters.check()?;
        let bodies = Bodies::new(parameters.bodies.clone())?;
        let turning = |part: &super::Part| matches!(part.motion, Motion::Turns { .. });
        let turns = parameters.bodies.parts.iter().any(turning);
        let flow = Flow {
            bodies,
            parameters,
            turns,
            of: PhantomData,
        };
        let relaxation = HalfStep::new(&flow.parameters, flow.unit(), true);
        Ok(Dissipative(Self { flow, relaxation }))
    }
}

impl<A: Arithmetic, const D: usize> Relax<A, D> for Relaxing<A, D> {
    type Scheme = Flow<A, D>;

    fn scheme(&self) -> &Flow<A, D> {
        &self.flow
    }

    fn stages(&self, _: u64) -> impl Iterator<Item = Stage> {
        [Kick(0.5), Lift(0.5), Drift(1.0), Stage::Relax, Kick(0.5)].into_iter()
    }

    /// Distortions are lifted and relax.
    fn relax<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.flow.bodies.moments(system, exec)?;
        exec.points(&self.relaxation, &mut system.particles)
    }
}

impl<A: Arithmetic, const D: usize> Flow<A, D> {
    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &FluidParameters<D> {
        &self.parameters
    }

    /// What solids and fluids share.
    #[must_use]
    pub fn bodies(&self) -> &Bodies<D> {
        &self.bodies
    }

    /// The forces, in two parts.
    #[must_use]
    pub fn force_pass(&self) -> SplitForcePass {
        SplitForcePass {
            whole: ForcePass {
                reach: self.bodies.reach(),
            },
        }
    }

    /// The sums over the flow beside walls.
    #[must_use]
    pub fn beside_pass(&self) -> BesidePass {
        let p = self.bodies.parameters();
        BesidePass {
            reach: self.bodies.reach(),
            volume: p.volume() * ONE,
            share: p.volume(),
            least: 0.5 * p.particle_spacing / p.scale.length_quantum(),
        }
    }

    /// Unit of exchanged energy, J/kg.
    fn unit(&self) -> f64 {
        let speed = self.bodies.parameters().sound_speed();
        speed * speed
    }

    /// The time so many steps after the last whole one, s.
    fn time(&self, system: &System<'_, A, D>, steps: f64) -> f64 {
        self.bodies.duration(system.clock.step as f64 + steps)
    }

    /// Walls look at the flow beside them.
    fn pretend<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        time: f64,
    ) -> Result<(), Fault> {
        let mirrored = self.parameters.wall_velocity == WallVelocity::Mirrored;
        exec.points(&NothingBeside, &mut system.particles)?;
        if mirrored {
            let sum = Sum::to_particles(Side::Particles, READ_OF_BESIDE, BESIDE);
            system.sum(exec, &self.beside_pass(), sum)?;
        }
        let pretend = Pretend {
            parameters: self.bodies.parameters().clone(),
            mirrored,
            progress: self.parameters.progress(time),
        };
        exec.points(&pretend, &mut system.particles)
    }

    /// The impulses of a kick of c time steps, from moments and distortions.
    fn impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        exec.points(&self.bodies.stresses(c), &mut system.particles)?;
        exec.points(&NoForces, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, READ_OF_FORCE, FORCES);
        system.sum(exec, &self.force_pass(), sum)?;
        let fall = self.bodies.fall::<A>(c);
        exec.points(&Collect { fall }, &mut system.particles)
    }

    /// v ← v + J, and the work that walls do meanwhile.
    fn kick<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        exec.points(&shears::Kick, &mut system.particles)?;
        let work = Work {
            parameters: self.bodies.parameters().clone(),
            fall: self.bodies.fall::<A>(c),
            progress: self.parameters.progress(self.time(system, 0.5)),
            unit: self.unit(),
        };
        exec.points(&work, &mut system.particles)
    }

    /// Particles of the flow drift, and walls turn.
    fn drift<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        let drift = walls::FlowDrift {
            drift: self.bodies.drift(c),
        };
        exec.points(&drift, &mut system.particles)?;
        if !self.turns {
            return Ok(());
        }
        let progress = self.parameters.progress(self.time(system, 0.5));
        let carry = Carry {
            parameters: self.bodies.parameters().clone(),
            half: 0.5 * self.bodies.duration(c) * progress,
        };
        exec.points(&carry, &mut system.particles)
    }
}

impl<A: Arithmetic, const D: usize> Model<A, D> for Flow<A, D> {
    const FIELDS: &'static [Field] = &FIELDS_OF_FLUIDS;
    const ENERGIES: &'static [&'static str] = energy::NAMES_OF_FLUIDS;
    const COLUMNS: &'static [Measure] = energy::columns_of_fluids(D);
    const HELD: Option<usize> = Some(HELD);
    const HELD_IS_WALL: bool = true;
    const REVERSIBILITY: Reversibility = Reversibility::UpToRounding;

    fn settings(&self) -> &Settings<D> {
        self.bodies.settings()
    }

    /// As solids; the ways to the surfaces of walls are given.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        self.place_walls(system, exec)?;
        self.bodies.begin(system, exec)?;
        let time = self.time(system, 0.0);
        self.pretend(system, exec, time)
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.bodies.moments(system, exec)
    }

    fn stages(&self, _: u64) -> impl Iterator<Item = Stage> {
        [Kick(0.5), Lift(0.5), Drift(1.0), Lift(0.5), Kick(0.5)].into_iter()
    }

    fn prepare<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Kick(c) => {
                self.bodies.moments(system, exec)?;
                self.impulses(system, exec, c)
            }
            Lift(_) => self.bodies.moments(system, exec),
            Drift(_) | Stage::Counterkick(_) | Stage::Relax => Ok(()),
        }
    }

    fn prepare_in_place<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Kick(c) => self.impulses(system, exec, c),
            Lift(_) => self.bodies.gradients(system, exec),
            Drift(_) | Stage::Counterkick(_) | Stage::Relax => Ok(()),
        }
    }

    fn apply<E: Executor>(
        &self,
        stage: Stage,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        match stage {
            Kick(c) => self.kick(system, exec, c),
            Drift(c) => self.drift(system, exec, c),
            Lift(_) => {
                let half = HalfStep::new(&self.parameters, self.unit(), false);
                exec.points(&half, &mut system.particles)?;
                // Kicks and lifts in one place see the walls with one velocity: what the ones take
                // is what the others give. Here both are done with, and nothing has moved.
                let time = self.time(system, 0.5);
                self.pretend(system, exec, time)
            }
            Stage::Counterkick(_) | Stage::Relax => Ok(()),
        }
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        let p = self.bodies.parameters();
        let mut energies = energy::energies(p, system);
        let set = system.particles.view();
        let exchanged = set.vectors::<A::Word, 2>(EXCHANGED);
        // The shear that walls pretend among themselves heats nothing: it is what they take.
        let [mut heat, mut drive] = [0i128; 2];
        for (held, x) in set.words(HELD).iter().zip(exchanged) {
            let [own, work] = x.map(|x| i128::from(x.whole_quanta()));
            drive += work;
            if held.whole_quanta() == 0 {
                heat += own;
            } else {
                drive += own;
            }
        }
        let unit = p.mass() * (self.unit() / ONE_ENERGY);
        energies[energy::EXCHANGED] = heat as f64 * unit;
        energies[energy::EXCHANGED + 1] = drive as f64 * unit;
        Ok(energies)
    }

    fn lone_particles(&self, system: &System<'_, A, D>) -> u64 {
        energy::lone_particles(system)
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        if column + 1 == Self::COLUMNS.len() {
            let exchanged = particles.vectors::<A::Word, 2>(EXCHANGED);
            return exchanged[place][0].quanta() * (self.unit() / ONE_ENERGY);
        }
        energy::column(self.bodies.parameters(), column, particles, place)
    }
}
