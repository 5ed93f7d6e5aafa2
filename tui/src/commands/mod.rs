//! The commands.

mod check;
mod movie;
mod reproduce;
mod run;
mod scenes;
mod sense;
mod tui;
#[cfg(feature = "window")]
mod view;

use crate::cli::{ProgramArguments, ProgramCommand, RunArguments, TuiArguments};
use crate::dashboard;
use crate::exit::Failure;
use clap::CommandFactory;
use loschmidt_runner::output::Snapshot;
use loschmidt_runner::plain::visible;
use std::io::Write;
use std::process::ExitCode;

/// Does what the command line says.
pub fn execute(arguments: ProgramArguments) -> Result<ExitCode, Failure> {
    match arguments.command {
        None if dashboard::is_terminal() => tui::tui(&TuiArguments::default()),
        None => run::run(&RunArguments::small()),
        Some(ProgramCommand::Run(arguments)) => run::run(&arguments),
        Some(ProgramCommand::Tui(arguments)) => tui::tui(&arguments),
        #[cfg(feature = "window")]
        Some(ProgramCommand::View(arguments)) => view::view(&arguments),
        Some(ProgramCommand::Resume(arguments)) => run::resume(&arguments),
        Some(ProgramCommand::Movie(arguments)) => movie::movie(&arguments),
        Some(ProgramCommand::Scenes(arguments)) => scenes::scenes(&arguments),
        Some(ProgramCommand::Reproduce(arguments)) => reproduce::reproduce(&arguments),
        Some(ProgramCommand::Check(arguments)) => check::check(&arguments),
        Some(ProgramCommand::Digest { snapshot }) => {
            let snapshot = Snapshot::read(&snapshot)?;
            print(&format!("{}\n", snapshot.digest()))
        }
        Some(ProgramCommand::Completions { shell }) => {
            let mut text = Vec::new();
            clap_complete::generate(
                shell,
                &mut ProgramArguments::command(),
                "loschmidt",
                &mut text,
            );
            print(&String::from_utf8_lossy(&text))
        }
    }
}

/// Writes to standard output; a reader that has gone away is not an error.
fn print(text: &str) -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    match out
        .write_all(visible(text).as_bytes())
        .and_then(|()| out.flush())
    {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(ExitCode::SUCCESS),
    }
}
