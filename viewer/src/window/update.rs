//! How the window's state changes, and what is asked for: what the mouse does in it, and what the
//! session makes of the rest.

use super::message::WindowMessage;
use super::places::Places;
use super::state::WindowState;
use crate::session::{self, Button, Drag, Effect, Mouse, Overlay};
use loschmidt_runner::deck::Command;

/// Magnification of a notch of the wheel.
const NOTCH: f64 = 1.15;

/// Changes the state; returns what is to be done.
pub fn update(state: &mut WindowState, message: impl Into<WindowMessage>) -> Vec<Effect> {
    let places = Places::of(state);
    if let Some(places) = &places {
        state.session.field = (places.field.width, places.field.height);
    }
    match message.into() {
        WindowMessage::Session(message) => session::update(&mut state.session, message),
        WindowMessage::Mouse(mouse, at) => on_mouse(state, places.as_ref(), mouse, at),
        WindowMessage::Resized(width, height, scale) => {
            state.size = (width, height);
            state.scale = scale;
            Vec::new()
        }
    }
}

fn on_mouse(
    state: &mut WindowState,
    places: Option<&Places>,
    mouse: Mouse,
    at: [f64; 2],
) -> Vec<Effect> {
    let session = &mut state.session;
    if session.overlay != Overlay::None {
        if matches!(mouse, Mouse::Press(_)) && session.overlay == Overlay::Help {
            session.overlay = Overlay::None;
        }
        return Vec::new();
    }
    let (Some(places), Some(stage)) = (places, &mut session.stage) else {
        return Vec::new();
    };
    match (mouse, session.drag) {
        (Mouse::Press(Button::Left), _) if places.on_bar(at) => {
            session.banner = None;
            let step = places.step_at(at, stage.span());
            return scrub(state, step);
        }
        (Mouse::Press(button), _) => {
            session.drag = places.field_at(at).map(|_| {
                let space = stage.home.dimension == 3 && button == Button::Left;
                if space {
                    Drag::Orbit(at)
                } else {
                    Drag::Pan(at)
                }
            });
        }
        (Mouse::Move, Some(Drag::Bar(last))) => {
            let step = places.step_at(at, stage.span());
            if step != last {
                return scrub(state, step);
            }
        }
        (Mouse::Move, Some(Drag::Pan(last))) => {
            session.drag = Some(Drag::Pan(at));
            session.drag_view([at[0] - last[0], at[1] - last[1]]);
        }
        (Mouse::Move, Some(Drag::Orbit(last))) => {
            session.drag = Some(Drag::Orbit(at));
            // Half a turn is a drag over the height of the field.
            let angle = std::f64::consts::PI / places.field.height.max(1) as f64;
            session.orbit_view(-(at[0] - last[0]) * angle, (at[1] - last[1]) * angle);
        }
        (Mouse::Release, _) => {
            session.drag = None;
            stage.wanted = None;
        }
        (Mouse::Wheel(notches), _) => {
            if let Some(field) = places.field_at(at) {
                let factor = libm::pow(NOTCH, notches.clamp(-10.0, 10.0));
                let place = [at[0] - field.x as f64, at[1] - field.y as f64];
                session.zoom_view(factor, place);
            }
        }
        (Mouse::Move, None) => {}
    }
    Vec::new()
}

/// To this step, by integrating, as fast as it goes; a later one takes its place.
fn scrub(state: &mut WindowState, step: i64) -> Vec<Effect> {
    let session = &mut state.session;
    session.drag = Some(Drag::Bar(step));
    if let Some(stage) = &mut session.stage {
        stage.wanted = Some(step);
    }
    vec![Effect::Deck(Command::Seek(step))]
}
