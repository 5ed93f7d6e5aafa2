//! What a deck plays: a scene from its start, or an earlier run from where it was left.

use super::messages::Meddling;
use crate::output::{OutputError, RunDirectory};
use crate::player::{Arrow, Player};
use crate::run::{Left, Row, RunError};
use crate::saved::SavedState;
use crate::scene::{self, Scene, SceneError, Source};
use crate::setup;
use crate::simulation::Options;
use std::path::Path;
use thiserror::Error;

/// What a deck plays.
#[derive(Clone, Debug)]
pub struct Opening {
    /// The scene.
    pub scene: Scene,
    /// How it is run.
    pub options: Options,
    /// Where an earlier run was left; `None` begins at home.
    pub recorded: Option<Box<Recorded>>,
    /// Simulated s per s; `None` for [`super::suggested_pace`].
    pub pace: Option<f64>,
}

/// Where an earlier run was left.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// Its first state.
    pub home: SavedState,
    /// Its latest state.
    pub state: SavedState,
    /// Steps from home of the latest.
    pub position: i64,
    /// Direction of motion of the latest.
    pub arrow: Arrow,
    /// Its series so far.
    pub rows: Vec<Row>,
    /// How it was changed by hand since it last was at home.
    pub meddling: Vec<Meddling>,
}

/// Why there is nothing to play.
#[derive(Debug, Error)]
pub enum OpeningError {
    /// The scene cannot be read or used.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The directory is not that of a run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run is what it is.
    #[error(
        "{path} is a run, and its scene cannot be changed\nhelp: play its scene anew: {path}/scene.toml --set {set}"
    )]
    Changed {
        /// The directory.
        path: String,
        /// The first override.
        set: String,
    },
}

impl From<OutputError> for OpeningError {
    fn from(error: OutputError) -> Self {
        Self::Run(error.into())
    }
}

impl Opening {
    /// A scene of the catalogue, a scene file, or the directory of a run, by its name or path.
    ///
    /// # Errors
    /// [`OpeningError`].
    pub fn of(name: &str, set: &[String], options: Options) -> Result<Self, OpeningError> {
        let opening = Self::read(name, set, options)?;
        // Before anything is given up for it.
        setup::check_memory(&opening.scene).map_err(RunError::from)?;
        Ok(opening)
    }

    fn read(name: &str, set: &[String], options: Options) -> Result<Self, OpeningError> {
        let source = scene::resolve(name)?;
        if let Source::Path(path) = &source
            && path.is_dir()
        {
            return match set.first() {
                Some(set) => Err(OpeningError::Changed {
                    path: name.trim_end_matches('/').to_owned(),
                    set: set.clone(),
                }),
                None => Self::of_run(path, options),
            };
        }
        Ok(Self {
            scene: scene::load(&source, set)?,
            options,
            recorded: None,
            pace: None,
        })
    }

    fn of_run(path: &Path, options: Options) -> Result<Self, OpeningError> {
        let manifest = RunDirectory::read_manifest(path)?;
        let left = Left::read(path, manifest)?;
        let (home, latest) = (left.any_snapshot("home")?, left.any_snapshot("latest")?);
        left.compare(&home, None, &latest)?;
        let rows = RunDirectory::read_rows(path, &left.manifest, latest.state.step)?;
        Ok(Self {
            options: Options {
                arithmetic: left.arithmetic(),
                ..options
            },
            scene: left.scene,
            recorded: Some(Box::new(Recorded {
                home: home.state,
                state: latest.state,
                position: latest.position,
                arrow: latest.arrow,
                rows,
                meddling: left.manifest.meddling,
            })),
            pace: None,
        })
    }

    /// The player, where the run was left, and its series.
    pub(super) fn player(self) -> Result<(Player, Option<Box<Recorded>>), RunError> {
        let initial = self.scene.initial_state()?;
        // Home is in the arithmetic that it was saved in; the latest state may be in the other.
        let at_home = self
            .recorded
            .as_ref()
            .map_or(self.options.arithmetic, |r| r.home.arithmetic);
        let options = Options {
            arithmetic: at_home,
            ..self.options
        };
        let mut player = Player::new(self.scene, initial, options)?;
        if let Some(recorded) = &self.recorded {
            player.restore_home(recorded.home.clone())?;
        }
        Ok((player, self.recorded))
    }
}
