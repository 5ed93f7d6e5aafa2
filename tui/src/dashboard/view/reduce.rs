//! True colours as those that a terminal has.

use super::super::state::Depth;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Color;

/// Reduces the colours of an area.
pub fn colours(buf: &mut Buffer, area: Rect, depth: Depth) {
    if depth == Depth::True {
        return;
    }
    for y in area.top()..area.bottom() {
        for x in area.left()..area.right() {
            let cell = &mut buf[(x, y)];
            cell.fg = foreground(cell.fg, depth);
            cell.bg = background(cell.bg, depth);
        }
    }
}

fn foreground(colour: Color, depth: Depth) -> Color {
    match (colour, depth) {
        (Color::Rgb(r, g, b), Depth::Indexed) => Color::Indexed(cube(r, g, b)),
        (Color::Rgb(r, g, b), Depth::Basic) => basic(r, g, b),
        (_, Depth::None) => Color::Reset,
        (colour, _) => colour,
    }
}

/// With 16 colours the ground is the terminal's own, except for badges, whose ground is bright.
fn background(colour: Color, depth: Depth) -> Color {
    match (colour, depth) {
        (Color::Rgb(r, g, b), Depth::Indexed) => Color::Indexed(cube(r, g, b)),
        (Color::Rgb(r, g, b), Depth::Basic) if r.max(g).max(b) > 0x90 => basic(r, g, b),
        _ => Color::Reset,
    }
}

/// The nearest of the colour cube and the ramp of greys.
fn cube(r: u8, g: u8, b: u8) -> u8 {
    const STEPS: [i32; 6] = [0, 95, 135, 175, 215, 255];
    let nearest = |v: u8| {
        let far = |s: i32| (s - i32::from(v)).abs();
        (0..6).min_by_key(|&n| far(STEPS[n])).unwrap_or(0)
    };
    let distance = |c: [i32; 3]| {
        let of = [r, g, b];
        (0..3)
            .map(|k| (c[k] - i32::from(of[k])).pow(2))
            .sum::<i32>()
    };
    let (nr, ng, nb) = (nearest(r), nearest(g), nearest(b));
    let in_cube = distance([STEPS[nr], STEPS[ng], STEPS[nb]]);
    let mean = (i32::from(r) + i32::from(g) + i32::from(b)) / 3;
    let grey = ((mean - 3) / 10).clamp(0, 23);
    let in_ramp = distance([8 + 10 * grey; 3]);
    if in_ramp < in_cube {
        232 + grey as u8
    } else {
        (16 + 36 * nr + 6 * ng + nb) as u8
    }
}

/// One of the 16 colours, by hue; greys by lightness.
fn basic(r: u8, g: u8, b: u8) -> Color {
    let (low, high) = (r.min(g).min(b), r.max(g).max(b));
    if u32::from(high - low) * 4 < u32::from(high) {
        return match high {
            0..=0x70 => Color::DarkGray,
            0x71..=0xb0 => Color::Gray,
            _ => Color::Reset,
        };
    }
    let strong = |v: u8| u32::from(v - low) * 2 > u32::from(high - low);
    match (strong(r), strong(g), strong(b)) {
        (true, true, false) => Color::Yellow,
        (true, false, true) => Color::Magenta,
        (false, true, true) => Color::Cyan,
        (true, false, false) => Color::Red,
        (false, true, false) => Color::Green,
        (false, false, true) => Color::Blue,
        _ => Color::Reset,
    }
}
