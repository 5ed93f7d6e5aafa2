//! The object that `--json` prints, the exit codes of a run, and where its files go.

use crate::program::{Workplace, files_below};
use serde_json::{Value, json};
use std::fs;

/// 50 particles, 320 steps out and 320 back: some hundredths of a second.
const SMALL: [&str; 5] = [
    "dam-break",
    "--set",
    "particle_spacing=0.2",
    "--set",
    "turnaround=0.32",
];

/// The same scene without a turnaround.
const ONE_WAY: [&str; 7] = [
    "dam-break",
    "--set",
    "particle_spacing=0.2",
    "--set",
    "turnaround=",
    "--set",
    "end=0.32",
];

fn keys(value: &Value) -> Vec<&str> {
    let object = value.as_object().expect("an object");
    object.keys().map(String::as_str).collect()
}

fn sorted<'a>(keys: &[&'a str]) -> Vec<&'a str> {
    let mut keys = keys.to_vec();
    keys.sort_unstable();
    keys
}

fn assert_documented_keys(result: &Value) {
    let of = |part: &str| sorted(&keys(&result[part]));
    let top = [
        "directory",
        "scene",
        "dimension",
        "particles",
        "wall_particles",
        "steps",
        "time_step_s",
        "model",
        "integrator",
        "arithmetic",
        "executor",
        "backend",
        "threads",
        "digest",
        "reversed_exactly",
        "max_return_error_m",
        "energy",
        "momentum",
        "angular_momentum",
        "entropy",
        "lone_particles",
        "largest_compression",
        "beyond_walls",
        "wall_time_s",
        "ns_per_particle_step",
    ];
    assert_eq!(sorted(&keys(result)), sorted(&top));
    assert_eq!(of("digest"), ["final", "initial", "turnaround"]);
    let energy = [
        "initial_J",
        "max_error_J",
        "max_error_over_released",
        "released_J",
    ];
    assert_eq!(of("energy"), energy);
    assert_eq!(of("momentum"), ["exactly_constant", "final", "initial"]);
    assert_eq!(of("angular_momentum"), ["initial", "turnaround"]);
    let entropy = ["equilibrium_turnaround", "final", "initial", "turnaround"];
    assert_eq!(of("entropy"), entropy);
}

#[test]
fn the_result_has_the_documented_keys_and_stands_alone_on_standard_output() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "--json", "--threads", "2", "--out", "a"];
    arguments.extend(SMALL);
    let ended = place.call(&arguments).with_code(0);
    assert_ne!(ended.stderr, "", "progress is told elsewhere");
    let result = ended.json();
    assert_documented_keys(&result);
    let expected = json!({
        "directory": "a",
        "scene": "dam-break",
        "dimension": 2,
        "particles": 50,
        "steps": 640,
        "time_step_s": 0.2 * (3.0 * 0.2) / 120.0,
        "model": "symplectic",
        "integrator": "stormer-verlet",
        "arithmetic": "fixed",
        "executor": "fast",
        "threads": 2,
        "reversed_exactly": true,
        "max_return_error_m": 0.0,
    });
    for (key, value) in expected.as_object().expect("an object") {
        assert_eq!(&result[key], value, "{key}");
    }
    assert_eq!(result["digest"]["initial"], result["digest"]["final"]);
    assert_ne!(result["digest"]["initial"], result["digest"]["turnaround"]);
    assert_eq!(result["momentum"]["exactly_constant"], false, "gravity");
    assert!(result["energy"]["released_J"].as_f64() > Some(0.0));
    assert!(result["wall_particles"].as_u64() > Some(0));
    assert_eq!(place.manifest("a")["digest"], result["digest"]);
    assert_eq!(place.manifest("a")["status"], "finished");
    // The directory does not say where it is.
    let mut result = result;
    result["directory"].take();
    let mut kept = place.manifest("a")["result"].take();
    kept["directory"] = Value::Null;
    assert_eq!(kept, result);
}

#[test]
fn the_serial_executor_counts_as_one_thread() {
    let place = Workplace::new();
    let mut arguments = SMALL.to_vec();
    arguments.extend(["--executor", "serial", "--threads", "3"]);
    let result = place.run("a", &arguments);
    assert_eq!(result["executor"], "serial");
    assert_eq!(result["threads"], 1);
}

#[test]
fn a_one_way_run_has_no_return_to_speak_of() {
    let place = Workplace::new();
    let result = place.run("a", &ONE_WAY);
    assert_documented_keys(&result);
    assert_eq!(result["steps"], 320);
    assert_eq!(result["digest"]["turnaround"], Value::Null);
    assert_eq!(result["reversed_exactly"], Value::Null);
    assert_eq!(result["max_return_error_m"], Value::Null);
    assert_eq!(result["entropy"]["turnaround"], Value::Null);
    // Its end is the turnaround of the run that comes back.
    let there_and_back = place.run("b", &SMALL);
    assert_eq!(
        result["digest"]["final"],
        there_and_back["digest"]["turnaround"]
    );
    assert_eq!(
        result["entropy"]["final"],
        there_and_back["entropy"]["turnaround"]
    );
    assert_eq!(
        result["entropy"]["equilibrium_turnaround"],
        there_and_back["entropy"]["equilibrium_turnaround"]
    );
}

#[test]
fn half_a_way_back_is_no_return_but_has_a_turnaround() {
    let place = Workplace::new();
    let mut arguments = SMALL.to_vec();
    arguments.extend(["--set", "end=0.5"]);
    let result = place.run("a", &arguments);
    assert_eq!(result["steps"], 500);
    assert_eq!(result["reversed_exactly"], Value::Null);
    assert!(result["digest"]["turnaround"].is_string());
    assert!(result["entropy"]["turnaround"].is_number());
    // 320 out and 180 back are the state after 140, velocities along physical time.
    let short = place.run(
        "b",
        &[
            "dam-break",
            "--set",
            "particle_spacing=0.2",
            "--set",
            "turnaround=0.14",
        ],
    );
    assert_eq!(result["digest"]["final"], short["digest"]["turnaround"]);
}

#[test]
fn floating_point_and_the_standard_scheme_do_not_return_and_exit_with_1() {
    let place = Workplace::new();
    let spacing = ["--set", "particle_spacing=0.04", "--set", "turnaround=0.8"];
    let mut arguments = vec!["run", "dam-break", "--json", "--quiet", "--out", "float"];
    arguments.extend(spacing);
    arguments.extend(["--arithmetic", "float"]);
    let result = place.call(&arguments).with_code(1).json();
    assert_documented_keys(&result);
    assert_eq!(result["arithmetic"], "float");
    assert_eq!(result["reversed_exactly"], false);
    let error = result["max_return_error_m"].as_f64().expect("a distance");
    println!("float, spacing 0.04 m, turned at 0.8 s: {error} m");
    assert!(error > 0.04);

    let mut arguments = vec!["run", "--json", "--quiet", "--out", "standard"];
    arguments.extend(SMALL);
    arguments.extend(["--set", "model=standard"]);
    let result = place.call(&arguments).with_code(1).json();
    assert_eq!(result["model"], "standard");
    assert_eq!(result["reversed_exactly"], false);
    assert_ne!(result["digest"]["initial"], result["digest"]["final"]);
}

#[test]
fn numbers_that_end_exit_with_4_and_leave_the_last_good_state() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "dam-break", "--json", "--quiet", "--out", "a"];
    for set in [
        "particle_spacing=0.2",
        "model=standard",
        "cfl=0.4",
        "turnaround=2",
    ] {
        arguments.extend(["--set", set]);
    }
    let ended = place
        .call(&arguments)
        .refused(4, &["the run ended at t = 1.324000 s"]);
    let lines: Vec<&str> = ended.stderr.lines().collect();
    assert_eq!(lines.len(), 2, "{ended:#?}");
    assert!(lines[0].ends_with("particle 13 in step 662: its density is not positive"));
    assert_eq!(
        lines[1],
        "the last good state is in a/snapshots/latest.snapshot"
    );
    assert_eq!(place.manifest("a")["steps"], 661);
    assert_eq!(place.manifest("a")["status"], "failed");
    let digest = place
        .call(&["digest", "a/snapshots/latest.snapshot"])
        .with_code(0);
    assert_eq!(
        place.manifest("a")["digest"]["final"],
        digest.stdout.trim_end()
    );
    let words = ["the run in a has failed", "nothing to resume"];
    place.call(&["resume", "a"]).refused(2, &words);
}

#[test]
fn without_json_the_end_is_a_table_and_a_sentence() {
    let place = Workplace::new();
    let call = |out, more: &[&str]| {
        let mut arguments = vec!["run", "--out", out];
        arguments.extend(SMALL);
        arguments.extend(more);
        place.call(&arguments)
    };
    let ended = call("a", &[]).with_code(0);
    let home = place.manifest("a")["digest"]["initial"].clone();
    let home = home.as_str().expect("a digest");
    for word in [
        "start",
        "turnaround",
        "end",
        "kinetic energy",
        "entropy",
        home,
    ] {
        assert!(ended.stdout.contains(word), "no {word:?} in {ended:#?}");
    }
    assert!(ended.stdout.ends_with(
        "Time came back: after 320 steps out and 320 back, \
         every bit of the last state equals the first.\n"
    ));
    let ended = call("b", &["--quiet"]).with_code(0);
    assert!(ended.stdout.starts_with("Time came back"));
    assert_eq!(ended.stderr, "");
    let ended = call("c", &["--quiet", "--set", "model=standard"]).with_code(1);
    assert!(ended.stdout.starts_with("Time did not come back"));
}

#[test]
fn a_directory_that_exists_is_refused_and_left_alone() {
    let place = Workplace::new();
    place.run("a", &SMALL);
    let before = files_below(&place.join("a"));
    let mut arguments = vec!["run", "--json", "--out", "a"];
    arguments.extend(SMALL);
    place
        .call(&arguments)
        .refused(3, &["a exists already", "--force"]);
    assert!(before == files_below(&place.join("a")));
    // Also one that is empty, and a file.
    fs::create_dir(place.join("empty")).expect("a directory");
    arguments[3] = "empty";
    place.call(&arguments).refused(3, &["empty exists already"]);
    assert!(files_below(&place.join("empty")).is_empty());
    fs::write(place.join("file"), "mine").expect("a file");
    arguments[3] = "file";
    place.call(&arguments).refused(3, &["file is a file"]);
    arguments.push("--force");
    place.call(&arguments).refused(3, &["file"]);
    assert_eq!(fs::read(place.join("file")).expect("a file"), b"mine");
}

#[test]
fn force_replaces_a_run_and_touches_no_file_of_others() {
    let place = Workplace::new();
    place.run("fresh", &SMALL);
    // An earlier run that left more frames, and files that no run writes.
    let mut arguments = SMALL.to_vec();
    arguments.extend(["--set", "output.frames=100"]);
    place.run("a", &arguments);
    let foreign = [
        "notes.txt",
        "series.csv.bak",
        "frames/measured.csv",
        "frames/particles.vtp",
        "frames/picture.png",
        "snapshots/mine.snapshot",
        "snapshots/deeper/latest.snapshot",
    ];
    fs::create_dir(place.join("a/snapshots/deeper")).expect("a directory");
    for name in foreign {
        fs::write(place.join("a").join(name), name).expect("a file");
    }
    let mut arguments = SMALL.to_vec();
    arguments.push("--force");
    place.run("a", &arguments);
    for name in foreign {
        let path = place.join("a").join(name);
        let text = fs::read_to_string(&path).unwrap_or_else(|_| panic!("{name} is gone"));
        assert_eq!(text, name);
        fs::remove_file(path).expect("removed");
    }
    assert!(place.essence("a") == place.essence("fresh"));
}

#[test]
fn force_touches_nothing_where_there_was_no_run() {
    let place = Workplace::new();
    fs::create_dir(place.join("lesson")).expect("a directory");
    for name in ["scene.toml", "series.csv"] {
        fs::write(place.join("lesson").join(name), "mine").expect("a file");
    }
    let before = files_below(&place.join("lesson"));
    let mut arguments = vec!["run", "--out", "lesson", "--force"];
    arguments.extend(SMALL);
    place
        .call(&arguments)
        .refused(3, &["lesson holds files of other origin"]);
    assert!(before == files_below(&place.join("lesson")));
}

#[test]
fn runs_are_numbered_where_no_directory_is_given() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "--quiet"];
    arguments.extend(SMALL);
    for n in 1..=3 {
        place.call(&arguments).with_code(0);
        assert_eq!(
            place.manifest(&format!("runs/dam-break-{n}"))["status"],
            "finished"
        );
    }
    // The first number that is free, be what is in the way a directory or a file.
    fs::remove_dir_all(place.join("runs/dam-break-2")).expect("removed");
    fs::write(place.join("runs/dam-break-4"), "").expect("a file");
    place.call(&arguments).with_code(0);
    place.manifest("runs/dam-break-2");
    place.call(&arguments).with_code(0);
    place.manifest("runs/dam-break-5");
}

#[test]
fn output_that_cannot_be_written_exits_with_3() {
    let place = Workplace::new();
    fs::write(place.join("file"), "mine").expect("a file");
    let mut arguments = vec!["run", "--json", "--out", "file/a"];
    arguments.extend(SMALL);
    place.call(&arguments).refused(3, &["cannot create file"]);
    fs::write(place.join("runs"), "mine").expect("a file");
    let mut arguments = vec!["run", "--json"];
    arguments.extend(SMALL);
    place.call(&arguments).refused(3, &["cannot create runs"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_up_in_mid_run_exits_with_3() {
    let place = Workplace::new();
    // No file above 64 blocks of 512 bytes, and an error instead of a signal.
    let script = "trap '' XFSZ; ulimit -f 64; exec \"$0\" \"$@\"";
    let mut arguments = vec!["-c", script, env!("CARGO_BIN_EXE_loschmidt")];
    arguments.extend(["run", "--json", "--quiet", "--out", "a"]);
    arguments.extend(SMALL);
    let output = std::process::Command::new("sh")
        .args(arguments)
        .current_dir(place.path())
        .output()
        .expect("a shell");
    crate::program::Ended::from(output).refused(3, &["cannot write a/series.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_exits_with_3() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "--json", "--quiet", "--out", "a"];
    arguments.extend(SMALL);
    let full = fs::OpenOptions::new().write(true).open("/dev/full");
    let output = crate::program::loschmidt(place.path(), &arguments)
        .stdout(full.expect("/dev/full"))
        .output()
        .expect("the program starts");
    crate::program::Ended::from(output).refused(3, &["cannot write the result"]);
    // The run itself is safe.
    assert_eq!(place.manifest("a")["status"], "finished");
}

#[cfg(unix)]
#[test]
fn nobody_listening_to_the_progress_does_not_stop_a_run() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "--json", "--out", "a"];
    arguments.extend(SMALL);
    let mut child = place.start(&arguments);
    drop(child.stderr.take());
    let ended = crate::program::end(child).with_code(0);
    assert_eq!(ended.json()["reversed_exactly"], true);
}
