//! Energies, eq. (7), with the zero of the internal energy at the reference density.
//!
//! - kinetic       Σ m v²/2
//! - internal      Σ m ε(ρ), fluid; that of dummy walls counts as wall energy; and, where particles that
//!   are very near repel each other, Σ m (p0/ρ0²) Σ m W̃ (with dummies: twice that)
//! - gravitational -Σ m g·x, zero at the origin, minus Σ m GM/(|x|² + s²)^(1/2)
//! - wall          Σ m E (s - 1)²/4 (footnote 3: E per mass), or the dummies' m ε(ρ)

use crate::chain::nothing;
use crate::exact::ExactSum;
use crate::executor::Ids;
use crate::fault::{Fault, FaultKind};
use crate::model::Forces;
use crate::number::{Arithmetic, Quantity, Real};
use crate::pairs::{gather, separation};
use crate::state::System;

/// Energies in J (per m of depth in 2D).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Kinetic.
    pub kinetic: f64,
    /// Internal (compressional).
    pub internal: f64,
    /// Gravitational.
    pub gravitational: f64,
    /// Of the interaction with walls.
    pub wall: f64,
}

impl Energies {
    /// The Hamiltonian.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.internal + self.gravitational + self.wall
    }

    /// Measures a system whose densities are up to date.
    pub(super) fn measure<A: Arithmetic, const D: usize>(
        forces: &Forces<A, D>,
        system: &System<'_, A, D>,
    ) -> Result<Self, Fault> {
        let p = forces.parameters();
        let c2 = p.sound_speed * p.sound_speed;
        let internal = |densities: &[A::Density], ids: Ids<'_>| {
            let mut sum = ExactSum::default();
            let mut first: Option<Fault> = None;
            for (i, rho) in densities.iter().enumerate() {
                let x = forces.relative_density(*rho).to_f64();
                if x > 0.0 {
                    sum = sum.plus(p.state_equation.internal_energy(x));
                } else {
                    let fault = Fault::new(FaultKind::DensityNotPositive, ids.get(i));
                    first = Some(first.map_or(fault, |other| other.first(fault)));
                }
            }
            first.map_or(Ok(p.mass * c2 * sum.value()), Err)
        };
        let mut fluid = internal(system.scratch.density, Ids::Listed(system.state.id))?;
        if let Some((energy, pass)) = forces.anti_clump_energy_pass() {
            let mut sum = [ExactSum::default()];
            let others = forces.fluid(system, nothing());
            let walls = forces.walls(system, nothing());
            let dummies = forces.has_dummies(system);
            for (i, (x, id)) in system
                .state
                .position
                .iter()
                .zip(&*system.state.id)
                .enumerate()
            {
                let fault = |kind| Fault::new(kind, *id);
                gather(&pass, x, &[], &others, Some(i), &mut sum).map_err(fault)?;
                // Once for the particle and once for the dummy, which has no turn of its own.
                for _ in 0..2 * usize::from(dummies) {
                    gather(&pass, x, &[], &walls, None, &mut sum).map_err(fault)?;
                }
            }
            fluid += p.mass * energy * sum[0].value();
        }
        let mut wall = 0.0;
        if forces.has_dummies(system) {
            let ids = Ids::From(system.state.len() as u64);
            wall += internal(system.scratch.wall_density, ids)?;
        }
        if let Some((energy, pass)) = forces.wall_energy_pass() {
            let walls = forces.walls(system, nothing());
            let mut sum = [ExactSum::default()];
            for (x, id) in system.state.position.iter().zip(&*system.state.id) {
                gather(&pass, x, &[], &walls, None, &mut sum)
                    .map_err(|kind| Fault::new(kind, *id))?;
            }
            wall += p.mass * energy * sum[0].value();
        }
        Ok(Self {
            kinetic: kinetic(system) * 0.5 * p.mass * square(p.scale.speed_quantum()),
            internal: fluid,
            gravitational: gravitational(forces, system),
            wall,
        })
    }
}

fn square(x: f64) -> f64 {
    x * x
}

/// Σ v² in squared speed quanta, summed exactly.
fn kinetic<A: Arithmetic, const D: usize>(system: &System<'_, A, D>) -> f64 {
    let mut sum = 0i128;
    for v in system.state.velocity.iter().flatten() {
        let v = i128::from(v.whole_quanta());
        sum += v * v;
    }
    sum as f64
}

fn gravitational<A: Arithmetic, const D: usize>(
    forces: &Forces<A, D>,
    system: &System<'_, A, D>,
) -> f64 {
    let p = forces.parameters();
    let quantum = p.scale.length_quantum();
    let mut energy = 0.0;
    for (d, g) in p.gravity.uniform.iter().enumerate() {
        let sum: i128 = system
            .state
            .position
            .iter()
            .map(|x| i128::from(x[d].whole_quanta()))
            .sum();
        energy -= p.mass * g * (sum as f64 * quantum);
    }
    if let Some(central) = &p.gravity.central {
        let centre = forces.centre();
        // In units of the potential at one scene unit, so that the terms are of order one.
        let unit = quantum * crate::number::power_of_two(46);
        let mut sum = ExactSum::default();
        for x in &*system.state.position {
            let (_, r2) = separation::<A, D>(x, centre);
            let r2 = r2.to_f64() * square(quantum) + square(central.softening);
            sum = sum.plus(unit / libm::sqrt(r2));
        }
        energy -= p.mass * central.strength / unit * sum.value();
    }
    energy
}
