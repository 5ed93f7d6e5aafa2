//! Energies of solids, and what is recorded of a particle.
//!
//! - bulk           Σ m (c_0²/2) (ρ/ρ0 - 1)²                  (29)
//! - shear          Σ m ε_s(A), see [`Material`]              (31), (35)
//! - penalty        Σ m (c_p²/2) (λ/ρ0)²                      (39)
//! - gravitational  -Σ m g·x, zero at the origin
//!
//! Held particles count: they store energy like others.

use super::fields::{BODY, CLUMPING, DENSITY, DISTORTION, HELD, LOG_VOLUME, MOMENTS, ONE};
use super::material::{Material, ShearEnergy, whole_metric};
use super::parameters::Parameters;
use crate::exact::ExactSum;
use crate::matrix::{Matrix, determinant_of, is_damped, trace};
use crate::model::{MAX_ENERGIES, Measure};
use crate::number::{Arithmetic, Quantity, sqrt};
use crate::set::SetView;
use crate::system::System;
use crate::values::{Symmetric, Values};

/// Kinds of energy.
pub(super) const NAMES: &[&str] = &["kinetic", "bulk", "shear", "penalty", "gravitational"];

/// The same of fluids: heat and what walls have taken come last.
pub(super) const NAMES_OF_FLUIDS: &[&str] = &[
    "kinetic",
    "bulk",
    "shear",
    "penalty",
    "gravitational",
    "heat",
    "drive",
];

/// Place of the heat among them.
pub(super) const EXCHANGED: usize = 5;

const fn measure(name: &'static str, unit: &'static str) -> Measure {
    Measure { name, unit }
}

/// Columns before the entries of the distortion.
const BEFORE: usize = 4;

const COLUMNS: [Measure; 14] = [
    measure("density", "kg/m³"),
    measure("pressure", "Pa"),
    measure("von Mises stress", "Pa"),
    measure("strain energy", "J/kg"),
    measure("distortion xx", ""),
    measure("distortion xy", ""),
    measure("distortion xz", ""),
    measure("distortion yx", ""),
    measure("distortion yy", ""),
    measure("distortion yz", ""),
    measure("distortion zx", ""),
    measure("distortion zy", ""),
    measure("distortion zz", ""),
    measure("heat", "J/kg"),
];

const IN_THE_PLANE: [Measure; 9] = [
    COLUMNS[0],
    COLUMNS[1],
    COLUMNS[2],
    COLUMNS[3],
    COLUMNS[4],
    COLUMNS[5],
    COLUMNS[7],
    COLUMNS[8],
    COLUMNS[13],
];

/// What is recorded of a particle of a solid.
pub(super) const fn columns(dimension: usize) -> &'static [Measure] {
    let all = columns_of_fluids(dimension);
    all.split_at(all.len() - 1).0
}

/// What is recorded of a particle of a fluid.
pub(super) const fn columns_of_fluids(dimension: usize) -> &'static [Measure] {
    match dimension {
        2 => &IN_THE_PLANE,
        _ => &COLUMNS,
    }
}

/// A particle as its energies see it.
struct Particle<const D: usize> {
    material: Material,
    /// ρ/ρ0.
    density: f64,
    /// λ/ρ0.
    clumping: f64,
    /// The unimodular part.
    distortion: Matrix<D>,
    log_volume: f64,
}

impl<const D: usize> Particle<D> {
    fn of<A: Arithmetic>(p: &Parameters<D>, set: &SetView<'_, A, D>, place: usize) -> Self {
        let scalar = |field: usize| set.words(field)[place].quanta() / ONE;
        let rows = set.vectors::<A::Word, D>(DISTORTION);
        Self {
            material: p.material(set.words(BODY)[place].whole_quanta()),
            density: scalar(DENSITY),
            clumping: scalar(CLUMPING),
            distortion: core::array::from_fn(|i| rows[place * D + i].map(|x| x.quanta() / ONE)),
            log_volume: scalar(LOG_VOLUME),
        }
    }

    fn metric(&self) -> Matrix<D> {
        whole_metric(&self.distortion, self.log_volume)
    }

    fn shear_energy(&self) -> f64 {
        // The determinant of A is 1 but for rounding, or holds the whole volume (midpoint).
        let log = libm::log(determinant_of(&self.distortion));
        let log_determinant = D as f64 * self.log_volume + log;
        self.material.shear_energy(&self.metric(), log_determinant)
    }

    /// -tr σ/3, Pa. In the continuum H = -ρ 1, and the stress is σ = -ρ² ∂ε_0/∂ρ 1 - ρ S.
    fn pressure(&self, reference_density: f64) -> f64 {
        let density = self.density * reference_density;
        let bulk = self.material.bulk_stress(self.density) * self.density;
        let shear = self.material.shear_stress(&self.metric());
        density * bulk + density * (trace(&shear) + self.third_axis()) / 3.0
    }

    /// sqrt(3/2 |dev σ|²), Pa.
    fn von_mises(&self, reference_density: f64) -> f64 {
        let stress = self.material.shear_stress(&self.metric());
        let third = self.third_axis();
        let mean = (trace(&stress) + third) / 3.0;
        let beside = if D == 2 { third - mean } else { 0.0 };
        let mut squares = beside * beside;
        for (i, row) in stress.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                let dev = if i == j { x - mean } else { *x };
                squares += dev * dev;
            }
        }
        sqrt(1.5 * squares) * self.density * reference_density
    }

    /// S along the third axis of plane strain, m²/s²; 0 in space, where there is none besides.
    fn third_axis(&self) -> f64 {
        let squared = self.material.shear_speed * self.material.shear_speed;
        match self.material.energy {
            ShearEnergy::Dpr if D == 2 => squared * (1.0 - (trace(&self.metric()) + 1.0) / 3.0),
            _ => 0.0,
        }
    }
}

/// All kinds but the kinetic one, of a system whose moments are up to date.
pub(super) fn energies<A: Arithmetic, const D: usize>(
    p: &Parameters<D>,
    system: &System<'_, A, D>,
) -> [f64; MAX_ENERGIES] {
    let set = system.particles.view();
    // In units of a squared speed that is large enough for every term.
    let unit = p.materials.iter().fold(1e-300, |most: f64, m| {
        most.max(m.bulk_speed * m.bulk_speed)
            .max(m.shear_speed * m.shear_speed)
    });
    let mut sums = [ExactSum::default(); 3];
    for place in 0..set.id.len() {
        let particle = Particle::of(p, &set, place);
        let terms = [
            particle.material.bulk_energy(particle.density),
            particle.shear_energy(),
            particle.material.penalty_energy(particle.clumping),
        ];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum = sum.plus(term / unit);
        }
    }
    let mut energies = [0.0; MAX_ENERGIES];
    for (energy, sum) in energies[1..].iter_mut().zip(&sums) {
        *energy = p.mass() * unit * sum.value();
    }
    energies[4] = gravitational(p, &set);
    energies
}

/// Free particles whose H is so near to singular that they feel less shear than they should, or none
/// (see [`damped_inverse`](crate::matrix::damped_inverse)), of a system whose moments are up to date.
pub(super) fn lone_particles<A: Arithmetic, const D: usize>(system: &System<'_, A, D>) -> u64 {
    let set = system.particles.view();
    let (moments, held) = (set.words(MOMENTS), set.words(HELD));
    let each = moments.len() / set.id.len().max(1);
    let lone = |place: usize| {
        let words = &moments[place * each..];
        let moment = Symmetric::<f64, D>::from_fn(|k| words[k].quanta() / ONE);
        held[place].whole_quanta() == 0 && is_damped(&moment)
    };
    (0..set.id.len()).filter(|place| lone(*place)).count() as u64
}

fn gravitational<A: Arithmetic, const D: usize>(p: &Parameters<D>, set: &SetView<'_, A, D>) -> f64 {
    let mut energy = 0.0;
    for (d, g) in p.gravity.iter().enumerate() {
        let positions = set.position().iter();
        let sum: i128 = positions.map(|x| i128::from(x[d].whole_quanta())).sum();
        energy -= p.mass() * g * (sum as f64 * p.scale.length_quantum());
    }
    energy
}

/// Number `column` of [`columns`].
pub(super) fn column<A: Arithmetic, const D: usize>(
    p: &Parameters<D>,
    column: usize,
    set: &SetView<'_, A, D>,
    place: usize,
) -> f64 {
    let particle = Particle::of(p, set, place);
    let density = p.reference_density;
    match column {
        0 => particle.density * density,
        1 => particle.pressure(density),
        2 => particle.von_mises(density),
        3 => particle.material.bulk_energy(particle.density) + particle.shear_energy(),
        _ => {
            let entry = column - BEFORE;
            let whole = crate::number::exp(particle.log_volume);
            particle.distortion[entry / D][entry % D] * whole
        }
    }
}
