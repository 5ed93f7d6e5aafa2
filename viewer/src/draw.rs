//! The whole picture: one or two fields of particles, and a panel with time, arrow, plots and
//! legend.
//!
//! The panel stands to the right of the fields or below them, where it leaves them more room.
//! Sizes follow from the em, which follows from the size of the picture: readable from 320 x 240
//! to 4K.

use crate::camera::{Projection, View};
use crate::colour::Rgb;
use crate::colouring::Colouring;
use crate::field;
use crate::history::History;
use crate::home::Home;
pub use crate::look::Look;
use crate::plot;
use crate::raster::{Mask, Pixels, Raster, Rect};
use crate::ruler;
use crate::text::{self, TextStyle, Weight};
use loschmidt_runner::Points;
use loschmidt_runner::figures::{self, Scale};
use std::cell::RefCell;

/// A run in the picture.
#[derive(Clone, Copy, Debug)]
pub struct Pane<'a> {
    /// Its particles and their time.
    pub points: &'a Points,
    /// Its energies and entropies so far.
    pub history: &'a History,
    /// Its name; may be empty.
    pub label: &'a str,
    /// How it is coloured, where that differs from the look.
    pub colouring: Option<&'a Colouring>,
}

impl<'a> Pane<'a> {
    /// A run without a name, coloured as the look says.
    #[must_use]
    pub fn new(points: &'a Points, history: &'a History) -> Self {
        Self {
            points,
            history,
            label: "",
            colouring: None,
        }
    }
}

/// Where the parts of a picture are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureLayout {
    /// The particles, one rectangle per pane.
    pub fields: Vec<Rect>,
    /// Plots and text; `None` without a panel.
    pub panel: Option<Rect>,
    /// Whether the panel is to the right.
    pub beside: bool,
    /// Size of plain text, pixels.
    pub em: usize,
}

/// The smallest picture with a panel, pixels.
const SMALLEST: (usize, usize) = (200, 150);

impl PictureLayout {
    /// The layout of a picture of `width` times `height` pixels with so many panes.
    #[must_use]
    pub fn new(home: &Home, look: &Look, panes: usize, width: usize, height: usize) -> Self {
        let em = (5 + height.min(width * 9 / 16) / 50).max(10);
        let whole = Rect::new(0, 0, width, height);
        if !look.panel || width < SMALLEST.0 || height < SMALLEST.1 {
            return Self {
                fields: side_by_side(whole, panes),
                panel: None,
                beside: false,
                em,
            };
        }
        let column = (15 * em).min(width / 2);
        let bar = (13 * em / 2).min(height / 2);
        let beside = Rect::new(0, 0, width - column, height);
        let above = Rect::new(0, 0, width, height - bar);
        let size = home.laid_out.size();
        let aspect = if home.dimension == 2 && size[1] > 0.0 {
            size[0] / size[1]
        } else {
            1.3
        };
        let scale = |fields: Rect| {
            let width = fields.width as f64 / panes.max(1) as f64;
            (width / aspect).min(fields.height as f64)
        };
        let to_the_right = scale(beside) > scale(above);
        let (fields, panel) = if to_the_right {
            (beside, Rect::new(width - column, 0, column, height))
        } else {
            (above, Rect::new(0, height - bar, width, bar))
        };
        Self {
            fields: side_by_side(fields, panes),
            panel: Some(panel),
            beside: to_the_right,
            em,
        }
    }
}

fn side_by_side(all: Rect, panes: usize) -> Vec<Rect> {
    let edge = |n: usize| all.x + all.width * n / panes.max(1);
    (0..panes)
        .map(|n| Rect::new(edge(n), all.y, edge(n + 1) - edge(n), all.height))
        .collect()
}

/// Draws one or more runs of a scene side by side; `width` and `height` in pixels.
///
/// The panel shows time, arrow and energy of the first.
#[must_use]
pub fn draw(panes: &[Pane<'_>], home: &Home, look: &Look, width: usize, height: usize) -> Raster {
    let mut raster = Raster::new(width, height, Rgb(0));
    draw_on(&mut raster.draw(), panes, home, look, height);
    raster
}

/// The same into the upper `height` rows of a raster, over whatever is there.
///
/// What of the panel is as in the last picture drawn by this thread is copied from it.
pub fn draw_on(
    raster: &mut Pixels<'_>,
    panes: &[Pane<'_>],
    home: &Home,
    look: &Look,
    height: usize,
) {
    let layout = PictureLayout::new(home, look, panes.len(), raster.width(), height);
    for (pane, &rect) in panes.iter().zip(&layout.fields) {
        let own = pane.colouring.map(|colouring| Look {
            colouring: colouring.clone(),
            ..look.clone()
        });
        field::paint(
            raster,
            rect,
            pane.points,
            home,
            own.as_ref().unwrap_or(look),
        );
        if layout.panel.is_some() {
            label(raster, rect, pane.label, look, layout.em);
            let projection = Projection::new(home, &look.view, rect.width, rect.height);
            ruler::paint(raster, rect, &projection, &look.theme, layout.em);
        }
    }
    let theme = &look.theme;
    for rect in layout.fields.iter().skip(1) {
        let width = (layout.em / 12).max(1);
        let line = Rect::new(rect.x - width / 2, rect.y, width, rect.height);
        raster.fill(line, theme.rule, 255);
    }
    if let (Some(panel), Some(first)) = (layout.panel, panes.first()) {
        let parts = Parts {
            panes,
            first,
            home,
            look,
            em: layout.em,
        };
        parts.paint(raster, panel, layout.beside);
    }
}

/// The name of a run in the upper corner of its field.
fn label(raster: &mut Pixels<'_>, rect: Rect, text: &str, look: &Look, em: usize) {
    let style = TextStyle {
        size: em,
        weight: Weight::SemiBold,
        colour: look.theme.text,
    };
    let text = text::fitted(&style, text, rect.width.saturating_sub(em) as f64);
    let middle = rect.x as f64 + 0.5 * rect.width as f64;
    text::write_around(raster, &style, middle, (rect.y + em + em / 2) as i64, &text);
}

/// All that the panel depends on but for its clock.
#[derive(PartialEq)]
struct PanelKey {
    size: (usize, usize),
    beside: bool,
    em: usize,
    name: String,
    range: [f64; 2],
    look: Look,
    histories: Vec<(String, u64)>,
}

thread_local! {
    /// The last panel, without its clock.
    static PANEL: RefCell<Option<(PanelKey, Raster)>> = const { RefCell::new(None) };
}

/// The parts of the panel.
struct Parts<'a> {
    panes: &'a [Pane<'a>],
    first: &'a Pane<'a>,
    home: &'a Home,
    look: &'a Look,
    em: usize,
}

impl Parts<'_> {
    /// The whole panel.
    fn paint(&self, raster: &mut Pixels<'_>, panel: Rect, beside: bool) {
        let look = self.look;
        let key = PanelKey {
            size: (panel.width, panel.height),
            beside,
            em: self.em,
            name: self.home.name.clone(),
            range: look.range.unwrap_or(look.colouring.range(self.home)),
            look: Look {
                view: View::default(),
                turn: None,
                ..look.clone()
            },
            histories: self
                .panes
                .iter()
                .map(|pane| (pane.label.to_owned(), pane.history.version()))
                .collect(),
        };
        let theme = &look.theme;
        PANEL.with_borrow_mut(|last| match last {
            Some((known, drawn)) if *known == key => raster.place(drawn, panel.x, panel.y),
            _ => {
                raster.fill(panel, theme.panel, 255);
                let edge = if beside {
                    Rect { width: 1, ..panel }
                } else {
                    Rect { height: 1, ..panel }
                };
                raster.fill(edge, theme.rule, 255);
                if beside {
                    self.column(raster, panel);
                } else {
                    self.bar(raster, panel);
                }
                *last = Some((key, raster.part(panel)));
            }
        });
        self.clock(raster, self.clock_place(panel, beside));
    }

    /// Where the time is: below the title.
    fn clock_place(&self, panel: Rect, beside: bool) -> Rect {
        let inner = self.inner(panel, beside);
        let y = inner.y + self.title_height();
        if beside {
            return Rect::new(inner.x, y, inner.width, 4 * self.em);
        }
        let height = inner.height.saturating_sub(self.title_height());
        Rect::new(inner.x, y, self.clock_width(inner), height)
    }

    fn clock_width(&self, inner: Rect) -> usize {
        (12 * self.em).min(inner.width)
    }

    /// The panel without its margins.
    fn inner(&self, panel: Rect, beside: bool) -> Rect {
        let em = self.em;
        if beside {
            return panel.shrunk(em);
        }
        Rect::new(
            panel.x + em,
            panel.y + em / 2,
            panel.width.saturating_sub(2 * em),
            panel.height.saturating_sub(em),
        )
    }

    fn style(&self, size: usize) -> TextStyle {
        TextStyle {
            size,
            weight: Weight::Medium,
            colour: self.look.theme.text,
        }
    }

    /// Size of small text, pixels.
    fn small(&self) -> usize {
        (self.em * 6 / 7).max(9)
    }

    fn has_legend(&self) -> bool {
        !matches!(self.look.colouring, Colouring::Picture(_))
    }

    /// From top to bottom: title, room for the time, plots, legend.
    fn column(&self, raster: &mut Pixels<'_>, panel: Rect) {
        let em = self.em;
        let inner = self.inner(panel, true);
        self.title(raster, inner);
        let y = inner.y + self.title_height() + 5 * em;
        let mut bottom = inner.y + inner.height;
        if self.has_legend() {
            let height = 7 * em / 2;
            bottom = bottom.saturating_sub(height);
            let rect = Rect::new(inner.x, bottom, inner.width, height);
            self.legend(raster, rect);
            bottom = bottom.saturating_sub(em);
        }
        let room = bottom.saturating_sub(y);
        let height = (room.saturating_sub(em) / 2).min(inner.width);
        if height >= 5 * em {
            self.energy(raster, Rect::new(inner.x, y, inner.width, height));
            let y = y + height + em;
            self.entropy(raster, Rect::new(inner.x, y, inner.width, height));
        } else if room >= 5 * em {
            self.entropy(raster, Rect::new(inner.x, y, inner.width, room));
        }
    }

    /// From left to right: title and room for the time, plots, legend.
    fn bar(&self, raster: &mut Pixels<'_>, panel: Rect) {
        let em = self.em;
        let inner = self.inner(panel, false);
        let clock = self.clock_width(inner);
        let width = clock;
        self.title(raster, Rect { width, ..inner });
        let mut left = inner.x + clock + em;
        let mut right = inner.x + inner.width;
        if self.has_legend() && right.saturating_sub(left) >= 8 * em {
            let width = (12 * em).min(right - left);
            right -= width;
            let height = 7 * em / 2;
            let y = inner.y + (inner.height - height) / 2;
            self.legend(raster, Rect::new(right, y, width, height));
            right = right.saturating_sub(3 * em / 2);
        }
        let room = right.saturating_sub(left);
        let plot = |x, width| Rect::new(x, inner.y, width, inner.height);
        if room >= 22 * em {
            let width = (room - 2 * em) / 2;
            self.energy(raster, plot(left, width));
            left += width + 2 * em;
            self.entropy(raster, plot(left, width));
        } else if room >= 7 * em {
            self.entropy(raster, plot(left, room));
        }
    }

    /// Height of title and caption.
    fn title_height(&self) -> usize {
        let caption = match self.look.caption.is_empty() {
            true => 0,
            false => self.small() * 7 / 5,
        };
        self.em * 6 / 5 + caption + self.em / 2
    }

    /// Title and caption.
    fn title(&self, raster: &mut Pixels<'_>, rect: Rect) {
        let em = self.em;
        let title = self.look.title.as_deref().unwrap_or(&self.home.name);
        let style = TextStyle {
            weight: Weight::SemiBold,
            ..self.style(em * 6 / 5)
        };
        let title = text::fitted(&style, title, rect.width as f64);
        let mut y = rect.y + em * 6 / 5;
        text::write(raster, &style, rect.x as f64, y as i64, &title);
        if !self.look.caption.is_empty() {
            let style = TextStyle {
                colour: self.look.theme.faint,
                ..self.style(self.small())
            };
            let caption = text::fitted(&style, &self.look.caption, rect.width as f64);
            y += self.small() * 7 / 5;
            text::write(raster, &style, rect.x as f64, y as i64, &caption);
        }
    }

    /// The arrow of time on a dial, the time, and which way it runs.
    fn clock(&self, raster: &mut Pixels<'_>, rect: Rect) {
        let theme = &self.look.theme;
        let points = self.first.points;
        let turn = self
            .look
            .turn
            .unwrap_or(f64::from(u8::from(points.way_back)))
            .clamp(0.0, 1.0);
        let colour = theme
            .forward
            .mix(theme.backward, (turn * 255.0).round() as u8);
        let radius = (rect.height as f64 / 2.0).min(1.7 * self.em as f64);
        let centre = [
            rect.x as f64 + radius,
            rect.y as f64 + rect.height as f64 / 2.0,
        ];
        dial(raster, centre, radius, turn, theme.rule, colour);
        let x = rect.x as f64 + 2.0 * radius + 0.7 * self.em as f64;
        let middle = centre[1] as i64;
        let big = TextStyle {
            weight: Weight::SemiBold,
            ..self.style(self.em * 10 / 7)
        };
        let time = Scale::of(self.home.span, "s").amount(points.time, 4);
        text::write(raster, &big, x, middle, &time);
        let small = TextStyle {
            colour,
            ..self.style(self.small())
        };
        let way = if turn > 0.5 { "backward" } else { "forward" };
        let y = middle + self.small() as i64 * 4 / 3;
        text::write(raster, &small, x, y, way);
    }

    fn energy(&self, raster: &mut Pixels<'_>, rect: Rect) {
        let history = self.first.history;
        plot::energy(raster, rect, history, &self.look.theme, self.small());
    }

    fn entropy(&self, raster: &mut Pixels<'_>, rect: Rect) {
        let runs: Vec<(&str, &History)> = self
            .panes
            .iter()
            .map(|pane| (pane.label, pane.history))
            .collect();
        plot::entropy(raster, rect, &runs, &self.look.theme, self.small());
    }

    /// The colour map between its numbers, with title and unit.
    fn legend(&self, raster: &mut Pixels<'_>, rect: Rect) {
        let colouring = &self.look.colouring;
        let range = self
            .look
            .range
            .unwrap_or_else(|| colouring.range(self.home));
        let ([low, middle, high], scale) = figures::ticks(range, colouring.unit());
        let style = self.style(self.small());
        let title = match scale.name() {
            unit if unit.is_empty() => colouring.title().to_owned(),
            unit => format!("{} / {unit}", colouring.title()),
        };
        let title = text::fitted(&style, &title, rect.width as f64);
        let size = style.size;
        text::write(
            raster,
            &style,
            rect.x as f64,
            (rect.y + size) as i64,
            &title,
        );
        let bar = Rect::new(rect.x, rect.y + size * 3 / 2, rect.width, size * 4 / 5);
        let map = self.look.palette();
        for column in 0..bar.width {
            let part = (column as f64 + 0.5) / bar.width as f64;
            let line = Rect::new(bar.x + column, bar.y, 1, bar.height);
            raster.fill(line, map.at(part), 255);
        }
        let faint = TextStyle {
            colour: self.look.theme.faint,
            ..style
        };
        let y = (bar.y + bar.height + size + size / 5) as i64;
        let x = rect.x as f64;
        let width = rect.width as f64;
        text::write(raster, &faint, x, y, &low);
        text::write_around(raster, &faint, x + 0.5 * width, y, &middle);
        text::write_left_of(raster, &faint, x + width, y, &high);
    }
}

/// A dial with one hand: to the right is forward, to the left backward.
fn dial(raster: &mut Pixels<'_>, centre: [f64; 2], radius: f64, turn: f64, ring: Rgb, colour: Rgb) {
    let room = Rect::new(
        (centre[0] - radius - 2.0).max(0.0) as usize,
        (centre[1] - radius - 2.0).max(0.0) as usize,
        (2.0 * radius + 5.0) as usize,
        (2.0 * radius + 5.0) as usize,
    );
    let width = 0.11 * radius;
    let mut mask = Mask::new(room);
    mask.ring(centre, radius - width, width.max(1.0));
    mask.paint(raster, ring, 255);
    let (sin, cos) = libm::sincos(std::f64::consts::PI * turn);
    // Along the hand, and across it; rows grow downwards.
    let at = |along: f64, across: f64| {
        [
            centre[0] + radius * (along * cos - across * sin),
            centre[1] - radius * (along * sin + across * cos),
        ]
    };
    let mut mask = Mask::new(room);
    mask.line(at(-0.58, 0.0), at(0.2, 0.0), 0.2 * radius);
    mask.triangle([at(0.64, 0.0), at(0.08, 0.36), at(0.08, -0.36)]);
    mask.paint(raster, colour, 255);
}
