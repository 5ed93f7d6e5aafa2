//! Lines in Braille: eight dots to a cell, one colour to a cell, the last one drawn.

use super::ink::colour;
use loschmidt_viewer::Rgb;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Modifier;

/// A canvas of dots.
pub struct Dots {
    cells: (usize, usize),
    mask: Vec<u8>,
    ink: Vec<(Rgb, bool)>,
}

/// The bit of a dot in its cell, by column and row.
const BITS: [[u8; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

impl Dots {
    /// A canvas of so many cells.
    pub fn new(columns: u16, rows: u16) -> Self {
        let cells = (usize::from(columns), usize::from(rows));
        Self {
            cells,
            mask: vec![0; cells.0 * cells.1],
            ink: vec![(Rgb(0), false); cells.0 * cells.1],
        }
    }

    /// Width and height in dots.
    pub fn size(&self) -> (f64, f64) {
        ((2 * self.cells.0) as f64, (4 * self.cells.1) as f64)
    }

    /// Draws the dot at this place, in dots from the top left; nothing outside.
    pub fn dot(&mut self, x: f64, y: f64, colour: Rgb, bold: bool) {
        let (width, height) = self.size();
        if !(x >= 0.0 && y >= 0.0 && x < width && y < height) {
            return;
        }
        let (x, y) = (x as usize, y as usize);
        let cell = y / 4 * self.cells.0 + x / 2;
        self.mask[cell] |= BITS[x % 2][y % 4];
        self.ink[cell] = (colour, bold);
    }

    /// Draws a line; a dashed one has gaps, at the same places whatever its pieces.
    pub fn line(&mut self, a: [f64; 2], b: [f64; 2], colour: Rgb, bold: bool, dashed: bool) {
        // The same dots in both directions: the way back must fall on the way out.
        let (a, b) = if (b[0], b[1]) < (a[0], a[1]) {
            (b, a)
        } else {
            (a, b)
        };
        let steps = (b[0] - a[0]).abs().max((b[1] - a[1]).abs()).ceil();
        if !steps.is_finite() || steps > 1e5 {
            return;
        }
        for n in 0..=steps as usize {
            let part = if steps > 0.0 { n as f64 / steps } else { 0.0 };
            let at = |k: usize| a[k] + part * (b[k] - a[k]);
            if !dashed || (at(0) as i64).rem_euclid(6) < 3 {
                self.dot(at(0), at(1), colour, bold);
            }
        }
    }

    /// Lays the dots over a buffer; cells without dots are left alone.
    pub fn render(&self, area: Rect, buf: &mut Buffer) {
        for (n, &mask) in self.mask.iter().enumerate() {
            if mask == 0 {
                continue;
            }
            let (x, y) = (n % self.cells.0, n / self.cells.0);
            let (x, y) = (area.x + x as u16, area.y + y as u16);
            if x >= area.right() || y >= area.bottom() {
                continue;
            }
            let (rgb, bold) = self.ink[n];
            let symbol = char::from_u32(0x2800 + u32::from(mask)).unwrap_or(' ');
            let cell = &mut buf[(x, y)];
            cell.set_char(symbol).set_fg(colour(rgb));
            if bold {
                cell.modifier.insert(Modifier::BOLD);
            }
        }
    }
}
