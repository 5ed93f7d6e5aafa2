//! The deck: a player on a thread of its own, and the messages to and from it.
//!
//! ```text
//! face (dashboard, window) --Command--> [thread: Player, clock, waypoints] --Report--> face
//! ```
//!
//! A face draws what it is told and sends what its user wants; it never waits for a step. The
//! thread looks at its commands between pieces of steps that take some milliseconds, and hands over
//! a new picture only when the last one has been drawn ([`Deck::ready`]), at most [`FRAMES`] times
//! a second. Which steps are taken is up to the commands; no timing changes a bit of a state.
//!
//! Time is integrated in either direction and never turns by itself: it turns on
//! [`Command::Turn`], and stands still at the start. The pace is in simulated seconds per second,
//! and does not depend on the machine as long as the machine keeps up.
//!
//! 1. `messages`: [`Command`], [`Report`]. 2. `opening`: what is played, a scene or an earlier run.
//! 3. `worker`: the thread. 4. `clock`: the pace. 5. `waypoints`: who is not on the way home.
//! 6. `beside`: the same in the other arithmetic.

mod beside;
mod clock;
mod keep;
mod messages;
mod opening;
mod waypoints;
mod worker;

pub use clock::{faster, slower, suggested_pace};
pub use messages::{
    Arrival, Beside, Command, Meddling, Moment, Opened, Perturbation, Refusal, Report, Seek, Shot,
    Status,
};
pub use opening::{Opening, OpeningError, Recorded};

use crate::pool::Rayon;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;

/// Pictures a second at most.
pub const FRAMES: u32 = 30;

/// What a face wishes for besides the first player's reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wishes {
    /// Pictures a second at most.
    pub frames: u32,
    /// Whether a second player does the same steps in the other arithmetic; only for a scene that
    /// is played from its start.
    pub beside: bool,
}

impl Default for Wishes {
    fn default() -> Self {
        Self {
            frames: FRAMES,
            beside: false,
        }
    }
}

/// A player on a thread of its own.
pub struct Deck {
    commands: Option<Sender<Command>>,
    ready: Arc<AtomicBool>,
    threads: Arc<OnceLock<Rayon>>,
    thread: Option<JoinHandle<()>>,
}

impl Deck {
    /// Opens a scene or an earlier run and begins to play. `report` is called on the thread of the
    /// deck, first with [`Report::Opened`] or [`Report::Failed`], and should hand over at once.
    ///
    /// # Errors
    /// The thread cannot be started.
    pub fn open(
        opening: Opening,
        report: impl Fn(Report) + Send + 'static,
    ) -> std::io::Result<Self> {
        Self::open_with(opening, Wishes::default(), report)
    }

    /// The same for a face with wishes of its own.
    ///
    /// # Errors
    /// The thread cannot be started.
    pub fn open_with(
        opening: Opening,
        wishes: Wishes,
        report: impl Fn(Report) + Send + 'static,
    ) -> std::io::Result<Self> {
        let (commands, inbox) = channel();
        let ready = Arc::new(AtomicBool::new(true));
        let drawn = Arc::clone(&ready);
        let threads = Arc::new(OnceLock::new());
        let lent = Arc::clone(&threads);
        let thread = std::thread::Builder::new()
            .name("deck".to_owned())
            .spawn(move || worker::work(opening, wishes, inbox, drawn, &lent, Box::new(report)))?;
        Ok(Self {
            commands: Some(commands),
            ready,
            threads,
            thread: Some(thread),
        })
    }

    /// Runs `work`, say a drawing, where it keeps the simulation least. Where the simulation has a
    /// thread for every processor they do it, between the parts of their steps: other threads would
    /// push them aside, and each that is kept from its part makes all wait.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        match self.threads.get() {
            Some(threads) if threads.threads() >= processors.max(2) => threads.install(work),
            _ => work(),
        }
    }

    /// Sends a command; a deck that has failed hears nothing.
    pub fn send(&self, command: Command) {
        if let Some(commands) = &self.commands {
            let _ = commands.send(command);
        }
    }

    /// Leaves the thread alone, which ends after the piece that it is at, or with the program: the
    /// set-up of a scene may take minutes.
    pub fn leave(mut self) {
        self.thread = None;
    }

    /// The last picture has been drawn: the next one may come.
    pub fn ready(&self) {
        self.ready.store(true, Ordering::Release);
    }
}

impl Drop for Deck {
    /// Ends the thread after the piece that it is at.
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
