//! What the dashboard is told.

use loschmidt_viewer::session::{Message, Mouse};

/// What the dashboard is told.
#[derive(Debug)]
pub enum DashboardMessage {
    /// What any face passes on to its session.
    Session(Message),
    /// The mouse, with the column and row that it is at.
    Mouse(Mouse, u16, u16),
    /// The terminal has this many columns and rows.
    Resized(u16, u16),
}

impl From<Message> for DashboardMessage {
    fn from(message: Message) -> Self {
        Self::Session(message)
    }
}
