//! What was kept last, and whether anything has happened since.

use loschmidt_runner::Arrow;
use loschmidt_runner::deck::{Recorded, Status};
use std::path::PathBuf;

/// What was kept last: nothing has happened since if it is still so.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// The directory.
    pub path: PathBuf,
    /// Steps from home.
    pub position: i64,
    /// Direction of motion.
    pub arrow: Arrow,
    /// How often the state had been changed by hand.
    pub meddling: usize,
}

impl Kept {
    /// The state of this status in this directory.
    #[must_use]
    pub fn new(path: PathBuf, status: &Status) -> Self {
        Self {
            path,
            position: status.position,
            arrow: status.arrow,
            meddling: status.meddling.len(),
        }
    }

    /// The directory of an earlier run that was opened.
    #[must_use]
    pub fn recorded(path: PathBuf, recorded: &Recorded) -> Self {
        Self {
            path,
            position: recorded.position,
            arrow: recorded.arrow,
            meddling: recorded.meddling.len(),
        }
    }

    fn is_of(&self, status: &Status) -> bool {
        self.position == status.position
            && self.arrow == status.arrow
            && self.meddling == status.meddling.len()
    }
}

/// Whether leaving would lose something: a state away from home, or changed by hand, that is not
/// what was kept last.
pub(super) fn is_unsaved(status: &Status, kept: Option<&Kept>) -> bool {
    let somewhere = status.position != 0 || !status.meddling.is_empty();
    somewhere && !kept.is_some_and(|kept| kept.is_of(status))
}
