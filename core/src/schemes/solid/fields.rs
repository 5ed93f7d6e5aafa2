//! What a particle of a solid consists of.

use crate::fields::{
    Field, IMPULSE_FIELD, POSITION_FIELD, Quantum, Rank, Role, TimeParity, VELOCITY_FIELD,
};

/// A, unimodular in the reversible scheme; row by row.
pub const DISTORTION: usize = 3;
/// θ = ln(det of the whole distortion)/D.
pub const LOG_VOLUME: usize = 4;
/// C_ρ, which makes the first relative density 1.
pub const DENSITY_CONSTANT: usize = 5;
/// C_λ, which makes the first λ 0.
pub const CLUMPING_CONSTANT: usize = 6;
/// Number of the body that the particle belongs to.
pub const BODY: usize = 7;
/// 1 for a particle that is held in its place, 0 for others.
pub const HELD: usize = 8;
/// Sums over positions and velocities, as [`Moments`](super::passes::Moments) has them.
pub const MOMENTS: usize = 9;
/// dt K, which the moments turn into dt L.
pub const GRADIENT: usize = 10;
/// H⁻¹.
pub const INVERSE: usize = 11;
/// ρ/ρ0.
pub const DENSITY: usize = 12;
/// λ/ρ0.
pub const CLUMPING: usize = 13;
/// Stresses times the factors of the present kick, as [`Stressed`](super::passes::Stressed) has
/// them.
pub const STRESS: usize = 14;

/// Where the surface of the wall is that a wall particle belongs to: the way there, and 0 for
/// particles that flow. Fluids alone.
pub const WALL_OFFSET: usize = 15;
/// Heat that a particle has received, and work that it has taken out of the flow, per mass, in units
/// of the square of [`Parameters::sound_speed`](super::Parameters::sound_speed). Fluids alone.
pub const EXCHANGED: usize = 16;
/// Impulses of the present kick in two parts, as [`SplitForce`](super::passes::SplitForce) has them.
/// Fluids alone.
pub const FORCES: usize = 17;
/// Sums over the flow next to a wall, as [`Beside`](super::Beside) has them. Fluids alone.
pub const BESIDE: usize = 18;

/// Distortions and logarithms count 2^-48: they are kept below 8.
pub(super) const STRAIN: Quantum = Quantum::Pure(48);
/// Sums over positions count 2^-48: one term is kept below 8.
pub(super) const SUM: Quantum = Quantum::Pure(48);
/// Sums over dt times velocities count 2^-50: one term is kept below 2.
pub(super) const RATE: Quantum = Quantum::Pure(50);

/// Energies per mass count 2^-44 of their unit: a term is kept below 128 of them.
pub(super) const ENERGY: Quantum = Quantum::Pure(44);
/// 1 in quanta of [`ENERGY`].
pub(super) const ONE_ENERGY: f64 = (1u64 << 44) as f64;

/// 1 in quanta of [`STRAIN`] and [`SUM`].
pub(super) const ONE: f64 = (1u64 << 48) as f64;
/// 1 in quanta of [`RATE`].
pub(super) const ONE_RATE: f64 = (1u64 << 50) as f64;

const fn even(name: &'static str, rank: Rank, quantum: Quantum) -> Field {
    Field::state(name, rank, quantum, TimeParity::Even)
}

/// The fields of a solid; nothing stands still outside of it.
pub(super) const FIELDS: [Field; 15] = {
    use Quantum::{Count, Real};
    use Rank::{Matrix, Scalar, Several, Symmetric};
    [
        POSITION_FIELD.on_walls(Role::State),
        VELOCITY_FIELD,
        IMPULSE_FIELD,
        even("distortion", Matrix, STRAIN),
        even("log_volume", Scalar, STRAIN),
        even("density_constant", Scalar, SUM),
        even("clumping_constant", Scalar, SUM),
        even("body", Scalar, Count),
        even("held", Scalar, Count),
        Field::scratch(
            "moments",
            Several {
                plane: 9,
                space: 17,
            },
            SUM,
        ),
        Field::scratch("gradient", Matrix, RATE),
        Field::scratch("inverse moment", Symmetric, Real),
        Field::scratch("relative density", Scalar, SUM),
        Field::scratch("clumping", Scalar, SUM),
        Field::scratch(
            "stress",
            Several {
                plane: 6,
                space: 11,
            },
            Real,
        ),
    ]
};

/// The fields of a fluid: those of a solid, and what walls and heat need.
pub(super) const FIELDS_OF_FLUIDS: [Field; 19] = {
    use Quantum::{Length, Speed};
    use Rank::{Several, Vector};
    let mut all = [even("wall offset", Vector, Length); 19];
    let mut f = 0;
    while f < FIELDS.len() {
        all[f] = FIELDS[f];
        f += 1;
    }
    all[EXCHANGED] = even("exchanged energy", Several { plane: 2, space: 2 }, ENERGY);
    all[FORCES] = Field::scratch("forces", Several { plane: 4, space: 6 }, Speed);
    all[BESIDE] = Field::scratch("flow beside", Several { plane: 4, space: 5 }, SUM);
    all
};
