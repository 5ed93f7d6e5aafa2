//! The state of the dashboard: a session, and what the terminal adds to it.

use loschmidt_viewer::Look;
use loschmidt_viewer::session::{Face, Session};

/// How many colours the terminal can show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// All colours of 24 bits.
    #[default]
    True,
    /// The 256 of a fixed table.
    Indexed,
    /// The 16 that every terminal has.
    Basic,
    /// None: the user wants no colours.
    None,
}

impl Depth {
    /// From the environment: `NO_COLOR`, `COLORTERM`, `TERM`.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Self {
        let is = |name: &str, wanted: &[&str]| {
            variable(name).is_some_and(|value| wanted.iter().any(|w| value.contains(w)))
        };
        if variable("NO_COLOR").is_some_and(|value| !value.is_empty()) {
            Self::None
        } else if is("COLORTERM", &["truecolor", "24bit"]) || is("TERM", &["direct", "kitty"]) {
            Self::True
        } else if is("TERM", &["256"]) {
            Self::Indexed
        } else {
            Self::Basic
        }
    }

    /// Whether a cell can show two pixels by their colours.
    pub fn has_pixels(self) -> bool {
        matches!(self, Self::True | Self::Indexed)
    }
}

/// The state of the dashboard.
#[derive(Debug)]
pub struct DashboardState {
    /// What it shows.
    pub session: Session,
    /// Columns and rows of the terminal.
    pub size: (u16, u16),
    pub depth: Depth,
    /// The line that the help begins with, where there is no room for all.
    pub help_line: usize,
}

impl DashboardState {
    /// The state of a dashboard of this size that shows nothing yet.
    pub fn new(depth: Depth, size: (u16, u16)) -> Self {
        Self {
            session: Session::new(Face::Dashboard, Look::default()),
            size,
            depth,
            help_line: 0,
        }
    }
}
