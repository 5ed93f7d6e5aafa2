//! `view`: the window.

use super::run::stop_flag;
use crate::exit::Failure;
use loschmidt_runner::Options;
use loschmidt_viewer::window::{self, WindowArguments};
use std::process::ExitCode;

/// Opens the window.
pub fn view(arguments: &WindowArguments) -> Result<ExitCode, Failure> {
    let stop = stop_flag()?;
    let options = Options::default();
    Ok(window::program(arguments, options, &stop, "loschmidt view"))
}
