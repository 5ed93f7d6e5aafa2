//! When a run records what: fixed before it starts, from the scene alone.
//!
//! Rows, frames and snapshots are taken at whole multiples of an interval, counted in physical
//! steps from home, so that the way back passes the same states as the way out and their rows can
//! be compared bit for bit. Nothing that is recorded changes a bit of the run.

use crate::output::Snapshot;
use crate::player::Arrow;
use crate::scene::Scene;

/// The course of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Steps of the way out (of the whole run if it is one-way).
    pub out: u64,
    /// Steps of the way back; 0 in a one-way run.
    pub back: u64,
    /// Steps between rows.
    pub row_every: u64,
    /// Steps between frames; 0 for none.
    pub frame_every: u64,
    /// Steps between snapshots of the latest state.
    pub snapshot_every: u64,
}

/// What is due at a moment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Due {
    /// A row of the series.
    pub row: bool,
    /// A frame.
    pub frame: bool,
    /// A snapshot.
    pub snapshot: bool,
}

impl Plan {
    /// The plan of a scene.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let (out, back) = (scene.steps_out(), scene.steps_back());
        let total = out + back;
        // Rounded down: at least as many as asked for.
        let every = |count: u64| (total / count.max(1)).max(1);
        Self {
            out,
            back,
            row_every: every(scene.output.rows),
            frame_every: match scene.output.frames {
                0 => 0,
                frames => every(frames),
            },
            snapshot_every: every(scene.output.snapshots),
        }
    }

    /// Steps of both legs.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.out + self.back
    }

    /// Physical steps from home after `step` steps.
    #[must_use]
    pub fn position(&self, step: u64) -> u64 {
        if step <= self.out {
            step
        } else {
            self.out - (step - self.out).min(self.out)
        }
    }

    /// Whether the run passes through the place in time of this snapshot.
    #[must_use]
    pub fn passes(&self, snapshot: &Snapshot) -> bool {
        let step = snapshot.state.step;
        let arrow = if step <= self.out {
            Arrow::Forward
        } else {
            Arrow::Backward
        };
        step <= self.total()
            && snapshot.arrow == arrow
            && u64::try_from(snapshot.position) == Ok(self.position(step))
    }

    /// What is due after `step` steps: at multiples of the intervals, at the turnaround, at the
    /// end.
    #[must_use]
    pub fn due(&self, step: u64) -> Due {
        let position = self.position(step);
        let always = step == 0 || step == self.out || step == self.total();
        let at = |every: u64| every > 0 && (always || position.is_multiple_of(every));
        Due {
            row: at(self.row_every),
            frame: at(self.frame_every),
            snapshot: at(self.snapshot_every),
        }
    }

    /// The first step after `step` at which something is due, or the last of the next `piece`
    /// steps.
    #[must_use]
    pub fn next(&self, step: u64, piece: u64) -> u64 {
        let last = step.saturating_add(piece.max(1)).min(self.total());
        (step + 1..last)
            .find(|&s| self.due(s) != Due::default())
            .unwrap_or(last)
    }

    /// Frames due up to and including `step`, as the steps they are taken at.
    pub fn frames_until(&self, step: u64) -> impl Iterator<Item = u64> + '_ {
        (0..=step).filter(|&s| self.due(s).frame)
    }
}
