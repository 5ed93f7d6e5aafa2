//! The program `loschmidt`: reads the command line and calls the runner.

#![forbid(unsafe_code)]

mod brief;
mod cli;
mod commands;
mod dashboard;
mod exit;
mod progress;
mod report;
mod stop;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = cli::ProgramArguments::parse();
    match commands::execute(arguments) {
        Ok(code) => code,
        Err(failure) => failure.report(),
    }
}
