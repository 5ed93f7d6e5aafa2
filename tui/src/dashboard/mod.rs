//! The dashboard: a run on a terminal, in both directions of time.
//!
//! ```text
//! keys, mouse, deck --DashboardMessage--> update --> DashboardState --> view --> Buffer
//!                                            \--Effect--> deck, files
//! ```
//!
//! The dashboard is a face of a session of the viewer: [`update`] adds what the mouse does and the
//! help that is longer than the screen. The views are pure functions of the state. The simulation
//! has a thread of its own, the runner's `Deck`; another one waits for keys. This one only draws,
//! at most 30 times a second, and at once when a key was pressed.

mod keys;
mod message;
mod state;
mod suspension;
mod terminal;
mod update;
mod view;

#[cfg(test)]
mod tests;

pub use state::Depth;
pub use terminal::is_terminal;

use crate::exit::{Failure, INTERRUPTED, OUTPUT, USAGE, tell};
use crate::stop::Stop;
use loschmidt_runner::Options;
use loschmidt_runner::deck::{FRAMES, Opening, OpeningError, Report};
use loschmidt_runner::plain::quote;
use loschmidt_viewer::session::{
    DEFECT, Effect, Host, LostState, Message, Request, guarded, new_picture,
};
use loschmidt_viewer::{Look, Pane, draw, png};
use message::DashboardMessage;
use state::DashboardState;
use std::io::BufWriter;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};
use suspension::Suspension;
use terminal::Terminal;

/// How often the signals are looked at.
const LOOK_UP: Duration = Duration::from_millis(50);

/// Size of a picture, pixels.
const PICTURE: (usize, usize) = (1920, 1080);

/// Opens the dashboard; returns when its user leaves.
pub fn run(request: Request, options: Options, stop: &Stop) -> Result<ExitCode, Failure> {
    // An error in the scene is told before the dashboard takes the terminal.
    let opening = request.opening(options)?;
    stop.wait_for_steps();
    let stop = stop.asked();
    let (sender, inbox) = channel();
    let mut terminal = Terminal::enter()?;
    let depth = Depth::of_environment(|name| std::env::var(name).ok());
    let mut dashboard = Dashboard {
        state: DashboardState::new(depth, terminal.size()?),
        host: Host::new(options, FRAMES),
        began: Instant::now(),
        sender,
    };
    dashboard.open(request, opening);
    terminal.listen(dashboard.sender.clone());
    let ended = guarded(|| dashboard.play(&mut terminal, &inbox, stop));
    let interrupted = stop.load(Ordering::Relaxed);
    let cut_short = interrupted || !matches!(ended, Ok(Ok(())));
    let kept = dashboard.keep_at_the_end(&inbox, cut_short);
    drop(terminal);
    drop(dashboard);
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
        Err(defect) => Err(Failure::new(DEFECT, format!("error: {defect}"))),
        Ok(Err(error)) if !interrupted => Err(error.into()),
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
struct Dashboard {
    state: DashboardState,
    host: Host,
    began: Instant,
    sender: Sender<DashboardMessage>,
}

impl Dashboard {
    /// Draws and listens until the user leaves or a signal comes.
    fn play(
        &mut self,
        terminal: &mut Terminal,
        inbox: &Receiver<DashboardMessage>,
        stop: &AtomicBool,
    ) -> std::io::Result<()> {
        let pause = Duration::from_secs(1) / FRAMES;
        let mut drawn = Instant::now();
        let (mut urgent, mut waiting, mut picture) = (true, false, false);
        let suspension = Suspension::new()?;
        while !self.state.session.leaving && !stop.load(Ordering::Relaxed) {
            if suspension.obey(terminal::restore)? {
                terminal.retake()?;
                // Its size may be another.
                let (columns, rows) = terminal.size()?;
                self.take(DashboardMessage::Resized(columns, rows));
                urgent = true;
            }
            if urgent || (waiting && drawn.elapsed() >= pause) {
                drawn = Instant::now();
                terminal.draw(&self.state, self.host.deck())?;
                (urgent, waiting) = (false, false);
                if let (true, Some(deck)) = (picture, self.host.deck()) {
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
            let had_notice = self.state.session.notice.is_some();
            self.take(Message::Tick(self.began.elapsed()));
            urgent |= had_notice != self.state.session.notice.is_some();
            while let Some(message) = next {
                match &message {
                    DashboardMessage::Session(Message::Report(_, report)) => {
                        picture |= matches!(**report, Report::Shot(_));
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
    fn take(&mut self, message: impl Into<DashboardMessage>) {
        for effect in update::update(&mut self.state, message) {
            if effect == Effect::Picture {
                let result = self.picture();
                self.take(Message::Pictured(result));
            } else {
                let report = self.reporter();
                self.host.carry_out(&mut self.state.session, effect, report);
            }
        }
    }

    /// Opens what was asked for.
    fn open(&mut self, request: Request, opening: Opening) {
        let report = self.reporter();
        self.host
            .open(&mut self.state.session, request, opening, report);
    }

    /// What passes the reports of a deck on, with its number.
    fn reporter(&self) -> impl Fn(u64, Report) + Send + use<> {
        let sender = self.sender.clone();
        move |number, report| {
            // Once the dashboard has ended nobody reads reports.
            let _ = sender.send(Message::Report(number, Box::new(report)).into());
        }
    }

    /// Writes a picture of what is shown, as large as a screen.
    fn picture(&self) -> Result<PathBuf, String> {
        let Some(stage) = &self.state.session.stage else {
            return Err("there is nothing to draw".to_owned());
        };
        let panes = [Pane::new(&stage.points, stage.track.history())];
        let look = Look {
            panel: true,
            ..self.state.session.look.clone()
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

    /// Keeps what would be lost; the directory to go on from, where there is something to go on
    /// with.
    fn keep_at_the_end(
        &mut self,
        inbox: &Receiver<DashboardMessage>,
        cut_short: bool,
    ) -> Result<Option<PathBuf>, LostState> {
        let present = self.state.session.deck;
        let next = |end: Instant| loop {
            let wait = end.saturating_duration_since(Instant::now());
            if let DashboardMessage::Session(Message::Report(number, report)) =
                inbox.recv_timeout(wait).ok()?
                && number == present
            {
                return Some(*report);
            }
        };
        let session = &mut self.state.session;
        self.host.keep_at_the_end(session, cut_short, next)
    }
}
