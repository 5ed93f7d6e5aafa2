//! What is said between a face and its deck.

use crate::frame::Frame;
use crate::player::{Arrow, PlayerError, Return};
use crate::points::Points;
use crate::ranged_fault::RangedFault;
use crate::run::Row;
use crate::saved::ArithmeticKind;
use crate::scene::Scene;
use crate::simulation::{BuildError, Options};
use loschmidt_core::observe::SpeedHistogram;
use loschmidt_core::{Digest, Reversibility};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use thiserror::Error;

/// What a user wants.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// To play, or to pause.
    Play(bool),
    /// To turn time round.
    Turn,
    /// To go so many steps along physical time, and pause there; back where negative.
    StepBy(i64),
    /// To go to this many steps from home, as fast as it goes, and to pause there.
    Seek(i64),
    /// To break off a seek where it is.
    Cancel,
    /// This pace, simulated s per s.
    Pace(f64),
    /// To flip the last bit of the first coordinate of this particle.
    Flip(u64),
    /// To go on in this arithmetic.
    Switch(ArithmeticKind),
    /// To leave the state in this directory, from which it can be opened again; with these rows as
    /// its series. It is created, or written anew if this deck has created it.
    Keep {
        /// Directory of a run.
        path: PathBuf,
        /// Rows in the order of their steps.
        rows: Vec<Row>,
    },
    /// A picture that is no longer shown: the next one may be made in its memory.
    Reuse(Box<Points>),
}

/// What happened.
#[derive(Debug)]
pub enum Report {
    /// The scene is set up, and plays.
    Opened(Box<Opened>),
    /// It cannot be set up; the deck has ended.
    Failed(String),
    /// A new picture, with the status that belongs to it; its state was measured before.
    Shot(Box<Shot>),
    /// The status after a command.
    Status(Status),
    /// The state was measured.
    Moment(Box<Moment>),
    /// Time was turned.
    Turned(Arrow),
    /// The state was changed by hand.
    Meddled(Meddling),
    /// The start was reached from later.
    Arrived(Box<Arrival>),
    /// A seek has ended; `false` where it was cancelled.
    SeekEnded(bool),
    /// A command was not carried out.
    Refused(Refusal),
    /// The numbers ended; the state is the last one that was measured before.
    Fault(RangedFault),
    /// The state is in this directory.
    Kept(PathBuf),
    /// It could not be written.
    NotKept(String),
    /// The player in the other arithmetic has something to say, before the report that it belongs
    /// to.
    Beside(Beside),
}

/// What the player in the other arithmetic says.
#[derive(Clone, Debug)]
pub enum Beside {
    /// Its particles.
    Picture(Box<Points>),
    /// Its energies and entropy, measured with those of the first.
    Row {
        /// The row.
        row: Box<Row>,
        /// The direction in which this state was reached.
        travel: Arrow,
    },
    /// Its numbers ended; it says nothing more.
    Ended(RangedFault),
}

/// A scene that was set up.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The scene.
    pub scene: Scene,
    /// How it is run.
    pub options: Options,
    /// Its first frame, at home.
    pub home: Frame,
    /// Its first row.
    pub first: Row,
    /// The digest at home.
    pub digest: Digest,
    /// What turning round can promise.
    pub reversibility: Reversibility,
    /// The smallest difference of two coordinates, m.
    pub length_quantum: f64,
    /// Steps to the turnaround, or to the end of a one-way run.
    pub span: i64,
    /// Steps between rows: those of the run's series, or fewer where these are few.
    pub row_every: i64,
    /// Rows of the run that was opened, in the order of its steps.
    pub rows: Vec<Row>,
    /// Where everything is at the beginning.
    pub status: Status,
}

/// Where everything is.
#[derive(Clone, Debug, PartialEq)]
pub struct Status {
    /// Steps from home along physical time.
    pub position: i64,
    /// The largest so far.
    pub farthest: i64,
    /// Physical time, s.
    pub time: f64,
    /// Direction of motion.
    pub arrow: Arrow,
    /// Whether time runs (or would, did it not stand at the start).
    pub playing: bool,
    /// Time has been turned and the start reached: there is nowhere to go.
    pub at_start: bool,
    /// A seek under way.
    pub seek: Option<Seek>,
    /// The pace asked for, simulated s per s.
    pub pace: f64,
    /// Steps per second, lately; 0 when time stands still.
    pub steps_per_second: f64,
    /// Whether the machine keeps up with the pace.
    pub keeps_up: bool,
    /// Numbers of the state.
    pub arithmetic: ArithmeticKind,
    /// What was done to the state by hand, in its order.
    pub meddling: Vec<Meddling>,
    /// Particles that are not, to the last bit, where they were on the way out; `None` on the way
    /// out and where nothing is known of it.
    pub astray: Option<usize>,
}

/// A seek under way, in steps from home.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seek {
    /// Where it began.
    pub from: i64,
    /// Where it leads.
    pub target: i64,
}

/// A picture.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The particles.
    pub points: Points,
    /// Where everything is.
    pub status: Status,
}

/// A state that was measured.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Energies, momenta, entropy.
    pub row: Row,
    /// Speeds.
    pub histogram: SpeedHistogram,
    /// The direction in which this state was reached, whatever the arrow: a seek goes back with
    /// time not turned.
    pub travel: Arrow,
    /// Whether it is one of the states of the series, at multiples of its interval.
    pub regular: bool,
}

/// A change of the state by hand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Meddling {
    /// What was done.
    pub what: Perturbation,
    /// Steps from home.
    pub position: i64,
    /// Physical time, s.
    pub time: f64,
}

/// What was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Perturbation {
    /// The last bit of the first coordinate of this particle was flipped.
    Flipped(u64),
    /// The state goes on in this arithmetic.
    Switched(ArithmeticKind),
}

/// The state back at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// How it differs from home.
    pub comparison: Return,
    /// The farthest it had been, steps.
    pub farthest: i64,
    /// The same in physical time, s.
    pub farthest_time: f64,
    /// What was done to it by hand.
    pub meddling: Vec<Meddling>,
    /// Numbers of the state.
    pub arithmetic: ArithmeticKind,
}

/// Why a command was not carried out.
#[derive(Debug, Error)]
pub enum Refusal {
    /// There is no way back.
    #[error(transparent)]
    Player(#[from] PlayerError),
    /// There is nothing before it.
    #[error("this is the start: there is nothing before it")]
    Start,
    /// The state cannot be had in the other arithmetic.
    #[error(transparent)]
    Build(#[from] BuildError),
}
