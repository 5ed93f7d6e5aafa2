//! The foot: the bar of time, the notice, the keys that one needs most.

use super::ink::Ink;
use super::numbers::{count, quantity};
use super::{Areas, Piece, width, write, write_right};
use loschmidt_runner::Arrow;
use loschmidt_viewer::session::StagedScene;
use loschmidt_viewer::session::{Notice, Tone};
use loschmidt_viewer::{Action, keys};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

/// Draws the bar of time: what was reached, the present, where a seek leads.
pub fn time(stage: &StagedScene, areas: &Areas, buf: &mut Buffer, ink: &Ink) {
    let (bar, status) = (areas.bar, &stage.status);
    if bar.width < 4 {
        return;
    }
    let span = stage.span();
    let dt = stage.opened.scene.time_step();
    let last = bar.width - 1;
    let column = |step: i64| {
        let part = step.clamp(0, span) as f64 / span as f64;
        bar.x + (part * f64::from(last)).round() as u16
    };
    let (now, farthest) = (column(status.position), column(status.farthest));
    for x in bar.left()..bar.right() {
        let (symbol, style) = if x <= now {
            ('━', ink.time())
        } else if x <= farthest {
            ('━', ink.of_colour(ink.muted(ink.theme.forward)))
        } else {
            ('─', ink.rule())
        };
        buf[(x, bar.y)].set_char(symbol).set_style(style);
    }
    let turnaround = column(stage.opened.span);
    if stage.opened.scene.turnaround.is_some() && turnaround > now {
        buf[(turnaround, bar.y)]
            .set_char('╂')
            .set_style(ink.faint());
    }
    let target = stage.wanted.or(status.seek.map(|seek| seek.target));
    if let Some(target) = target {
        buf[(column(target), bar.y)]
            .set_char('◎')
            .set_style(ink.of_colour(ink.theme.third));
    }
    buf[(now, bar.y)].set_char('●').set_style(ink.bold());
    let left = Rect::new(0, bar.y, bar.x.saturating_sub(1), 1);
    let unit = stage.opened.scene.time_unit();
    let zero = format!("0 {}", unit.name());
    write_right(buf, left, bar.y, &[(zero, ink.faint())]);
    let end = quantity(span as f64 * dt, "s", 3);
    let right = Rect::new(
        bar.right() + 1,
        bar.y,
        areas.time.right() - bar.right() - 1,
        1,
    );
    write(buf, right, bar.y, &[(end, ink.faint())]);
}

/// The line above the keys: a seek, a notice, or how many particles are astray.
pub fn notice(
    stage: &StagedScene,
    notice: Option<&Notice>,
    area: Rect,
    buf: &mut Buffer,
    ink: &Ink,
) {
    let mut pieces: Vec<Piece> = vec![(" ".to_owned(), ink.text())];
    let astray = astray(stage, ink);
    if let Some(seek) = stage.status.seek {
        let way = (seek.target - seek.from).unsigned_abs().max(1);
        let done = (stage.status.position - seek.from).unsigned_abs();
        let percent = done * 100 / way;
        let time = seek.target as f64 * stage.opened.scene.time_step();
        let verb = if seek.target < seek.from {
            "integrating back"
        } else {
            "integrating on"
        };
        let time = stage.opened.scene.time_unit().amount(time, 5);
        pieces.push((format!("{verb} to {time}: {percent} %"), ink.bold()));
        pieces.push(("   Esc stops".to_owned(), ink.faint()));
    } else if let Some(notice) = notice {
        let style = match notice.tone {
            Tone::Done => ink.of_colour(ink.success_colour()),
            Tone::Warning => ink.of_colour(ink.theme.backward),
            Tone::Refused => ink.alarm(),
        };
        // What is astray comes first: a notice may be cut short.
        let taken: u16 = astray.iter().map(|(text, _)| width(text)).sum();
        let room = usize::from(area.width.saturating_sub(taken + 3));
        pieces.push((shortened(&notice.text, room), style));
    }
    let end = write(buf, area, area.y, &pieces);
    let rest = Rect::new(end, area.y, area.right().saturating_sub(end), 1);
    write_right(buf, rest, area.y, &astray);
}

fn shortened(text: &str, room: usize) -> String {
    if text.chars().count() <= room {
        text.to_owned()
    } else {
        let mut text: String = text.chars().take(room.saturating_sub(1)).collect();
        text.push('…');
        text
    }
}

/// On the way back: how many particles are not on their way home.
fn astray(stage: &StagedScene, ink: &Ink) -> Vec<Piece> {
    let status = &stage.status;
    let total = count(stage.points.len() as u64);
    let back = status.arrow == Arrow::Backward || status.seek.is_some();
    match status.astray {
        Some(0) if back => vec![(
            format!("0 of {total} astray: every particle is on its way home "),
            ink.of_colour(ink.success_colour()),
        )],
        Some(n) if back => vec![
            (format!(" {} of {total} ", count(n as u64)), {
                ink.badge(ink.alarm_colour())
            }),
            (" not on their way home ".to_owned(), ink.alarm()),
        ],
        _ if !status.meddling.is_empty() => {
            let n = status.meddling.len();
            let times = if n == 1 {
                "meddled with once".to_owned()
            } else {
                format!("meddled with {n} times")
            };
            let mark = stage.flipped().map_or(String::new(), |particle| {
                format!("✱ particle {particle}, ",)
            });
            vec![(format!("{mark}{times} "), ink.of_colour(ink.theme.backward))]
        }
        _ => Vec::new(),
    }
}

/// The keys that one needs most, as many as there is room for.
pub fn hints(stage: &StagedScene, area: Rect, buf: &mut Buffer, ink: &Ink) {
    const HINTS: [(&[Action], &str); 10] = [
        (&[Action::Play], ""),
        (&[Action::Turn], "reverse time"),
        (&[Action::StepBack, Action::StepOn], "step"),
        (&[Action::Slower, Action::Faster], "pace"),
        (&[Action::Flip], "flip a bit"),
        (&[Action::Switch], "float"),
        (&[Action::Colour], "colour"),
        (&[Action::Scenes], "scenes"),
        (&[Action::Help], "help"),
        (&[Action::Quit], "quit"),
    ];
    let play = if stage.status.playing && !stage.status.at_start {
        "pause"
    } else {
        "play"
    };
    let pieces = HINTS.map(|(actions, words)| {
        let keys: Vec<String> = actions
            .iter()
            .filter_map(|a| keys::key_of(keys::TABLE, *a))
            .collect();
        [
            (format!(" {}", keys.join(" ")), ink.bold()),
            (
                format!(" {} ", if words.is_empty() { play } else { words }),
                ink.faint(),
            ),
        ]
    });
    let wide = |pieces: &[Piece; 2]| pieces.iter().map(|(text, _)| super::width(text)).sum();
    // How to get help and how to leave are said wherever there is room for anything.
    let (others, last) = pieces.split_at(HINTS.len() - 2);
    let kept: u16 = last.iter().map(wide).sum();
    let mut rest = area;
    for pieces in others {
        let wide: u16 = wide(pieces);
        if wide + kept > rest.width {
            break;
        }
        let end = write(buf, rest, area.y, pieces);
        rest = Rect::new(end, area.y, area.right() - end, 1);
    }
    for pieces in last {
        let wide: u16 = wide(pieces);
        if wide <= rest.width {
            let end = write(buf, rest, area.y, pieces);
            rest = Rect::new(end, area.y, area.right() - end, 1);
        }
    }
}
