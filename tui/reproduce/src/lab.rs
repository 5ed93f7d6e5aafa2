//! The laboratory: scenes are run in the directory of the report, once.
//!
//! `DIR/runs/NAME` is an ordinary run directory. Asked for a run, the lab looks there first: a
//! finished run of the same scene is read, an interrupted one goes on, and only where there is none
//! a new one is started. Sections are kept in `DIR/NAME.json`.

use crate::section::{Figure, Section};
use loschmidt_core::Fault;
use loschmidt_runner::output::{OutputError, RunDirectory, RunStatus, Snapshot, SnapshotError};
use loschmidt_runner::run::Row;
use loschmidt_runner::scene::{Scene, SceneError, Source, load};
use loschmidt_runner::{ArithmeticKind, BuildError, Options, Player, Run, RunError, SavedState};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use thiserror::Error;

/// Why a target came to no end.
#[derive(Debug, Error)]
pub enum LabError {
    /// A run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A simulation.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The numbers ended where they should not.
    #[error("the numbers ended: {0}")]
    Fault(#[from] Fault),
    /// A file.
    #[error("cannot {what} {}: {source}", path.display())]
    Io {
        /// What was tried.
        what: &'static str,
        /// With which file.
        path: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
    /// A signal came.
    #[error("interrupted")]
    Interrupted,
    /// Something else is in the directory.
    #[error("{} {why}; choose another --out, or replace it with --force", path.display())]
    Occupied {
        /// The directory.
        path: PathBuf,
        /// What is in it.
        why: &'static str,
    },
}

/// What the lab tells on the way.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// A line.
    Line(&'a str),
    /// How far the present run has come.
    Progress {
        /// Name of the run.
        run: &'a str,
        /// Steps taken.
        done: u64,
        /// Steps planned.
        total: u64,
    },
}

/// A run that has ended, one way or the other.
#[derive(Clone, Debug)]
pub struct Past {
    /// What was run.
    pub scene: Scene,
    /// Its rows.
    pub rows: Vec<Row>,
    /// Whether the last state is the first; `None` for a one-way run and for one that ended early.
    pub returned: Option<bool>,
    /// What ended it early.
    pub failure: Option<String>,
    /// Where it is.
    pub path: PathBuf,
}

impl Past {
    /// Rows of the way out.
    pub fn out(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.leg == 1)
    }

    /// Rows of the way back.
    pub fn back(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.leg == 2)
    }

    /// A kept state: `home`, `turnaround` or `latest`.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn state(&self, name: &str) -> Result<SavedState, LabError> {
        let snapshot = Snapshot::read(&RunDirectory::snapshot_path(&self.path, name));
        Ok(snapshot
            .map_err(|e: SnapshotError| RunError::from(OutputError::from(e)))?
            .state)
    }
}

/// Where targets are worked out.
pub struct Lab<'a> {
    dir: PathBuf,
    quick: bool,
    options: Options,
    stop: &'a AtomicBool,
    news: Box<dyn FnMut(News<'_>) + 'a>,
}

/// A scene of the catalogue with overrides.
///
/// # Errors
/// A mistake in an override.
pub fn scene(name: &str, set: &[String]) -> Result<Scene, LabError> {
    Ok(load(&Source::Catalogue(name.to_owned()), set)?)
}

/// A scene from its text.
///
/// # Errors
/// A mistake in it.
pub fn scene_of(name: &str, text: &str) -> Result<Scene, LabError> {
    let source = Source::Text {
        name: format!("{name}.toml"),
        text: text.to_owned(),
    };
    Ok(load(&source, &[])?)
}

/// `key=value` for [`scene`].
#[must_use]
pub fn set<const N: usize>(pairs: [&str; N]) -> Vec<String> {
    pairs.map(str::to_owned).to_vec()
}

/// How often the signals are looked at during a set-up.
const LOOK_UP: Duration = Duration::from_millis(5);

const MARK: &str = "reproduce.json";

#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct ReportMark {
    report: String,
    quick: bool,
}

impl<'a> Lab<'a> {
    /// A lab in a directory, which is made, or was made by an earlier one of the same size.
    ///
    /// # Errors
    /// Something else is there; or it cannot be made.
    pub fn open(
        dir: &Path,
        quick: bool,
        force: bool,
        options: Options,
        stop: &'a AtomicBool,
        news: impl FnMut(News<'_>) + 'a,
    ) -> Result<Self, LabError> {
        let mark = ReportMark {
            report: "loschmidt reproduce".to_owned(),
            quick,
        };
        let path = dir.join(MARK);
        let occupied = |why| LabError::Occupied {
            path: dir.to_owned(),
            why,
        };
        if dir.exists() {
            let text = fs::read_to_string(&path).unwrap_or_default();
            match serde_json::from_str::<ReportMark>(&text) {
                Ok(found) if found == mark => {}
                Ok(_) if force => remove_sections(dir)?,
                Ok(found) if found.quick => return Err(occupied("holds a quick report")),
                Ok(_) => return Err(occupied("holds a report of full size")),
                Err(_) if fs::read_dir(dir).is_ok_and(|mut entries| entries.next().is_none()) => {}
                Err(_) => {
                    return Err(LabError::Occupied {
                        path: dir.to_owned(),
                        why: "is not the directory of a report",
                    });
                }
            }
        }
        if force {
            remove_sections(dir)?;
        }
        fs::create_dir_all(dir.join("runs")).map_err(io("create", dir))?;
        let lab = Self {
            dir: dir.to_owned(),
            quick,
            options,
            stop,
            news: Box::new(news),
        };
        let text = serde_json::to_string(&mark).unwrap_or_default();
        lab.write(MARK, &text)?;
        Ok(lab)
    }

    /// Whether coarser spacings are asked for.
    #[must_use]
    pub fn quick(&self) -> bool {
        self.quick
    }

    /// Where files go.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// How things are computed.
    #[must_use]
    pub fn options(&self) -> Options {
        self.options
    }

    /// One of two, by size.
    pub fn size<T>(&self, quick: T, full: T) -> T {
        if self.quick { quick } else { full }
    }

    /// Tells a line.
    pub fn say(&mut self, line: &str) {
        (self.news)(News::Line(line));
    }

    /// Ends where a signal came.
    ///
    /// # Errors
    /// A signal came.
    pub fn check(&self) -> Result<(), LabError> {
        if self.stop.load(Ordering::Relaxed) {
            Err(LabError::Interrupted)
        } else {
            Ok(())
        }
    }

    /// Writes a file of the report.
    ///
    /// # Errors
    /// The file system's.
    pub fn write(&self, name: &str, text: &str) -> Result<(), LabError> {
        let path = self.dir.join(name);
        let beside = self.dir.join(format!("{name}.part"));
        fs::write(&beside, text).map_err(io("write", &beside))?;
        fs::rename(&beside, &path).map_err(io("replace", &path))
    }

    /// Writes a figure and puts it into the section.
    ///
    /// # Errors
    /// The file system's.
    pub fn figure(
        &self,
        section: &mut Section,
        name: &str,
        svg: &str,
        caption: &str,
    ) -> Result<(), LabError> {
        let file = format!("{name}.svg");
        self.write(&file, svg)?;
        section.figures.push(Figure {
            file,
            caption: caption.to_owned(),
        });
        Ok(())
    }

    /// The run of this name, made if need be. A run that ends early is not an error here.
    ///
    /// # Errors
    /// A run of another scene is there; the scene cannot be run; a signal came.
    pub fn run(
        &mut self,
        name: &str,
        scene: Scene,
        arithmetic: ArithmeticKind,
    ) -> Result<Past, LabError> {
        self.check()?;
        let path = self.dir.join("runs").join(name);
        if path.exists() && !is_of(&path, &scene) {
            return Err(LabError::Occupied {
                path,
                why: "holds a run of another scene",
            });
        }
        if let Some(past) = past(&path, &scene) {
            return Ok(past);
        }
        let options = Options {
            arithmetic,
            ..self.options
        };
        let can_resume = RunDirectory::read_manifest(&path).is_ok()
            && RunDirectory::snapshot_path(&path, "latest").exists();
        let (place, of) = (path.clone(), scene.clone());
        let mut run = self.set_up(move || {
            if can_resume {
                return Run::resume(&place, |_| options);
            }
            // What a killed run left before its first snapshot is of no use.
            Run::start(of, options, Some((&place, place.exists())))
        })??;
        let news = &mut self.news;
        let result = run.execute(
            |p| {
                news(News::Progress {
                    run: name,
                    done: p.step,
                    total: p.total,
                });
            },
            self.stop,
        );
        match result {
            Ok(_) | Err(RunError::Fault { .. }) => {}
            Err(RunError::Interrupted { .. }) => return Err(LabError::Interrupted),
            Err(error) => return Err(error.into()),
        }
        drop(run);
        past(&path, &scene).ok_or(LabError::Interrupted)
    }

    /// A player at home in a scene.
    ///
    /// # Errors
    /// The scene cannot be simulated.
    pub fn player(&mut self, scene: &Scene, options: Options) -> Result<Player, LabError> {
        self.check()?;
        let scene = scene.clone();
        self.set_up(move || -> Result<Player, LabError> {
            let initial = scene.initial_state()?;
            Ok(Player::new(scene, initial, options)?)
        })?
    }

    /// Does what may take minutes on a thread of its own, and listens for a signal meanwhile. After
    /// one the thread is left alone: it ends with the program.
    pub(crate) fn set_up<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, LabError> {
        let worker = std::thread::spawn(work);
        while !worker.is_finished() {
            self.check()?;
            std::thread::sleep(LOOK_UP);
        }
        worker
            .join()
            .or_else(|panic| std::panic::resume_unwind(panic))
    }

    /// Takes a player `steps` steps on, listening for a signal.
    ///
    /// # Errors
    /// A signal came, or the numbers ended.
    pub fn advance(&mut self, name: &str, player: &mut Player, steps: u64) -> Result<(), LabError> {
        let piece = (200_000 / player.home().id.len().max(1) as u64).max(1);
        let mut done = 0;
        while done < steps {
            self.check()?;
            let next = piece.min(steps - done);
            player.advance(next)?;
            done += next;
            (self.news)(News::Progress {
                run: name,
                done,
                total: steps,
            });
        }
        Ok(())
    }

    /// As [`Lab::advance`]; false where the numbers ended, and in `ended` what the fault says.
    ///
    /// # Errors
    /// A signal came.
    pub fn advance_to_fault(
        &mut self,
        name: &str,
        player: &mut Player,
        steps: u64,
        ended: &mut Option<String>,
    ) -> Result<bool, LabError> {
        match self.advance(name, player, steps) {
            Ok(()) => Ok(true),
            Err(LabError::Fault(fault)) => {
                *ended = Some(fault.to_string());
                Ok(false)
            }
            Err(error) => Err(error),
        }
    }

    /// A section that is there already.
    #[must_use]
    pub fn kept(&self, target: &str) -> Option<Section> {
        let text = fs::read_to_string(self.dir.join(format!("{target}.json"))).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// Keeps a section.
    ///
    /// # Errors
    /// The file system's.
    pub fn keep(&self, section: &Section) -> Result<(), LabError> {
        let text = serde_json::to_string_pretty(section)
            .map_err(|e| io("write", &self.dir)(std::io::Error::other(e)))?;
        self.write(&format!("{}.json", section.target), &text)
    }
}

fn io(what: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> LabError {
    let path = path.to_owned();
    move |source| LabError::Io { what, path, source }
}

/// Removes the sections of an earlier report; its runs stay, for they are what they are.
fn remove_sections(dir: &Path) -> Result<(), LabError> {
    let Ok(entries) = fs::read_dir(dir) else {
        return Ok(());
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        if is_section(&path) {
            fs::remove_file(&path).map_err(io("remove", &path))?;
        }
    }
    Ok(())
}

/// Whether a file holds a section under the name of its target, as [`Lab::keep`] writes it.
fn is_section(path: &Path) -> bool {
    let text = fs::read_to_string(path).unwrap_or_default();
    let target = path.file_stem().and_then(|stem| stem.to_str());
    path.extension()
        .is_some_and(|extension| extension == "json")
        && serde_json::from_str::<Section>(&text).is_ok_and(|s| Some(s.target.as_str()) == target)
}

/// Whether the directory holds a run of this scene, or of none yet.
fn is_of(path: &Path, scene: &Scene) -> bool {
    match fs::read_to_string(RunDirectory::scene_path(path)) {
        Ok(text) => text == scene.to_toml(),
        Err(_) => true,
    }
}

fn past(path: &Path, scene: &Scene) -> Option<Past> {
    let manifest = RunDirectory::read_manifest(path).ok()?;
    let ended = matches!(manifest.status, RunStatus::Finished | RunStatus::Failed);
    let two_way = scene.turnaround.is_some() && manifest.status == RunStatus::Finished;
    ended.then_some(())?;
    Some(Past {
        scene: scene.clone(),
        rows: RunDirectory::read_rows(path, &manifest, u64::MAX).ok()?,
        returned: two_way.then(|| manifest.digest.initial == manifest.digest.last),
        failure: manifest.failure,
        path: path.to_owned(),
    })
}
