//! `scenes`: the catalogue.

use super::print;
use crate::cli::{ScenesArguments, ScenesCommand};
use crate::exit::Failure;
use loschmidt_runner::scene::{catalogue, load, resolve};
use std::process::ExitCode;

/// Lists the catalogue or prints a scene of it.
pub fn scenes(arguments: &ScenesArguments) -> Result<ExitCode, Failure> {
    match &arguments.command {
        None => {
            let width = catalogue().iter().map(|e| e.name.len()).max().unwrap_or(0);
            let mut text = String::new();
            for entry in catalogue() {
                text += &format!("{:width$}  {}\n", entry.name, entry.title);
                text += &format!("{:width$}  {}\n", "", entry.citation);
            }
            print(&text)
        }
        Some(ScenesCommand::Print(scene)) => {
            let scene = load(&resolve(&scene.scene)?, &scene.overrides())?;
            print(&scene.to_toml())
        }
    }
}
