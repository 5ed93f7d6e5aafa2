//! `tui`: the dashboard.

use crate::cli::{RunArguments, TuiArguments};
use crate::dashboard;
use crate::exit::{Failure, USAGE};
use crate::stop::Stop;
use loschmidt_runner::Options;
use loschmidt_viewer::session::Request;
use std::process::ExitCode;

/// Opens the dashboard.
pub fn tui(arguments: &TuiArguments) -> Result<ExitCode, Failure> {
    if !dashboard::is_terminal() {
        return Err(Failure::new(
            USAGE,
            "error: `loschmidt tui` needs a terminal; `loschmidt run` does without",
        ));
    }
    let options = Options::default();
    let default = RunArguments::default().scene;
    let request = match &arguments.scene {
        Some(name) => Request {
            name: name.clone(),
            set: arguments.set.clone(),
            threads: arguments.threads.map(Into::into),
            beside: false,
        },
        None => Request {
            name: default.scene,
            set: default
                .set
                .into_iter()
                .chain(arguments.set.clone())
                .collect(),
            threads: arguments.threads.map(Into::into),
            beside: false,
        },
    };
    dashboard::run(request, options, &Stop::new()?)
}
