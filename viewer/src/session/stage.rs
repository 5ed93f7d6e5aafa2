//! A scene that is set up, and what is known of how it goes.

use crate::colour::Rgb;
use crate::home::Home;
use crate::picture::Picture;
use crate::track::Track;
use loschmidt_core::observe::BINS;
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
    /// The end of the axis of speeds, m/s: it follows the fastest particles, smoothly, and never
    /// comes back.
    pub fastest: f64,
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
            fastest: 0.0,
            moment: None,
            wanted: None,
            turning: false,
            home,
            opened,
        }
    }

    /// Takes what was measured.
    pub(super) fn note(&mut self, moment: Box<Moment>) {
        if moment.regular {
            self.track.push(moment.row.clone(), moment.travel);
        }
        self.fastest = axis_of_speeds(&moment, self.fastest);
        self.moment = Some(moment);
    }

    /// Lets the view grow with the fluid.
    pub(super) fn follow(&mut self) {
        let other = self.other.as_ref().map(|other| &other.points);
        self.home.follow(std::iter::once(&self.points).chain(other));
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

    /// Where that particle is, m.
    #[must_use]
    pub fn flipped_at(&self) -> Option<[f64; 3]> {
        let particle = self.flipped()?;
        let place = self.points.id.iter().position(|&id| id == particle)?;
        Some(self.points.at(place))
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

/// The end of the axis of speeds after this moment, from where it was before: with every row it goes
/// a part of the way to the speed that all but one particle in 500 stay below, and the fitted curve
/// too.
fn axis_of_speeds(moment: &Moment, before: f64) -> f64 {
    /// Part of the way.
    const PART: f64 = 0.15;
    let histogram = &moment.histogram;
    let total: u64 = histogram.counts.iter().map(|&c| u64::from(c)).sum();
    let mut slower = 0;
    let bins = histogram.counts.iter().take_while(|&&count| {
        let before = slower;
        slower += u64::from(count);
        before * 500 < total * 499
    });
    let mut wanted = bins.count() as f64 * histogram.bin_width;
    if let Some(t) = moment.row.fitted_temperature_m2_per_s2 {
        wanted = wanted.max(3.2 * t.sqrt());
    }
    let all = BINS as f64 * histogram.bin_width;
    let wanted = wanted.min(all);
    // At rest there is an axis as well.
    let before = before.max(all / 5.0);
    match moment.regular {
        true => before + PART * (wanted - before).max(0.0),
        false => before,
    }
}
