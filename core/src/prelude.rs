//! What a model is written with: `use loschmidt_core::prelude::*`.

pub use crate::exact::ExactSum;
pub use crate::executor::Executor;
pub use crate::fault::{Fault, FaultKind};
pub use crate::fields::{
    Field, IMPULSE, IMPULSE_FIELD, POSITION, POSITION_FIELD, Quantum, Rank, Role, Side, TimeParity,
    VELOCITY, VELOCITY_FIELD,
};
pub use crate::integrator::Stage;
pub use crate::model::{
    Dissipative, MAX_ENERGIES, Measure, Model, Relax, Reversibility, Settings, SetupError,
};
pub use crate::number::{Arithmetic, Fixed, Float, Lanes, Quantity, Word};
pub use crate::observe::sum_over_pairs;
pub use crate::pairs::{PairPass, Parity};
pub use crate::points::PointPass;
pub use crate::schemes::wcsph::Parameters;
pub use crate::set::SetView;
pub use crate::shears::{Drift, Kick, NoImpulse};
pub use crate::system::{Sum, System};
pub use crate::values::{Symmetric, Values};
