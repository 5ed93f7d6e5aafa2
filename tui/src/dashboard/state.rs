//! The state of the dashboard: everything that a view shows.

use loschmidt_runner::deck::{Arrival, Moment, Opened, Perturbation, Report, Status};
use loschmidt_runner::run::Row;
use loschmidt_runner::{Arrow, Points};
use loschmidt_viewer::face::{Kept, List, Notice, Panel, Request, is_unsaved};
use loschmidt_viewer::{Home, Look, Track};
use std::time::Duration;

/// How many colours the terminal has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// All of them.
    #[default]
    True,
    /// The 256 of the cube.
    Indexed,
    /// The 16 of old.
    Basic,
    /// None are wanted.
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

/// What lies over the rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys, from this line on where there is no room for all.
    Help(usize),
    /// What can be opened, and which is chosen.
    Scenes(List),
    /// The panel of parameters.
    Parameters(Panel),
    /// Nothing can be shown, and why.
    Error(String),
}

/// A scene that is shown.
#[derive(Debug)]
pub struct Stage {
    /// What the deck said when it was opened.
    pub opened: Box<Opened>,
    pub home: Home,
    pub points: Points,
    pub status: Status,
    /// Energies and entropies of both ways.
    pub track: Track,
    /// The latest state that was measured.
    pub moment: Option<Box<Moment>>,
    /// Where on the bar the mouse or a key wants to go, steps; until the deck says that it goes there.
    pub wanted: Option<i64>,
    /// A turn was asked for and not yet heard of.
    pub turning: bool,
}

impl Stage {
    pub fn new(mut opened: Box<Opened>) -> Self {
        let rows = std::mem::take(&mut opened.rows);
        let mut track = Track::of_rows(&rows);
        if track.out().is_empty() {
            track.push(opened.first.clone(), Arrow::Forward);
        }
        Self {
            home: Home::new(&opened.scene, &opened.home),
            points: Points::from(&opened.home),
            status: opened.status.clone(),
            track,
            moment: None,
            wanted: None,
            turning: false,
            opened,
        }
    }

    /// The direction of time as the user has it: a turn that was asked for is shown at once.
    pub fn arrow(&self) -> Arrow {
        if self.turning {
            self.status.arrow.turned()
        } else {
            self.status.arrow
        }
    }

    /// Steps that the time bar has room for.
    pub fn span(&self) -> i64 {
        self.opened
            .span
            .max(self.status.farthest)
            .max(self.status.position)
            .max(1)
    }

    /// The row of the latest state that was measured.
    pub fn row(&self) -> &Row {
        self.moment
            .as_ref()
            .map_or(&self.opened.first, |moment| &moment.row)
    }

    /// Gravitational energy at the start less its lowest value so far, J.
    pub fn released(&self) -> f64 {
        let start = self.opened.first.energy("gravitational");
        let rows = self.track.out().iter().chain(self.track.back());
        let lowest = rows.fold(start, |low, row| low.min(row.energy("gravitational")));
        start - lowest.min(self.row().energy("gravitational"))
    }

    /// The particle whose bit was flipped last.
    pub fn flipped(&self) -> Option<u64> {
        self.status
            .meddling
            .iter()
            .rev()
            .find_map(|m| match m.what {
                Perturbation::Flipped(particle) => Some(particle),
                Perturbation::Switched(_) => None,
            })
    }
}

/// The state.
#[derive(Debug, Default)]
pub struct State {
    /// Columns and rows of the terminal.
    pub size: (u16, u16),
    pub depth: Depth,
    /// Since the start of the program.
    pub now: Duration,
    /// What is open or being opened.
    pub request: Request,
    /// Number of the deck that is heard.
    pub deck: u64,
    pub stage: Option<Stage>,
    pub look: Look,
    pub overlay: Overlay,
    /// The start was reached: stays until a key.
    pub banner: Option<Box<Arrival>>,
    pub notice: Option<Notice>,
    /// Where a drag began or was last.
    pub drag: Option<Drag>,
    pub kept: Option<Kept>,
    /// The program ends.
    pub leaving: bool,
}

/// A drag of the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drag {
    /// On the bar.
    Bar,
    /// On the field, last at this cell.
    Field(u16, u16),
}

impl State {
    pub fn new(depth: Depth, size: (u16, u16), request: Request) -> Self {
        Self {
            size,
            depth,
            request,
            ..Self::default()
        }
    }

    /// What would be lost by leaving now.
    pub fn unsaved(&self) -> bool {
        let Some(stage) = &self.stage else {
            return false;
        };
        is_unsaved(&stage.status, self.kept.as_ref())
    }

    /// Whether a picture came with this report.
    pub fn is_picture(report: &Report) -> bool {
        matches!(report, Report::Shot(_))
    }
}
