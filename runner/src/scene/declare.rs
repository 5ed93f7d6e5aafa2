//! One declaration for each key of the scene language.
//!
//! [`keys!`] takes a list of keys that stand beside each other in a table:
//!
//! ```text
//! keys! {
//!     /// The potential of a conservative wall, per mass of fluid.
//!     WallPotential of WATER, table Header "`[wall]`" {
//!         radius: f64 = Number(0.95), AboveUpTo(0.0, 6.0),
//!             "distance at which the wall begins to repel", "particle spacings";
//!         …
//!     }
//! }
//! ```
//!
//! Each line says: name, type, default, range, meaning and, where there is one, the unit. From it
//! follow a field of the struct with its documentation, the key in the schema, reading the field
//! from what was written, and printing it with its comment.
//!
//! - `of` names the models that have the keys; `ANY_MODEL` stands for all of them.
//! - `table` says how the table of these keys is written and what messages call it. It is left out
//!   for keys that stand in the table of another declaration, which takes them in by a line
//!   `..field: Type;` after the key that they follow.
//! - A key is printed where it stands, or where `printed after "key"` says.
//!
//! What a type looks like in a scene file is said once by [`KeyValue`], for every key that has it.

use super::builder::{Builder, Here};
use super::geometry::Vector3;
use super::page::{Page, number, text};
use super::schema::{Family, SceneKey, TableRules, ValueType};
use super::words::{ChoiceWord, Dimension};

/// A type that the value of a key can have.
pub(super) trait KeyValue: Sized {
    /// What stands in a scene file.
    const KIND: ValueType;

    /// The models that have keys of this type; `None` where all have them.
    const FAMILY: Option<Family> = None;

    /// The value of the key `name`, or what an absent or refused one stands for.
    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self;

    /// Prints the key `name`, commented out where it has no value.
    fn print(value: Option<&Self>, page: &mut Page, name: &'static str);
}

/// Keys that stand beside each other in a table, and their values.
pub(super) trait Keys: Sized {
    /// The keys.
    const KEYS: &'static [SceneKey];

    /// The models that have them; `None` where all have them.
    const FAMILY: Option<Family>;

    /// The values in a table.
    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Self;

    /// Prints every key, commented out where there are no values.
    fn print(values: Option<&Self>, page: &mut Page);
}

/// Keys that fill a table.
pub(super) trait KeyTable: Keys + 'static {
    /// The table.
    const RULES: &'static TableRules;
}

/// Declares keys; the head of this module says how.
macro_rules! keys {
    (
        $(#[$meta:meta])*
        $name:ident of $family:ident $(, table $form:ident $title:literal)? {
            $(
                $key:ident: $type:ty = $default:expr, $range:expr, $meaning:expr
                    $(, $unit:literal)? $(, printed after $before:literal)?;
                $( $(#[$group_meta:meta])* ..$group:ident: $group_type:ty; )*
            )*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $(
                #[doc = $meaning]
                $(#[doc = concat!("(", $unit, ")")])?
                pub $key: $type,
                $( $(#[$group_meta])* pub $group: $group_type, )*
            )*
        }

        const _: () = {
            use $crate::scene::declare::parts::*;

            impl Keys for $name {
                const KEYS: &'static [SceneKey] = {
                    const LISTS: &[&[SceneKey]] = &[$(
                        &[SceneKey {
                            name: stringify!($key),
                            kind: <$type as KeyValue>::KIND,
                            default: $default,
                            range: $range,
                            meaning: $meaning,
                            unit: concat!($($unit)?),
                            only: None,
                            family: either($family, <$type as KeyValue>::FAMILY),
                            printed_after: [$(Some($before),)? None][0],
                        }],
                        $( <$group_type as Keys>::KEYS, )*
                    )*];
                    &join::<{ count(LISTS) }>(LISTS)
                };
                const FAMILY: Option<Family> = $family;

                fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Self {
                    Self {
                        $(
                            $key: <$type as KeyValue>::read(builder, here, stringify!($key)),
                            $( $group: <$group_type as Keys>::read(builder, here), )*
                        )*
                    }
                }

                fn print(values: Option<&Self>, page: &mut Page) {
                    $(
                        let value = values.map(|values| &values.$key);
                        <$type as KeyValue>::print(value, page, stringify!($key));
                        $(
                            let group = values.map(|values| &values.$group);
                            <$group_type as Keys>::print(group, page);
                        )*
                    )*
                }
            }

            $( $crate::scene::declare::table!($name, $form, $title); )?
        };
    };
}
pub(super) use keys;

/// Gives keys a table of their own, and makes them the value of the key that holds the table.
macro_rules! table {
    ($name:ident, $form:ident, $title:literal) => {
        static RULES: TableRules = TableRules {
            title: $title,
            form: Form::$form,
            keys: <$name as Keys>::KEYS,
        };

        impl KeyTable for $name {
            const RULES: &'static TableRules = &RULES;
        }

        impl KeyValue for $name {
            const KIND: ValueType = ValueType::Table(&RULES);
            const FAMILY: Option<Family> = <$name as Keys>::FAMILY;

            fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
                read_table(builder, here, name)
            }

            fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
                print_table(value, page, name);
            }
        }
    };
}
pub(super) use table;

/// What the macros of this module use.
pub(super) mod parts {
    pub(in crate::scene) use crate::scene::builder::{Builder, Here};
    pub(in crate::scene) use crate::scene::declare::{
        KeyTable, KeyValue, Keys, either, print_table, read_table,
    };
    pub(in crate::scene) use crate::scene::page::Page;
    pub(in crate::scene) use crate::scene::schema::{
        Family, Form, SceneKey, TableRules, ValueType, count, join,
    };
}

/// The first family that is named.
pub(super) const fn either(first: Option<Family>, second: Option<Family>) -> Option<Family> {
    match first {
        None => second,
        first => first,
    }
}

/// Reads a table; the keys of one that is absent have their defaults.
pub(super) fn read_table<'a, T: KeyTable>(
    builder: &mut Builder<'a>,
    here: Here<'a>,
    name: &'static str,
) -> T {
    let inner = builder.inner(here, name, T::RULES);
    T::read(builder, inner.unwrap_or(Here::absent(T::RULES, name)))
}

/// Prints a table under its header.
pub(super) fn print_table<T: KeyTable>(value: Option<&T>, page: &mut Page, name: &'static str) {
    if page.open(name, T::RULES, value.is_some()) {
        T::print(value, page);
        page.close();
    }
}

/// A table that may be absent.
impl<T: KeyTable> KeyValue for Option<T> {
    const KIND: ValueType = ValueType::Table(T::RULES);
    const FAMILY: Option<Family> = T::FAMILY;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        let inner = builder.inner(here, name, T::RULES)?;
        Some(T::read(builder, inner))
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        print_table(value.and_then(Option::as_ref), page, name);
    }
}

/// A choice; a refused word stands for the default, about which no rule complains.
impl<W: ChoiceWord> KeyValue for W {
    const KIND: ValueType = ValueType::Choice(W::WORDS);

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        let word = builder.word(here, name);
        word.or_else(|| here.default_word(name)).unwrap_or(W::FIRST)
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.map(|value| text(value.word())));
    }
}

impl KeyValue for f64 {
    const KIND: ValueType = ValueType::Number;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        builder.number(here, name)
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.copied().map(number));
    }
}

impl KeyValue for Option<f64> {
    const KIND: ValueType = ValueType::Number;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        builder.optional_number(here, name)
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.copied().flatten().map(number));
    }
}

/// A whole number within the key's range; of a refused one nothing is used.
impl KeyValue for u64 {
    const KIND: ValueType = ValueType::Whole;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        builder.number(here, name) as u64
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.map(u64::to_string));
    }
}

impl KeyValue for Vector3 {
    const KIND: ValueType = ValueType::Vector;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        builder.vector(here, name)
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        let value = value.map(|value| page.vector(*value));
        page.value(name, value);
    }
}

/// A text; an absent one is empty.
impl KeyValue for String {
    const KIND: ValueType = ValueType::Text;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        builder.text(here, name).unwrap_or("").to_owned()
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.map(|value| text(value)));
    }
}

/// The number of dimensions, which is read before anything else.
impl KeyValue for Dimension {
    const KIND: ValueType = ValueType::Dimension;

    fn read<'a>(builder: &mut Builder<'a>, _: Here<'a>, _: &'static str) -> Self {
        builder.dimension
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.map(|value| value.axes().to_string()));
    }
}
