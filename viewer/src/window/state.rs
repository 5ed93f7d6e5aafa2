//! The state of the window: a session, and what the desktop adds to it.

use crate::look::Look;
use crate::picture::Picture;
use crate::session::{Face, Session};
use loschmidt_runner::Arrow;

/// The state of the window.
#[derive(Debug)]
pub struct WindowState {
    /// What it shows.
    pub session: Session,
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Pixels that make one of a plain display.
    pub scale: f64,
}

impl WindowState {
    /// The state of a window of this size that shows nothing yet.
    #[must_use]
    pub fn new(size: (usize, usize), scale: f64, look: Look, picture: Option<Picture>) -> Self {
        let mut session = Session::new(Face::Window, look);
        session.picture = picture;
        Self {
            session,
            size,
            scale,
        }
    }

    /// The words on the window's frame.
    #[must_use]
    pub fn title(&self) -> String {
        let session = &self.session;
        let Some(stage) = &session.stage else {
            return format!("{} · loschmidt", session.request.name);
        };
        let name = &stage.home.name;
        let what = match &session.banner {
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
