//! What a key of the scene language is: where it stands, its type, unit, allowed range, default
//! and meaning.
//!
//! The keys themselves are declared where their values are used (see [`declare`](super::declare)).
//! Parsing, the ranges in error messages, the nearest-key suggestions, `--set` and the comments of
//! [`Scene::to_toml`](super::Scene::to_toml) all read these declarations; a key that is in none of
//! them does not exist.

use std::fmt;
use std::ptr;

use super::words::Dimension;

/// The rules of a table of the scene language: which keys may stand in it.
///
/// Shapes hold shapes, so rules refer to each other in rings: two of them are equal when they are
/// the same one in memory.
pub(super) struct TableRules {
    /// How a message names the table, e.g. "`[fluid]`".
    pub title: &'static str,
    /// How the table is written in a scene file.
    pub form: Form,
    /// Its keys, in the order in which messages list them.
    pub keys: &'static [SceneKey],
}

/// How a table is written in a scene file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// It is the file itself.
    File,
    /// Under a header in single brackets.
    Header,
    /// As the value of a key, by whose name messages call it.
    UnderKey,
    /// In another way.
    Other,
}

impl PartialEq for TableRules {
    fn eq(&self, other: &Self) -> bool {
        ptr::eq(self, other)
    }
}

impl TableRules {
    /// The key of this name.
    pub fn key(&self, name: &str) -> Option<&'static SceneKey> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// The first table, this one or one below it, that has a key of this name.
    pub fn find_below(&'static self, name: &str) -> Option<&'static TableRules> {
        let mut seen = Vec::new();
        self.list_below(&mut seen);
        seen.into_iter().find(|rules| rules.key(name).is_some())
    }

    fn list_below(&'static self, seen: &mut Vec<&'static TableRules>) {
        if seen.contains(&self) {
            return;
        }
        seen.push(self);
        for key in self.keys {
            if let ValueType::Table(inner) | ValueType::Tables(inner) = key.kind {
                inner.list_below(seen);
            }
        }
    }
}

/// The type of a key's value.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ValueType {
    /// A string.
    Text,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// One of these words, or the name of a model that the program has registered.
    Model(&'static [&'static str]),
    /// The whole number 2 or 3.
    Dimension,
    /// A finite number.
    Number,
    /// A whole number.
    Whole,
    /// As many numbers as there are dimensions.
    Vector,
    /// As many rows as there are dimensions, each a vector.
    Matrix,
    /// At least three points of the plane.
    Corners,
    /// A number in 2D, a vector in 3D.
    Rotation,
    /// True or false.
    Flag,
    /// One table.
    Table(&'static TableRules),
    /// An array of tables.
    Tables(&'static TableRules),
}

impl ValueType {
    /// Whether it is a table or an array of tables.
    pub fn is_table(self) -> bool {
        matches!(self, Self::Table(_) | Self::Tables(_))
    }
}

/// The numbers a key allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    /// Every finite number.
    Any,
    /// Greater than the bound.
    Above(f64),
    /// The bound or more.
    AtLeast(f64),
    /// Both bounds included.
    Between(f64, f64),
    /// Greater than the first bound, at most the second.
    AboveUpTo(f64, f64),
}

impl Range {
    /// Whether `x` is allowed.
    pub fn contains(self, x: f64) -> bool {
        match self {
            Self::Any => x.is_finite(),
            Self::Above(low) => x > low,
            Self::AtLeast(low) => x >= low,
            Self::Between(low, high) => (low..=high).contains(&x),
            Self::AboveUpTo(low, high) => x > low && x <= high,
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => write!(f, "any finite number"),
            Self::Above(low) => write!(f, "greater than {low}"),
            Self::AtLeast(low) => write!(f, "{low} or more"),
            Self::Between(low, high) => write!(f, "from {low} to {high}"),
            Self::AboveUpTo(low, high) => write!(f, "greater than {low}, at most {high}"),
        }
    }
}

/// What an absent key means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum IfAbsent {
    /// An error.
    Required,
    /// No value, or one that follows from other keys.
    Optional,
    /// This number.
    Number(f64),
    /// This word.
    Word(&'static str),
}

/// One key.
#[derive(Clone, Copy)]
pub(super) struct SceneKey {
    pub name: &'static str,
    pub kind: ValueType,
    pub default: IfAbsent,
    pub range: Range,
    pub meaning: &'static str,
    /// The SI unit; empty for a number without one.
    pub unit: &'static str,
    /// The only dimension in which the key exists, if there is one.
    pub only: Option<Dimension>,
    /// The models that have the key; none where every model has it.
    pub family: Option<Family>,
    /// The key after which it is printed, if that is not the one before it.
    pub printed_after: Option<&'static str>,
}

/// A name for the models that share keys which no other model has (see [`model`](super::model)).
pub(super) type Family = &'static str;

/// The family of a key that every model has.
pub(super) const ANY_MODEL: Option<Family> = None;

impl SceneKey {
    /// Whether a scene of this dimension may have the key; an unknown dimension has the keys that
    /// all have.
    pub fn exists_in(&self, dimension: Option<Dimension>) -> bool {
        self.only.is_none() || self.only == dimension
    }

    /// Whether a model of this family may have the key; an unknown model may have all.
    pub fn exists_for(&self, family: Option<Family>) -> bool {
        match (self.family, family) {
            (Some(owner), Some(family)) => owner == family,
            _ => true,
        }
    }

    /// What the value is, for the first half of a comment: unit, allowed words or type.
    pub fn unit_label(&self) -> String {
        match self.kind {
            ValueType::Text => "text".to_owned(),
            ValueType::Choice(words) | ValueType::Model(words) => quoted(words, "or"),
            ValueType::Dimension => "2 or 3".to_owned(),
            ValueType::Flag => "true or false".to_owned(),
            ValueType::Table(_) | ValueType::Tables(_) => "table".to_owned(),
            _ if self.unit.is_empty() => "no unit".to_owned(),
            _ => self.unit.to_owned(),
        }
    }
}

/// Lists words in quotation marks: `"a", "b" or "c"`.
pub(super) fn quoted(words: &[&str], conjunction: &str) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    listed(&quoted, conjunction)
}

/// Lists phrases: `a, b or c`.
pub(super) fn listed(phrases: &[String], conjunction: &str) -> String {
    match phrases {
        [] => String::new(),
        [one] => one.clone(),
        [head @ .., last] => format!("{} {conjunction} {last}", head.join(", ")),
    }
}

/// A key without a unit, a range, a default and a meaning, which are put to it by methods: for keys
/// whose values are read by hand.
pub(super) const fn key(name: &'static str, kind: ValueType) -> SceneKey {
    SceneKey {
        name,
        kind,
        default: IfAbsent::Optional,
        range: Range::Any,
        meaning: "",
        unit: "",
        only: None,
        family: None,
        printed_after: None,
    }
}

impl SceneKey {
    pub const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = unit;
        self
    }

    pub const fn within(mut self, range: Range) -> Self {
        self.range = range;
        self
    }

    pub const fn required(mut self) -> Self {
        self.default = IfAbsent::Required;
        self
    }

    pub const fn or(mut self, number: f64) -> Self {
        self.default = IfAbsent::Number(number);
        self
    }

    pub const fn of(mut self, family: Family) -> Self {
        self.family = Some(family);
        self
    }

    pub const fn only(mut self, dimension: Dimension) -> Self {
        self.only = Some(dimension);
        self
    }

    pub const fn means(mut self, meaning: &'static str) -> Self {
        self.meaning = meaning;
        self
    }
}

/// The number of keys in several lists.
pub(super) const fn count(lists: &[&[SceneKey]]) -> usize {
    let mut total = 0;
    let mut list = 0;
    while list < lists.len() {
        total += lists[list].len();
        list += 1;
    }
    total
}

/// Several lists of keys as one, which holds `N` keys as [`count`] says; the first list is not
/// empty.
pub(super) const fn join<const N: usize>(lists: &[&[SceneKey]]) -> [SceneKey; N] {
    let mut all = [lists[0][0]; N];
    let (mut list, mut filled) = (0, 0);
    while list < lists.len() {
        let mut place = 0;
        while place < lists[list].len() {
            all[filled] = lists[list][place];
            filled += 1;
            place += 1;
        }
        list += 1;
    }
    all
}
