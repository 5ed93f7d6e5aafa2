//! A frame: an immutable picture of a state.

/// Immutable picture of a synchronised state, fluid in id order.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// 2 or 3; in 2D the last component of every vector is zero.
    pub dimension: usize,
    /// Steps from home along physical time: falls on the way back.
    pub step: u64,
    /// Physical time, s: falls on the way back.
    pub time: f64,
    /// Simulated time along both legs, s.
    pub elapsed: f64,
    /// True after the turnaround.
    pub way_back: bool,
    /// Mass of every particle, kg (per m of depth in 2D).
    pub particle_mass: f64,
    /// Ids of the fluid.
    pub id: Vec<u64>,
    /// Positions of the fluid, m.
    pub position: Vec<[f64; 3]>,
    /// Velocities of the fluid, m/s, as the run has them: reversed on the way back.
    pub velocity: Vec<[f64; 3]>,
    /// Densities, kg/m³.
    pub density: Vec<f64>,
    /// Pressures, Pa.
    pub pressure: Vec<f64>,
    /// Positions of the walls, m.
    pub wall_position: Vec<[f64; 3]>,
}
