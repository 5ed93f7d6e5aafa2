//! What a run found: the one object that `--json` prints, computed from its rows and digests.

use super::row::Row;
use super::seen::Seen;
use crate::player::{Player, Return};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Digests of the three states, as hexadecimal text.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Digests {
    /// At home.
    pub initial: String,
    /// At the turnaround, before the velocities are reversed; `null` in a one-way run.
    pub turnaround: Option<String>,
    /// At the end; on the way back after reversing again, so that it can equal the first.
    #[serde(rename = "final")]
    pub last: String,
}

/// Energy balance. J, per m of depth in 2D.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EnergyBalance {
    /// Total at home.
    #[serde(rename = "initial_J")]
    pub initial: f64,
    /// Initial minus lowest gravitational energy.
    #[serde(rename = "released_J")]
    pub released: f64,
    /// Largest |total - initial total| over all rows of both legs.
    #[serde(rename = "max_error_J")]
    pub max_error: f64,
    /// The same over the energy released; `null` where nothing is released.
    pub max_error_over_released: Option<f64>,
}

/// Linear momentum, kg m/s (per m of depth in 2D).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Momentum {
    /// Constant to the last bit within each leg, the second leg's the negative of the first's.
    pub exactly_constant: bool,
    /// At home.
    pub initial: Vec<f64>,
    /// At the end, velocities along physical time.
    #[serde(rename = "final")]
    pub last: Vec<f64>,
}

/// Angular momentum about the origin, kg m²/s: a number in 2D, three in 3D.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Angular {
    /// The component normal to the plane.
    Plane(f64),
    /// All three.
    Space([f64; 3]),
}

/// Angular momentum at two moments.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AngularMomentum {
    /// At home.
    pub initial: Angular,
    /// At the turnaround (one-way runs: at the end).
    pub turnaround: Angular,
}

/// Reduced Boltzmann entropy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Entropy {
    /// At home.
    pub initial: f64,
    /// At the turnaround; `null` in a one-way run.
    pub turnaround: Option<f64>,
    /// At the end.
    #[serde(rename = "final")]
    pub last: f64,
    /// Equilibrium value (21) for the kinetic energy at the turnaround (one-way runs: at the end).
    pub equilibrium_turnaround: Option<f64>,
}

/// What a model says of the whole, over a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TotalOverTime {
    /// At home.
    pub initial: f64,
    /// At the turnaround; `null` in a one-way run.
    pub turnaround: Option<f64>,
    /// At the end.
    #[serde(rename = "final")]
    pub last: f64,
    /// The largest of all rows.
    pub largest: f64,
}

impl TotalOverTime {
    /// Every total by name, from all rows.
    fn all(rows: &[Row], two_way: bool) -> BTreeMap<String, Self> {
        let (Some(home), Some(last)) = (rows.first(), rows.last()) else {
            return BTreeMap::new();
        };
        let turn = rows.iter().rev().find(|row| row.leg == 1);
        let turn = turn.filter(|_| two_way);
        let over_time = |name: &str, initial: f64| {
            let values = rows.iter().filter_map(|row| row.total_of(name));
            Self {
                initial,
                turnaround: turn.and_then(|row| row.total_of(name)),
                last: last.total_of(name).unwrap_or(f64::NAN),
                largest: values.fold(initial, f64::max),
            }
        };
        let totals = home.totals.iter();
        totals
            .map(|(name, initial)| (name.to_string(), over_time(name, *initial)))
            .collect()
    }
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Name of the scene.
    pub scene: String,
    /// 2 or 3.
    pub dimension: usize,
    /// Fluid particles.
    pub particles: u64,
    /// Wall particles.
    pub wall_particles: u64,
    /// Steps of both legs.
    pub steps: u64,
    /// s.
    pub time_step_s: f64,
    /// Scheme.
    pub model: String,
    /// Row of the integrator table.
    pub integrator: String,
    /// `fixed` or `float`.
    pub arithmetic: String,
    /// Who walked the particles.
    pub executor: String,
    /// What the pair sums were made with: an instruction set; `serial` for the plain traversal,
    /// which sums in the other executors, in floating point, and where a fluid is too long or too
    /// crowded for the lists of the fast one; or both.
    pub backend: String,
    /// Threads at work.
    pub threads: usize,
    /// Fingerprints.
    pub digest: Digests,
    /// Whether time came back to the last bit; `null` where no way home was asked for.
    pub reversed_exactly: Option<bool>,
    /// Largest distance of a particle from its home after the return, m; `null` as before.
    pub max_return_error_m: Option<f64>,
    /// Energies.
    pub energy: EnergyBalance,
    /// Linear momentum.
    pub momentum: Momentum,
    /// Angular momentum.
    pub angular_momentum: AngularMomentum,
    /// Entropies.
    pub entropy: Entropy,
    /// What else the model says of the whole, by name and unit; of a superfluid its thermodynamic
    /// entropy, and how far its two copies are apart. Left out where there is nothing.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub totals: BTreeMap<String, TotalOverTime>,
    /// Particles of a body, a viscous fluid or a superfluid that have too few neighbours at the end to
    /// feel all of its shear, or of the gradient of the temperature: what has torn off. Zero for
    /// water.
    pub lone_particles: u64,
    /// Signs that the scene is not what it is meant to be.
    #[serde(flatten)]
    pub seen: Seen,
    /// Everything, output included, s. Of the last piece of a run that was resumed.
    pub wall_time_s: f64,
    /// Time of the step loop times threads over particles times steps, ns.
    pub ns_per_particle_step: f64,
}

impl EnergyBalance {
    /// From all rows; the first is home.
    #[must_use]
    pub fn of(rows: &[Row]) -> Option<Self> {
        let home = rows.first()?;
        let lowest = rows.iter().fold(home.energy("gravitational"), |l, r| {
            l.min(r.energy("gravitational"))
        });
        let released = home.energy("gravitational") - lowest;
        let max_error = rows
            .iter()
            .fold(0.0, |m: f64, r| m.max((r.total - home.total).abs()));
        Some(Self {
            initial: home.total,
            released,
            max_error,
            max_error_over_released: (released > 0.0).then(|| max_error / released),
        })
    }
}

impl Momentum {
    /// From all rows; `unit` is kg m/s per quantum of Σ v.
    #[must_use]
    pub fn of(rows: &[Row], dimension: usize, unit: f64) -> Option<Self> {
        let (home, last) = (rows.first()?, rows.last()?);
        let first = home.momentum_quanta();
        let exactly_constant = rows.iter().all(|row| {
            let sign = if row.leg == 1 { 1 } else { -1 };
            row.momentum_quanta() == first.map(|p| sign * p)
        });
        let si = |row: &Row| {
            let sign = if row.leg == 1 { 1.0 } else { -1.0 };
            let p = row.momentum_quanta().map(|p| sign * p as f64 * unit + 0.0);
            p[..dimension].to_vec()
        };
        Some(Self {
            exactly_constant,
            initial: si(home),
            last: si(last),
        })
    }
}

impl Angular {
    fn of(row: &Row, dimension: usize) -> Self {
        match dimension {
            2 => Self::Plane(row.angular_momentum_z),
            _ => Self::Space([
                row.angular_momentum_x,
                row.angular_momentum_y,
                row.angular_momentum_z,
            ]),
        }
    }
}

/// What the step loop cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Steps taken in this process.
    pub steps: u64,
    /// Time in the step loop, s.
    pub loop_s: f64,
    /// Time since the run was started or resumed, s.
    pub wall_s: f64,
}

/// What was found at the end of a run, besides its rows.
pub(super) struct Found {
    /// At the turnaround.
    pub turnaround_digest: Option<String>,
    /// How far from home, where a run was to come home.
    pub came_back: Option<Return>,
    /// At the end.
    pub last_digest: String,
    /// With too few neighbours.
    pub lone_particles: u64,
    /// Signs that the scene is not what it is meant to be.
    pub seen: Seen,
    /// What it cost.
    pub cost: Cost,
}

impl Outcome {
    /// Puts together what is known at the end of a run. `rows` must not be empty.
    pub(super) fn new(player: &Player, rows: &[Row], found: Found) -> Option<Self> {
        let Found {
            turnaround_digest,
            came_back,
            last_digest,
            lone_particles,
            seen,
            cost,
        } = found;
        let scene = player.scene();
        let options = player.options();
        let dimension = scene.dimension.axes();
        let home = rows.first()?;
        let last = rows.last()?;
        // In a one-way run the end takes the place of the turnaround where a value is asked for.
        let turn = rows.iter().rev().find(|row| row.leg == 1)?;
        let two_way = scene.turnaround.is_some();
        let (all, held) = (player.home().id.len() as u64, player.held_walls());
        let unit = player.momentum_unit();
        let threads = player.threads();
        let work = all as f64 * cost.steps as f64;
        Some(Self {
            scene: scene.name.clone(),
            dimension,
            particles: player.particles(),
            wall_particles: player.home().walls as u64 + held,
            steps: player.steps_taken(),
            time_step_s: scene.time_step(),
            model: scene.model.word().to_owned(),
            integrator: scene.integrator.word().to_owned(),
            arithmetic: options.arithmetic.name().to_owned(),
            executor: options.executor.name().to_owned(),
            backend: player.backend(),
            threads,
            digest: Digests {
                initial: player.home_digest().to_string(),
                turnaround: turnaround_digest,
                last: last_digest,
            },
            reversed_exactly: came_back.map(|r| r.is_exact()),
            max_return_error_m: came_back.map(|r| r.error),
            energy: EnergyBalance::of(rows)?,
            momentum: Momentum::of(rows, dimension, unit)?,
            angular_momentum: AngularMomentum {
                initial: Angular::of(home, dimension),
                turnaround: Angular::of(turn, dimension),
            },
            entropy: Entropy {
                initial: home.entropy,
                turnaround: two_way.then_some(turn.entropy),
                last: last.entropy,
                equilibrium_turnaround: turn.equilibrium_entropy_of_energy,
            },
            totals: TotalOverTime::all(rows, two_way),
            lone_particles,
            seen,
            wall_time_s: cost.wall_s,
            ns_per_particle_step: if work > 0.0 {
                cost.loop_s * 1e9 * threads as f64 / work
            } else {
                0.0
            },
        })
    }
}
