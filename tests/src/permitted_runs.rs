//! What whole runs are permitted, with reasons. Whatever is promised exactly has no line here.

/// Angular momentum of the rotating drop over 3000 steps, relative: half a quantum in each of some
/// 30 pair terms, positions and velocities, per particle and step, adds up to 1e-12.
pub const ANGULAR_MOMENTUM_OF_A_RUN: f64 = 1e-8;

/// Least factor by which the energy error of the dam break falls with a fourth of the time step: 16
/// for a scheme of second order, less what two chaotic flows differ in.
pub const ENERGY_FALL_WITH_VERLET: f64 = 9.0;

/// The same for half the time step with dummy walls: 4, less the same.
pub const ENERGY_FALL_WITH_DUMMIES: f64 = 3.0;
