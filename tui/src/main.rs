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
    let arguments = match cli::ProgramArguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refused) => return exit::refuse(&refused),
    };
    match commands::execute(arguments) {
        Ok(code) => code,
        Err(failure) => failure.report(),
    }
}
