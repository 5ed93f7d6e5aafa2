//! A run that is interrupted and resumed, by whatever and however often, leaves what an
//! uninterrupted one leaves, byte for byte.
#![cfg(unix)]

use crate::program::{Ended, Workplace, end, signal, wait_for_lines};
use std::fs;

/// 325 particles, 2500 steps out and 2500 back, 1000 rows: a second or two.
const SCENE: [&str; 3] = ["dam-break", "--set", "particle_spacing=0.08"];

/// Rows on the way out and on the way back, of about 1000, at which a signal is sent.
const LEGS: [usize; 2] = [150, 620];

fn uninterrupted(place: &Workplace) {
    place.run("whole", &SCENE);
}

/// Starts a run in `broken` and ends it with a signal at a row.
fn interrupted(place: &Workplace, work: &[&str], name: &str, row: usize) -> Ended {
    let mut arguments = vec!["run", "--json", "--quiet", "--out", "broken"];
    arguments.extend(SCENE);
    arguments.extend(work);
    interrupt(place, &arguments, name, row)
}

fn interrupt(place: &Workplace, arguments: &[&str], name: &str, row: usize) -> Ended {
    let child = place.start(arguments);
    wait_for_lines(&place.join("broken"), row);
    signal(&child, name);
    end(child)
}

#[test]
fn a_signal_during_set_up_ends_the_program_and_leaves_nothing() {
    let place = Workplace::new();
    let pipe = std::process::Command::new("mkfifo")
        .arg(place.join("pipe.toml"))
        .status();
    assert!(pipe.is_ok_and(|status| status.success()));
    // A scene that nobody writes, and the positions of 31,000 particles, which take half a minute.
    let calls: [&[&str]; 3] = [
        &["run", "pipe.toml", "--out=broken"],
        if cfg!(feature = "window") {
            &["view", "pipe.toml"]
        } else {
            &["movie", "pipe.toml"]
        },
        &[
            "run",
            "dam-break",
            "--set=particle_spacing=0.008",
            "--set=density_correction=isc",
            "--out=broken",
        ],
    ];
    for arguments in calls {
        for name in ["INT", "TERM"] {
            let child = place.start(arguments);
            std::thread::sleep(std::time::Duration::from_secs(1));
            signal(&child, name);
            end(child).refused(130, &[]);
            assert!(!place.join("broken").exists(), "{arguments:?}");
        }
    }
}

fn assert_says_how_to_resume(ended: Ended) {
    let ended = ended.refused(130, &["interrupted after step "]);
    assert!(ended.stderr.ends_with("loschmidt resume broken\n"));
}

/// Asserts in which leg the run of `broken` stands.
fn assert_leg(place: &Workplace, leg: usize, status: &str) {
    let manifest = place.manifest("broken");
    assert_eq!(manifest["status"], status);
    let (step, turn) = (manifest["steps"].as_u64(), 2500);
    assert!(step.is_some_and(|step| (step < turn) == (leg == 0)));
    assert_eq!(manifest["digest"]["turnaround"].is_null(), leg == 0);
}

fn assert_equals_the_uninterrupted(place: &Workplace, resume: &[&str]) {
    let mut arguments = vec!["resume", "broken", "--json", "--quiet"];
    arguments.extend(resume);
    let ended = place.call(&arguments).with_code(0);
    assert_eq!(ended.stderr, "");
    assert_eq!(ended.json()["reversed_exactly"], true);
    let (whole, broken) = (place.essence("whole"), place.essence("broken"));
    for (name, bytes) in &whole.0 {
        assert!(
            broken.0.get(name) == Some(bytes),
            "{} differs",
            name.display()
        );
    }
    assert_eq!(whole.0.len(), broken.0.len());
    assert_eq!(whole.1, broken.1);
}

#[test]
fn sigint_and_sigterm_in_either_leg_change_nothing() {
    let place = Workplace::new();
    uninterrupted(&place);
    let ways: [(&str, usize, &[&str], &[&str]); 4] = [
        ("INT", 0, &["--threads", "2"], &["--executor", "serial"]),
        ("TERM", 0, &["--executor", "serial"], &[]),
        (
            "INT",
            1,
            &["--executor", "serial"],
            &["--executor", "rayon", "--threads", "3"],
        ),
        ("TERM", 1, &["--threads", "1"], &["--threads", "8"]),
    ];
    for (name, leg, run, resume) in ways {
        let ended = interrupted(&place, run, name, LEGS[leg]);
        assert_says_how_to_resume(ended);
        assert_leg(&place, leg, "interrupted");
        assert_equals_the_uninterrupted(&place, resume);
        fs::remove_dir_all(place.join("broken")).expect("removed");
    }
}

#[test]
fn two_interruptions_change_nothing() {
    let place = Workplace::new();
    uninterrupted(&place);
    assert_says_how_to_resume(interrupted(&place, &[], "INT", LEGS[0]));
    assert_leg(&place, 0, "interrupted");
    let resume = ["resume", "broken", "--json", "--quiet", "--threads", "1"];
    assert_says_how_to_resume(interrupt(&place, &resume, "TERM", LEGS[1]));
    assert_leg(&place, 1, "interrupted");
    assert_equals_the_uninterrupted(&place, &["--executor", "serial"]);
}

#[test]
fn a_run_that_was_killed_goes_on_from_its_latest_snapshot() {
    let place = Workplace::new();
    uninterrupted(&place);
    for (leg, row) in LEGS.into_iter().enumerate() {
        let ended = interrupted(&place, &[], "KILL", row);
        assert_eq!(ended.code, None);
        assert_eq!(ended.stdout, "");
        assert_leg(&place, leg, "running");
        assert_equals_the_uninterrupted(&place, &["--threads", "2"]);
        fs::remove_dir_all(place.join("broken")).expect("removed");
    }
}

#[test]
fn an_impatient_second_signal_loses_nothing() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "--quiet", "--out", "broken", "--executor", "serial"];
    arguments.extend(SCENE);
    let child = place.start(&arguments);
    wait_for_lines(&place.join("broken"), LEGS[0]);
    // All signals wait for the one thread of the program, which has no time to react to the first.
    signal(&child, "STOP");
    for name in ["INT", "TERM", "HUP"] {
        signal(&child, name);
    }
    signal(&child, "CONT");
    assert_says_how_to_resume(end(child));
    assert_leg(&place, 0, "interrupted");
}

#[test]
fn a_directory_in_use_is_left_to_the_run_that_uses_it() {
    let place = Workplace::new();
    let mut arguments = vec!["run", "--quiet", "--out", "broken"];
    arguments.extend(SCENE);
    let child = place.start(&arguments);
    wait_for_lines(&place.join("broken"), LEGS[0]);
    arguments.push("--force");
    place.call(&arguments).refused(3, &["broken is in use"]);
    let resume = place.call(&["resume", "broken", "--quiet"]);
    resume.refused(3, &["broken is in use"]);
    signal(&child, "INT");
    assert_says_how_to_resume(end(child));
}
