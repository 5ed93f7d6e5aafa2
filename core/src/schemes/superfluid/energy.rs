//! Energies of a superfluid, its totals, and what is recorded of a particle.
//!
//! - counterflow    Σ m (χ_s/χ_n) u²/2
//! - compression    Σ m u_1² (ln ϱ + 1/ϱ - 1)
//! - thermal        Σ m T0 x²/(2C), x = s - s0
//! - gravitational  -Σ m g·x, zero at the origin
//!
//! as eq. (15) has them, the compression that of walls too, but for T0 Σ m x: that is the entropy
//! of the whole times a constant, which friction alone changes; there it is counted as heat, from the
//! start on. What walls have taken, less what lids and the heater have given, is `drive`: with it
//! the sum of all is constant. Where the state is held twice, all of these are of the mean.

use super::fields::{
    COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, ENTROPY, ENTROPY_COPY, ONE, ONE_LEDGER, SUMS, TAKEN,
};
use super::parameters::{HeliumParameters, Operators};
use super::walls::felt_compression;
use crate::exact::ExactSum;
use crate::fault::{Fault, FaultKind};
use crate::matrix::is_damped;
use crate::model::{MAX_ENERGIES, MAX_TOTALS, Measure};
use crate::number::{Arithmetic, Quantity, root, sqrt};
use crate::set::SetView;
use crate::system::System;
use crate::values::{Symmetric, Values};

/// Kinds of energy.
pub(super) const NAMES: &[&str] = &[
    "kinetic",
    "counterflow",
    "compression",
    "thermal",
    "gravitational",
];

/// The same, the heat, T0 Σ m x, which friction makes, and what was exchanged with the
/// surroundings.
pub(super) const NAMES_WITH_HEAT: &[&str] = &[
    "kinetic",
    "counterflow",
    "compression",
    "thermal",
    "gravitational",
    "heat",
    "drive",
];

/// Place of the heat among them.
pub(super) const HEAT: usize = 5;

const fn measure(name: &'static str, unit: &'static str) -> Measure {
    Measure { name, unit }
}

/// What is recorded of a particle.
pub(super) const COLUMNS: &[Measure] = &[
    measure("density", "kg/m³"),
    measure("pressure", "Pa"),
    measure("entropy", "J/(kg K)"),
    measure("temperature", "K"),
    measure("normal speed", "m/s"),
    measure("superfluid speed", "m/s"),
    measure("counterflow speed", "m/s"),
    measure("separation", "m/s"),
];

/// What is recorded of the whole.
pub(super) const TOTALS: &[Measure] = &[
    measure("thermodynamic entropy", "J/K"),
    measure("separation of counterflow", "m/s"),
    measure("separation of entropy", "J/(kg K)"),
];

/// A particle as energies and columns see it, in SI units.
struct Particle<const D: usize> {
    /// ϱ - 1.
    compression: f64,
    /// s - s0.
    excess: f64,
    velocity: [f64; D],
    /// v - v_s.
    counterflow: [f64; D],
    /// |w - W|.
    separation: f64,
}

fn length<const D: usize>(x: &[f64; D]) -> f64 {
    sqrt(x.iter().fold(0.0, |sum, x| sum + x * x))
}

impl<const D: usize> Particle<D> {
    /// With `TWICE` of the mean of both copies.
    fn of<A: Arithmetic, const TWICE: bool>(
        p: &HeliumParameters<D>,
        set: &SetView<'_, A, D>,
        place: usize,
    ) -> Self {
        let speed = p.scale.speed_quantum();
        let compression = (set.words(DENSITY)[place].quanta() - ONE) / ONE;
        let mut excess = set.words(ENTROPY)[place].quanta();
        let first = set.vectors::<A::Word, D>(COUNTERFLOW)[place];
        let mut counterflow = first.map(Quantity::quanta);
        let mut apart = [0.0; D];
        if TWICE {
            excess = 0.5 * (excess + set.words(ENTROPY_COPY)[place].quanta());
            let second = set.vectors::<A::Word, D>(COUNTERFLOW_COPY)[place];
            for d in 0..D {
                apart[d] = first[d].difference(second[d]) * speed;
                counterflow[d] = 0.5 * (counterflow[d] + second[d].quanta());
            }
            let stretch = root::<D>(1.0 + compression);
            counterflow = counterflow.map(|w| stretch * w);
        }
        Self {
            compression,
            excess: p.helium.entropy * (excess / ONE),
            velocity: set.velocity()[place].map(|v| v.quanta() * speed),
            counterflow: counterflow.map(|u| u * speed),
            separation: length(&apart),
        }
    }

    fn counterflow_squared(&self) -> f64 {
        self.counterflow.iter().fold(0.0, |sum, u| sum + u * u)
    }

    /// The length of v + factor u.
    fn speed(&self, factor: f64) -> f64 {
        let mut sum = self.velocity;
        for (v, u) in sum.iter_mut().zip(&self.counterflow) {
            *v += factor * u;
        }
        length(&sum)
    }
}

/// All kinds but the kinetic one, of a system whose sums are up to date.
pub(super) fn energies<A: Arithmetic, const TWICE: bool, const D: usize>(
    p: &HeliumParameters<D>,
    system: &System<'_, A, D>,
) -> Result<[f64; MAX_ENERGIES], Fault> {
    let (set, helium) = (system.particles.view(), &p.helium);
    // Waves of second sound are as energetic as this times their amplitude's square.
    let unit = p.heat_speed() * p.heat_speed();
    let mut sums = [ExactSum::default(); 3];
    let mut faults: Option<Fault> = None;
    for place in 0..set.id.len() {
        let particle = Particle::of::<A, TWICE>(p, &set, place);
        if particle.compression <= -1.0 {
            let fault = Fault::new(FaultKind::DensityNotPositive, set.id[place]);
            faults = Some(faults.map_or(fault, |other| other.first(fault)));
            continue;
        }
        let terms = [
            helium.counterflow_energy(particle.excess, particle.counterflow_squared()),
            helium.compression_energy(particle.compression),
            helium.thermal_energy(particle.excess),
        ];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum = sum.plus(term / unit);
        }
    }
    let walls = system.walls.view();
    for place in 0..walls.id.len() {
        let compression = (walls.words(DENSITY)[place].quanta() - ONE) / ONE;
        let felt = felt_compression(compression, p.suction);
        sums[1] = sums[1].plus(helium.compression_energy(felt) / unit);
    }
    if let Some(fault) = faults {
        return Err(fault);
    }
    let mut energies = [0.0; MAX_ENERGIES];
    for (energy, sum) in energies[1..].iter_mut().zip(&sums) {
        *energy = p.mass() * unit * sum.value();
    }
    for (d, g) in p.gravity.iter().enumerate() {
        let positions = set.position().iter();
        let sum: i128 = positions.map(|x| i128::from(x[d].whole_quanta())).sum();
        energies[4] -= p.mass() * g * (sum as f64 * p.scale.length_quantum());
    }
    Ok(energies)
}

/// T0 Σ m x of both copies' mean, less what it was at the start, J.
pub(super) fn heat<A: Arithmetic, const D: usize>(
    p: &HeliumParameters<D>,
    system: &System<'_, A, D>,
) -> f64 {
    let set = system.particles.view();
    let words = set.words(ENTROPY).iter().chain(set.words(ENTROPY_COPY));
    let twice: i128 = words.map(|s| i128::from(s.whole_quanta())).sum();
    let first = (p.first_excess * ONE) * (2 * set.id.len()) as f64;
    let twice = twice - libm::rint(first) as i128;
    let unit = p.mass() * p.helium.temperature * p.helium.entropy / (2.0 * ONE);
    twice as f64 * unit
}

/// What walls have taken from the liquid, less what the heater has given, J.
pub(super) fn taken<A: Arithmetic, const D: usize>(
    p: &HeliumParameters<D>,
    system: &System<'_, A, D>,
) -> f64 {
    let unit = p.mass() * (p.heat_speed() * p.heat_speed()) / ONE_LEDGER;
    let words = system.walls.words(TAKEN).iter();
    let of_walls: i128 = words.map(|word| i128::from(word.whole_quanta())).sum();
    let power = p.heater.map_or(0.0, |heater| heater.power);
    of_walls as f64 * unit - power * p.time_step * system.clock.step as f64
}

/// Σ m s, and how far the copies are apart at most, in the order of [`TOTALS`].
pub(super) fn totals<A: Arithmetic, const TWICE: bool, const D: usize>(
    p: &HeliumParameters<D>,
    system: &System<'_, A, D>,
) -> [f64; MAX_TOTALS] {
    let set = system.particles.view();
    let sum = |field: usize| -> i128 {
        let words = set.words(field).iter();
        words.map(|s| i128::from(s.whole_quanta())).sum()
    };
    // Twice the mean of both copies, as an integer.
    let second = if TWICE { ENTROPY_COPY } else { ENTROPY };
    let all = 2 * set.id.len() as i128 * ONE as i128;
    let twice = all + sum(ENTROPY) + sum(second);
    let unit = p.mass() * p.helium.entropy / (2.0 * ONE);
    let mut totals = [twice as f64 * unit, 0.0, 0.0, 0.0];
    if TWICE {
        let entropies = set.words(ENTROPY).iter().zip(set.words(ENTROPY_COPY));
        for (place, (s, copy)) in entropies.enumerate() {
            let particle = Particle::of::<A, TWICE>(p, &set, place);
            totals[1] = totals[1].max(particle.separation);
            totals[2] = totals[2].max(s.difference(*copy).abs() * (p.helium.entropy / ONE));
        }
    }
    totals
}

/// Particles whose H is so near to singular that they feel less of the gradient of the temperature
/// than they should, or nothing (see `damped_inverse`); none where the operators are the paper's.
pub(super) fn lone_particles<A: Arithmetic, const D: usize>(
    p: &HeliumParameters<D>,
    system: &System<'_, A, D>,
) -> u64 {
    if p.operators == Operators::Paper || p.is_normal() {
        return 0;
    }
    let set = system.particles.view();
    let words = set.words(SUMS);
    let each = words.len() / set.id.len().max(1);
    let lone = |place: usize| {
        // The density comes before H.
        let sums = &words[place * each + 1..];
        is_damped(&Symmetric::<f64, D>::from_fn(|k| sums[k].quanta() / ONE))
    };
    (0..set.id.len()).filter(|place| lone(*place)).count() as u64
}

/// Number `column` of [`COLUMNS`].
pub(super) fn column<A: Arithmetic, const TWICE: bool, const D: usize>(
    p: &HeliumParameters<D>,
    column: usize,
    set: &SetView<'_, A, D>,
    place: usize,
) -> f64 {
    let (helium, particle) = (&p.helium, Particle::of::<A, TWICE>(p, set, place));
    let normal = helium.normal_fraction_at(particle.excess);
    let density = 1.0 + particle.compression;
    match column {
        0 => helium.reference_density * density,
        1 => helium.pressure(density),
        2 => helium.entropy + particle.excess,
        3 => {
            let squared = particle.counterflow_squared();
            helium.temperature + helium.warming(particle.excess, squared)
        }
        // v_n = v + (χ_s/χ_n) u, v_s = v - u, v_ns = u/χ_n
        4 => particle.speed((1.0 - normal) / normal),
        5 => particle.speed(-1.0),
        6 => length(&particle.counterflow) / normal,
        _ => particle.separation,
    }
}
