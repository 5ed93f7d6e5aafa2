//! What lies over the rest: help, scenes, parameters, errors.

use super::ink::Ink;
use super::{Piece, width};
use loschmidt_viewer::session::{List, Panel};
use loschmidt_viewer::{Rgb, keys};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;
use ratatui::widgets::{Block, BorderType, Clear, Widget};

/// Pieces of a line.
pub type StyledLine = Vec<Piece>;

/// A sheet in the middle of an area, with lines on it.
pub fn sheet(
    title: &str,
    lines: &[StyledLine],
    border: Option<Rgb>,
    area: Rect,
    buf: &mut Buffer,
    ink: &Ink,
) -> Rect {
    let wide = |line: &StyledLine| line.iter().map(|(text, _)| width(text)).sum::<u16>();
    let columns = lines
        .iter()
        .map(wide)
        .max()
        .unwrap_or(0)
        .max(width(title) + 2)
        + 4;
    let (columns, rows) = (
        columns.min(area.width),
        (lines.len() as u16 + 2).min(area.height),
    );
    let at = Rect::new(
        area.x + (area.width - columns) / 2,
        area.y + (area.height - rows) / 2,
        columns,
        rows,
    );
    Clear.render(at, buf);
    let border = ink.of_colour(border.unwrap_or(ink.theme.faint));
    let mut block = Block::bordered()
        .border_type(BorderType::Rounded)
        .border_style(border)
        .style(ink.sheet());
    if !title.is_empty() {
        block = block.title(format!(" {title} ")).title_style(ink.bold());
    }
    let inner = block.inner(at);
    block.render(at, buf);
    for (row, line) in (inner.top()..inner.bottom()).zip(lines) {
        let mut x = inner.x + 1;
        for (text, style) in line {
            let room = (inner.right()).saturating_sub(x);
            x = buf.set_stringn(x, row, text, room.into(), *style).0;
        }
    }
    inner
}

/// The table of keys.
pub fn help(first: usize, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let table = keys::TABLE;
    let column = table.iter().map(|b| width(&b.names())).max().unwrap_or(0);
    let spaced = usize::from(area.height) >= table.len() + 9;
    let mut lines: Vec<StyledLine> = Vec::new();
    let mut group = "";
    for binding in table {
        let head = if binding.group == group {
            ""
        } else {
            binding.group
        };
        if !head.is_empty() && !group.is_empty() && spaced {
            lines.push(Vec::new());
        }
        group = binding.group;
        let mut line = Vec::new();
        if area.width >= 76 {
            line.push((
                format!("{head:<13}"),
                ink.time().add_modifier(Modifier::BOLD),
            ));
        }
        let names = binding.names();
        let pad = usize::from(column - width(&names)) + 2;
        line.push((names + &" ".repeat(pad), ink.bold()));
        line.push((binding.meaning.to_owned(), ink.faint()));
        lines.push(line);
    }
    let room = usize::from(area.height.saturating_sub(2));
    let title = if lines.len() > room {
        // As far down as there are lines.
        let first = first.min(lines.len() - room);
        lines.drain(..first);
        "keys   ↑ ↓ for the others"
    } else {
        "keys"
    };
    sheet(title, &lines, None, area, buf, ink);
}

/// What can be opened.
pub fn scenes(list: &List, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let names = list.choices.iter().map(|c| width(&c.name));
    let column = names.max().unwrap_or(0).min(36);
    let room = usize::from(area.height.saturating_sub(5));
    let mut lines: Vec<StyledLine> = Vec::new();
    for (n, choice) in list.visible(room) {
        let mark = if n == list.chosen { "▸ " } else { "  " };
        let name: String = choice.name.chars().take(36).collect();
        let pad = " ".repeat(usize::from(column.saturating_sub(width(&name))) + 2);
        let style = if n == list.chosen {
            ink.time().add_modifier(Modifier::BOLD)
        } else {
            ink.text()
        };
        lines.push(vec![
            (format!("{mark}{name}{pad}"), style),
            (choice.title.clone(), ink.faint()),
        ]);
    }
    lines.push(Vec::new());
    lines.push(vec![(
        "↑ ↓ choose   Enter opens   Esc goes back".to_owned(),
        ink.faint(),
    )]);
    sheet("scenes and runs", &lines, None, area, buf, ink);
}

/// The panel of parameters.
pub fn parameters(panel: &Panel, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let mut lines: Vec<StyledLine> = Vec::new();
    for (n, (name, unit, _)) in Panel::FIELDS.iter().enumerate() {
        let here = n == panel.field;
        let mark = if here { "▸ " } else { "  " };
        let changed = panel.values[n] != panel.before[n];
        let style = if here {
            ink.time().add_modifier(Modifier::BOLD)
        } else if changed {
            ink.of_colour(ink.theme.backward)
        } else {
            ink.text()
        };
        let shown = panel.shown(n, ['◂', '▸', '▏']);
        lines.push(vec![
            (format!("{mark}{name:<18}"), style),
            (format!("{shown:<20}"), style),
            (format!("{unit:<4}"), ink.faint()),
        ]);
    }
    lines.push(Vec::new());
    if let Some(problem) = &panel.problem {
        let room = usize::from(area.width.saturating_sub(6));
        for text in problem.lines().filter(|line| !line.trim().is_empty()) {
            let text: String = text.chars().take(room).collect();
            lines.push(vec![(text, ink.of_colour(ink.alarm_colour()))]);
        }
        lines.push(Vec::new());
    }
    lines.push(vec![(
        "type a value   ↑ ↓ field   Enter starts anew   Esc".to_owned(),
        ink.faint(),
    )]);
    sheet("parameters", &lines, None, area, buf, ink);
}

/// Why nothing can be shown.
pub fn error(why: &str, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let room = usize::from(area.width.saturating_sub(6)).max(10);
    let mut lines: Vec<StyledLine> = Vec::new();
    for line in why.lines() {
        for piece in wrapped(line, room) {
            lines.push(vec![(piece, ink.text())]);
        }
    }
    lines.push(Vec::new());
    lines.push(vec![("o opens a scene   q quits".to_owned(), ink.faint())]);
    sheet(
        "this cannot be shown",
        &lines,
        Some(ink.alarm_colour()),
        area,
        buf,
        ink,
    );
}

fn wrapped(line: &str, room: usize) -> Vec<String> {
    let mut pieces = vec![String::new()];
    for word in line.split_inclusive(' ') {
        let last = pieces.last().map_or(0, |p| p.chars().count());
        if last > 0 && last + word.chars().count() > room {
            pieces.push(String::new());
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push_str(word);
        }
    }
    pieces
}
