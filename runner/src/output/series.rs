//! `series.csv`: one line per [`Row`], the units in the header.
//!
//! The energies of the model stand between the times and their sum, each as `KIND_J`; what else a
//! model says of the whole comes then, and at the end the linear momentum in kg m/s, which series
//! of earlier versions do not have. Numbers are written in the shortest form that reads back to the
//! same bits.

use crate::run::Row;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, Read, Write};

/// One number of a line.
#[derive(Serialize)]
#[serde(untagged)]
enum Number {
    Whole(u64),
    Signed(i64),
    Sum(i128),
    Real(f64),
    Maybe(Option<f64>),
}

/// A column: its name, its number of a row, and how a row takes it from a text.
type SeriesColumn = (
    &'static str,
    fn(&Row) -> Number,
    fn(&mut Row, &str) -> Option<()>,
);

/// A column of the field of this name.
macro_rules! column {
    ($name:literal, $field:ident, $kind:ident) => {
        (
            $name,
            |row: &Row| Number::$kind(row.$field.into()),
            |row: &mut Row, text: &str| {
                row.$field = text.parse().ok()?;
                Some(())
            },
        )
    };
    ($name:literal, $field:ident) => {
        (
            $name,
            |row: &Row| Number::Maybe(row.$field),
            |row: &mut Row, text: &str| {
                row.$field = match text {
                    "" => None,
                    text => Some(text.parse().ok()?),
                };
                Some(())
            },
        )
    };
}

/// Before the energies.
const HEAD: [SeriesColumn; 5] = [
    column!("step", step, Whole),
    column!("position", position, Signed),
    column!("leg", leg, Whole),
    column!("elapsed_s", elapsed_s, Real),
    column!("time_s", time_s, Real),
];

/// After the energies.
const TAIL: [SeriesColumn; 13] = [
    column!("total_J", total, Real),
    column!("momentum_x_quanta", momentum_x_quanta, Sum),
    column!("momentum_y_quanta", momentum_y_quanta, Sum),
    column!("momentum_z_quanta", momentum_z_quanta, Sum),
    column!("angular_momentum_x_kg_m2_per_s", angular_momentum_x, Real),
    column!("angular_momentum_y_kg_m2_per_s", angular_momentum_y, Real),
    column!("angular_momentum_z_kg_m2_per_s", angular_momentum_z, Real),
    column!("entropy", entropy, Real),
    column!(
        "equilibrium_entropy_of_energy",
        equilibrium_entropy_of_energy
    ),
    column!("equilibrium_entropy_of_fit", equilibrium_entropy_of_fit),
    column!("fitted_temperature_m2_per_s2", fitted_temperature_m2_per_s2),
    column!("faster_than_last_bin", faster_than_last_bin, Whole),
    column!("front_m", front_m, Real),
];

/// The linear momentum, at the end where it is known.
const MOMENTUM: [&str; 3] = [
    "momentum_x_kg_m_per_s",
    "momentum_y_kg_m_per_s",
    "momentum_z_kg_m_per_s",
];

/// The numbers of a row, column by column.
fn columns(row: &Row) -> impl Iterator<Item = (Cow<'_, str>, Number)> {
    let fixed = |column: &'static SeriesColumn| move |row| (column.0.into(), column.1(row));
    let head = HEAD.iter().map(move |column| fixed(column)(row));
    let energies = row.energies.iter();
    let energies = energies.map(|(kind, value)| (heading(kind).into(), Number::Real(*value)));
    let tail = TAIL.iter().map(move |column| fixed(column)(row));
    let totals = row.totals.iter();
    let totals = totals.map(|(name, value)| ((&**name).into(), Number::Real(*value)));
    let momentum = MOMENTUM.into_iter().zip(row.momentum.into_iter().flatten());
    let momentum = momentum.map(|(name, value)| (name.into(), Number::Real(value)));
    head.chain(energies)
        .chain(tail)
        .chain(totals)
        .chain(momentum)
}

/// The bits of every number of a row, with the name of its column.
pub(super) fn numbers(row: &Row) -> Vec<(String, u128)> {
    let bits = |number| match number {
        Number::Whole(n) => u128::from(n),
        Number::Signed(n) => n as u128,
        Number::Sum(n) => n as u128,
        Number::Real(x) => u128::from(x.to_bits()),
        Number::Maybe(Some(x)) => 1 << 64 | u128::from(x.to_bits()),
        Number::Maybe(None) => 0,
    };
    let named = |(name, number): (Cow<'_, str>, Number)| (name.into_owned(), bits(number));
    columns(row).map(named).collect()
}

/// Writes rows; the header comes before the first.
pub struct SeriesWriter<W: Write> {
    csv: csv::Writer<W>,
    begun: bool,
}

impl<W: Write> SeriesWriter<W> {
    /// A series from its first row on.
    pub fn new(writer: W) -> Self {
        Self {
            csv: csv::Writer::from_writer(writer),
            begun: false,
        }
    }

    /// Adds a row and hands it to the operating system.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&mut self, row: &Row) -> io::Result<()> {
        if !std::mem::replace(&mut self.begun, true) {
            let header: Vec<_> = columns(row).map(|(name, _)| name.into_owned()).collect();
            self.csv.write_record(header)?;
        }
        let numbers: Vec<Number> = columns(row).map(|(_, number)| number).collect();
        self.csv.serialize(numbers).map_err(io::Error::from)?;
        self.csv.flush()
    }
}

/// The heading of a kind of energy.
fn heading(kind: &str) -> String {
    format!("{}_J", kind.replace([' ', '-'], "_"))
}

/// Reads all whole lines; a last one without its end, which was cut off, is left out.
///
/// # Errors
/// The reader's, and a malformed line.
pub fn read(mut reader: impl Read) -> io::Result<Vec<Row>> {
    let mut text = Vec::new();
    reader.read_to_end(&mut text)?;
    let whole = text.iter().rposition(|&byte| byte == b'\n');
    let whole = &text[..whole.map_or(0, |end| end + 1)];
    let mut reader = csv::Reader::from_reader(whole);
    let names = VariableColumns::of(reader.headers()?)?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        let row = row(&record, &names);
        rows.push(row.map_err(|column| bad(&format!("`{column}` in line {line}")))?);
    }
    Ok(rows)
}

/// The columns that depend on the model.
#[derive(Default)]
struct VariableColumns {
    /// Kinds of energy.
    kinds: Vec<String>,
    /// Totals.
    totals: Vec<String>,
    /// Whether the momentum stands at the end.
    momentum: bool,
}

impl VariableColumns {
    /// Those that a header names; none of an empty file.
    fn of(header: &csv::StringRecord) -> io::Result<Self> {
        if header.is_empty() {
            return Ok(Self::default());
        }
        let names: Vec<&str> = header.iter().collect();
        let sum = TAIL[0].0;
        let tail = names.iter().position(|name| *name == sum);
        let tail = tail.ok_or_else(|| bad("the header"))?;
        let (head, rest) = names.split_at(tail);
        let fixed = |all: &[&str], columns: &[SeriesColumn]| {
            all.len() >= columns.len() && all.iter().zip(columns).all(|(a, b)| *a == b.0)
        };
        if !fixed(head, &HEAD) || !fixed(rest, &TAIL) {
            return Err(bad("the header"));
        }
        let totals = &rest[TAIL.len()..];
        let without = totals.strip_suffix(&MOMENTUM);
        let kind = |name: &&str| Some(name.strip_suffix("_J")?.to_owned());
        let kinds: Option<Vec<String>> = head[HEAD.len()..].iter().map(kind).collect();
        Ok(Self {
            kinds: kinds.ok_or_else(|| bad("the header"))?,
            totals: without
                .unwrap_or(totals)
                .iter()
                .map(|name| (*name).to_owned())
                .collect(),
            momentum: without.is_some(),
        })
    }
}

/// A line as a row.
///
/// # Errors
/// The column whose number is missing or none.
fn row(record: &csv::StringRecord, names: &VariableColumns) -> Result<Row, String> {
    let mut row = Row::default();
    let mut texts = record.iter();
    for (name, _, read) in &HEAD {
        let number = texts.next().and_then(|text| read(&mut row, text));
        number.ok_or_else(|| (*name).to_owned())?;
    }
    for kind in &names.kinds {
        let value = texts.next().and_then(|text| text.parse().ok());
        let value = value.ok_or_else(|| heading(kind))?;
        row.energies.push((kind.clone().into(), value));
    }
    for (name, _, read) in &TAIL {
        let number = texts.next().and_then(|text| read(&mut row, text));
        number.ok_or_else(|| (*name).to_owned())?;
    }
    for name in &names.totals {
        let value = texts.next().and_then(|text| text.parse().ok());
        let value = value.ok_or_else(|| name.clone())?;
        row.totals.push((name.clone().into(), value));
    }
    if names.momentum {
        let mut momentum = [0.0; 3];
        for (name, value) in MOMENTUM.iter().zip(&mut momentum) {
            let number = texts.next().and_then(|text| text.parse().ok());
            *value = number.ok_or_else(|| (*name).to_owned())?;
        }
        row.momentum = Some(momentum);
    }
    Ok(row)
}

fn bad(what: &str) -> io::Error {
    let message = format!("{what} is not that of a series");
    io::Error::new(io::ErrorKind::InvalidData, message)
}
