//! What the faces, dashboard and window, do alike: what they open and keep, and their words for what
//! happens.

mod list;
mod panel;

pub use list::{Choice, List, choices};
pub use panel::Panel;

use crate::colour::Colormap;
use crate::colouring::Colouring;
use loschmidt_runner::deck::{Meddling, Opening, OpeningError, Perturbation, Recorded, Status};
use loschmidt_runner::{ArithmeticKind, Arrow, Options};
use std::fs::File;
use std::io::ErrorKind;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What is to be opened.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Request {
    /// A scene of the catalogue, a scene file or the directory of a run.
    pub name: String,
    /// Overrides `key=value`.
    pub set: Vec<String>,
    /// Threads; `None` for those of the program's options.
    pub threads: Option<usize>,
    /// Whether the other arithmetic is played beside it.
    pub beside: bool,
}

impl Request {
    /// What it opens.
    ///
    /// # Errors
    /// There is no such scene or run, or it is broken.
    pub fn opening(&self, options: Options) -> Result<Opening, OpeningError> {
        let threads = self.threads.and_then(NonZeroUsize::new);
        let options = Options {
            threads: threads.unwrap_or(options.threads),
            ..options
        };
        Opening::of(&self.name, &self.set, options)
    }

    /// The same from its start, with nothing done to it.
    #[must_use]
    pub fn anew(&self) -> Self {
        let mut name = self.name.clone();
        if Path::new(&name).is_dir() {
            // A run goes on where it was left; its scene begins.
            name = format!("{}/scene.toml", name.trim_end_matches('/'));
        }
        Self {
            name,
            ..self.clone()
        }
    }
}

/// The most threads that a user may ask for: more than any machine has processors for.
pub const MOST_THREADS: usize = 1024;

/// What a key in an open list or panel leads to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It stays open.
    Stay,
    /// It is closed.
    Close,
    /// This is opened in the place of what is open.
    Open(Request),
    /// The program ends.
    Quit,
}

/// What was kept last: nothing has happened since if it is still so.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// The directory.
    pub path: PathBuf,
    /// Steps from home.
    pub position: i64,
    /// Direction of motion.
    pub arrow: Arrow,
    /// How often the state had been changed by hand.
    pub meddling: usize,
}

impl Kept {
    /// The state of this status in this directory.
    #[must_use]
    pub fn new(path: PathBuf, status: &Status) -> Self {
        Self {
            path,
            position: status.position,
            arrow: status.arrow,
            meddling: status.meddling.len(),
        }
    }

    /// The directory of an earlier run that was opened.
    #[must_use]
    pub fn recorded(path: PathBuf, recorded: &Recorded) -> Self {
        Self {
            path,
            position: recorded.position,
            arrow: recorded.arrow,
            meddling: recorded.meddling.len(),
        }
    }

    fn is_of(&self, status: &Status) -> bool {
        self.position == status.position
            && self.arrow == status.arrow
            && self.meddling == status.meddling.len()
    }
}

/// Whether leaving would lose something: a state away from home, or changed by hand, that is not
/// what was kept last.
#[must_use]
pub fn is_unsaved(status: &Status, kept: Option<&Kept>) -> bool {
    let somewhere = status.position != 0 || !status.meddling.is_empty();
    somewhere && !kept.is_some_and(|kept| kept.is_of(status))
}

/// How a notice is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// It was done.
    Done,
    /// It was done, and something must be known of it.
    Warning,
    /// It was not done.
    Refused,
}

/// A line that stays for some seconds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// How it is meant.
    pub tone: Tone,
    /// What it says.
    pub text: String,
    /// When it goes.
    pub until: Duration,
}

impl Notice {
    /// One that comes now.
    #[must_use]
    pub fn new(tone: Tone, text: impl Into<String>, now: Duration) -> Self {
        /// How long it stays.
        const STAYS: Duration = Duration::from_secs(6);
        Self {
            tone,
            text: text.into(),
            until: now + STAYS,
        }
    }
}

/// Time was turned.
#[must_use]
pub fn turned(arrow: Arrow, arithmetic: ArithmeticKind) -> (Tone, &'static str) {
    match (arrow, arithmetic) {
        (Arrow::Backward, ArithmeticKind::Float) => (
            Tone::Warning,
            "time reversed, in floating point: these sums do not lead back home",
        ),
        (Arrow::Backward, ArithmeticKind::Fixed) => (
            Tone::Done,
            "time reversed: every velocity has changed its sign",
        ),
        (Arrow::Forward, _) => (Tone::Done, "time runs forward again"),
    }
}

/// The state was changed by hand. `quantum`: what a last bit is, m.
#[must_use]
pub fn meddled(meddling: &Meddling, quantum: f64) -> String {
    match meddling.what {
        Perturbation::Flipped(particle) => {
            format!("particle {particle}: last bit flipped, it stands {quantum:.1e} m aside")
        }
        Perturbation::Switched(ArithmeticKind::Float) => {
            "floating point from here on: the same terms, their sums rounded".to_owned()
        }
        Perturbation::Switched(ArithmeticKind::Fixed) => "fixed point from here on".to_owned(),
    }
}

/// The colouring after this one; that of a picture comes last, where there is one.
#[must_use]
pub fn next_colouring(now: &Colouring, tint: Option<Colouring>) -> Colouring {
    let all = Colouring::MEASURED;
    match (all.iter().position(|c| c == now), tint) {
        (Some(place), Some(tint)) if place + 1 == all.len() => tint,
        (Some(place), _) => all[(place + 1) % all.len()].clone(),
        (None, _) => all[0].clone(),
    }
}

/// The colour map that suits the colouring, and then all of them in turn.
#[must_use]
pub fn next_colormap(now: Option<Colormap>) -> Option<Colormap> {
    let all = Colormap::ALL;
    match now {
        None => Some(all[0]),
        Some(map) => {
            let place = all.iter().position(|m| *m == map).unwrap_or(0);
            all.get(place + 1).copied()
        }
    }
}

/// A new PNG file of this name in the present directory, with a number where there is one already.
///
/// # Errors
/// It cannot be created.
pub fn new_picture(name: &str) -> std::io::Result<(File, PathBuf)> {
    let mut number = 1;
    loop {
        let path = match number {
            1 => PathBuf::from(format!("{name}.png")),
            n => PathBuf::from(format!("{name}-{n}.png")),
        };
        match File::create_new(&path) {
            Ok(file) => return Ok((file, path)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
        }
    }
}
