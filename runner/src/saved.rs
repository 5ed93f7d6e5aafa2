//! A state taken out of a simulation: integers without a type parameter.
//!
//! What a snapshot file stores, what a player keeps of its home, and what two states are compared
//! by. Particles are in id order.

use crate::scene::InitialState;
use loschmidt_core::Scale;
use loschmidt_core::fields::{POSITION, VELOCITY};
use serde::{Deserialize, Serialize};

/// Which arithmetic the words belong to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ArithmeticKind {
    /// Words are fixed-point integers.
    #[default]
    Fixed,
    /// Words are the bits of doubles, in quanta.
    Float,
}

impl ArithmeticKind {
    /// The name used on the command line and in outputs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Float => "float",
        }
    }
}

/// One field of a saved state.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedField {
    /// As the model declares it.
    pub name: String,
    /// Whether it changes sign when time is turned.
    pub odd: bool,
    /// Component by component within each particle.
    pub words: Vec<i64>,
}

/// The state of a run at a whole step.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedState {
    /// 2 or 3.
    pub dimension: usize,
    /// Meaning of the words.
    pub arithmetic: ArithmeticKind,
    /// Units.
    pub scale: Scale,
    /// Steps taken over all legs.
    pub step: u64,
    /// Ids, increasing.
    pub id: Vec<u64>,
    /// The fields of the model's state: position, velocity, and what else there is.
    pub fields: Vec<SavedField>,
    /// Number of wall particles.
    pub walls: usize,
    /// Those fields that walls have: position, and what else there is.
    pub wall_fields: Vec<SavedField>,
}

impl SavedState {
    /// Where the particles are, as a scene would have placed them.
    #[must_use]
    pub fn initial_state(&self) -> InitialState {
        let particles = 0..self.id.len();
        let quantum = self.scale.length_quantum();
        let walls = self.wall_positions().chunks_exact(self.dimension.max(1));
        InitialState {
            fluid: particles.clone().map(|n| self.position(n)).collect(),
            fluid_velocity: particles.map(|n| self.velocity(n)).collect(),
            wall: walls.map(|words| self.in_si(words, quantum)).collect(),
            // What follows from them are fields of the state.
            walls: Vec::new(),
            parts: Vec::new(),
            given: Vec::new(),
            wall_given: Vec::new(),
            added: Vec::new(),
            wall_added: Vec::new(),
        }
    }

    /// Words of the walls' positions.
    #[must_use]
    pub fn wall_positions(&self) -> &[i64] {
        let position = self.wall_fields.first();
        position.map_or(&[], |field| &field.words)
    }

    /// The words of the positions, D for each particle.
    #[must_use]
    pub fn positions(&self) -> &[i64] {
        &self.fields[POSITION].words
    }

    /// The words of the velocities, D for each particle.
    #[must_use]
    pub fn velocities(&self) -> &[i64] {
        &self.fields[VELOCITY].words
    }

    /// The word of an arithmetic as a number of quanta.
    fn quanta(&self, word: i64) -> f64 {
        match self.arithmetic {
            ArithmeticKind::Fixed => word as f64,
            ArithmeticKind::Float => f64::from_bits(word as u64),
        }
    }

    /// Position of the particle with the n-th id, m; unused components are zero.
    #[must_use]
    pub fn position(&self, n: usize) -> [f64; 3] {
        self.vector(POSITION, n, self.scale.length_quantum())
    }

    /// Velocity of the particle with the n-th id, m/s.
    #[must_use]
    pub fn velocity(&self, n: usize) -> [f64; 3] {
        self.vector(VELOCITY, n, self.scale.speed_quantum())
    }

    fn vector(&self, field: usize, n: usize, quantum: f64) -> [f64; 3] {
        let d = self.dimension;
        self.in_si(&self.fields[field].words[n * d..(n + 1) * d], quantum)
    }

    fn in_si(&self, words: &[i64], quantum: f64) -> [f64; 3] {
        let mut out = [0.0; 3];
        for (o, w) in out.iter_mut().zip(words) {
            *o = self.quanta(*w) * quantum;
        }
        out
    }

    /// The largest distance between a particle here and there, m.
    #[must_use]
    pub fn largest_distance(&self, other: &Self) -> f64 {
        (0..self.id.len().min(other.id.len()))
            .map(|n| {
                let (a, b) = (self.position(n), other.position(n));
                (0..3).map(|d| (a[d] - b[d]).powi(2)).sum::<f64>()
            })
            .fold(0.0, f64::max)
            .sqrt()
    }

    /// The same state in the other arithmetic. From fixed to float is exact for positions and
    /// velocities in range; from float to fixed rounds to the nearest quantum.
    #[must_use]
    pub fn converted(&self, to: ArithmeticKind) -> Self {
        if to == self.arithmetic {
            return self.clone();
        }
        let convert = |&w: &i64| match to {
            ArithmeticKind::Float => (w as f64).to_bits() as i64,
            ArithmeticKind::Fixed => self.quanta(w).round_ties_even() as i64,
        };
        let convert = |fields: &[SavedField]| {
            let convert = |field: &SavedField| SavedField {
                words: field.words.iter().map(convert).collect(),
                ..field.clone()
            };
            fields.iter().map(convert).collect()
        };
        Self {
            arithmetic: to,
            fields: convert(&self.fields),
            wall_fields: convert(&self.wall_fields),
            id: self.id.clone(),
            ..*self
        }
    }
}
