//! What an earlier part of a run has left, read back: nothing is taken that it has not written.
//!
//! The snapshots must be those of the scene beside them, of moments that the plan passes, and of
//! the digests in the manifest; the series must have the numbers of the checksums there; and the
//! frames must be there.

use super::error::RunError;
use super::plan::Plan;
use super::row::Row;
use crate::output::{FRAME_FORMATS, Manifest, OutputError, RunDirectory, Snapshot};
use crate::saved::ArithmeticKind;
use crate::scene::{self, Scene, Source};
use loschmidt_core::digest::hash;
use std::path::Path;

/// The directory of an earlier part of a run.
pub(crate) struct Left<'a> {
    path: &'a Path,
    /// Its manifest.
    pub manifest: Manifest,
    /// Its scene.
    pub scene: Scene,
}

impl<'a> Left<'a> {
    /// Reads the scene of the run in this directory.
    pub fn read(path: &'a Path, manifest: Manifest) -> Result<Self, RunError> {
        Ok(Self {
            path,
            manifest,
            scene: scene::load(&Source::Path(RunDirectory::scene_path(path)), &[])?,
        })
    }

    /// The arithmetic of its latest state.
    pub fn arithmetic(&self) -> ArithmeticKind {
        if self.manifest.arithmetic == ArithmeticKind::Float.name() {
            ArithmeticKind::Float
        } else {
            ArithmeticKind::Fixed
        }
    }

    /// The snapshot of this name, if it is one of the scene.
    pub fn any_snapshot(&self, name: &str) -> Result<Snapshot, RunError> {
        let file = RunDirectory::snapshot_path(self.path, name);
        let snapshot = Snapshot::read(&file).map_err(OutputError::from)?;
        if belongs(&snapshot, self.path, &self.scene) {
            Ok(snapshot)
        } else {
            Err(RunError::ForeignSnapshot(file))
        }
    }

    /// The same of a run that follows its plan, at a moment that `belongs` there.
    pub fn snapshot(
        &self,
        name: &str,
        belongs: impl FnOnce(&Snapshot) -> bool,
    ) -> Result<Snapshot, RunError> {
        let snapshot = self.any_snapshot(name)?;
        if Plan::of(&self.scene).passes(&snapshot) && belongs(&snapshot) {
            return Ok(snapshot);
        }
        Err(RunError::MisplacedSnapshot {
            path: RunDirectory::snapshot_path(self.path, name),
            step: snapshot.state.step,
        })
    }

    /// Compares the snapshots with the digests of the manifest. A latest one that is newer was
    /// written in the moment before the run was killed.
    pub fn compare(
        &self,
        home: &Snapshot,
        turnaround: Option<&Snapshot>,
        latest: &Snapshot,
    ) -> Result<(), OutputError> {
        let known = &self.manifest.digest;
        let is_of_manifest = latest.state.step == self.manifest.steps;
        let pairs = [
            ("home", Some(home), Some(&known.initial)),
            ("turnaround", turnaround, known.turnaround.as_ref()),
            (
                "latest",
                Some(latest),
                is_of_manifest.then_some(&known.last),
            ),
        ];
        for (name, snapshot, wanted) in pairs {
            let (Some(snapshot), Some(wanted)) = (snapshot, wanted) else {
                continue;
            };
            let found = snapshot.digest().to_string();
            if found != *wanted {
                return Err(OutputError::Changed {
                    path: RunDirectory::snapshot_path(self.path, name),
                    what: format!("its state has the digest {found}, the manifest says {wanted}"),
                });
            }
        }
        Ok(())
    }

    /// The rows up to this step, all that are due and no others.
    pub fn rows(&self, step: u64) -> Result<Vec<Row>, OutputError> {
        let rows = RunDirectory::read_rows(self.path, &self.manifest, step)?;
        let plan = Plan::of(&self.scene);
        let due = (0..=step).filter(|&s| plan.due(s).row);
        if rows.iter().map(|row| row.step).eq(due) {
            return Ok(rows);
        }
        Err(OutputError::NotARun {
            path: self.path.to_owned(),
            why: format!("series.csv does not hold the rows up to step {step}"),
        })
    }

    /// Whether the frames up to this step are there.
    pub fn has_frames(&self, step: u64) -> Result<(), OutputError> {
        let frames = Plan::of(&self.scene).frames_until(step).count();
        RunDirectory::has_frames(self.path, frames, &FRAME_FORMATS)
    }
}

/// Whether a snapshot is that of the scene in this run directory. The text that was written there
/// is what counts: the next version of this program may print the same scene with other comments.
fn belongs(snapshot: &Snapshot, directory: &Path, scene: &Scene) -> bool {
    let written = std::fs::read(RunDirectory::scene_path(directory));
    snapshot.scene == scene_hash(scene) || written.is_ok_and(|text| snapshot.scene == hash(&text))
}

/// Hash of the resolved scene, which ties snapshots to it.
pub(crate) fn scene_hash(scene: &Scene) -> [u8; 16] {
    hash(scene.to_toml().as_bytes())
}
