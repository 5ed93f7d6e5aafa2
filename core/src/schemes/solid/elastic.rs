//! The step of a solid.
//!
//! State: x, v, the unimodular distortion A, θ. The semi-discrete equations are (23) with the
//! penalty (42),
//!
//! - dx/dt = v,  dv/dt = Σ V0 ((T_a + T_b) W' e - (c_p²λ_a + c_p²λ_b) s x_ab) + g
//! - dA/dt = -A (L - (tr L/D) 1),  dθ/dt = -tr L/D,  L = K H⁻¹
//!
//! with T = -ρ0 ∂ε_0/∂ρ 1 + S H⁻¹: in this order, S on the left, and at one x with H, the force is
//! -dE/dx to the last digit and exerts no torque. A step is the palindrome
//!
//! - kick(½): J from x, A, θ;  v ← v + J
//! - lift(½): dt L from x, v;  A, θ by [`lift`](crate::lift)
//! - drift(1): x ← x + R(dt v)
//! - lift(½), kick(½) the same
//!
//! and [`Midpoint`] has the paper's (49): half drifts, and between them A by Cayley's
//! transformation of L at the middle, which is rounded and so not undone exactly.
//!
//! Held particles receive no impulse; they carry A and take part in all sums.
//!
//! Source: Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, section 3.

use super::bodies::Bodies;
use super::energy;
use super::fields::{FIELDS, HELD};
use super::parameters::Parameters;
use super::passes::ForcePass;
use super::updates::{Advance, Hold, Midpoint as CayleyAdvance, READ_OF_FORCE};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Field, IMPULSE, Side};
use crate::integrator::Stage::{self, Drift, Kick, Lift};
use crate::model::{MAX_ENERGIES, Measure, Model, Reversibility, Settings, SetupError};
use crate::number::Arithmetic;
use crate::set::SetView;
use crate::shears;
use crate::system::{Sum, System};
use core::fmt::Debug;
use core::marker::PhantomData;

/// How a step is composed.
pub trait Composition: Copy + Debug + Send + Sync + 'static {
    /// The table.
    const STAGES: &'static [Stage];
    /// Whether the distortion is advanced by what can be undone.
    const EXACT: bool;
}

/// Kicks and lifts before and after the drift.
#[derive(Clone, Copy, Debug)]
pub struct Palindrome;

impl Composition for Palindrome {
    const STAGES: &'static [Stage] = &[Kick(0.5), Lift(0.5), Drift(1.0), Lift(0.5), Kick(0.5)];
    const EXACT: bool = true;
}

/// The paper's (49).
#[derive(Clone, Copy, Debug)]
pub struct Middle;

impl Composition for Middle {
    const STAGES: &'static [Stage] = &[Kick(0.5), Drift(0.5), Lift(1.0), Drift(0.5), Kick(0.5)];
    const EXACT: bool = false;
}

/// The reversible solid.
pub type Solid<A, const D: usize> = Elastic<A, Palindrome, D>;
/// The solid with the paper's own integrator.
pub type Midpoint<A, const D: usize> = Elastic<A, Middle, D>;

/// Elastic bodies ("model B" without relaxation).
#[derive(Clone, Debug)]
pub struct Elastic<A: Arithmetic, C, const D: usize> {
    bodies: Bodies<D>,
    of: PhantomData<(A, C)>,
}

impl<A: Arithmetic, C: Composition, const D: usize> Elastic<A, C, D> {
    /// Bodies with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn new(parameters: Parameters<D>) -> Result<Self, SetupError> {
        Ok(Self {
            bodies: Bodies::new(parameters)?,
            of: PhantomData,
        })
    }

    /// What solids and fluids share.
    #[must_use]
    pub fn bodies(&self) -> &Bodies<D> {
        &self.bodies
    }

    /// The force.
    #[must_use]
    pub fn force_pass(&self) -> ForcePass {
        ForcePass {
            reach: self.bodies.reach(),
        }
    }

    /// The impulses of a kick of c time steps, from moments and distortions.
    fn impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        exec.points(&self.bodies.stresses(c), &mut system.particles)?;
        exec.points(&self.bodies.fall::<A>(c), &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, READ_OF_FORCE, IMPULSE);
        system.sum(exec, &self.force_pass(), sum)?;
        exec.points(&Hold, &mut system.particles)
    }
}

impl<A: Arithmetic, C: Composition, const D: usize> Model<A, D> for Elastic<A, C, D> {
    const FIELDS: &'static [Field] = &FIELDS;
    const ENERGIES: &'static [&'static str] = energy::NAMES;
    const COLUMNS: &'static [Measure] = energy::columns(D);
    const HELD: Option<usize> = Some(HELD);
    const REVERSIBILITY: Reversibility = if A::EXACT && C::EXACT {
        Reversibility::BitExact
    } else {
        Reversibility::UpToRounding
    };

    fn settings(&self) -> &Settings<D> {
        self.bodies.settings()
    }

    /// A ← 1, θ ← 0, and the constants that make the first density ρ0 and the first λ 0.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        self.place_walls(system, exec)?;
        self.bodies.begin(system, exec)
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.bodies.moments(system, exec)
    }

    fn stages(&self, _: u64) -> impl Iterator<Item = Stage> {
        C::STAGES.iter().copied()
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
        let particles = &mut system.particles;
        match stage {
            Kick(_) => exec.points(&shears::Kick, particles),
            Drift(c) => exec.points(&self.bodies.drift(c), particles),
            Lift(share) if C::EXACT => exec.points(&Advance { share }, particles),
            Lift(share) => exec.points(&CayleyAdvance { share }, particles),
            Stage::Counterkick(_) | Stage::Relax => Ok(()),
        }
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        Ok(energy::energies(self.bodies.parameters(), system))
    }

    fn lone_particles(&self, system: &System<'_, A, D>) -> u64 {
        energy::lone_particles(system)
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        energy::column(self.bodies.parameters(), column, particles, place)
    }
}
