//! The dashboard: a run on a terminal, in both directions of time.
//!
//! ```text
//! keys, mouse, deck --Message--> update --> State --> view --> Buffer
//!                                   \--Effect--> deck, files
//! ```
//!
//! [`update`] changes the state and asks for effects; it knows neither clock nor file. The views are
//! pure functions of the state. The simulation has a thread of its own, the runner's
//! [`Deck`]; another one waits for keys. This one only draws, at most 30 times a second, and
//! at once when a key was pressed.

mod keys;
mod message;
mod state;
mod terminal;
mod update;
mod view;

#[cfg(test)]
mod tests;

pub use state::Depth;
pub use terminal::is_terminal;

use crate::exit::{Failure, INTERRUPTED, OUTPUT, USAGE, quote, tell};
use loschmidt_runner::deck::{Command, FRAMES, Opening, OpeningError, Report};
use loschmidt_runner::output::free_directory;
use loschmidt_runner::{Deck, Options};
use loschmidt_viewer::face::{Kept, Request, new_picture};
use loschmidt_viewer::{Look, Pane, draw, png};
use message::{Effect, Message};
use state::State;
use std::io::BufWriter;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};
use terminal::Terminal;

/// Between two looks at the signals.
const LOOK_UP: Duration = Duration::from_millis(50);

/// A step is waited for so long when the state is kept at the end.
const PATIENCE: Duration = Duration::from_secs(60);

/// Size of a picture, pixels.
const PICTURE: (usize, usize) = (1920, 1080);

/// Opens the dashboard; returns when its user leaves.
pub fn run(request: Request, options: Options, stop: &AtomicBool) -> Result<ExitCode, Failure> {
    // What cannot be read is said on the terminal as it was.
    let opening = request.opening(options)?;
    let (sender, inbox) = channel();
    let mut terminal = Terminal::enter()?;
    let depth = Depth::of_environment(|name| std::env::var(name).ok());
    let mut face = Face {
        state: State::new(depth, terminal.size()?, request.clone()),
        options,
        deck: None,
        decks: 0,
        began: Instant::now(),
        sender,
    };
    face.open(request, opening);
    terminal.listen(face.sender.clone());
    let ended = face.play(&mut terminal, &inbox, stop);
    let interrupted = stop.load(Ordering::Relaxed);
    let kept = face.keep_at_the_end(&inbox);
    drop(terminal);
    drop(face);
    match kept {
        Ok(Some(path)) => tell(&format!(
            "go on from where you left it with\n    loschmidt tui {}",
            quote(&path)
        )),
        Ok(None) => {}
        Err(why) => {
            return Err(Failure::new(
                OUTPUT,
                format!("error: the state is lost: {why}"),
            ));
        }
    }
    match ended {
        Err(error) if !interrupted => Err(error.into()),
        _ if interrupted => Ok(ExitCode::from(INTERRUPTED)),
        _ => Ok(ExitCode::SUCCESS),
    }
}

impl From<OpeningError> for Failure {
    fn from(error: OpeningError) -> Self {
        match error {
            OpeningError::Scene(error) => error.into(),
            OpeningError::Run(error) => error.into(),
            OpeningError::Changed { .. } => Self::new(USAGE, format!("error: {error}")),
        }
    }
}

/// The dashboard and what it has at hand.
struct Face {
    state: State,
    options: Options,
    deck: Option<Deck>,
    /// Decks opened so far: the number of the last one.
    decks: u64,
    began: Instant,
    sender: Sender<Message>,
}

impl Face {
    /// Draws and listens until the user leaves or a signal comes.
    fn play(
        &mut self,
        terminal: &mut Terminal,
        inbox: &Receiver<Message>,
        stop: &AtomicBool,
    ) -> std::io::Result<()> {
        let pause = Duration::from_secs(1) / FRAMES;
        let mut drawn = Instant::now();
        let (mut urgent, mut waiting, mut picture) = (true, false, false);
        while !self.state.leaving && !stop.load(Ordering::Relaxed) {
            if urgent || (waiting && drawn.elapsed() >= pause) {
                drawn = Instant::now();
                terminal.draw(&self.state, self.deck.as_ref())?;
                (urgent, waiting) = (false, false);
                if let (true, Some(deck)) = (picture, &self.deck) {
                    deck.ready();
                    picture = false;
                }
            }
            let wait = if waiting {
                pause.saturating_sub(drawn.elapsed())
            } else {
                LOOK_UP
            };
            let mut next = match inbox.recv_timeout(wait) {
                Ok(message) => Some(message),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => return Ok(()),
            };
            let had_notice = self.state.notice.is_some();
            self.take(Message::Tick(self.began.elapsed()));
            urgent |= had_notice != self.state.notice.is_some();
            while let Some(message) = next {
                match &message {
                    Message::Report(_, report) => {
                        picture |= State::is_picture(report);
                        let calm = matches!(**report, Report::Moment(_) | Report::Shot(_));
                        urgent |= !calm;
                    }
                    _ => urgent = true,
                }
                waiting = true;
                self.take(message);
                next = inbox.try_recv().ok();
            }
        }
        Ok(())
    }

    /// Takes a message, and does what is asked for then.
    fn take(&mut self, message: Message) {
        for effect in update::update(&mut self.state, message) {
            self.carry_out(effect);
        }
    }

    fn carry_out(&mut self, effect: Effect) {
        match effect {
            Effect::Deck(command) => {
                if let Some(deck) = &self.deck {
                    deck.send(command);
                }
            }
            Effect::Open(request) => match request.opening(self.options) {
                Ok(opening) => self.open(request, opening),
                Err(why) => {
                    let why = why.to_string();
                    let why = why.strip_prefix("error: ").unwrap_or(&why).to_owned();
                    self.take(Message::NotOpened(why));
                }
            },
            Effect::List => self.take(Message::Choices(loschmidt_viewer::face::choices())),
            Effect::Picture => {
                let result = self.picture();
                self.take(Message::Pictured(result));
            }
            Effect::Keep => self.keep(),
            Effect::Quit => self.state.leaving = true,
        }
    }

    /// Opens what was asked for, in the place of what is open.
    fn open(&mut self, request: Request, opening: Opening) {
        // The old one ends first: two of them may not fit into memory.
        self.deck = None;
        self.decks += 1;
        let number = self.decks;
        let run = opening
            .recorded
            .as_ref()
            .map(|recorded| Kept::recorded(PathBuf::from(&request.name), recorded));
        self.take(Message::Opening(number, request));
        self.state.kept = run;
        let sender = self.sender.clone();
        let report = move |report| {
            // A face that has gone needs nothing.
            let _ = sender.send(Message::Report(number, Box::new(report)));
        };
        match Deck::open(opening, report) {
            Ok(deck) => self.deck = Some(deck),
            Err(why) => self.take(Message::NotOpened(format!("cannot start a thread: {why}"))),
        }
    }

    /// Writes a picture of what is shown, as large as a screen.
    fn picture(&self) -> Result<PathBuf, String> {
        let Some(stage) = &self.state.stage else {
            return Err("there is nothing to draw".to_owned());
        };
        let history = stage.track.history(stage.home.span);
        let panes = [Pane::new(&stage.points, &history)];
        let look = Look {
            panel: true,
            ..self.state.look.clone()
        };
        let raster = draw(&panes, &stage.home, &look, PICTURE.0, PICTURE.1);
        let name = format!(
            "{}-step-{:06}",
            stage.home.name,
            stage.status.position.max(0)
        );
        let (file, path) = new_picture(&name).map_err(|e| format!("no picture: {e}"))?;
        png::write(&raster, BufWriter::new(file))
            .map_err(|e| format!("cannot write {}: {e}", path.display()))?;
        Ok(path)
    }

    /// Has the state kept in a new directory: what was kept before stays as it was.
    fn keep(&mut self) {
        let (Some(stage), Some(deck)) = (&self.state.stage, &self.deck) else {
            return;
        };
        deck.send(Command::Keep {
            path: free_directory(&stage.home.name),
            rows: stage.track.rows(),
        });
    }

    /// Keeps what would be lost; the directory to go on from, where there is something to go on with.
    fn keep_at_the_end(&mut self, inbox: &Receiver<Message>) -> Result<Option<PathBuf>, String> {
        if let Some(deck) = &self.deck {
            deck.send(Command::Play(false));
        }
        self.settle(inbox);
        if self.state.unsaved() {
            self.keep();
            let end = Instant::now() + PATIENCE;
            loop {
                match inbox.recv_timeout(end.saturating_duration_since(Instant::now())) {
                    Ok(Message::Report(number, report)) if number == self.state.deck => {
                        match *report {
                            Report::Kept(path) => return Ok(Some(path)),
                            Report::NotKept(why) => return Err(why),
                            _ => {}
                        }
                    }
                    Ok(_) => {}
                    Err(_) => return Err("the simulation does not answer".to_owned()),
                }
            }
        }
        let somewhere = |stage: &state::Stage| stage.status.position != 0;
        let on_the_way = self.state.stage.as_ref().is_some_and(somewhere);
        let kept = self.state.kept.as_ref().filter(|_| on_the_way);
        Ok(kept.map(|kept| kept.path.clone()))
    }

    /// Hears the last reports, so that the state is the one that the simulation stands at.
    fn settle(&mut self, inbox: &Receiver<Message>) {
        let end = Instant::now() + PATIENCE;
        while self
            .state
            .stage
            .as_ref()
            .is_some_and(|s| s.status.playing || s.status.seek.is_some())
        {
            match inbox.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(Message::Report(number, report)) => {
                    update::update(&mut self.state, Message::Report(number, report));
                }
                Ok(_) => {}
                Err(_) => return,
            }
        }
    }
}
