//! Presets: overrides with a name.

/// At most 1e-4 of the energy released is lost or gained on the dam break; see
/// `loschmidt reproduce work` for what it costs.
pub const ACCURATE: [&str; 2] = ["integrator=stormer-verlet", "cfl=0.05"];
