//! Below the picture: the bar of time, what the simulation does, and the keys that one needs most.

use super::places::Places;
use crate::colour::{Rgb, Theme};
use crate::keys::{self, Action};
use crate::raster::{Mask, Pixels, Rect};
use crate::session::{Session, StagedScene, Tone, count};
use crate::text::{self, TextStyle, Weight};
use loschmidt_runner::figures::{number, quantity};
use loschmidt_runner::{ArithmeticKind, Arrow};

/// The colour of what is not as it should be.
pub fn alarm(theme: &Theme) -> Rgb {
    theme.backward
}

/// Paints the strip.
pub fn paint(raster: &mut Pixels<'_>, session: &Session, stage: &StagedScene, places: &Places) {
    if places.strip.height == 0 {
        return;
    }
    let theme = &session.look.theme;
    let rule = Rect {
        height: 1,
        ..places.strip
    };
    raster.fill(rule, theme.rule, 255);
    bar(raster, stage, places, theme);
    words(raster, session, stage, places);
}

/// The bar of time: what was reached, the present, where a seek leads.
fn bar(raster: &mut Pixels<'_>, stage: &StagedScene, places: &Places, theme: &Theme) {
    let (bar, em, status) = (places.bar, places.em as f64, &stage.status);
    if bar.width < 8 {
        return;
    }
    let span = stage.span();
    let y = bar.y as f64 + 0.5 * bar.height as f64;
    let at = |step: i64| [places.bar_at(step, span), y];
    let room = Rect::new(
        bar.x.saturating_sub(2 * places.em),
        bar.y.saturating_sub(places.em),
        bar.width + 4 * places.em,
        bar.height + 2 * places.em,
    );
    let mut paint = |colour: Rgb, alpha: u8, shape: &dyn Fn(&mut Mask)| {
        let mut mask = Mask::new(room.clipped(raster.width(), raster.height()));
        shape(&mut mask);
        mask.paint(raster, colour, alpha);
    };
    let time = match stage.arrow() {
        Arrow::Forward => theme.forward,
        Arrow::Backward => theme.backward,
    };
    let thick = 0.28 * em;
    paint(theme.rule, 255, &|m| m.line(at(0), at(span), thick));
    paint(theme.forward, 90, &|m| {
        m.line(at(0), at(status.farthest), thick);
    });
    paint(time, 255, &|m| m.line(at(0), at(status.position), thick));
    if stage.opened.scene.turnaround.is_some() {
        let [x, y] = at(stage.opened.span);
        let (low, high) = ([x, y + 0.4 * em], [x, y - 0.4 * em]);
        paint(theme.faint, 255, &|m| m.line(low, high, 0.1 * em));
    }
    let target = stage.wanted.or(status.seek.map(|seek| seek.target));
    if let Some(target) = target {
        paint(theme.third, 255, &|m| {
            m.ring(at(target), 0.5 * em, 0.16 * em)
        });
    }
    let here = at(status.position);
    paint(theme.text, 255, &|m| m.line(here, here, 0.8 * em));
    let faint = TextStyle {
        size: places.em * 6 / 7,
        weight: Weight::Medium,
        colour: theme.faint,
    };
    let below = (y + 0.35 * em) as i64;
    let left = bar.x as f64 - em;
    let unit = stage.opened.scene.time_unit();
    text::write_left_of(raster, &faint, left, below, &format!("0 {}", unit.name()));
    let end = span as f64 * stage.opened.scene.time_step();
    let right = (bar.x + bar.width) as f64 + em;
    let end = quantity(end, "s", 3);
    text::write(raster, &faint, right, below, &end);
}

/// On the left what the simulation does; on the right a notice, or how many particles are astray,
/// or the keys.
fn words(raster: &mut Pixels<'_>, session: &Session, stage: &StagedScene, places: &Places) {
    let (theme, em) = (&session.look.theme, places.em);
    let style = |colour, weight| TextStyle {
        size: em * 6 / 7,
        weight,
        colour,
    };
    let baseline = (places.strip.y + 7 * em / 2) as i64;
    let gap = em as f64;
    let mut x = gap;
    let end = places.strip.width as f64 - gap;
    for (text, colour, weight) in doing(stage, theme) {
        let style = style(colour, weight);
        if x + text::width(&style, &text) > end {
            return;
        }
        x = text::write(raster, &style, x, baseline, &text) + 0.8 * gap;
    }
    let room = end - x - gap;
    let told = match (&session.notice, astray(stage, theme)) {
        (Some(notice), _) => {
            let colour = match notice.tone {
                Tone::Done => theme.second,
                Tone::Warning => theme.backward,
                Tone::Refused => alarm(theme),
            };
            Some((notice.text.clone(), colour))
        }
        (None, astray) => astray,
    };
    if let Some((text, colour)) = told {
        let style = style(colour, Weight::SemiBold);
        let text = text::fitted(&style, &text, room);
        text::write_left_of(raster, &style, end, baseline, &text);
    } else {
        let style = style(theme.faint, Weight::Medium);
        let text = hints(stage, |text| text::width(&style, text) <= room);
        text::write_left_of(raster, &style, end, baseline, &text);
    }
}

type ColouredText = (String, Rgb, Weight);

/// What the simulation does, in pieces from left to right.
fn doing(stage: &StagedScene, theme: &Theme) -> Vec<ColouredText> {
    let status = &stage.status;
    let dt = stage.opened.scene.time_step();
    let state = if let Some(seek) = status.seek {
        let way = (seek.target - seek.from).unsigned_abs().max(1);
        let done = (status.position - seek.from).unsigned_abs();
        let verb = if seek.target < seek.from {
            "integrating back"
        } else {
            "integrating on"
        };
        let time = stage.opened.scene.time_unit();
        let time = time.amount(seek.target as f64 * dt, 5);
        format!("{verb} to {time}: {} %", done * 100 / way)
    } else if status.at_start {
        "at the start".to_owned()
    } else if status.playing {
        "playing".to_owned()
    } else {
        "paused".to_owned()
    };
    let time = match stage.arrow() {
        Arrow::Forward => theme.forward,
        Arrow::Backward => theme.backward,
    };
    let mut pieces = vec![
        (state, time, Weight::SemiBold),
        (
            format!("step {}", count(status.position.unsigned_abs())),
            theme.text,
            Weight::Medium,
        ),
        (quantity(status.pace, "s/s", 3), theme.text, Weight::Medium),
    ];
    if status.steps_per_second > 0.0 {
        let speed = format!("{} steps/s", number(status.steps_per_second, 3));
        let colour = if status.keeps_up {
            theme.faint
        } else {
            alarm(theme)
        };
        pieces.push((speed, colour, Weight::Medium));
    }
    if status.arithmetic == ArithmeticKind::Float {
        let text = "floating point".to_owned();
        pieces.push((text, alarm(theme), Weight::SemiBold));
    }
    pieces
}

/// On the way back: how many particles are not on their way home.
fn astray(stage: &StagedScene, theme: &Theme) -> Option<(String, Rgb)> {
    let status = &stage.status;
    let total = count(stage.points.len() as u64);
    let back = status.arrow == Arrow::Backward || status.seek.is_some();
    match status.astray {
        Some(0) if back => {
            let text = format!("0 of {total} astray: every particle is on its way home");
            Some((text, theme.second))
        }
        Some(n) if back => {
            let text = format!("{} of {total} not on their way home", count(n as u64));
            Some((text, alarm(theme)))
        }
        _ if !status.meddling.is_empty() => {
            let text = match status.meddling.len() {
                1 => "meddled with once".to_owned(),
                n => format!("meddled with {n} times"),
            };
            Some((text, theme.backward))
        }
        _ => None,
    }
}

/// The keys that one needs most, as many as `fits` finds room for.
fn hints(stage: &StagedScene, fits: impl Fn(&str) -> bool) -> String {
    let play = if stage.status.playing && !stage.status.at_start {
        "pause"
    } else {
        "play"
    };
    let hints = [
        (Action::Help, "help"),
        (Action::Turn, "reverse time"),
        (Action::Play, play),
        (Action::Flip, "flip a bit"),
        (Action::Colour, "colour"),
        (Action::Quit, "quit"),
    ];
    let table = keys::of_window();
    let mut line = String::new();
    for (action, words) in hints {
        let Some(key) = keys::key_of(&table, action) else {
            continue;
        };
        let longer = if line.is_empty() {
            format!("{key} {words}")
        } else {
            format!("{line}   {key} {words}")
        };
        if !fits(&longer) {
            break;
        }
        line = longer;
    }
    line
}
