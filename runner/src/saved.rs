//! A state taken out of a simulation: integers without a type parameter.
//!
//! What a snapshot file stores, what a player keeps of its home, and what two states are compared
//! by. Particles are in id order.

use crate::scene::InitialState;
use loschmidt_core::Scale;
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
    /// Position, velocity and density field: name and words, component by component within each
    /// particle.
    pub fields: Vec<(String, Vec<i64>)>,
    /// Positions of the walls.
    pub wall_position: Vec<i64>,
    /// Density field of the walls.
    pub wall_density: Vec<i64>,
}

impl SavedState {
    /// Where the particles are, as a scene would have placed them.
    #[must_use]
    pub fn initial_state(&self) -> InitialState {
        let particles = 0..self.id.len();
        let quantum = self.scale.length_quantum();
        let walls = self.wall_position.chunks_exact(self.dimension.max(1));
        InitialState {
            fluid: particles.clone().map(|n| self.position(n)).collect(),
            fluid_velocity: particles.map(|n| self.velocity(n)).collect(),
            wall: walls.map(|words| self.in_si(words, quantum)).collect(),
        }
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
        self.vector(0, n, self.scale.length_quantum())
    }

    /// Velocity of the particle with the n-th id, m/s.
    #[must_use]
    pub fn velocity(&self, n: usize) -> [f64; 3] {
        self.vector(1, n, self.scale.speed_quantum())
    }

    fn vector(&self, field: usize, n: usize, quantum: f64) -> [f64; 3] {
        let d = self.dimension;
        self.in_si(&self.fields[field].1[n * d..(n + 1) * d], quantum)
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
        let convert = |words: &[i64]| {
            words
                .iter()
                .map(|&w| match to {
                    ArithmeticKind::Float => (w as f64).to_bits() as i64,
                    ArithmeticKind::Fixed => self.quanta(w).round_ties_even() as i64,
                })
                .collect()
        };
        Self {
            arithmetic: to,
            fields: self
                .fields
                .iter()
                .map(|(name, words)| (name.clone(), convert(words)))
                .collect(),
            wall_position: convert(&self.wall_position),
            wall_density: convert(&self.wall_density),
            ..self.clone()
        }
    }
}
