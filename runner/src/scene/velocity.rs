//! The first velocity of a region: one field, or several that are added.

use super::builder::{Builder, Here};
use super::exclusive::{companions, report_empty};
use super::region::Velocity;
use super::values::{elements, number, numbers};
use super::words::Dimension;

/// The fields, each with the keys that it needs, in the order in which they are added.
const FIELDS: [(&str, &[&str]); 7] = [
    ("uniform", &[]),
    ("rotation", &[]),
    ("gresho", &[]),
    ("kepler", &[]),
    ("bending", &["wave_number", "a1", "a2"]),
    ("twist", &["height"]),
    ("linear", &[]),
];

/// The keys that go with a field, and with which.
const COMPANIONS: [(&str, &[&str]); 8] = [
    ("centre", &["rotation", "gresho", "kepler"]),
    ("radius", &["gresho"]),
    ("offset", &["linear"]),
    ("wave_number", &["bending"]),
    ("a1", &["bending"]),
    ("a2", &["bending"]),
    ("start", &["bending"]),
    ("height", &["twist"]),
];

/// Reads the fields of a velocity; those that turn have one centre.
pub(super) fn velocity<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Vec<Velocity> {
    let is_given = |(name, _): &(&str, &[&str])| here.table.get(name).is_some();
    let given: Vec<_> = FIELDS.into_iter().filter(is_given).collect();
    if given.is_empty() {
        let is_field = |name: &str| FIELDS.iter().any(|(field, _)| *field == name);
        report_empty(builder, here, "the velocity", is_field);
        return Vec::new();
    }
    companions(builder, here, &given, &COMPANIONS);
    let names = given.into_iter();
    names.map(|(name, _)| field(builder, here, name)).collect()
}

/// Reads the field of this name.
fn field<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &str) -> Velocity {
    match name {
        "uniform" => Velocity::Uniform(builder.vector(here, name)),
        "rotation" => Velocity::Rotation {
            omega: match (builder.dimension, here.table.get(name)) {
                (Dimension::Two, Some(entry)) if number(&entry.node).is_some() => {
                    [0.0, 0.0, builder.number(here, name)]
                }
                _ => builder.vector(here, name),
            },
            centre: builder.vector(here, "centre"),
        },
        "gresho" => Velocity::Gresho {
            peak: builder.number(here, name),
            radius: builder.number(here, "radius"),
            centre: builder.vector(here, "centre"),
        },
        "kepler" => Velocity::Kepler {
            strength: builder.number(here, name),
            centre: builder.vector(here, "centre"),
        },
        "bending" => Velocity::Bending {
            peak: builder.number(here, name),
            wave_number: builder.number(here, "wave_number"),
            shape: ["a1", "a2"].map(|name| builder.number(here, name)),
            start: builder.number(here, "start"),
        },
        "twist" => Velocity::Twist {
            rate: builder.number(here, name),
            height: builder.number(here, "height"),
        },
        _ => {
            let rows = here.table.get(name).map(|entry| elements(&entry.node));
            let rows = rows.unwrap_or_default();
            Velocity::Linear {
                matrix: std::array::from_fn(|i| rows.get(i).map_or([0.0; 3], numbers)),
                offset: builder.vector(here, "offset"),
            }
        }
    }
}
