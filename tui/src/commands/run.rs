//! `run` and `resume`.

use super::print;
use crate::cli::{ResumeArguments, RunArguments, WorkArguments};
use crate::exit::{Failure, NOT_EXACT};
use crate::progress::{Display, announce};
use crate::report;
use crate::stop::Stop;
use loschmidt_runner::output::{Manifest, OutputError, free_directory};
use loschmidt_runner::run::Outcome;
use loschmidt_runner::scene;
use loschmidt_runner::{ExecutorKind, Options, Run, RunError};
use serde::Serialize;
use std::num::NonZeroUsize;
use std::path::Path;
use std::process::ExitCode;

/// Runs a scene.
pub fn run(arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let stop = Stop::new()?;
    let source = scene::resolve(&arguments.scene.scene)?;
    let scene = scene::load(&source, &arguments.scene.overrides())?;
    let options = arguments.work.options(Options {
        arithmetic: arguments.arithmetic.into(),
        ..Options::default()
    })?;
    let run = loop {
        let out = match &arguments.out {
            Some(out) => out.clone(),
            None => free_directory(&scene.name),
        };
        let ready = || stop.wait_for_steps();
        match Run::start_when_ready(scene.clone(), options, Some((&out, arguments.force)), ready) {
            // Another run took the name in this moment.
            Err(RunError::Output(OutputError::Exists(_))) if arguments.out.is_none() => {}
            result => break result?,
        }
    };
    execute(run, &arguments.work, &arguments.scene.overrides(), &stop)
}

/// Goes on with a run.
pub fn resume(arguments: &ResumeArguments) -> Result<ExitCode, Failure> {
    let stop = Stop::new()?;
    let work = &arguments.work;
    // What is asked for is checked before the run is touched; what is not is as before.
    let asked = work.options(Options::default())?;
    let run = Run::resume(&arguments.run, |manifest| {
        let earlier = earlier(manifest);
        Options {
            executor: work.executor.map_or(earlier.executor, |_| asked.executor),
            threads: work.threads.map_or(earlier.threads, |_| asked.threads),
            ..asked
        }
    })?;
    stop.wait_for_steps();
    execute(run, work, &[], &stop)
}

/// The options of the earlier part of a run.
fn earlier(manifest: &Manifest) -> Options {
    let default = Options::default();
    Options {
        executor: ExecutorKind::by_name(&manifest.executor).unwrap_or(default.executor),
        threads: NonZeroUsize::new(manifest.threads).unwrap_or(default.threads),
        ..default
    }
}

/// The result and where all of it is.
#[derive(Serialize)]
struct PrintedResult<'a> {
    directory: Option<&'a Path>,
    #[serde(flatten)]
    outcome: &'a Outcome,
}

fn execute(
    mut run: Run,
    work: &WorkArguments,
    set: &[String],
    stop: &Stop,
) -> Result<ExitCode, Failure> {
    let (done, total) = (run.player().steps_taken(), run.plan().total());
    if !work.quiet {
        announce(&mut run, set);
    }
    let unit = run.player().scene().time_unit();
    let mut display = Display::new(work.quiet, unit, done, total);
    let result = run.execute(|progress| display.show(progress), stop.asked());
    display.finish(result.is_ok());
    let outcome = result?;
    let text = if work.json {
        // Shortest digits that read back to the same number; no NaN or infinity can occur in it.
        let printed = PrintedResult {
            directory: run.path(),
            outcome: &outcome,
        };
        serde_json::to_string(&printed).map_err(std::io::Error::from)? + "\n"
    } else {
        let mut text = String::new();
        if !work.quiet {
            text += &format!("{}\n", report::table(&outcome, run.rows(), unit));
            if let Some(path) = run.path() {
                text += &format!("written to              {}\n", path.display());
            }
            text += "\n";
        }
        text + &report::sentence(&outcome) + "\n"
    };
    print(&text)?;
    Ok(match outcome.reversed_exactly {
        Some(false) => ExitCode::from(NOT_EXACT),
        Some(true) | None => ExitCode::SUCCESS,
    })
}
