//! What can be opened: the catalogue, scene files nearby, runs.

use super::request::{Answer, Request};
use crate::keys::Key;
use loschmidt_runner::output::RunDirectory;
use loschmidt_runner::output::RunStatus;
use loschmidt_runner::scene::catalogue;
use std::fs;
use std::path::{Path, PathBuf};

/// What can be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Name of a scene, path of a scene file or of a run.
    pub name: String,
    /// What it is.
    pub title: String,
}

/// A list to choose from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct List {
    /// What there is.
    pub choices: Vec<Choice>,
    /// Which one is chosen.
    pub chosen: usize,
}

impl List {
    /// These, at first the one that is open.
    #[must_use]
    pub fn new(choices: Vec<Choice>, open: &Request) -> Self {
        let chosen = choices.iter().position(|choice| choice.name == open.name);
        Self {
            chosen: chosen.unwrap_or(0),
            choices,
        }
    }

    /// What a key does in it. `open`: what is open.
    pub fn key(&mut self, key: Key, open: &Request) -> Answer {
        let last = self.choices.len().saturating_sub(1);
        match key {
            Key::Up | Key::Char('k') => self.chosen = self.chosen.saturating_sub(1),
            Key::Down | Key::Char('j') => self.chosen = (self.chosen + 1).min(last),
            Key::Home => self.chosen = 0,
            Key::End => self.chosen = last,
            Key::Enter | Key::Space => {
                if let Some(choice) = self.choices.get(self.chosen) {
                    return Answer::Open(Request {
                        name: choice.name.clone(),
                        threads: open.threads,
                        ..Request::default()
                    });
                }
            }
            Key::Char('q') => return Answer::Quit,
            Key::Escape | Key::Char('o') => return Answer::Close,
            _ => {}
        }
        Answer::Stay
    }

    /// The choices that a sheet of so many lines has room for, with their places in the list:
    /// among them the one that is chosen.
    pub fn visible(&self, lines: usize) -> impl Iterator<Item = (usize, &Choice)> {
        let lines = lines.max(1);
        let last = self.choices.len().saturating_sub(lines);
        let first = (self.chosen + 1).saturating_sub(lines).min(last);
        self.choices.iter().enumerate().skip(first).take(lines)
    }
}

/// The catalogue, `*.toml` here and in `examples/scenes`, and the directories in `runs`.
#[must_use]
pub fn choices() -> Vec<Choice> {
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
            RunStatus::Running => "run, not finished",
            RunStatus::Interrupted => "run, interrupted",
            RunStatus::Finished => "run, finished",
            RunStatus::Failed => "run whose numbers ended",
            RunStatus::Watched => "left by a watcher",
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
