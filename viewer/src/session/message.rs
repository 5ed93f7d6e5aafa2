//! What a session is told, and what it asks for.

use super::list::Choice;
use super::request::Request;
use crate::keys::Key;
use crate::picture::Picture;
use loschmidt_runner::deck::{Command, Report};
use std::path::PathBuf;
use std::time::Duration;

/// What a session is told.
#[derive(Debug)]
pub enum Message {
    /// A key was pressed.
    Key(Key),
    /// The deck has something to say; with the number of the deck, since reports of an earlier one
    /// may still be under way.
    Report(u64, Box<Report>),
    /// Time goes by, counted from the start of the program.
    Tick(Duration),
    /// What can be opened.
    Choices(Vec<Choice>),
    /// A picture was written, or not.
    Pictured(Result<PathBuf, String>),
    /// A picture to tint the fluid with was read, or not.
    Tint(Result<Picture, String>),
    /// A scene could not even be read.
    NotOpened(String),
    /// A deck with this number has begun to open what was asked for.
    Opening(u64, Request),
}

/// What a session asks for.
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
