//! Keys that exclude each other, and keys that go with one of them.

use super::builder::{Builder, Here};
use super::schema::listed;
use super::spec::Entry;

/// Reports companions of keys that are not given, and companions of the given ones that are
/// missing: each of those with what it needs.
pub(super) fn companions<'a>(
    builder: &mut Builder<'a>,
    here: Here<'a>,
    given: &[(&str, &[&'static str])],
    all: &[(&'static str, &[&str])],
) {
    let in_words = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        listed(&names, "or")
    };
    let names: Vec<&str> = given.iter().map(|(name, _)| *name).collect();
    for (name, owners) in all {
        if let Some(stray) = here.table.get(name)
            && !owners.iter().any(|owner| names.contains(owner))
        {
            let (owners, given) = (in_words(owners), in_words(&names));
            builder.conflict(
                format!("`{name}` goes with {owners}, not with {given}"),
                stray.key,
                "remove it".to_owned(),
            );
        }
    }
    for (owner, needed) in given {
        for name in *needed {
            if here.table.get(name).is_none() && !here.misspells(name) {
                let message = format!("`{owner}` needs `{name}`");
                let meaning = here.rules.key(name).map_or("", |key| key.meaning);
                builder.missing(here, message, vec![format!("`{name}`: {meaning}")]);
            }
        }
    }
}

/// Of the keys that exclude each other, the one that is given.
pub(super) fn only_one<'a>(
    builder: &mut Builder<'a>,
    here: Here<'a>,
    what: &str,
    exclusive: impl Fn(&str) -> bool,
) -> Option<&'a Entry> {
    let mut given = here
        .table
        .entries
        .iter()
        .filter(|entry| exclusive(&entry.name));
    let first = given.next();
    if let (Some(first), Some(second)) = (first, given.next()) {
        builder.conflict(
            format!(
                "{what} is given twice: as `{}` and as `{}`",
                first.name, second.name
            ),
            second.key,
            "keep one of them".to_owned(),
        );
    }
    if first.is_none() {
        report_empty(builder, here, what, exclusive);
    }
    first
}

/// Reports that none of the keys is given.
pub(super) fn report_empty<'a>(
    builder: &mut Builder<'a>,
    here: Here<'a>,
    what: &str,
    of_them: impl Fn(&str) -> bool,
) {
    // An unknown key is reported already, and was most likely meant to be the missing one.
    if here
        .table
        .entries
        .iter()
        .all(|e| here.rules.key(&e.name).is_some())
    {
        let names: Vec<String> = here
            .rules
            .keys
            .iter()
            .filter(|key| of_them(key.name) && builder.may_have(key))
            .map(|key| format!("`{}`", key.name))
            .collect();
        let help = format!("one of {}", listed(&names, "or"));
        builder.missing(here, format!("{what} is empty"), vec![help]);
    }
}
