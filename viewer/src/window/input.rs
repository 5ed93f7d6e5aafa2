//! From the events of the desktop to keys, and nothing else.

use crate::keys::Key;
use winit::keyboard::{Key as Pressed, NamedKey};

/// The key of the table; `None` for those that mean nothing here.
pub fn key(pressed: &Pressed, control: bool, shift: bool) -> Option<Key> {
    Some(match pressed {
        Pressed::Character(text) => {
            let c = text.chars().next()?;
            if control {
                Key::Ctrl(c.to_ascii_lowercase())
            } else {
                Key::Char(c)
            }
        }
        Pressed::Named(named) => match named {
            NamedKey::Space => Key::Space,
            NamedKey::ArrowLeft => Key::Left,
            NamedKey::ArrowRight => Key::Right,
            NamedKey::ArrowUp => Key::Up,
            NamedKey::ArrowDown => Key::Down,
            NamedKey::Home => Key::Home,
            NamedKey::End => Key::End,
            NamedKey::PageUp => Key::PageUp,
            NamedKey::PageDown => Key::PageDown,
            NamedKey::Enter => Key::Enter,
            NamedKey::Escape => Key::Escape,
            NamedKey::Tab if shift => Key::BackTab,
            NamedKey::Tab => Key::Tab,
            NamedKey::Backspace => Key::Backspace,
            _ => return None,
        },
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::{of_window, window_action};

    #[test]
    fn every_key_of_the_help_can_be_typed() {
        for (key_of_help, action) in of_window().iter().flat_map(|b| b.keys.to_vec()) {
            let typed = match key_of_help {
                Key::Char(c) => key(&Pressed::Character(c.to_string().into()), false, false),
                Key::Ctrl(c) => key(&Pressed::Character(c.to_string().into()), true, false),
                Key::Space => key(&Pressed::Named(NamedKey::Space), false, false),
                Key::Left => key(&Pressed::Named(NamedKey::ArrowLeft), false, false),
                Key::Right => key(&Pressed::Named(NamedKey::ArrowRight), false, false),
                Key::Home => key(&Pressed::Named(NamedKey::Home), false, false),
                Key::End => key(&Pressed::Named(NamedKey::End), false, false),
                Key::PageUp => key(&Pressed::Named(NamedKey::PageUp), false, false),
                Key::PageDown => key(&Pressed::Named(NamedKey::PageDown), false, false),
                Key::Escape => key(&Pressed::Named(NamedKey::Escape), false, false),
                other => panic!("no way to type {other}"),
            };
            assert_eq!(typed.and_then(window_action), Some(action), "{key_of_help}");
        }
    }
}
