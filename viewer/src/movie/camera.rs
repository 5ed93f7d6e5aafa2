//! Where the camera of a movie is.

use super::Schedule;
use super::directory::{Movie, replace};
use super::error::MovieError;
use crate::home::{Box3, Home};
use crate::look::Look;
use loschmidt_runner::Points;
use std::fs;
use std::io::Write;

/// Where the camera of a movie is, besides the view of its look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraPath {
    /// The rectangle of the plane that is shown, m: left, bottom, right, top. Without one the view
    /// follows the fluid.
    pub rectangle: Option<[f64; 4]>,
    /// In space, the camera goes once around the scene.
    pub orbit: bool,
}

impl CameraPath {
    /// The look of a picture.
    pub(super) fn look(&self, look: &Look, picture: usize, pictures: usize) -> Look {
        let part = picture as f64 / pictures.saturating_sub(1).max(1) as f64;
        let turn = if self.orbit {
            std::f64::consts::TAU * part
        } else {
            0.0
        };
        Look {
            view: look.view.orbited(turn, 0.0),
            ..look.clone()
        }
    }
}

/// The views of the pictures of a run that is simulated for them: they grow with the fluid, and on
/// the way back the same ones come in reverse, so that the last picture is the first.
pub(super) struct Views {
    follows: bool,
    mirrored: bool,
    shown: Vec<Box3>,
}

impl Views {
    pub fn new(path: &CameraPath, mirrored: bool) -> Self {
        Self {
            follows: path.rectangle.is_none(),
            mirrored,
            shown: Vec::new(),
        }
    }

    /// Sets the view for the next picture, of these states.
    pub fn next<'a>(
        &mut self,
        home: &mut Home,
        schedule: &Schedule,
        states: impl Iterator<Item = &'a Points>,
    ) {
        let picture = self.shown.len();
        let mirror = (schedule.pictures - 1).checked_sub(picture);
        let before = mirror.filter(|&n| self.mirrored && n < picture);
        if let Some(shown) = before.and_then(|n| self.shown.get(n)) {
            home.shown = *shown;
        }
        if self.follows {
            home.follow(states);
        }
        self.shown.push(home.shown);
    }

    /// Writes the views so far, to the last bit.
    pub fn write(&self, movie: &Movie) -> Result<(), MovieError> {
        replace(&movie.views_path(), |file| {
            self.shown.iter().try_for_each(|box3| {
                let sides = box3.low.iter().chain(&box3.high);
                let sides: Vec<String> = sides.map(|x| format!("{x:?}")).collect();
                writeln!(file, "{}", sides.join(","))
            })
        })
    }

    /// Reads the views of so many pictures; false where they are not there.
    pub fn read(&mut self, home: &mut Home, movie: &Movie, pictures: usize) -> bool {
        let text = fs::read_to_string(movie.views_path()).unwrap_or_default();
        let shown: Option<Vec<Box3>> = text.lines().take(pictures).map(read_box).collect();
        match shown {
            Some(shown) if shown.len() == pictures => {
                home.shown = shown.last().copied().unwrap_or(home.shown);
                self.shown = shown;
                true
            }
            _ => false,
        }
    }
}

fn read_box(line: &str) -> Option<Box3> {
    let mut sides = line.split(',').map(|side| side.parse::<f64>().ok());
    let mut three = || Some([sides.next()??, sides.next()??, sides.next()??]);
    Some(Box3 {
        low: three()?,
        high: three()?,
    })
}
