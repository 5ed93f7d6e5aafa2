//! The course of a run: every step of both legs, what is recorded after it, and what is left behind
//! when it is stopped or fails.

use super::error::RunError;
use super::estimate::expected_seconds;
use super::left::{Left, scene_hash};
use super::outcome::{Cost, Digests, Found, Outcome};
use super::plan::Plan;
use super::row::Row;
use super::seen::Seen;
use crate::enclosure::Enclosure;
use crate::frame::Frame;
use crate::output::{Checksums, Manifest, OutputError, RunDirectory, RunStatus, Snapshot};
use crate::player::{Arrow, Player};
use crate::pool::Rayon;
use crate::ranged_fault::RangedFault;
use crate::scene::Scene;
use crate::setup;
use crate::simulation::{BuildError, Options};
use loschmidt_core::Fault;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Steps are taken in pieces of about this many particle steps: 30 ms of the fast executor, so that
/// a signal is heard soon.
const PIECE: u64 = 500_000;

/// What an observer is told, several times a second.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Steps taken over both legs.
    pub step: u64,
    /// Steps planned for both legs.
    pub total: u64,
    /// True after the turnaround.
    pub way_back: bool,
    /// The latest row.
    pub row: &'a Row,
    /// The first row.
    pub home: &'a Row,
}

/// Where the latest good state is.
enum Good {
    /// The player has it.
    Home,
    /// The latest snapshot in the directory.
    Stored,
    /// Here, for a run without a directory.
    Kept(Box<Snapshot>),
}

/// A run under way.
pub struct Run {
    player: Player,
    plan: Plan,
    scene_hash: [u8; 16],
    rows: Vec<Row>,
    turnaround_digest: Option<String>,
    /// What the walls enclose.
    walls: Option<Enclosure>,
    seen: Seen,
    /// The state that a run is taken back to when a step fails.
    good: Good,
    directory: Option<RunDirectory>,
    started: Instant,
    loop_time: Duration,
    loop_steps: u64,
}

impl Run {
    /// Sets up a scene at home, in a new directory if one is given; with `true` beside it, an
    /// earlier run in it is replaced.
    ///
    /// # Errors
    /// The scene is too large or cannot be simulated; the directory cannot be made.
    pub fn start(
        scene: Scene,
        options: Options,
        out: Option<(&Path, bool)>,
    ) -> Result<Self, RunError> {
        Self::start_when_ready(scene, options, out, || {})
    }

    /// The same, and calls `ready` once the scene is set up, which may take minutes, before anything is
    /// written.
    ///
    /// # Errors
    /// See [`Run::start`].
    pub fn start_when_ready(
        scene: Scene,
        options: Options,
        out: Option<(&Path, bool)>,
        ready: impl FnOnce(),
    ) -> Result<Self, RunError> {
        let started = Instant::now();
        let (player, walls) = new_player(scene, options)?;
        ready();
        let directory = out
            .map(|(path, force)| RunDirectory::create(path, force))
            .transpose()?;
        let mut run = Self::new(player, walls, directory, started);
        if let Some(directory) = &run.directory {
            directory.write_scene(&run.player.scene().to_toml())?;
        }
        run.write_manifest(RunStatus::Running, None, None)?;
        run.record(0)?;
        Ok(run)
    }

    /// Goes on with the run in this directory. Executor and threads may be others than before.
    ///
    /// # Errors
    /// Not a run, or one that has ended; its files cannot be read or do not belong together.
    pub fn resume(
        path: &Path,
        choose: impl FnOnce(&Manifest) -> Options,
    ) -> Result<Self, RunError> {
        let started = Instant::now();
        let manifest = RunDirectory::read_manifest(path)?;
        match manifest.status {
            RunStatus::Running | RunStatus::Interrupted => {}
            RunStatus::Watched => return Err(RunError::Watched(path.to_owned())),
            RunStatus::Finished | RunStatus::Failed => {
                return Err(RunError::Ended {
                    path: path.to_owned(),
                    failed: manifest.status == RunStatus::Failed,
                });
            }
        }
        let left = Left::read(path, manifest)?;
        let options = Options {
            arithmetic: left.arithmetic(),
            ..choose(&left.manifest)
        };
        let (mut player, walls) = new_player(left.scene.clone(), options)?;
        let plan = Plan::of(player.scene());
        let home = left.snapshot("home", |home| home.state.step == 0)?;
        let latest = left.snapshot("latest", |_| true)?;
        let turned = plan.back > 0 && latest.state.step >= plan.out;
        let turnaround = turned
            .then(|| left.snapshot("turnaround", |turn| turn.state.step == plan.out))
            .transpose()?;
        player.restore_home(home.state.clone())?;
        player.restore(&latest.state, latest.position, latest.arrow)?;
        let step = latest.state.step;
        left.compare(&home, turnaround.as_ref(), &latest)?;
        let mut run = Self::new(player, walls, None, started);
        run.seen = left.manifest.seen;
        let rows = left.rows(step)?.into_iter();
        // Earlier versions wrote the momentum in quanta alone.
        run.rows = rows.map(|row| row.with_momentum(&run.player)).collect();
        run.turnaround_digest = turnaround.map(|snapshot| snapshot.digest().to_string());
        left.has_frames(step)?;
        run.directory = Some(RunDirectory::reopen(path, &run.rows)?);
        run.good = Good::Stored;
        run.note_frames(step)?;
        Ok(run)
    }

    fn new(
        player: Player,
        walls: Option<Enclosure>,
        directory: Option<RunDirectory>,
        started: Instant,
    ) -> Self {
        Self {
            plan: Plan::of(player.scene()),
            scene_hash: scene_hash(player.scene()),
            rows: Vec::new(),
            turnaround_digest: None,
            walls,
            seen: Seen::default(),
            good: Good::Home,
            directory,
            player,
            started,
            loop_time: Duration::ZERO,
            loop_steps: 0,
        }
    }

    fn note_frames(&mut self, step: u64) -> Result<(), RunError> {
        let dt = self.player.scene().time_step();
        if let Some(directory) = &mut self.directory {
            for s in self.plan.frames_until(step) {
                directory.note_frame(s as f64 * dt)?;
            }
        }
        Ok(())
    }

    /// The directory written to.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.directory.as_ref().map(RunDirectory::path)
    }

    /// The player, to look at.
    #[must_use]
    pub fn player(&self) -> &Player {
        &self.player
    }

    /// The rows so far.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The course of the run.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Takes the run to its end. `observe` is called several times a second; when `stop` becomes
    /// true, the run leaves a snapshot and returns [`RunError::Interrupted`].
    ///
    /// # Errors
    /// [`RunError`].
    pub fn execute(
        &mut self,
        mut observe: impl FnMut(&Progress<'_>),
        stop: &AtomicBool,
    ) -> Result<Outcome, RunError> {
        let total = self.plan.total();
        let particles = self.player.home().id.len() as u64;
        let piece = PIECE / particles.max(1);
        self.observe(&mut observe);
        while self.player.steps_taken() < total {
            if stop.load(Ordering::Relaxed) {
                return Err(self.interrupt()?);
            }
            let step = self.player.steps_taken();
            if step == self.plan.out {
                self.player.turn();
            }
            let steps = self.plan.next(step, piece) - step;
            let before = Instant::now();
            let result = self.player.advance(steps);
            self.loop_time += before.elapsed();
            self.loop_steps += steps;
            if let Err(fault) = result {
                return Err(self.fail(fault)?);
            }
            self.record(step + steps)?;
            self.observe(&mut observe);
        }
        self.finish()
    }

    /// How long the run will take, s, by some of its first steps, which are then taken back. `None`
    /// away from home and in floating point, and where the steps end early.
    pub fn expected_seconds(&mut self) -> Option<f64> {
        expected_seconds(&mut self.player, &self.plan)
    }

    fn observe(&self, observe: &mut impl FnMut(&Progress<'_>)) {
        if let (Some(home), Some(row)) = (self.rows.first(), self.rows.last()) {
            observe(&Progress {
                step: self.player.steps_taken(),
                total: self.plan.total(),
                way_back: self.player.arrow() == Arrow::Backward,
                row,
                home,
            });
        }
    }

    /// Records what is due after `step` steps.
    fn record(&mut self, step: u64) -> Result<(), RunError> {
        let due = self.plan.due(step);
        if due.row {
            let leg = if step > self.plan.out { 2 } else { 1 };
            let row = match Row::measure(&mut self.player, leg) {
                Ok(row) => row,
                Err(fault) => return Err(self.fail(fault)?),
            };
            if let Some(directory) = &mut self.directory {
                directory.write_row(&row)?;
            }
            self.rows.push(row);
        }
        if due.frame || due.snapshot {
            self.player.release();
        }
        if step == self.plan.out && self.plan.back > 0 {
            self.turnaround_digest = Some(self.player.digest().to_string());
            self.write_snapshot("turnaround")?;
        }
        if due.frame && self.directory.is_some() {
            let frame = match self.player.frame() {
                Ok(frame) => frame,
                Err(fault) => return Err(self.fail(fault)?),
            };
            self.look(&frame);
            if let Some(directory) = &mut self.directory {
                directory.write_frame(&frame)?;
            }
        } else if step == self.plan.out || step == self.plan.total() {
            match self.player.frame() {
                Ok(frame) => self.look(&frame),
                Err(fault) => return Err(self.fail(fault)?),
            }
        }
        if due.snapshot {
            // Let go of the one before first: it is as large as the state.
            self.good = Good::Home;
            let snapshot = self.snapshot();
            if let Some(directory) = &self.directory {
                if step == 0 {
                    directory.write_snapshot("home", &snapshot)?;
                }
                directory.write_snapshot("latest", &snapshot)?;
            }
            self.good = match &self.directory {
                _ if step == 0 => Good::Home,
                Some(_) => Good::Stored,
                None => Good::Kept(Box::new(snapshot)),
            };
            self.write_manifest(RunStatus::Running, None, None)?;
        }
        Ok(())
    }

    fn look(&mut self, frame: &Frame) {
        let density = self.player.scene().reference_density();
        self.seen.look(frame, density, self.walls.as_ref());
    }

    fn snapshot(&mut self) -> Snapshot {
        Snapshot {
            scene: self.scene_hash,
            position: self.player.position(),
            arrow: self.player.arrow(),
            state: self.player.save(),
        }
    }

    fn write_snapshot(&mut self, name: &str) -> Result<Option<PathBuf>, RunError> {
        let snapshot = self.snapshot();
        let Some(directory) = &self.directory else {
            return Ok(None);
        };
        Ok(Some(directory.write_snapshot(name, &snapshot)?))
    }

    fn write_manifest(
        &mut self,
        status: RunStatus,
        failure: Option<String>,
        result: Option<&Outcome>,
    ) -> Result<(), RunError> {
        let Some(directory) = &self.directory else {
            return Ok(());
        };
        let options = self.player.options();
        let manifest = Manifest {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene: self.player.scene().name.clone(),
            status,
            steps: self.player.steps_taken(),
            steps_planned: self.plan.total(),
            arithmetic: options.arithmetic.name().to_owned(),
            executor: options.executor.name().to_owned(),
            threads: options.threads.get(),
            meddling: Vec::new(),
            failure,
            seen: self.seen,
            series: Some(Checksums::of(&self.rows)),
            digest: Digests {
                initial: self.player.home_digest().to_string(),
                turnaround: self.turnaround_digest.clone(),
                last: self.player.digest().to_string(),
            },
            result: result.cloned(),
        };
        directory.write_manifest(&manifest)?;
        Ok(())
    }

    /// Leaves a snapshot of the present state; returns the error to end with.
    fn interrupt(&mut self) -> Result<RunError, RunError> {
        self.write_snapshot("latest")?;
        self.write_manifest(RunStatus::Interrupted, None, None)?;
        Ok(RunError::Interrupted {
            step: self.player.steps_taken(),
            path: self.path().map(Path::to_owned),
        })
    }

    /// Leaves a snapshot of the last good state: the run is taken back to the latest kept state and
    /// from there to the step before the one that failed, which is the same steps as before.
    fn fail(&mut self, fault: Fault) -> Result<RunError, RunError> {
        let stored = match (&self.good, self.path()) {
            (Good::Stored, Some(path)) => {
                let path = RunDirectory::snapshot_path(path, "latest");
                Some(Snapshot::read(&path).map_err(OutputError::from)?)
            }
            _ => None,
        };
        match (&self.good, &stored) {
            (Good::Kept(good), _) => {
                self.player
                    .restore(&good.state, good.position, good.arrow)?;
            }
            (_, Some(good)) => {
                self.player
                    .restore(&good.state, good.position, good.arrow)?;
            }
            _ => {
                let home = self.player.home().clone();
                self.player.restore(&home, 0, Arrow::Forward)?;
            }
        }
        let good_step = fault.step.saturating_sub(1);
        while self.player.steps_taken() < good_step {
            if self.player.steps_taken() == self.plan.out && self.player.arrow() == Arrow::Forward {
                self.player.turn();
            }
            self.player.advance(1)?;
        }
        let snapshot = self.write_snapshot("latest")?;
        let time = fault.step as f64 * self.player.scene().time_step();
        let fault = RangedFault::of(&self.player, fault);
        self.write_manifest(RunStatus::Failed, Some(fault.to_string()), None)?;
        Ok(RunError::Fault {
            fault,
            time,
            snapshot,
        })
    }

    fn finish(&mut self) -> Result<Outcome, RunError> {
        let came_home = self.plan.back > 0 && self.plan.back == self.plan.out;
        let came_back = came_home.then(|| self.player.compare_with_home());
        let last_digest = self.player.digest().to_string();
        let lone_particles = self.player.measure()?.lone_particles;
        let cost = Cost {
            steps: self.loop_steps,
            loop_s: self.loop_time.as_secs_f64(),
            wall_s: self.started.elapsed().as_secs_f64(),
        };
        let outcome = Outcome::new(
            &self.player,
            &self.rows,
            Found {
                turnaround_digest: self.turnaround_digest.clone(),
                came_back,
                last_digest,
                lone_particles,
                seen: self.seen,
                cost,
            },
        )
        .ok_or(RunError::NoRows)?;
        self.write_manifest(RunStatus::Finished, None, Some(&outcome))?;
        Ok(outcome)
    }
}

/// Home, after the memory for it was found to be there.
fn new_player(scene: Scene, options: Options) -> Result<(Player, Option<Enclosure>), RunError> {
    setup::check_memory(&scene)?;
    // The initial state correction works on the threads that the run may have.
    let threads = Rayon::new(options.threads).map_err(BuildError::from)?;
    let initial = threads.install(|| scene.initial_state())?;
    let walls = setup::enclosure(&scene, &initial);
    Ok((Player::new(scene, initial, options)?, walls))
}
