//! Particle frames on their way into files and back.

mod csv;
mod made;
mod pvd;
mod vtp;

use std::env;
use std::fs::{self, File};
use std::io;
use std::path::Path;

use loschmidt_runner::frame::{Frame, FrameError};
use loschmidt_runner::output::particles_csv::CsvWriter;
use loschmidt_runner::output::pvd::Collection;
use loschmidt_runner::output::vtp::VtpWriter;
use loschmidt_runner::output::{COLLECTION, frame_path};

use self::csv::csv;
use self::made::{frame, frames};
use self::vtp::vtp;

#[test]
fn a_used_writer_writes_what_a_new_one_does() {
    let (mut csv_writer, mut vtp_writer) = (CsvWriter::new(), VtpWriter::new());
    for frame in frames().iter().rev() {
        let (mut as_csv, mut as_vtp) = (Vec::new(), Vec::new());
        csv_writer.write(frame, &mut as_csv).unwrap();
        vtp_writer.write(frame, &mut as_vtp).unwrap();
        assert!(as_csv == csv(frame).into_bytes());
        assert!(as_vtp == vtp(frame).into_bytes());
    }
}

#[test]
fn a_frame_that_fits_no_file_is_refused_before_the_first_byte() {
    let good = frame(2, 3, 2, 0);
    let broken = |change: &dyn Fn(&mut Frame)| {
        let mut frame = good.clone();
        change(&mut frame);
        let mut bytes = Vec::new();
        let error = VtpWriter::new().write(&frame, &mut bytes).unwrap_err();
        let same = CsvWriter::new().write(&frame, &mut bytes).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
        assert_eq!(error.to_string(), same.to_string());
        assert!(bytes.is_empty());
        frame.check().unwrap_err()
    };
    let (list, found, expected) = ("density", 2, 3);
    assert_eq!(
        broken(&|f| f.columns[0].values.truncate(2)),
        FrameError::Length {
            list,
            found,
            expected
        }
    );
    assert_eq!(broken(&|f| f.dimension = 1), FrameError::Dimension(1));
    assert_eq!(
        broken(&|f| f.id[2] = f.id[1]),
        FrameError::IdOrder { index: 2 }
    );
    let last = i64::MAX as u64 - 1;
    assert_eq!(broken(&|f| f.id[2] = last), FrameError::IdRange { last });
    let list = "wall_position";
    assert_eq!(
        broken(&|f| f.wall_position[1][2] = 0.5),
        FrameError::OutOfPlane { list, index: 1 }
    );
}

#[test]
fn a_full_disk_is_reported() {
    let mut small = [0; 1000];
    let frame = frame(3, 100, 0, 0);
    for error in [
        CsvWriter::new().write(&frame, &mut small[..]).unwrap_err(),
        VtpWriter::new().write(&frame, &mut small[..]).unwrap_err(),
    ] {
        assert_eq!(error.kind(), io::ErrorKind::WriteZero);
    }
}

/// Leaves a run's files, for a program that reads VTK: see `tests/vtk/run.sh`.
#[test]
fn writes_the_files_of_a_run() {
    let directory = match env::var_os("LOSCHMIDT_FRAMES_DIR") {
        Some(given) => given.into(),
        None => Path::new(env!("CARGO_TARGET_TMPDIR")).join("frames"),
    };
    fs::create_dir_all(directory.join("frames")).unwrap();
    let (mut csv, mut vtp) = (CsvWriter::new(), VtpWriter::new());
    let mut collection = Collection::new();
    for (index, frame) in frames().iter().enumerate() {
        let index = index as u64;
        let path = frame_path(index, "csv");
        csv.write(frame, File::create(directory.join(path)).unwrap())
            .unwrap();
        let path = frame_path(index, "vtp");
        vtp.write(frame, File::create(directory.join(&path)).unwrap())
            .unwrap();
        collection.push(frame.elapsed, path).unwrap();
    }
    collection
        .write(File::create(directory.join(COLLECTION)).unwrap())
        .unwrap();
}
