//! The directory of a movie.
//!
//! | file | holds |
//! |---|---|
//! | `frame-00000.png`, … | the pictures |
//! | `movie.json` | [`MovieManifest`]: what they show, and whether all are there |
//! | `state-0.snapshot`, `series-0.csv` (and `-1` for a second run), `views.csv` | where an interrupted export goes on |
//!
//! Every file is written beside its place and renamed, so that there is the old one or the new one,
//! never half of one.

use super::error::MovieError;
use super::target;
use super::{MovieStyle, Times};
use crate::colour::Rgb;
use crate::raster::Raster;
use crate::{picture, png};
use loschmidt_core::digest::hash;
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

const MANIFEST: &str = "movie.json";
const LOCK: &str = ".lock";

/// The boxes that the pictures show.
const VIEWS: &str = "views.csv";

/// `movie.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MovieManifest {
    /// Version of the program that drew the pictures.
    pub version: String,
    /// Name of the scene.
    pub scene: String,
    /// Hash of everything the pixels depend on.
    pub identity: String,
    /// Width of a picture, pixels.
    pub width: usize,
    /// Height of a picture, pixels.
    pub height: usize,
    /// Pictures per second.
    pub fps: u32,
    /// Number of pictures.
    pub pictures: usize,
    /// Whether all pictures are there.
    pub finished: bool,
}

/// A directory of pictures.
pub struct Movie {
    path: PathBuf,
    pub(super) style: MovieStyle,
    manifest: MovieManifest,
    /// Pictures that were there when it was opened.
    found: usize,
    /// Held locked for as long as the directory is written to.
    _lock: Option<File>,
    /// Where the time went.
    pub times: Times,
}

/// The first of `movies/<scene>-1`, `-2`, … that does not exist.
#[must_use]
pub fn free_directory(scene: &str) -> PathBuf {
    (1u64..)
        .map(|n| Path::new("movies").join(format!("{scene}-{n}")))
        .find(|path| fs::symlink_metadata(path).is_err())
        .unwrap_or_else(|| Path::new("movies").join(scene))
}

/// Name of a picture's file.
#[must_use]
pub fn picture_name(picture: usize) -> String {
    format!("frame-{picture:05}.png")
}

impl Movie {
    /// Opens the directory of a movie: a new one, or the same movie's where an earlier export was
    /// interrupted. `scene` names the run and `run` is a text of everything that it depends on.
    /// With `force` another movie in it, or a finished one, is removed; other files never are.
    ///
    /// # Errors
    /// It holds something else, or cannot be created.
    pub fn create(
        path: &Path,
        force: bool,
        style: MovieStyle,
        scene: &str,
        run: &str,
    ) -> Result<Self, MovieError> {
        let version = env!("CARGO_PKG_VERSION");
        let identity = hash(format!("{version}\n{}\n{run}", style.text()).as_bytes());
        let mut manifest = MovieManifest {
            version: version.to_owned(),
            scene: scene.to_owned(),
            identity: identity.iter().map(|byte| format!("{byte:02x}")).collect(),
            width: style.size.0,
            height: style.size.1,
            fps: style.fps,
            pictures: style.pictures,
            finished: false,
        };
        let earlier = earlier(path, force)?;
        fs::create_dir_all(path).map_err(MovieError::io("create", path))?;
        let lock = lock(path)?;
        let mut found = 0;
        match earlier {
            Some(earlier)
                if earlier.identity == manifest.identity && !(force && earlier.finished) =>
            {
                manifest.finished = earlier.finished;
                found = (0..style.pictures)
                    .take_while(|&n| is_whole(&path.join(picture_name(n)), style.size))
                    .count();
                manifest.finished &= found == style.pictures;
            }
            Some(_) if !force => return Err(MovieError::OtherMovie(path.to_owned())),
            Some(_) => remove_movie(path)?,
            None => {}
        }
        let movie = Self {
            path: path.to_owned(),
            style,
            manifest,
            found,
            _lock: lock,
            times: Times::default(),
        };
        movie.write_manifest()?;
        Ok(movie)
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Pictures that an earlier export had left.
    #[must_use]
    pub fn found(&self) -> usize {
        self.found
    }

    /// Whether all pictures are there.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.manifest.finished
    }

    /// What the pictures look like.
    #[must_use]
    pub fn style(&self) -> &MovieStyle {
        &self.style
    }

    /// Paths of the pictures, in order.
    pub fn pictures(&self) -> impl ExactSizeIterator<Item = PathBuf> + use<'_> {
        (0..self.style.pictures).map(|n| self.path.join(picture_name(n)))
    }

    pub(super) fn write_picture(&mut self, n: usize, raster: &Raster) -> Result<(), MovieError> {
        let began = Instant::now();
        replace(&self.path.join(picture_name(n)), |file| {
            png::write(raster, file).map_err(std::io::Error::other)
        })?;
        self.times.writing += began.elapsed();
        Ok(())
    }

    pub(super) fn finish(&mut self) -> Result<(), MovieError> {
        self.manifest.finished = true;
        self.write_manifest()?;
        for run in 0..2 {
            remove(&self.state_path(run))?;
            remove(&self.series_path(run))?;
        }
        remove(&self.views_path())
    }

    fn write_manifest(&self) -> Result<(), MovieError> {
        replace(&self.path.join(MANIFEST), |file| {
            serde_json::to_writer_pretty(&mut *file, &self.manifest)?;
            file.write_all(b"\n")
        })
    }

    pub(super) fn state_path(&self, run: usize) -> PathBuf {
        self.path.join(format!("state-{run}.snapshot"))
    }

    pub(super) fn views_path(&self) -> PathBuf {
        self.path.join(VIEWS)
    }

    pub(super) fn series_path(&self, run: usize) -> PathBuf {
        self.path.join(format!("series-{run}.csv"))
    }
}

/// What is in the directory: nothing, or a movie.
fn earlier(path: &Path, force: bool) -> Result<Option<MovieManifest>, MovieError> {
    if path.is_file() {
        return Err(MovieError::Exists(path.to_owned()));
    }
    let Ok(entries) = fs::read_dir(path) else {
        return Ok(None);
    };
    let manifest = fs::read(path.join(MANIFEST))
        .ok()
        .and_then(|text| serde_json::from_slice(&text).ok());
    let is_empty = entries.flatten().all(|entry| entry.file_name() == LOCK);
    if manifest.is_none() && !is_empty && !force {
        return Err(MovieError::Foreign(path.to_owned()));
    }
    Ok(manifest)
}

/// Takes the directory for this process; `None` where the file system knows no locks.
fn lock(path: &Path) -> Result<Option<File>, MovieError> {
    let file = path.join(LOCK);
    let lock = File::create(&file).map_err(MovieError::io("create", &file))?;
    match lock.try_lock() {
        Ok(()) => Ok(Some(lock)),
        Err(fs::TryLockError::WouldBlock) => Err(MovieError::InUse(path.to_owned())),
        Err(fs::TryLockError::Error(_)) => Ok(None),
    }
}

/// Writes a file beside its place and renames it.
pub(super) fn replace(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> Result<(), MovieError> {
    let beside = target::beside(path);
    let result = File::create(&beside).and_then(|file| {
        let mut file = BufWriter::new(file);
        write(&mut file)?;
        file.flush()
    });
    if let Err(source) = result {
        // What is left of the attempt is of no use; that it cannot be removed changes nothing.
        let _ = fs::remove_file(&beside);
        return Err(MovieError::io("write", path)(source));
    }
    fs::rename(&beside, path).map_err(MovieError::io("write", path))
}

/// Removes what a movie consists of, and nothing else.
fn remove_movie(path: &Path) -> Result<(), MovieError> {
    let entries = fs::read_dir(path).map_err(MovieError::io("read", path))?;
    for entry in entries.flatten() {
        let name = entry.file_name();
        if name.to_str().is_some_and(is_ours) {
            remove(&entry.path())?;
        }
    }
    Ok(())
}

fn is_ours(name: &str) -> bool {
    let number = |prefix: &str, suffix: &str| {
        let middle = name
            .strip_prefix(prefix)
            .and_then(|rest| rest.strip_suffix(suffix));
        middle.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
    };
    name == MANIFEST
        || name == VIEWS
        || number("frame-", ".png")
        || number("state-", ".snapshot")
        || number("series-", ".csv")
}

fn remove(path: &Path) -> Result<(), MovieError> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
            Err(MovieError::io("remove", path)(e))
        }
        _ => Ok(()),
    }
}

/// Whether a picture of this size is there, whole and as it was written.
fn is_whole(path: &Path, size: (usize, usize)) -> bool {
    fs::read(path).is_ok_and(|bytes| png::is_whole(&bytes, size))
}

/// Reads one of the pictures, or one to tint with.
///
/// # Errors
/// It is missing or not a picture.
pub(super) fn read_picture(path: &Path) -> Result<Raster, MovieError> {
    File::open(path)
        .map_err(Into::into)
        .and_then(|file| picture::read(BufReader::new(file), Rgb(0xff_ff_ff)))
        .map_err(|source| MovieError::Picture {
            path: path.to_owned(),
            source,
        })
}

impl crate::Picture {
    /// Reads a picture to tint with; transparent parts are white.
    ///
    /// # Errors
    /// It is missing or not a picture.
    pub fn open(path: &Path) -> Result<Self, MovieError> {
        Ok(Self::new(read_picture(path)?))
    }
}
