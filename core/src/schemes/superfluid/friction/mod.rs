//! Friction of the normal component and diffusion of heat, which make a superfluid dissipative.
//!
//! After every step of the reversible scheme the two copies of the state are merged, and then, at
//! fixed positions and densities, with g = V0 W'/r and ϱ = ρ/ρ0,
//!
//! - v and u change by Δv = dt Σ 2 (D + 2) (μ/ρ0) g (v_n,ij·x_ij) x_ij/((r² + η²) ϱ_i ϱ_j)   (19)
//! - a particle receives the heat of conduction, dt Σ (β/ρ0) g (T_i² - T_j²)/(ϱ_i ϱ_j), per mass
//! - and of friction, half of what each pair loses, with the mean of v_n before and after:
//!   -dt Σ (D + 2) (μ/ρ0) g (v_n,ij·x_ij) (v̄_n,ij·x_ij)/((r² + η²) ϱ_i ϱ_j)
//! - s changes so that the energy (15) grows by that heat;
//! - before that u decays by mutual friction ([`mutual`]), whose heat is added.
//!
//! v_s feels no other friction. The energy of a particle changes by v̄_n·Δv, exactly, so nothing is lost
//! but by rounding. Heat instead of entropy is what is conducted: β g (T_i² - T_j²) is what the
//! paper's entropy flux 2 β g (T_i - T_j) and the production of its (23) come to together, and it is
//! the negative for the partner. (The second factor of (23) is printed twice too large.) η is a
//! tenth of the paper's h.
//!
//! A wall takes part with its own velocity, which is that of a lid or 0, and with the temperature
//! T0, in place of a particle's; the heat of what rubs against it is all the particle's. It takes
//! the heat that it conducts, and J·v_b of the impulse J that it receives, which a lid gives.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, sections II B and II D.

mod mutual;
mod passes;
mod updates;

pub use passes::{FrictionPass, HeatPass, Normal, Rubbed, Rubbing};

use super::devices::{Give, Weigh};
use super::fields::{HEAT, HEATING, NORMAL, ONE_LEDGER, ONE_WARMTH, RUBBED, RUBBING};
use super::liquid::Liquid;
use super::parameters::HeliumParameters;
use super::reversible::Doubled;
use crate::executor::Executor;
use crate::fault::{Fault, FaultKind};
use crate::fields::Side;
use crate::integrator::Stage;
use crate::kernel::Reach;
use crate::model::{Dissipative, Model, Relax, SetupError};
use crate::number::{Arithmetic, Quantity};
use crate::system::{Sum, System};
use mutual::Mutual;
use updates::{FindNormal, Merge, NotRubbed, Push, Take, WallNormal, Warm};

/// Superfluid helium with friction.
pub type DissipativeSuperfluid<A, const D: usize> = Dissipative<Friction<A, D>>;

/// The friction, and the scheme between two of it.
#[derive(Clone, Debug)]
pub struct Friction<A: Arithmetic, const D: usize> {
    scheme: Doubled<A, D, true>,
}

/// The passes of helium with these parameters.
fn passes<const D: usize>(p: &HeliumParameters<D>, reach: Reach) -> (FrictionPass, HeatPass) {
    let (length, speed) = (p.scale.length_quantum(), p.scale.speed_quantum());
    // The paper's h is half of the support.
    let softening = p.support_radius / 20.0 / length;
    let share = p.time_step * p.volume() / p.helium.reference_density;
    let of_pair = share * (D as f64 + 2.0) * p.viscosity;
    let unit = heat_quantum(p);
    let friction = FrictionPass {
        reach,
        softening: softening * softening,
        friction: 2.0 * of_pair,
        conduction: share * p.diffusion / unit,
    };
    let heat = HeatPass {
        of: friction,
        heat: -of_pair * (speed * speed / unit),
    };
    (friction, heat)
}

/// J/kg.
pub(super) fn heat_quantum<const D: usize>(p: &HeliumParameters<D>) -> f64 {
    p.heat_speed() * p.heat_speed() / ONE_WARMTH
}

impl<A: Arithmetic, const D: usize> Friction<A, D> {
    /// Helium with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn superfluid(
        parameters: HeliumParameters<D>,
    ) -> Result<DissipativeSuperfluid<A, D>, SetupError> {
        let scheme = Doubled::new(parameters)?;
        Ok(Dissipative(Self { scheme }))
    }

    /// What all superfluid schemes share.
    #[must_use]
    pub fn liquid(&self) -> &Liquid<D> {
        self.scheme.liquid()
    }

    /// The sums of friction.
    #[must_use]
    pub fn friction_passes(&self) -> (FrictionPass, HeatPass) {
        passes(self.liquid().parameters(), self.liquid().reach())
    }

    /// The same where the liquid meets walls, which have a conduction of their own and leave all
    /// of a pair's heat to the liquid.
    #[must_use]
    pub fn wall_passes(&self) -> (FrictionPass, HeatPass) {
        let p = self.liquid().parameters();
        let with_unit_conduction = HeliumParameters {
            diffusion: 1.0,
            ..p.clone()
        };
        let (friction, mut heat) = passes(&with_unit_conduction, self.liquid().reach());
        heat.heat *= 2.0;
        (friction, heat)
    }

    /// Mutual friction in a step.
    fn mutual(&self) -> Mutual {
        let p = self.liquid().parameters();
        Mutual {
            helium: p.helium,
            strength: 2.0 * p.mutual_friction * p.helium.reference_density * p.time_step,
            speed: p.scale.speed_quantum(),
            heat: heat_quantum(p),
        }
    }

    /// Impulses of friction and conducted heat of all.
    fn rub<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let p = self.liquid().parameters();
        exec.points(&NotRubbed, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, &[NORMAL], RUBBED);
        system.sum(exec, &self.friction_passes().0, sum)?;
        if system.walls.is_empty() {
            return Ok(());
        }
        let walls = WallNormal {
            parameters: p.clone(),
            first: system.particles.len() as u64,
        };
        exec.points(&walls, &mut system.walls)?;
        let pass = self.wall_passes().0;
        let sum = Sum::to_particles(Side::Walls, &[NORMAL], RUBBED);
        system.sum(exec, &pass, sum)?;
        exec.points(&NotRubbed, &mut system.walls)?;
        let sum = Sum::to_walls(Side::Particles, &[NORMAL], RUBBED);
        system.sum(exec, &pass, sum)?;
        let speed = p.scale.speed_quantum();
        let heat = ONE_LEDGER / ONE_WARMTH;
        let work = speed * speed / heat_quantum(p) * heat;
        exec.points(&Take { work, heat }, &mut system.walls)
    }

    /// Heats of what has rubbed, and of the heater.
    fn heats<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let sum = Sum::to_particles(Side::Particles, &[RUBBING], HEAT);
        system.sum(exec, &self.friction_passes().1, sum)?;
        if !system.walls.is_empty() {
            let sum = Sum::to_particles(Side::Walls, &[RUBBING], HEAT);
            system.sum(exec, &self.wall_passes().1, sum)?;
        }
        let p = self.liquid().parameters();
        let Some(heater) = p.heater else {
            return Ok(());
        };
        let length = p.scale.length_quantum();
        exec.points(&Weigh { heater, length }, &mut system.particles)?;
        let shares = system.particles.words(HEATING).iter();
        let sum: i128 = shares.map(|share| i128::from(share.whole_quanta())).sum();
        if sum == 0 {
            return Err(Fault::new(FaultKind::HeaterDry, 0));
        }
        let of_all = heater.power * p.time_step / (p.mass() * heat_quantum(p));
        let factor = of_all / sum as f64;
        exec.points(&Give { factor }, &mut system.particles)
    }
}

impl<A: Arithmetic, const D: usize> Relax<A, D> for Friction<A, D> {
    type Scheme = Doubled<A, D, true>;

    fn scheme(&self) -> &Doubled<A, D, true> {
        &self.scheme
    }

    fn stages(&self, step: u64) -> impl Iterator<Item = Stage> {
        self.scheme.stages(step).chain([Stage::Relax])
    }

    /// The kick before has left the sums over positions, and nothing moves here.
    fn relax<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let p = self.liquid().parameters();
        let (helium, speed) = (p.helium, p.scale.speed_quantum());
        exec.points(&Merge, &mut system.particles)?;
        exec.points(&FindNormal { helium, speed }, &mut system.particles)?;
        self.rub(system, exec)?;
        let pulls = !p.is_normal();
        exec.points(&Push { helium, pulls }, &mut system.particles)?;
        self.heats(system, exec)?;
        if pulls && p.mutual_friction > 0.0 {
            exec.points(&self.mutual(), &mut system.particles)?;
        }
        let warm = Warm {
            helium,
            speed,
            heat: heat_quantum(p),
        };
        exec.points(&warm, &mut system.particles)
    }
}
