//! Where the text of a scene comes from: a file, the catalogue, or a string.

use std::fs;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::catalogue::{self, catalogue};
use super::error::SceneError;
use super::nearest::nearest;

/// Where the text of a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A TOML file.
    Path(PathBuf),
    /// A scene of the [`catalogue`](catalogue()), by its name.
    Catalogue(String),
    /// A text at hand.
    Text {
        /// What error messages call the text.
        name: String,
        /// The text itself.
        text: String,
    },
}

/// Decides whether an argument names a scene of the catalogue or a file.
///
/// A name of the catalogue wins; anything that has a path separator, ends in `.toml` or
/// exists on the disk is a path.
///
/// # Errors
///
/// [`SceneError::UnknownScene`] when it is neither; the message lists the catalogue and
/// suggests the nearest name.
pub fn resolve(name_or_path: &str) -> Result<Source, SceneError> {
    if catalogue::entry(name_or_path).is_some() {
        return Ok(Source::Catalogue(name_or_path.to_owned()));
    }
    let path = Path::new(name_or_path);
    let looks_like_a_path = name_or_path.contains(std::path::is_separator)
        || path
            .extension()
            .is_some_and(|extension| extension == "toml")
        || path.exists();
    if looks_like_a_path {
        Ok(Source::Path(path.to_owned()))
    } else {
        Err(unknown_scene(name_or_path))
    }
}

/// A text with the name that messages give it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SourceText {
    /// Name in messages: the path as it was given, or `scene dam-break`.
    pub name: String,
    /// Name of a scene that does not state one.
    pub stem: String,
    pub text: String,
}

impl Source {
    /// Reads the text.
    pub(super) fn read(&self) -> Result<SourceText, SceneError> {
        match self {
            Self::Path(path) => Ok(SourceText {
                name: path.display().to_string(),
                stem: stem(path),
                text: read_file(path)?,
            }),
            Self::Catalogue(name) => {
                let entry = catalogue::entry(name).ok_or_else(|| unknown_scene(name))?;
                Ok(SourceText {
                    name: format!("{}.toml (catalogue)", entry.name),
                    stem: entry.name.to_owned(),
                    text: entry.text.to_owned(),
                })
            }
            Self::Text { name, text } => Ok(SourceText {
                name: name.clone(),
                stem: stem(Path::new(name)),
                text: text.clone(),
            }),
        }
    }
}

fn unknown_scene(name: &str) -> SceneError {
    let names = catalogue().iter().map(|entry| entry.name);
    SceneError::UnknownScene {
        name: name.to_owned(),
        nearest: nearest(name, names),
    }
}

/// The file's name without its ending, made fit for the name of a scene.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let fit: String = stem
        .chars()
        .map(|c| if is_name_character(c) { c } else { '-' })
        .collect();
    match fit.trim_start_matches('.') {
        "" => "scene".to_owned(),
        name => name.to_owned(),
    }
}

/// Whether a character may stand in the name of a scene, which names a folder of outputs.
pub(super) fn is_name_character(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '-' | '_' | '.')
}

/// Bytes of a scene file at most: what is read of it takes some seventy times as many.
const LONGEST: u64 = 16 << 20;

fn read_file(path: &Path) -> Result<String, SceneError> {
    let shown = path.display().to_string();
    // Asked before opening: reading a folder fails with a different error on each system.
    if path.is_dir() {
        return Err(SceneError::Directory { path: shown });
    }
    let mut bytes = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes));
    read.map_err(|error| match error.kind() {
        ErrorKind::NotFound => SceneError::NotFound {
            path: shown.clone(),
        },
        _ => SceneError::Unreadable {
            path: shown.clone(),
            reason: error,
        },
    })?;
    if bytes.len() as u64 > LONGEST {
        return Err(SceneError::TooLong {
            path: shown,
            limit: LONGEST >> 20,
        });
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..valid]
            .iter()
            .filter(|&&byte| byte == b'\n')
            .count();
        SceneError::NotUtf8 { path: shown, line }
    })
}
