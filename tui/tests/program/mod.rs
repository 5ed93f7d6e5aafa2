//! The program `loschmidt`, started as a user would, and what it leaves behind.

// Every test file takes what it needs of this.
#![allow(dead_code)]

#[cfg(unix)]
pub mod terminal;

use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A call of the program in a directory.
pub fn loschmidt(directory: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_loschmidt"));
    command
        .current_dir(directory)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// What a call of the program ended with.
#[derive(Debug)]
pub struct Ended {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Self {
            code: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

impl Ended {
    /// Asserts the exit code; hands itself on.
    pub fn with_code(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{self:#?}");
        self
    }

    /// Asserts the exit code of a failure, that nothing went to standard output, and that the
    /// message holds these words.
    pub fn refused(self, code: i32, words: &[&str]) -> Self {
        let ended = self.with_code(code);
        assert_eq!(ended.stdout, "", "{ended:#?}");
        for word in words {
            assert!(ended.stderr.contains(word), "no {word:?} in {ended:#?}");
        }
        ended
    }

    /// The object on standard output, and nothing else there.
    pub fn json(&self) -> Value {
        assert!(self.stdout.ends_with("}\n"), "{self:#?}");
        serde_json::from_str(&self.stdout).expect("one JSON object")
    }
}

/// A directory of its own for every test, and the program in it.
pub struct Workplace(TempDir);

impl Workplace {
    pub fn new() -> Self {
        Self(TempDir::new().expect("a temporary directory"))
    }
    pub fn path(&self) -> &Path {
        self.0.path()
    }
    pub fn join(&self, path: &str) -> PathBuf {
        self.path().join(path)
    }
    pub fn call(&self, arguments: &[&str]) -> Ended {
        loschmidt(self.path(), arguments)
            .output()
            .expect("the program starts")
            .into()
    }
    /// `run` with `--json --quiet` and this output directory, which has to succeed.
    pub fn run(&self, out: &str, arguments: &[&str]) -> Value {
        let mut all = vec!["run", "--json", "--quiet", "--out", out];
        all.extend(arguments);
        let ended = self.call(&all).with_code(0);
        assert_eq!(ended.stderr, "");
        ended.json()
    }
    pub fn start(&self, arguments: &[&str]) -> Child {
        loschmidt(self.path(), arguments)
            .spawn()
            .expect("the program starts")
    }
    pub fn manifest(&self, run: &str) -> Value {
        let text = fs::read_to_string(self.join(run).join("manifest.json")).expect("a manifest");
        serde_json::from_str(&text).expect("JSON")
    }
    /// What a run leaves that must not depend on how it was computed or interrupted: every file but
    /// the manifest, and the manifest without times, threads and executor.
    pub fn essence(&self, run: &str) -> (BTreeMap<PathBuf, Vec<u8>>, Value) {
        let root = self.join(run);
        let mut files = files_below(&root);
        files
            .remove(Path::new("manifest.json"))
            .expect("a manifest");
        let mut manifest = self.manifest(run);
        let forget = |object: &mut Value, keys: &[&str]| {
            let object = object.as_object_mut().expect("an object");
            for key in keys {
                object.remove(*key).unwrap_or_else(|| panic!("no {key}"));
            }
        };
        forget(&mut manifest, &["executor", "threads"]);
        forget(
            &mut manifest["result"],
            &[
                "executor",
                "backend",
                "threads",
                "wall_time_s",
                "ns_per_particle_step",
            ],
        );
        (files, manifest)
    }
}

/// Every file below a directory, by its path from there.
pub fn files_below(root: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut left = vec![root.to_owned()];
    while let Some(directory) = left.pop() {
        for entry in fs::read_dir(&directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                left.push(path);
            } else {
                let name = path.strip_prefix(root).expect("below").to_owned();
                files.insert(name, fs::read(&path).expect("a file"));
            }
        }
    }
    files
}

/// Waits until the condition holds, a minute at most.
pub fn wait_for(what: &str, mut condition: impl FnMut() -> bool) {
    let began = Instant::now();
    while !condition() {
        assert!(began.elapsed() < Duration::from_secs(60), "no {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Waits until the series of a run has so many lines.
pub fn wait_for_lines(run: &Path, lines: usize) {
    let series = run.join("series.csv");
    wait_for(&format!("{lines} lines in {}", series.display()), || {
        fs::read(&series).is_ok_and(|text| bytecount(&text) >= lines)
    });
}

fn bytecount(text: &[u8]) -> usize {
    text.iter().filter(|&&byte| byte == b'\n').count()
}

/// Sends a signal, by its name without SIG.
pub fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill")
        .args([format!("-{name}"), child.id().to_string()])
        .status()
        .expect("kill");
    assert!(sent.success());
}

/// Waits for the end of a program that was started.
pub fn end(child: Child) -> Ended {
    child.wait_with_output().expect("an end").into()
}
