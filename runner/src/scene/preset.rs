//! Presets: overrides with a name.

/// At most 1e-4 of the energy released is lost or gained on the dam break, for twice the force
/// evaluations of the paper's parameters; `loschmidt reproduce work` measures both.
pub const ACCURATE: [&str; 2] = ["integrator=pefrl", "cfl=0.4"];
