//! Energies, eq. (7), with the zero of the internal energy at the reference density; and what is
//! recorded of a particle.
//!
//! - internal      Σ m ε(ρ), fluid; that of dummy walls counts as wall energy; and, where particles
//!   that are very near repel each other, Σ m (p0/ρ0²) Σ m W̃ (with dummies: twice that)
//! - gravitational -Σ m g·x, zero at the origin, minus Σ m GM/(|x|² + s²)^(1/2)
//! - wall          Σ m E (s - 1)²/4 (footnote 3: E per mass), or the dummies' m ε(ρ)

use super::fields::DENSITY;
use super::water::Water;
use crate::exact::ExactSum;
use crate::fault::{Fault, FaultKind};
use crate::fields::Side;
use crate::model::{MAX_ENERGIES, Measure};
use crate::number::{Arithmetic, Quantity};
use crate::observe::sum_over_pairs;
use crate::set::SetView;
use crate::system::System;

/// Kinds of energy.
pub(super) const NAMES: &[&str] = &["kinetic", "internal", "gravitational", "wall"];

/// What is recorded of a particle.
pub(super) const COLUMNS: &[Measure] = &[
    Measure {
        name: "density",
        unit: "kg/m³",
    },
    Measure {
        name: "pressure",
        unit: "Pa",
    },
];

/// Density or pressure of a particle.
pub(super) fn column<A: Arithmetic, const D: usize>(
    water: &Water<A, D>,
    column: usize,
    particles: &SetView<'_, A, D>,
    place: usize,
) -> f64 {
    let p = water.parameters();
    let density = particles.words(DENSITY)[place].quanta() * p.scale.density_quantum();
    if column == 0 {
        return density;
    }
    let stiffness = p.sound_speed * p.sound_speed * p.reference_density;
    stiffness * p.state_equation.pressure(density / p.reference_density)
}

/// All kinds but the kinetic one, of a system whose densities are up to date.
pub(super) fn energies<A: Arithmetic, const D: usize>(
    water: &Water<A, D>,
    system: &System<'_, A, D>,
) -> Result<[f64; MAX_ENERGIES], Fault> {
    let mut energies = [0.0; MAX_ENERGIES];
    energies[1] = compression(water, &system.particles.view())? + clump(water, system)?;
    energies[2] = gravitational(water, system);
    if water.has_dummies(system) {
        energies[3] += compression(water, &system.walls.view())?;
    }
    energies[3] += repulsion_of_walls(water, system)?;
    Ok(energies)
}

/// Σ m ε(ρ).
fn compression<A: Arithmetic, const D: usize>(
    water: &Water<A, D>,
    particles: &SetView<'_, A, D>,
) -> Result<f64, Fault> {
    let p = water.parameters();
    let mut sum = ExactSum::default();
    let mut first: Option<Fault> = None;
    for (rho, id) in particles.words(DENSITY).iter().zip(particles.id) {
        let x = water.relative_density(*rho);
        if x > 0.0 {
            sum = sum.plus(p.state_equation.internal_energy(x));
        } else {
            let fault = Fault::new(FaultKind::DensityNotPositive, *id);
            first = Some(first.map_or(fault, |other| other.first(fault)));
        }
    }
    let unit = p.mass * (p.sound_speed * p.sound_speed);
    first.map_or(Ok(unit * sum.value()), Err)
}

/// Energy of particles that are very near to each other.
fn clump<A: Arithmetic, const D: usize>(
    water: &Water<A, D>,
    system: &System<'_, A, D>,
) -> Result<f64, Fault> {
    let Some((energy, pass)) = water.anti_clump_energy_pass() else {
        return Ok(0.0);
    };
    let mut sum = sum_over_pairs(system, &pass, Side::Particles, 1, ExactSum::default())?;
    if water.has_dummies(system) {
        // Once for the particle and once for the dummy, which has no turn of its own.
        sum = sum_over_pairs(system, &pass, Side::Walls, 2, sum)?;
    }
    Ok(water.parameters().mass * energy * sum.value())
}

/// Energy of the conservative wall.
fn repulsion_of_walls<A: Arithmetic, const D: usize>(
    water: &Water<A, D>,
    system: &System<'_, A, D>,
) -> Result<f64, Fault> {
    let Some((energy, pass)) = water.wall_energy_pass() else {
        return Ok(0.0);
    };
    let sum = sum_over_pairs(system, &pass, Side::Walls, 1, ExactSum::default())?;
    Ok(water.parameters().mass * energy * sum.value())
}

fn square(x: f64) -> f64 {
    x * x
}

fn gravitational<A: Arithmetic, const D: usize>(
    water: &Water<A, D>,
    system: &System<'_, A, D>,
) -> f64 {
    let p = water.parameters();
    let quantum = p.scale.length_quantum();
    let position = system.particles.position();
    let mut energy = 0.0;
    for (d, g) in p.gravity.uniform.iter().enumerate() {
        let sum: i128 = position
            .iter()
            .map(|x| i128::from(x[d].whole_quanta()))
            .sum();
        energy -= p.mass * g * (sum as f64 * quantum);
    }
    if let Some(central) = &p.gravity.central {
        // In units of the potential at one scene unit, so that the terms are of order one.
        let unit = quantum * crate::number::power_of_two(46);
        let mut sum = ExactSum::default();
        for x in position {
            let mut r2 = 0.0;
            for (x, c) in x.iter().zip(water.centre()) {
                r2 += square(x.quanta() - c.quanta());
            }
            let r2 = r2 * square(quantum) + square(central.softening);
            sum = sum.plus(unit / crate::number::sqrt(r2));
        }
        energy -= p.mass * central.strength / unit * sum.value();
    }
    energy
}
