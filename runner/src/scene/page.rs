//! A page of an annotated scene file: keys under headers, with their comments in a column.

use super::geometry::Vector3;
use super::schema::{Family, Form, SceneKey, TableRules};
use super::words::Dimension;

/// One line: the code and its comment.
struct PageLine {
    code: String,
    comment: String,
    /// The key, on a line of a table that stands under its own header.
    key: &'static str,
}

/// A scene file in the making.
pub(super) struct Page {
    pub dimension: Dimension,
    /// The keys that the scene's model has.
    family: Family,
    /// The values of keys of the top level that follow from other keys where they are absent.
    follows: Vec<(&'static str, f64)>,
    /// The tables that are open, the file first, with the keys that hold them.
    open: Vec<(&'static str, &'static TableRules)>,
    lines: Vec<PageLine>,
}

impl Page {
    /// An empty page of a file with these rules.
    pub fn new(
        rules: &'static TableRules,
        dimension: Dimension,
        family: Family,
        follows: Vec<(&'static str, f64)>,
    ) -> Self {
        Self {
            dimension,
            family,
            follows,
            open: vec![("", rules)],
            lines: Vec::new(),
        }
    }

    /// A line as it stands.
    pub fn line(&mut self, code: String, comment: String) {
        self.lines.push(PageLine {
            code,
            comment,
            key: "",
        });
    }

    /// A header, commented out if the table is absent.
    pub fn header(&mut self, title: &str, is_set: bool) {
        self.line(String::new(), String::new());
        let code = if is_set {
            title.to_owned()
        } else {
            format!("# {title}")
        };
        self.line(code, String::new());
    }

    /// Opens the table `name` under its header; false if the model does not have it.
    pub fn open(&mut self, name: &'static str, rules: &'static TableRules, is_set: bool) -> bool {
        if self.key(name).is_some_and(|key| !self.has(key)) {
            return false;
        }
        self.open.push((name, rules));
        let names: Vec<&str> = self.open.iter().skip(1).map(|(name, _)| *name).collect();
        self.header(&format!("[{}]", names.join(".")), is_set);
        true
    }

    /// Closes the table that was opened last.
    pub fn close(&mut self) {
        self.open.pop();
    }

    /// A key of the open table with unit and meaning. One without a value is commented out, with
    /// the value that takes effect where there is one.
    pub fn value(&mut self, name: &'static str, value: Option<String>) {
        if let Some(key) = self.key(name).filter(|key| self.has(key)) {
            self.value_of(key, value);
        }
    }

    /// As [`value`](Self::value), for a key that has another meaning in the scene's model.
    pub fn value_of(&mut self, key: &SceneKey, value: Option<String>) {
        let name = key.name;
        let follows = self.follows.iter().find(|(known, _)| *known == name);
        let code = match (value, follows) {
            (Some(value), _) => format!("{name} = {value}"),
            (None, Some((_, x))) if self.is_at_the_top() => format!("# {name} = {}", number(*x)),
            (None, _) => format!("# {name} = …"),
        };
        let before = key.printed_after;
        let place = before.and_then(|before| self.lines.iter().rposition(|l| l.key == before));
        let line = PageLine {
            code,
            comment: comment(key),
            key: name,
        };
        self.lines
            .insert(place.map_or(self.lines.len(), |place| place + 1), line);
    }

    /// A key of any table under the dotted `path` that it has in the open table.
    pub fn value_at(&mut self, key: &SceneKey, path: &str, value: Option<String>) {
        let code = match value {
            Some(value) => format!("{path} = {value}"),
            None => format!("# {path} = …"),
        };
        self.line(code, comment(key));
    }

    /// The coordinates that the scene's dimension has.
    pub fn vector(&self, vector: Vector3) -> String {
        list(&vector[..self.dimension.axes()])
    }

    /// Whether the scene's model is one of this family.
    pub fn is_of(&self, family: Family) -> bool {
        self.family == family
    }

    /// Whether the scene may have a key, by its dimension and its model.
    pub fn may_have(&self, key: &SceneKey) -> bool {
        key.exists_in(Some(self.dimension)) && self.has(key)
    }

    fn key(&self, name: &str) -> Option<&'static SceneKey> {
        self.open.last().and_then(|(_, rules)| rules.key(name))
    }

    fn has(&self, key: &SceneKey) -> bool {
        key.exists_for(Some(self.family))
    }

    fn is_at_the_top(&self) -> bool {
        self.open
            .last()
            .is_some_and(|(_, rules)| rules.form == Form::File)
    }

    /// Joins the lines, with the comments of neighbouring lines in one column.
    pub fn finish(self) -> String {
        const WIDEST: usize = 44;
        let mut page = String::new();
        for block in self.lines.split(|line| line.code.is_empty()) {
            if !page.is_empty() {
                page.push('\n');
            }
            let column = block
                .iter()
                .filter(|line| !line.comment.is_empty())
                .map(|line| line.code.chars().count())
                .filter(|&width| width <= WIDEST)
                .max()
                .unwrap_or(0);
            for line in block {
                let code = &line.code;
                if line.comment.is_empty() {
                    page.push_str(code);
                } else {
                    let gap = column.saturating_sub(code.chars().count());
                    page.push_str(&format!("{code}{:gap$}  # {}", "", line.comment));
                }
                page.push('\n');
            }
        }
        page
    }
}

/// Unit and meaning of a key.
pub(super) fn comment(key: &SceneKey) -> String {
    format!("{}; {}", key.unit_label(), key.meaning)
}

/// The shortest decimal that reads back as the same number; always a TOML float.
pub(super) fn number(x: f64) -> String {
    format!("{x:?}")
}

/// Numbers in brackets.
pub(super) fn list(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|&x| number(x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// A TOML basic string.
pub(super) fn text(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
