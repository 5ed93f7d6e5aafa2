//! Names of what a model says of a particle and of the whole: in files, and for people.

use loschmidt_core::Fixed;
use loschmidt_core::model::{Measure, Model};
use loschmidt_core::schemes::superfluid::Superfluid;

/// A measure with its unit, as headings of files and keys of JSON have it: in letters that every
/// reader takes for a name.
#[must_use]
pub fn heading(measure: &Measure) -> String {
    let unit = measure
        .unit
        .replace('/', "_per_")
        .replace('²', "2")
        .replace('³', "3")
        .replace(['(', ')'], "")
        .replace(' ', "_");
    let name = measure.name.replace([' ', '-'], "_");
    match unit.is_empty() {
        true => name,
        false => format!("{name}_{unit}"),
    }
}

/// A total by its heading in a series ([`heading`]): its name, and its unit.
#[must_use]
pub fn total_for_people(written: &str) -> (String, &'static str) {
    let all = <Superfluid<Fixed, 2> as Model<Fixed, 2>>::TOTALS.iter();
    let mut all = all.filter(|measure| heading(measure) == written);
    match all.next() {
        Some(measure) => (measure.name.to_owned(), measure.unit),
        None => (written.replace('_', " "), ""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_names_and_are_read_back_for_people() {
        let all = <Superfluid<Fixed, 2> as Model<Fixed, 2>>::TOTALS.iter();
        let columns = <Superfluid<Fixed, 2> as Model<Fixed, 2>>::COLUMNS.iter();
        for measure in all.clone().chain(columns) {
            let name = heading(measure);
            let fit = |c: char| c.is_ascii_alphanumeric() || c == '_';
            assert!(name.chars().all(fit), "{name}");
        }
        for measure in all {
            let expected = (measure.name.to_owned(), measure.unit);
            assert_eq!(total_for_people(&heading(measure)), expected);
        }
    }
}
