//! The executors by name, and one of them ready to work.

use crate::fast::Fast;
use crate::pool::Rayon;
use loschmidt_core::Serial;

/// Which executor, by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExecutorKind {
    /// The core's reference, one thread.
    Serial,
    /// The reference's traversal on all threads asked for.
    Rayon,
    /// Vectorised half-pair sweeps on all threads asked for.
    #[default]
    Fast,
}

impl ExecutorKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Serial, Self::Rayon, Self::Fast];

    /// The name used on the command line and in outputs.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Serial => "serial",
            Self::Rayon => "rayon",
            Self::Fast => "fast",
        }
    }

    /// The executor of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// An executor, ready to work.
#[derive(Debug)]
pub(crate) enum AnyExecutor {
    Serial(Serial),
    Rayon(Rayon),
    Fast(Box<Fast>),
}
