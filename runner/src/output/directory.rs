//! The directory of a run: created without overwriting, written file by file.

use super::error::OutputError;
use super::manifest::Manifest;
use super::particles_csv::CsvWriter;
use super::pvd::Collection;
use super::series::{self, SeriesWriter};
use super::snapshot::Snapshot;
use super::vtp::VtpWriter;
use super::{COLLECTION, frame_path};
use crate::frame::Frame;
use crate::run::Row;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

/// An open run directory.
pub struct RunDirectory {
    path: PathBuf,
    /// Held locked for as long as the directory is written to.
    _lock: Option<File>,
    series: SeriesWriter<File>,
    frames: Collection,
    csv: CsvWriter,
    vtp: VtpWriter,
}

const MANIFEST: &str = "manifest.json";
const SCENE: &str = "scene.toml";
const SERIES: &str = "series.csv";
const FRAMES: &str = "frames";
const SNAPSHOTS: &str = "snapshots";
const LOCK: &str = ".lock";

/// The first of `runs/<scene>-1`, `-2`, … that does not exist.
#[must_use]
pub fn free_directory(scene: &str) -> PathBuf {
    free_directory_in(Path::new(""), scene)
}

/// The same in another folder than the present one.
#[must_use]
pub fn free_directory_in(folder: &Path, scene: &str) -> PathBuf {
    let runs = folder.join("runs");
    (1u64..)
        .map(|n| runs.join(format!("{scene}-{n}")))
        .find(|path| fs::symlink_metadata(path).is_err())
        .unwrap_or_else(|| runs.join(scene))
}

/// `--force` replaces a run, or fills a directory that holds nothing of a run's names; anything
/// else may be somebody's work.
fn refuse_to_replace(path: &Path, force: bool) -> Result<(), OutputError> {
    let refuse = |what| {
        Err(OutputError::NotReplaced {
            path: path.to_owned(),
            what,
        })
    };
    if !path.is_dir() {
        return refuse("is a file");
    }
    if !force {
        return Err(OutputError::Exists(path.to_owned()));
    }
    let ours = [MANIFEST, SCENE, SERIES, COLLECTION];
    let is_empty = !ours.iter().any(|name| path.join(name).exists());
    if is_empty || is_broken_start(path) || RunDirectory::read_manifest(path).is_ok() {
        Ok(())
    } else {
        refuse("holds files of other origin")
    }
}

/// Whether a run was ended here before it had written its first manifest: nothing is there but what
/// comes before.
fn is_broken_start(path: &Path) -> bool {
    let is_lock = |lock: fs::Metadata| lock.is_file() && lock.len() == 0;
    let is_ours = |name: &str| {
        let name = name.strip_suffix(".part").unwrap_or(name);
        [
            LOCK, SCENE, SERIES, COLLECTION, FRAMES, SNAPSHOTS, "scene", "manifest",
        ]
        .contains(&name)
    };
    let only_ours = |entries: fs::ReadDir| {
        entries
            .into_iter()
            .all(|entry| entry.is_ok_and(|entry| entry.file_name().to_str().is_some_and(is_ours)))
    };
    fs::metadata(path.join(LOCK)).is_ok_and(is_lock) && fs::read_dir(path).is_ok_and(only_ours)
}

/// Takes the directory for this process; `None` where the file system knows no locks.
fn lock(path: &Path) -> Result<Option<File>, OutputError> {
    let file = path.join(LOCK);
    let lock = File::create(&file).map_err(io("create", &file))?;
    match lock.try_lock() {
        Ok(()) => Ok(Some(lock)),
        Err(std::fs::TryLockError::WouldBlock) => Err(OutputError::InUse(path.to_owned())),
        Err(std::fs::TryLockError::Error(_)) => Ok(None),
    }
}

fn io(what: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> OutputError {
    let path = path.to_owned();
    move |source| OutputError::Io { what, path, source }
}

/// Writes beside the file and renames, so that a reader sees the old or the new, never a half.
fn replace_by(
    path: &Path,
    write: impl FnOnce(&File) -> std::io::Result<()>,
) -> Result<(), OutputError> {
    let beside = path.with_extension("part");
    File::create(&beside)
        .and_then(|file| write(&file))
        .map_err(io("write", &beside))?;
    fs::rename(&beside, path).map_err(io("replace", path))
}

/// As [`replace_by`], with these bytes.
fn replace(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    replace_by(path, |mut file| file.write_all(bytes))
}

impl RunDirectory {
    /// Creates the directory. With `force` an earlier run in it is removed, other files are not.
    ///
    /// # Errors
    /// It exists already, or cannot be created.
    pub fn create(path: &Path, force: bool) -> Result<Self, OutputError> {
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(io("create", parent))?;
        }
        let mut replacing = false;
        match fs::create_dir(path) {
            Ok(()) => {}
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {
                refuse_to_replace(path, force)?;
                replacing = true;
            }
            Err(error) => return Err(io("create", path)(error)),
        }
        let lock = lock(path)?;
        if replacing {
            remove_run(path)?;
        }
        for sub in [FRAMES, SNAPSHOTS] {
            let sub = path.join(sub);
            fs::create_dir_all(&sub).map_err(io("create", &sub))?;
        }
        let series = path.join(SERIES);
        let file = File::create(&series).map_err(io("create", &series))?;
        Ok(Self {
            path: path.to_owned(),
            _lock: lock,
            series: SeriesWriter::new(file),
            frames: Collection::new(),
            csv: CsvWriter::new(),
            vtp: VtpWriter::new(),
        })
    }

    /// The rows of an earlier run up to `step`.
    ///
    /// # Errors
    /// Not a run, or not readable; a number is not the one whose checksum is in the manifest.
    pub fn read_rows(path: &Path, manifest: &Manifest, step: u64) -> Result<Vec<Row>, OutputError> {
        let not_a_run = |why| OutputError::NotARun {
            path: path.to_owned(),
            why,
        };
        let mut rows = File::open(path.join(SERIES))
            .and_then(series::read)
            .map_err(|e| not_a_run(format!("{SERIES} cannot be read ({e})")))?;
        if let Some(checksums) = &manifest.series {
            if rows.len() < checksums.rows {
                let steps = manifest.steps;
                let why = format!("{SERIES} does not hold the rows up to step {steps}");
                return Err(not_a_run(why));
            }
            if let Some(changed) = checksums.changed(&rows) {
                return Err(OutputError::Changed {
                    path: path.join(SERIES),
                    what: changed.to_string(),
                });
            }
        }
        rows.retain(|row| row.step <= step);
        Ok(rows)
    }

    /// Opens the directory of an earlier run to go on after these rows; later ones are dropped.
    ///
    /// # Errors
    /// The file system's.
    pub fn reopen(path: &Path, rows: &[Row]) -> Result<Self, OutputError> {
        let lock = lock(path)?;
        let series = path.join(SERIES);
        // The rewritten file replaces the old one whole, so that an interruption here loses
        // nothing.
        let beside = series.with_extension("part");
        let file = File::create(&beside).map_err(io("create", &beside))?;
        let mut writer = SeriesWriter::new(file);
        for row in rows {
            writer.write(row).map_err(io("write", &beside))?;
        }
        fs::rename(&beside, &series).map_err(io("replace", &series))?;
        Ok(Self {
            path: path.to_owned(),
            _lock: lock,
            series: writer,
            frames: Collection::new(),
            csv: CsvWriter::new(),
            vtp: VtpWriter::new(),
        })
    }

    /// Whether the first `count` frames of a run are there, in these formats.
    ///
    /// # Errors
    /// Names the first file that is not.
    pub fn has_frames(path: &Path, count: usize, formats: &[&str]) -> Result<(), OutputError> {
        let files = (0..count as u64).flat_map(|n| {
            let formats = formats.iter();
            formats.map(move |format| frame_path(n, format))
        });
        let missing: Vec<String> = files.filter(|file| !path.join(file).is_file()).collect();
        let Some(first) = missing.first() else {
            return Ok(());
        };
        let others = match missing.len() - 1 {
            0 => String::new(),
            others => format!(" and {others} other files of frames"),
        };
        Err(OutputError::NotARun {
            path: path.to_owned(),
            why: format!("{first}{others} were written, and are missing; put them back"),
        })
    }

    /// Whether a run is at work in the directory at this moment.
    #[must_use]
    pub fn is_in_use(path: &Path) -> bool {
        // A file system without locks cannot tell.
        File::open(path.join(LOCK)).is_ok_and(|lock| {
            matches!(
                lock.try_lock_shared(),
                Err(std::fs::TryLockError::WouldBlock)
            )
        })
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of a snapshot by its name.
    #[must_use]
    pub fn snapshot_path(path: &Path, name: &str) -> PathBuf {
        path.join(SNAPSHOTS).join(format!("{name}.snapshot"))
    }

    /// Reads the manifest of a run.
    ///
    /// # Errors
    /// Not a run.
    pub fn read_manifest(path: &Path) -> Result<Manifest, OutputError> {
        let file = path.join(MANIFEST);
        let not_a_run = |why: String| OutputError::NotARun {
            path: path.to_owned(),
            why,
        };
        let text = fs::read_to_string(&file).map_err(|e| {
            not_a_run(if is_broken_start(path) {
                "a run was ended here before its first state was written; begin it again with \
                 --force"
                    .to_owned()
            } else {
                format!("{MANIFEST} cannot be read ({e})")
            })
        })?;
        serde_json::from_str(&text)
            .map_err(|e| not_a_run(format!("{MANIFEST} cannot be understood ({e})")))
    }

    /// Path of the resolved scene.
    #[must_use]
    pub fn scene_path(path: &Path) -> PathBuf {
        path.join(SCENE)
    }

    /// Writes the resolved scene.
    ///
    /// # Errors
    /// The file system's.
    pub fn write_scene(&self, text: &str) -> Result<(), OutputError> {
        replace(&self.path.join(SCENE), text.as_bytes())
    }

    /// Writes the manifest.
    ///
    /// # Errors
    /// The file system's.
    pub fn write_manifest(&self, manifest: &Manifest) -> Result<(), OutputError> {
        let path = self.path.join(MANIFEST);
        let mut text = serde_json::to_string_pretty(manifest)
            .map_err(|e| io("write", &path)(std::io::Error::other(e)))?;
        text.push('\n');
        replace(&path, text.as_bytes())
    }

    /// Adds a row.
    ///
    /// # Errors
    /// The file system's.
    pub fn write_row(&mut self, row: &Row) -> Result<(), OutputError> {
        let path = self.path.join(SERIES);
        self.series.write(row).map_err(io("write", &path))
    }

    /// Writes a snapshot under this name, replacing an earlier one; returns where.
    ///
    /// # Errors
    /// The file system's.
    pub fn write_snapshot(&self, name: &str, snapshot: &Snapshot) -> Result<PathBuf, OutputError> {
        let path = Self::snapshot_path(&self.path, name);
        replace_by(&path, |file| snapshot.write(file))?;
        Ok(path)
    }

    /// Notes a frame that an earlier part of the run has written.
    ///
    /// # Errors
    /// Frames must come in the order of time.
    pub fn note_frame(&mut self, elapsed: f64) -> Result<(), OutputError> {
        let path = self.path.join(COLLECTION);
        let name = frame_path(self.frames.len() as u64, "vtp");
        self.frames.push(elapsed, name).map_err(io("write", &path))
    }

    /// Writes a frame as CSV and VTP, and the collection anew.
    ///
    /// # Errors
    /// The file system's.
    pub fn write_frame(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let index = self.frames.len() as u64;
        let create = |extension| {
            let path = self.path.join(frame_path(index, extension));
            match File::create(&path) {
                Ok(file) => Ok((file, path)),
                Err(source) => Err(io("create", &path)(source)),
            }
        };
        let (file, path) = create("csv")?;
        self.csv.write(frame, file).map_err(io("write", &path))?;
        let (file, path) = create("vtp")?;
        self.vtp.write(frame, file).map_err(io("write", &path))?;
        self.note_frame(frame.elapsed)?;
        let path = self.path.join(COLLECTION);
        let mut text = Vec::new();
        self.frames.write(&mut text).map_err(io("write", &path))?;
        replace(&path, &text)
    }
}

/// Removes what a run writes, and nothing else.
fn remove_run(path: &Path) -> Result<(), OutputError> {
    for name in [MANIFEST, SCENE, SERIES, COLLECTION] {
        let file = path.join(name);
        remove(&file)?;
        remove(&file.with_extension("part"))?;
    }
    for name in ["home", "turnaround", "latest"] {
        let file = RunDirectory::snapshot_path(path, name);
        remove(&file)?;
        remove(&file.with_extension("part"))?;
    }
    let Ok(frames) = fs::read_dir(path.join(FRAMES)) else {
        return Ok(());
    };
    for frame in frames.flatten() {
        if frame.file_name().to_str().is_some_and(is_frame) {
            remove(&frame.path())?;
        }
    }
    Ok(())
}

/// Removes a file that may be missing.
fn remove(file: &Path) -> Result<(), OutputError> {
    match fs::remove_file(file) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(io("remove", file)(e)),
        _ => Ok(()),
    }
}

/// Whether a file of this name is one that [`frame_path`] names.
fn is_frame(name: &str) -> bool {
    let index = name.strip_prefix("particles-").and_then(|rest| {
        let (digits, extension) = rest.split_once('.')?;
        ["csv", "vtp"].contains(&extension).then_some(digits)
    });
    index.is_some_and(|digits| digits.len() >= 6 && digits.bytes().all(|b| b.is_ascii_digit()))
}
