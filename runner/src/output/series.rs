//! `series.csv`: one line per [`Row`], the units in the header.
//!
//! Numbers are written in the shortest form that reads back to the same bits.

use crate::run::Row;
use std::io::{Read, Write};

/// Writes rows; the header comes before the first.
pub struct SeriesWriter<W: Write> {
    csv: csv::Writer<W>,
}

impl<W: Write> SeriesWriter<W> {
    /// A series from its first row on.
    pub fn new(writer: W) -> Self {
        Self {
            csv: csv::Writer::from_writer(writer),
        }
    }

    /// Adds a row and hands it to the operating system.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&mut self, row: &Row) -> std::io::Result<()> {
        self.csv.serialize(row).map_err(std::io::Error::from)?;
        self.csv.flush()
    }
}

/// Reads all complete rows; a last line that was cut off in the middle is ignored.
///
/// # Errors
/// The reader's, and a malformed line before the last.
pub fn read(reader: impl Read) -> std::io::Result<Vec<Row>> {
    let mut rows = Vec::new();
    let mut records = csv::Reader::from_reader(reader).into_deserialize::<Row>();
    while let Some(row) = records.next() {
        match row {
            Ok(row) => rows.push(row),
            Err(error) if records.reader().is_done() || error.is_io_error() => {
                if error.is_io_error() {
                    return Err(error.into());
                }
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok(rows)
}
