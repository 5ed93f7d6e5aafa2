//! Text of users on a terminal: made harmless, and paths as a shell takes them.
//!
//! Scene files, arguments and names of files may hold anything: escape sequences that repaint the
//! screen or change its title, bells, characters that turn the direction of what follows. Whatever
//! prints text that it did not write itself sends it through [`visible`].

use std::borrow::Cow;
use std::path::Path;

/// The text with a visible character in the place of each that a terminal would obey: of a control
/// character its picture (␛ for ESC, ␇ for BEL), of others �. Ends of lines and tabs stay. Each
/// character stands for one, so that columns are kept.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    if text.chars().any(|c| shown(c) != c) {
        Cow::Owned(text.chars().map(shown).collect())
    } else {
        Cow::Borrowed(text)
    }
}

fn shown(c: char) -> char {
    match c {
        '\n' | '\t' => c,
        '\0'..='\x1f' => char::from_u32(0x2400 + c as u32).unwrap_or('\u{fffd}'),
        '\x7f' => '\u{2421}',
        // The control characters of Latin-1, and those that turn the direction of a text.
        '\u{80}'..='\u{9f}'
        | '\u{61c}'
        | '\u{200e}'
        | '\u{200f}'
        | '\u{202a}'..='\u{202e}'
        | '\u{2066}'..='\u{2069}' => '\u{fffd}',
        c => c,
    }
}

/// A path as a shell takes it, also one that is not UTF-8 or holds control characters:
/// `$'\xff'`.
#[must_use]
pub fn quote(path: &Path) -> String {
    let bytes = path.as_os_str().as_encoded_bytes();
    let plain = |b: &u8| b.is_ascii_alphanumeric() || b"/._-+:@,=".contains(b);
    if !bytes.is_empty() && bytes.iter().all(plain) {
        return String::from_utf8_lossy(bytes).into_owned();
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if visible(text) == text && !text.contains(['\n', '\t']) => {
            format!("'{}'", text.replace('\'', r"'\''"))
        }
        _ => {
            let escaped = |byte: &u8| match *byte {
                b'\'' | b'\\' => format!("\\{}", char::from(*byte)),
                b' '..=b'~' => char::from(*byte).to_string(),
                byte => format!("\\x{byte:02x}"),
            };
            let text: String = bytes.iter().map(escaped).collect();
            format!("$'{text}'")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_shown() {
        let wild = "a\x1b[2J\x07\tb\n\u{202e}c\u{9b}d\u{7f}\u{2066}";
        let tame = visible(wild);
        assert_eq!(tame, "a␛[2J␇\tb\n\u{fffd}c\u{fffd}d␡\u{fffd}");
        assert_eq!(tame.chars().count(), wild.chars().count());
        assert!(matches!(visible("ordinary: µ ü\n"), Cow::Borrowed(_)));
    }

    #[test]
    fn quoted_paths_are_what_a_shell_takes() {
        for (path, quoted) in [
            ("runs/dam-break-1", "runs/dam-break-1"),
            ("", "''"),
            ("a b", "'a b'"),
            ("it's", r"'it'\''s'"),
            ("ü", "'ü'"),
            ("a\n\x1b'\\", r"$'a\x0a\x1b\'\\'"),
        ] {
            assert_eq!(quote(Path::new(path)), quoted);
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_shell_gives_the_path_back() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let bytes: Vec<u8> = (1..=255).collect();
        let quoted = quote(Path::new(OsStr::from_bytes(&bytes)));
        assert!(quoted.is_ascii());
        let said = std::process::Command::new("bash")
            .args(["-c", &format!("printf %s {quoted}")])
            .output();
        // Where there is no such shell there is nothing to compare with.
        if let Ok(said) = said {
            assert_eq!(said.stdout, bytes);
        }
    }
}
