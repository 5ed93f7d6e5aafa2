//! What a run leaves on disk.
//!
//! ```text
//! DIR/manifest.json            version, state of the run, digests, the result
//! DIR/scene.toml               the scene as it was run, overrides included
//! DIR/series.csv               energies, momenta and entropy, units in the header
//! DIR/particles.pvd            the frames in time, for ParaView
//! DIR/frames/particles-N.csv   a frame, one particle a line
//! DIR/frames/particles-N.vtp   the same as VTK PolyData
//! DIR/snapshots/home.snapshot, turnaround.snapshot, latest.snapshot
//! ```

mod directory;
mod manifest;
pub mod particles_csv;
pub mod pvd;
pub mod series;
pub mod snapshot;
pub mod vtp;

pub use directory::{OutputError, RunDirectory, free_directory};
pub use manifest::{Manifest, Status};
pub use snapshot::{Snapshot, SnapshotError};
