//! Frames as VTP, read by the format's documentation with an XML reader.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use loschmidt_runner::frame::Frame;
use loschmidt_runner::output::vtp::VtpWriter;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use super::csv::csv;
use super::made::{frame, frames, particles};

pub fn vtp(frame: &Frame) -> String {
    let mut bytes = Vec::new();
    VtpWriter::new().write(frame, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// An array as a reader finds it: section, name, type, components, tuples if given, bytes.
struct Array {
    section: String,
    name: String,
    number: String,
    components: usize,
    tuples: Option<usize>,
    bytes: Vec<u8>,
}

impl Array {
    fn words(&self) -> Vec<u64> {
        let (words, rest) = self.bytes.as_chunks::<8>();
        assert!(rest.is_empty(), "{}", self.name);
        words.iter().map(|word| u64::from_le_bytes(*word)).collect()
    }
}

pub fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    let found = element.try_get_attribute(name).unwrap()?;
    Some(found.normalized_value(Default::default()).unwrap().into())
}

/// Reads a VTP file by its documentation: the arrays, and the number of points.
fn read_vtp(text: &str) -> (Vec<Array>, usize) {
    let mut reader = Reader::from_str(text);
    reader.config_mut().check_end_names = true;
    let (mut path, mut appended, mut points) = (Vec::<String>::new(), String::new(), None);
    let mut arrays = Vec::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Start(element) => {
                let name = element.name().as_ref().to_owned();
                let value = |name| attribute(&element, name);
                match name.as_str() {
                    "VTKFile" => {
                        assert_eq!(value("type").unwrap(), "PolyData");
                        assert_eq!(value("version").unwrap(), "1.0");
                        assert_eq!(value("byte_order").unwrap(), "LittleEndian");
                        assert_eq!(value("header_type").unwrap(), "UInt64");
                        assert_eq!(value("compressor"), None);
                    }
                    "Piece" => {
                        points = value("NumberOfPoints");
                        assert_eq!(value("NumberOfVerts"), points);
                    }
                    "AppendedData" => assert_eq!(value("encoding").unwrap(), "base64"),
                    _ => {}
                }
                path.push(name);
            }
            Event::Empty(element) => {
                assert_eq!(element.name().as_ref(), "DataArray");
                let value = |name| attribute(&element, name);
                assert_eq!(value("format").unwrap(), "appended");
                let offset: usize = value("offset").unwrap().parse().unwrap();
                arrays.push((
                    offset,
                    Array {
                        section: path.last().unwrap().clone(),
                        name: value("Name").unwrap(),
                        number: value("type").unwrap(),
                        components: value("NumberOfComponents").unwrap().parse().unwrap(),
                        tuples: value("NumberOfTuples").map(|n| n.parse().unwrap()),
                        bytes: Vec::new(),
                    },
                ));
            }
            Event::Text(content) if path.last().is_some_and(|p| p == "AppendedData") => {
                appended.push_str(&content);
            }
            Event::End(_) => drop(path.pop().unwrap()),
            Event::Eof => break,
            _ => {}
        }
    }
    assert!(path.is_empty());
    let data = appended.trim().strip_prefix('_').unwrap();
    let ends: Vec<usize> = arrays.iter().skip(1).map(|(offset, _)| *offset).collect();
    assert_eq!(arrays[0].0, 0);
    let arrays = arrays.into_iter().zip(ends.into_iter().chain([data.len()]));
    let arrays = arrays.map(|((offset, mut array), end)| {
        // Strict: padding in the middle, or a character too many, is an error.
        let decoded = STANDARD.decode(&data[offset..end]).unwrap();
        let (count, bytes) = decoded.split_first_chunk().unwrap();
        assert_eq!(u64::from_le_bytes(*count), bytes.len() as u64, "byte count");
        array.bytes = bytes.to_vec();
        array
    });
    (arrays.collect(), points.unwrap().parse().unwrap())
}

#[test]
fn vtp_is_xml_that_holds_the_same_bits() {
    for frame in frames() {
        let (arrays, points) = read_vtp(&vtp(&frame));
        let expected = particles(&frame);
        assert_eq!(points, expected.len());
        let layout: Vec<_> = arrays
            .iter()
            .map(|a| (&*a.section, &*a.name, &*a.number, a.components, a.tuples))
            .collect();
        assert_eq!(
            layout,
            [
                ("FieldData", "TimeValue", "Float64", 1, Some(1)),
                ("FieldData", "time", "Float64", 1, Some(1)),
                ("FieldData", "step", "UInt64", 1, Some(1)),
                ("FieldData", "way_back", "UInt8", 1, Some(1)),
                ("FieldData", "particle_mass", "Float64", 1, Some(1)),
                ("PointData", "id", "Int64", 1, None),
                ("PointData", "kind", "UInt8", 1, None),
                ("PointData", "velocity", "Float64", 3, None),
                ("PointData", "density", "Float64", 1, None),
                ("PointData", "pressure", "Float64", 1, None),
                ("Points", "position", "Float64", 3, None),
                ("Verts", "connectivity", "Int64", 1, None),
                ("Verts", "offsets", "Int64", 1, None),
            ]
        );
        let column = |from: usize, to: usize| -> Vec<u64> {
            let values = expected.iter().flat_map(|particle| &particle.2[from..to]);
            values.copied().collect()
        };
        let n = points as u64;
        assert_eq!(arrays[0].words(), [frame.elapsed.to_bits()]);
        assert_eq!(arrays[1].words(), [frame.time.to_bits()]);
        assert_eq!(arrays[2].words(), [frame.step]);
        assert_eq!(arrays[3].bytes, [u8::from(frame.way_back)]);
        assert_eq!(arrays[4].words(), [frame.particle_mass.to_bits()]);
        let ids: Vec<u64> = expected.iter().map(|particle| particle.0).collect();
        assert_eq!(arrays[5].words(), ids);
        let kinds: Vec<u8> = expected.iter().map(|particle| particle.1.into()).collect();
        assert_eq!(arrays[6].bytes, kinds);
        assert_eq!(arrays[7].words(), column(3, 6));
        assert_eq!(arrays[8].words(), column(6, 7));
        assert_eq!(arrays[9].words(), column(7, 8));
        assert_eq!(arrays[10].words(), column(0, 3));
        assert_eq!(arrays[11].words(), (0..n).collect::<Vec<_>>());
        assert_eq!(arrays[12].words(), (1..=n).collect::<Vec<_>>());
    }
}

#[test]
fn the_largest_ids_stay_themselves() {
    let mut frame = frame(3, 3, 2, 0);
    frame.id = vec![0, 1, i64::MAX as u64 - 2];
    let (arrays, _) = read_vtp(&vtp(&frame));
    let last = i64::MAX as u64;
    assert_eq!(arrays[5].words(), [0, 1, last - 2, last - 1, last]);
    assert!(csv(&frame).contains("\n9223372036854775807,wall,"));
}
