//! Notices: what a user is told of what happened.

use super::state::Face;
use loschmidt_runner::deck::{Meddling, Perturbation};
use loschmidt_runner::figures::quantity;
use loschmidt_runner::{ArithmeticKind, Arrow};
use std::time::Duration;

/// How a notice is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// It was done.
    Done,
    /// It was done, and something must be known of it.
    Warning,
    /// It was not done.
    Refused,
}

/// A line that stays for some seconds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// How it is meant.
    pub tone: Tone,
    /// What it says.
    pub text: String,
    /// When it goes.
    pub until: Duration,
}

impl Notice {
    /// One that comes now.
    #[must_use]
    pub fn new(tone: Tone, text: impl Into<String>, now: Duration) -> Self {
        /// How long it stays.
        const STAYS: Duration = Duration::from_secs(6);
        Self {
            tone,
            text: text.into(),
            until: now + STAYS,
        }
    }
}

/// What is told when time was turned.
pub(super) fn turned(arrow: Arrow, arithmetic: ArithmeticKind) -> (Tone, &'static str) {
    match (arrow, arithmetic) {
        (Arrow::Backward, ArithmeticKind::Float) => (
            Tone::Warning,
            "time reversed, in floating point: these sums do not lead back home",
        ),
        (Arrow::Backward, ArithmeticKind::Fixed) => (
            Tone::Done,
            "time reversed: every velocity has changed its sign",
        ),
        (Arrow::Forward, _) => (Tone::Done, "time runs forward again"),
    }
}

/// What is told when the state was changed by hand. `quantum`: what a last bit is, m.
pub(super) fn meddled(meddling: &Meddling, quantum: f64, face: Face) -> String {
    match meddling.what {
        Perturbation::Flipped(particle) => {
            let aside = quantity(quantum, "m", 2);
            let mark = match face {
                Face::Dashboard => "✱ is ",
                Face::Window => "in the ring, ",
            };
            format!("{mark}particle {particle}: last bit flipped, it stands {aside} aside")
        }
        Perturbation::Switched(ArithmeticKind::Float) => {
            "floating point from here on: the same terms, their sums rounded".to_owned()
        }
        Perturbation::Switched(ArithmeticKind::Fixed) => "fixed point from here on".to_owned(),
    }
}
