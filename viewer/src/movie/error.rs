//! Why there is no movie.

use loschmidt_runner::RunError;
use loschmidt_runner::plain::quote;
use loschmidt_runner::ranged_fault::RangedFault;
use std::path::PathBuf;
use thiserror::Error;

/// Why there is no movie, or not all of it.
#[derive(Debug, Error)]
pub enum MovieError {
    /// The scene or the run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The directory holds another movie.
    #[error("{} holds another movie; choose another --out, or replace it with --force", .0.display())]
    OtherMovie(PathBuf),
    /// The directory holds something else.
    #[error("{} holds files that are no movie's; choose another --out, or write between them with --force", .0.display())]
    Foreign(PathBuf),
    /// A file is in the way of the directory or of a movie.
    #[error("{} exists already; choose another name, or replace it with --force", .0.display())]
    Exists(PathBuf),
    /// A folder, a device or a pipe, where a file is to be.
    #[error("{} is no file that could be written anew; choose another name", .0.display())]
    NotAFile(PathBuf),
    /// There is no ffmpeg for a movie asked for.
    #[error("{} needs ffmpeg, which is not on the path\nhelp: without --mp4 the pictures are made; the same command with --mp4 makes the movie of them later", .0.display())]
    FfmpegMissing(PathBuf),
    /// Another process is at work in the directory.
    #[error("{} is in use by another export at this moment", .0.display())]
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
    /// A picture that cannot be read.
    #[error("{} cannot be read as a picture: {source}", path.display())]
    Picture {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: crate::picture::ReadError,
    },
    /// A run that is still to come to its end.
    #[error(
        "the run in {} has not finished; go on with\n    loschmidt resume {}",
        .0.display(),
        quote(.0)
    )]
    Unfinished(PathBuf),
    /// A run that is being taken at this moment.
    #[error(
        "the run in {} is at work at this moment, after {steps} of {planned} steps; a movie can be \
         made of it when it has ended",
        path.display()
    )]
    AtWork {
        /// The run's directory.
        path: PathBuf,
        /// Steps taken when it last said so.
        steps: u64,
        /// Steps of the whole run.
        planned: u64,
    },
    /// A directory that a user of the dashboard or the window left.
    #[error(
        "{} was left by the dashboard or the window, and holds no frames\n\
         help: `loschmidt movie {}` makes a movie of its scene",
        .0.display(),
        quote(&.0.join("scene.toml"))
    )]
    Watched(PathBuf),
    /// A run with too few frames.
    #[error(
        "the run in {} stored {stored} frames, and {wanted} pictures were asked for\nhelp: --seconds {} shows each frame once; `loschmidt run --set output.frames={wanted}` stores more, and\n    loschmidt movie {}\nsimulates again",
        path.display(),
        (10.0 * *stored as f64 / f64::from(*fps)).floor() / 10.0,
        quote(&path.join("scene.toml"))
    )]
    FewFrames {
        /// The run's directory.
        path: PathBuf,
        /// Frames it has.
        stored: usize,
        /// Pictures asked for.
        wanted: usize,
        /// Pictures per second.
        fps: u32,
    },
    /// A run without frames.
    #[error("the run in {} stored no frames (its output.frames is 0)", .0.display())]
    NoFrames(PathBuf),
    /// A simulation left the number range.
    #[error("the {arithmetic}-point run ended at t = {time:.6} s: {fault}")]
    Fault {
        /// `fixed` or `floating`.
        arithmetic: &'static str,
        /// Time along both legs, s.
        time: f64,
        /// Particle, step and range.
        fault: RangedFault,
    },
    /// A signal came.
    #[error("interrupted after {done} of {total} pictures")]
    Interrupted {
        /// Pictures that are there.
        done: usize,
        /// Pictures of the whole movie.
        total: usize,
    },
    /// ffmpeg is not there.
    #[error("ffmpeg is not on the path; once it is, make {} with\n    {command}", path.display())]
    NoFfmpeg {
        /// The movie asked for.
        path: PathBuf,
        /// What to run.
        command: String,
    },
    /// ffmpeg failed.
    #[error("ffmpeg could not make {}: {why}\nto try by hand:\n    {command}", path.display())]
    Ffmpeg {
        /// The movie asked for.
        path: PathBuf,
        /// What it said.
        why: String,
        /// What to run.
        command: String,
    },
}

impl MovieError {
    /// An error of the file system, from `what` was tried with which file.
    pub(super) fn io(
        what: &'static str,
        path: &std::path::Path,
    ) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { what, path, source }
    }
}
