//! The state of a session: everything that its face shows, but for what is the face's own.

use super::kept::{Kept, is_unsaved};
use super::list::List;
use super::notice::{Notice, Tone};
use super::panel::Panel;
use super::pointer::Drag;
use super::request::Request;
use super::stage::StagedScene;
use crate::keys::{self, Action, Key};
use crate::look::Look;
use crate::picture::Picture;
use loschmidt_runner::deck::Arrival;
use loschmidt_runner::plain::visible;
use std::path::Path;
use std::time::Duration;

/// What shows a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// The dashboard on a terminal.
    Dashboard,
    /// The desktop window.
    Window,
}

impl Face {
    /// What a key does.
    #[must_use]
    pub fn action(self, key: Key) -> Option<Action> {
        match self {
            Self::Dashboard => keys::action(key),
            Self::Window => keys::window_action(key),
        }
    }

    /// What is told when the state was kept in a directory.
    pub(super) fn kept(self, path: &Path) -> String {
        let how = match self {
            Self::Dashboard => "open it again with  loschmidt tui",
            Self::Window => "open it with  loschmidt view",
        };
        format!("saved; {how} {}", path.display())
    }
}

/// What lies over the rest.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Overlay {
    /// Nothing.
    #[default]
    None,
    /// The keys.
    Help,
    /// What can be opened, and which is chosen.
    Scenes(List),
    /// The panel of parameters.
    Parameters(Box<Panel>),
    /// Nothing can be shown, and why.
    Error(String),
}

/// The state of a session.
#[derive(Debug)]
pub struct Session {
    /// What shows it.
    pub face: Face,
    /// Width and height of the first player's particles on the face, pixels: the face keeps it up
    /// to date.
    pub field: (usize, usize),
    /// Since the start of the program.
    pub now: Duration,
    /// What is open or being opened.
    pub request: Request,
    /// Number of the deck that is heard.
    pub deck: u64,
    /// The scene, once it is set up.
    pub stage: Option<StagedScene>,
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
    /// The user has done something to the scene: turned time, played or paused, stepped, gone
    /// somewhere, changed its state.
    pub acted: bool,
    /// The program ends.
    pub leaving: bool,
}

impl Session {
    /// A session that shows nothing yet.
    #[must_use]
    pub fn new(face: Face, look: Look) -> Self {
        Self {
            face,
            field: (0, 0),
            now: Duration::ZERO,
            request: Request::default(),
            deck: 0,
            stage: None,
            look,
            picture: None,
            overlay: Overlay::None,
            banner: None,
            notice: None,
            drag: None,
            kept: None,
            acted: false,
            leaving: false,
        }
    }

    /// Whether something would be lost by leaving now.
    #[must_use]
    pub fn unsaved(&self) -> bool {
        let stage = self.stage.as_ref();
        stage.is_some_and(|stage| is_unsaved(&stage.status, self.kept.as_ref()))
    }

    /// Tells the user something.
    pub(super) fn tell(&mut self, tone: Tone, text: impl Into<String>) {
        let text = text.into();
        self.notice = Some(Notice::new(tone, visible(&text), self.now));
    }
}
