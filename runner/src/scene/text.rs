//! A text of a scene, and where in it something stands: line, column, excerpt.
//!
//! The beginnings of the lines, and the number of characters before every kibibyte, are counted
//! once. A place is then found in the same time wherever it is, also on a line of a megabyte.

use super::error::Line;

/// Bytes between two places at which the characters before are known.
const BLOCK: usize = 1024;

/// Characters of a line that are shown.
const SHOWN: usize = 160;

/// Characters before the place where a line is cut.
const BEFORE: usize = 60;

/// One of the texts a scene is written in.
#[derive(Clone, Debug)]
pub(super) struct Text {
    /// What messages call it.
    pub name: String,
    /// The text.
    pub text: String,
    /// Where the lines begin, bytes.
    lines: Vec<usize>,
    /// Characters that begin before each block of bytes.
    characters: Vec<usize>,
}

impl Text {
    /// Counts lines and characters.
    pub fn new(name: String, text: String) -> Self {
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        let lines = std::iter::once(0).chain(ends).collect();
        let mut before = 0;
        let blocks = text.as_bytes().chunks(BLOCK).map(|block| {
            let here = before;
            before += block.iter().filter(|&&byte| begins_character(byte)).count();
            here
        });
        let characters = blocks.collect();
        Self {
            name,
            text,
            lines,
            characters,
        }
    }

    /// Characters before the byte `end`.
    fn characters_before(&self, end: usize) -> usize {
        let block = (end / BLOCK).min(self.characters.len().saturating_sub(1));
        let rest = &self.text.as_bytes()[(block * BLOCK).min(end)..end];
        let counted = self.characters.get(block).copied().unwrap_or(0);
        counted + rest.iter().filter(|&&byte| begins_character(byte)).count()
    }

    /// The line and column of `start..end`; a span over several lines is cut at the end of its
    /// first, and a long line is cut on both sides of the span.
    pub fn locate(&self, start: usize, end: usize, numbered: bool) -> Line {
        let text = &self.text;
        let start = floor_to_character(text, start);
        let end = floor_to_character(text, end).max(start);
        let number = self.lines.partition_point(|&line| line <= start);
        let line_start = self.lines[number.saturating_sub(1)];
        let line_end = self.lines.get(number).map_or(text.len(), |next| next - 1);
        let before = self.characters_before(start) - self.characters_before(line_start);
        // A line is cut by bytes first, so that a long one is not walked.
        let from = match before > BEFORE {
            true => floor_to_character(text, start.saturating_sub(4 * SHOWN).max(line_start)),
            false => line_start,
        };
        let near = &text[from..floor_to_character(text, line_end.min(start + 4 * SHOWN))];
        let skipped = self.characters_before(from) - self.characters_before(line_start);
        let skip = before.saturating_sub(BEFORE).saturating_sub(skipped);
        let is_short = skipped == 0 && near.chars().count() <= SHOWN;
        let skip = if is_short { 0 } else { skip };
        let shown: String = near.chars().skip(skip).take(SHOWN).collect();
        let cut = skipped + skip;
        let pointed = text[start..end.min(line_end).min(start + 4 * SHOWN)].trim_end();
        let room = shown
            .trim_end()
            .chars()
            .count()
            .saturating_sub(before - cut);
        Line {
            number: numbered.then_some(number),
            column: 1 + before,
            width: pointed.chars().count().min(room).max(1),
            text: shown.trim_end().to_owned(),
            before: cut,
        }
    }
}

/// Whether a byte is the first of a character in UTF-8.
fn begins_character(byte: u8) -> bool {
    byte & 0xc0 != 0x80
}

/// The last character boundary at or before `index`.
fn floor_to_character(text: &str, index: usize) -> usize {
    (0..=index.min(text.len()))
        .rev()
        .find(|&i| text.is_char_boundary(i))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_found_on_lines_of_every_length() {
        for before in [0, 1, 59, 60, 61, 1023, 5000] {
            for after in [0, 1, 90, 5000] {
                let line = format!("{}there{}", "ä".repeat(before), "ö".repeat(after));
                let start = 2 + 2 * before;
                let text = Text::new("f".to_owned(), format!("x\n{line}\ny\n"));
                let place = text.locate(start, start + 5, true);
                assert_eq!(
                    (place.number, place.column, place.width),
                    (Some(2), before + 1, 5)
                );
                let from = before - place.before;
                let shown: String = place.text.chars().skip(from).take(5).collect();
                assert_eq!(shown, "there", "{before} {after}");
                assert!(place.text.chars().count() <= SHOWN);
                let whole = before + 5 + after <= SHOWN;
                assert_eq!(place.text == line, whole, "{before} {after}");
            }
        }
        let empty = Text::new("f".to_owned(), String::new()).locate(0, 0, true);
        assert_eq!((empty.number, empty.column, empty.width), (Some(1), 1, 1));
        // The rest of a span is on other lines.
        let text = Text::new("f".to_owned(), "a = [\n1,\n]\n".to_owned());
        assert_eq!(text.locate(4, 10, true).width, 1);
    }
}
