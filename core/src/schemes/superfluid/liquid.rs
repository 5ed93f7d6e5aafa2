//! What both superfluid schemes share: parameters, the sums over positions, and fluxes.

use super::devices::Hold;
use super::fields::{CARRIER, DENSITY, FLUXES, GRADIENT, ONE, ONE_RATE, SUMS};
use super::parameters::HeliumParameters;
use super::passes::{FluxPass, GradientPass, SumsPass};
use super::updates::{Add, Carry, NoFluxes, NoGradient, NoSums, Resolve, SetConstant};
use super::walls::{
    AddConstant, CarryWall, DensityPass, KeepDensity, NoDensity, PressurePass, SetWallConstant,
};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{IMPULSE, Side, VELOCITY};
use crate::kernel::Reach;
use crate::model::{Settings, SetupError};
use crate::number::{Arithmetic, Quantity};
use crate::pairs::PairPass;
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

    /// Densities alone.
    #[must_use]
    pub fn density_pass(&self) -> DensityPass {
        DensityPass {
            reach: self.reach,
            volume: self.parameters.volume() * ONE,
        }
    }

    /// What walls add to velocities in a kick of c time steps, of one copy of two or, with `PAPER`,
    /// of a single one.
    #[must_use]
    pub fn pressure_pass<const PAPER: bool>(&self, c: f64) -> PressurePass {
        let all = self.flux_pass(c);
        PressurePass {
            reach: self.reach,
            pressing: all.warming,
            momentum: if PAPER { 2.0 } else { 1.0 } * all.momentum,
        }
    }

    /// A drift of c time steps.
    #[must_use]
    pub fn drift(&self, c: f64) -> Drift {
        Drift::new(c * self.parameters.time_step, &self.parameters.scale)
    }

    /// What a superleak does in a kick of c time steps, where there is one.
    pub(super) fn hold(&self, c: f64) -> Option<Hold<D>> {
        let p = &self.parameters;
        p.superleak.map(|leak| Hold {
            leak,
            helium: p.helium,
            times: c * p.time_step / leak.time,
            length: p.scale.length_quantum(),
            speed: p.scale.speed_quantum(),
        })
    }

    /// C_a, which makes the first density ρ0, or that of the first pressure; and those of walls.
    pub(super) fn begin<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        self.sum_positions(system, exec)?;
        let set = SetConstant {
            parameters: self.parameters.clone(),
        };
        exec.points(&set, &mut system.particles)?;
        if system.walls.is_empty() {
            return Ok(());
        }
        self.sum_on_walls(system, exec, Side::Walls)?;
        exec.points(&KeepDensity, &mut system.walls)?;
        self.sum_on_walls(system, exec, Side::Particles)?;
        let set = SetWallConstant {
            parameters: self.parameters.clone(),
        };
        exec.points(&set, &mut system.walls)
    }

    /// Adds to a field of the liquid the terms of a pass with the liquid, and of another with walls.
    fn sum_over_all<A: Arithmetic, E: Executor, P: PairPass<D>>(
        system: &mut System<'_, A, D>,
        exec: &E,
        [of_liquid, of_walls]: [&P; 2],
        read: &[usize],
        into: usize,
    ) -> Result<(), Fault> {
        system.sum(
            exec,
            of_liquid,
            Sum::to_particles(Side::Particles, read, into),
        )?;
        if system.walls.is_empty() {
            return Ok(());
        }
        system.sum(exec, of_walls, Sum::to_particles(Side::Walls, read, into))
    }

    /// Densities, H and dt K of every particle, as sums.
    fn sum_positions<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        // Walls look for the liquid in its cells.
        let walled = !system.walls.is_empty();
        system.locate(exec, walled);
        exec.points(&NoSums, &mut system.particles)?;
        let pass = self.sums_pass();
        // Entropy does not pass, so that walls are no part of H.
        let of_walls = SumsPass {
            moment: 0.0,
            ..pass
        };
        Self::sum_over_all(system, exec, [&pass, &of_walls], &[VELOCITY], SUMS)
    }

    /// ϱ, H⁻¹ and dt K of every particle, and ϱ of walls.
    pub(super) fn sums<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if self.parameters.is_normal() {
            self.densities(system, exec)?;
        } else {
            self.sum_positions(system, exec)?;
            let operators = self.parameters.operators;
            exec.points(&Resolve { operators }, &mut system.particles)?;
        }
        if system.walls.is_empty() {
            return Ok(());
        }
        self.sum_on_walls(system, exec, Side::Particles)?;
        exec.points(&AddConstant, &mut system.walls)
    }

    /// Σ V0 W of every wall over the liquid or over the walls.
    fn sum_on_walls<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        from: Side,
    ) -> Result<(), Fault> {
        exec.points(&NoDensity, &mut system.walls)?;
        let sum = Sum::to_walls(from, &[], DENSITY);
        system.sum(exec, &self.density_pass(), sum)
    }

    /// ϱ of every particle, which is all that a normal liquid needs.
    fn densities<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let walled = !system.walls.is_empty();
        system.locate(exec, walled);
        exec.points(&NoDensity, &mut system.particles)?;
        let pass = self.density_pass();
        Self::sum_over_all(system, exec, [&pass, &pass], &[], DENSITY)?;
        exec.points(&AddConstant, &mut system.particles)
    }

    /// dt K alone, of particles that have not moved since the other sums were taken.
    pub(super) fn gradients<A: Arithmetic, E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        exec.points(&NoGradient, &mut system.particles)?;
        let pass = self.gradient_pass();
        Self::sum_over_all(system, exec, [&pass, &pass], &[VELOCITY], GRADIENT)
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
        let share = f64::from(u8::from(pressed));
        let carry = Carry::<COPY, PAPER> {
            helium: p.helium,
            speed: p.scale.speed_quantum(),
            pressed: share,
        };
        exec.points(&carry, &mut system.particles)?;
        exec.points(&NoFluxes, &mut system.particles)?;
        if !p.is_normal() {
            let sum = Sum::to_particles(Side::Particles, &[CARRIER], FLUXES);
            system.sum(exec, &self.flux_pass(c), sum)?;
        }
        let fall = if pressed {
            self.fall::<A>(c)
        } else {
            Some([A::Word::ZERO; D])
        };
        let add = Add::<A::Word, COPY, PAPER, D> { fall };
        exec.points(&add, &mut system.particles)?;
        let pass = self.pressure_pass::<PAPER>(c);
        if p.is_normal() {
            let sum = Sum::to_particles(Side::Particles, &[CARRIER], IMPULSE);
            system.sum(exec, &pass, sum)?;
        }
        if system.walls.is_empty() {
            return Ok(());
        }
        let carry = CarryWall {
            helium: p.helium,
            suction: p.suction,
            pressed: share,
        };
        exec.points(&carry, &mut system.walls)?;
        let sum = Sum::to_particles(Side::Walls, &[CARRIER], IMPULSE);
        system.sum(exec, &pass, sum)
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
