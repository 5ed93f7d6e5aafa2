//! Leaving a state behind, to be opened again.

use super::messages::Meddling;
use crate::output::{Checksums, Manifest, OutputError, RunDirectory, RunStatus, Snapshot};
use crate::player::{Arrow, Player};
use crate::run::{Digests, Plan, Row, Seen, scene_hash};
use std::path::{Path, PathBuf};

/// The directory that a deck has created.
#[derive(Default)]
pub(super) struct Keeper {
    path: Option<PathBuf>,
}

impl Keeper {
    /// Writes the present state, its home and the series so far.
    pub fn keep(
        &mut self,
        player: &mut Player,
        path: &Path,
        rows: &[Row],
        meddling: &[Meddling],
    ) -> Result<(), OutputError> {
        if self.path.as_deref() != Some(path) {
            drop(RunDirectory::create(path, false)?);
            self.path = Some(path.to_owned());
        }
        let directory = RunDirectory::reopen(path, rows)?;
        directory.write_scene(&player.scene().to_toml())?;
        let scene = scene_hash(player.scene());
        let home = Snapshot {
            scene,
            position: 0,
            arrow: Arrow::Forward,
            state: player.home().clone(),
        };
        directory.write_snapshot("home", &home)?;
        let latest = Snapshot {
            scene,
            position: player.position(),
            arrow: player.arrow(),
            state: player.save(),
        };
        directory.write_snapshot("latest", &latest)?;
        let options = player.options();
        let manifest = Manifest {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene: player.scene().name.clone(),
            status: RunStatus::Watched,
            steps: player.steps_taken(),
            steps_planned: Plan::of(player.scene()).total(),
            arithmetic: options.arithmetic.name().to_owned(),
            executor: options.executor.name().to_owned(),
            threads: options.threads.get(),
            meddling: meddling.to_vec(),
            seen: Seen::default(),
            failure: None,
            digest: Digests {
                initial: player.home_digest().to_string(),
                turnaround: None,
                last: player.digest().to_string(),
            },
            series: Some(Checksums::of(rows)),
            result: None,
        };
        directory.write_manifest(&manifest)
    }
}
