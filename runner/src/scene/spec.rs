//! A scene as it was written: a tree of values, each knowing where it stands.
//!
//! Overrides are merged into the same tree, and their values keep pointing at the
//! override's own text, so that a message about them shows what the user typed.

use toml_edit::{Document, Item, TableLike, TomlError};

use super::error::{Place, Problem, ProblemKind, Problems, SceneError};
use super::source::SourceText;
use super::text::Text;

/// A piece of one of the texts of a [`SceneSpec`]: the file is text 0, the overrides follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub text: usize,
    pub start: usize,
    pub end: usize,
}

impl Span {
    /// Whether the piece stands in an override.
    pub fn is_override(self) -> bool {
        self.text > 0
    }
}

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub value: WrittenValue,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(super) enum WrittenValue {
    Text(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    Date,
    List(Vec<Node>),
    Table(WrittenTable),
}

impl WrittenValue {
    /// How a message names the type of the value.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Text(_) => "a string",
            Self::Integer(_) => "a whole number",
            Self::Float(_) => "a number",
            Self::Boolean(_) => "true or false",
            Self::Date => "a date",
            Self::List(_) => "an array",
            Self::Table(_) => "a table",
        }
    }
}

/// Keys in the order in which they were written.
#[derive(Clone, Debug, Default)]
pub(super) struct WrittenTable {
    pub entries: Vec<Entry>,
}

#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub name: String,
    pub key: Span,
    pub node: Node,
}

impl WrittenTable {
    pub fn get(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    pub fn get_mut(&mut self, name: &str) -> Option<&mut Entry> {
        self.entries.iter_mut().find(|entry| entry.name == name)
    }
}

/// A scene as it was written, overrides included.
#[derive(Clone, Debug)]
pub(super) struct SceneSpec {
    texts: Vec<Text>,
    /// Name of a scene that does not state one.
    pub stem: String,
    pub root: WrittenTable,
}

impl SceneSpec {
    /// Reads the syntax of a scene.
    ///
    /// # Errors
    ///
    /// [`SceneError::Invalid`] with one problem when the text is not TOML.
    pub fn parse(source: SourceText) -> Result<Self, SceneError> {
        let mut spec = Self {
            texts: vec![Text::new(source.name, source.text)],
            stem: source.stem,
            root: WrittenTable::default(),
        };
        let text = &spec.texts[0].text;
        match Document::parse(text.as_str()) {
            Ok(document) => spec.root = table(document.as_table(), 0),
            Err(error) => {
                let problem = spec.syntax_problem(0, &error);
                return Err(SceneError::Invalid(Problems::new(vec![problem])));
            }
        }
        Ok(spec)
    }

    /// Adds the text of an override and returns its number.
    pub fn add_override(&mut self, text: &str) -> usize {
        self.texts
            .push(Text::new("--set".to_owned(), text.to_owned()));
        self.texts.len() - 1
    }

    /// The mistake that `error` found in the text of number `text`.
    pub fn syntax_problem(&self, text: usize, error: &TomlError) -> Problem {
        let range = error.span().unwrap_or(0..0);
        let span = Span {
            text,
            start: range.start,
            end: range.end,
        };
        let found = self.texts[text].text.get(range).unwrap_or("");
        if error.message() == "duplicate key" {
            return self.problem(
                ProblemKind::Syntax,
                format!("`{found}` is given twice"),
                span,
                vec![
                    "a key or table may stand only once in its table: keep one of them".to_owned(),
                ],
            );
        }
        let (message, help) = match error.message().split_once(", expected ") {
            Some(("string values must be quoted", _)) => (
                "a string stands in quotation marks",
                vec![format!("write \"{found}\"")],
            ),
            Some(("invalid basic string", "`\"`")) => (
                "the string does not end",
                vec!["close it with \" on the same line".to_owned()],
            ),
            Some((message, expected)) => (message, vec![format!("expected {expected}")]),
            None => (error.message(), Vec::new()),
        };
        self.problem(ProblemKind::Syntax, message.to_owned(), span, help)
    }

    /// A mistake at `span`.
    pub fn problem(
        &self,
        kind: ProblemKind,
        message: String,
        span: Span,
        help: Vec<String>,
    ) -> Problem {
        let text = &self.texts[span.text];
        let line = text.locate(span.start, span.end, !span.is_override());
        let place = Place {
            file: text.name.clone(),
            line: Some(line),
            order: (span.text, span.start),
        };
        Problem {
            kind,
            message,
            place,
            help,
        }
    }

    /// A mistake that stands nowhere in the file, such as a missing key of the top level.
    pub fn problem_of_the_file(&self, message: String, help: Vec<String>) -> Problem {
        Problem {
            kind: ProblemKind::MissingKey,
            message,
            place: Place {
                file: self.texts[0].name.clone(),
                line: None,
                order: (0, 0),
            },
            help,
        }
    }
}

fn span(text: usize, range: Option<std::ops::Range<usize>>, fallback: Span) -> Span {
    range.map_or(fallback, |range| Span {
        text,
        start: range.start,
        end: range.end,
    })
}

/// Converts a table of a parsed document.
pub(super) fn table(source: &dyn TableLike, text: usize) -> WrittenTable {
    let nowhere = Span {
        text,
        start: 0,
        end: 0,
    };
    let entries = source
        .iter()
        .filter_map(|(name, _)| source.get_key_value(name))
        .map(|(key, item)| {
            let key_span = span(text, key.span(), nowhere);
            Entry {
                name: key.get().to_owned(),
                key: key_span,
                node: node(item, text, key_span),
            }
        })
        .collect();
    WrittenTable { entries }
}

fn node(item: &Item, text: usize, key: Span) -> Node {
    let value = match item {
        Item::Value(inner) => return value_node(inner, text, key),
        Item::Table(inner) => WrittenValue::Table(table(inner, text)),
        Item::ArrayOfTables(inner) => WrittenValue::List(
            inner
                .iter()
                .map(|element| Node {
                    span: span(text, element.span(), key),
                    value: WrittenValue::Table(table(element, text)),
                })
                .collect(),
        ),
        Item::None => WrittenValue::Table(WrittenTable::default()),
    };
    // The span of an array of tables reaches over all of them: its key says more.
    let range = match item {
        Item::ArrayOfTables(_) => None,
        _ => item.span(),
    };
    Node {
        value,
        span: span(text, range, key),
    }
}

fn value_node(source: &toml_edit::Value, text: usize, key: Span) -> Node {
    let here = span(text, source.span(), key);
    let value = match source {
        toml_edit::Value::String(inner) => WrittenValue::Text(inner.value().clone()),
        toml_edit::Value::Integer(inner) => WrittenValue::Integer(*inner.value()),
        toml_edit::Value::Float(inner) => WrittenValue::Float(*inner.value()),
        toml_edit::Value::Boolean(inner) => WrittenValue::Boolean(*inner.value()),
        toml_edit::Value::Datetime(_) => WrittenValue::Date,
        toml_edit::Value::Array(inner) => WrittenValue::List(
            inner
                .iter()
                .map(|element| value_node(element, text, here))
                .collect(),
        ),
        toml_edit::Value::InlineTable(inner) => WrittenValue::Table(table(inner, text)),
    };
    Node { value, span: here }
}
