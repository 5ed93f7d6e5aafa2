//! The state of the window: everything that it shows.

use crate::colour::Rgb;
use crate::draw::Look;
use crate::face::{Kept, List, Notice, Panel, Request, is_unsaved};
use crate::history::History;
use crate::home::Home;
use crate::picture::Picture;
use crate::track::Track;
use loschmidt_core::Fault;
use loschmidt_runner::deck::{Arrival, Beside, Moment, Opened, Status};
use loschmidt_runner::{Arrow, Points};
use std::sync::Arc;
use std::time::Duration;

/// What lies over the rest.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys.
    Help,
    /// What can be opened.
    Scenes(List),
    /// The panel of parameters.
    Parameters(Panel),
    /// Nothing can be shown, and why.
    Error(String),
}

/// The ways of a player, and the same as curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ways {
    /// Its rows.
    pub track: Track,
    /// What the plots show.
    pub history: History,
}

impl Ways {
    fn of(track: Track, span: f64) -> Self {
        let history = track.history(span);
        Self { track, history }
    }

    /// Adds a row that was reached in this direction.
    pub fn push(&mut self, row: loschmidt_runner::run::Row, travel: Arrow, span: f64) {
        self.track.push(row, travel);
        self.history = self.track.history(span);
    }
}

/// The player in the other arithmetic.
#[derive(Clone, Debug, Default)]
pub struct Other {
    /// Its particles.
    pub points: Points,
    /// Its energies and entropies.
    pub ways: Ways,
    /// Why it goes no further.
    pub ended: Option<Fault>,
}

/// A scene that is shown.
#[derive(Debug)]
pub struct Stage {
    /// What the deck said when it was opened.
    pub opened: Box<Opened>,
    /// What stays the same in all pictures.
    pub home: Home,
    /// The particles.
    pub points: Points,
    /// Where everything is.
    pub status: Status,
    /// Energies and entropies of both ways.
    pub ways: Ways,
    /// The other arithmetic, where it is played too.
    pub other: Option<Other>,
    /// The colours of the particles from a picture, in the order of the ids.
    pub tint: Option<Arc<[Rgb]>>,
    /// The latest state that was measured.
    pub moment: Option<Box<Moment>>,
    /// Where on the bar the mouse or a key wants to go, steps; until it is there.
    pub wanted: Option<i64>,
    /// A turn was asked for and not yet heard of.
    pub turning: bool,
}

impl Stage {
    /// A scene at the place where it was opened. `beside`: whether the other arithmetic is played.
    #[must_use]
    pub fn new(mut opened: Box<Opened>, beside: bool, tint: Option<&Picture>) -> Self {
        let rows = std::mem::take(&mut opened.rows);
        let mut track = Track::of_rows(&rows);
        if track.out().is_empty() {
            track.push(opened.first.clone(), Arrow::Forward);
        }
        let home = Home::new(&opened.scene, &opened.home);
        let points = Points::from(&opened.home);
        Self {
            status: opened.status.clone(),
            ways: Ways::of(track, home.span),
            other: beside.then(|| Other {
                points: points.clone(),
                ..Other::default()
            }),
            points,
            tint: tint.map(|picture| picture.tint(&home).into()),
            moment: None,
            wanted: None,
            turning: false,
            home,
            opened,
        }
    }

    /// The direction of time as the user has it: a turn that was asked for is shown at once.
    #[must_use]
    pub fn arrow(&self) -> Arrow {
        if self.turning {
            self.status.arrow.turned()
        } else {
            self.status.arrow
        }
    }

    /// Steps that the time bar has room for.
    #[must_use]
    pub fn span(&self) -> i64 {
        let reached = self.status.farthest.max(self.status.position);
        self.opened.span.max(reached).max(1)
    }

    /// What the player in the other arithmetic says.
    pub fn hear(&mut self, beside: Beside) {
        let span = self.home.span;
        let Some(other) = &mut self.other else { return };
        match beside {
            Beside::Picture(points) => other.points = *points,
            Beside::Row { row, travel } => other.ways.push(*row, travel, span),
            Beside::Ended(fault) => other.ended = Some(fault),
        }
    }
}

/// A drag of the mouse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drag {
    /// On the bar, last at this step.
    Bar(i64),
    /// On the particles, last at this place, moving the view.
    Pan([f64; 2]),
    /// On the particles, last at this place, turning the view.
    Orbit([f64; 2]),
}

/// The state.
#[derive(Debug, Default)]
pub struct State {
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Pixels that make one of a plain display.
    pub scale: f64,
    /// Since the start of the program.
    pub now: Duration,
    /// What is open or being opened.
    pub request: Request,
    /// Number of the deck that is heard.
    pub deck: u64,
    /// The scene, once it is set up.
    pub stage: Option<Stage>,
    /// How it is drawn.
    pub look: Look,
    /// The picture to tint the fluid with.
    pub picture: Option<Picture>,
    /// What lies over the rest.
    pub overlay: Overlay,
    /// The start was reached: stays until a key.
    pub banner: Option<Box<Arrival>>,
    /// A line that stays for some seconds.
    pub notice: Option<Notice>,
    /// Where a drag was last.
    pub drag: Option<Drag>,
    /// What was kept last.
    pub kept: Option<Kept>,
    /// The program ends.
    pub leaving: bool,
}

impl State {
    /// The state of a window of this size that shows nothing yet.
    #[must_use]
    pub fn new(size: (usize, usize), scale: f64, look: Look, picture: Option<Picture>) -> Self {
        Self {
            size,
            scale,
            look,
            picture,
            ..Self::default()
        }
    }

    /// Whether something would be lost by leaving now.
    #[must_use]
    pub fn unsaved(&self) -> bool {
        let Some(stage) = &self.stage else {
            return false;
        };
        is_unsaved(&stage.status, self.kept.as_ref())
    }

    /// The words on the window's frame.
    #[must_use]
    pub fn title(&self) -> String {
        let Some(stage) = &self.stage else {
            return format!("{} · loschmidt", self.request.name);
        };
        let name = &stage.home.name;
        let what = match &self.banner {
            Some(arrival) if arrival.comparison.is_exact() => "bit-identical",
            Some(_) => "time did not come back",
            None if stage.status.seek.is_some() => "on the way",
            None if !stage.status.playing => "paused",
            None if stage.arrow() == Arrow::Backward => "backward",
            None => "forward",
        };
        format!("{name}: {what} · loschmidt")
    }
}
