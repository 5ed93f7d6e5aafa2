//! What solids and fluids with a distortion share: parameters, the sums over positions, and dt K.

use super::fields::{BODY, GRADIENT, MOMENTS, ONE, ONE_RATE};
use super::parameters::Parameters;
use super::passes::{GradientPass, MomentsPass};
use super::updates::{Begin, Fall, NoGradient, NoMoments, Resolve, SetConstants, Stresses};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Side, VELOCITY};
use crate::kernel::Reach;
use crate::model::{Settings, SetupError};
use crate::number::{Arithmetic, Quantity};
use crate::shears::Drift;
use crate::system::{Sum, System};

/// What sums over velocities read.
const READ_OF_GRADIENT: &[usize] = &[VELOCITY, BODY];

/// Bodies of particles with a distortion, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Bodies<const D: usize> {
    parameters: Parameters<D>,
    settings: Settings<D>,
    reach: Reach,
}

impl<const D: usize> Bodies<D> {
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
        })
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &Parameters<D> {
        &self.parameters
    }

    /// What every model says of itself.
    #[must_use]
    pub fn settings(&self) -> &Settings<D> {
        &self.settings
    }

    /// The kernel and where it ends.
    #[must_use]
    pub fn reach(&self) -> Reach {
        self.reach
    }

    /// c time steps, s.
    #[must_use]
    pub fn duration(&self, c: f64) -> f64 {
        c * self.parameters.time_step
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

    /// Stresses for a kick of c time steps.
    pub(super) fn stresses(&self, c: f64) -> Stresses {
        let p = &self.parameters;
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        Stresses {
            materials: p.materials.clone(),
            factor: (self.duration(c) * p.volume()) * units,
        }
    }

    /// The pull of gravity in a kick of c time steps.
    pub(super) fn fall<A: Arithmetic>(&self, c: f64) -> Fall<A::Word, D> {
        let quantum = self.parameters.scale.speed_quantum();
        let mut impulse = Some([A::Word::ZERO; D]);
        for (d, g) in self.parameters.gravity.iter().enumerate() {
            let rounded = A::Word::ZERO.add_rounded(self.duration(c) * g / quantum);
            impulse = impulse.zip(rounded).map(|(mut impulse, word)| {
                impulse[d] = word;
                impulse
            });
        }
        Fall { impulse }
    }

    /// A drift of c time steps.
    #[must_use]
    pub fn drift(&self, c: f64) -> Drift {
        Drift::new(self.duration(c), &self.parameters.scale)
    }

    /// A ← 1, θ ← 0, and the constants that make the first density ρ0 and the first λ 0.
    pub(super) fn begin<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let parameters = self.parameters.clone();
        exec.points(&Begin { parameters }, &mut system.particles)?;
        self.sum_moments(system, exec)?;
        exec.points(&SetConstants, &mut system.particles)
    }

    /// H, ρ, λ and dt K of every particle, as sums.
    fn sum_moments<A: Arithmetic, E: Executor>(
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
    pub(super) fn moments<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.sum_moments(system, exec)?;
        exec.points(&Resolve, &mut system.particles)
    }

    /// dt K alone, of particles that have not moved since the moments were summed.
    pub(super) fn gradients<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        exec.points(&NoGradient, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, READ_OF_GRADIENT, GRADIENT);
        system.sum(exec, &self.gradient_pass(), sum)
    }
}
