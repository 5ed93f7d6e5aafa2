//! How a simulation ends before its end, in words: with the range of the numbers that it left.

use crate::figures::quantity;
use crate::player::Player;
use loschmidt_core::{Fault, FaultKind};
use std::fmt;

/// A fault, and the range of the positions where it happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangedFault {
    /// Reason, particle and step.
    pub fault: Fault,
    /// Positions are kept below this |coordinate|, m.
    pub range: f64,
}

impl RangedFault {
    /// The fault of this player.
    #[must_use]
    pub fn of(player: &Player, fault: Fault) -> Self {
        Self {
            fault,
            range: player.home().scale.largest_length(),
        }
    }
}

impl fmt::Display for RangedFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.fault)?;
        if self.fault.kind == FaultKind::PositionRange {
            write!(
                f,
                ", {} from the origin along an axis; the key `domain` sets it",
                quantity(self.range, "m", 4)
            )?;
        }
        Ok(())
    }
}
