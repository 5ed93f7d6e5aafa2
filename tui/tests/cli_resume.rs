//! What cannot be resumed is told, and left as it is.
#![cfg(unix)]

use crate::program::{Workplace, end, files_below, signal, wait_for_lines};
use loschmidt_core::digest::hash;
use loschmidt_runner::output::Snapshot;
use std::fs;
use std::path::Path;

const SET: [&str; 3] = ["dam-break", "--set", "particle_spacing=0.1"];

/// A run that was interrupted on its way back.
fn broken(place: &Workplace, out: &str, more: &[&str]) {
    let mut arguments = vec!["run", "--quiet", "--out", out];
    arguments.extend(SET);
    arguments.extend(more);
    let child = place.start(&arguments);
    wait_for_lines(&place.join(out), 650);
    signal(&child, "INT");
    end(child).refused(130, &[]);
}

/// Asserts that the run is refused with these words, and afterwards is as it was.
fn assert_refused(place: &Workplace, run: &str, words: &[&str]) {
    let before = files_below(&place.join(run));
    place.call(&["resume", run, "--json"]).refused(2, words);
    let after = files_below(&place.join(run));
    let names =
        |files: &std::collections::BTreeMap<_, _>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&before), names(&after));
    for (name, bytes) in &before {
        assert!(after[name] == *bytes, "{} was changed", name.display());
    }
}

fn change(path: &Path, change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let before = fs::read(path).expect("a file");
    let mut bytes = before.clone();
    change(&mut bytes);
    fs::write(path, bytes).expect("written");
    before
}

#[test]
fn a_start_that_was_ended_early_is_told_and_may_be_begun_again() {
    let place = Workplace::new();
    // What there is, from one moment to the next, before the first manifest.
    let made = [
        ".lock",
        "frames/",
        "snapshots/",
        "series.csv",
        "scene.part",
        "scene.toml",
        "manifest.part",
    ];
    for most in 1..=made.len() {
        let run = place.join("early");
        fs::create_dir(&run).expect("a directory");
        for name in &made[..most] {
            match name.strip_suffix('/') {
                Some(name) => fs::create_dir(run.join(name)).expect("a directory"),
                None if *name == ".lock" => fs::write(run.join(name), "").expect("a file"),
                None => fs::write(run.join(name), "half a").expect("a file"),
            }
        }
        assert_refused(&place, "early", &["before its first state", "--force"]);
        let mut again = vec!["run", "--quiet", "--force", "--out=early"];
        again.extend(SET);
        again.push("--set=turnaround=0.01");
        place.call(&again).with_code(0);
        fs::write(run.join("notes.txt"), "somebody's").expect("a file");
        fs::remove_file(run.join("manifest.json")).expect("removed");
        place.call(&again).refused(3, &["other origin"]);
        fs::remove_dir_all(&run).expect("removed");
    }
}

#[test]
fn what_is_no_run_is_refused() {
    let place = Workplace::new();
    place
        .call(&["resume", "missing"])
        .refused(2, &["missing is not the directory of a run"]);
    fs::create_dir(place.join("empty")).expect("a directory");
    assert_refused(
        &place,
        "empty",
        &["empty is not the directory of a run", "manifest.json"],
    );
    fs::write(place.join("empty/manifest.json"), "{}").expect("a file");
    assert_refused(&place, "empty", &["empty is not the directory of a run"]);
    place.call(&["resume"]).refused(2, &["RUN"]);
}

#[test]
fn a_finished_run_is_refused() {
    let place = Workplace::new();
    place.run(
        "a",
        &[
            "dam-break",
            "--set",
            "particle_spacing=0.2",
            "--set",
            "turnaround=0.1",
        ],
    );
    assert_refused(
        &place,
        "a",
        &["the run in a has finished", "nothing to resume"],
    );
}

#[test]
fn a_damaged_or_missing_file_is_named_and_nothing_is_changed() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    for name in ["home", "turnaround", "latest"] {
        let name = format!("{name}.snapshot");
        let path = place.join("a/snapshots").join(&name);
        let whole = change(&path, |bytes| bytes[1000] ^= 1);
        assert_refused(&place, "a", &[&name, "checksum"]);
        change(&path, |bytes| bytes.truncate(1000));
        assert_refused(&place, "a", &[&name, "checksum"]);
        change(&path, |bytes| bytes.clear());
        assert_refused(&place, "a", &[&name, "is not a usable snapshot"]);
        fs::remove_file(&path).expect("removed");
        assert_refused(&place, "a", &["cannot read snapshot", &name]);
        fs::write(&path, whole).expect("written");
    }
    let scene = place.join("a/scene.toml");
    let whole = change(&scene, |bytes| bytes.extend(b"[[["));
    assert_refused(&place, "a", &["scene.toml"]);
    fs::remove_file(&scene).expect("removed");
    assert_refused(&place, "a", &["scene.toml"]);
    fs::write(&scene, whole).expect("written");
    fs::rename(place.join("a/series.csv"), place.join("series.csv")).expect("moved");
    place.call(&["resume", "a"]).refused(2, &["series.csv"]);
    fs::rename(place.join("series.csv"), place.join("a/series.csv")).expect("moved");
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn a_series_cut_off_anywhere_is_refused() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    let series = place.join("a/series.csv");
    let whole = fs::read(&series).expect("a series");
    let last_line = whole[..whole.len() - 1]
        .iter()
        .rposition(|&b| b == b'\n')
        .expect("lines");
    // The last line without its end, in the middle of its last number, at every place; whole lines
    // fewer; a line that is missing in the middle; nothing.
    let mut cuts: Vec<Vec<u8>> = (last_line..whole.len())
        .map(|end| whole[..end].to_vec())
        .collect();
    cuts.push(whole[..whole.len() / 2].to_vec());
    let lines: Vec<&[u8]> = whole.split_inclusive(|&b| b == b'\n').collect();
    cuts.push([&lines[..100], &lines[101..]].concat().concat());
    cuts.push(lines[0].to_vec());
    cuts.push(Vec::new());
    for cut in cuts {
        fs::write(&series, &cut).expect("written");
        assert_refused(
            &place,
            "a",
            &["series.csv does not hold the rows up to step"],
        );
    }
    // Garbage in the middle.
    let mut garbage = lines.clone();
    garbage[100] = b"these,are,no,numbers\n";
    fs::write(&series, garbage.concat()).expect("written");
    assert_refused(&place, "a", &["series.csv"]);
    fs::write(&series, &whole).expect("written");
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn snapshots_of_another_scene_or_arithmetic_are_refused() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    // The same particles under another time step; other particles; the same scene in floats.
    broken(&place, "slow", &["--set", "cfl=0.19"]);
    broken(&place, "coarse", &["--set", "particle_spacing=0.2"]);
    broken(&place, "float", &["--arithmetic", "float"]);
    let latest = place.join("a/snapshots/latest.snapshot");
    let own = fs::read(&latest).expect("a snapshot");
    for other in ["slow", "coarse"] {
        fs::copy(place.join(other).join("snapshots/latest.snapshot"), &latest).expect("copied");
        assert_refused(&place, "a", &["latest.snapshot was taken of another scene"]);
    }
    fs::copy(place.join("float/snapshots/latest.snapshot"), &latest).expect("copied");
    assert_refused(
        &place,
        "a",
        &["does not belong to this scene", "another arithmetic"],
    );
    fs::write(&latest, own).expect("written");
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn a_snapshot_in_the_place_of_another_is_refused() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    let path = |name: &str| place.join("a/snapshots").join(format!("{name}.snapshot"));
    for (name, other) in [
        ("home", "latest"),
        ("home", "turnaround"),
        ("turnaround", "latest"),
    ] {
        let own = fs::read(path(name)).expect("a snapshot");
        fs::copy(path(other), path(name)).expect("copied");
        assert_refused(
            &place,
            "a",
            &[&format!("{name}.snapshot holds the state after step ")],
        );
        fs::write(path(name), own).expect("written");
    }
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn a_run_of_a_version_with_other_comments_goes_on() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    let scene = place.join("a/scene.toml");
    let text = fs::read_to_string(&scene).expect("a scene");
    let older = text.replacen("# ", "# formerly ", 3);
    assert_ne!(text, older);
    fs::write(&scene, &older).expect("written");
    for name in ["home", "turnaround", "latest"] {
        let path = place.join("a/snapshots").join(format!("{name}.snapshot"));
        let mut snapshot = Snapshot::read(&path).expect("a snapshot");
        snapshot.scene = hash(older.as_bytes());
        let mut file = fs::File::create(&path).expect("a file");
        snapshot.write(&mut file).expect("written");
    }
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn a_changed_number_of_the_series_is_named() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    let series = place.join("a/series.csv");
    let whole = fs::read_to_string(&series).expect("a series");
    let lines: Vec<&str> = whole.lines().collect();
    let columns: Vec<&str> = lines[0].split(',').collect();
    for (column, other) in [
        ("entropy", "0.5"),
        ("total_J", "1e3"),
        ("step", "8"),
        ("front_m", "7"),
        ("momentum_y_kg_m_per_s", "12"),
    ] {
        let place_of = columns.iter().position(|name| *name == column);
        for line in [2, 100, 600] {
            let mut numbers: Vec<&str> = lines[line - 1].split(',').collect();
            numbers[place_of.expect("a column")] = other;
            let mut changed = lines.clone();
            let numbers = numbers.join(",");
            changed[line - 1] = &numbers;
            fs::write(&series, changed.join("\n") + "\n").expect("written");
            let row = line - 2;
            let words = format!("the `{column}` of row {row}, in line {line}, is another");
            assert_refused(&place, "a", &["a/series.csv was changed since", &words]);
        }
    }
    fs::write(&series, whole).expect("written");
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn a_forged_snapshot_is_told_from_the_one_in_the_manifest() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    for name in ["home", "turnaround", "latest"] {
        let path = place.join("a/snapshots").join(format!("{name}.snapshot"));
        let whole = fs::read(&path).expect("a snapshot");
        let mut snapshot = Snapshot::read(&path).expect("a snapshot");
        snapshot.state.fields[0].words[17] ^= 1;
        snapshot
            .write(fs::File::create(&path).expect("a file"))
            .expect("written");
        let file = format!("a/snapshots/{name}.snapshot was changed since");
        assert_refused(
            &place,
            "a",
            &[&file, "has the digest ", "the manifest says "],
        );
        fs::write(&path, whole).expect("written");
    }
    place.call(&["resume", "a", "--quiet"]).with_code(0);
}

#[test]
fn missing_frames_are_named() {
    let place = Workplace::new();
    broken(&place, "a", &["--set", "output.frames=20"]);
    let frame = place.join("a/frames/particles-000003.vtp");
    let whole = fs::read(&frame).expect("a frame");
    fs::remove_file(&frame).expect("removed");
    let words = ["frames/particles-000003.vtp", "missing; put them back"];
    assert_refused(&place, "a", &words);
    fs::write(&frame, whole).expect("written");
    place.call(&["resume", "a", "--quiet"]).with_code(0);
    fs::remove_file(place.join("a/frames/particles-000003.csv")).expect("removed");
    let words = ["frames/particles-000003.csv", "missing; put them back"];
    place.call(&["movie", "a"]).refused(2, &words);
}

/// A series of an earlier version has no momentum in kg m/s, and the manifest no checksums.
#[test]
fn a_run_of_a_version_without_checksums_goes_on() {
    let place = Workplace::new();
    broken(&place, "a", &[]);
    let series = place.join("a/series.csv");
    let whole = fs::read_to_string(&series).expect("a series");
    let cut = |line: &str| line.rsplitn(4, ',').last().expect("columns").to_owned() + "\n";
    fs::write(&series, whole.lines().map(cut).collect::<String>()).expect("written");
    let manifest = place.join("a/manifest.json");
    let mut values = place.manifest("a");
    values.as_object_mut().expect("an object").remove("series");
    fs::write(&manifest, values.to_string()).expect("written");
    place.call(&["resume", "a", "--quiet"]).with_code(0);
    let resumed = fs::read_to_string(&series).expect("a series");
    assert!(resumed.starts_with(&whole), "the earlier rows are others");
}

/// A path that is not UTF-8 is printed so that a shell takes it.
#[cfg(target_os = "linux")]
#[test]
fn the_command_to_resume_can_be_pasted_whatever_the_path() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let place = Workplace::new();
    let out = OsStr::from_bytes(b"a\xff b");
    let mut run = crate::program::loschmidt(place.path(), &["run", "--quiet", "--out"]);
    let child = run.arg(out).args(SET).spawn().expect("the program");
    wait_for_lines(&place.path().join(out), 100);
    signal(&child, "INT");
    let ended = end(child).refused(130, &["loschmidt resume $'a\\xff b'\n"]);
    let command = ended.stderr.lines().last().expect("a command").trim();
    let command = command.replacen("loschmidt", env!("CARGO_BIN_EXE_loschmidt"), 1);
    let resumed = std::process::Command::new("bash")
        .current_dir(place.path())
        .args(["-c", &format!("{command} --quiet")])
        .status();
    assert!(resumed.expect("a shell").success());
}
