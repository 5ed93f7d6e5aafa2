//! The pace: how many steps are due.
//!
//! With a pace p (simulated s per s) and a time step Δt, p/Δt steps become due every second. What a
//! machine does not manage is forgotten, not caught up with.

use std::time::{Duration, Instant};

/// Debt is forgotten beyond what is due in this time.
const PATIENCE: Duration = Duration::from_millis(100);

/// The speed shown is that of about the last while.
const WHILE: Duration = Duration::from_millis(600);

/// Paces in a decade.
const PACES: [f64; 6] = [1.0, 1.5, 2.0, 3.0, 5.0, 7.0];

/// A pace that takes a scene of so many simulated seconds to its turnaround in half a minute or a
/// little more: one of 1, 1.5, 2, 3, 5, 7 times a power of ten.
#[must_use]
pub fn suggested_pace(span: f64) -> f64 {
    let wanted = span / 30.0;
    if wanted > 0.0 && wanted.is_finite() {
        at_most(wanted * 1.000_001)
    } else {
        1.0
    }
}

fn at_most(x: f64) -> f64 {
    let mut power = 1.0;
    while power > x {
        power /= 10.0;
    }
    while power * 10.0 <= x {
        power *= 10.0;
    }
    let fits = PACES.iter().rfind(|p| **p * power <= x);
    power * fits.unwrap_or(&1.0)
}

/// The next larger pace.
#[must_use]
pub fn faster(pace: f64) -> f64 {
    let power = at_most_power(pace);
    let next = PACES.iter().find(|p| **p * power > pace * 1.001);
    (power * next.unwrap_or(&10.0)).min(1e6)
}

/// The next smaller pace.
#[must_use]
pub fn slower(pace: f64) -> f64 {
    at_most(pace * 0.999).max(1e-9)
}

fn at_most_power(x: f64) -> f64 {
    let mut power = 1.0;
    while power > x * 1.001 {
        power /= 10.0;
    }
    while power * 10.0 <= x * 1.001 {
        power *= 10.0;
    }
    power
}

/// Counts the steps that are due.
#[derive(Debug)]
pub(super) struct DeckClock {
    /// Steps per second.
    rate: f64,
    credit: f64,
    last: Instant,
    /// Since when steps are counted, and how many there were.
    since: Instant,
    steps: u64,
    /// Steps per second of the while before.
    speed: f64,
    /// When debt was last forgotten.
    behind: Option<Instant>,
}

impl DeckClock {
    pub fn new(rate: f64, now: Instant) -> Self {
        Self {
            rate,
            credit: 0.0,
            last: now,
            since: now,
            steps: 0,
            speed: 0.0,
            behind: None,
        }
    }

    /// Another pace; what is due already stays due.
    pub fn set_rate(&mut self, rate: f64) {
        self.rate = rate;
        self.behind = None;
    }

    /// After a pause nothing is due.
    pub fn restart(&mut self, now: Instant) {
        *self = Self::new(self.rate, now);
    }

    /// Whole steps due now, and otherwise how long until the next one.
    pub fn due(&mut self, now: Instant) -> Result<u64, Duration> {
        self.credit += self.rate * now.duration_since(self.last).as_secs_f64();
        self.last = now;
        let most = (self.rate * PATIENCE.as_secs_f64()).max(1.0);
        if self.credit > most + 1.0 {
            self.credit = most;
            self.behind = Some(now);
        }
        if self.credit >= 1.0 {
            // The credit is below `most`, a finite number.
            Ok(self.credit as u64)
        } else {
            let wait = (1.0 - self.credit) / self.rate.max(1e-9);
            Err(Duration::from_secs_f64(wait.clamp(1e-4, 1.0)))
        }
    }

    /// So many steps were taken.
    pub fn took(&mut self, steps: u64, now: Instant) {
        self.credit -= steps as f64;
        self.steps += steps;
        let time = now.duration_since(self.since);
        if time >= WHILE {
            self.speed = self.steps as f64 / time.as_secs_f64();
            self.since = now;
            self.steps = 0;
        }
    }

    /// Steps per second, lately.
    pub fn speed(&self, now: Instant) -> f64 {
        let time = now.duration_since(self.since).as_secs_f64();
        if self.speed == 0.0 && time > 0.05 {
            self.steps as f64 / time
        } else {
            self.speed
        }
    }

    /// Whether no debt was forgotten lately.
    pub fn keeps_up(&self, now: Instant) -> bool {
        self.behind
            .is_none_or(|behind| now.duration_since(behind) > WHILE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paces_climb_and_fall_through_the_same_numbers() {
        let mut pace = 0.01;
        let mut up = vec![pace];
        for _ in 0..14 {
            pace = faster(pace);
            up.push(pace);
        }
        for expected in up.iter().rev().skip(1) {
            pace = slower(pace);
            assert!((pace / expected - 1.0).abs() < 1e-9, "{pace} {expected}");
        }
        assert!((up[6] / 0.1 - 1.0).abs() < 1e-9, "{up:?}");
    }

    #[test]
    fn a_second_of_simulated_time_takes_half_a_minute() {
        assert!((suggested_pace(1.0) - 0.03).abs() < 1e-12);
        assert!((suggested_pace(0.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_steps_due_are_those_of_the_pace_whatever_the_machine_does_in_between() {
        let start = Instant::now();
        let mut clock = DeckClock::new(100.0, start);
        let mut taken = 0;
        // Asked every 7 ms for ten seconds.
        for n in 1..=1428 {
            let now = start + Duration::from_millis(7 * n);
            if let Ok(due) = clock.due(now) {
                clock.took(due, now);
                taken += due;
            }
        }
        assert_eq!(taken, 999);
        assert!(clock.keeps_up(start + Duration::from_millis(9996)));
    }

    #[test]
    fn debt_is_forgotten() {
        let start = Instant::now();
        let mut clock = DeckClock::new(100.0, start);
        let late = start + Duration::from_secs(60);
        assert_eq!(clock.due(late), Ok(10));
        assert!(!clock.keeps_up(late));
    }
}
