//! How a run can end before its end.

use crate::output::OutputError;
use crate::ranged_fault::RangedFault;
use crate::scene::SceneError;
use crate::setup::MemoryError;
use crate::simulation::BuildError;
use loschmidt_core::Fault;
use std::path::PathBuf;
use thiserror::Error;

/// Why there is no outcome.
#[derive(Debug, Error)]
pub enum RunError {
    /// The scene cannot be read or used.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The scene needs more memory than there is; nothing was allocated.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The scene cannot be simulated.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A file could not be written or read.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The numbers ended.
    #[error("the run ended at t = {time:.6} s: {fault}")]
    Fault {
        /// Particle, step and range.
        fault: RangedFault,
        /// Simulated time along both legs, s.
        time: f64,
        /// The last good state, one step before.
        snapshot: Option<PathBuf>,
    },
    /// The numbers ended where they had not before: the memory of this machine is at fault.
    #[error("a step that had succeeded failed when it was repeated: {0}")]
    NotRepeatable(#[from] Fault),
    /// A signal came.
    #[error("interrupted after step {step}")]
    Interrupted {
        /// Steps taken.
        step: u64,
        /// Where to resume from.
        path: Option<PathBuf>,
    },
    /// The run to be resumed has ended.
    #[error(
        "the run in {} has {}: there is nothing to resume",
        path.display(),
        if *failed { "failed" } else { "finished" }
    )]
    Ended {
        /// Its directory.
        path: PathBuf,
        /// Whether it left the number range.
        failed: bool,
    },
    /// The directory was left by a dashboard, whose user goes back and forth as a plan does not.
    #[error(
        "{} was left by the dashboard or the window: \
         open it with `loschmidt tui` or `loschmidt view`",
        .0.display()
    )]
    Watched(PathBuf),
    /// A snapshot of another scene.
    #[error("{} was taken of another scene than the scene.toml beside it", .0.display())]
    ForeignSnapshot(PathBuf),
    /// A snapshot of this scene, but of another moment.
    #[error("{} holds the state after step {step}, which does not belong there", path.display())]
    MisplacedSnapshot {
        /// The file.
        path: PathBuf,
        /// Steps taken when it was.
        step: u64,
    },
    /// A run without rows has no outcome.
    #[error("the run recorded nothing")]
    NoRows,
}
