//! The commands.

mod check;
mod movie;
mod reproduce;
mod run;
mod scenes;
mod tui;
#[cfg(feature = "window")]
mod view;

use crate::cli::{Arguments, Command, RunArguments, TuiArguments};
use crate::dashboard;
use crate::exit::Failure;
use clap::CommandFactory;
use loschmidt_runner::output::Snapshot;
use std::io::Write;
use std::process::ExitCode;

/// Does what the command line says.
pub fn execute(arguments: Arguments) -> Result<ExitCode, Failure> {
    match arguments.command {
        None if dashboard::is_terminal() => tui::tui(&TuiArguments::default()),
        None => run::run(&RunArguments::default()),
        Some(Command::Run(arguments)) => run::run(&arguments),
        Some(Command::Tui(arguments)) => tui::tui(&arguments),
        #[cfg(feature = "window")]
        Some(Command::View(arguments)) => view::view(&arguments),
        Some(Command::Resume(arguments)) => run::resume(&arguments),
        Some(Command::Movie(arguments)) => movie::movie(&arguments),
        Some(Command::Scenes(arguments)) => scenes::scenes(&arguments),
        Some(Command::Reproduce(arguments)) => reproduce::reproduce(&arguments),
        Some(Command::Check(arguments)) => check::check(&arguments),
        Some(Command::Digest { snapshot }) => {
            let snapshot = Snapshot::read(&snapshot)?;
            print(&format!("{}\n", snapshot.digest()))
        }
        Some(Command::Completions { shell }) => {
            let mut text = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "loschmidt", &mut text);
            print(&String::from_utf8_lossy(&text))
        }
    }
}

/// Writes to standard output; a reader that has gone away is not an error.
fn print(text: &str) -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(ExitCode::SUCCESS),
    }
}
