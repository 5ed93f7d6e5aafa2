//! The models that a scene can choose from: those of [`crate::model_list`], and those that a
//! program has registered.
//!
//! If a model has keys of its own, declare them in a module beside [`wcsph`] with a family of their
//! own (see [`declare`](super::declare)), and put the group or table that they make up into the
//! declaration of [`Scene`](super::Scene). Keys of another family are refused in a scene, and left
//! out where it is printed.

use super::builder::{Builder, Here};
use super::declare::KeyValue;
use super::page::{Page, text};
use super::schema::{Family, ValueType};
use super::{solid, superfluid, viscous, wcsph};
use crate::model_list::for_each_model;
use std::sync::{PoisonError, RwLock};

/// A key that a model does not go with.
pub(super) struct Exclusion {
    pub key: &'static str,
    /// The only word that the key may have; `None` where the key may not stand in the scene at all.
    pub unless: Option<&'static str>,
    pub help: &'static str,
}

/// Declares [`Model`] and what is known of each from the list.
macro_rules! scene_models {
    (
        $(
            $(#[$doc:meta])*
            $variant:ident = $word:literal, keys $family:ident,
            made by $made:path, from $from:ident,
            except [$($exclusion:expr),* $(,)?];
        )+
    ) => {
        /// Which discretisation advances the fluid.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Model {
            $($(#[$doc])* $variant,)+
            /// One that the program has registered, by its name ([`crate::own`]).
            Own(&'static str),
        }

        impl Model {
            /// Every word of the models of this package, as a scene spells it.
            pub const WORDS: &'static [&'static str] = &[$($word),+];

            /// The word a scene uses for this value.
            #[must_use]
            pub const fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                    Self::Own(name) => name,
                }
            }

            fn of_this_package(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)+ _ => None }
            }

            /// The models that share keys with this one.
            pub(super) const fn family(self) -> Family {
                match self {
                    $(Self::$variant => $family::FAMILY,)+
                    Self::Own(_) => wcsph::FAMILY,
                }
            }

            /// What this model does not go with.
            pub(super) const fn exclusions(self) -> &'static [Exclusion] {
                match self {
                    $(Self::$variant => &[$($exclusion),*],)+
                    Self::Own(_) => &[],
                }
            }
        }
    };
}
for_each_model!(scene_models);

/// Names of the models that the program has registered.
static OWN: RwLock<Vec<&'static str>> = RwLock::new(Vec::new());

impl KeyValue for Model {
    const KIND: ValueType = ValueType::Model(Self::WORDS);

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &'static str) -> Self {
        let word = builder.text(here, name);
        word.and_then(Self::from_word).unwrap_or(Self::Symplectic)
    }

    fn print(value: Option<&Self>, page: &mut Page, name: &'static str) {
        page.value(name, value.map(|value| text(value.word())));
    }
}

impl Model {
    /// Lets scenes name a model that the program has registered.
    pub(crate) fn know(name: &'static str) {
        let mut own = OWN.write().unwrap_or_else(PoisonError::into_inner);
        if !own.contains(&name) {
            own.push(name);
        }
    }

    /// The model that a word stands for.
    pub(super) fn from_word(word: &str) -> Option<Self> {
        let own = || {
            let own = OWN.read().unwrap_or_else(PoisonError::into_inner);
            let name = own.iter().find(|name| **name == word)?;
            Some(Self::Own(name))
        };
        Self::of_this_package(word).or_else(own)
    }

    /// Every word that a scene may write.
    pub(super) fn known() -> Vec<&'static str> {
        let own = OWN.read().unwrap_or_else(PoisonError::into_inner);
        Self::WORDS.iter().chain(&*own).copied().collect()
    }
}

impl Model {
    /// The words of the models of a family.
    pub(super) fn words_of(family: Family) -> Vec<&'static str> {
        Self::WORDS
            .iter()
            .copied()
            .filter(|word| Self::from_word(word).is_some_and(|model| model.family() == family))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::wcsph;
    use crate::scene::builder::{Builder, Here};
    use crate::scene::check::check_as;
    use crate::scene::declare::{KeyTable, Keys, keys};
    use crate::scene::page::Page;
    use crate::scene::schema::IfAbsent::{Optional, Required};
    use crate::scene::schema::Range::{Above, Any};
    use crate::scene::schema::{ANY_MODEL, Family};
    use crate::scene::source::SourceText;
    use crate::scene::spec::SceneSpec;
    use crate::scene::words::Dimension;

    const SOLID: Family = "elastic";
    const ELASTIC: Option<Family> = Some(SOLID);

    keys! {
        /// The keys of a model that does not exist.
        Solid of ELASTIC, table Header "`[solid]`" {
            stiffness: f64 = Required, Above(0.0), "Young's modulus", "Pa";
        }
    }

    keys! {
        /// A top level that has them.
        Body of ANY_MODEL, table File "the top level" {
            name: String = Optional, Any, "short name";
            solid: Solid = Required, Any, "what the solid is";
        }
    }

    fn parse(text: &str) -> SceneSpec {
        let source = SourceText {
            name: "body.toml".to_owned(),
            stem: "body".to_owned(),
            text: text.to_owned(),
        };
        SceneSpec::parse(source).expect("TOML")
    }

    fn read(text: &str, family: Family) -> Result<Body, String> {
        let spec = parse(text);
        let top = Here::top(&spec.root, Body::RULES);
        let mut builder = Builder::new(&spec, Dimension::Two, Some(family), Vec::new());
        builder.require_tables(top);
        let body = Body::read(&mut builder, top);
        builder.finish(body).map_err(|error| error.to_string())
    }

    fn print(body: &Body, family: Family) -> String {
        let mut page = Page::new(Body::RULES, Dimension::Two, family, Vec::new());
        Body::print(Some(body), &mut page);
        page.finish()
    }

    #[test]
    fn a_model_with_keys_of_its_own_reads_prints_and_needs_them() {
        let body = read("name = \"rod\"\nsolid.stiffness = 2e9", SOLID).expect("a body");
        assert_eq!(body.solid.stiffness, 2e9);
        let printed = "name = \"rod\"  # text; short name\n\n\
                       [solid]\nstiffness = 2000000000.0  # Pa; Young's modulus\n";
        assert_eq!(print(&body, SOLID), printed);
        let error = read("", SOLID).expect_err("a missing table");
        assert!(error.contains("`[solid]` is missing"), "{error}");
    }

    #[test]
    fn other_models_need_and_print_no_such_keys_and_refuse_them() {
        let body = read("name = \"rod\"", wcsph::FAMILY).expect("a body");
        let printed = "name = \"rod\"  # text; short name\n";
        assert_eq!(print(&body, wcsph::FAMILY), printed);
        let problems = check_as(&parse("solid.stiffness = 2e9"), Body::RULES);
        let messages: Vec<&str> = problems.iter().map(|p| p.message.as_str()).collect();
        assert_eq!(messages, ["`solid` is a key of another model"]);
        let problems = check_as(
            &parse("model = \"foo\"\nsolid.stiffness = 2e9"),
            Body::RULES,
        );
        assert_eq!(problems.len(), 1, "the model alone is unknown here");
    }
}
