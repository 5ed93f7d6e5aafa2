//! Pictures of runs that are simulated for them.
//!
//! One run, or two of the same scene in different arithmetic. After a picture both are at the same
//! step; that is where an interrupted export goes on. The plots have a point for every row that a
//! run would record, and for every picture.

use super::camera::Views;
use super::directory::{Movie, replace};
use super::error::MovieError;
use super::{MovieProgress, Schedule};
use crate::draw::{Look, Pane, draw};
use crate::history::History;
use crate::home::Home;
use loschmidt_core::digest::hash;
use loschmidt_runner::figures::count;
use loschmidt_runner::output::Snapshot;
use loschmidt_runner::output::series::{self, SeriesWriter};
use loschmidt_runner::player::Return;
use loschmidt_runner::ranged_fault::RangedFault;
use loschmidt_runner::run::Row;
use loschmidt_runner::{ArithmeticKind, Arrow, Plan, Player, Points, SavedState};
use std::fs::File;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Steps are taken in pieces of about this many particle steps, so that a signal is heard soon.
const PIECE: u64 = 20_000;

/// Between two checkpoints.
const PAUSE: Duration = Duration::from_secs(20);

/// How a run of the movie ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fate {
    /// Its arithmetic.
    pub arithmetic: ArithmeticKind,
    /// How far from home it is; `None` where it was not to come home.
    pub home: Option<Return>,
}

/// How the runs of a movie ended, in the order of the panes.
pub type Ending = Vec<Fate>;

/// A run and what is known of it.
struct Strand {
    player: Player,
    rows: Vec<Row>,
    history: History,
    /// The state after the latest picture.
    kept: (SavedState, i64, Arrow),
}

impl Strand {
    /// Measures the state for the plots; the way out has so many steps.
    fn measure(&mut self, out: u64) -> Result<(), MovieError> {
        let player = &mut self.player;
        let leg = if player.steps_taken() > out { 2 } else { 1 };
        let row = Row::measure(player, leg).map_err(|fault| fault_of(player, fault))?;
        self.history.push((&row).into());
        self.rows.push(row);
        Ok(())
    }
}

/// Runs under way.
struct Export<'a> {
    strands: Vec<Strand>,
    home: Home,
    views: Views,
    look: Look,
    schedule: Schedule,
    plan: Plan,
    scene: [u8; 16],
    comes_home: bool,
    stop: &'a AtomicBool,
}

impl Movie {
    /// Simulates the runs of these players, all of one scene and at home, and draws the pictures
    /// that are not there yet. `observe` is told after every picture; when `stop` becomes true, the
    /// state is kept and [`MovieError::Interrupted`] returned.
    ///
    /// # Errors
    /// [`MovieError`].
    pub fn simulate(
        &mut self,
        players: Vec<Player>,
        mut observe: impl FnMut(&MovieProgress),
        stop: &AtomicBool,
    ) -> Result<Ending, MovieError> {
        let mut export = Export::new(self, players, stop)?;
        let total = self.style.pictures;
        let mut first = export.resume(self)?;
        if first == 0 {
            export.picture(self, 0)?;
            export.keep();
            first = 1;
        }
        let mut checkpoint = Instant::now();
        for n in first..total {
            observe(&export.progress(n));
            let target = export.schedule.step(n);
            let began = Instant::now();
            let result = export.advance(target);
            self.times.simulating += began.elapsed();
            if !result? {
                export.checkpoint(self)?;
                return Err(MovieError::Interrupted {
                    done: n.max(self.found()),
                    total,
                });
            }
            export.picture(self, n)?;
            export.keep();
            if checkpoint.elapsed() > PAUSE {
                export.checkpoint(self)?;
                checkpoint = Instant::now();
            }
        }
        observe(&export.progress(total));
        self.finish()?;
        Ok(export.ending())
    }
}

impl<'a> Export<'a> {
    fn new(movie: &Movie, players: Vec<Player>, stop: &'a AtomicBool) -> Result<Self, MovieError> {
        let mut strands = Vec::new();
        let mut home = None;
        let mut plan = None;
        let mut scene = [0; 16];
        for mut player in players {
            if home.is_none() {
                let frame = player.frame().map_err(|fault| fault_of(&player, fault))?;
                home = Some(Home::new(player.scene(), &frame));
                plan = Some(Plan::of(player.scene()));
                scene = hash(player.scene().to_toml().as_bytes());
            }
            strands.push(Strand {
                history: History::new(home.as_ref().map_or(0.0, |home| home.span)),
                kept: (player.save(), 0, Arrow::Forward),
                rows: Vec::new(),
                player,
            });
        }
        let (Some(mut home), Some(plan)) = (home, plan) else {
            return Err(MovieError::Run(loschmidt_runner::RunError::NoRows));
        };
        let camera = movie.style.camera;
        if let Some(rectangle) = camera.rectangle {
            home.show_only(rectangle);
        }
        Ok(Self {
            views: Views::new(&camera, plan.back == plan.out),
            look: movie.style.look(&home),
            schedule: Schedule::new(&plan, movie.style.pictures),
            plan,
            comes_home: plan.back == plan.out,
            strands,
            home,
            scene,
            stop,
        })
    }

    fn progress(&self, done: usize) -> MovieProgress {
        MovieProgress {
            done,
            total: self.schedule.pictures,
            step: self.strands[0].player.steps_taken(),
            steps: self.schedule.total,
        }
    }

    /// Takes all runs to `target` steps over both legs; false where it was told to stop.
    fn advance(&mut self, target: u64) -> Result<bool, MovieError> {
        let out = self.schedule.out;
        for strand in &mut self.strands {
            let particles = strand.player.home().id.len() as u64;
            let piece = (PIECE / particles.max(1)).max(1);
            while strand.player.steps_taken() < target {
                if self.stop.load(Ordering::Relaxed) {
                    return Ok(false);
                }
                let player = &mut strand.player;
                let step = player.steps_taken();
                if step == out {
                    player.turn();
                }
                let until = if step < out { target.min(out) } else { target };
                let most = (until - step).min(piece);
                let row = (1..most).find(|n| self.plan.due(step + n).row);
                let next = step + row.unwrap_or(most);
                player
                    .advance(next - step)
                    .map_err(|fault| fault_of(player, fault))?;
                if next < target && self.plan.due(next).row {
                    strand.measure(out)?;
                }
            }
        }
        Ok(!self.stop.load(Ordering::Relaxed))
    }

    /// Measures the runs and draws picture `n`, unless it is there.
    fn picture(&mut self, movie: &mut Movie, n: usize) -> Result<(), MovieError> {
        let began = Instant::now();
        let (wanted, total) = (n >= movie.found(), movie.style.pictures);
        let mut pictures: Vec<Points> = Vec::new();
        for strand in &mut self.strands {
            strand.measure(self.schedule.out)?;
            let player = &mut strand.player;
            let mut points = Points::default();
            player
                .points(&mut points)
                .map_err(|fault| fault_of(player, fault))?;
            pictures.push(points);
        }
        self.views
            .next(&mut self.home, &self.schedule, pictures.iter());
        movie.times.simulating += began.elapsed();
        if !wanted {
            return Ok(());
        }
        let began = Instant::now();
        let look = Look {
            turn: self.schedule.turn(n, movie.style.fps),
            caption: self.caption(n),
            ..movie.style.camera.look(&self.look, n, total)
        };
        let panes: Vec<Pane<'_>> = self
            .strands
            .iter()
            .zip(&pictures)
            .map(|(strand, points)| Pane {
                label: self.label(strand),
                ..Pane::new(points, &strand.history)
            })
            .collect();
        let (width, height) = movie.style.size;
        let raster = draw(&panes, &self.home, &look, width, height);
        movie.times.drawing += began.elapsed();
        movie.times.pictures += 1;
        movie.write_picture(n, &raster)
    }

    fn label(&self, strand: &Strand) -> &'static str {
        match (self.strands.len(), strand.player.options().arithmetic) {
            (1, _) => "",
            (_, ArithmeticKind::Fixed) => "fixed point",
            (_, ArithmeticKind::Float) => "floating point",
        }
    }

    /// What stands under the title: at the end, whether the first run is at home.
    fn caption(&mut self, n: usize) -> String {
        let particles = self.strands[0].player.particles();
        if self.comes_home && n + 1 == self.schedule.pictures {
            let exact = self.strands[0].player.compare_with_home().is_exact();
            return if exact {
                "home, every bit".to_owned()
            } else {
                "not home".to_owned()
            };
        }
        format!("{} particles", count(particles))
    }

    fn ending(&mut self) -> Ending {
        let comes_home = self.comes_home;
        self.strands
            .iter_mut()
            .map(|strand| Fate {
                arithmetic: strand.player.options().arithmetic,
                home: comes_home.then(|| strand.player.compare_with_home()),
            })
            .collect()
    }

    fn keep(&mut self) {
        for strand in &mut self.strands {
            let player = &mut strand.player;
            strand.kept = (player.save(), player.position(), player.arrow());
        }
    }

    /// Writes the runs as they were after the latest picture.
    fn checkpoint(&self, movie: &Movie) -> Result<(), MovieError> {
        for (n, strand) in self.strands.iter().enumerate() {
            let (state, position, arrow) = strand.kept.clone();
            let snapshot = Snapshot {
                scene: self.scene,
                position,
                arrow,
                state,
            };
            replace(&movie.series_path(n), |file| {
                let mut writer = SeriesWriter::new(file);
                strand.rows.iter().try_for_each(|row| writer.write(row))
            })?;
            replace(&movie.state_path(n), |file| snapshot.write(file))?;
        }
        self.views.write(movie)
    }

    /// Takes the runs to where an earlier export kept them, and returns the first picture that is
    /// still to be passed. Without a state that belongs there, the runs begin at home again;
    /// pictures that are there are not drawn again.
    fn resume(&mut self, movie: &Movie) -> Result<usize, MovieError> {
        let mut loaded = Vec::new();
        for n in 0..self.strands.len() {
            let Some(state) = self.load(movie, n) else {
                return Ok(0);
            };
            loaded.push(state);
        }
        let (first, rows) = &loaded[0];
        let (step, measured) = (first.state.step, rows.len());
        let same = loaded
            .iter()
            .all(|(snapshot, rows)| snapshot.state.step == step && rows.len() == measured);
        // It was kept after one of the pictures that are there.
        let picture = (0..movie.found()).find(|&n| self.schedule.step(n) == step);
        let last = rows.last().map(|row| row.step);
        let Some(picture) = picture.filter(|_| same && last == Some(step)) else {
            return Ok(0);
        };
        if !self.views.read(&mut self.home, movie, picture + 1) {
            return Ok(0);
        }
        for (strand, (snapshot, rows)) in self.strands.iter_mut().zip(loaded) {
            let restored =
                strand
                    .player
                    .restore(&snapshot.state, snapshot.position, snapshot.arrow);
            restored.map_err(loschmidt_runner::RunError::from)?;
            rows.iter().for_each(|row| strand.history.push(row.into()));
            strand.rows = rows;
        }
        self.keep();
        Ok(picture + 1)
    }

    fn load(&self, movie: &Movie, n: usize) -> Option<(Snapshot, Vec<Row>)> {
        let snapshot = Snapshot::read(&movie.state_path(n)).ok()?;
        let arithmetic = self.strands[n].player.options().arithmetic;
        let belongs = snapshot.scene == self.scene && snapshot.state.arithmetic == arithmetic;
        let file = File::open(movie.series_path(n)).ok()?;
        let rows = series::read(file).ok()?;
        belongs.then_some((snapshot, rows))
    }
}

fn fault_of(player: &Player, fault: loschmidt_core::Fault) -> MovieError {
    MovieError::Fault {
        arithmetic: match player.options().arithmetic {
            ArithmeticKind::Fixed => "fixed",
            ArithmeticKind::Float => "floating",
        },
        time: fault.step as f64 * player.scene().time_step(),
        fault: RangedFault::of(player, fault),
    }
}
