//! Why there is no window.

use crate::movie::MovieError;
use crate::session::{DEFECT, Defect, LostState};
use loschmidt_runner::deck::OpeningError;
use std::path::PathBuf;
use thiserror::Error;

/// The other ways to watch, told where there is no window.
const ELSE: &str = "`loschmidt tui` shows the same in a terminal, `loschmidt movie` makes pictures";

/// Why there is no window, or no longer.
#[derive(Debug, Error)]
pub enum WindowError {
    /// There is nothing to show.
    #[error(transparent)]
    Opening(#[from] OpeningError),
    /// The picture to tint with cannot be read.
    #[error(transparent)]
    Tint(#[from] MovieError),
    /// There is no display.
    #[error("there is no display for a window; {ELSE}")]
    NoDisplay,
    /// The display does not answer.
    #[error("the display cannot be opened ({0}); {ELSE}")]
    Display(String),
    /// A library that is looked for at run time is missing.
    #[error("a window needs the library {0}, which is not on this system; {ELSE}")]
    Library(String),
    /// A run goes on where it was left, and the other arithmetic has not been played up to there.
    #[error("{0} is a run; to see both arithmetics, play its scene anew: {0}/scene.toml --beside")]
    Beside(String),
    /// The program is wrong; the state is kept in this directory.
    #[error("{0}")]
    Defect(Defect, Option<PathBuf>),
    /// The state could not be kept.
    #[error("the state is lost: {0}")]
    Lost(#[from] LostState),
}

impl WindowError {
    /// The exit code that it ends the program with.
    #[must_use]
    pub fn code(&self) -> u8 {
        match self {
            Self::Lost(_) => 3,
            Self::Defect(..) => DEFECT,
            _ => 2,
        }
    }

    /// What went wrong on the way to a display, from its description. `set`: whether the
    /// environment names a display.
    pub(super) fn of_display(description: &str, set: bool) -> Self {
        match (library(description), set) {
            (Some(library), _) => Self::Library(library),
            (None, false) => Self::NoDisplay,
            (None, true) => {
                let known = [
                    ("XOpenDisplayFailed", "no X server answers at DISPLAY"),
                    ("NoCompositor", "no Wayland compositor answers"),
                    ("NoWaylandLib", "the Wayland client library is missing"),
                ];
                let known = known.iter().find(|(name, _)| description.contains(name));
                let why = known.map_or(description, |(_, words)| words);
                Self::Display(why.lines().next().unwrap_or_default().to_owned())
            }
        }
    }
}

/// The first name of a shared library in a text.
fn library(text: &str) -> Option<String> {
    let part = |c: char| c.is_ascii_alphanumeric() || "._-+".contains(c);
    text.split(|c: char| !part(c))
        .find(|word| word.starts_with("lib") && word.contains(".so"))
        .map(|word| word.trim_end_matches('.').to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(description: &str, set: bool) -> String {
        WindowError::of_display(description, set).to_string()
    }

    #[test]
    fn a_missing_library_is_named() {
        let loader = "OpenError { kind: Library, detail: \"opening library failed \
                      (libXcursor.so.1: cannot open shared object file: \
                      No such file or directory)\" }";
        assert!(said(loader, true).contains("the library libXcursor.so.1,"));
        let panic = "Library libxkbcommon-x11.so could not be loaded.";
        assert!(said(panic, true).contains("the library libxkbcommon-x11.so,"));
    }

    #[test]
    fn without_a_display_one_line_points_to_terminal_and_movie() {
        let text = said("neither WAYLAND_DISPLAY nor DISPLAY is set.", false);
        assert_eq!(text.lines().count(), 1);
        assert!(text.contains("loschmidt tui") && text.contains("loschmidt movie"));
        assert!(said("XNotSupported(XOpenDisplayFailed)", true).contains("no X server answers"));
    }
}
