//! What a particle of a superfluid consists of.

use crate::fields::{
    Field, IMPULSE_FIELD, POSITION_FIELD, Quantum, Rank, Role, TimeParity, VELOCITY_FIELD,
};

/// w = u ϱ^(-1/D), the reduced counterflow. With the paper's integrator u itself.
pub const COUNTERFLOW: usize = 3;
/// σ = (s - s0)/s0.
pub const ENTROPY: usize = 4;
/// C_a, which makes the first relative density 1.
pub const DENSITY_CONSTANT: usize = 5;
/// Sums over positions and velocities, as [`Sums`](super::passes::Sums) has them.
pub const SUMS: usize = 6;
/// dt K, which ϱ turns into dt times the velocity gradient.
pub const GRADIENT: usize = 7;
/// H⁻¹, or the unit matrix where the operators are the paper's.
pub const INVERSE: usize = 8;
/// ϱ = ρ/ρ0.
pub const DENSITY: usize = 9;
/// What fluxes need of a particle, as [`Carrier`](super::passes::Carrier) has it.
pub const CARRIER: usize = 10;
/// Sums of fluxes, as [`Fluxes`](super::passes::Fluxes) has them.
pub const FLUXES: usize = 11;
/// What the present kick adds to the counterflow.
pub const PULL: usize = 12;
/// What the present kick adds to the entropy.
pub const INFLOW: usize = 13;
/// W, the second copy of w. The reversible model alone.
pub const COUNTERFLOW_COPY: usize = 14;
/// S, the second copy of s. The reversible model alone.
pub const ENTROPY_COPY: usize = 15;
/// What friction needs of a particle, as [`Normal`](super::friction::Normal) has it. With friction.
pub const NORMAL: usize = 16;
/// Impulse of friction and conducted heat, as [`Rubbed`](super::friction::Rubbed) has them. With
/// friction.
pub const RUBBED: usize = 17;
/// What the heat of friction needs, as [`Rubbing`](super::friction::Rubbing) has it. With friction.
pub const RUBBING: usize = 18;
/// Heat that a particle receives, per mass. With friction.
pub const HEAT: usize = 19;
/// The share of a particle in what the heater gives. With friction.
pub const HEATING: usize = 20;
/// What a wall has taken from the liquid since the start, per mass of a particle: heat, less the
/// work of a lid. Walls alone, with friction.
pub const TAKEN: usize = 21;
/// dv and du of half a step, kept from the end of the last one. The paper's integrator alone.
pub const RATES: usize = 14;

/// Entropies and sums over positions count 2^-48: they, or one term, are kept below 8.
pub(super) const PURE: Quantum = Quantum::Pure(48);
/// Sums over dt times velocities count 2^-50: one term is kept below 2.
pub(super) const RATE: Quantum = Quantum::Pure(50);
/// Heats per mass count 2^-50 of the square of [`HeliumParameters::heat_speed`].
///
/// [`HeliumParameters::heat_speed`]: super::HeliumParameters::heat_speed
pub(super) const WARMTH: Quantum = Quantum::Pure(50);
/// What walls take adds up over a run: it counts 2^-36 of the same, and stays below 2^15.
pub(super) const LEDGER: Quantum = Quantum::Pure(36);
/// 1 in quanta of [`LEDGER`].
pub(super) const ONE_LEDGER: f64 = (1u64 << 36) as f64;
/// 1 in quanta of [`WARMTH`].
pub(super) const ONE_WARMTH: f64 = (1u64 << 50) as f64;
/// 1 in quanta of [`PURE`].
pub(super) const ONE: f64 = (1u64 << 48) as f64;
/// 1 in quanta of [`RATE`].
pub(super) const ONE_RATE: f64 = (1u64 << 50) as f64;

use Quantum::{Real, Speed};
use Rank::{Matrix, Scalar, Several, Symmetric, Vector};
use TimeParity::{Even, Odd};

/// The fields that walls have as well.
const fn with_walls<const N: usize>(mut fields: [Field; N]) -> [Field; N] {
    // Walls stand still: the zeros are there to be read.
    fields[crate::fields::VELOCITY].walls = Role::Scratch;
    fields[DENSITY_CONSTANT].walls = Role::State;
    fields[DENSITY].walls = Role::Scratch;
    fields[CARRIER].walls = Role::Scratch;
    fields
}

/// What both schemes have.
const SHARED: [Field; 14] = [
    POSITION_FIELD,
    VELOCITY_FIELD,
    IMPULSE_FIELD,
    Field::state("counterflow", Vector, Speed, Odd),
    Field::state("entropy", Scalar, PURE, Even),
    Field::state("density_constant", Scalar, PURE, Even),
    Field::scratch(
        "sums",
        Several {
            plane: 8,
            space: 16,
        },
        PURE,
    ),
    Field::scratch("gradient", Matrix, RATE),
    Field::scratch("inverse moment", Symmetric, Real),
    Field::scratch("relative density", Scalar, PURE),
    Field::scratch(
        "carrier",
        Several {
            plane: 9,
            space: 12,
        },
        Real,
    ),
    Field::scratch(
        "fluxes",
        Several {
            plane: 11,
            space: 19,
        },
        Speed,
    ),
    Field::scratch("pull", Vector, Speed),
    Field::scratch("inflow", Scalar, PURE).odd(),
];

/// The fields of the reversible model.
pub(super) const FIELDS: [Field; 16] = {
    let mut all = [Field::state("counterflow copy", Vector, Speed, Odd); 16];
    let mut f = 0;
    while f < SHARED.len() {
        all[f] = SHARED[f];
        f += 1;
    }
    all[ENTROPY_COPY] = Field::state("entropy copy", Scalar, PURE, Even);
    with_walls(all)
};

/// The fields of the reversible model, and what friction needs.
pub(super) const FIELDS_OF_FRICTION: [Field; 22] = {
    let mut all = [Field::scratch("heating", Scalar, PURE); 22];
    let mut f = 0;
    while f < FIELDS.len() {
        all[f] = FIELDS[f];
        f += 1;
    }
    all[NORMAL] = Field::scratch("normal flow", Several { plane: 5, space: 6 }, Real);
    all[RUBBED] = Field::scratch("rubbed", Several { plane: 3, space: 4 }, Speed);
    all[RUBBING] = Field::scratch("rubbing", Several { plane: 5, space: 7 }, Real);
    f = NORMAL;
    while f <= RUBBING {
        all[f].walls = Role::Scratch;
        f += 1;
    }
    all[HEAT] = Field::scratch("heat", Scalar, WARMTH);
    all[TAKEN] = Field::scratch("taken", Scalar, LEDGER)
        .on_particles(Role::Absent)
        .on_walls(Role::State);
    all
};

/// The fields of the paper's integrator.
pub(super) const FIELDS_OF_PAPER: [Field; 15] = {
    let several = Several { plane: 4, space: 6 };
    let mut all = [Field::state("rates", several, Speed, Even); 15];
    let mut f = 0;
    while f < SHARED.len() {
        all[f] = SHARED[f];
        f += 1;
    }
    with_walls(all)
};
