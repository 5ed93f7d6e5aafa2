//! Steps, played and sought.

use super::{PIECE, Worker};
use crate::deck::messages::Report;
use crate::player::Arrow;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

impl Worker {
    /// Takes the steps that are due; how long there is nothing to do.
    pub(super) fn go_on(&mut self) -> Duration {
        const IDLE: Duration = Duration::from_secs(3600);
        if self.seek.is_some() {
            self.seek_piece();
            return Duration::ZERO;
        }
        if !self.playing || self.at_start() {
            return IDLE;
        }
        let now = Instant::now();
        match self.clock.due(now) {
            Err(wait) => wait,
            Ok(due) => {
                let steps = due.min(self.piece(now)).min(self.room());
                match self.player.advance(steps) {
                    Ok(()) => {
                        self.beside(|companion| companion.advance(steps));
                        self.took(steps, now);
                        self.moved(self.player.arrow());
                    }
                    Err(fault) => self.fail(fault),
                }
                Duration::ZERO
            }
        }
    }

    /// Steps in a piece that begins now: fewer where a picture is due before its end.
    pub(super) fn piece(&self, now: Instant) -> u64 {
        let time = match self.due.map(|due| due.saturating_duration_since(now)) {
            // The face is late with the last one: it may be ready any moment.
            Some(Duration::ZERO) => PIECE / 8,
            Some(time) => time.min(PIECE),
            None => PIECE,
        };
        (time.as_secs_f64() / self.step_time).round().max(1.0) as u64
    }

    /// So many steps were taken since.
    pub(super) fn took(&mut self, steps: u64, since: Instant) {
        /// Weight of the latest piece.
        const LATEST: f64 = 0.25;
        let now = Instant::now();
        if steps > 0 {
            let took = now.duration_since(since).as_secs_f64() / steps as f64;
            self.step_time += LATEST * (took.max(1e-7) - self.step_time);
        }
        self.clock.took(steps, now);
    }

    /// Steps to the next row or to the start, whichever comes first.
    pub(super) fn room(&self) -> u64 {
        let position = self.player.position();
        let steps = match self.player.arrow() {
            Arrow::Forward => self.every - position.rem_euclid(self.every),
            Arrow::Backward => match position.rem_euclid(self.every) {
                0 => self.every,
                past => past,
            }
            .min(position),
        };
        steps.max(1) as u64
    }

    /// Goes on with a seek, to the next row at most.
    pub(super) fn seek_piece(&mut self) {
        let Some(seek) = self.seek else { return };
        let position = self.player.position();
        let travel = if seek.target < position {
            Arrow::Backward
        } else {
            Arrow::Forward
        };
        let began = Instant::now();
        let past = position.rem_euclid(self.every);
        let next = match travel {
            Arrow::Forward => (position - past + self.every).min(seek.target),
            Arrow::Backward if past == 0 => (position - self.every).max(seek.target),
            Arrow::Backward => (position - past).max(seek.target),
        };
        let piece = self.piece(began);
        let next = next.clamp(position - piece as i64, position + piece as i64);
        match self.player.seek(next, piece, |_| ControlFlow::Continue(())) {
            Ok(()) => {}
            Err(crate::player::PlayerError::Fault(fault)) => return self.fail(fault),
            Err(why) => {
                self.seek = None;
                return (self.tell)(Report::Refused(why.into()));
            }
        }
        self.beside(|companion| companion.walk(next - position));
        self.took(next.abs_diff(position), began);
        let ended = next == seek.target;
        if ended {
            self.seek = None;
        }
        self.moved(travel);
        if ended {
            if next.rem_euclid(self.every) != 0 {
                self.measure(travel, false);
            }
            self.stand();
            (self.tell)(Report::SeekEnded(true));
            self.report();
        }
    }
}
