//! The other commands, and everything that is refused: exit code 2 and nothing on standard output.

use crate::program::{Ended, Workplace};
use serde_json::Value;
use std::fs;
use std::time::{Duration, Instant};

const CATALOGUE: [&str; 17] = [
    "dam-break",
    "dam-break-3d",
    "colliding-drops",
    "rotating-drop",
    "gresho-vortex",
    "kepler-ring",
    "beryllium-plate",
    "twisting-column",
    "colliding-rings",
    "cantilever",
    "taylor-couette",
    "lid-driven-cavity",
    "second-sound",
    "second-sound-steep",
    "counterflow",
    "normal-cavity",
    "fountain",
];

/// Makes a few dozen steps of a scene of the catalogue.
const SHORT: [(&str, &[&str]); 8] = [
    ("dam-break", &["particle_spacing=0.1", "turnaround=0.02"]),
    (
        "dam-break-3d",
        &["particle_spacing=0.125", "turnaround=0.05"],
    ),
    (
        "colliding-drops",
        &["particle_spacing=0.05", "turnaround=0.03"],
    ),
    (
        "rotating-drop",
        &["particle_spacing=0.05", "turnaround=0.06"],
    ),
    (
        "gresho-vortex",
        &["particle_spacing=0.05", "turnaround=0.02"],
    ),
    ("kepler-ring", &["particle_spacing=0.05", "turnaround=0.5"]),
    (
        "beryllium-plate",
        &["particle_spacing=1e-3", "turnaround=1e-7"],
    ),
    (
        "twisting-column",
        &["particle_spacing=0.2", "turnaround=1e-3"],
    ),
];

#[test]
fn the_catalogue_is_listed_with_its_sources() {
    let place = Workplace::new();
    let ended = place.call(&["scenes"]).with_code(0);
    for name in CATALOGUE {
        assert!(ended.stdout.lines().any(|line| line.starts_with(name)));
    }
    assert_eq!(ended.stdout.lines().count(), 2 * CATALOGUE.len());
    assert_eq!(ended.stderr, "");
}

#[test]
fn a_printed_scene_is_the_scene() {
    let place = Workplace::new();
    for (name, set) in SHORT {
        let set: Vec<&str> = set.iter().flat_map(|&s| ["--set", s]).collect();
        let mut arguments = vec![name];
        arguments.extend(&set);
        let direct = place.run(&format!("{name}-direct"), &arguments);
        // Printed with the overrides in it, and printed without them and overridden later.
        let mut print = vec!["scenes", "print", name];
        print.extend(&set);
        let text = place.call(&print).with_code(0).stdout;
        fs::write(place.join("scene.toml"), &text).expect("a file");
        let printed = place.run(&format!("{name}-printed"), &["scene.toml"]);
        assert_eq!(direct["digest"], printed["digest"]);
        assert_eq!(direct["scene"], printed["scene"]);
        assert_eq!(
            fs::read_to_string(place.join(&format!("{name}-direct/scene.toml"))).expect("a file"),
            text
        );
        let plain = place.call(&["scenes", "print", name]).with_code(0).stdout;
        fs::write(place.join("plain.toml"), plain).expect("a file");
        arguments[0] = "plain.toml";
        let overridden = place.run(&format!("{name}-overridden"), &arguments);
        assert_eq!(direct["digest"], overridden["digest"]);
    }
}

#[test]
fn check_tells_what_every_scene_of_the_catalogue_takes() {
    let place = Workplace::new();
    for name in CATALOGUE {
        let text = place.call(&["check", name]).with_code(0).stdout;
        let solid = text.contains(" solid\n");
        let viscous = text.contains(" viscous fluid\n");
        let limit = if solid || viscous {
            "elastic limit"
        } else {
            "acoustic limit"
        };
        for word in ["particles", "steps", "memory", "time", limit, "force limit"] {
            assert!(
                text.lines().any(|line| line.trim_start().starts_with(word)),
                "{word}: {text}"
            );
        }
        assert!(!text.contains("EXCEEDED"), "{text}");
        assert!(!text.contains("SPOILT"), "{text}");
        for warning in ["TOO LOW", "HOLES", "does not fit"] {
            assert!(!text.contains(warning), "{text}");
        }
        assert_eq!(solid, text.contains("Young's modulus"), "{text}");
        assert_eq!(viscous, text.contains("relaxation time"), "{text}");
        let helium = text.contains("second sound");
        assert_eq!(helium, text.contains("superfluid helium at"), "{text}");
        for device in ["superleak", "mutual friction"] {
            assert_eq!(name == "fountain", text.contains(device), "{text}");
        }
        assert_eq!(
            name == "normal-cavity",
            text.contains("a lid of 1.000 m/s"),
            "{text}"
        );
    }
    let paper = ["check", "beryllium-plate", "--preset", "paper"];
    let text = place.call(&paper).with_code(0).stdout;
    assert!(
        text.contains("1.548 of the stiffness in bulk, SPOILT"),
        "{text}"
    );
    let text = place.call(&["check", "dam-break"]).with_code(0).stdout;
    assert!(text.contains("80000 fluid, 6008 wall"));
    assert!(text.contains("80000 (40000 out and 40000 back)"));
    let set = [
        "check",
        "dam-break",
        "--set",
        "particle_spacing=0.1",
        "--set",
        "cfl=0.5",
    ];
    let text = place.call(&set).with_code(0).stdout;
    assert!(text.contains("EXCEEDED (0.4 h/c)"), "{text}");
    assert!(
        fs::read_dir(place.path())
            .expect("a directory")
            .next()
            .is_none()
    );
}

#[test]
fn check_compares_walls_sound_and_shapes_with_the_flow() {
    let place = Workplace::new();
    let set = |more: &'static str| {
        let arguments = [
            "check",
            "dam-break",
            "--set=particle_spacing=0.1",
            "--set",
            more,
        ];
        place.call(&arguments).with_code(0).stdout
    };
    for (more, warning) in [
        ("wall.energy=1", "TOO LOW (ten times, "),
        ("wall.radius=0.5", "HOLES"),
        (
            "fluid.sound_speed=20",
            "TOO LOW (ten times), the density changes by about ",
        ),
        ("particle_spacing=0.15", "does not fit the particle spacing"),
    ] {
        let text = set(more);
        assert!(text.contains(warning), "{more}: {text}");
    }
    let text = set("domain=30");
    assert!(
        text.contains("32 m from the origin along each axis"),
        "{text}"
    );
}

#[test]
fn check_foretells_the_failures_of_the_run_and_no_others() {
    let place = Workplace::new();
    // Steps too long for the sound: the run fails in step 28.
    let set = ["--set=particle_spacing=0.1", "--set=cfl=0.9"];
    let call = |command: &str, more: &str| {
        let mut all = vec![command, "dam-break", set[0], set[1], more];
        if command == "run" {
            all.push("--quiet");
        }
        place.call(&all)
    };
    let foretold = call("check", "--set=turnaround=0.1").with_code(1).stdout;
    let failed = call("run", "--set=turnaround=0.1").with_code(4).stderr;
    let reason = "particle 2 in step 28: one of its force or density terms left the number range";
    assert!(
        foretold.contains(&format!("the run will fail, {reason}")),
        "{foretold}"
    );
    assert!(failed.contains(reason), "{failed}");
    // A run that turns before it does not.
    let foretold = call("check", "--set=turnaround=0.02").with_code(0).stdout;
    assert!(!foretold.contains("fail"), "{foretold}");
    call("run", "--set=turnaround=0.02").with_code(0);
}

#[test]
fn the_digest_of_a_snapshot_is_that_of_the_manifest() {
    let place = Workplace::new();
    for (n, (name, set)) in SHORT.into_iter().enumerate() {
        for arithmetic in ["fixed", "float"] {
            let out = format!("{name}-{arithmetic}");
            let mut arguments = vec!["run", "--quiet", "--out", &out, name];
            arguments.extend(["--arithmetic", arithmetic]);
            arguments.extend(set.iter().flat_map(|&s| ["--set", s]));
            let code = place.call(&arguments).code;
            assert!(
                code == Some(0) || (code == Some(1) && arithmetic == "float"),
                "{n}"
            );
            let digest = |snapshot: &str| {
                let path = format!("{out}/snapshots/{snapshot}.snapshot");
                Value::String(
                    place
                        .call(&["digest", &path])
                        .with_code(0)
                        .stdout
                        .trim_end()
                        .to_owned(),
                )
            };
            let manifest = &place.manifest(&out)["digest"];
            assert_eq!(manifest["initial"], digest("home"));
            assert_eq!(manifest["turnaround"], digest("turnaround"));
            assert_eq!(manifest["final"], digest("latest"));
        }
    }
}

#[test]
fn completions_for_every_shell() {
    let place = Workplace::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let ended = place.call(&["completions", shell]).with_code(0);
        for word in ["loschmidt", "resume", "arithmetic"] {
            assert!(ended.stdout.contains(word), "{shell}");
        }
        assert_eq!(ended.stderr, "");
    }
    place.call(&["completions", "cmd"]).refused(2, &["bash"]);
}

#[test]
fn help_and_version_are_no_errors() {
    let place = Workplace::new();
    let help = place.call(&["--help"]).with_code(0);
    for word in [
        "run",
        "resume",
        "scenes",
        "check",
        "digest",
        "completions",
        "130",
    ] {
        assert!(help.stdout.contains(word));
    }
    let version = place.call(&["--version"]).with_code(0);
    assert_eq!(
        version.stdout,
        format!("loschmidt {}\n", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn mistakes_on_the_command_line_are_told_and_exit_with_2() {
    let place = Workplace::new();
    fs::write(place.join("latin-1.toml"), b"name = \"\xfcber\"\n").expect("a file");
    fs::create_dir(place.join("folder.toml")).expect("a directory");
    let calls: [(&[&str], &[&str]); 15] = [
        (&["run", "dam-brake"], &["dam-brake", "dam-break"]),
        (&["run", "missing.toml"], &["missing.toml"]),
        (&["run", "latin-1.toml"], &["latin-1.toml", "UTF-8"]),
        (&["run", "folder.toml"], &["folder.toml"]),
        (&["check", "dam-brake"], &["dam-break"]),
        (&["scenes", "print", "dam-brake"], &["dam-break"]),
        (&["run"], &["SCENE"]),
        (&["walk"], &["walk"]),
        (&["run", "dam-break", "--fast"], &["--fast"]),
        (&["run", "dam-break", "--threads", "0"], &["--threads"]),
        (
            &["run", "dam-break", "--executor", "gpu"],
            &["serial", "rayon"],
        ),
        (
            &["run", "dam-break", "--arithmetic", "half"],
            &["fixed", "float"],
        ),
        (
            &["run", "dam-break", "--set", "particle_spacing"],
            &["particle_spacing"],
        ),
        (
            &["run", "dam-break", "--set", "particle_spacing=-1"],
            &["--set", "greater than 0", "m"],
        ),
        (
            &["run", "dam-break", "--set", "particle_spcing=0.1"],
            &["particle_spacing"],
        ),
    ];
    for (arguments, words) in calls {
        place.call(arguments).refused(2, words);
    }
    assert!(!place.join("runs").exists(), "nothing was begun");
}

#[test]
fn what_is_no_snapshot_has_no_digest() {
    let place = Workplace::new();
    fs::write(place.join("a.snapshot"), "LSCHSNAP and then something else").expect("a file");
    place
        .call(&["digest", "a.snapshot"])
        .refused(2, &["a.snapshot"]);
    place.call(&["digest", "missing"]).refused(2, &["missing"]);
    place.call(&["digest", "."]).refused(2, &["."]);
    // A device that has no end, and a pipe that nobody writes to.
    let endless = "/dev/zero";
    if std::path::Path::new(endless).exists() {
        let refused = place.call(&["digest", endless]);
        refused.refused(2, &[endless, "no regular file"]);
    }
    let pipe = std::process::Command::new("mkfifo")
        .arg(place.join("pipe"))
        .status();
    if pipe.is_ok_and(|status| status.success()) {
        let refused = place.call(&["digest", "pipe"]);
        refused.refused(2, &["pipe", "no regular file"]);
    }
}

#[test]
fn a_scene_far_too_large_is_refused_before_anything_is_allocated() {
    let place = Workplace::new();
    for command in ["run", "check"] {
        let began = Instant::now();
        let call = [command, "dam-break", "--set", "particle_spacing=1e-6"];
        place.call(&call).refused(
            2,
            &["the scene needs about", "of memory", "particle_spacing"],
        );
        assert!(began.elapsed() < Duration::from_secs(10));
    }
    assert!(!place.join("runs").exists());
}

/// Scenes, names and arguments that would repaint the screen.
#[test]
fn what_a_terminal_would_obey_is_shown_instead() {
    let place = Workplace::new();
    let wild = "\u{1b}]0;title\u{7}\u{202e}";
    let file = format!("{wild}.toml");
    fs::write(place.join(&file), "'a\u{202e}b' = 1\n").expect("a file");
    fs::write(place.join("esc.toml"), format!("a = 1 # {wild}\n")).expect("a file");
    let set = format!("--set={wild}=1");
    let calls: [&[&str]; 7] = [
        &["check", &file],
        &["check", "esc.toml"],
        &["check", wild],
        &["check", "dam-break", &set],
        &["resume", wild],
        &["digest", wild],
        &["run", "dam-break", "--executor", wild],
    ];
    for call in calls {
        let ended = place.call(call).refused(2, &[]);
        let obeyed = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
        assert!(!ended.stderr.contains(obeyed), "{call:?}: {ended:#?}");
    }
}

/// What ended with an abort and a backtrace.
#[cfg(target_os = "linux")]
#[test]
fn a_limit_of_the_address_space_is_told_in_words() {
    let place = Workplace::new();
    let program = env!("CARGO_BIN_EXE_loschmidt");
    for (command, limit) in [("check", 600_000), ("run", 600_000), ("check", 150_000)] {
        let call = format!(
            "ulimit -v {limit}; exec {program} {command} dam-break --set particle_spacing=0.001"
        );
        let ended = std::process::Command::new("sh")
            .current_dir(place.path())
            .args(["-c", &call])
            .output();
        let ended: Ended = ended.expect("a shell").into();
        ended.refused(
            2,
            &[
                "the scene needs about",
                "limit of its address space, `ulimit -v`",
            ],
        );
        assert!(!place.join("runs").exists());
    }
}

#[cfg(target_os = "linux")]
mod interrupted {
    use super::*;
    use crate::program::{end, signal, wait_for, wait_for_lines};

    /// Largest memory that a process has held so far, bytes.
    fn peak(pid: u32) -> u64 {
        let status = fs::read_to_string(format!("/proc/{pid}/status")).expect("a process");
        let line = status.lines().find(|line| line.starts_with("VmHWM:"));
        let words: Vec<&str> = line.expect("a peak").split_whitespace().collect();
        1024 * words[1].parse::<u64>().expect("kB")
    }

    #[test]
    fn the_paper_s_own_dam_break_starts_within_2_gib_and_tells_how_long_it_takes() {
        let place = Workplace::new();
        let child = place.start(&["run", "dam-break", "--out", "a"]);
        // Two rows: 80 steps of 80,000 particles.
        wait_for_lines(&place.join("a"), 2);
        let memory = peak(child.id());
        signal(&child, "INT");
        let words = [
            "dam-break: 80,000 particles, 80,000 steps, fast on ",
            "\nabout ",
            "; about 431 MiB of frames, written to a\n",
            "/80000, ",
            " left; ",
            "loschmidt resume a",
        ];
        let ended = end(child).refused(130, &words);
        println!("{} MiB; {}", memory >> 20, ended.stderr);
        assert!(memory < 2 << 30);
        assert_eq!(place.manifest("a")["steps_planned"], 80_000);
    }

    #[test]
    fn without_arguments_it_is_the_small_dam_break() {
        let place = Workplace::new();
        let child = place.start(&[]);
        let run = place.join("runs/dam-break-small-1");
        wait_for("a manifest", || run.join("manifest.json").exists());
        signal(&child, "TERM");
        end(child).refused(
            130,
            &[
                "dam-break-small with particle_spacing=0.02 name=dam-break-small: 5,000 particles, \
                 20,000 steps, ",
                " MiB of frames, written to runs/dam-break-small-1",
                "loschmidt resume runs/dam-break-small-1",
            ],
        );
        let manifest = place.manifest("runs/dam-break-small-1");
        assert_eq!(manifest["steps_planned"], 20_000);
        assert_eq!(
            manifest["digest"]["initial"],
            "b613df923636cef25005d7e559dd5ab2"
        );
        let scene = fs::read_to_string(run.join("scene.toml")).expect("a scene");
        assert!(scene.contains("\nparticle_spacing = 0.02 "));
    }
}
