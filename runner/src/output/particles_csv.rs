//! A frame as comma-separated values (RFC 4180, with a line feed alone at the end of a line).
//!
//! The first line names the columns with their units; in 2D those of z are absent, and after the
//! velocity come the columns of the model, here of water:
//!
//! ```text
//! id,kind,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,density_kg_per_m3,pressure_Pa
//! 0,fluid,0.01,0.01,0.0,0.0,-0.0,0.0,1000.25,4905.0
//! 1,wall,-0.01,0.01,0.0,0.0,0.0,0.0,NaN,NaN
//! ```
//!
//! Then one line per particle. `id` is a decimal integer, `kind` is `fluid` or `wall`, everything
//! else a float in the fewest decimal digits that a correctly rounding reader turns back into the
//! very same bits (R. Giulietti, *The Schubfach way to render doubles*, 2020): `0.1`, `-0.0`,
//! `1e-300`, `1e+22`, `NaN`, `inf`. No field is ever quoted or empty, and the decimal separator is
//! a point whatever the locale.

use std::io::{self, Write};

use super::PIECE;
use crate::frame::{Frame, FrameColumn};
use crate::totals::heading;
use loschmidt_core::model::Measure;

/// Writes frames as CSV, one after another with the same buffer.
#[derive(Clone, Debug, Default)]
pub struct CsvWriter {
    text: Vec<u8>,
}

impl CsvWriter {
    /// A writer with an empty buffer.
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes one whole file.
    ///
    /// # Errors
    /// `InvalidInput` for a frame that does not pass [`Frame::check`]; else what `to` reports.
    pub fn write(&mut self, frame: &Frame, mut to: impl Write) -> io::Result<()> {
        frame.check()?;
        let axes = frame.dimension;
        self.text.clear();
        let names: Vec<String> = frame.columns.iter().map(|c| heading(&c.measure)).collect();
        self.header(axes, &names);
        let mut numbers = Vec::new();
        let fluid = frame.id.iter().zip(&frame.position).zip(&frame.velocity);
        for (n, ((id, x), v)) in fluid.enumerate() {
            numbers.clear();
            numbers.extend(frame.columns.iter().map(|column| column.values[n]));
            self.row(*id, "fluid", &x[..axes], &v[..axes], &numbers);
            self.spill(&mut to)?;
        }
        numbers.clear();
        numbers.resize(names.len(), f64::NAN);
        for (id, x) in frame.wall_ids().zip(&frame.wall_position) {
            self.row(id, "wall", &x[..axes], &[0.0; 3][..axes], &numbers);
            self.spill(&mut to)?;
        }
        to.write_all(&self.text)
    }

    fn header(&mut self, axes: usize, columns: &[String]) {
        self.text.extend_from_slice(b"id,kind");
        for names in [
            ["x_m", "y_m", "z_m"],
            ["vx_m_per_s", "vy_m_per_s", "vz_m_per_s"],
        ] {
            for name in &names[..axes] {
                self.text.push(b',');
                self.text.extend_from_slice(name.as_bytes());
            }
        }
        for name in columns {
            self.text.push(b',');
            self.text.extend_from_slice(name.as_bytes());
        }
        self.text.push(b'\n');
    }

    fn row(&mut self, id: u64, kind: &str, x: &[f64], v: &[f64], columns: &[f64]) {
        self.integer(id);
        self.text.push(b',');
        self.text.extend_from_slice(kind.as_bytes());
        for value in x.iter().chain(v).chain(columns) {
            self.text.push(b',');
            let mut digits = zmij::Buffer::new();
            self.text
                .extend_from_slice(digits.format(*value).as_bytes());
        }
        self.text.push(b'\n');
    }

    /// Appends an integer in decimal.
    fn integer(&mut self, mut value: u64) {
        let mut digits = [0; 20]; // of u64::MAX
        let mut first = digits.len();
        loop {
            first -= 1;
            digits[first] = b'0' + (value % 10) as u8;
            value /= 10;
            if value == 0 {
                break;
            }
        }
        self.text.extend_from_slice(&digits[first..]);
    }

    /// Hands a full buffer on.
    fn spill(&mut self, to: &mut impl Write) -> io::Result<()> {
        if self.text.len() >= PIECE {
            to.write_all(&self.text)?;
            self.text.clear();
        }
        Ok(())
    }
}

/// Reads a file that [`CsvWriter`] wrote of a model with these columns. What the file does not hold
/// (step, times, way and mass) is 0 or `false`; the dimension is that of the header.
///
/// # Errors
/// The reader's; `InvalidData` for a header or a line that this program does not write.
pub fn read(from: impl io::Read, columns: &[Measure]) -> io::Result<Frame> {
    let mut reader = csv::Reader::from_reader(from);
    let vectors = reader.headers()?.len().checked_sub(2 + columns.len());
    let axes = match vectors {
        Some(4) => 2,
        Some(6) => 3,
        _ => return Err(bad("header", 1)),
    };
    let mut expected = CsvWriter::new();
    expected.header(axes, &columns.iter().map(heading).collect::<Vec<_>>());
    let header: Vec<&str> = reader.headers()?.iter().collect();
    if expected.text.trim_ascii_end() != header.join(",").as_bytes() {
        return Err(bad("header", 1));
    }
    let empty = |&measure: &Measure| FrameColumn {
        measure,
        values: Vec::new(),
    };
    let mut frame = Frame {
        dimension: axes,
        columns: columns.iter().map(empty).collect(),
        ..Frame::default()
    };
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| -> io::Result<f64> {
            let text = record.get(column).unwrap_or_default();
            text.parse().map_err(|_| bad("number", line))
        };
        let vector = |first: usize| -> io::Result<[f64; 3]> {
            let mut x = [0.0; 3];
            for (k, x) in x.iter_mut().enumerate().take(axes) {
                *x = number(first + k)?;
            }
            Ok(x)
        };
        match record.get(1) {
            Some("fluid") => {
                let id = record.get(0).and_then(|text| text.parse().ok());
                frame.id.push(id.ok_or_else(|| bad("id", line))?);
                frame.position.push(vector(2)?);
                frame.velocity.push(vector(2 + axes)?);
                for (n, column) in frame.columns.iter_mut().enumerate() {
                    column.values.push(number(2 + 2 * axes + n)?);
                }
            }
            Some("wall") => frame.wall_position.push(vector(2)?),
            _ => return Err(bad("kind", line)),
        }
    }
    Ok(frame)
}

fn bad(what: &str, line: u64) -> io::Error {
    let message = format!("line {line}: not the {what} of a frame of particles");
    io::Error::new(io::ErrorKind::InvalidData, message)
}
