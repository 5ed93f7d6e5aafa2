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

/// Distortions and logarithms count 2^-48: they are kept below 8.
pub(super) const STRAIN: Quantum = Quantum::Pure(48);
/// Sums over positions count 2^-48: one term is kept below 8.
pub(super) const SUM: Quantum = Quantum::Pure(48);
/// Sums over dt times velocities count 2^-50: one term is kept below 2.
pub(super) const RATE: Quantum = Quantum::Pure(50);

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
