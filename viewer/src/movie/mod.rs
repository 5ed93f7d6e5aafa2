//! The movie of a reversal: numbered pictures, evenly paced out and back.
//!
//! Of n pictures the i-th (0, …, n - 1) shows the run after round(i S/(n - 1)) of its S steps,
//! rounded in the first half and mirrored in the second, so that the way back shows the very places
//! in time that the way out showed: home first and home last.
//!
//! [`Movie::create`] opens a directory of pictures, new or one that was interrupted;
//! [`Movie::simulate`] or [`Movie::render`] fill it; [`gif::write`] and [`mp4::write`] make
//! one file of the pictures.

mod camera;
mod directory;
mod error;
pub mod gif;
pub mod mp4;
mod schedule;
mod simulate;
mod stored;
pub mod target;

pub use camera::CameraPath;
pub use directory::{Movie, MovieManifest, free_directory, picture_name};
pub use error::MovieError;
pub use schedule::Schedule;
pub use simulate::{Ending, Fate};
pub use stored::Stored;

use crate::colour::Rgb;
use crate::colouring::Colouring;
use crate::draw::Look;
use crate::picture::Picture;
use std::time::Duration;

/// What the pictures are to look like.
#[derive(Clone, Debug, PartialEq)]
pub struct MovieStyle {
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Pictures per second of the movie.
    pub fps: u32,
    /// Number of pictures, at least 2.
    pub pictures: usize,
    /// Camera, colours, theme.
    pub look: Look,
    /// A picture to be laid over the initial state, instead of the look's colouring.
    pub tint: Option<Picture>,
    /// Where the camera goes.
    pub camera: CameraPath,
}

impl Default for MovieStyle {
    /// 300 pictures of 1280 by 720 pixels, ten seconds long.
    fn default() -> Self {
        Self {
            size: (1280, 720),
            fps: 30,
            pictures: 300,
            look: Look::default(),
            tint: None,
            camera: CameraPath::default(),
        }
    }
}

impl MovieStyle {
    /// What the pixels depend on, besides the run.
    fn text(&self) -> String {
        let look = Look {
            // Of these the tint tells all.
            colouring: match (&self.tint, &self.look.colouring) {
                (Some(_), _) => Colouring::Speed,
                (None, colouring) => colouring.clone(),
            },
            ..self.look.clone()
        };
        let (tint, width) = self.tint.as_ref().map_or_else(Default::default, |picture| {
            let raster = picture.raster();
            (raster.rgb(), raster.width())
        });
        let digest = loschmidt_core::digest::hash(&tint);
        format!(
            "{:?} {} fps {} pictures {look:?} {:?} tint {width} {digest:?}",
            self.size, self.fps, self.pictures, self.camera
        )
    }

    /// The look of a run whose initial state is `home`: with the tint in it.
    fn look(&self, home: &crate::Home) -> Look {
        let mut look = self.look.clone();
        if let Some(picture) = &self.tint {
            let colours: Vec<Rgb> = picture.tint(home);
            look.colouring = Colouring::Picture(colours.into());
        }
        look
    }
}

/// How far an export has come; an observer is told after every picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MovieProgress {
    /// Pictures that are there.
    pub done: usize,
    /// Pictures of the whole movie.
    pub total: usize,
    /// Steps taken, of each run.
    pub step: u64,
    /// Steps of the whole run.
    pub steps: u64,
}

/// Where the time went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// Taking steps and measuring.
    pub simulating: Duration,
    /// Reading stored frames.
    pub reading: Duration,
    /// Turning frames into pixels.
    pub drawing: Duration,
    /// Compressing and writing.
    pub writing: Duration,
    /// Pictures drawn.
    pub pictures: u32,
}
