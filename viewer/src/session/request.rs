//! What is to be opened, and what a key in a list or a panel leads to.

use loschmidt_runner::Options;
use loschmidt_runner::deck::{Opening, OpeningError};
use std::num::NonZeroUsize;
use std::path::Path;

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
