//! What can be opened: the catalogue, scene files nearby, runs.

use super::message::Choice;
use loschmidt_runner::output::RunDirectory;
use loschmidt_runner::output::Status;
use loschmidt_runner::scene::catalogue;
use std::fs;
use std::path::{Path, PathBuf};

/// The catalogue, `*.toml` here and in `examples/scenes`, and the directories in `runs`.
pub fn all() -> Vec<Choice> {
    let mut choices: Vec<Choice> = catalogue()
        .iter()
        .map(|entry| Choice {
            name: entry.name.to_owned(),
            title: entry.title.to_owned(),
        })
        .collect();
    for place in [".", "examples/scenes"] {
        let scenes = entries(Path::new(place))
            .into_iter()
            .filter(|path| is_scene(path));
        choices.extend(scenes.map(|path| Choice {
            name: path.display().to_string(),
            title: "scene file".to_owned(),
        }));
    }
    for path in entries(Path::new("runs")) {
        let Ok(manifest) = RunDirectory::read_manifest(&path) else {
            continue;
        };
        let how = match manifest.status {
            Status::Running => "run, not finished",
            Status::Interrupted => "run, interrupted",
            Status::Finished => "run, finished",
            Status::Failed => "run whose numbers ended",
            Status::Watched => "left by a watcher",
        };
        choices.push(Choice {
            name: path.display().to_string(),
            title: format!("{}: {how}, after {} steps", manifest.scene, manifest.steps),
        });
    }
    choices
}

/// What is in a directory, in the order of the names.
fn entries(place: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(place) else {
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = entries
        .flatten()
        .map(|entry| entry.path())
        .map(|path| path.strip_prefix(".").map(Path::to_owned).unwrap_or(path))
        .collect();
    paths.sort();
    paths
}

/// A TOML file with the key that every scene has.
fn is_scene(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension == "toml")
        && fs::read_to_string(path).is_ok_and(|text| text.contains("particle_spacing"))
}
