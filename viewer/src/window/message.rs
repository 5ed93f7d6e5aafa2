//! What the window is told.

use crate::session::{Message, Mouse};

/// What the window is told.
#[derive(Debug)]
pub enum WindowMessage {
    /// What any face passes on to its session.
    Session(Message),
    /// The mouse, and where it is, pixels from the top left.
    Mouse(Mouse, [f64; 2]),
    /// The window has this many pixels, and this many of them make one of a plain display.
    Resized(usize, usize, f64),
}

impl From<Message> for WindowMessage {
    fn from(message: Message) -> Self {
        Self::Session(message)
    }
}
