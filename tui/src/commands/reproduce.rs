//! `reproduce`: the paper's figures and tables, run again.

use super::print;
use crate::cli::ReproduceArguments;
use crate::exit::{Failure, INTERRUPTED, NOT_EXACT, OUTPUT, RANGE, tell};
use crate::progress::duration;
use crate::stop::Stop;
use loschmidt_reproduce::{Lab, LabError, News, Section, Target, report};
use loschmidt_runner::Options;
use loschmidt_runner::plain::quote;
use std::io::IsTerminal;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Between two lines of progress at least.
const PAUSE: Duration = Duration::from_secs(10);

/// Works out the targets and writes the report.
pub fn reproduce(arguments: &ReproduceArguments) -> Result<ExitCode, Failure> {
    let stop = Stop::new()?;
    stop.wait_for_steps();
    let options = Options {
        threads: arguments.threads.unwrap_or(Options::default().threads),
        ..Options::default()
    };
    let out = arguments.directory();
    let mut teller = Teller::new(arguments.quiet);
    let mut lab = Lab::open(
        &out,
        arguments.quick,
        arguments.force,
        options,
        stop.asked(),
        |news| {
            teller.hear(news);
        },
    )
    .map_err(|error| failure(error, arguments))?;
    let wanted = arguments.targets();
    for target in &wanted {
        target
            .reproduce(&mut lab)
            .map_err(|error| failure(error, arguments))?;
        write(&lab).map_err(|error| failure(error, arguments))?;
    }
    let sections: Vec<Section> = wanted.iter().filter_map(|t| lab.kept(t.name())).collect();
    let mut text = String::new();
    for section in &sections {
        text += &format!("{}\n", section.title);
        for f in &section.findings {
            let mut line = format!("  {:<9}{}: {}", f.verdict.word(), f.quantity, f.ours);
            if !f.published.is_empty() {
                line += &format!("   [{}]", f.published);
            }
            if !f.asked.is_empty() {
                line += &format!("   (asked: {})", f.asked);
            }
            text += &format!("{line}\n");
        }
    }
    text += &format!("\nwritten to {}\n", out.join("report.html").display());
    print(&text)?;
    Ok(if sections.iter().all(Section::holds) {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(NOT_EXACT)
    })
}

/// The pages, from all sections that are there.
fn write(lab: &Lab<'_>) -> Result<(), LabError> {
    let sections: Vec<Section> = Target::ALL
        .iter()
        .filter_map(|target| lab.kept(target.name()))
        .collect();
    report::write(lab, &sections)
}

fn failure(error: LabError, arguments: &ReproduceArguments) -> Failure {
    match error {
        LabError::Run(error) => error.into(),
        LabError::Scene(error) => error.into(),
        LabError::Interrupted => Failure::new(
            INTERRUPTED,
            format!(
                "interrupted; what is done is kept. Go on with\n    {}",
                arguments.again(quote(&arguments.directory()))
            ),
        ),
        error @ (LabError::Io { .. } | LabError::Occupied { .. }) => {
            Failure::new(OUTPUT, format!("error: {error}"))
        }
        error @ (LabError::Fault(_) | LabError::Build(_)) => {
            Failure::new(RANGE, format!("error: {error}"))
        }
    }
}

/// Lines on standard error; how far a run has come now and then.
struct Teller {
    quiet: bool,
    last: Instant,
    began: Instant,
    run: String,
}

impl Teller {
    fn new(quiet: bool) -> Self {
        Self {
            quiet,
            last: Instant::now(),
            began: Instant::now(),
            run: String::new(),
        }
    }

    fn hear(&mut self, news: News<'_>) {
        if self.quiet {
            return;
        }
        match news {
            News::Line(line) => tell(line),
            News::Progress { run, done, total } => {
                if self.run != run {
                    self.run = run.to_owned();
                    self.began = Instant::now();
                    self.last = self.began;
                }
                let now = Instant::now();
                // On a terminal more often: somebody is watching.
                let pause = if std::io::stderr().is_terminal() {
                    PAUSE / 5
                } else {
                    PAUSE
                };
                if now - self.last >= pause && done > 0 {
                    self.last = now;
                    let pace = (now - self.began).as_secs_f64() / done as f64;
                    let left = duration(pace * (total - done) as f64);
                    tell(&format!("    {run}: step {done}/{total}, {left} left"));
                }
            }
        }
    }
}
