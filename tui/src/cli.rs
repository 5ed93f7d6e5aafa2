//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use loschmidt_runner::{ArithmeticKind, ExecutorKind, Options};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Fluids that run backwards: smoothed particle hydrodynamics, reversible to the last bit.
///
/// Without a command, the dam break of 5,000 particles is run out and back.
#[derive(Debug, Parser)]
#[command(
    name = "loschmidt",
    version,
    after_help = "Exit codes: 0 all is well; 1 the run did not return exactly; 2 usage or scene; \
                  3 output; 4 the numbers ended; 130 interrupted, can be resumed."
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene out and, if it has a turnaround, back; compare the last state with the first
    Run(RunArguments),
    /// Go on with an interrupted run
    Resume(ResumeArguments),
    /// List the catalogue of scenes, or print one of them
    Scenes(ScenesArguments),
    /// Tell what a scene takes (particles, steps, memory, time) and whether its time step is small enough
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
    /// Override a key of the scene, for example particle_spacing=0.01; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// How a run is computed and shown; none of it changes a bit of the result.
#[derive(Args, Debug)]
pub struct WorkArguments {
    /// Threads of the executor [default: as many as there are processors]
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Who walks the particles: the one-threaded reference or all threads [default: rayon]
    #[arg(long)]
    pub executor: Option<ExecutorName>,
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

/// Names of the executors.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ExecutorName {
    /// The reference, one thread
    Serial,
    /// All threads
    Rayon,
}

impl From<ExecutorName> for ExecutorKind {
    fn from(name: ExecutorName) -> Self {
        match name {
            ExecutorName::Serial => Self::Serial,
            ExecutorName::Rayon => Self::Rayon,
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
    pub fn options(&self, otherwise: Options) -> Options {
        Options {
            executor: self.executor.map_or(otherwise.executor, Into::into),
            threads: self.threads.unwrap_or(otherwise.threads),
            ..otherwise
        }
    }
}

impl Default for RunArguments {
    /// What the program does without arguments: the paper's dam break, 16 times fewer particles.
    fn default() -> Self {
        Self {
            scene: SceneArguments {
                scene: "dam-break".to_owned(),
                set: vec!["particle_spacing=0.02".to_owned()],
            },
            work: WorkArguments {
                threads: None,
                executor: None,
                quiet: false,
                json: false,
            },
            arithmetic: ArithmeticName::Fixed,
            out: None,
            force: false,
        }
    }
}
