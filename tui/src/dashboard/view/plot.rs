//! Curves over physical time. On the way back time falls, and the curve runs back over itself: the
//! way out stands back, and the way back is drawn over it in full.

use super::dots::Dots;
use super::ink::Ink;
use super::numbers::{quantity, short};
use super::{width, write_right};
use loschmidt_runner::run::Row;
use loschmidt_viewer::{Rgb, Track};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

/// What is drawn of a row.
pub type RowValue<'a> = &'a dyn Fn(&Row) -> Option<f64>;

/// A curve.
pub struct DotCurve<'a> {
    pub colour: Rgb,
    pub value: RowValue<'a>,
    /// Its colour on the way back, where that is another.
    pub back: Option<Rgb>,
    /// Drawn with gaps: an equilibrium, not a state.
    pub reference: bool,
}

/// Curves with a common pair of axes.
pub struct DotPlot<'a> {
    pub track: &'a Track,
    pub curves: &'a [DotCurve<'a>],
    /// Ends of the upward axis.
    pub range: [f64; 2],
    /// The end of the axis of time, s.
    pub span: f64,
    /// The present, s.
    pub now: f64,
}

/// Columns for the numbers at the upward axis.
const MARGIN: u16 = 7;

impl DotPlot<'_> {
    /// Draws the plot; nothing where there is no room.
    pub fn render(&self, area: Rect, buf: &mut Buffer, ink: &Ink) {
        if area.height < 2 || area.width < MARGIN + 4 {
            return;
        }
        let axes = Rect::new(
            area.x + MARGIN,
            area.y,
            area.width - MARGIN,
            area.height - 1,
        );
        self.axes(area, axes, buf, ink);
        let mut dots = Dots::new(axes.width, axes.height);
        let returning = !self.track.back().is_empty();
        for curve in self.curves.iter().rev() {
            let out = if returning && !curve.reference {
                ink.muted(curve.colour)
            } else {
                curve.colour
            };
            self.curve(&mut dots, self.track.out(), curve, out, false);
        }
        if returning {
            for curve in self.curves.iter().rev().filter(|c| !c.reference) {
                let colour = curve.back.unwrap_or(curve.colour);
                self.curve(&mut dots, self.track.back(), curve, colour, true);
            }
        }
        dots.render(axes, buf);
    }

    fn axes(&self, area: Rect, axes: Rect, buf: &mut Buffer, ink: &Ink) {
        let [low, high] = self.range;
        for y in axes.top()..axes.bottom() {
            buf[(axes.x - 1, y)].set_char('│').set_style(ink.rule());
        }
        for x in axes.left()..axes.right() {
            buf[(x, axes.bottom())].set_char('─').set_style(ink.rule());
        }
        buf[(axes.x - 1, axes.bottom())]
            .set_char('└')
            .set_style(ink.rule());
        let numbers = Rect::new(area.x, area.y, MARGIN - 1, area.height);
        write_right(buf, numbers, axes.y, &[(short(high), ink.faint())]);
        write_right(
            buf,
            numbers,
            axes.bottom() - 1,
            &[(short(low), ink.faint())],
        );
        let end = format!(" {}", quantity(self.span, "s", 3));
        let x = axes.right().saturating_sub(width(&end));
        buf.set_string(x, axes.bottom(), end, ink.faint());
        buf.set_string(axes.x, axes.bottom(), "0 ", ink.faint());
        // The present.
        let part = (self.now / self.span.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let x = axes.x + (part * f64::from(axes.width - 1)).round() as u16;
        for y in axes.top()..axes.bottom() {
            buf[(x, y)].set_char('┊').set_style(ink.rule());
        }
        buf[(x, axes.bottom())].set_char('▲').set_style(ink.time());
    }

    fn curve(&self, dots: &mut Dots, rows: &[Row], curve: &DotCurve<'_>, colour: Rgb, bold: bool) {
        let (width, height) = dots.size();
        let [low, high] = self.range;
        let mut last: Option<[f64; 2]> = None;
        for (n, row) in rows.iter().enumerate() {
            let here = (curve.value)(row).map(|value| {
                let part = (value - low) / (high - low).max(f64::MIN_POSITIVE);
                let x = row.time_s / self.span.max(f64::MIN_POSITIVE) * (width - 1.0);
                [x, (1.0 - part) * (height - 1.0)]
            });
            match (last, here) {
                (Some(a), Some(b)) => dots.line(a, b, colour, bold, curve.reference),
                (None, Some([x, y])) if n + 1 == rows.len() => dots.dot(x, y, colour, bold),
                _ => {}
            }
            last = here;
        }
    }
}
