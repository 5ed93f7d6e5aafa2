//! Where the parts of the window are: the picture above, and below it a strip with the bar of time.

use super::state::WindowState;
use crate::draw::PictureLayout;
use crate::home::Home;
use crate::look::Look;
use crate::raster::Rect;
use crate::session::StagedScene;

/// The smallest window with a strip, pixels.
const SMALLEST: (usize, usize) = (160, 120);

/// Where the parts of the window are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Places {
    /// The picture.
    pub picture: Rect,
    /// The particles of every player.
    pub fields: Vec<Rect>,
    /// Those of the first one.
    pub field: Rect,
    /// Below the picture; no pixels high where there is no room.
    pub strip: Rect,
    /// The line that stands for time.
    pub bar: Rect,
    /// Size of plain text, pixels.
    pub em: usize,
}

impl Places {
    /// The places of a window; `None` as long as it shows nothing.
    #[must_use]
    pub fn of(state: &WindowState) -> Option<Self> {
        let stage = state.session.stage.as_ref()?;
        Some(Self::with(state, stage, state.size))
    }

    /// The places in a window of this size, pixels.
    #[must_use]
    pub fn with(state: &WindowState, stage: &StagedScene, size: (usize, usize)) -> Self {
        let panes = 1 + usize::from(stage.other.is_some());
        Self::sized(&stage.home, &state.session.look, panes, state.scale, size)
    }

    /// The places for so many players. `scale`: pixels that make one of a plain display.
    #[must_use]
    pub fn sized(
        home: &Home,
        look: &Look,
        panes: usize,
        scale: f64,
        (width, height): (usize, usize),
    ) -> Self {
        let plain = PictureLayout::new(home, look, 1, width, height).em;
        // Readable on a display of many pixels, however small the window.
        let em = plain.max((11.0 * scale) as usize).min(height / 8);
        let high = if width < SMALLEST.0 || height < SMALLEST.1 {
            0
        } else {
            9 * em / 2
        };
        let picture = Rect::new(0, 0, width, height - high);
        let layout = PictureLayout::new(home, look, panes, picture.width, picture.height);
        let ends = (5 * em).min(width / 4);
        Self {
            picture,
            field: layout.fields.first().copied().unwrap_or_default(),
            fields: layout.fields,
            strip: Rect::new(0, height - high, width, high),
            bar: Rect::new(ends, height - high + em, width - 2 * ends, em),
            em,
        }
    }

    /// Whether a place is on the bar of time, or so near that it is meant.
    #[must_use]
    pub fn on_bar(&self, [x, y]: [f64; 2]) -> bool {
        let (bar, near) = (self.bar, self.em as f64 / 2.0);
        self.strip.height > 0
            && x >= bar.x as f64 - near
            && x < (bar.x + bar.width) as f64 + near
            && y >= bar.y as f64 - near
            && y < (bar.y + bar.height) as f64 + near
    }

    /// The field of particles at a place.
    #[must_use]
    pub fn field_at(&self, [x, y]: [f64; 2]) -> Option<Rect> {
        let inside = |rect: &&Rect| {
            x >= rect.x as f64
                && x < (rect.x + rect.width) as f64
                && y >= rect.y as f64
                && y < (rect.y + rect.height) as f64
        };
        self.fields.iter().find(inside).copied()
    }

    /// The step that a place on the bar stands for; the nearest end beside it.
    #[must_use]
    pub fn step_at(&self, [x, _]: [f64; 2], span: i64) -> i64 {
        let last = self.bar.width.saturating_sub(1).max(1) as f64;
        let part = ((x - self.bar.x as f64) / last).clamp(0.0, 1.0);
        (part * span as f64).round() as i64
    }

    /// The place on the bar of a step, pixels from the left.
    #[must_use]
    pub fn bar_at(&self, step: i64, span: i64) -> f64 {
        let last = self.bar.width.saturating_sub(1) as f64;
        let part = (step as f64 / span.max(1) as f64).clamp(0.0, 1.0);
        self.bar.x as f64 + part * last + 0.5
    }
}
