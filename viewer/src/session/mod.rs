//! A session: a scene that a user watches and steers, whatever face shows it.
//!
//! ```text
//! keys, deck --Message--> update --> Session --> drawn by the face
//!                            \--Effect--> deck, files
//! ```
//!
//! Dashboard and window are two faces of the same session. A face draws, and turns events of its
//! terminal or desktop into messages; what those lead to is decided here, once. [`update`] changes
//! the state and asks for effects: it knows neither clock nor file nor screen. [`Host`] carries the
//! effects out that need the simulation.

mod guard;
mod host;
mod kept;
mod list;
mod message;
mod notice;
mod panel;
mod pointer;
mod request;
mod stage;
mod state;
mod update;
mod view;
mod words;

pub use guard::{DEFECT, Defect, guarded};
pub use host::{Host, LostState, new_picture};
pub use kept::Kept;
pub use list::{Choice, List, choices};
pub use loschmidt_runner::figures::count;
pub use message::{Effect, Message};
pub use notice::{Notice, Tone};
pub use panel::Panel;
pub use pointer::{Button, Drag, Mouse};
pub use request::{Answer, MOST_THREADS, Request};
pub use stage::{OtherPlayer, StagedScene};
pub use state::{Face, Overlay, Session};
pub use update::update;
pub use words::because;
