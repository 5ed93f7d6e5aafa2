//! The host twin of the firmware: the same run, printed in the same words.
//!
//! `cargo run --release -p loschmidt-examples --example embedded_twin`; `embedded/run.sh`
//! compares what it prints with what the microcontroller prints.

use std::process::ExitCode;

fn main() -> ExitCode {
    match loschmidt_embedded_scene::run() {
        Ok(outcome) => {
            print!("{outcome}");
            ExitCode::from(u8::from(!outcome.reversed_exactly()))
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
