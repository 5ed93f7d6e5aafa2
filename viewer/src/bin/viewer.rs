//! The window by itself: the same as `loschmidt view`.

#![forbid(unsafe_code)]

use clap::Parser;
use loschmidt_runner::Options;
use loschmidt_viewer::window::{self, WindowArguments};
use signal_hook::consts::{SIGINT, SIGTERM};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Watch a scene or an earlier run in a window, in both directions of time; ? shows the keys.
#[derive(Debug, Parser)]
#[command(name = "loschmidt-viewer", version)]
struct Program {
    #[command(flatten)]
    arguments: WindowArguments,
}

fn main() -> ExitCode {
    let program = Program::parse();
    let stop = Arc::new(AtomicBool::new(false));
    let hear_signals = || {
        for signal in [SIGINT, SIGTERM] {
            // Without it the program ends at once, as programs do.
            let _ = signal_hook::flag::register(signal, Arc::clone(&stop));
        }
    };
    window::program(
        &program.arguments,
        Options::default(),
        &stop,
        "loschmidt-viewer",
        hear_signals,
    )
}
