//! Pictures of a finished run, from the frames it stored: nothing is simulated again.

use super::directory::Movie;
use super::error::MovieError;
use super::{MovieProgress, MovieStyle, Schedule};
use crate::draw::{Look, Pane, draw};
use crate::framing;
use crate::history::History;
use crate::home::{Box3, Home};
use loschmidt_runner::figures::count;
use loschmidt_runner::output::particles_csv;
use loschmidt_runner::output::{Manifest, OutputError, RunDirectory, RunStatus, frame_path};
use loschmidt_runner::scene::{Scene, Source, load};
use loschmidt_runner::setup;
use loschmidt_runner::{Frame, Plan, Points, RunError};
use rayon::prelude::*;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// A finished run on the disk.
pub struct Stored {
    path: PathBuf,
    scene: Scene,
    plan: Plan,
    /// The steps of the frames, in their order.
    steps: Vec<u64>,
    history: History,
    manifest: Manifest,
}

impl Stored {
    /// Whether a directory is one that a run left.
    #[must_use]
    pub fn is_run(path: &Path) -> bool {
        path.is_dir() && RunDirectory::scene_path(path).is_file()
    }

    /// Opens the directory of a run.
    ///
    /// # Errors
    /// Not a run, or one that has not finished or stored no frames.
    pub fn open(path: &Path) -> Result<Self, MovieError> {
        let manifest = RunDirectory::read_manifest(path).map_err(RunError::from)?;
        if manifest.status == RunStatus::Watched {
            return Err(MovieError::Watched(path.to_owned()));
        }
        if manifest.status == RunStatus::Running && RunDirectory::is_in_use(path) {
            return Err(MovieError::AtWork {
                path: path.to_owned(),
                steps: manifest.steps,
                planned: manifest.steps_planned,
            });
        }
        if manifest.status != RunStatus::Finished {
            return Err(MovieError::Unfinished(path.to_owned()));
        }
        let source = Source::Path(RunDirectory::scene_path(path));
        let scene = load(&source, &[]).map_err(RunError::from)?;
        let plan = Plan::of(&scene);
        let rows = RunDirectory::read_rows(path, &manifest, plan.total());
        let rows = rows.map_err(RunError::from)?;
        let steps: Vec<u64> = plan.frames_until(plan.total()).collect();
        if steps.is_empty() {
            return Err(MovieError::NoFrames(path.to_owned()));
        }
        RunDirectory::has_frames(path, steps.len(), &["csv"]).map_err(RunError::from)?;
        let span = scene.steps_out() as f64 * scene.time_step();
        Ok(Self {
            path: path.to_owned(),
            history: History::of_rows(&rows, span),
            scene,
            plan,
            steps,
            manifest,
        })
    }

    /// Its scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How many frames it stored.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.steps.len()
    }

    /// Whether there is a frame for every picture of a movie.
    ///
    /// # Errors
    /// There are too few.
    pub fn suffices(&self, style: &MovieStyle) -> Result<(), MovieError> {
        if style.pictures > self.frames() {
            return Err(MovieError::FewFrames {
                path: self.path.clone(),
                stored: self.frames(),
                wanted: style.pictures,
                fps: style.fps,
            });
        }
        Ok(())
    }

    /// A text of everything that the frames depend on.
    #[must_use]
    pub fn identity(&self) -> String {
        format!(
            "stored {}\n{}",
            self.manifest.arithmetic,
            self.scene.to_toml()
        )
    }

    /// Reads a frame.
    fn frame(&self, index: usize) -> Result<Frame, MovieError> {
        let path = self.path.join(frame_path(index as u64, "csv"));
        let frame = File::open(&path)
            .and_then(|file| particles_csv::read(file, setup::columns(&self.scene)))
            .map_err(|e| OutputError::NotARun {
                path: self.path.clone(),
                why: format!("{} cannot be read ({e})", path.display()),
            })
            .map_err(RunError::from)?;
        let step = self.steps[index];
        let position = self.plan.position(step);
        let dt = self.scene.time_step();
        Ok(Frame {
            step: position,
            time: position as f64 * dt,
            elapsed: step as f64 * dt,
            way_back: step > self.plan.out,
            particle_mass: self.scene.particle_mass(),
            ..frame
        })
    }

    /// The regions of the frames that these pictures show, as far as they are read before `stop`
    /// becomes true: then no picture is drawn any more.
    fn regions(&self, schedule: &Schedule, stop: &AtomicBool) -> Result<Vec<Box3>, MovieError> {
        let pictures = 0..schedule.pictures;
        let mut frames: Vec<usize> = pictures.map(|n| self.nearest(schedule.step(n))).collect();
        // A frame of the way back is that of the way out, where the run came home; this does not
        // rely on it.
        frames.dedup();
        let regions = frames.into_par_iter().map(|index| {
            if stop.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let points = Points::from(&self.frame(index)?);
            Ok(framing::region(&points, self.scene.particle_spacing))
        });
        let regions: Result<Vec<Option<Box3>>, MovieError> = regions.collect();
        Ok(regions?.into_iter().flatten().collect())
    }

    /// The stored frame nearest to a step, the earlier one of two.
    fn nearest(&self, step: u64) -> usize {
        let after = self.steps.partition_point(|&s| s < step);
        let candidates = [after.saturating_sub(1), after.min(self.steps.len() - 1)];
        let [before, after] = candidates;
        if self.steps[before].abs_diff(step) <= self.steps[after].abs_diff(step) {
            before
        } else {
            after
        }
    }
}

impl Movie {
    /// Draws the pictures that are not there yet from the frames of a run.
    ///
    /// # Errors
    /// The run has fewer frames than the movie pictures; a frame cannot be read; a signal came.
    pub fn render(
        &mut self,
        run: &Stored,
        mut observe: impl FnMut(&MovieProgress),
        stop: &AtomicBool,
    ) -> Result<(), MovieError> {
        let total = self.style.pictures;
        run.suffices(&self.style)?;
        let schedule = Schedule::new(&run.plan, total);
        let first = run.frame(0)?;
        let mut home = Home::new(&run.scene, &first);
        let began = Instant::now();
        match self.style.camera.rectangle {
            Some(rectangle) => home.show_only(rectangle),
            None => home.show_all(run.regions(&schedule, stop)?),
        }
        self.times.reading += began.elapsed();
        let look = self.style.look(&home);
        for n in self.found()..total {
            if stop.load(Ordering::Relaxed) {
                return Err(MovieError::Interrupted { done: n, total });
            }
            let began = Instant::now();
            let index = run.nearest(schedule.step(n));
            let points = Points::from(&run.frame(index)?);
            self.times.reading += began.elapsed();
            observe(&MovieProgress {
                done: n,
                total,
                step: run.steps[index],
                steps: run.plan.total(),
            });
            let began = Instant::now();
            let history = run.history.until(run.steps[index]);
            let look = Look {
                turn: schedule.turn(n, self.style.fps),
                caption: format!("{} particles", count(points.len() as u64)),
                ..self.style.camera.look(&look, n, total)
            };
            let (width, height) = self.style.size;
            let raster = draw(&[Pane::new(&points, &history)], &home, &look, width, height);
            self.times.drawing += began.elapsed();
            self.times.pictures += 1;
            self.write_picture(n, &raster)?;
        }
        self.finish()
    }
}
