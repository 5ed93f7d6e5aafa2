//! Exit codes, and what a failure prints.

use loschmidt_runner::RunError;
use loschmidt_runner::output::{OutputError, SnapshotError};
use loschmidt_runner::plain::{quote, visible};
use loschmidt_runner::scene::SceneError;
use loschmidt_viewer::movie::MovieError;
use std::io::Write;
use std::process::ExitCode;

/// The run did not return exactly.
pub const NOT_EXACT: u8 = 1;
/// Usage or scene.
pub const USAGE: u8 = 2;
/// Output.
pub const OUTPUT: u8 = 3;
/// The run left the number range.
pub const RANGE: u8 = 4;
/// A signal came.
pub const INTERRUPTED: u8 = 130;

/// Prints a line on standard error; a reader that has gone away ends nothing.
pub fn tell(line: &str) {
    let _ = writeln!(std::io::stderr(), "{}", visible(line));
}

/// Prints what is wrong with the arguments, or the help that they ask for.
pub fn refuse(refused: &clap::Error) -> ExitCode {
    let text = refused.render().to_string();
    // The colours of clap are only used where no argument could add to them.
    if visible(&text) == text || !refused.use_stderr() {
        let _ = refused.print();
    } else {
        tell(text.trim_end());
    }
    ExitCode::from(u8::try_from(refused.exit_code()).unwrap_or(USAGE))
}

/// What goes to standard error, and the code to leave with.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    pub fn new(code: u8, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
        }
    }

    /// Prints the message.
    pub fn report(self) -> ExitCode {
        tell(self.message.trim_end());
        ExitCode::from(self.code)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        // These messages are complete, with their own "error:".
        Self::new(USAGE, error.to_string())
    }
}

impl From<SnapshotError> for Failure {
    fn from(error: SnapshotError) -> Self {
        Self::new(USAGE, format!("error: {error}"))
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self::new(OUTPUT, format!("error: cannot write the result: {error}"))
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Scene(error) => error.into(),
            RunError::Output(error) => {
                let code = match error {
                    OutputError::NotARun { .. }
                    | OutputError::Changed { .. }
                    | OutputError::Snapshot(_) => USAGE,
                    OutputError::Exists(_)
                    | OutputError::NotReplaced { .. }
                    | OutputError::InUse(_)
                    | OutputError::Io { .. } => OUTPUT,
                };
                Self::new(code, format!("error: {error}"))
            }
            RunError::Memory(_)
            | RunError::Build(_)
            | RunError::Ended { .. }
            | RunError::ForeignSnapshot(_)
            | RunError::MisplacedSnapshot { .. }
            | RunError::Watched(_)
            | RunError::NoRows => Self::new(USAGE, format!("error: {error}")),
            RunError::Fault { ref snapshot, .. } => {
                let mut message = format!("error: {error}");
                if let Some(path) = snapshot {
                    message += &format!("\nthe last good state is in {}", path.display());
                }
                Self::new(RANGE, message)
            }
            RunError::NotRepeatable(_) => Self::new(RANGE, format!("error: {error}")),
            RunError::Interrupted { ref path, .. } => {
                let mut message = error.to_string();
                if let Some(path) = path {
                    message += &format!("; resume with\n    loschmidt resume {}", quote(path));
                }
                Self::new(INTERRUPTED, message)
            }
        }
    }
}

impl From<MovieError> for Failure {
    fn from(error: MovieError) -> Self {
        let code = match error {
            MovieError::Run(error) => return error.into(),
            MovieError::OtherMovie(_)
            | MovieError::Foreign(_)
            | MovieError::Exists(_)
            | MovieError::InUse(_)
            | MovieError::Io { .. }
            | MovieError::NoFfmpeg { .. }
            | MovieError::Ffmpeg { .. } => OUTPUT,
            MovieError::NotAFile(_)
            | MovieError::FfmpegMissing(_)
            | MovieError::Picture { .. }
            | MovieError::Unfinished(_)
            | MovieError::AtWork { .. }
            | MovieError::Watched(_)
            | MovieError::FewFrames { .. }
            | MovieError::NoFrames(_) => USAGE,
            MovieError::Fault { .. } => RANGE,
            MovieError::Interrupted { .. } => INTERRUPTED,
        };
        Self::new(code, format!("error: {error}"))
    }
}
