//! The command line.

mod movie;

pub use movie::MovieArguments;

use crate::exit::{Failure, USAGE};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use loschmidt_reproduce::{GROUPS, Target};
use loschmidt_runner::fast::Backend;
use loschmidt_runner::scene::preset;
use loschmidt_runner::{ArithmeticKind, ExecutorKind, Options};
use loschmidt_viewer::session::MOST_THREADS;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Fluids that run backwards: smoothed particle hydrodynamics, reversible to the last bit.
///
/// Without a command, the dam break of 5,000 particles: on a terminal in the dashboard, elsewhere
/// it is run out and back.
#[derive(Debug, Parser)]
#[command(
    name = "loschmidt",
    version,
    after_help = "Exit codes: 0 all is well; 1 the run did not return exactly, or `check` saw it fail; 2 usage or scene; \
                  3 output; 4 the numbers ended; 70 a defect of the program; 130 interrupted, can be \
                  resumed."
)]
pub struct ProgramArguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<ProgramCommand>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum ProgramCommand {
    /// Run a scene out and, if it has a turnaround, back; compare the last state with the first
    Run(RunArguments),
    /// Watch a scene or an earlier run in the dashboard, in both directions of time; ? shows the
    /// keys
    Tui(TuiArguments),
    /// Watch a scene or an earlier run in a window, in both directions of time; ? shows the keys
    #[cfg(feature = "window")]
    View(loschmidt_viewer::window::WindowArguments),
    /// Go on with an interrupted run
    Resume(ResumeArguments),
    /// Make a movie of a scene or of a finished run: numbered pictures, GIF, MP4
    Movie(MovieArguments),
    /// List the catalogue of scenes, or print one of them
    Scenes(ScenesArguments),
    /// Run the paper's figures and tables again: numbers beside the paper's, verdicts, a report
    Reproduce(ReproduceArguments),
    /// Tell what a scene takes (particles, steps, memory, time) and whether its time step is small
    /// enough
    Check(SceneArguments),
    /// Print the digest of a snapshot
    Digest {
        /// A .snapshot file of a run
        snapshot: PathBuf,
    },
    /// Print completions for a shell
    Completions {
        /// The shell
        shell: Shell,
    },
}

/// A scene and changes to it.
#[derive(Args, Debug)]
pub struct SceneArguments {
    /// A scene file, or the name of a scene of the catalogue
    pub scene: String,
    /// Override a key of the scene, for example particle_spacing=0.01 or
    /// region.0.shape.circle.radius=1; an empty value removes the key; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Overrides with a name, taken before those of --set
    #[arg(long, value_name = "NAME")]
    pub preset: Option<Preset>,
}

/// Names of the presets.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Preset {
    /// At most 1e-4 of the energy released is lost or gained on the dam break: PEFRL at twice the
    /// usual time step, twice the force evaluations
    Accurate,
    /// Solids with the support and the penalty of their paper, and about its time step
    Paper,
}

impl SceneArguments {
    /// The overrides of the preset, if there is one, and those of --set.
    pub fn overrides(&self) -> Vec<String> {
        let preset = match self.preset {
            Some(Preset::Accurate) => &preset::ACCURATE[..],
            Some(Preset::Paper) => &preset::PAPER[..],
            None => &[],
        };
        let preset = preset.iter().map(|&set| set.to_owned());
        preset.chain(self.set.iter().cloned()).collect()
    }
}

/// Arguments of `reproduce`.
#[derive(Args, Debug)]
pub struct ReproduceArguments {
    /// What to reproduce: all, or any of fig1 … fig6, table2 (with Fig. 7), kepler, claims, echo,
    /// work; plate, column, cantilever, couette, cavity, or these five as solids;
    /// normal-cavity, second-sound, fountain, or these three as helium
    #[arg(default_value = "all", value_parser = target_names())]
    pub targets: Vec<String>,
    /// Coarser spacings: each paper within five minutes on two processors
    #[arg(long)]
    pub quick: bool,
    /// Directory of the report; what an earlier call has done there is kept [default: reproduction,
    /// or reproduction-quick]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Work out again what is there already (runs of the same scene are kept all the same)
    #[arg(long)]
    pub force: bool,
    /// Threads [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = threads)]
    pub threads: Option<NonZeroUsize>,
    /// Print no progress
    #[arg(long, short)]
    pub quiet: bool,
}

/// `all` and the names of the targets.
fn target_names() -> PossibleValuesParser {
    let names = Target::ALL
        .iter()
        .map(|target| PossibleValue::new(target.name()).help(target.title()));
    let groups = GROUPS
        .iter()
        .map(|(name, title, _)| PossibleValue::new(name).help(title));
    PossibleValuesParser::new(
        [PossibleValue::new("all").help("all of them")]
            .into_iter()
            .chain(names)
            .chain(groups),
    )
}

impl ReproduceArguments {
    /// The targets, each once, in the order of the report.
    pub fn targets(&self) -> Vec<Target> {
        let all = self.targets.iter().any(|name| name == "all");
        let named = |name: &str| self.targets.iter().any(|n| n == name);
        let in_a_group = |target: &Target| {
            let mut groups = GROUPS.iter();
            groups.any(|(name, _, targets)| named(name) && targets.contains(target))
        };
        let wanted = |target: &&Target| all || named(target.name()) || in_a_group(target);
        Target::ALL.iter().filter(wanted).copied().collect()
    }

    /// Where the report goes.
    pub fn directory(&self) -> PathBuf {
        let default = if self.quick {
            "reproduction-quick"
        } else {
            "reproduction"
        };
        self.out.clone().unwrap_or_else(|| default.into())
    }

    /// The command that goes on after an interruption.
    pub fn again(&self, directory: String) -> String {
        let quick = if self.quick { " --quick" } else { "" };
        format!(
            "loschmidt reproduce {}{quick} --out {directory}",
            self.targets.join(" ")
        )
    }
}

/// How a run is computed and shown; none of it changes a bit of the result.
#[derive(Args, Debug)]
pub struct WorkArguments {
    /// Threads of the executor [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = threads)]
    pub threads: Option<NonZeroUsize>,
    /// Who walks the particles [default: fast]
    #[arg(long)]
    pub executor: Option<ExecutorName>,
    /// Instruction set of the fast executor [default: the best this processor has]
    #[arg(long)]
    pub backend: Option<BackendName>,
    /// Print neither progress nor tables
    #[arg(long, short)]
    pub quiet: bool,
    /// Print one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `run`.
#[derive(Args, Debug)]
pub struct RunArguments {
    /// Scene and overrides.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// How it is computed.
    #[command(flatten)]
    pub work: WorkArguments,
    /// Numbers of the state: fixed point, or floating point as the experiment that fails
    #[arg(long, default_value = "fixed")]
    pub arithmetic: ArithmeticName,
    /// Directory to write to; it must not exist [default: runs/SCENE-N, the next free N]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace an earlier run in the directory
    #[arg(long)]
    pub force: bool,
}

/// Arguments of `tui`.
#[derive(Args, Debug, Default)]
pub struct TuiArguments {
    /// A scene file, a scene of the catalogue, or the directory of a run
    /// [default: dam-break with 5,000 particles]
    #[arg(value_name = "SCENE|RUN")]
    pub scene: Option<String>,
    /// Override a key of the scene, for example particle_spacing=0.01; an empty value removes the
    /// key; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Threads of the executor [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = threads)]
    pub threads: Option<NonZeroUsize>,
}

/// Arguments of `resume`.
#[derive(Args, Debug)]
pub struct ResumeArguments {
    /// The directory of the run
    pub run: PathBuf,
    /// How it is computed.
    #[command(flatten)]
    pub work: WorkArguments,
}

/// Arguments of `scenes`.
#[derive(Args, Debug)]
pub struct ScenesArguments {
    /// Print instead of listing.
    #[command(subcommand)]
    pub command: Option<ScenesCommand>,
}

/// What to do with the catalogue.
#[derive(Debug, Subcommand)]
pub enum ScenesCommand {
    /// Print a scene with every key, its unit and its meaning
    Print(SceneArguments),
}

fn threads(text: &str) -> Result<NonZeroUsize, String> {
    match text.parse::<NonZeroUsize>() {
        Ok(n) if n.get() <= MOST_THREADS => Ok(n),
        _ => Err(format!("allowed: a whole number from 1 to {MOST_THREADS}")),
    }
}

/// Names of the executors.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ExecutorName {
    /// The plain reference, one thread
    Serial,
    /// The reference's traversal on all threads
    Rayon,
    /// Every pair once, in vector instructions, on all threads
    Fast,
}

impl From<ExecutorName> for ExecutorKind {
    fn from(name: ExecutorName) -> Self {
        match name {
            ExecutorName::Serial => Self::Serial,
            ExecutorName::Rayon => Self::Rayon,
            ExecutorName::Fast => Self::Fast,
        }
    }
}

/// Names of the instruction sets.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum BackendName {
    /// x86-64-v4, 8 doubles at once
    Avx512,
    /// x86-64-v3, 4 doubles at once
    Avx2,
    /// What every processor has
    Baseline,
}

impl From<BackendName> for Backend {
    fn from(name: BackendName) -> Self {
        match name {
            BackendName::Avx512 => Self::Avx512,
            BackendName::Avx2 => Self::Avx2,
            BackendName::Baseline => Self::Baseline,
        }
    }
}

/// Names of the arithmetics.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ArithmeticName {
    /// Integers: exactly reversible
    Fixed,
    /// Doubles: the same pair terms, sums in the order of the neighbours
    Float,
}

impl From<ArithmeticName> for ArithmeticKind {
    fn from(name: ArithmeticName) -> Self {
        match name {
            ArithmeticName::Fixed => Self::Fixed,
            ArithmeticName::Float => Self::Float,
        }
    }
}

impl WorkArguments {
    /// The options, where nothing is given those of `otherwise`.
    ///
    /// # Errors
    /// The processor does not have the instruction set asked for.
    pub fn options(&self, otherwise: Options) -> Result<Options, Failure> {
        let backend = self.backend.map_or(otherwise.backend, Into::into);
        if !backend.is_available() {
            let names = Backend::ALL
                .into_iter()
                .filter(|backend| backend.is_available())
                .map(Backend::name);
            return Err(Failure::new(
                USAGE,
                format!(
                    "error: this processor has no {}\nhelp: it has {}",
                    backend.name(),
                    names.collect::<Vec<_>>().join(", ")
                ),
            ));
        }
        Ok(Options {
            executor: self.executor.map_or(otherwise.executor, Into::into),
            threads: self.threads.unwrap_or(otherwise.threads),
            backend,
            ..otherwise
        })
    }
}

impl RunArguments {
    /// What the program does without arguments and without a terminal: its default under a name
    /// that tells it from the scene of the catalogue.
    pub fn small() -> Self {
        let mut arguments = Self::default();
        arguments.scene.set.push("name=dam-break-small".to_owned());
        arguments
    }
}

impl Default for RunArguments {
    /// What the program does without arguments: the paper's dam break, 16 times fewer particles.
    fn default() -> Self {
        Self {
            scene: SceneArguments {
                scene: "dam-break".to_owned(),
                set: vec!["particle_spacing=0.02".to_owned()],
                preset: None,
            },
            work: WorkArguments {
                threads: None,
                executor: None,
                backend: None,
                quiet: false,
                json: false,
            },
            arithmetic: ArithmeticName::Fixed,
            out: None,
            force: false,
        }
    }
}
