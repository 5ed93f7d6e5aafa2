//! From the state to pixels: what the window shows, and what its PNG shows.

use super::places::Places;
use super::state::WindowState;
use super::{sheets, strip};
use crate::camera::Projection;
use crate::colour::Rgb;
use crate::draw::{Pane, draw_on};
use crate::look::Look;
use crate::raster::{Mask, Pixels, Raster, Rect};
use crate::session::{Overlay, Session, StagedScene, count};
use crate::text::{self, TextStyle, Weight};
use loschmidt_runner::{ArithmeticKind, Arrow};

/// The pixels of a window of `width` times `height` pixels: a function of the state alone.
#[must_use]
pub fn compose(state: &WindowState, (width, height): (usize, usize)) -> Raster {
    let mut raster = Raster::new(width, height, Rgb(0));
    compose_on(&mut raster.draw(), state);
    raster
}

/// The same over whatever is in a raster of the window's size.
pub fn compose_on(raster: &mut Pixels<'_>, state: &WindowState) {
    let size = (raster.width(), raster.height());
    let session = &state.session;
    let theme = &session.look.theme;
    match &session.stage {
        Some(stage) => {
            let places = Places::with(state, stage, size);
            picture(raster, session, stage, &places);
            mark(raster, session, stage, &places);
            let below = places.picture.height;
            let rest = Rect::new(0, below, size.0, size.1.saturating_sub(below));
            raster.fill(rest, theme.panel, 255);
            strip::paint(raster, session, stage, &places);
            if let Some(arrival) = &session.banner {
                sheets::banner(raster, arrival, theme, &places);
            }
        }
        None => waiting(raster, session),
    }
    match &session.overlay {
        Overlay::None => {}
        Overlay::Help => sheets::help(raster, theme),
        Overlay::Scenes(list) => sheets::scenes(raster, list, theme),
        Overlay::Parameters(panel) => sheets::parameters(raster, panel, theme),
        Overlay::Error(why) => sheets::error(raster, why, theme),
    }
}

/// The rasteriser's picture of the players.
fn picture(raster: &mut Pixels<'_>, session: &Session, stage: &StagedScene, places: &Places) {
    let look = look(session, stage);
    let name = |kind| match kind {
        ArithmeticKind::Fixed => "fixed point",
        ArithmeticKind::Float => "floating point",
    };
    let mut first = Pane::new(&stage.points, stage.track.history());
    let height = places.picture.height;
    let Some(other) = &stage.other else {
        return draw_on(raster, &[first], &stage.home, &look, height);
    };
    let asked = stage.opened.options.arithmetic;
    first.label = name(stage.status.arithmetic);
    let second = Pane {
        label: name(match asked {
            ArithmeticKind::Fixed => ArithmeticKind::Float,
            ArithmeticKind::Float => ArithmeticKind::Fixed,
        }),
        ..Pane::new(&other.points, other.track.history())
    };
    draw_on(raster, &[first, second], &stage.home, &look, height);
}

/// A ring around the particle whose bit was flipped.
fn mark(raster: &mut Pixels<'_>, session: &Session, stage: &StagedScene, places: &Places) {
    let (field, view) = (places.field, &session.look.view);
    let projection = Projection::new(&stage.home, view, field.width, field.height);
    let Some(at) = stage.flipped_at().and_then(|x| projection.project(x)) else {
        return;
    };
    let mut mask = Mask::new(field);
    let centre = [at.x + field.x as f64, at.y + field.y as f64];
    let radius = 0.6 * places.em as f64;
    mask.ring(centre, radius, 0.2 * radius);
    mask.paint(raster, session.look.theme.backward, 255);
}

/// The look with what follows from the state.
fn look(session: &Session, stage: &StagedScene) -> Look {
    let particles = count(stage.points.len() as u64);
    Look {
        caption: format!("{particles} particles"),
        turn: Some(f64::from(u8::from(stage.arrow() == Arrow::Backward))),
        ..session.look.clone()
    }
}

/// A scene is being set up.
fn waiting(raster: &mut Pixels<'_>, session: &Session) {
    let theme = &session.look.theme;
    let (width, height) = (raster.width(), raster.height());
    raster.fill(raster.rect(), theme.background, 255);
    if session.overlay == Overlay::None {
        let style = TextStyle {
            size: (height / 30).clamp(8, 64),
            weight: Weight::Medium,
            colour: theme.faint,
        };
        let text = format!("setting up {} …", session.request.name);
        let text = text::fitted(&style, &text, width as f64);
        text::write_around(raster, &style, 0.5 * width as f64, height as i64 / 2, &text);
    }
}
