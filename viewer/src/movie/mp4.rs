//! A movie as an MP4, by ffmpeg: the pictures are piped to it.

use super::directory::Movie;
use super::error::MovieError;
use super::target;
use std::ffi::OsString;
use std::fs;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::process::{Command, Stdio};

/// H.264 that every player opens: even sizes, two by two pixels with one colour.
const CODING: [&str; 10] = [
    "-vf",
    "pad=ceil(iw/2)*2:ceil(ih/2)*2",
    "-c:v",
    "libx264",
    "-crf",
    "18",
    "-pix_fmt",
    "yuv420p",
    "-movflags",
    "+faststart",
];

/// Whether ffmpeg is on the path.
#[must_use]
pub fn is_available() -> bool {
    Command::new("ffmpeg")
        .arg("-version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
}

/// A path as ffmpeg takes it: one with a colon or a leading hyphen would be a protocol or an option.
fn named(path: &Path) -> OsString {
    let mut name = OsString::new();
    let text = path.to_string_lossy();
    if text.contains(':') || text.starts_with('-') {
        name.push("file:");
    }
    name.push(path);
    name
}

/// The command that makes the movie by hand. `quote` writes a path as a shell takes it.
#[must_use]
pub fn command(movie: &Movie, to: &Path, quote: impl Fn(&Path) -> String) -> String {
    format!(
        "ffmpeg -framerate {} -i {} {} {}",
        movie.style().fps,
        quote(Path::new(&named(&movie.path().join("frame-%05d.png")))),
        CODING
            .map(|word| if word.contains('(') {
                format!("'{word}'")
            } else {
                word.to_owned()
            })
            .join(" "),
        quote(Path::new(&named(to)))
    )
}

/// Writes the pictures of a finished movie as an MP4. `by_hand`: what [`command`] returns.
///
/// # Errors
/// There is no ffmpeg, or it failed; the file exists and `force` is not given.
pub fn write(movie: &Movie, to: &Path, force: bool, by_hand: String) -> Result<(), MovieError> {
    target::check(to, force)?;
    let beside = target::beside(to);
    let spawned = Command::new("ffmpeg")
        .args(["-y", "-loglevel", "error", "-f", "image2pipe", "-framerate"])
        .arg(movie.style().fps.to_string())
        .args(["-c:v", "png", "-i", "-"])
        .args(CODING)
        .args(["-f", "mp4"])
        .arg(named(&beside))
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = match spawned {
        Ok(child) => child,
        Err(e) if e.kind() == ErrorKind::NotFound => {
            return Err(MovieError::NoFfmpeg {
                path: to.to_owned(),
                command: by_hand,
            });
        }
        Err(e) => return Err(MovieError::io("start ffmpeg for", to)(e)),
    };
    let mut fed = Ok(());
    if let Some(mut pipe) = child.stdin.take() {
        for path in movie.pictures() {
            let picture = fs::File::open(&path).map_err(MovieError::io("read", &path));
            fed = picture.and_then(|mut picture| {
                std::io::copy(&mut picture, &mut pipe)
                    .map(drop)
                    .map_err(MovieError::io("pipe to ffmpeg", &path))
            });
            if fed.is_err() {
                break;
            }
        }
    }
    let mut said = String::new();
    if let Some(mut stderr) = child.stderr.take() {
        // What it says is wanted only if it fails.
        let _ = stderr.read_to_string(&mut said);
    }
    let ended = child
        .wait()
        .map_err(MovieError::io("wait for ffmpeg for", to))?;
    if !ended.success() {
        let _ = fs::remove_file(&beside);
        return Err(MovieError::Ffmpeg {
            path: to.to_owned(),
            why: said.lines().next().unwrap_or("no reason given").to_owned(),
            command: by_hand,
        });
    }
    fed?;
    fs::rename(&beside, to).map_err(MovieError::io("write", to))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_path_is_an_option_or_a_protocol() {
        for (path, name) in [
            ("a.mp4", "a.mp4"),
            ("-x.mp4", "file:-x.mp4"),
            ("a:b.mp4", "file:a:b.mp4"),
            ("/tmp/a.mp4", "/tmp/a.mp4"),
        ] {
            assert_eq!(named(Path::new(path)), name);
        }
    }
}
