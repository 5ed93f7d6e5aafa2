//! What happened, line by line on standard error, for scripts.

use super::state::WindowState;
use loschmidt_runner::Arrow;
use loschmidt_runner::deck::Report;
use std::io::Write;
use std::time::{Duration, Instant};

/// Between two lines about the speed.
const EVERY: Duration = Duration::from_secs(1);

/// The log, and what it counts.
#[derive(Debug)]
pub struct Log {
    wanted: bool,
    since: Instant,
    frames: u64,
    /// Steps taken since, by what the pictures said, and the position of the last.
    steps: u64,
    position: Option<i64>,
    /// Time spent drawing since.
    drawing: Duration,
}

impl Log {
    /// A log; nothing is written where it is not wanted.
    pub fn new(wanted: bool) -> Self {
        Self {
            wanted,
            since: Instant::now(),
            frames: 0,
            steps: 0,
            position: None,
            drawing: Duration::ZERO,
        }
    }

    /// Writes a line; a reader that has gone away ends nothing.
    pub fn say(&self, line: &str) {
        if self.wanted {
            let _ = writeln!(std::io::stderr(), "{line}");
        }
    }

    /// What a report says, before the state hears it.
    pub fn report(&mut self, report: &Report) {
        match report {
            Report::Opened(opened) => self.say(&format!(
                "opened {} {} particles at {}",
                opened.scene.name,
                opened.home.id.len(),
                opened.status.position
            )),
            Report::Failed(why) => self.say(&format!("failed {why}")),
            Report::Turned(Arrow::Backward) => self.say("turned backward"),
            Report::Turned(Arrow::Forward) => self.say("turned forward"),
            Report::Arrived(arrival) if arrival.comparison.is_exact() => self.say(&format!(
                "arrived bit-identical {} after {} steps",
                arrival.comparison.present, arrival.farthest
            )),
            Report::Arrived(arrival) => {
                self.say(&format!(
                    "arrived with {} astray",
                    arrival.comparison.astray
                ));
            }
            Report::SeekEnded(there) => self.say(&format!("seek ended {there}")),
            Report::Refused(why) => self.say(&format!("refused {why}")),
            Report::Kept(path) => self.say(&format!("kept {}", path.display())),
            Report::Shot(shot) => {
                let now = shot.status.position;
                if let Some(before) = self.position.replace(now) {
                    self.steps += now.abs_diff(before);
                }
            }
            Report::Status(status) if !status.playing && status.seek.is_none() => {
                self.say(&format!("stands at {}", status.position));
            }
            _ => {}
        }
    }

    /// A frame was drawn in this time.
    pub fn drawn(&mut self, state: &WindowState, time: Duration) {
        self.frames += 1;
        self.drawing += time;
        let elapsed = self.since.elapsed();
        if elapsed >= EVERY {
            let seconds = elapsed.as_secs_f64();
            let (width, height) = state.size;
            self.say(&format!(
                "speed {:.1} frames/s {:.1} steps/s {:.2} ms/frame {width}x{height}",
                self.frames as f64 / seconds,
                self.steps as f64 / seconds,
                1e3 * self.drawing.as_secs_f64() / self.frames as f64,
            ));
            self.since = Instant::now();
            self.frames = 0;
            self.steps = 0;
            self.drawing = Duration::ZERO;
        }
    }
}
