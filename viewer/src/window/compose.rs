//! From the state to pixels: what the window shows, and what its PNG shows.

use super::places::Places;
use super::state::{Overlay, Stage, State};
use super::{sheets, strip};
use crate::draw::{Look, Pane, draw};
use crate::raster::Raster;
use crate::text::{self, Style, Weight};
use loschmidt_runner::{ArithmeticKind, Arrow};

/// The pixels of a window of `width` times `height` pixels: a function of the state alone.
#[must_use]
pub fn compose(state: &State, (width, height): (usize, usize)) -> Raster {
    let mut raster = match &state.stage {
        Some(stage) => {
            let places = Places::with(state, stage, (width, height));
            let theme = &state.look.theme;
            let mut raster = picture(state, stage, &places).extended(height, theme.panel);
            strip::paint(&mut raster, state, stage, &places);
            if let Some(arrival) = &state.banner {
                sheets::banner(&mut raster, arrival, theme, &places);
            }
            raster
        }
        None => waiting(state, width, height),
    };
    match &state.overlay {
        Overlay::None => {}
        Overlay::Help => sheets::help(&mut raster, &state.look.theme),
        Overlay::Error(why) => sheets::error(&mut raster, why, &state.look.theme),
    }
    raster
}

/// The rasteriser's picture of the players.
fn picture(state: &State, stage: &Stage, places: &Places) -> Raster {
    let look = look(state, stage);
    let name = |kind| match kind {
        ArithmeticKind::Fixed => "fixed point",
        ArithmeticKind::Float => "floating point",
    };
    let mut first = Pane::new(&stage.frame, &stage.ways.history);
    let size = (places.picture.width, places.picture.height);
    let Some(other) = &stage.other else {
        return draw(&[first], &stage.home, &look, size.0, size.1);
    };
    let asked = stage.opened.options.arithmetic;
    first.label = name(stage.status.arithmetic);
    let frame = other.frame.as_ref().unwrap_or(&stage.opened.home);
    let second = Pane {
        label: name(match asked {
            ArithmeticKind::Fixed => ArithmeticKind::Float,
            ArithmeticKind::Float => ArithmeticKind::Fixed,
        }),
        ..Pane::new(frame, &other.ways.history)
    };
    draw(&[first, second], &stage.home, &look, size.0, size.1)
}

/// The look with what follows from the state.
fn look(state: &State, stage: &Stage) -> Look {
    let particles = strip::count(stage.frame.id.len() as u64);
    Look {
        caption: format!("{particles} particles"),
        turn: Some(f64::from(u8::from(stage.arrow() == Arrow::Backward))),
        ..state.look.clone()
    }
}

/// A scene is being set up.
fn waiting(state: &State, width: usize, height: usize) -> Raster {
    let theme = &state.look.theme;
    let mut raster = Raster::new(width, height, theme.background);
    if state.overlay == Overlay::None {
        let style = Style {
            size: (height / 30).clamp(8, 64),
            weight: Weight::Medium,
            colour: theme.faint,
        };
        let text = format!("setting up {} …", state.request.name);
        let text = text::fitted(&style, &text, width as f64);
        text::write_around(
            &mut raster,
            &style,
            0.5 * width as f64,
            height as i64 / 2,
            &text,
        );
    }
    raster
}
