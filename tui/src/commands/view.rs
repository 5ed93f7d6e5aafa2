//! `view`: the window.

use crate::exit::Failure;
use crate::stop::Stop;
use loschmidt_runner::Options;
use loschmidt_viewer::window::{self, WindowArguments};
use std::process::ExitCode;

/// Opens the window.
pub fn view(arguments: &WindowArguments) -> Result<ExitCode, Failure> {
    let stop = Stop::new()?;
    let options = Options::default();
    Ok(window::program(
        arguments,
        options,
        stop.asked(),
        "loschmidt view",
        || stop.wait_for_steps(),
    ))
}
