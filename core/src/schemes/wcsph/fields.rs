//! What a particle of water consists of.

use crate::fields::{
    Field, IMPULSE_FIELD, POSITION_FIELD, Quantum, Rank, Role, TimeParity, VELOCITY_FIELD,
};

/// C_a of eq. (5), constant; in the standard scheme the density itself, advanced in time.
pub const CONSTANT: usize = 3;
/// ρ.
pub const DENSITY: usize = 4;
/// p/ρ² times the factors of the present kick.
pub const PRESSURE: usize = 5;
/// The part of a dummy's density that comes from other dummies and C_a, and never changes.
pub const FIXED_DENSITY: usize = 6;

/// The fields of water whose third one has this name.
pub(super) const fn fields(density_field: &'static str) -> [Field; 7] {
    use Quantum::{Density, Real};
    use Rank::Scalar;
    [
        POSITION_FIELD,
        // Walls stand still: the zeros are there to be read.
        VELOCITY_FIELD.on_walls(Role::Scratch),
        IMPULSE_FIELD,
        Field::state(density_field, Scalar, Density, TimeParity::Even).on_walls(Role::State),
        Field::scratch("scratch density", Scalar, Density).on_walls(Role::Scratch),
        Field::scratch("pressure", Scalar, Real).on_walls(Role::Scratch),
        Field::scratch("fixed density", Scalar, Density)
            .on_particles(Role::Absent)
            .on_walls(Role::Scratch),
    ]
}
