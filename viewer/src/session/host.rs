//! What carries out the effects of a session: the deck that plays its scene, and its files.

use super::kept::Kept;
use super::list::choices;
use super::message::{Effect, Message};
use super::request::Request;
use super::state::Session;
use super::update::update;
use loschmidt_runner::deck::{Command, Opening, Report, Wishes};
use loschmidt_runner::output::free_directory_in;
use loschmidt_runner::{Deck, Options};
use std::fs::File;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use thiserror::Error;

/// How long the simulation is waited for at the end.
const PATIENCE: Duration = Duration::from_secs(60);

/// Why the state is lost at the end.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum LostState {
    /// It could not be written.
    #[error("{0}")]
    NotWritten(String),
    /// A step takes too long, or the simulation has ended.
    #[error("the simulation does not answer")]
    Silent,
}

/// The deck of a session.
pub struct Host {
    options: Options,
    /// Pictures a second that are asked for.
    frames: u32,
    deck: Option<Deck>,
    /// Decks opened so far: the number of the last one.
    opened: u64,
}

impl Host {
    /// Without a deck yet. `frames`: pictures a second at most.
    #[must_use]
    pub fn new(options: Options, frames: u32) -> Self {
        Self {
            options,
            frames,
            deck: None,
            opened: 0,
        }
    }

    /// The deck of the scene that is open.
    #[must_use]
    pub fn deck(&self) -> Option<&Deck> {
        self.deck.as_ref()
    }

    /// Opens what was asked for, in the place of what is open. `report` is called with the number
    /// of the deck, from a thread of its own.
    pub fn open(
        &mut self,
        session: &mut Session,
        request: Request,
        opening: Opening,
        report: impl Fn(u64, Report) + Send + 'static,
    ) {
        // The old one ends first: two of them may not fit into memory.
        self.deck = None;
        self.opened += 1;
        let number = self.opened;
        let recorded = opening.recorded.as_ref();
        let kept = recorded.map(|it| Kept::recorded(PathBuf::from(&request.name), it));
        let wishes = Wishes {
            frames: self.frames,
            beside: request.beside,
        };
        update(session, Message::Opening(number, request));
        session.kept = kept;
        match Deck::open_with(opening, wishes, move |it| report(number, it)) {
            Ok(deck) => self.deck = Some(deck),
            Err(why) => {
                let why = format!("cannot start a thread: {why}");
                update(session, Message::NotOpened(why));
            }
        }
    }

    /// Does what a session asks for, but for a picture, which its face makes.
    pub fn carry_out(
        &mut self,
        session: &mut Session,
        effect: Effect,
        report: impl Fn(u64, Report) + Send + 'static,
    ) {
        match effect {
            Effect::Deck(command) => self.obey(session, command),
            Effect::Open(request) => match request.opening(self.options) {
                Ok(opening) => self.open(session, request, opening, report),
                Err(why) => {
                    let why = why.to_string();
                    let why = why.strip_prefix("error: ").unwrap_or(&why).to_owned();
                    update(session, Message::NotOpened(why));
                }
            },
            Effect::List => {
                update(session, Message::Choices(choices()));
            }
            Effect::Picture => {}
            Effect::Keep => self.keep(session),
            Effect::Quit => session.leaving = true,
        }
    }

    /// Passes on what the user wants.
    fn obey(&self, session: &mut Session, command: Command) {
        session.acted |= !matches!(command, Command::Pace(_) | Command::Reuse(_));
        self.send(command);
    }

    fn send(&self, command: Command) {
        if let Some(deck) = &self.deck {
            deck.send(command);
        }
    }

    /// Has the state kept in a new directory: what was kept before stays as it was.
    fn keep(&self, session: &Session) {
        self.keep_below(session, Path::new(""));
    }

    /// The same, in this folder.
    fn keep_below(&self, session: &Session, folder: &Path) {
        if let Some(stage) = &session.stage {
            self.send(Command::Keep {
                path: free_directory_in(folder, &stage.home.name),
                rows: stage.track.rows(),
            });
        }
    }

    /// Keeps what would be lost; the directory to go on from, where there is something to go on
    /// with. Who has only watched loses nothing by leaving; where the program is `cut_short`, by a
    /// signal or a defect, nobody knows what was meant, and the state is kept all the same. Where the
    /// present folder cannot be written to, that is in one for temporary files. `next`: the next
    /// report of the present deck, waited for until then. A deck that is still setting up its scene is
    /// left alone, and ends with the program.
    ///
    /// # Errors
    /// The state is lost.
    pub fn keep_at_the_end(
        &mut self,
        session: &mut Session,
        cut_short: bool,
        mut next: impl FnMut(Instant) -> Option<Report>,
    ) -> Result<Option<PathBuf>, LostState> {
        self.send(Command::Play(false));
        settle(session, &mut next);
        if session.stage.is_none()
            && let Some(deck) = self.deck.take()
        {
            deck.leave();
        }
        if session.unsaved() && (session.acted || cut_short) {
            self.keep(session);
            return match heard_of_keeping(&mut next) {
                Err(LostState::NotWritten(_)) => {
                    self.keep_below(session, &std::env::temp_dir());
                    heard_of_keeping(&mut next).map(Some)
                }
                other => other.map(Some),
            };
        }
        let stage = session.stage.as_ref();
        let on_the_way = stage.is_some_and(|stage| stage.status.position != 0);
        let kept = session.kept.as_ref().filter(|_| on_the_way);
        Ok(kept.map(|kept| kept.path.clone()))
    }
}

/// Waits until a state is kept.
fn heard_of_keeping(
    next: &mut impl FnMut(Instant) -> Option<Report>,
) -> Result<PathBuf, LostState> {
    let end = Instant::now() + PATIENCE;
    loop {
        match next(end) {
            Some(Report::Kept(path)) => return Ok(path),
            Some(Report::NotKept(why)) => return Err(LostState::NotWritten(why)),
            Some(_) => {}
            None => return Err(LostState::Silent),
        }
    }
}

/// Hears the last reports, so that the session is where the simulation stands.
fn settle(session: &mut Session, next: &mut impl FnMut(Instant) -> Option<Report>) {
    let end = Instant::now() + PATIENCE;
    let moves = |session: &Session| {
        let stage = session.stage.as_ref();
        stage.is_some_and(|it| it.status.playing || it.status.seek.is_some())
    };
    while moves(session) {
        let Some(report) = next(end) else { return };
        let number = session.deck;
        update(session, Message::Report(number, Box::new(report)));
    }
}

/// A new PNG file of this name in the present directory, with a number where there is one already.
///
/// # Errors
/// It cannot be created.
pub fn new_picture(name: &str) -> std::io::Result<(File, PathBuf)> {
    let mut number = 1;
    loop {
        let path = match number {
            1 => PathBuf::from(format!("{name}.png")),
            n => PathBuf::from(format!("{name}-{n}.png")),
        };
        match File::create_new(&path) {
            Ok(file) => return Ok((file, path)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error),
        }
    }
}
