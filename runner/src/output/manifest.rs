//! `manifest.json`: what a run directory is, for people and for `resume`.

use super::checksums::Checksums;
use crate::deck::Meddling;
use crate::run::{Digests, Outcome, Seen};
use serde::{Deserialize, Serialize};

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RunStatus {
    /// At work, or killed without a chance to say so.
    Running,
    /// Stopped by a signal; can be resumed.
    Interrupted,
    /// Ended as planned.
    Finished,
    /// Left the number range.
    Failed,
    /// Left by a dashboard, to be opened there again.
    Watched,
}

/// The manifest.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of the program that wrote it.
    pub version: String,
    /// Name of the scene.
    pub scene: String,
    /// How far it has come.
    pub status: RunStatus,
    /// Steps taken over both legs.
    pub steps: u64,
    /// Steps planned for both legs.
    pub steps_planned: u64,
    /// `fixed` or `float`.
    pub arithmetic: String,
    /// The executor asked for.
    pub executor: String,
    /// The threads asked for.
    pub threads: usize,
    /// What ended a failed run.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub failure: Option<String>,
    /// How a user who watched it changed the state by hand.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pub meddling: Vec<Meddling>,
    /// What was seen of the scene so far.
    #[serde(default)]
    pub seen: Seen,
    /// The digests known so far.
    pub digest: Digests,
    /// Checksums of the series so far; none by an earlier version.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub series: Option<Checksums>,
    /// The result of a finished run; written, never read back.
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none", default)]
    pub result: Option<Outcome>,
}
