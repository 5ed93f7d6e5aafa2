//! A scene that is set up, and what is known of how it goes.

use crate::colour::Rgb;
use crate::home::Home;
use crate::picture::Picture;
use crate::track::Track;
use loschmidt_runner::deck::{Beside, Moment, Opened, Perturbation, Status};
use loschmidt_runner::run::Row;
use loschmidt_runner::{Arrow, Points};
use std::sync::Arc;

/// The player in the other arithmetic.
#[derive(Clone, Debug, Default)]
pub struct OtherPlayer {
    /// Its particles.
    pub points: Points,
    /// Its energies and entropies.
    pub track: Track,
}

/// A scene that is set up and shown.
#[derive(Debug)]
pub struct StagedScene {
    /// What the deck said when it was opened.
    pub opened: Box<Opened>,
    /// What stays the same in all pictures.
    pub home: Home,
    /// The particles.
    pub points: Points,
    /// Where everything is.
    pub status: Status,
    /// Energies and entropies of both ways.
    pub track: Track,
    /// The other arithmetic, where it is played too.
    pub other: Option<OtherPlayer>,
    /// The colours of the particles from a picture, in the order of the ids.
    pub tint: Option<Arc<[Rgb]>>,
    /// The latest state that was measured.
    pub moment: Option<Box<Moment>>,
    /// Where on the bar the mouse or a key wants to go, steps; until the deck says that it goes
    /// there.
    pub wanted: Option<i64>,
    /// A turn was asked for and not yet heard of.
    pub turning: bool,
}

impl StagedScene {
    /// A scene at the place where it was opened. `beside`: whether the other arithmetic is played.
    #[must_use]
    pub fn new(mut opened: Box<Opened>, beside: bool, tint: Option<&Picture>) -> Self {
        let home = Home::new(&opened.scene, &opened.home);
        let rows = std::mem::take(&mut opened.rows);
        let mut track = Track::of_rows(&rows, home.span);
        if track.out().is_empty() {
            track.push(opened.first.clone(), Arrow::Forward);
        }
        let points = Points::from(&opened.home);
        Self {
            status: opened.status.clone(),
            track,
            other: beside.then(|| OtherPlayer {
                points: points.clone(),
                track: Track::new(home.span),
            }),
            points,
            tint: tint.map(|picture| picture.tint(&home).into()),
            moment: None,
            wanted: None,
            turning: false,
            home,
            opened,
        }
    }

    /// The direction of time as the user has it: a turn that was asked for is shown at once.
    #[must_use]
    pub fn arrow(&self) -> Arrow {
        if self.turning {
            self.status.arrow.turned()
        } else {
            self.status.arrow
        }
    }

    /// Steps that the time bar has room for.
    #[must_use]
    pub fn span(&self) -> i64 {
        let reached = self.status.farthest.max(self.status.position);
        self.opened.span.max(reached).max(1)
    }

    /// The row of the latest state that was measured.
    #[must_use]
    pub fn row(&self) -> &Row {
        self.moment
            .as_ref()
            .map_or(&self.opened.first, |moment| &moment.row)
    }

    /// Gravitational energy at the start less its lowest value so far, J.
    #[must_use]
    pub fn released(&self) -> f64 {
        let start = self.opened.first.energy("gravitational");
        let rows = self.track.out().iter().chain(self.track.back());
        let lowest = rows.fold(start, |low, row| low.min(row.energy("gravitational")));
        start - lowest.min(self.row().energy("gravitational"))
    }

    /// The particle whose bit was flipped last.
    #[must_use]
    pub fn flipped(&self) -> Option<u64> {
        self.status
            .meddling
            .iter()
            .rev()
            .find_map(|m| match m.what {
                Perturbation::Flipped(particle) => Some(particle),
                Perturbation::Switched(_) => None,
            })
    }

    /// Takes what the player in the other arithmetic says.
    pub(super) fn hear(&mut self, beside: Beside) {
        let Some(other) = &mut self.other else { return };
        match beside {
            Beside::Picture(points) => other.points = *points,
            Beside::Row { row, travel } => other.track.push(*row, travel),
            Beside::Ended(_) => {}
        }
    }
}
