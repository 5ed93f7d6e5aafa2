//! What the schemes share: the fields, the passes with their factors, densities and impulses.
//!
//! - ρ_i = m W(0) + Σ R(m W(r_ij)) + C_i, over fluid and dummy walls                         (5)
//! - J_i = R(c dt g) - Σ R(c dt m (p_i/ρ_i² + p_j/ρ_j²) (W'/r) x_ij) + walls + repulsion     (1b)
//!
//! c is the kick's share of the time step dt. Symbols and units: [`Parameters`].

use super::fields::{DENSITY, PRESSURE};
use super::gravity::Pull;
use super::parameters::{DensityCorrection, Parameters, Wall};
use super::passes::{
    AntiClumpEnergyPass, AntiClumpPass, ContinuityPass, DensityPass, FilterPass, PressurePass,
    WallEnergyPass, WallGeometry, WallPass,
};
use super::updates::{Constants, FromFixed, OwnDensity, PressureFactor};
use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{IMPULSE, Side};
use crate::kernel::Reach;
use crate::model::{Settings, SetupError};
use crate::number::{Arithmetic, Quantity};
use crate::observe::BINS;
use crate::pairs::PairPass;
use crate::shears::Drift;
use crate::system::{Sum, System};

/// Weakly compressible water in D dimensions, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Water<A: Arithmetic, const D: usize> {
    parameters: Parameters<D>,
    reach: Reach,
    settings: Settings<D>,
    /// 1/ρ0 in 1/quanta of density.
    inverse_reference: f64,
    /// ρ0 and m W(0), rounded to density quanta.
    reference_density: A::Word,
    own_density: A::Word,
    /// Centre of the attracting mass.
    centre: [A::Word; D],
}

/// A number in quanta, if it is in range.
fn rounded<W: Quantity>(value: f64, quantum: f64, error: SetupError) -> Result<W, SetupError> {
    W::ZERO.add_rounded(value / quantum).ok_or(error)
}

impl<A: Arithmetic, const D: usize> Water<A, D> {
    /// Water with these parameters.
    ///
    /// # Errors
    /// [`SetupError`] for a number out of range.
    pub fn new(parameters: Parameters<D>) -> Result<Self, SetupError> {
        parameters.check()?;
        let p = &parameters;
        let (length, density) = (p.scale.length_quantum(), p.scale.density_quantum());
        let no = |name, value| SetupError::Parameter { name, value };
        let support_radius = p.support_radius;
        let of_walls = match p.wall {
            Wall::Conservative { radius, .. } => ("wall.radius", radius),
            Wall::Dummy | Wall::None => ("support_radius", support_radius),
        };
        let reach = Reach::new(D, support_radius, length);
        let own = reach.largest_value() * (p.mass / density);
        let mut centre = [A::Word::ZERO; D];
        if let Some(central) = &p.gravity.central {
            for (c, &metres) in centre.iter_mut().zip(&central.centre) {
                *c = rounded(metres, length, no("gravity.central.centre", metres))?;
            }
        }
        let reference = p.reference_density;
        Ok(Self {
            reach,
            // The flow is to be much slower than sound: the bins end at c/6.
            settings: p.settings(
                [("support_radius", support_radius), of_walls],
                p.sound_speed / (6.0 * BINS as f64),
            )?,
            inverse_reference: density / reference,
            reference_density: rounded(reference, density, no("reference_density", reference))?,
            own_density: rounded(own, 1.0, SetupError::Support { support_radius })?,
            centre,
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
    /// ρ/ρ0 of a density in quanta.
    #[inline]
    pub fn relative_density<Q: Quantity>(&self, density: Q) -> f64 {
        density.quanta() * self.inverse_reference
    }
    /// 1/ρ0 in 1/quanta of density.
    pub(super) fn inverse_reference(&self) -> f64 {
        self.inverse_reference
    }
    /// ρ0, in density quanta.
    #[must_use]
    pub fn reference_density(&self) -> A::Word {
        self.reference_density
    }
    /// m W(0), in density quanta.
    #[must_use]
    pub fn own_density(&self) -> A::Word {
        self.own_density
    }
    /// Centre of the attracting mass, in length quanta.
    #[must_use]
    pub fn centre(&self) -> &[A::Word; D] {
        &self.centre
    }
    /// c time steps, s.
    #[must_use]
    pub fn duration(&self, c: f64) -> f64 {
        c * self.parameters.time_step
    }

    /// The density sum (5).
    #[must_use]
    pub fn density_pass(&self) -> DensityPass {
        DensityPass {
            reach: self.reach,
            mass: self.parameters.mass / self.parameters.scale.density_quantum(),
        }
    }
    /// The pressure impulse (1b).
    #[must_use]
    pub fn pressure_pass(&self) -> PressurePass {
        PressurePass { reach: self.reach }
    }
    /// -κ m p/ρ² of a kick of `duration` seconds.
    #[must_use]
    pub fn pressure_factor(&self, duration: f64) -> PressureFactor {
        let p = &self.parameters;
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        let factor = (duration * p.mass) * (p.sound_speed * p.sound_speed / p.reference_density);
        PressureFactor {
            factor: -(factor * units),
            state_equation: p.state_equation,
            inverse_reference: self.inverse_reference,
        }
    }
    /// The pull of gravity in a kick of `duration` seconds.
    #[must_use]
    pub fn pull(&self, duration: f64) -> Pull<A, D> {
        Pull::new(&self.parameters, &self.centre, duration)
    }
    /// A drift of c time steps.
    #[must_use]
    pub fn drift(&self, c: f64) -> Drift {
        Drift::new(self.duration(c), &self.parameters.scale)
    }
    /// The continuity sum (1a) over `duration` seconds.
    #[must_use]
    pub fn continuity_pass(&self, duration: f64) -> ContinuityPass {
        let s = self.parameters.scale;
        let units = s.speed_quantum() * s.length_quantum() / s.density_quantum();
        ContinuityPass {
            reach: self.reach,
            factor: (duration * self.parameters.mass) * units,
        }
    }
    /// The filter's sum of velocity differences.
    #[must_use]
    pub fn filter_pass(&self) -> FilterPass {
        let p = &self.parameters;
        FilterPass {
            reach: self.reach,
            volume: p.mass / p.reference_density,
        }
    }
    /// W̃, with p0/ρ0² in J m³/kg² (2D: J m²/kg²), where there is such a repulsion.
    fn anti_clump(&self) -> Option<(f64, Reach)> {
        let p = &self.parameters;
        let clump = p.anti_clump.filter(|clump| clump.pressure > 0.0)?;
        let strength = clump.pressure / (p.reference_density * p.reference_density);
        let reach = Reach::new(D, clump.support_radius, p.scale.length_quantum());
        Some((strength, reach))
    }
    /// The repulsion of near particles over `duration` seconds, if there is one.
    #[must_use]
    pub fn anti_clump_pass(&self, duration: f64) -> Option<AntiClumpPass> {
        let (strength, reach) = self.anti_clump()?;
        let p = &self.parameters;
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        Some(AntiClumpPass {
            reach,
            factor: -((duration * p.mass) * (2.0 * strength) * units),
        })
    }
    /// The energy of near particles, if they repel each other, with its unit in J/kg for each of
    /// two particles.
    #[must_use]
    pub fn anti_clump_energy_pass(&self) -> Option<(f64, AntiClumpEnergyPass)> {
        let (strength, reach) = self.anti_clump()?;
        let most = reach.largest_value();
        let pass = AntiClumpEnergyPass {
            reach,
            factor: 1.0 / most,
        };
        Some((strength * self.parameters.mass * most, pass))
    }
    fn wall_geometry(&self) -> Option<(f64, WallGeometry)> {
        let Wall::Conservative {
            energy,
            radius,
            softening,
        } = self.parameters.wall
        else {
            return None;
        };
        let quantum = self.parameters.scale.length_quantum();
        let (r, e) = (radius / quantum, softening / quantum);
        let geometry = WallGeometry {
            radius_squared: r * r,
            softening_squared: e * e,
        };
        Some((energy, geometry))
    }
    /// The impulse of a conservative wall over `duration` seconds, if there is one.
    #[must_use]
    pub fn wall_pass(&self, duration: f64) -> Option<WallPass> {
        let (energy, geometry) = self.wall_geometry()?;
        let s = self.parameters.scale;
        let units = s.length_quantum() * s.speed_quantum();
        Some(WallPass {
            geometry,
            factor: (duration * energy) / units,
        })
    }
    /// The energy of a conservative wall, if there is one, with its unit E in J/kg.
    #[must_use]
    pub fn wall_energy_pass(&self) -> Option<(f64, WallEnergyPass)> {
        let (energy, geometry) = self.wall_geometry()?;
        Some((energy, WallEnergyPass { geometry }))
    }

    /// Whether walls take part in density and pressure.
    #[must_use]
    pub fn has_dummies(&self, system: &System<'_, A, D>) -> bool {
        matches!(self.parameters.wall, Wall::Dummy) && !system.walls.is_empty()
    }

    /// Makes the fluid findable at its present positions.
    pub fn locate<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) {
        // Dummies look for the fluid in its cells, and so does the energy of near particles.
        let for_others = self.has_dummies(system) || self.parameters.anti_clump.is_some();
        system.locate(exec, for_others);
    }

    /// Adds to a field of the fluid the terms of a pass with the fluid and with dummies.
    pub(super) fn sum_over_all<E: Executor, P: PairPass<D>>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        pass: &P,
        read: &[usize],
        into: usize,
    ) -> Result<(), Fault> {
        system.sum(exec, pass, Sum::to_particles(Side::Particles, read, into))?;
        if self.has_dummies(system) {
            system.sum(exec, pass, Sum::to_particles(Side::Walls, read, into))?;
        }
        Ok(())
    }

    /// m W(0) + Σ m W of every fluid particle.
    pub(super) fn bare_densities<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        exec.points(&self.own(), &mut system.particles)?;
        self.sum_over_all(system, exec, &self.density_pass(), &[], DENSITY)
    }

    /// ρ of every dummy.
    pub(super) fn dummy_densities<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        if !self.has_dummies(system) {
            return Ok(());
        }
        exec.points(&FromFixed, &mut system.walls)?;
        let of_fluid = Sum::to_walls(Side::Particles, &[], DENSITY);
        system.sum(exec, &self.density_pass(), of_fluid)
    }

    /// A density's first term.
    pub(super) fn own(&self) -> OwnDensity<A::Word> {
        OwnDensity {
            own: self.own_density,
        }
    }

    /// What makes density constants of sums.
    pub(super) fn constants(&self) -> Constants<A::Word> {
        Constants {
            reference: match self.parameters.density_correction {
                DensityCorrection::Constant => Some(self.reference_density),
                DensityCorrection::None => None,
            },
        }
    }

    /// The impulses of a kick of c time steps, from the densities.
    pub(super) fn impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        let duration = self.duration(c);
        let pressures = self.pressure_factor(duration);
        exec.points(&pressures, &mut system.particles)?;
        if self.has_dummies(system) {
            exec.points(&pressures, &mut system.walls)?;
        }
        exec.points(&self.pull(duration), &mut system.particles)?;
        self.sum_over_all(system, exec, &self.pressure_pass(), &[PRESSURE], IMPULSE)?;
        self.short_impulses(system, exec, duration)
    }

    /// Adds the impulses of very near particles and of the conservative wall, where there are such.
    ///
    /// # Errors
    /// As a step.
    pub fn short_impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        duration: f64,
    ) -> Result<(), Fault> {
        if let Some(pass) = self.anti_clump_pass(duration) {
            self.sum_over_all(system, exec, &pass, &[], IMPULSE)?;
        }
        if let Some(pass) = self.wall_pass(duration) {
            let of_walls = Sum::to_particles(Side::Walls, &[], IMPULSE);
            system.sum(exec, &pass, of_walls)?;
        }
        Ok(())
    }
}
