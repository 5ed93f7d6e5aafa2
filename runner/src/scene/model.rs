//! The models that a scene can choose from: one table, one entry for each.
//!
//! An entry names the model's word, the family whose keys it reads, and what it does not go with.
//! To add a model, add an entry here; if it has keys of its own, declare them in a module beside
//! [`wcsph`] with a family of their own (see [`declare`](super::declare)), and put the group or
//! table that they make up into the declaration of [`Scene`](super::Scene). Keys of another family
//! are refused in a scene, and left out where it is printed.

use super::schema::Family;
use super::wcsph;
use super::words::{ChoiceWord, words};

/// A key that a model does not go with.
pub(super) struct Exclusion {
    pub key: &'static str,
    /// The only word that the key may have; `None` where the key may not stand in the scene at all.
    pub unless: Option<&'static str>,
    pub help: &'static str,
}

/// Declares [`Model`] and what is known of each from one list.
macro_rules! models {
    (
        $(
            $(#[$doc:meta])*
            $variant:ident = $word:literal, $family:expr, $exclusions:expr;
        )+
    ) => {
        words! {
            /// Which discretisation advances the fluid.
            Model { $($(#[$doc])* $variant = $word,)+ }
        }

        impl Model {
            /// The models that share keys with this one.
            pub(super) const fn family(self) -> Family {
                match self { $(Self::$variant => $family,)+ }
            }

            /// What this model does not go with.
            pub(super) const fn exclusions(self) -> &'static [Exclusion] {
                match self { $(Self::$variant => $exclusions,)+ }
            }
        }
    };
}

models! {
    /// Density by summation over the neighbours: Hamiltonian and reversible.
    Symplectic = "symplectic", wcsph::FAMILY, &[];
    /// Density advanced in time by the continuity equation: not reversible.
    Standard = "standard", wcsph::FAMILY, &[Exclusion {
        key: "integrator",
        unless: Some("stormer-verlet"),
        help: "the standard scheme has a kick, a drift and a kick of its own: \
               write `integrator = \"stormer-verlet\"`, or `model = \"symplectic\"`",
    }];
    /// The symplectic scheme with its noise filtered out every few steps: dissipative.
    Filtered = "filtered", wcsph::FAMILY, &[Exclusion {
        key: "turnaround",
        unless: None,
        help: "the filter takes noise and energy out of the flow, and nothing brings them back: \
               write `end`, or `model = \"symplectic\"`",
    }];
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
