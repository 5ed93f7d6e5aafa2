//! Where a GIF or an MP4 is to be written.

use super::error::MovieError;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The name under which a file is written, until it is whole.
pub(super) fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    path.with_file_name(name)
}

/// Finds out whether a movie can be written there, before pictures are made for it.
///
/// # Errors
/// The path names no file, or one in a folder that is not there or may not be written; something is
/// there that is no regular file, or a file and `force` is not given.
pub fn check(path: &Path, force: bool) -> Result<(), MovieError> {
    match fs::metadata(path) {
        Ok(data) if !data.is_file() => return Err(MovieError::NotAFile(path.to_owned())),
        Ok(_) if !force => return Err(MovieError::Exists(path.to_owned())),
        Ok(_) => {}
        Err(error) if error.kind() == ErrorKind::NotFound => {}
        Err(error) => return Err(MovieError::io("write", path)(error)),
    }
    if path.file_name().is_none() {
        return Err(MovieError::NotAFile(path.to_owned()));
    }
    let beside = beside(path);
    match fs::File::create_new(&beside) {
        Ok(_) => fs::remove_file(&beside),
        // Another export is at work, or one was broken off.
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
        Err(error) => Err(error),
    }
    .map_err(MovieError::io("write", path))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_written_is_told_before() {
        let place = tempfile::tempdir().expect("a directory");
        let at = |name: &str| place.path().join(name);
        assert!(check(&at("new.gif"), false).is_ok());
        assert!(
            fs::read_dir(place.path())
                .expect("a directory")
                .next()
                .is_none()
        );
        fs::write(at("old.gif"), "old").expect("a file");
        let refused = check(&at("old.gif"), false);
        assert!(matches!(refused, Err(MovieError::Exists(_))));
        assert!(check(&at("old.gif"), true).is_ok());
        assert_eq!(fs::read(at("old.gif")).expect("a file"), b"old");
        let refused = check(&at("none/new.gif"), true);
        assert!(matches!(refused, Err(MovieError::Io { .. })));
        for special in [place.path(), Path::new("/dev/full"), Path::new("/")] {
            let refused = check(special, true);
            let no_file = matches!(refused, Err(MovieError::NotAFile(_)));
            assert!(no_file || !special.exists(), "{special:?}");
        }
    }
}
