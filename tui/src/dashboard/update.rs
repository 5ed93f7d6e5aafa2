//! How the dashboard's state changes, and what is asked for: what the mouse does in it, the help
//! that is longer than the screen, and what the session makes of the rest.

use super::message::DashboardMessage;
use super::state::DashboardState;
use super::view::Areas;
use loschmidt_runner::deck::Command;
use loschmidt_viewer::session::{self, Button, Drag, Effect, Message, Mouse, Overlay};
use loschmidt_viewer::{Key, keys};
use ratatui::layout::Position;

/// Magnification of a notch of the wheel.
const NOTCH: f64 = 1.15;

/// Radians of a turn of the view, for a column and for a row.
const ANGLES: [f64; 2] = [-0.03, 0.06];

/// Changes the state; returns what is to be done.
pub fn update(state: &mut DashboardState, message: impl Into<DashboardMessage>) -> Vec<Effect> {
    let areas = Areas::of(state.size);
    let (columns, rows) = (areas.field.width, areas.field.height);
    state.session.field = (usize::from(columns), 2 * usize::from(rows));
    match message.into() {
        DashboardMessage::Session(Message::Key(key)) if scrolls(state, key) => Vec::new(),
        DashboardMessage::Session(message) => session::update(&mut state.session, message),
        DashboardMessage::Mouse(mouse, column, row) => on_mouse(state, &areas, mouse, column, row),
        DashboardMessage::Resized(columns, rows) => {
            state.size = (columns, rows);
            Vec::new()
        }
    }
}

/// Scrolls the help where it is open; whether the key was for that.
fn scrolls(state: &mut DashboardState, key: Key) -> bool {
    if state.session.overlay != Overlay::Help {
        state.help_line = 0;
        return false;
    }
    match key {
        Key::Down | Key::PageDown => {
            state.help_line = (state.help_line + 1).min(keys::TABLE.len() - 1);
        }
        Key::Up | Key::PageUp => state.help_line = state.help_line.saturating_sub(1),
        _ => return false,
    }
    true
}

fn on_mouse(
    state: &mut DashboardState,
    areas: &Areas,
    mouse: Mouse,
    column: u16,
    row: u16,
) -> Vec<Effect> {
    let session = &mut state.session;
    if session.overlay != Overlay::None {
        return Vec::new();
    }
    let Some(stage) = &mut session.stage else {
        return Vec::new();
    };
    let step = areas.steps_at(column, stage.span());
    let here = [f64::from(column), f64::from(row)];
    let over = Position::new(column, row);
    match (mouse, session.drag) {
        (Mouse::Press(Button::Left), _) if areas.bar.contains(over) => {
            session.banner = None;
            stage.wanted = Some(step);
            session.drag = Some(Drag::Bar(step));
        }
        (Mouse::Press(button), _) if areas.field.contains(over) => {
            session.drag = Some(match button {
                Button::Left => Drag::Pan(here),
                Button::Right => Drag::Orbit(here),
            });
        }
        (Mouse::Move, Some(Drag::Bar(_))) => {
            stage.wanted = Some(step);
            session.drag = Some(Drag::Bar(step));
        }
        (Mouse::Release, Some(Drag::Bar(_))) => {
            session.drag = None;
            stage.wanted = Some(step);
            return vec![Effect::Deck(Command::Seek(step))];
        }
        (Mouse::Release, _) => session.drag = None,
        (Mouse::Move, Some(Drag::Pan(last))) => {
            session.drag = Some(Drag::Pan(here));
            // A row is two pixels high.
            session.drag_view([here[0] - last[0], 2.0 * (here[1] - last[1])]);
        }
        (Mouse::Move, Some(Drag::Orbit(last))) => {
            session.drag = Some(Drag::Orbit(here));
            let [yaw, pitch] = [0, 1].map(|k| ANGLES[k] * (here[k] - last[k]));
            session.orbit_view(yaw, pitch);
        }
        (Mouse::Wheel(notches), _) if areas.field.contains(over) => {
            let x = here[0] - f64::from(areas.field.x) + 0.5;
            let y = 2.0 * (here[1] - f64::from(areas.field.y)) + 1.0;
            session.zoom_view(NOTCH.powf(notches), [x, y]);
        }
        _ => {}
    }
    Vec::new()
}
