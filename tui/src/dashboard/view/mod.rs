//! The views: pure functions of the state into a buffer.
//!
//! Everything is drawn in true colours; where a terminal has fewer, they are reduced at the end.

mod banner;
mod bar;
mod dots;
mod energies;
mod entropy;
mod field;
mod header;
mod ink;
mod numbers;
mod overlays;
mod plot;
mod reduce;
mod speeds;

use super::state::DashboardState;
use ink::Ink;
use loschmidt_viewer::session::{Overlay, StagedScene};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

/// The smallest terminal with everything in it.
pub const SMALLEST: (u16, u16) = (60, 20);

/// Where the parts of the screen are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Areas {
    pub header: Rect,
    pub field: Rect,
    pub legend: Rect,
    pub energies: Rect,
    pub entropy: Rect,
    pub speeds: Rect,
    /// The bar of time, and the room for its ends left and right.
    pub bar: Rect,
    pub time: Rect,
    pub notice: Rect,
    pub hints: Rect,
}

impl Areas {
    /// The areas of a terminal of so many columns and rows.
    pub fn of((columns, rows): (u16, u16)) -> Self {
        let wide = columns >= 90;
        let roomy = rows >= 36;
        let header = if roomy { 3 } else { 2 };
        let foot = 3;
        let body = Rect::new(0, header, columns, rows.saturating_sub(header + foot));
        let time = Rect::new(0, body.bottom(), columns, 1);
        let ends = 9.min(columns / 4);
        let mut areas = Self {
            header: Rect::new(0, 0, columns, header),
            time,
            bar: Rect::new(ends, time.y, columns.saturating_sub(2 * ends), 1),
            notice: Rect::new(0, time.y + 1, columns, 1),
            hints: Rect::new(0, time.y + 2, columns, 1),
            ..Self::default()
        };
        if wide {
            areas.beside(body, columns, roomy);
        } else {
            areas.below(body);
        }
        areas
    }

    /// Plots to the right of the field.
    fn beside(&mut self, body: Rect, columns: u16, roomy: bool) {
        let plots = (columns * 2 / 5).clamp(38, 90);
        let field = columns - plots - 3;
        self.field = Rect::new(1, body.y, field, body.height.saturating_sub(1));
        self.legend = Rect::new(1, self.field.bottom(), field, 1);
        let x = field + 3;
        let width = plots - 1;
        let gap = u16::from(roomy);
        let room = body.height.saturating_sub(2 * gap);
        let speeds = room * 3 / 10;
        let energies = (room - speeds) / 2 + 1;
        let entropy = room - speeds - energies;
        self.energies = Rect::new(x, body.y, width, energies);
        self.entropy = Rect::new(x, self.energies.bottom() + gap, width, entropy);
        self.speeds = Rect::new(x, self.entropy.bottom() + gap, width, speeds);
    }

    /// Plots below the field, side by side.
    fn below(&mut self, body: Rect) {
        let plots = (body.height * 2 / 5).max(5).min(body.height);
        let field = (body.height - plots).saturating_sub(1);
        self.field = Rect::new(0, body.y, body.width, field);
        self.legend = Rect::new(0, self.field.bottom(), body.width, 1);
        let y = body.bottom() - plots;
        let half = body.width / 2;
        self.energies = Rect::new(0, y, half.saturating_sub(1), plots);
        self.entropy = Rect::new(half, y, body.width - half, plots);
    }

    /// The step that a column of the bar stands for.
    pub fn steps_at(&self, column: u16, span: i64) -> i64 {
        let last = i64::from(self.bar.width.max(2)) - 1;
        let place = (i64::from(column) - i64::from(self.bar.x)).clamp(0, last);
        (place * span + last / 2) / last
    }
}

impl Widget for &DashboardState {
    fn render(self, area: Rect, buf: &mut Buffer) {
        let ink = Ink::of(self);
        buf.set_style(area, ink.page());
        let areas = Areas::of((area.width, area.height));
        if area.width < SMALLEST.0 || area.height < SMALLEST.1 {
            too_small(area, buf, &ink);
        } else {
            match &self.session.stage {
                Some(stage) => self.stage(stage, &areas, area, buf, &ink),
                None => self.waiting(area, buf, &ink),
            }
            match &self.session.overlay {
                Overlay::None => {}
                Overlay::Help => overlays::help(self.help_line, area, buf, &ink),
                Overlay::Scenes(list) => overlays::scenes(list, area, buf, &ink),
                Overlay::Parameters(panel) => overlays::parameters(panel, area, buf, &ink),
                Overlay::Error(why) => overlays::error(why, area, buf, &ink),
            }
        }
        reduce::colours(buf, area, self.depth);
    }
}

impl DashboardState {
    fn stage(&self, stage: &StagedScene, areas: &Areas, whole: Rect, buf: &mut Buffer, ink: &Ink) {
        header::render(stage, areas.header, buf, ink);
        field::render(stage, &self.session.look, self.depth, areas.field, buf, ink);
        field::legend(stage, &self.session.look, areas, buf, ink);
        energies::render(stage, areas.energies, buf, ink);
        entropy::render(stage, areas.entropy, buf, ink);
        speeds::render(stage, areas.speeds, buf, ink);
        bar::time(stage, areas, buf, ink);
        bar::notice(stage, self.session.notice.as_ref(), areas.notice, buf, ink);
        bar::hints(stage, areas.hints, buf, ink);
        if let Some(arrival) = &self.session.banner {
            banner::render(arrival, areas.field, whole, buf, ink);
        }
    }

    /// A scene is being set up.
    fn waiting(&self, area: Rect, buf: &mut Buffer, ink: &Ink) {
        let text = format!("setting up {} …", self.session.request.name);
        let x = area.x + area.width.saturating_sub(text.chars().count() as u16) / 2;
        let y = area.y + area.height / 2;
        buf.set_stringn(x, y, &text, area.width.into(), ink.faint());
    }
}

fn too_small(area: Rect, buf: &mut Buffer, ink: &Ink) {
    let text = format!("at least {} x {}", SMALLEST.0, SMALLEST.1);
    let y = area.y + area.height / 2;
    let x = area.x + area.width.saturating_sub(text.len() as u16) / 2;
    buf.set_stringn(x, y, text, area.width.into(), ink.text());
}

/// Pieces of text with their styles.
type Piece = (String, Style);

/// Writes pieces one after the other, as many as fit whole; returns the column after the last.
fn write(buf: &mut Buffer, area: Rect, row: u16, pieces: &[Piece]) -> u16 {
    let mut x = area.x;
    if row >= area.bottom() {
        return x;
    }
    for (text, style) in pieces {
        let room = area.right().saturating_sub(x);
        if width(text) > room {
            break;
        }
        x = buf.set_stringn(x, row, text, room.into(), *style).0;
    }
    x
}

/// Writes pieces up to the right edge.
fn write_right(buf: &mut Buffer, area: Rect, row: u16, pieces: &[Piece]) {
    let wide: u16 = pieces.iter().map(|(text, _)| width(text)).sum();
    if wide <= area.width {
        let x = area.right() - wide;
        write(buf, Rect::new(x, area.y, wide, area.height), row, pieces);
    }
}

/// Columns of a text; every character here takes one.
fn width(text: &str) -> u16 {
    text.chars().count() as u16
}
