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

/// Reads all whole lines; a last one without its end, which was cut off, is left out.
///
/// # Errors
/// The reader's, and a malformed line.
pub fn read(mut reader: impl Read) -> std::io::Result<Vec<Row>> {
    let mut text = Vec::new();
    reader.read_to_end(&mut text)?;
    let whole = text.iter().rposition(|&byte| byte == b'\n');
    let whole = &text[..whole.map_or(0, |end| end + 1)];
    let rows: csv::Result<Vec<Row>> = csv::Reader::from_reader(whole).into_deserialize().collect();
    Ok(rows?)
}
