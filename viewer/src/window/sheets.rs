//! What lies over the rest: the keys, the arrival at the start, errors.

use super::places::Places;
use super::strip::alarm;
use crate::colour::{Rgb, Theme};
use crate::keys;
use crate::raster::{Pixels, Rect};
use crate::session::{List, Panel, because, count};
use crate::text::{self, TextStyle, Weight};
use loschmidt_runner::ArithmeticKind;
use loschmidt_runner::deck::Arrival;
use loschmidt_runner::figures::quantity;

/// A piece of a line: where it begins, in ems from the left of the sheet; what it says, and how.
struct SheetText {
    at: f64,
    text: String,
    colour: Rgb,
    weight: Weight,
}

impl SheetText {
    fn new(at: f64, text: impl Into<String>, colour: Rgb, weight: Weight) -> Self {
        Self {
            at,
            text: text.into(),
            colour,
            weight,
        }
    }

    fn style(&self, size: usize) -> TextStyle {
        TextStyle {
            size,
            weight: self.weight,
            colour: self.colour,
        }
    }
}

type SheetLine = Vec<SheetText>;

/// Height of a line, ems.
const LINE: f64 = 1.5;

/// A sheet in the middle of a rectangle; its text is as large as `em` where it fits then, and else
/// smaller.
fn sheet(
    raster: &mut Pixels<'_>,
    within: Rect,
    em: usize,
    lines: &[SheetLine],
    edge: Rgb,
    theme: &Theme,
) {
    let width = |em: usize| {
        let pieces = lines.iter().flatten();
        pieces
            .map(|p| p.at * em as f64 + text::width(&p.style(em), &p.text))
            .fold(0.0, f64::max)
            + 2.5 * em as f64
    };
    let height = |em: usize| (lines.len() as f64 * LINE + 2.0) * em as f64;
    let mut em = em;
    while em > 6 && (height(em) > within.height as f64 || width(em) > within.width as f64) {
        em -= 1;
    }
    let size = [width(em), height(em)].map(|x| x as usize);
    let rect = Rect::new(
        within.x + within.width.saturating_sub(size[0]) / 2,
        within.y + within.height.saturating_sub(size[1]) / 2,
        size[0].min(within.width),
        size[1].min(within.height),
    );
    raster.fill(rect, edge, 255);
    raster.fill(rect.shrunk((em / 8).max(1)), theme.panel, 255);
    for (n, line) in lines.iter().enumerate() {
        let y = rect.y as f64 + (2.1 + n as f64 * LINE) * em as f64;
        for piece in line {
            let x = rect.x as f64 + (1.25 + piece.at) * em as f64;
            text::write(raster, &piece.style(em), x, y as i64, &piece.text);
        }
    }
}

/// The keys.
pub fn help(raster: &mut Pixels<'_>, theme: &Theme) {
    let mut lines: Vec<SheetLine> = Vec::new();
    let mut group = "";
    for binding in keys::of_window() {
        let mut line = Vec::new();
        if binding.group != group {
            if !group.is_empty() {
                lines.push(Vec::new());
            }
            group = binding.group;
            line.push(SheetText::new(0.0, group, theme.forward, Weight::SemiBold));
        }
        line.push(SheetText::new(
            7.5,
            binding.names(),
            theme.text,
            Weight::SemiBold,
        ));
        line.push(SheetText::new(
            14.0,
            binding.meaning,
            theme.faint,
            Weight::Medium,
        ));
        lines.push(line);
    }
    lines.push(Vec::new());
    let mouse = "a PNG dropped on the window tints the fluid";
    lines.push(vec![
        SheetText::new(0.0, "mouse", theme.forward, Weight::SemiBold),
        SheetText::new(7.5, mouse, theme.faint, Weight::Medium),
    ]);
    let within = raster.rect().shrunk(4);
    let em = raster.height() / 48 + 2;
    sheet(raster, within, em, &lines, theme.rule, theme);
}

/// What can be opened.
pub fn scenes(raster: &mut Pixels<'_>, list: &List, theme: &Theme) {
    let within = raster.rect().shrunk(4);
    let em = raster.height() / 44 + 2;
    let room = (within.height as f64 / (LINE * em as f64)) as usize;
    let mut lines = headed("scenes and runs", theme);
    for (n, choice) in list.visible(room.saturating_sub(6)) {
        let (mark, colour, weight) = match n == list.chosen {
            true => (">", theme.forward, Weight::SemiBold),
            false => ("", theme.text, Weight::Medium),
        };
        lines.push(vec![
            SheetText::new(0.0, mark, colour, weight),
            SheetText::new(1.0, choice.name.clone(), colour, weight),
            SheetText::new(15.0, choice.title.clone(), theme.faint, Weight::Medium),
        ]);
    }
    let keys = "arrows choose   Enter opens   Esc goes back";
    footed(&mut lines, keys, theme);
    sheet(raster, within, em, &lines, theme.rule, theme);
}

/// The panel of parameters.
pub fn parameters(raster: &mut Pixels<'_>, panel: &Panel, theme: &Theme) {
    let mut lines = headed("parameters", theme);
    for (n, (name, unit, _)) in Panel::FIELDS.iter().enumerate() {
        let colour = if n == panel.field {
            theme.forward
        } else if panel.values[n] != panel.before[n] {
            theme.backward
        } else {
            theme.text
        };
        lines.push(vec![
            SheetText::new(0.0, *name, colour, Weight::SemiBold),
            SheetText::new(
                10.0,
                panel.shown(n, ['<', '>', '|']),
                colour,
                Weight::Medium,
            ),
            SheetText::new(20.0, *unit, theme.faint, Weight::Medium),
        ]);
    }
    if let Some(problem) = &panel.problem {
        lines.push(Vec::new());
        // Without the excerpt, which is laid out for letters of one width.
        for text in problem.lines().filter(|line| !line.starts_with([' ', '|'])) {
            lines.push(vec![SheetText::new(
                0.0,
                text,
                alarm(theme),
                Weight::Medium,
            )]);
        }
    }
    let keys = "type a value   arrows choose   Enter starts anew   Esc goes back";
    footed(&mut lines, keys, theme);
    let em = raster.height() / 40 + 2;
    sheet(
        raster,
        raster.rect().shrunk(4),
        em,
        &lines,
        theme.rule,
        theme,
    );
}

fn headed(title: &str, theme: &Theme) -> Vec<SheetLine> {
    let title = SheetText::new(0.0, title, theme.forward, Weight::SemiBold);
    vec![vec![title], Vec::new()]
}

fn footed(lines: &mut Vec<SheetLine>, keys: &str, theme: &Theme) {
    lines.push(Vec::new());
    lines.push(vec![SheetText::new(0.0, keys, theme.faint, Weight::Medium)]);
}

/// Why nothing can be shown.
pub fn error(raster: &mut Pixels<'_>, why: &str, theme: &Theme) {
    let edge = alarm(theme);
    let title = SheetText::new(0.0, "this cannot be shown", edge, Weight::SemiBold);
    let mut lines: Vec<SheetLine> = vec![vec![title], Vec::new()];
    for text in why.lines() {
        lines.push(vec![SheetText::new(0.0, text, theme.text, Weight::Medium)]);
    }
    footed(&mut lines, "q quits   o opens another scene", theme);
    let within = raster.rect().shrunk(4);
    let em = raster.height() / 40 + 2;
    sheet(raster, within, em, &lines, edge, theme);
}

/// The start was reached.
pub fn banner(raster: &mut Pixels<'_>, arrival: &Arrival, theme: &Theme, places: &Places) {
    let exact = arrival.comparison.is_exact();
    let (lines, edge) = if exact {
        (returned(arrival, theme), theme.second)
    } else {
        (missed(arrival, theme), alarm(theme))
    };
    let within = if places.fields.len() > 1 {
        places.picture
    } else {
        places.field
    };
    sheet(raster, within, places.em, &lines, edge, theme);
}

fn digests(arrival: &Arrival, theme: &Theme) -> [SheetLine; 2] {
    let line = |name: &str, digest: String| {
        vec![
            SheetText::new(0.0, name, theme.faint, Weight::Medium),
            SheetText::new(10.5, digest, theme.text, Weight::Medium),
        ]
    };
    [
        line("digest at the start", arrival.comparison.home.to_string()),
        line("digest now", arrival.comparison.present.to_string()),
    ]
}

fn returned(arrival: &Arrival, theme: &Theme) -> Vec<SheetLine> {
    let steps = count(arrival.farthest.unsigned_abs());
    let title = "Time came back: bit-identical";
    let story = format!("{steps} steps out, and back; every bit is as it was");
    let mut lines = vec![
        vec![SheetText::new(0.0, title, theme.second, Weight::SemiBold)],
        Vec::new(),
    ];
    lines.extend(digests(arrival, theme));
    lines.push(Vec::new());
    lines.push(vec![SheetText::new(0.0, story, theme.text, Weight::Medium)]);
    let keys = "r runs it again, any other key goes on";
    lines.push(vec![SheetText::new(0.0, keys, theme.faint, Weight::Medium)]);
    lines
}

fn missed(arrival: &Arrival, theme: &Theme) -> Vec<SheetLine> {
    let c = &arrival.comparison;
    let story = format!(
        "{} {} astray, the farthest {} from home",
        count(c.astray as u64),
        if c.astray == 1 {
            "particle"
        } else {
            "particles"
        },
        quantity(c.error, "m", 2)
    );
    let title = "Time did not come back";
    let mut lines = vec![
        vec![SheetText::new(0.0, title, alarm(theme), Weight::SemiBold)],
        Vec::new(),
        vec![SheetText::new(0.0, story, theme.text, Weight::Medium)],
    ];
    let mut reason = |text: String| {
        lines.push(vec![SheetText::new(
            0.0,
            text,
            theme.backward,
            Weight::Medium,
        )]);
    };
    for meddling in arrival.meddling.iter().rev().take(2).rev() {
        reason(because(meddling));
    }
    if arrival.meddling.is_empty() && arrival.arithmetic == ArithmeticKind::Float {
        reason("floating-point sums are rounded differently on the way back".to_owned());
    }
    lines.push(Vec::new());
    lines.extend(digests(arrival, theme));
    let keys = "any key goes on";
    lines.push(vec![SheetText::new(0.0, keys, theme.faint, Weight::Medium)]);
    lines
}
