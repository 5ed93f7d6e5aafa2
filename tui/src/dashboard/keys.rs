//! From the terminal's events to messages.

use super::message::DashboardMessage;
use crossterm::event::{
    Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use loschmidt_viewer::Key;
use loschmidt_viewer::session::{Button, Message, Mouse};

/// What an event of the terminal means; `None` for those that mean nothing here.
pub fn message(event: Event) -> Option<DashboardMessage> {
    match event {
        Event::Key(event) if event.kind != KeyEventKind::Release => {
            key(event).map(|key| Message::Key(key).into())
        }
        Event::Mouse(event) => mouse(event),
        Event::Resize(columns, rows) => Some(DashboardMessage::Resized(columns, rows)),
        _ => None,
    }
}

fn key(event: KeyEvent) -> Option<Key> {
    let control = event.modifiers.contains(KeyModifiers::CONTROL);
    Some(match event.code {
        KeyCode::Char(c) if control => Key::Ctrl(c.to_ascii_lowercase()),
        KeyCode::Char(' ') => Key::Space,
        KeyCode::Char(c) => Key::Char(c),
        KeyCode::Left => Key::Left,
        KeyCode::Right => Key::Right,
        KeyCode::Up => Key::Up,
        KeyCode::Down => Key::Down,
        KeyCode::Home => Key::Home,
        KeyCode::End => Key::End,
        KeyCode::PageUp => Key::PageUp,
        KeyCode::PageDown => Key::PageDown,
        KeyCode::Enter => Key::Enter,
        KeyCode::Esc => Key::Escape,
        KeyCode::Tab => Key::Tab,
        KeyCode::BackTab => Key::BackTab,
        KeyCode::Backspace => Key::Backspace,
        _ => return None,
    })
}

fn mouse(event: MouseEvent) -> Option<DashboardMessage> {
    let what = match event.kind {
        MouseEventKind::Down(MouseButton::Left) => Mouse::Press(Button::Left),
        MouseEventKind::Down(MouseButton::Right) => Mouse::Press(Button::Right),
        MouseEventKind::Drag(MouseButton::Left | MouseButton::Right) => Mouse::Move,
        MouseEventKind::Up(MouseButton::Left | MouseButton::Right) => Mouse::Release,
        MouseEventKind::ScrollUp => Mouse::Wheel(1.0),
        MouseEventKind::ScrollDown => Mouse::Wheel(-1.0),
        _ => return None,
    };
    Some(DashboardMessage::Mouse(what, event.column, event.row))
}
