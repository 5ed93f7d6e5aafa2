//! The viewer of Loschmidt: turns points into pixels, once, for files, window and terminal.
//!
//! ```text
//! Points + Home + Look --draw--> Raster -> PNG, GIF, MP4 | window | half-blocks of a terminal
//! ```
//!
//! 1. [`raster`]: the pixels. [`colour`]: colour maps and themes. [`text`]: the embedded font.
//! 2. [`home`]: what a picture needs to know of a scene besides its points. [`framing`]: the region
//!    that the view shows. [`camera`]: where a point of the scene is on the screen.
//! 3. [`colouring`]: what the colour of a particle says. [`picture`]: a picture laid over the
//!    initial state.
//! 4. [`field`](mod@field): the particles. [`ruler`]: the length scale. [`history`], [`plot`]: energy and entropy, on which the
//!    way back retraces the way out. [`draw`](mod@draw): all of it, with time, arrow and legend.
//! 5. [`movie`]: a run out and back as numbered pictures, GIF and MP4.
//! 6. [`session`]: a scene that a user watches and steers, whatever face shows it. [`keys`]: the
//!    one table of keys. [`track`]: the ways out and back while a user goes to and fro.
//! 7. `window`: the desktop window, a face of a session, if the feature of that name is on, as it
//!    is by default; the dashboard of `loschmidt tui` is the other face.
//!
//! A picture is a function of its arguments alone: the same pixels for any number of threads and on
//! every machine. Every thread owns the rows it draws, sums over particles are sums of whole
//! numbers or in the order of the ids, and of the functions beyond `+ - * / sqrt` only those of
//! `libm` are used.

#![forbid(unsafe_code)]

mod bands;
pub mod camera;
pub mod colour;
pub mod colouring;
mod deep;
pub mod draw;
pub mod field;
mod flat;
pub mod framing;
pub mod history;
pub mod home;
pub mod keys;
pub mod look;
pub mod movie;
pub mod picture;
pub mod plot;
pub mod png;
pub mod raster;
pub mod ruler;
pub mod session;
mod stamp;
pub mod text;
#[cfg(feature = "cli")]
pub mod theme_name;
pub mod track;
mod wide;
#[cfg(feature = "window")]
pub mod window;

pub use camera::{Projection, View};
pub use colour::{Colormap, Rgb, Theme};
pub use colouring::Colouring;
pub use draw::{Pane, draw, draw_on};
pub use field::field;
pub use history::{History, HistoryPoint};
pub use home::Home;
pub use keys::{Action, Key};
pub use look::Look;
pub use picture::Picture;
pub use raster::{Pixels, Raster, Rect};
pub use track::Track;
