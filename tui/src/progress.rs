//! Progress on standard error: a bar on a terminal, a line now and then elsewhere.

use crate::brief::brief;
use crate::exit::tell;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use loschmidt_runner::figures::{Scale, number, quantity};
use loschmidt_runner::run::Progress;
use loschmidt_runner::{Run, SavedState, setup};
use loschmidt_viewer::movie;
use loschmidt_viewer::session::count;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Between two plain lines at least.
const PAUSE: Duration = Duration::from_secs(10);

/// Says what is about to be run, how long it will take, and where its files go. `set`: what the
/// scene was changed by.
pub fn announce(run: &mut Run, set: &[String]) {
    let seconds = run.expected_seconds();
    let player = run.player();
    let changes = match set {
        [] => String::new(),
        set => format!(" with {}", set.join(" ")),
    };
    tell(&format!(
        "{}{changes}: {} particles, {} steps, {} on {} thread(s)",
        player.scene().name,
        count(player.particles()),
        count(run.plan().total()),
        player.options().executor.name(),
        player.threads(),
    ));
    let time = seconds.map(|seconds| format!("about {}; ", duration(seconds)));
    let path = run.path().map(|path| {
        let frames = run.plan().frames_until(run.plan().total()).count() as u64;
        let bytes = frames * frame_bytes(player.home());
        let size = setup::bytes_for_people(bytes);
        format!("about {size} of frames, written to {}", path.display())
    });
    tell(&format!(
        "{}{}",
        time.unwrap_or_default(),
        path.unwrap_or_default()
    ));
    let dt = player.scene().time_step();
    for (name, limit) in setup::fixed_limits(player.scene()) {
        if dt > limit {
            tell(&format!(
                "warning: the time step {} exceeds the {name} limit {}; see `loschmidt check`",
                quantity(dt, "s", 3),
                quantity(limit, "s", 3)
            ));
        }
    }
}

/// Bytes of a particle in the CSV and VTP files of a frame, about.
const BYTES_PER_PARTICLE: u64 = 250;

/// Bytes of a frame of these particles, about.
pub fn frame_bytes(state: &SavedState) -> u64 {
    BYTES_PER_PARTICLE * (state.id.len() + state.walls) as u64
}

/// Shows how far a run has come.
pub enum Display {
    /// Nothing.
    Quiet,
    /// A bar.
    Bar {
        /// It.
        bar: ProgressBar,
        /// In which times are shown.
        unit: Scale,
    },
    /// Lines.
    Lines {
        /// In which times are shown.
        unit: Scale,
        /// When and at which step this process began.
        began: Option<(Instant, u64)>,
        /// When the last line was printed.
        last: Option<Instant>,
    },
}

impl Display {
    pub fn new(quiet: bool, unit: Scale, done: u64, total: u64) -> Self {
        if quiet {
            return Self::Quiet;
        }
        if !std::io::stderr().is_terminal() {
            return Self::Lines {
                unit,
                began: None,
                last: None,
            };
        }
        let bar =
            ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(10));
        let template =
            "{prefix:>4} {wide_bar} {percent:>3} %  step {pos}/{len}  {eta} left\n{wide_msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("█▉▊▋▌▍▎▏ "));
        }
        bar.set_position(done);
        bar.reset_eta();
        Self::Bar { bar, unit }
    }

    pub fn show(&mut self, progress: &Progress<'_>) {
        match self {
            Self::Quiet => {}
            Self::Bar { bar, unit } => {
                bar.set_prefix(if progress.way_back { "back" } else { "out" });
                bar.set_message(energies(progress, *unit));
                bar.set_position(progress.step);
            }
            Self::Lines { unit, began, last } => {
                let now = Instant::now();
                let (start, first) = *began.get_or_insert((now, progress.step));
                let finished = progress.step == progress.total;
                if !finished && last.is_some_and(|last| now - last < PAUSE) {
                    return;
                }
                *last = Some(now);
                let done = progress.step - first;
                let left = if done == 0 {
                    "?".to_owned()
                } else {
                    let pace = (now - start).as_secs_f64() / done as f64;
                    duration(pace * (progress.total - progress.step) as f64)
                };
                tell(&format!(
                    "{} step {}/{}, {left} left; {}",
                    if progress.way_back { "back" } else { "out" },
                    progress.step,
                    progress.total,
                    energies(progress, *unit)
                ));
            }
        }
    }

    /// Takes the bar away; that of a run that did not end well stays, to show how far it came. (It
    /// could not be taken away cleanly: the terminal has echoed the Ctrl-C into it.)
    pub fn finish(self, well: bool) {
        match self {
            Self::Bar { bar, .. } if well => bar.finish_and_clear(),
            Self::Bar { bar, .. } => {
                bar.abandon();
                tell("");
            }
            Self::Quiet | Self::Lines { .. } => {}
        }
    }
}

fn energies(progress: &Progress<'_>, unit: Scale) -> String {
    let (row, home) = (progress.row, progress.home);
    // Short enough for one line of 80 columns: a wrapped bar cannot be redrawn cleanly.
    let largest = row.energies.iter().chain(&home.energies);
    let largest = largest.fold(0.0, |most: f64, (_, energy)| most.max(energy.abs()));
    let scale = Scale::of(largest, "J");
    let mut text = format!("t {}  {}:", unit.amount(row.time_s, 5), scale.name());
    for (kind, energy) in row.energies.iter().take(4) {
        text += &format!(" {} {}", brief(kind), scale.fixed(*energy, 4));
    }
    let error = row.total - home.total;
    let error = quantity(error, "J", 2);
    text + &format!(" error {error}  S {}", number(row.entropy, 4))
}

/// Seconds for people: 48 s, 12 min 30 s, 2 h 05 min.
pub fn duration(seconds: f64) -> String {
    let s = seconds.round().max(0.0) as u64;
    match s {
        0..60 => format!("{s} s"),
        60..3600 => format!("{} min {:02} s", s / 60, s % 60),
        _ => format!("{} h {:02} min", s / 3600, s % 3600 / 60),
    }
}

/// Shows how far a movie has come.
pub struct Pictures {
    quiet: bool,
    bar: Option<ProgressBar>,
    /// When and at which step this process began.
    began: Option<(Instant, u64)>,
    last: Option<Instant>,
}

impl Pictures {
    pub fn new(quiet: bool) -> Self {
        Self {
            quiet,
            bar: None,
            began: None,
            last: None,
        }
    }

    pub fn show(&mut self, progress: &movie::MovieProgress) {
        if self.quiet {
            return;
        }
        let now = Instant::now();
        let (start, first) = *self.began.get_or_insert((now, progress.step));
        let left = match progress.step.saturating_sub(first) {
            0 => None,
            done => {
                let pace = (now - start).as_secs_f64() / done as f64;
                let steps = progress.steps.saturating_sub(progress.step);
                Some(duration(pace * steps as f64))
            }
        };
        if std::io::stderr().is_terminal() {
            let total = progress.total as u64;
            let bar = self.bar.get_or_insert_with(|| {
                let target = ProgressDrawTarget::stderr_with_hz(10);
                let bar = ProgressBar::with_draw_target(Some(total), target);
                let template = "{wide_bar} picture {pos}/{len}  {msg}";
                if let Ok(style) = ProgressStyle::with_template(template) {
                    bar.set_style(style.progress_chars("█▉▊▋▌▍▎▏ "));
                }
                bar
            });
            bar.set_message(left.map_or_else(String::new, |left| format!("{left} left")));
            bar.set_position(progress.done as u64);
            return;
        }
        let finished = progress.done == progress.total;
        // Before the first steps nobody knows how long it takes.
        let Some(left) = left else { return };
        if finished || self.last.is_none_or(|last| now - last >= PAUSE) {
            self.last = Some(now);
            let (done, total) = (progress.done, progress.total);
            tell(&format!("picture {done}/{total}, {left} left"));
        }
    }

    /// Leaves the terminal as it was.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
