//! Keys that exclude each other, and keys that go with one of them.

use super::builder::{Builder, Here};
use super::schema::listed;
use super::spec::Entry;

/// Reports companions of a key that is not given, and companions of the given one that are missing.
pub(super) fn companions<'a>(
    builder: &mut Builder<'a>,
    here: Here<'a>,
    given: &str,
    all: &[(&'static str, &[&str])],
    needed: &[&'static str],
) {
    for (name, owners) in all {
        if let Some(stray) = here.table.get(name)
            && !owners.contains(&given)
        {
            let owners: Vec<String> = owners.iter().map(|owner| format!("`{owner}`")).collect();
            let owners = listed(&owners, "or");
            builder.conflict(
                format!("`{name}` goes with {owners}, not with `{given}`"),
                stray.key,
                "remove it".to_owned(),
            );
        }
    }
    for name in needed {
        if here.table.get(name).is_none() && !here.misspells(name) {
            let message = format!("`{given}` needs `{name}`");
            let meaning = here.rules.key(name).map_or("", |key| key.meaning);
            builder.missing(here, message, vec![format!("`{name}`: {meaning}")]);
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
    // An unknown key is reported already, and was most likely meant to be the missing one.
    if first.is_none()
        && here
            .table
            .entries
            .iter()
            .all(|e| here.rules.key(&e.name).is_some())
    {
        let names: Vec<String> = here
            .rules
            .keys
            .iter()
            .filter(|key| exclusive(key.name) && builder.may_have(key))
            .map(|key| format!("`{}`", key.name))
            .collect();
        let help = format!("one of {}", listed(&names, "or"));
        builder.missing(here, format!("{what} is empty"), vec![help]);
    }
    first
}
