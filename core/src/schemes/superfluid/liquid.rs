//! What both superfluid schemes share: parameters, the sums over positions, and fluxes.

use super::fields::{CARRIER, FLUXES, GRADIENT, ONE, ONE_RATE, SUMS};
use super::parameters::HeliumParameters;
use super::passes::{FluxPass, GradientPass, SumsPass};
use super::updates::{Add, Carry, NoFluxes, NoGradient, NoSums, Resolve, SetConstant};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Side, VELOCITY};
use crate::kernel::Reach;
use crate::model::{Settings, SetupError};
use crate::number::{Arithmetic, Quantity};
use crate::shears::Drift;
use crate::system::{Sum, System};

/// Helium of particles, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Liquid<const D: usize> {
    parameters: HeliumParameters<D>,
    settings: Settings<D>,
    reach: Reach,
}

impl<const D: usize> Liquid<D> {
    /// Helium with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn new(parameters: HeliumParameters<D>) -> Result<Self, SetupError> {
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
    pub fn parameters(&self) -> &HeliumParameters<D> {
        &self.parameters
    }

    /// What every model says of itself.
    #[must_use]
    pub fn settings(&self) -> &Settings<D> {
        &self.settings
    }

    /// The kernel and where it ends.
    pub(super) fn reach(&self) -> Reach {
        self.reach
    }

    /// V0 times a duration of c time steps.
    fn share(&self, c: f64) -> f64 {
        (c * self.parameters.time_step) * self.parameters.volume()
    }

    /// The sum dt K.
    #[must_use]
    pub fn gradient_pass(&self) -> GradientPass {
        let scale = &self.parameters.scale;
        let units = scale.length_quantum() * scale.speed_quantum() * ONE_RATE;
        GradientPass {
            reach: self.reach,
            rate: self.share(1.0) * units,
        }
    }

    /// All sums over positions, and dt K.
    #[must_use]
    pub fn sums_pass(&self) -> SumsPass {
        let p = &self.parameters;
        let quantum = p.scale.length_quantum();
        SumsPass {
            gradient: self.gradient_pass(),
            moment: (p.volume() * ONE) * (quantum * quantum),
            volume: p.volume() * ONE,
        }
    }

    /// Fluxes in a kick of c time steps.
    #[must_use]
    pub fn flux_pass(&self, c: f64) -> FluxPass {
        let scale = &self.parameters.scale;
        let (length, speed) = (scale.length_quantum(), scale.speed_quantum());
        let share = self.share(c);
        FluxPass {
            reach: self.reach,
            momentum: -0.5 * share * (length * speed),
            entropy: -share * (length * speed * ONE),
            stretching: share * (length * speed * ONE_RATE),
            warming: share * (length / speed),
        }
    }

    /// A drift of c time steps.
    #[must_use]
    pub fn drift(&self, c: f64) -> Drift {
        Drift::new(c * self.parameters.time_step, &self.parameters.scale)
    }

    /// C_a, which makes the first density ρ0.
    pub(super) fn begin<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.sum_positions(system, exec)?;
        exec.points(&SetConstant, &mut system.particles)
    }

    /// Densities, H and dt K of every particle, as sums.
    fn sum_positions<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        // The sums over the particles are all there are.
        system.locate(exec, false);
        exec.points(&NoSums, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, &[VELOCITY], SUMS);
        system.sum(exec, &self.sums_pass(), sum)
    }

    /// ϱ, H⁻¹ and dt K of every particle.
    pub(super) fn sums<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.sum_positions(system, exec)?;
        let operators = self.parameters.operators;
        exec.points(&Resolve { operators }, &mut system.particles)
    }

    /// dt K alone, of particles that have not moved since the other sums were taken.
    pub(super) fn gradients<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        exec.points(&NoGradient, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, &[VELOCITY], GRADIENT);
        system.sum(exec, &self.gradient_pass(), sum)
    }

    /// What a kick of c time steps adds, from the sums over positions: of the copy or, without
    /// `COPY`, of the first; with pressures and gravity where they are asked for.
    pub(super) fn fluxes<A: Arithmetic, E: Executor, const COPY: bool, const PAPER: bool>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
        pressed: bool,
    ) -> Result<(), Fault> {
        let p = &self.parameters;
        let carry = Carry::<COPY, PAPER> {
            helium: p.helium,
            speed: p.scale.speed_quantum(),
            pressed: f64::from(u8::from(pressed)),
        };
        exec.points(&carry, &mut system.particles)?;
        exec.points(&NoFluxes, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, &[CARRIER], FLUXES);
        system.sum(exec, &self.flux_pass(c), sum)?;
        let fall = if pressed {
            self.fall::<A>(c)
        } else {
            Some([A::Word::ZERO; D])
        };
        let add = Add::<A::Word, COPY, PAPER, D> { fall };
        exec.points(&add, &mut system.particles)
    }

    /// The pull of gravity in a kick of c time steps; none where it is out of range.
    fn fall<A: Arithmetic>(&self, c: f64) -> Option<[A::Word; D]> {
        let quantum = self.parameters.scale.speed_quantum();
        let mut impulse = [A::Word::ZERO; D];
        for (word, g) in impulse.iter_mut().zip(&self.parameters.gravity) {
            *word = word.add_rounded((c * self.parameters.time_step) * g / quantum)?;
        }
        Some(impulse)
    }
}
