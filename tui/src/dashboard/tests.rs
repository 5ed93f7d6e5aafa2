//! The dashboard without a terminal: a real deck, the real update and the real views on buffers.

mod keys_and_pictures;
mod screens;
mod speed;
mod widgets;

use super::message::DashboardMessage;
use super::state::{DashboardState, Depth};
use super::update::update;
use loschmidt_runner::deck::{Command, Opening, Report};
use loschmidt_runner::{Deck, Options};
use loschmidt_viewer::Key;
use loschmidt_viewer::session::{Effect, Message, Request};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// A dashboard at work.
pub struct Bench {
    pub state: DashboardState,
    deck: Deck,
    inbox: Receiver<Report>,
}

impl Bench {
    /// A scene of the catalogue, set up.
    pub fn open(name: &str, set: &[&str], size: (u16, u16)) -> Self {
        let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
        let mut opening = Opening::of(name, &set, Options::default()).expect("a scene");
        // Nothing moves unless a test says so.
        opening.pace = Some(1e-9);
        let (sender, inbox) = channel();
        let deck = Deck::open(opening, move |report| drop(sender.send(report))).expect("a thread");
        let request = Request {
            name: name.to_owned(),
            set,
            threads: None,
            beside: false,
        };
        let mut bench = Self {
            state: DashboardState::new(Depth::True, size),
            deck,
            inbox,
        };
        bench.tell(Message::Opening(1, request));
        bench.until(|report| matches!(report, Report::Shot(_)));
        bench
    }

    pub fn tell(&mut self, message: impl Into<DashboardMessage>) -> Vec<Effect> {
        let effects = update(&mut self.state, message);
        for effect in &effects {
            if let Effect::Deck(command) = effect {
                self.deck.send(command.clone());
            }
        }
        effects
    }

    pub fn key(&mut self, key: Key) -> Vec<Effect> {
        self.tell(Message::Key(key))
    }

    /// Hears reports up to one that is awaited.
    pub fn until(&mut self, awaited: impl Fn(&Report) -> bool) {
        loop {
            let report = self
                .inbox
                .recv_timeout(Duration::from_secs(120))
                .expect("a report");
            let found = awaited(&report);
            if matches!(report, Report::Shot(_)) {
                self.deck.ready();
            }
            self.tell(Message::Report(1, Box::new(report)));
            if found {
                return;
            }
        }
    }

    /// Goes to a step and hears of it, its picture included.
    pub fn seek(&mut self, target: i64) {
        self.deck.send(Command::Seek(target));
        self.until(|report| matches!(report, Report::SeekEnded(true)));
        self.shot_at(target);
    }

    /// Hears reports up to the picture of this step, standing.
    pub fn shot_at(&mut self, step: i64) {
        self.until(|report| {
            matches!(report, Report::Shot(shot)
                if shot.status.position == step && shot.status.seek.is_none())
        });
    }

    pub fn screen(&self) -> Buffer {
        screen(&self.state)
    }
}

/// What the terminal shows.
pub fn screen(state: &DashboardState) -> Buffer {
    let area = Rect::new(0, 0, state.size.0, state.size.1);
    let mut buffer = Buffer::empty(area);
    state.render(area, &mut buffer);
    buffer
}

/// The characters of a buffer, line by line.
pub fn text(buffer: &Buffer) -> String {
    let area = buffer.area;
    let mut text = String::new();
    for y in area.top()..area.bottom() {
        let line: String = (area.left()..area.right())
            .map(|x| buffer[(x, y)].symbol())
            .collect();
        text += line.trim_end();
        text.push('\n');
    }
    text
}
