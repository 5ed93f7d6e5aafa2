//! A run: out, turn, back, with everything that is recorded on the way.
//!
//! [`Run::start`] or [`Run::resume`] set it up, [`Run::execute`] takes it to its end or to the next
//! interruption. What is written where is told in [`crate::output`], when in [`Plan`].

mod course;
mod error;
mod estimate;
mod left;
mod outcome;
mod plan;
mod row;
mod seen;

pub use course::{Progress, Run};
pub use error::RunError;
pub(crate) use left::{Left, scene_hash};
pub use outcome::{
    Angular, AngularMomentum, Cost, Digests, EnergyBalance, Entropy, Momentum, Outcome,
    TotalOverTime,
};
pub use plan::{Due, Plan};
pub use row::Row;
pub use seen::Seen;
