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

use super::energy;
use super::fields::{FIELDS, GRADIENT, MOMENTS, ONE, ONE_RATE};
use super::parameters::Parameters;
use super::passes::{ForcePass, GradientPass, MomentsPass, Reach};
use super::updates::{
    Advance, Begin, Fall, Hold, Midpoint as CayleyAdvance, NoGradient, NoMoments, READ_OF_FORCE,
    Resolve, SetConstants, Stresses,
};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Field, IMPULSE, Side, VELOCITY};
use crate::integrator::Stage::{self, Drift, Kick, Lift};
use crate::model::{MAX_ENERGIES, Measure, Model, Reversibility, Settings, SetupError};
use crate::number::{Arithmetic, Quantity};
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
    parameters: Parameters<D>,
    settings: Settings<D>,
    reach: Reach,
    of: PhantomData<(A, C)>,
}

/// What sums over velocities read.
const READ_OF_GRADIENT: &[usize] = &[VELOCITY, super::fields::BODY];

impl<A: Arithmetic, C: Composition, const D: usize> Elastic<A, C, D> {
    /// Bodies with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn new(parameters: Parameters<D>) -> Result<Self, SetupError> {
        parameters.check()?;
        let quantum = parameters.scale.length_quantum();
        Ok(Self {
            settings: parameters.settings()?,
            reach: Reach::new(D, parameters.support_radius, quantum),
            parameters,
            of: PhantomData,
        })
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &Parameters<D> {
        &self.parameters
    }

    /// The sum dt K.
    #[must_use]
    pub fn gradient_pass(&self) -> GradientPass {
        let p = &self.parameters;
        let units = p.scale.length_quantum() * p.scale.speed_quantum() * ONE_RATE;
        GradientPass {
            reach: self.reach,
            rate: (p.time_step * p.volume()) * units,
        }
    }

    /// All sums over positions, and dt K.
    #[must_use]
    pub fn moments_pass(&self) -> MomentsPass {
        let p = &self.parameters;
        let quantum = p.scale.length_quantum();
        MomentsPass {
            gradient: self.gradient_pass(),
            moment: (p.volume() * ONE) * (quantum * quantum),
            volume: p.volume() * ONE,
        }
    }

    /// The force.
    #[must_use]
    pub fn force_pass(&self) -> ForcePass {
        ForcePass { reach: self.reach }
    }

    /// Stresses for a kick of `duration` seconds.
    fn stresses(&self, duration: f64) -> Stresses {
        let p = &self.parameters;
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        Stresses {
            materials: p.materials.clone(),
            factor: (duration * p.volume()) * units,
        }
    }

    /// The pull of gravity in a kick of `duration` seconds.
    fn fall(&self, duration: f64) -> Fall<A::Word, D> {
        let quantum = self.parameters.scale.speed_quantum();
        let mut impulse = Some([A::Word::ZERO; D]);
        for (d, g) in self.parameters.gravity.iter().enumerate() {
            let rounded = A::Word::ZERO.add_rounded(duration * g / quantum);
            impulse = impulse.zip(rounded).map(|(mut impulse, word)| {
                impulse[d] = word;
                impulse
            });
        }
        Fall { impulse }
    }

    /// H, ρ, λ and dt K of every particle, as sums.
    fn sum_moments<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        // The sums over the particles are all there are.
        system.locate(exec, false);
        exec.points(&NoMoments, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, READ_OF_GRADIENT, MOMENTS);
        system.sum(exec, &self.moments_pass(), sum)
    }

    /// H⁻¹, ρ, λ and dt K of every particle.
    fn moments<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.sum_moments(system, exec)?;
        exec.points(&Resolve, &mut system.particles)
    }

    /// dt K alone, of particles that have not moved since the moments were summed.
    fn gradients<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        exec.points(&NoGradient, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, READ_OF_GRADIENT, GRADIENT);
        system.sum(exec, &self.gradient_pass(), sum)
    }

    /// The impulses of a kick of c time steps, from moments and distortions.
    fn impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        let duration = c * self.parameters.time_step;
        exec.points(&self.stresses(duration), &mut system.particles)?;
        exec.points(&self.fall(duration), &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, READ_OF_FORCE, IMPULSE);
        system.sum(exec, &self.force_pass(), sum)?;
        exec.points(&Hold, &mut system.particles)
    }
}

impl<A: Arithmetic, C: Composition, const D: usize> Model<A, D> for Elastic<A, C, D> {
    const FIELDS: &'static [Field] = &FIELDS;
    const ENERGIES: &'static [&'static str] = energy::NAMES;
    const COLUMNS: &'static [Measure] = energy::columns(D);
    const REVERSIBILITY: Reversibility = if A::EXACT && C::EXACT {
        Reversibility::BitExact
    } else {
        Reversibility::UpToRounding
    };

    fn settings(&self) -> &Settings<D> {
        &self.settings
    }

    /// A ← 1, θ ← 0, and the constants that make the first density ρ0 and the first λ 0.
    fn initialise<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        system.clock.initialised = true;
        self.place_walls(system, exec)?;
        let parameters = self.parameters.clone();
        exec.points(&Begin { parameters }, &mut system.particles)?;
        self.sum_moments(system, exec)?;
        exec.points(&SetConstants, &mut system.particles)
    }

    fn refresh<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        self.moments(system, exec)
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
                self.moments(system, exec)?;
                self.impulses(system, exec, c)
            }
            Lift(_) => self.moments(system, exec),
            Drift(_) | Stage::Relax => Ok(()),
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
            Lift(_) => self.gradients(system, exec),
            Drift(_) | Stage::Relax => Ok(()),
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
            Drift(c) => {
                let duration = c * self.parameters.time_step;
                let drift = shears::Drift::new(duration, &self.parameters.scale);
                exec.points(&drift, particles)
            }
            Lift(share) if C::EXACT => exec.points(&Advance { share }, particles),
            Lift(share) => exec.points(&CayleyAdvance { share }, particles),
            Stage::Relax => Ok(()),
        }
    }

    fn energies(&self, system: &System<'_, A, D>) -> Result<[f64; MAX_ENERGIES], Fault> {
        Ok(energy::energies(&self.parameters, system))
    }

    fn column(&self, column: usize, particles: &SetView<'_, A, D>, place: usize) -> f64 {
        energy::column(&self.parameters, column, particles, place)
    }
}
