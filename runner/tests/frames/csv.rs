//! Frames as CSV.

use loschmidt_core::model::Measure;
use loschmidt_runner::frame::{Frame, FrameColumn};
use loschmidt_runner::output::particles_csv::{self, CsvWriter};

use super::made::{AWKWARD, COLUMNS, bits, frames, of_water, particles};

pub fn csv(frame: &Frame) -> String {
    let mut bytes = Vec::new();
    CsvWriter::new().write(frame, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn csv_parses_back_to_the_same_bits() {
    for frame in frames() {
        let text = csv(&frame);
        assert!(text.ends_with('\n'));
        let mut lines = text.lines();
        let header = lines.next().unwrap();
        assert_eq!(
            header,
            match frame.dimension {
                2 => "id,kind,x_m,y_m,vx_m_per_s,vy_m_per_s,density_kg_per_m3,pressure_Pa",
                _ =>
                    "id,kind,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,density_kg_per_m3,pressure_Pa",
            }
        );
        let read: Vec<_> = lines
            .map(|line| {
                let fields: Vec<&str> = line.split(',').collect();
                assert_eq!(fields.len(), header.split(',').count());
                let id = fields[0].parse().unwrap();
                let wall = match fields[1] {
                    "fluid" => false,
                    "wall" => true,
                    other => panic!("kind {other}"),
                };
                let mut values: Vec<f64> = fields[2..].iter().map(|f| f.parse().unwrap()).collect();
                if frame.dimension == 2 {
                    values.insert(2, 0.0);
                    values.insert(5, 0.0);
                }
                (id, wall, bits(&values))
            })
            .collect();
        assert_eq!(read, particles(&frame));
    }
}

#[test]
fn csv_of_a_small_frame_reads_like_this() {
    let frame = Frame {
        dimension: 2,
        id: vec![0, 12],
        position: vec![[0.01, 1e-300, 0.0], [1e22, -0.0, 0.0]],
        velocity: vec![[0.0, -9.81, 0.0], [1.5, f64::INFINITY, 0.0]],
        columns: of_water([vec![1000.0, 1000.25], vec![4905.0, -0.1]]),
        wall_position: vec![[-0.01, 0.3, 0.0]],
        ..Frame::default()
    };
    let expected = "\
id,kind,x_m,y_m,vx_m_per_s,vy_m_per_s,density_kg_per_m3,pressure_Pa
0,fluid,0.01,1e-300,0.0,-9.81,1000.0,4905.0
12,fluid,1e+22,-0.0,1.5,inf,1000.25,-0.1
13,wall,-0.01,0.3,0.0,0.0,NaN,NaN
";
    assert_eq!(csv(&frame), expected);
}

#[test]
fn a_frame_is_read_back_to_the_same_bits() {
    for frame in frames() {
        let read = particles_csv::read(csv(&frame).as_bytes(), COLUMNS).unwrap();
        assert_eq!(read.dimension, frame.dimension);
        assert_eq!(particles(&read), particles(&frame));
    }
}

#[test]
fn columns_of_any_model_are_named_with_their_units_and_read_back() {
    let measure = |name, unit| Measure { name, unit };
    for (columns, names) in [
        (&[][..], ""),
        (
            &[measure("specific entropy", "J/kg")],
            ",specific_entropy_J_per_kg",
        ),
        (
            &[
                measure("shear-rate", "1/s²"),
                measure("damage", ""),
                measure("density", "kg/m³"),
            ],
            ",shear_rate_1_per_s2,damage,density_kg_per_m3",
        ),
    ] {
        for mut frame in frames() {
            let fluid = frame.id.len();
            let column = |(n, &measure): (usize, &Measure)| FrameColumn {
                measure,
                values: (0..fluid)
                    .map(|i| AWKWARD[(i + n) % AWKWARD.len()])
                    .collect(),
            };
            frame.columns = columns.iter().enumerate().map(column).collect();
            let text = csv(&frame);
            let header = text.lines().next().unwrap();
            assert!(header.ends_with(&format!("_per_s{names}")), "{header}");
            let read = particles_csv::read(text.as_bytes(), columns).unwrap();
            assert_eq!(particles(&read), particles(&frame));
            // Of another model.
            assert!(particles_csv::read(text.as_bytes(), COLUMNS).is_err());
        }
    }
}

#[test]
fn a_file_that_holds_no_frame_is_refused_with_its_line() {
    let header = "id,kind,x_m,y_m,vx_m_per_s,vy_m_per_s,density_kg_per_m3,pressure_Pa\n";
    for (text, words) in [
        ("", "line 1: not the header"),
        ("a,b,c,d,e,f,g,h\n", "line 1: not the header"),
        ("0,fluid,1,2,3,4,5,six\n", "line 2: not the number"),
        (
            "0,fluid,1,2,3,4,5,6\n1,gas,1,2,3,4,5,6\n",
            "line 3: not the kind",
        ),
        ("-1,fluid,1,2,3,4,5,6\n", "line 2: not the id"),
        ("0,fluid,1,2,3\n", "found record with 5 fields"),
    ] {
        let text = match text.chars().next() {
            Some('0'..='9' | '-') => header.to_owned() + text,
            _ => text.to_owned(),
        };
        let error = particles_csv::read(text.as_bytes(), COLUMNS)
            .unwrap_err()
            .to_string();
        assert!(error.contains(words), "{words:?} in {error:?}");
    }
}
