//! Why the files of a run cannot be written or read back.

use super::snapshot::SnapshotError;
use std::path::PathBuf;
use thiserror::Error;

/// Something could not be written or read back.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The directory is there already.
    #[error(
        "{} exists already; choose another --out, or replace the run in it with --force",
        .0.display()
    )]
    Exists(PathBuf),
    /// `--force` replaces runs, and this is something else.
    #[error(
        "{} {what}, not a run that --force could replace; choose another --out",
        path.display()
    )]
    NotReplaced {
        /// What is there.
        path: PathBuf,
        /// What it is.
        what: &'static str,
    },
    /// Another process is at work in it.
    #[error("{} is in use by a run at this moment", .0.display())]
    InUse(PathBuf),
    /// The file system said no.
    #[error("cannot {what} {}: {source}", path.display())]
    Io {
        /// What was tried.
        what: &'static str,
        /// With which file.
        path: PathBuf,
        /// Why not.
        source: std::io::Error,
    },
    /// Not a directory that a run left.
    #[error("{} is not the directory of a run: {why}", path.display())]
    NotARun {
        /// The directory.
        path: PathBuf,
        /// What is missing or wrong.
        why: String,
    },
    /// A file has been changed since the run wrote it.
    #[error("{} was changed since the run wrote it: {what}", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
        /// What is not as it was.
        what: String,
    },
    /// A snapshot of the run cannot be read.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
}
