//! A frame as VTK XML PolyData: what ParaView, VisIt, PyVista and meshio open.
//!
//! The format is that of *VTK XML File Formats* (VTK User's Guide; docs.vtk.org), version 1.0 with
//! 64-bit headers, uncompressed, appended data in base64. The file is ASCII and well-formed
//! XML throughout:
//!
//! ```text
//! <?xml version="1.0"?>
//! <VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
//!   <PolyData>
//!     <FieldData>                  one value each:
//!       TimeValue      Float64     Frame::elapsed, s (the name by which VTK knows a file's time)
//!       time           Float64     Frame::time, s
//!       step           UInt64      Frame::step
//!       way_back       UInt8       0 on the way out, 1 on the way back
//!       particle_mass  Float64     kg
//!     <Piece NumberOfPoints=".." NumberOfVerts="..">    one vertex cell per particle
//!       <PointData>                one tuple per particle, fluid first, then walls:
//!         id           Int64
//!         kind         UInt8       0 fluid, 1 wall
//!         velocity     Float64 x3  m/s
//!         density      Float64     kg/m³   \ the columns of the model, here of water; the last
//!         pressure     Float64     Pa      / one is what a viewer shows first
//!       <Points>
//!         position     Float64 x3  m
//!       <Verts>
//!         connectivity Int64       0, 1, 2, ..: cell i is point i
//!         offsets      Int64       1, 2, 3, ..: where cell i ends in `connectivity`
//!   <AppendedData encoding="base64">_...
//! ```
//!
//! Each array is an element `<DataArray type name NumberOfComponents format="appended" offset>`
//! with no content. Its bytes stand in `AppendedData` in the order of the table: `offset`
//! characters after the underscore begins the base64 text (RFC 4648 §4, padded) of
//!
//! | bytes | value                                             |
//! |-------|---------------------------------------------------|
//! | 8     | n, the number of bytes that follow; little-endian |
//! | n     | the array, little-endian, tuple after tuple       |
//!
//! and takes 4⌈(8 + n)/3⌉ characters.

use std::io::{self, Write};
use std::ops::Range;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::{PIECE, PointKind};
use crate::frame::Frame;

/// An array of the file.
struct Array {
    name: &'static str,
    /// VTK's name of the type of its numbers.
    number: &'static str,
    /// Size of a tuple in bytes.
    tuple_bytes: usize,
    /// Numbers per tuple.
    components: usize,
    /// Appends the bytes of some of its tuples.
    fill: Fill,
}

/// What appends the bytes of some tuples of an array.
#[derive(Clone, Copy)]
enum Fill {
    /// Of a frame's fixed lists.
    With(fn(&Frame, Range<usize>, &mut Vec<u8>)),
    /// Of this column of the model.
    Column(usize),
}

impl Array {
    fn fill(&self, frame: &Frame, places: Range<usize>, raw: &mut Vec<u8>) {
        match self.fill {
            Fill::With(fill) => fill(frame, places, raw),
            Fill::Column(n) => fluid_scalars(&frame.columns[n].values, split(frame, places), raw),
        }
    }
}

const fn array(
    name: &'static str,
    number: &'static str,
    tuple_bytes: usize,
    components: usize,
    fill: fn(&Frame, Range<usize>, &mut Vec<u8>),
) -> Array {
    Array {
        name,
        number,
        tuple_bytes,
        components,
        fill: Fill::With(fill),
    }
}

const FIELD_DATA: [Array; 5] = [
    array("TimeValue", "Float64", 8, 1, |frame, _, raw| {
        raw.extend_from_slice(&frame.elapsed.to_le_bytes());
    }),
    array("time", "Float64", 8, 1, |frame, _, raw| {
        raw.extend_from_slice(&frame.time.to_le_bytes());
    }),
    array("step", "UInt64", 8, 1, |frame, _, raw| {
        raw.extend_from_slice(&frame.step.to_le_bytes());
    }),
    array("way_back", "UInt8", 1, 1, |frame, _, raw| {
        raw.push(frame.way_back.into());
    }),
    array("particle_mass", "Float64", 8, 1, |frame, _, raw| {
        raw.extend_from_slice(&frame.particle_mass.to_le_bytes());
    }),
];

const POINT_DATA: [Array; 3] = [
    array("id", "Int64", 8, 1, |frame, places, raw| {
        let (fluid, walls) = split(frame, places);
        let ids = frame.wall_ids().skip(walls.start).take(walls.len());
        for id in frame.id[fluid].iter().copied().chain(ids) {
            raw.extend_from_slice(&id.to_le_bytes());
        }
    }),
    array("kind", "UInt8", 1, 1, |frame, places, raw| {
        let (fluid, walls) = split(frame, places);
        raw.resize(raw.len() + fluid.len(), PointKind::Fluid as u8);
        raw.resize(raw.len() + walls.len(), PointKind::Wall as u8);
    }),
    array("velocity", "Float64", 24, 3, |frame, places, raw| {
        let (fluid, walls) = split(frame, places);
        vectors(&frame.velocity[fluid], raw);
        raw.resize(raw.len() + 24 * walls.len(), 0); // the bytes of 0.0
    }),
];

/// Everything that is recorded of a point.
fn point_data(frame: &Frame) -> Vec<Array> {
    let columns = frame.columns.iter().enumerate();
    let columns = columns.map(|(n, column)| Array {
        name: column.measure.name,
        number: "Float64",
        tuple_bytes: 8,
        components: 1,
        fill: Fill::Column(n),
    });
    POINT_DATA.into_iter().chain(columns).collect()
}

const POINTS: [Array; 1] = [array("position", "Float64", 24, 3, |frame, places, raw| {
    let (fluid, walls) = split(frame, places);
    vectors(&frame.position[fluid], raw);
    vectors(&frame.wall_position[walls], raw);
})];

const VERTS: [Array; 2] = [
    array("connectivity", "Int64", 8, 1, |_, places, raw| {
        places.for_each(|i| raw.extend_from_slice(&(i as u64).to_le_bytes()));
    }),
    array("offsets", "Int64", 8, 1, |_, places, raw| {
        places.for_each(|i| raw.extend_from_slice(&(i as u64 + 1).to_le_bytes()));
    }),
];

/// Places in the lists of the fluid and of the walls.
fn split(frame: &Frame, places: Range<usize>) -> (Range<usize>, Range<usize>) {
    let n = frame.id.len();
    let fluid = places.start.min(n)..places.end.min(n);
    (fluid, places.start.max(n) - n..places.end.max(n) - n)
}

fn vectors(values: &[[f64; 3]], raw: &mut Vec<u8>) {
    for value in values.as_flattened() {
        raw.extend_from_slice(&value.to_le_bytes());
    }
}

fn fluid_scalars(values: &[f64], (fluid, walls): (Range<usize>, Range<usize>), raw: &mut Vec<u8>) {
    for value in &values[fluid] {
        raw.extend_from_slice(&value.to_le_bytes());
    }
    for _ in walls {
        raw.extend_from_slice(&f64::NAN.to_le_bytes());
    }
}

/// Writes frames as VTP, one after another with the same buffers.
#[derive(Clone, Debug, Default)]
pub struct VtpWriter {
    raw: Vec<u8>,
    text: Vec<u8>,
}

impl VtpWriter {
    /// A writer with empty buffers.
    pub fn new() -> Self {
        Self::default()
    }

    /// Writes one whole file.
    ///
    /// # Errors
    /// `InvalidInput` for a frame that does not pass [`Frame::check`]; else what `to` reports.
    pub fn write(&mut self, frame: &Frame, mut to: impl Write) -> io::Result<()> {
        frame.check()?;
        self.text.clear();
        let points = point_data(frame);
        header(frame, &points, &mut self.text)?;
        to.write_all(&self.text)?;
        for array in &FIELD_DATA {
            self.append(array, frame, 1, &mut to)?;
        }
        for array in points.iter().chain(&POINTS).chain(&VERTS) {
            self.append(array, frame, frame.particles(), &mut to)?;
        }
        to.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
    }

    /// Writes the base64 text of an array of so many tuples.
    fn append(
        &mut self,
        array: &Array,
        frame: &Frame,
        tuples: usize,
        to: &mut impl Write,
    ) -> io::Result<()> {
        // As many tuples as make about a piece of text.
        const TUPLES: usize = PIECE / 32;
        let length = (array.tuple_bytes * tuples) as u64;
        self.raw.clear();
        self.raw.extend_from_slice(&length.to_le_bytes());
        let mut first = 0;
        loop {
            let last = (first + TUPLES).min(tuples);
            array.fill(frame, first..last, &mut self.raw);
            // Padding stands only at the end: whole threes, and the rest goes on.
            let whole = match last == tuples {
                true => self.raw.len(),
                false => self.raw.len() / 3 * 3,
            };
            self.text.resize(whole.div_ceil(3) * 4, 0);
            let written = STANDARD.encode_slice(&self.raw[..whole], &mut self.text);
            to.write_all(&self.text[..written.map_err(io::Error::other)?])?;
            self.raw.drain(..whole);
            if last == tuples {
                break;
            }
            first = last;
        }
        Ok(())
    }
}

/// Everything before the appended data.
fn header(frame: &Frame, points: &[Array], text: &mut Vec<u8>) -> io::Result<()> {
    let particles = frame.particles();
    let mut offset = 0_u64;
    let mut section =
        |text: &mut Vec<u8>, indent: &str, tag: &str, arrays: &[Array], tuples: usize| {
            let name = tag.split(' ').next().unwrap_or(tag);
            writeln!(text, "{indent}<{tag}>")?;
            for array in arrays {
                // Field data are not per point or cell: VTK takes their number from here.
                let count = match name {
                    "FieldData" => " NumberOfTuples=\"1\"",
                    _ => "",
                };
                writeln!(
                    text,
                    "{indent}  <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{count} \
                 format=\"appended\" offset=\"{offset}\"/>",
                    array.number, array.name, array.components,
                )?;
                offset += (8 + array.tuple_bytes as u64 * tuples as u64).div_ceil(3) * 4;
            }
            writeln!(text, "{indent}</{name}>")
        };
    text.write_all(
        b"<?xml version=\"1.0\"?>\n\
          <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
          header_type=\"UInt64\">\n  <PolyData>\n",
    )?;
    section(text, "    ", "FieldData", &FIELD_DATA, 1)?;
    writeln!(
        text,
        "    <Piece NumberOfPoints=\"{particles}\" NumberOfVerts=\"{particles}\" \
         NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">"
    )?;
    let shown = frame.columns.last().map_or(String::new(), |column| {
        format!(" Scalars=\"{}\"", column.measure.name)
    });
    let point_data = format!("PointData{shown} Vectors=\"velocity\"");
    section(text, "      ", &point_data, points, particles)?;
    section(text, "      ", "Points", &POINTS, particles)?;
    section(text, "      ", "Verts", &VERTS, particles)?;
    text.write_all(b"    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"base64\">\n    _")
}
