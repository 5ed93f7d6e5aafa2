//! What is drawn of a state: a third of a [`Frame`], for eyes that want many a second.
//!
//! Positions, speeds |v| and the model's columns in SI units, each the frame's f64 rounded once to
//! f32; the particles in the order in which they are stored, each with its id. Files are made of
//! frames, pictures of points.

use crate::frame::{Frame, FrameColumn};
use loschmidt_core::model::Measure;

/// What is drawn of a synchronised state.
///
/// The fluid's lists have one entry per particle, all in the same order, whichever it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Dimension of space, 2 or 3.
    pub dimension: usize,
    /// Physical step; 0 is home.
    pub step: u64,
    /// Physical time in s; falls on the way back.
    pub time: f64,
    /// Whether time has been turned.
    pub way_back: bool,
    /// Ids of the fluid.
    pub id: Vec<u64>,
    /// Coordinates of the fluid in m, axis by axis; nothing in the third list in 2D.
    pub position: [Vec<f32>; 3],
    /// Speeds of the fluid in m/s.
    pub speed: Vec<f32>,
    /// What else the model says of a particle.
    pub columns: Vec<PointColumn>,
    /// Positions of the walls in m; z = 0 in 2D.
    pub wall_position: Vec<[f32; 3]>,
}

/// A number for each particle of the fluid.
#[derive(Clone, Debug, PartialEq)]
pub struct PointColumn {
    /// What it measures, and in which unit.
    pub measure: Measure,
    /// Its values.
    pub values: Vec<f32>,
}

impl Points {
    /// The values of the column of this name, if the model has it.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f32]> {
        let mut columns = self.columns.iter();
        let column = columns.find(|column| column.measure.name == name)?;
        Some(&column.values)
    }

    /// Number of particles of the fluid.
    #[must_use]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there is no fluid.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Where the particle at this place in the lists is, m; z = 0 in 2D.
    #[must_use]
    #[inline]
    pub fn at(&self, place: usize) -> [f64; 3] {
        let [x, y, z] = &self.position;
        let z = z.get(place).copied().unwrap_or(0.0);
        [x[place], y[place], z].map(f64::from)
    }

    /// Room for so many particles of the fluid, with these columns.
    pub(crate) fn resize(&mut self, dimension: usize, particles: usize, columns: &[Measure]) {
        self.dimension = dimension;
        self.id.resize(particles, 0);
        for (axis, list) in self.position.iter_mut().enumerate() {
            list.resize(if axis < dimension { particles } else { 0 }, 0.0);
        }
        self.speed.resize(particles, 0.0);
        let same = self.columns.iter().map(|column| column.measure);
        if !same.eq(columns.iter().copied()) {
            let new = |&measure: &Measure| PointColumn {
                measure,
                values: Vec::new(),
            };
            self.columns = columns.iter().map(new).collect();
        }
        for column in &mut self.columns {
            column.values.resize(particles, 0.0);
        }
    }

    /// The fluid's lists in parts of so many particles.
    pub(crate) fn parts(&mut self, size: usize) -> Vec<PointsPart<'_>> {
        let mut axes = self.position.each_mut().map(|list| list.chunks_mut(size));
        let columns = self.columns.iter_mut();
        let mut columns: Vec<_> = columns
            .map(|column| column.values.chunks_mut(size))
            .collect();
        let ids = self.id.chunks_mut(size);
        ids.zip(self.speed.chunks_mut(size))
            .enumerate()
            .map(|(n, (id, speed))| PointsPart {
                first: n * size,
                id,
                position: axes.each_mut().map(|axis| axis.next().unwrap_or_default()),
                speed,
                columns: columns
                    .iter_mut()
                    .map(|column| column.next().unwrap_or_default())
                    .collect(),
            })
            .collect()
    }
}

/// Some consecutive particles of the lists.
pub(crate) struct PointsPart<'a> {
    /// Place of the first.
    pub first: usize,
    pub id: &'a mut [u64],
    pub position: [&'a mut [f32]; 3],
    pub speed: &'a mut [f32],
    pub columns: Vec<&'a mut [f32]>,
}

/// |v|, m/s.
#[inline]
pub(crate) fn speed(v: [f64; 3]) -> f32 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt() as f32
}

impl From<&Frame> for Points {
    fn from(frame: &Frame) -> Self {
        let column = |column: &FrameColumn| PointColumn {
            measure: column.measure,
            values: column.values.iter().map(|&x| x as f32).collect(),
        };
        let axis = |k: usize| match k < frame.dimension {
            true => frame.position.iter().map(|x| x[k] as f32).collect(),
            false => Vec::new(),
        };
        Self {
            dimension: frame.dimension,
            step: frame.step,
            time: frame.time,
            way_back: frame.way_back,
            id: frame.id.clone(),
            position: std::array::from_fn(axis),
            speed: frame.velocity.iter().map(|&v| speed(v)).collect(),
            columns: frame.columns.iter().map(column).collect(),
            wall_position: frame
                .wall_position
                .iter()
                .map(|x| x.map(|x| x as f32))
                .collect(),
        }
    }
}
