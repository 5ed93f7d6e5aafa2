//! Diagnostics: floats come back here, to be read only.
//!
//! Everything is a sum of integers ([`crate::exact`] where the terms are real), so it has the same
//! bits for every executor and storage order, and on the way back the same as on the way out.

mod energy;
mod entropy;

pub use energy::Energies;
pub use entropy::{BINS, SpeedHistogram, equilibrium_entropy};

use crate::executor::Executor;
use crate::fault::Fault;
use crate::model::Model;
use crate::number::{Arithmetic, Quantity};
use crate::state::System;

/// What one looks at of a synchronised state.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostics {
    /// Energies, J (per m of depth in 2D).
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
}

impl Diagnostics {
    /// Measures the system; brings its densities up to date, and changes nothing else.
    ///
    /// # Errors
    /// As [`Model::update_density`], and [`crate::FaultKind::DensityNotPositive`], which has no
    /// internal energy: a row that ends with a drift leaves densities that no kick has looked at.
    /// The fault carries the number of steps that led to this state.
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
        let step = system.progress.step;
        model
            .update_density(system, exec)
            .map_err(|fault| fault.at_step(step))?;
        let forces = model.forces();
        let p = forces.parameters();
        let (lq, sq) = (p.scale.length_quantum(), p.scale.speed_quantum());
        let momentum_quanta = momentum(system);
        let angular_momentum_quanta = angular_momentum(system);
        let front = system
            .state
            .position
            .iter()
            .map(|x| x[0].whole_quanta())
            .max()
            .map_or(0.0, |x| x as f64 * lq);
        Ok(Self {
            energies: Energies::measure(forces, system).map_err(|fault| fault.at_step(step))?,
            histogram: SpeedHistogram::measure(system, p.sound_speed, sq),
            momentum: momentum_quanta.map(|q| q as f64 * (sq * p.mass)),
            angular_momentum: angular_momentum_quanta.map(|q| q as f64 * (sq * lq * p.mass)),
            momentum_quanta,
            angular_momentum_quanta,
            front,
        })
    }
}

fn momentum<A: Arithmetic, const D: usize>(system: &System<'_, A, D>) -> [i128; 3] {
    let mut sum = [0i128; 3];
    for v in &*system.state.velocity {
        for (s, v) in sum.iter_mut().zip(v) {
            *s += i128::from(v.whole_quanta());
        }
    }
    sum
}

fn angular_momentum<A: Arithmetic, const D: usize>(system: &System<'_, A, D>) -> [i128; 3] {
    let mut sum = [0i128; 3];
    let state = &system.state;
    for (x, v) in state.position.iter().zip(&*state.velocity) {
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
