//! The thread of a deck.

mod motion;
mod orders;

use super::Wishes;
use super::beside::Companion;
use super::clock::{DeckClock, suggested_pace};
use super::keep::Keeper;
use super::messages::{
    Arrival, Beside, Command, Meddling, Moment, Opened, Report, Seek, Shot, Status,
};
use super::opening::{Opening, Recorded};
use super::waypoints::Waypoints;
use crate::player::{Arrow, Player};
use crate::points::Points;
use crate::pool::Rayon;
use crate::ranged_fault::RangedFault;
use crate::run::{Plan, Row, RunError};
use crate::saved::{ArithmeticKind, SavedState};
use loschmidt_core::Fault;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// Steps are taken in pieces of about this time: handing over each of them costs more than a longer
/// wait for a command.
const PIECE: Duration = Duration::from_millis(8);

/// Rows on the way to the turnaround, at least.
const POINTS: u64 = 100;

type Tell = Box<dyn Fn(Report) + Send>;

/// Plays until the face has gone.
pub(super) fn work(
    opening: Opening,
    wishes: Wishes,
    inbox: Receiver<Command>,
    ready: Arc<AtomicBool>,
    threads: &OnceLock<Rayon>,
    tell: Tell,
) {
    let tell: Arc<Mutex<Tell>> = Arc::new(Mutex::new(tell));
    let ours = Arc::clone(&tell);
    let say = move |report| {
        if let Ok(tell) = ours.lock() {
            tell(report);
        }
    };
    // A defect must not leave a face that waits for ever.
    let played = catch_unwind(AssertUnwindSafe(move || {
        let beside = wishes.beside && opening.recorded.is_none();
        let companion = match beside.then(|| Companion::new(&opening)).transpose() {
            Ok(companion) => companion,
            Err(error) => return say(Report::Failed(error.to_string())),
        };
        let (pace, arithmetic) = (opening.pace, opening.options.arithmetic);
        let (player, recorded) = match opening.player() {
            Ok(opened) => opened,
            Err(error) => return say(Report::Failed(error.to_string())),
        };
        if let Some(lent) = player.pool() {
            // It is set once, here.
            let _ = threads.set(lent);
        }
        let mut worker = Worker::new(player, companion, &wishes, pace, ready, Box::new(say));
        match worker.begin(recorded, arithmetic) {
            Ok(()) => worker.run(&inbox),
            Err(error) => (worker.tell)(Report::Failed(error.to_string())),
        }
    }));
    if let Err(panic) = played {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&s| s.to_owned()));
        let why = format!("a defect of the program: {}", text.unwrap_or_default());
        let tell = tell.lock().unwrap_or_else(PoisonError::into_inner);
        tell(Report::Failed(why));
    }
}

struct Worker {
    player: Player,
    /// The same in the other arithmetic, where it is wished for and its numbers have not ended.
    companion: Option<Companion>,
    /// Pictures a second at most.
    frames: u32,
    tell: Tell,
    /// The face wants another picture.
    ready: Arc<AtomicBool>,
    clock: DeckClock,
    pace: f64,
    playing: bool,
    seek: Option<Seek>,
    /// Steps to the turnaround.
    span: i64,
    /// Steps between rows.
    every: i64,
    /// What a step takes, lately, s.
    step_time: f64,
    waypoints: Waypoints,
    astray: Option<usize>,
    meddling: Vec<Meddling>,
    /// The farthest since it last was at the start, steps.
    excursion: i64,
    /// The state that is gone back to when a step fails.
    good: (SavedState, i64, Arrow),
    keeper: Keeper,
    /// When the next picture is due; `None` for at once.
    due: Option<Instant>,
    /// The state has changed since.
    changed: bool,
    /// The direction in which the state was reached.
    travel: Arrow,
    /// The state has been measured.
    measured: bool,
    /// A picture that the face has done with.
    spare: Option<Box<Points>>,
}

impl Worker {
    fn new(
        player: Player,
        companion: Option<Companion>,
        wishes: &Wishes,
        pace: Option<f64>,
        ready: Arc<AtomicBool>,
        tell: Tell,
    ) -> Self {
        let plan = Plan::of(player.scene());
        let dt = player.scene().time_step();
        let pace = pace.unwrap_or_else(|| suggested_pace(plan.out as f64 * dt));
        let particles = player.home().id.len();
        // Curves have a hundred points at least, however few rows a run would store.
        let every = plan.row_every.min((plan.out / POINTS).max(1)) as i64;
        Self {
            clock: DeckClock::new(pace / dt, Instant::now()),
            good: (player.home().clone(), 0, Arrow::Forward),
            player,
            companion,
            frames: wishes.frames.max(1),
            tell,
            ready,
            pace,
            playing: true,
            seek: None,
            every,
            // The first piece is one step.
            step_time: PIECE.as_secs_f64(),
            waypoints: Waypoints::new(every, particles),
            astray: None,
            meddling: Vec::new(),
            excursion: 0,
            keeper: Keeper::default(),
            due: None,
            changed: true,
            travel: Arrow::Forward,
            measured: false,
            spare: None,
            span: plan.out as i64,
        }
    }

    /// Tells of home, and goes to where an earlier run was left.
    fn begin(
        &mut self,
        recorded: Option<Box<Recorded>>,
        arithmetic: ArithmeticKind,
    ) -> Result<(), RunError> {
        let fault = |fault: Fault| RunError::Build(fault.into());
        let home = self.player.frame().map_err(fault)?;
        let first = Row::measure(&mut self.player, 1).map_err(fault)?;
        let reversibility = self.player.reversibility();
        self.waypoints.mark(0, self.player.home(), Arrow::Forward);
        let rows = match recorded {
            None => Vec::new(),
            Some(recorded) => {
                self.meddling = recorded.meddling;
                self.player.switch_arithmetic(arithmetic)?;
                self.player
                    .restore(&recorded.state, recorded.position, recorded.arrow)?;
                let farthest = recorded.rows.iter().map(|row| row.position).max();
                self.player.reached(farthest.unwrap_or(0));
                recorded.rows
            }
        };
        self.keep_good();
        self.excursion = self.player.farthest();
        let opened = Opened {
            scene: self.player.scene().clone(),
            options: *self.player.options(),
            home,
            first,
            digest: self.player.home_digest(),
            reversibility,
            length_quantum: self.player.home().scale.length_quantum(),
            span: self.span,
            row_every: self.every,
            rows,
            status: self.status(),
        };
        (self.tell)(Report::Opened(Box::new(opened)));
        self.measure(Arrow::Forward, false);
        if self.at_start() {
            self.arrived();
        }
        self.clock.restart(Instant::now());
        Ok(())
    }

    fn run(&mut self, inbox: &Receiver<Command>) {
        loop {
            loop {
                match inbox.try_recv() {
                    Ok(command) => self.obey(command),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return,
                }
            }
            let wait = self.go_on();
            let wait = self.picture(wait);
            if wait.is_zero() {
                continue;
            }
            match inbox.recv_timeout(wait) {
                Ok(command) => self.obey(command),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Time has been turned, and the start reached.
    fn at_start(&self) -> bool {
        self.player.arrow() == Arrow::Backward && self.player.position() <= 0
    }

    /// Has the player in the other arithmetic do something, unless its numbers have ended.
    fn beside<T>(&mut self, act: impl FnOnce(&mut Companion) -> Result<T, Fault>) -> Option<T> {
        match act(self.companion.as_mut()?) {
            Ok(done) => Some(done),
            Err(fault) => {
                self.companion = None;
                (self.tell)(Report::Beside(Beside::Ended(RangedFault::of(
                    &self.player,
                    fault,
                ))));
                None
            }
        }
    }

    /// What is due after a piece of steps.
    fn moved(&mut self, travel: Arrow) {
        self.changed = true;
        self.travel = travel;
        self.measured = false;
        let position = self.player.position();
        self.excursion = self.excursion.max(position);
        if position.rem_euclid(self.every) == 0 {
            self.measure(travel, true);
        }
        if position == 0 && travel == Arrow::Backward {
            self.arrived();
        }
    }

    fn keep_good(&mut self) {
        self.good = (
            self.player.save(),
            self.player.position(),
            self.player.arrow(),
        );
        if let Some(companion) = &mut self.companion {
            companion.keep_good();
        }
    }

    /// Measures the state, and marks it or compares it with the marks.
    fn measure(&mut self, travel: Arrow, regular: bool) {
        self.measured = true;
        let leg = match travel {
            Arrow::Forward => 1,
            Arrow::Backward => 2,
        };
        let measured = self.player.measure();
        let measured = measured.map(|d| (Row::of(&self.player, leg, &d), d.histogram));
        let (row, histogram) = match measured {
            Ok(measured) => measured,
            Err(fault) => return self.fail(fault),
        };
        // A seek goes against the arrow without turning it.
        let row = match travel == self.player.arrow() {
            true => row,
            false => row.turned(),
        };
        if regular {
            self.keep_good();
            let (state, position, arrow) = &self.good;
            let (waypoints, astray) = (&mut self.waypoints, self.astray);
            let mut compare = || match travel {
                Arrow::Forward => {
                    waypoints.mark(*position, state, *arrow);
                    None
                }
                Arrow::Backward => waypoints.astray(*position, state, *arrow).or(astray),
            };
            self.astray = match self.player.pool() {
                Some(pool) => pool.install(compare),
                None => compare(),
            };
        }
        // The other one is compared at rows.
        let compared = regular || !self.playing;
        if let Some(Some(report)) =
            self.beside(|companion| compared.then(|| companion.measure(travel)).transpose())
        {
            (self.tell)(report);
        }
        (self.tell)(Report::Moment(Box::new(Moment {
            row,
            histogram,
            travel,
            regular,
        })));
    }

    /// At the start, coming from later.
    fn arrived(&mut self) {
        let comparison = self.player.compare_with_home();
        let farthest = std::mem::take(&mut self.excursion);
        (self.tell)(Report::Arrived(Box::new(Arrival {
            comparison,
            farthest,
            farthest_time: farthest as f64 * self.player.scene().time_step(),
            meddling: self.meddling.clone(),
            arithmetic: self.player.options().arithmetic,
        })));
        if comparison.is_exact() {
            self.meddling.clear();
        }
        self.stand();
        self.report();
    }

    /// Time stands still from now on: the numbers shown are those of this state.
    fn stand(&mut self) {
        self.clock.restart(Instant::now());
        self.due = None;
        self.changed = true;
    }

    /// The numbers ended: back to the last good state.
    fn fail(&mut self, fault: Fault) {
        let (state, position, arrow) = &self.good;
        // It came from this very player: it fits.
        let _ = self.player.restore(state, *position, *arrow);
        if let Some(companion) = &mut self.companion {
            companion.back_to_good();
        }
        self.playing = false;
        self.seek = None;
        self.measured = false;
        self.stand();
        (self.tell)(Report::Fault(RangedFault::of(&self.player, fault)));
        self.report();
    }

    fn status(&self) -> Status {
        let now = Instant::now();
        let moving = self.seek.is_some() || (self.playing && !self.at_start());
        Status {
            position: self.player.position(),
            farthest: self.player.farthest(),
            time: self.player.time(),
            arrow: self.player.arrow(),
            playing: self.playing,
            at_start: self.at_start(),
            seek: self.seek,
            pace: self.pace,
            steps_per_second: if moving { self.clock.speed(now) } else { 0.0 },
            keeps_up: self.seek.is_some() || self.clock.keeps_up(now),
            arithmetic: self.player.options().arithmetic,
            meddling: self.meddling.clone(),
            astray: self.astray,
        }
    }

    fn report(&self) {
        (self.tell)(Report::Status(self.status()));
    }

    /// Hands over a picture when one is due and wanted; how long to wait then, at most `wait`.
    fn picture(&mut self, wait: Duration) -> Duration {
        if !self.changed {
            return wait;
        }
        // Of two ends of a step, the one that is nearer to the time.
        let pause = Duration::from_secs(1) / self.frames;
        let half_a_step = Duration::from_secs_f64(0.5 * self.step_time).min(pause / 4);
        let now = Instant::now();
        let due = self.due.unwrap_or(now);
        let early = due.saturating_duration_since(now + half_a_step);
        if !early.is_zero() {
            return wait.min(early);
        }
        if !self.ready.swap(false, Ordering::Acquire) {
            // The face is still at the last one.
            return wait.min(Duration::from_millis(2));
        }
        // The numbers beside a picture are those of the picture.
        if !self.measured {
            self.measure(self.travel, false);
        }
        let mut points = self.spare.take().unwrap_or_default();
        match self.player.points(&mut points) {
            Ok(()) => {
                // In step with the clock, so that pictures that come a little late are not fewer.
                self.due = Some((due + pause).max(now + pause / 2));
                self.changed = false;
                if let Some(report) = self.beside(Companion::picture) {
                    (self.tell)(report);
                }
                let status = self.status();
                let points = *points;
                (self.tell)(Report::Shot(Box::new(Shot { points, status })));
            }
            Err(fault) => self.fail(fault),
        }
        wait
    }
}
