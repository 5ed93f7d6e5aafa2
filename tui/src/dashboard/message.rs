//! What the dashboard is told, and what it asks for.

use loschmidt_runner::deck::{Command, Report};
use loschmidt_viewer::Key;
use loschmidt_viewer::face::{Choice, Request};
use std::path::PathBuf;
use std::time::Duration;

/// What the dashboard is told.
#[derive(Debug)]
pub enum Message {
    /// A key was pressed.
    Key(Key),
    /// The mouse, with the cell that it is at.
    Mouse(Mouse, u16, u16),
    /// The terminal has this many columns and rows.
    Resized(u16, u16),
    /// The deck has something to say; with the number of the deck, since reports of an earlier one
    /// may still be under way.
    Report(u64, Box<Report>),
    /// Time goes by, counted from the start of the program.
    Tick(Duration),
    /// What can be opened.
    Choices(Vec<Choice>),
    /// A picture was written, or not.
    Pictured(Result<PathBuf, String>),
    /// A scene could not even be read.
    NotOpened(String),
    /// A deck with this number has begun to open what was asked for.
    Opening(u64, Request),
}

/// What the mouse did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mouse {
    /// The left button went down.
    Press,
    /// The left button is held.
    Drag,
    /// The left button went up.
    Release,
    /// The right button went down.
    PressRight,
    /// The right button is held.
    DragRight,
    /// The wheel.
    WheelUp,
    /// The wheel.
    WheelDown,
}

/// What the dashboard asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// To tell the deck.
    Deck(Command),
    /// To open this in the place of what is open.
    Open(Request),
    /// To look for what can be opened: answered by [`Message::Choices`].
    List,
    /// To write a picture: answered by [`Message::Pictured`].
    Picture,
    /// To keep the state.
    Keep,
    /// To leave.
    Quit,
}
