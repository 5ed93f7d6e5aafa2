//! A frame: what a run looks like between two steps.
//!
//! A frame is to look at. It holds the physical values, in SI units, of a synchronised state
//! (positions and velocities at the same time), and nothing of the integers that the run itself is
//! made of; to resume a run takes a snapshot. Nothing in a frame is rounded further than the f64
//! it was handed in.
//!
//! Two clocks stand in it. [`Frame::time`] is physical: it rises from home to the turnaround and
//! falls on the way back. [`Frame::elapsed`] rises along both legs, and is what orders frames.

use loschmidt_core::model::Measure;
use std::io;

/// A synchronised state, the fluid in the order of its ids.
///
/// The fluid's lists have one entry per particle, all in that order. What is drawn of it are its
/// [`crate::Points`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Dimension of space, 2 or 3.
    pub dimension: usize,
    /// Physical step; 0 is home.
    pub step: u64,
    /// Physical time in s; falls on the way back.
    pub time: f64,
    /// Time in s along both legs; never falls.
    pub elapsed: f64,
    /// Whether time has been turned.
    pub way_back: bool,
    /// Mass of a fluid particle in kg (2D: of a metre of depth).
    pub particle_mass: f64,
    /// Ids of the fluid.
    pub id: Vec<u64>,
    /// Positions of the fluid in m; z = 0 in 2D.
    pub position: Vec<[f64; 3]>,
    /// Velocities of the fluid in m/s; z = 0 in 2D.
    pub velocity: Vec<[f64; 3]>,
    /// What else the model says of a particle: of water, its density and its pressure.
    pub columns: Vec<FrameColumn>,
    /// Positions of the walls in m; z = 0 in 2D.
    pub wall_position: Vec<[f64; 3]>,
}

/// A number for each particle of the fluid.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameColumn {
    /// What it measures, and in which unit.
    pub measure: Measure,
    /// Its values.
    pub values: Vec<f64>,
}

impl Frame {
    /// The values of the column of this name, if the model has it.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let mut columns = self.columns.iter();
        let column = columns.find(|column| column.measure.name == name)?;
        Some(&column.values)
    }

    /// Number of fluid and wall particles together.
    pub fn particles(&self) -> usize {
        self.id.len() + self.wall_position.len()
    }

    /// Ids for the walls: they follow the largest id of the fluid, in the order of
    /// [`Frame::wall_position`], so that no two particles of a frame share one, and a wall
    /// particle keeps its own from frame to frame as long as the fluid keeps its particles.
    pub fn wall_ids(&self) -> impl Iterator<Item = u64> + use<> {
        let first = self.id.last().map_or(0, |last| last.saturating_add(1));
        (first..).take(self.wall_position.len())
    }

    /// Whether a file can be made of this frame.
    ///
    /// # Errors
    /// Names the first thing wrong: the dimension, the length of a list, an id out of order or
    /// above `i64::MAX`, a particle of a two-dimensional frame outside the plane z = 0.
    pub fn check(&self) -> Result<(), FrameError> {
        if !(2..=3).contains(&self.dimension) {
            return Err(FrameError::Dimension(self.dimension));
        }
        let expected = self.id.len();
        let columns = self.columns.iter();
        let columns = columns.map(|column| (column.measure.name, column.values.len()));
        let vectors = [
            ("position", self.position.len()),
            ("velocity", self.velocity.len()),
        ];
        for (list, found) in vectors.into_iter().chain(columns) {
            if found != expected {
                return Err(FrameError::Length {
                    list,
                    found,
                    expected,
                });
            }
        }
        if let Some(before) = self.id.windows(2).position(|pair| pair[0] >= pair[1]) {
            return Err(FrameError::IdOrder { index: before + 1 });
        }
        let last = self.id.last().copied().unwrap_or(0);
        if last.saturating_add(self.wall_position.len() as u64) > i64::MAX as u64 {
            return Err(FrameError::IdRange { last });
        }
        if self.dimension == 2 {
            for (list, vectors) in [
                ("position", &self.position),
                ("velocity", &self.velocity),
                ("wall_position", &self.wall_position),
            ] {
                if let Some(index) = vectors.iter().position(|vector| vector[2] != 0.0) {
                    return Err(FrameError::OutOfPlane { list, index });
                }
            }
        }
        Ok(())
    }
}

/// Why no file can be made of a frame.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
pub enum FrameError {
    /// Neither 2 nor 3.
    #[error("a frame has 2 or 3 dimensions, not {0}")]
    Dimension(usize),
    /// A list that has more or fewer entries than there are particles.
    #[error("the frame's `{list}` has {found} entries for {expected} fluid particles")]
    Length {
        /// Name of the list.
        list: &'static str,
        /// Its number of entries.
        found: usize,
        /// Number of fluid particles.
        expected: usize,
    },
    /// An id that is not above the one before it.
    #[error("the frame's ids do not rise at index {index}")]
    IdOrder {
        /// Index of the later of the two.
        index: usize,
    },
    /// Ids that a signed 64-bit integer cannot hold, and with them most readers.
    #[error("the frame's ids end beyond the largest signed 64-bit integer (fluid: {last})")]
    IdRange {
        /// Largest id of the fluid.
        last: u64,
    },
    /// A two-dimensional frame with a z that is not zero.
    #[error("the frame is two-dimensional, but z of its `{list}` is not 0 at index {index}")]
    OutOfPlane {
        /// Name of the list.
        list: &'static str,
        /// Index in it.
        index: usize,
    },
}

impl From<FrameError> for io::Error {
    fn from(error: FrameError) -> Self {
        Self::new(io::ErrorKind::InvalidInput, error)
    }
}
