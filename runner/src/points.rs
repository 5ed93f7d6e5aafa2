//! What is drawn of a state: a third of a [`Frame`], for eyes that want many a second.
//!
//! Positions, speeds |v|, densities and pressures in SI units, each the frame's f64 rounded once to
//! f32; the particles in the order in which they are stored, each with its id. Files are made of
//! frames, pictures of points.

use crate::frame::Frame;

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
    /// Densities of the fluid in kg/m³.
    pub density: Vec<f32>,
    /// Pressures of the fluid in Pa.
    pub pressure: Vec<f32>,
    /// Positions of the walls in m; z = 0 in 2D.
    pub wall_position: Vec<[f32; 3]>,
}

impl Points {
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

    /// Room for so many particles of the fluid.
    pub(crate) fn resize(&mut self, dimension: usize, particles: usize) {
        self.dimension = dimension;
        self.id.resize(particles, 0);
        for (axis, list) in self.position.iter_mut().enumerate() {
            list.resize(if axis < dimension { particles } else { 0 }, 0.0);
        }
        for list in [&mut self.speed, &mut self.density, &mut self.pressure] {
            list.resize(particles, 0.0);
        }
    }

    /// The fluid's lists in parts of so many particles.
    pub(crate) fn parts(&mut self, size: usize) -> Vec<Part<'_>> {
        let mut axes = self.position.each_mut().map(|list| list.chunks_mut(size));
        let ids = self.id.chunks_mut(size);
        let values = self
            .speed
            .chunks_mut(size)
            .zip(self.density.chunks_mut(size))
            .zip(self.pressure.chunks_mut(size));
        ids.zip(values)
            .enumerate()
            .map(|(n, (id, ((speed, density), pressure)))| Part {
                first: n * size,
                id,
                position: axes.each_mut().map(|axis| axis.next().unwrap_or_default()),
                speed,
                density,
                pressure,
            })
            .collect()
    }
}

/// Some consecutive particles of the lists.
pub(crate) struct Part<'a> {
    /// Place of the first.
    pub first: usize,
    pub id: &'a mut [u64],
    pub position: [&'a mut [f32]; 3],
    pub speed: &'a mut [f32],
    pub density: &'a mut [f32],
    pub pressure: &'a mut [f32],
}

/// |v|, m/s.
#[inline]
pub(crate) fn speed(v: [f64; 3]) -> f32 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt() as f32
}

impl From<&Frame> for Points {
    fn from(frame: &Frame) -> Self {
        let single = |list: &[f64]| list.iter().map(|&x| x as f32).collect();
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
            density: single(&frame.density),
            pressure: single(&frame.pressure),
            wall_position: frame
                .wall_position
                .iter()
                .map(|x| x.map(|x| x as f32))
                .collect(),
        }
    }
}
