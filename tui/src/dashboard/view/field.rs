//! The fluid, from the shared rasteriser: two pixels to a cell, or eight dots where colours are
//! few.

use super::super::state::Depth;
use super::ink::{Ink, colour};
use super::{Areas, width, write_right};
use loschmidt_runner::figures;
use loschmidt_viewer::ruler::Ruler;
use loschmidt_viewer::session::StagedScene;
use loschmidt_viewer::{Look, Projection, Raster, Rgb, field};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

/// Draws the field.
pub fn render(
    stage: &StagedScene,
    look: &Look,
    depth: Depth,
    area: Rect,
    buf: &mut Buffer,
    ink: &Ink,
) {
    let (columns, rows) = (usize::from(area.width), usize::from(area.height));
    if columns == 0 || rows == 0 {
        return;
    }
    if depth.has_pixels() {
        let raster = field(&stage.points, &stage.home, look, columns, 2 * rows);
        half_blocks(&raster, area, buf);
    } else {
        let raster = field(&stage.points, &stage.home, look, 2 * columns, 4 * rows);
        braille(&raster, look.theme.background, area, buf);
    }
    mark(stage, look, area, buf, ink);
}

/// The upper pixel is the foreground of a cell and the lower one its ground.
fn half_blocks(raster: &Raster, area: Rect, buf: &mut Buffer) {
    let width = raster.width();
    let rows = raster.pixels().chunks_exact(2 * width);
    for (y, pair) in (area.top()..area.bottom()).zip(rows) {
        let (upper, lower) = pair.split_at(width);
        for (x, (&upper, &lower)) in (area.left()..area.right()).zip(upper.iter().zip(lower)) {
            let cell = &mut buf[(x, y)];
            if upper == lower {
                cell.set_char(' ').set_bg(colour(Rgb(lower)));
            } else {
                cell.set_char('▀')
                    .set_fg(colour(Rgb(upper)))
                    .set_bg(colour(Rgb(lower)));
            }
        }
    }
}

/// A dot where a pixel is more than half covered; the colour of a cell is the mean of its dots.
fn braille(raster: &Raster, background: Rgb, area: Rect, buf: &mut Buffer) {
    const BITS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];
    let ground = background.channels();
    for row in 0..area.height {
        for column in 0..area.width {
            let (mut mask, mut sum, mut dots) = (0, [0u32; 3], 0);
            for (dx, bits) in BITS.iter().enumerate() {
                for (dy, bit) in bits.iter().enumerate() {
                    let at = raster.at(2 * usize::from(column) + dx, 4 * usize::from(row) + dy);
                    let pixel = at.channels();
                    let away: u32 = (0..3)
                        .map(|k| u32::from(pixel[k].abs_diff(ground[k])))
                        .sum();
                    if away > 90 {
                        mask |= bit;
                        dots += 1;
                        (0..3).for_each(|k| sum[k] += u32::from(pixel[k]));
                    }
                }
            }
            let symbol = char::from_u32(0x2800 + mask).filter(|_| mask != 0);
            let cell = &mut buf[(area.x + column, area.y + row)];
            cell.set_char(symbol.unwrap_or(' '));
            if dots > 0 {
                cell.set_fg(colour(Rgb::of(sum.map(|s| (s / dots) as u8))));
            }
        }
    }
}

/// The particle whose bit was flipped.
fn mark(stage: &StagedScene, look: &Look, area: Rect, buf: &mut Buffer, ink: &Ink) {
    let Some(particle) = stage.flipped_at() else {
        return;
    };
    let (width, height) = (usize::from(area.width), 2 * usize::from(area.height));
    let projection = Projection::new(&stage.home, &look.view, width, height);
    let Some(at) = projection.project(particle) else {
        return;
    };
    if !(at.x >= 0.0 && at.y >= 0.0 && at.x < width as f64 && at.y < height as f64) {
        return;
    }
    let cell = &mut buf[(area.x + at.x as u16, area.y + (at.y / 2.0) as u16)];
    cell.set_char('✱').set_fg(colour(ink.alarm_colour()));
    cell.modifier.insert(Modifier::BOLD);
}

/// What the colours say: the name, the ends and the colours between.
pub fn legend(stage: &StagedScene, look: &Look, areas: &Areas, buf: &mut Buffer, ink: &Ink) {
    let area = areas.legend;
    if area.height == 0 {
        return;
    }
    let colouring = &look.colouring;
    let range = look.range.unwrap_or_else(|| colouring.range(&stage.home));
    let ([low, _, high], scale) = figures::ticks(range, colouring.unit());
    let high = format!("{high} {}", scale.name());
    let title = colouring.title();
    let ruler = ruler(stage, look, areas.field);
    let words = width(title) + width(&low) + width(&high) + 6 + width(&ruler);
    let steps = area.width.saturating_sub(words).min(40);
    let mut x = buf
        .set_stringn(area.x + 1, area.y, title, area.width.into(), ink.bold())
        .0;
    x = buf.set_stringn(x + 1, area.y, &low, 12, ink.faint()).0 + 1;
    let map = look.palette();
    for n in 0..steps {
        let part = |k: u16| f64::from(2 * n + k) / f64::from((2 * steps).max(2) - 1);
        // Half a cell is the finest step there is.
        buf[(x + n, area.y)]
            .set_char(if ink.depth.has_pixels() { '▌' } else { '■' })
            .set_fg(colour(map.at(part(0))))
            .set_bg(if ink.depth.has_pixels() {
                colour(map.at(part(1)))
            } else {
                colour(ink.theme.background)
            });
    }
    x += steps + 1;
    let room = area.right().saturating_sub(x);
    let end = buf
        .set_stringn(x, area.y, &high, room.into(), ink.faint())
        .0;
    let rest = Rect::new(end, area.y, area.right().saturating_sub(end), 1);
    write_right(buf, rest, area.y, &[(ruler, ink.faint())]);
}

/// A bar as long as it says, in cells of the field.
fn ruler(stage: &StagedScene, look: &Look, field: Rect) -> String {
    let (width, height) = (usize::from(field.width), 2 * usize::from(field.height));
    let projection = Projection::new(&stage.home, &look.view, width, height);
    let most = (width as f64 / 6.0).min(24.0);
    let ruler = Ruler::new(&projection, most).filter(|ruler| ruler.pixels >= 1.5);
    ruler.map_or_else(String::new, |ruler| {
        let between = (ruler.pixels.round() as usize).saturating_sub(2);
        format!("├{}┤ {}", "─".repeat(between), ruler.text())
    })
}
