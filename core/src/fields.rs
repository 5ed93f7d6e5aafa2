//! Fields: what a particle consists of, declared once, and the memory that holds it.
//!
//! A model declares a list of [`Field`]s. Everything that must know of what a particle consists
//! reads that list: storage, checks of capacity, estimates of memory, digest, snapshot, reversal,
//! reordering. The first three fields of every model are the position, the velocity and, as
//! scratch, the impulse.
//!
//! Fields of the *state* are what a run is; *scratch* is computed from the state in every step and
//! never stored or compared.

use crate::number::{Scale, power_of_two};

/// Place of the position in every model's list.
pub const POSITION: usize = 0;
/// Place of the velocity in every model's list.
pub const VELOCITY: usize = 1;
/// Place of the impulses of the present kick in every model's list.
pub const IMPULSE: usize = 2;
/// Most fields that a model may declare.
pub const MAX_FIELDS: usize = 24;

/// What reversing time does to a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeParity {
    /// Kept (positions, densities).
    Even,
    /// Changes sign (velocities).
    Odd,
}

/// What one word of a field counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantum {
    /// [`Scale::length_quantum`].
    Length,
    /// [`Scale::speed_quantum`].
    Speed,
    /// [`Scale::density_quantum`].
    Density,
    /// 2^-n of a pure number (distortions, relative densities).
    Pure(i32),
    /// One: numbers that count or name something.
    Count,
    /// Nothing: the word holds a double. For scratch only.
    Real,
}

impl Quantum {
    /// SI units for each quantum.
    #[must_use]
    pub fn size(self, scale: &Scale) -> f64 {
        match self {
            Self::Length => scale.length_quantum(),
            Self::Speed => scale.speed_quantum(),
            Self::Density => scale.density_quantum(),
            Self::Pure(n) => power_of_two(-n),
            Self::Count | Self::Real => 1.0,
        }
    }
}

/// How many words a field has in D dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// One.
    Scalar,
    /// D.
    Vector,
    /// D(D + 1)/2.
    Symmetric,
    /// D².
    Matrix,
    /// So many in the plane and in space: sums of several kinds that a pass adds at once.
    Several {
        /// Words in two dimensions.
        plane: usize,
        /// Words in three dimensions.
        space: usize,
    },
}

/// What a field is to the particles of one set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A part of what a run is.
    State,
    /// Computed from the state.
    Scratch,
    /// These particles do not have it.
    Absent,
}

/// A named field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name in digests, snapshots and messages.
    pub name: &'static str,
    /// Words for each particle.
    pub rank: Rank,
    /// Unit of a word.
    pub quantum: Quantum,
    /// Behaviour under time reversal.
    pub parity: TimeParity,
    /// What it is to the particles that move.
    pub particles: Role,
    /// What it is to the walls.
    pub walls: Role,
}

impl Field {
    /// A field of the state of particles that move; walls do not have it.
    #[must_use]
    pub const fn state(
        name: &'static str,
        rank: Rank,
        quantum: Quantum,
        parity: TimeParity,
    ) -> Self {
        Self {
            name,
            rank,
            quantum,
            parity,
            particles: Role::State,
            walls: Role::Absent,
        }
    }

    /// Scratch of particles that move; walls do not have it.
    #[must_use]
    pub const fn scratch(name: &'static str, rank: Rank, quantum: Quantum) -> Self {
        Self {
            particles: Role::Scratch,
            ..Self::state(name, rank, quantum, TimeParity::Even)
        }
    }

    /// The same field, which changes sign with time.
    #[must_use]
    pub const fn odd(self) -> Self {
        Self {
            parity: TimeParity::Odd,
            ..self
        }
    }

    /// The same field, with this role on walls too.
    #[must_use]
    pub const fn on_walls(self, walls: Role) -> Self {
        Self { walls, ..self }
    }

    /// The same field, with this role on particles that move.
    #[must_use]
    pub const fn on_particles(self, particles: Role) -> Self {
        Self { particles, ..self }
    }

    /// What the field is to the particles of a set.
    #[must_use]
    pub const fn role(&self, side: Side) -> Role {
        match side {
            Side::Particles => self.particles,
            Side::Walls => self.walls,
        }
    }

    /// Words for each particle of a set.
    #[must_use]
    pub const fn words(&self, side: Side, dimension: usize) -> usize {
        match (self.role(side), self.rank) {
            (Role::Absent, _) => 0,
            (_, Rank::Scalar) => 1,
            (_, Rank::Vector) => dimension,
            (_, Rank::Symmetric) => dimension * (dimension + 1) / 2,
            (_, Rank::Matrix) => dimension * dimension,
            (_, Rank::Several { plane, space }) => match dimension {
                2 => plane,
                _ => space,
            },
        }
    }
}

/// x, as every model declares it.
pub const POSITION_FIELD: Field =
    Field::state("position", Rank::Vector, Quantum::Length, TimeParity::Even).on_walls(Role::State);

/// v of the particles that move.
pub const VELOCITY_FIELD: Field =
    Field::state("velocity", Rank::Vector, Quantum::Speed, TimeParity::Odd);

/// J, the impulse per mass of the present kick.
pub const IMPULSE_FIELD: Field = Field::scratch("impulse", Rank::Vector, Quantum::Speed);

/// Which particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Those that move.
    Particles,
    /// Those that stand still.
    Walls,
}

/// Words for each particle of a set with these fields.
#[must_use]
pub const fn words_each(fields: &[Field], side: Side, dimension: usize) -> usize {
    let (mut sum, mut f) = (0, 0);
    while f < fields.len() {
        sum += fields[f].words(side, dimension);
        f += 1;
    }
    sum
}

/// Fields of the state of a set, with their places in the list.
pub fn state_fields(
    fields: &'static [Field],
    side: Side,
) -> impl Iterator<Item = (usize, &'static Field)> + Clone {
    let all = fields.iter().enumerate();
    all.filter(move |(_, field)| field.role(side) == Role::State)
}
