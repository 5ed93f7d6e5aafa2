//! Diagnostics: floats come back here, to be read only.
//!
//! Everything is a sum of integers ([`crate::exact`] where the terms are real), so it has the same
//! bits for every executor and storage order, and on the way back the same as on the way out.

mod entropy;
mod pair_sums;

pub use entropy::{BINS, SpeedHistogram, equilibrium_entropy};
pub use pair_sums::sum_over_pairs;

use crate::executor::Executor;
use crate::fault::Fault;
use crate::model::{MAX_ENERGIES, MAX_TOTALS, Measure, Model};
use crate::number::{Arithmetic, Quantity};
use crate::system::System;

/// Energies by kind, J (per m of depth in 2D).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energies {
    names: &'static [&'static str],
    values: [f64; MAX_ENERGIES],
}

impl Default for Energies {
    /// No kinds of energy at all.
    fn default() -> Self {
        Self::new(&[], [0.0; MAX_ENERGIES])
    }
}

impl Energies {
    /// These kinds with these values, in the same order.
    ///
    /// # Panics
    /// There are more kinds than values.
    #[must_use]
    pub fn new(names: &'static [&'static str], values: [f64; MAX_ENERGIES]) -> Self {
        assert!(names.len() <= MAX_ENERGIES);
        Self { names, values }
    }

    /// Kinds and values.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.names.iter().copied().zip(self.values)
    }

    /// The energy of this kind; 0 where the model has no such kind.
    #[must_use]
    pub fn get(&self, name: &str) -> f64 {
        let mut kinds = self.iter();
        kinds
            .find(|(kind, _)| *kind == name)
            .map_or(0.0, |(_, value)| value)
    }

    /// Their sum, the Hamiltonian.
    #[must_use]
    pub fn total(&self) -> f64 {
        let values = &self.values[..self.names.len()];
        values.iter().fold(0.0, |sum, value| sum + value)
    }
}

/// What a model says of the whole besides energies and momenta.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    measures: &'static [Measure],
    values: [f64; MAX_TOTALS],
}

impl Default for Totals {
    /// Nothing.
    fn default() -> Self {
        Self::new(&[], [0.0; MAX_TOTALS])
    }
}

impl Totals {
    /// These measures with these values, in the same order.
    ///
    /// # Panics
    /// There are more measures than values.
    #[must_use]
    pub fn new(measures: &'static [Measure], values: [f64; MAX_TOTALS]) -> Self {
        assert!(measures.len() <= MAX_TOTALS);
        Self { measures, values }
    }

    /// Measures and values.
    pub fn iter(&self) -> impl Iterator<Item = (Measure, f64)> {
        self.measures.iter().copied().zip(self.values)
    }

    /// The value of this name; none where the model has no such measure.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<f64> {
        let mut all = self.iter();
        all.find(|(measure, _)| measure.name == name)
            .map(|(_, value)| value)
    }
}

/// What one looks at of a synchronised state.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics {
    /// Energies.
    pub energies: Energies,
    /// Σ v, in speed quanta: the linear momentum divided by the mass of a particle, exactly.
    /// Unused components are zero.
    pub momentum_quanta: [i128; 3],
    /// Σ x × v, in length times speed quanta; in 2D only the last component.
    pub angular_momentum_quanta: [i128; 3],
    /// Largest position component along the first axis, m.
    pub front: f64,
    /// Speeds.
    pub histogram: SpeedHistogram,
    /// Linear momentum, kg m/s.
    pub momentum: [f64; 3],
    /// Angular momentum about the origin, kg m²/s.
    pub angular_momentum: [f64; 3],
    /// See [`Model::TOTALS`].
    pub totals: Totals,
    /// See [`Model::lone_particles`].
    pub lone_particles: u64,
}

impl Diagnostics {
    /// Refreshes the system and measures it; changes nothing else.
    ///
    /// # Errors
    /// As [`Diagnostics::of`], and [`Model::refresh`].
    pub fn measure<A, M, E, const D: usize>(
        model: &M,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<Self, Fault>
    where
        A: Arithmetic,
        M: Model<A, D>,
        E: Executor,
    {
        let step = system.clock.step;
        model
            .refresh(system, exec)
            .map_err(|fault| fault.at_step(step))?;
        Self::of(model, system)
    }

    /// Measures a system that was refreshed.
    ///
    /// # Errors
    /// A particle without an energy ([`crate::FaultKind::DensityNotPositive`]): a row that ends
    /// with a drift leaves densities that no kick has looked at. The fault carries the number of
    /// steps that led to this state.
    pub fn of<A, M, const D: usize>(model: &M, system: &System<'_, A, D>) -> Result<Self, Fault>
    where
        A: Arithmetic,
        M: Model<A, D>,
    {
        let (lq, sq) = (
            model.scale().length_quantum(),
            model.scale().speed_quantum(),
        );
        let (mass, speed_bin) = (model.settings().mass, model.settings().speed_bin);
        let moving = Moving {
            system,
            held: M::HELD,
        };
        let momentum_quanta = momentum(&moving);
        let angular_momentum_quanta = angular_momentum(&moving);
        let position = system.particles.position();
        let front = position
            .iter()
            .map(|x| x[0].whole_quanta())
            .max()
            .map_or(0.0, |x| x as f64 * lq);
        let mut energies = model
            .energies(system)
            .map_err(|fault| fault.at_step(system.clock.step))?;
        energies[0] = squares(&moving) * 0.5 * mass * (sq * sq);
        Ok(Self {
            energies: Energies::new(M::ENERGIES, energies),
            histogram: SpeedHistogram::measure(&moving, speed_bin, sq),
            momentum: momentum_quanta.map(|q| q as f64 * (sq * mass)),
            angular_momentum: angular_momentum_quanta.map(|q| q as f64 * (sq * lq * mass)),
            momentum_quanta,
            angular_momentum_quanta,
            front,
            totals: Totals::new(M::TOTALS, model.totals(system)),
            lone_particles: model.lone_particles(system),
        })
    }
}

/// The particles that are not held.
struct Moving<'a, 'b, A: Arithmetic, const D: usize> {
    system: &'a System<'b, A, D>,
    /// See [`Model::HELD`].
    held: Option<usize>,
}

impl<A: Arithmetic, const D: usize> Moving<'_, '_, A, D> {
    /// Their positions and velocities.
    fn iter(&self) -> impl Iterator<Item = (&[A::Length; D], &[A::Speed; D])> {
        let particles = &self.system.particles;
        let held = self.held.map(|field| particles.words(field));
        let all = particles.position().iter().zip(particles.velocity());
        all.enumerate().filter_map(move |(place, particle)| {
            let moves = held.is_none_or(|held| held[place] == A::Word::ZERO);
            moves.then_some(particle)
        })
    }
}

/// Σ v² in squared speed quanta, summed exactly.
fn squares<A: Arithmetic, const D: usize>(moving: &Moving<'_, '_, A, D>) -> f64 {
    let mut sum = 0i128;
    for v in moving.iter().flat_map(|(_, v)| v) {
        let v = i128::from(v.whole_quanta());
        sum += v * v;
    }
    sum as f64
}

fn momentum<A: Arithmetic, const D: usize>(moving: &Moving<'_, '_, A, D>) -> [i128; 3] {
    let mut sum = [0i128; 3];
    for (_, v) in moving.iter() {
        for (s, v) in sum.iter_mut().zip(v) {
            *s += i128::from(v.whole_quanta());
        }
    }
    sum
}

fn angular_momentum<A: Arithmetic, const D: usize>(moving: &Moving<'_, '_, A, D>) -> [i128; 3] {
    let mut sum = [0i128; 3];
    for (x, v) in moving.iter() {
        let component = |a: usize, b: usize| {
            let product = |c: usize, d: usize| {
                i128::from(x[c].whole_quanta()) * i128::from(v[d].whole_quanta())
            };
            product(a, b) - product(b, a)
        };
        sum[2] += component(0, 1);
        if D == 3 {
            sum[0] += component(1, 2);
            sum[1] += component(2, 0);
        }
    }
    sum
}
