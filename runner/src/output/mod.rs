//! What a run leaves on disk.
//!
//! | file in the directory of a run | written by | holds |
//! |---|---|---|
//! | `manifest.json` | [`Manifest`] | version, status, digests, the result |
//! | `scene.toml` | [`crate::scene`] | the scene as it was run, overrides included |
//! | `series.csv` | [`series`] | energies, momenta, entropy; units in the header |
//! | `snapshots/home.snapshot`, `turnaround.snapshot`, `latest.snapshot` | [`snapshot`] | states to resume from |
//! | `particles.pvd` | [`pvd::Collection`] | when each frame is, for ParaView |
//! | `frames/particles-000000.vtp` | [`vtp::VtpWriter`] | frame 0 |
//! | `frames/particles-000000.csv` | [`particles_csv::CsvWriter`] | frame 0, the same numbers |
//!
//! Both files of a frame hold the same particles in the same order, first the fluid in the order of
//! its ids and then the walls, and the same 64-bit floats to the last bit. All frame writers take
//! any [`std::io::Write`], check the frame before the first byte, and keep their buffers for the
//! next frame; they flush nothing that they do not own. They hand over pieces of about 64 KiB, so a
//! `File` needs no `BufWriter` around it.
//!
//! A wall particle stands still, and has no density or pressure of its own in a frame: its
//! velocity is written as 0, the other two as NaN, which plotting programs leave out of their
//! ranges. Its id is that of [`crate::frame::Frame::wall_ids`].

mod checksums;
mod directory;
mod error;
mod manifest;
pub mod particles_csv;
pub mod pvd;
pub mod series;
pub mod snapshot;
pub mod vtp;

pub use checksums::{ChangedNumber, Checksums};
pub use directory::{RunDirectory, free_directory, free_directory_in};
pub use error::OutputError;
pub use manifest::{Manifest, RunStatus};
pub use snapshot::{Snapshot, SnapshotError};

/// Path of the collection, relative to the directory of the run.
pub const COLLECTION: &str = "particles.pvd";

/// The formats of a frame, by the endings of their files.
pub const FRAME_FORMATS: [&str; 2] = ["csv", "vtp"];

/// Size in bytes of the pieces in which files are written.
const PIECE: usize = 64 * 1024;

/// What a particle is.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[repr(u8)]
pub enum PointKind {
    /// It moves: 0 in VTK, `fluid` in CSV.
    Fluid = 0,
    /// It stands still: 1 in VTK, `wall` in CSV.
    Wall = 1,
}

/// Path of one file of frame `index`, relative to the directory of the run, with `/` as the
/// separator (as in a [`pvd::Collection`]): `frames/particles-000000.csv`.
#[must_use]
pub fn frame_path(index: u64, extension: &str) -> String {
    format!("frames/particles-{index:06}.{extension}")
}
