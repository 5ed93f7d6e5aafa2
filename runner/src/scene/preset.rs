//! Presets: overrides with a name.

/// At most 1e-4 of the energy released is lost or gained on the dam break, for twice the force
/// evaluations of the paper's parameters; `loschmidt reproduce work` measures both.
pub const ACCURATE: [&str; 2] = ["integrator=pefrl", "cfl=0.4"];

/// Support, penalty and about the time step of Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput.
/// 439 (2023) 127579, for scenes of solids.
pub const PAPER: [&str; 3] = ["support=3", "solid.penalty=10", "cfl=0.2"];
