//! Reads single values of a scene as it was written, and collects what is missing or wrong.
//!
//! Values that [`check`](super::check) has already refused are replaced by NaN or another
//! stand-in, which no rule complains about, so that one mistake gives one message.

use super::error::{MOST_FOUND, Problem, ProblemKind, Problems, SceneError};
use super::nearest::nearest;
use super::schema::{Family, Form, IfAbsent, SceneKey, TableRules, ValueType};
use super::spec::{Entry, SceneSpec, Span, WrittenTable, WrittenValue};
use super::values::{as_table, finite, numbers};
use super::words::{ChoiceWord, Dimension};

/// Stands in for a table that is not in the file: all its keys have their defaults.
const EMPTY_TABLE: &WrittenTable = &WrittenTable {
    entries: Vec::new(),
};

/// A table and where messages about what it lacks point to.
#[derive(Clone, Copy)]
pub(super) struct Here<'a> {
    pub table: &'a WrittenTable,
    /// `None` is the top level of the file.
    pub span: Option<Span>,
    pub rules: &'static TableRules,
    /// The key that holds the table.
    pub name: &'a str,
    /// Whether the file lacks the table; then nothing is missed in it.
    is_absent: bool,
}

impl<'a> Here<'a> {
    /// The top level of the file.
    pub fn top(table: &'a WrittenTable, rules: &'static TableRules) -> Self {
        Self {
            table,
            span: None,
            rules,
            name: "",
            is_absent: false,
        }
    }

    /// A table of the file, at `span`.
    pub fn table(
        table: &'a WrittenTable,
        span: Span,
        rules: &'static TableRules,
        name: &'a str,
    ) -> Self {
        Self {
            table,
            span: Some(span),
            rules,
            name,
            is_absent: false,
        }
    }

    /// A table that is not in the file.
    pub fn absent(rules: &'static TableRules, name: &'a str) -> Self {
        Self {
            table: EMPTY_TABLE,
            span: None,
            rules,
            name,
            is_absent: true,
        }
    }

    /// How a message names the table.
    fn title(&self) -> String {
        match self.rules.form {
            Form::UnderKey => format!("`{}`", self.name),
            _ => self.rules.title.to_owned(),
        }
    }

    /// Whether a key that does not exist was most likely meant to be `name`.
    pub fn misspells(&self, name: &str) -> bool {
        let names = || self.rules.keys.iter().map(|key| key.name);
        self.table.entries.iter().any(|entry| {
            names().all(|known| known != entry.name) && nearest(&entry.name, names()) == Some(name)
        })
    }

    /// The value that the key `name` has where it is absent, if it is a word.
    pub fn default_word<W: ChoiceWord>(&self, name: &str) -> Option<W> {
        match self.rules.key(name)?.default {
            IfAbsent::Word(word) => W::from_word(word),
            _ => None,
        }
    }
}

/// Reads a scene, value by value.
pub(super) struct Builder<'a> {
    spec: &'a SceneSpec,
    pub dimension: Dimension,
    /// The keys that the scene's model has; `None` when the model was refused.
    family: Option<Family>,
    problems: Vec<Problem>,
}

impl<'a> Builder<'a> {
    /// A reader of `spec`, of which these problems are known.
    pub fn new(
        spec: &'a SceneSpec,
        dimension: Dimension,
        family: Option<Family>,
        problems: Vec<Problem>,
    ) -> Self {
        Self {
            spec,
            dimension,
            family,
            problems,
        }
    }

    /// The value that was read, or every problem found on the way.
    pub fn finish<T>(self, value: T) -> Result<T, SceneError> {
        if self.problems.is_empty() {
            Ok(value)
        } else {
            self.give_up()
        }
    }

    /// Every problem found so far.
    pub fn give_up<T>(self) -> Result<T, SceneError> {
        Err(SceneError::Invalid(Problems::new(self.problems)))
    }

    /// Whether so much is wrong that nothing more is looked for.
    pub fn has_enough(&self) -> bool {
        self.problems.len() >= MOST_FOUND
    }

    fn report(
        &mut self,
        kind: ProblemKind,
        message: String,
        span: Option<Span>,
        help: Vec<String>,
    ) {
        if self.has_enough() {
            return;
        }
        self.problems.push(match span {
            Some(span) => self.spec.problem(kind, message, span, help),
            None => self.spec.problem_of_the_file(message, help),
        });
    }

    /// Reports values that exclude each other.
    pub fn conflict(&mut self, message: String, span: Span, help: String) {
        self.report(ProblemKind::Conflict, message, Some(span), vec![help]);
    }

    /// Reports a value that is not allowed.
    pub fn out_of_range(&mut self, message: String, span: Span, help: String) {
        self.report(ProblemKind::OutOfRange, message, Some(span), vec![help]);
    }

    /// Reports that a table lacks something.
    pub fn missing(&mut self, here: Here, message: String, help: Vec<String>) {
        self.report(ProblemKind::MissingKey, message, here.span, help);
    }

    /// The entry `name`; its absence is reported when the schema requires it. A table that the
    /// file lacks is reported by [`require_tables`](Self::require_tables).
    pub fn entry(&mut self, here: Here<'a>, name: &str) -> Option<&'a Entry> {
        let entry = here.table.get(name);
        if entry.is_some() || here.is_absent {
            return entry;
        }
        let key = here.rules.key(name)?;
        if !(key.kind.is_table() && here.rules.form == Form::File) {
            self.require(here, key);
        }
        None
    }

    /// Reports the tables that the file needs and lacks.
    pub fn require_tables(&mut self, top: Here<'a>) {
        for key in top.rules.keys {
            if key.kind.is_table() && top.table.get(key.name).is_none() {
                self.require(top, key);
            }
        }
    }

    /// Reports that a key is missing, if it is required.
    fn require(&mut self, here: Here<'a>, key: &'static SceneKey) {
        let name = key.name;
        // One message for one mistake: the misspelt key is reported already.
        // What an unknown model needs is not known either.
        let needed = key.family.is_none() || self.family.is_some_and(|_| self.has(key));
        if key.default != IfAbsent::Required || !needed || here.misspells(name) {
            return;
        }
        let message = match (here.rules.form, key.kind) {
            (Form::File, ValueType::Table(inner) | ValueType::Tables(inner)) => {
                format!("{} is missing", inner.title)
            }
            (Form::File, _) => format!("`{name}` is missing"),
            _ => format!("{} needs `{name}`", here.title()),
        };
        let help = if key.kind.is_table() {
            format!("it says {}", key.meaning)
        } else {
            format!("`{name}` ({}): {}", key.unit_label(), key.meaning)
        };
        self.missing(here, message, vec![help]);
    }

    /// Whether the scene's model has the key; a refused model has every key.
    fn has(&self, key: &SceneKey) -> bool {
        key.exists_for(self.family)
    }

    /// A number; NaN stands for one that was refused or is absent without a default.
    pub fn number(&mut self, here: Here<'a>, name: &str) -> f64 {
        match self.entry(here, name) {
            Some(entry) => accepted(here, entry),
            None => match here.rules.key(name).map(|key| key.default) {
                Some(IfAbsent::Number(x)) => x,
                _ => f64::NAN,
            },
        }
    }

    /// A number that may be absent.
    pub fn optional_number(&mut self, here: Here<'a>, name: &str) -> Option<f64> {
        here.table.get(name).map(|entry| accepted(here, entry))
    }

    /// A vector; zero stands for an absent one.
    pub fn vector(&mut self, here: Here<'a>, name: &str) -> [f64; 3] {
        self.entry(here, name)
            .map_or([0.0; 3], |entry| numbers(&entry.node))
    }

    /// A text; `None` when it was refused or is absent.
    pub fn text(&mut self, here: Here<'a>, name: &str) -> Option<&'a str> {
        match &self.entry(here, name)?.node.value {
            WrittenValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// True or false; false stands for an absent one.
    pub fn flag(&mut self, here: Here<'a>, name: &str) -> bool {
        let entry = self.entry(here, name);
        matches!(
            entry.map(|entry| &entry.node.value),
            Some(WrittenValue::Boolean(true))
        )
    }

    /// Whether the scene may have a key, by its dimension and its model.
    pub fn may_have(&self, key: &SceneKey) -> bool {
        key.exists_in(Some(self.dimension)) && self.has(key)
    }

    /// Whether the scene's model is one of this family; a refused model is of every family.
    pub fn is_of(&self, family: Family) -> bool {
        self.family.is_none_or(|own| own == family)
    }

    /// A word; `None` when it was refused or is absent without a default.
    pub fn word<W: ChoiceWord>(&mut self, here: Here<'a>, name: &str) -> Option<W> {
        if here.table.get(name).is_some() {
            return W::from_word(self.text(here, name)?);
        }
        let default = here.default_word(name);
        if default.is_none() {
            self.entry(here, name);
        }
        default
    }

    /// The table `name`, if there is one.
    pub fn inner(
        &mut self,
        here: Here<'a>,
        name: &str,
        rules: &'static TableRules,
    ) -> Option<Here<'a>> {
        let entry = self.entry(here, name)?;
        let table = as_table(&entry.node)?;
        Some(Here::table(table, entry.node.span, rules, &entry.name))
    }
}

/// The number of an entry, or NaN when it is refused.
fn accepted(here: Here, entry: &Entry) -> f64 {
    let range = here.rules.key(&entry.name).map(|key| key.range);
    finite(&entry.node)
        .filter(|&x| range.is_none_or(|range| range.contains(x)))
        .unwrap_or(f64::NAN)
}
