//! The dashboard on a real terminal.

use crate::program::terminal::start;
use crate::program::{Workplace, loschmidt};

const SMALL: [&str; 4] = ["tui", "dam-break", "--set", "particle_spacing=0.1"];
const TRUE_COLOURS: [(&str, &str); 1] = [("COLORTERM", "truecolor")];

#[test]
fn time_is_turned_and_comes_back_bit_identical() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (120, 40));
    terminal.wait_for("dam-break");
    terminal.wait_for("forward");
    // It plays at once.
    terminal.wait_for("step 5");
    terminal.type_keys("r");
    terminal.wait_for("time reversed");
    terminal.wait_for("bit-identical");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
    // At the start there is nothing to go on from.
    assert!(!terminal.text().contains("go on"), "{}", terminal.text());
    assert!(!place.join("runs").exists());
}

#[test]
fn who_has_only_watched_leaves_nothing_behind() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (120, 40));
    terminal.wait_for("step 3");
    terminal.type_keys("c");
    terminal.type_keys("?");
    terminal.wait_for("reverse time");
    terminal.type_keys("?");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
    assert!(!place.join("runs").exists(), "{}", terminal.text());
}

#[test]
fn what_is_left_on_the_way_can_be_opened_again() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (120, 40));
    terminal.wait_for("step 2");
    terminal.type_keys(" ");
    terminal.wait_for("paused");
    // Half of the way out; the way there is integrated.
    terminal.type_keys(&"\x1b[6~".repeat(10));
    terminal.wait_for("step 1,0");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
    let shown = terminal.text();
    assert!(shown.contains("loschmidt tui runs/dam-break-1"), "{shown}");

    let mut again = start(
        place.path(),
        &["tui", "runs/dam-break-1"],
        &TRUE_COLOURS,
        (120, 40),
    );
    again.wait_for("step 1,0");
    again.type_keys("\x1b[H");
    again.wait_for("bit-identical");
    again.type_keys("q");
    assert_eq!(again.ended_and_restored(), 0);

    // The planned way of `resume` is not the way of somebody who watches.
    place
        .call(&["resume", "runs/dam-break-1"])
        .refused(2, &["left by the dashboard", "loschmidt tui"]);
}

#[test]
fn what_was_saved_is_not_touched_again() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (120, 40));
    terminal.wait_for("step 2");
    terminal.type_keys(" ");
    terminal.wait_for("paused");
    terminal.type_keys("s");
    terminal.wait_for("runs/dam-break-1");
    let saved = place
        .path()
        .join("runs/dam-break-1/snapshots/latest.snapshot");
    let before = std::fs::read(&saved).expect("a snapshot");
    terminal.type_keys(&"\x1b[6~".repeat(10));
    terminal.wait_for("step 1,0");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
    let shown = terminal.text();
    assert!(shown.contains("loschmidt tui runs/dam-break-2"), "{shown}");
    assert!(std::fs::read(&saved).expect("a snapshot") == before);
    let told = |n: u32| place.manifest(&format!("runs/dam-break-{n}"))["steps"].as_u64();
    assert!(told(2) > told(1));
}

#[test]
fn a_finished_run_is_opened_at_its_end() {
    let place = Workplace::new();
    place.run(
        "run",
        &[
            "dam-break",
            "--set",
            "particle_spacing=0.1",
            "--set",
            "turnaround=0.05",
        ],
    );
    let mut terminal = start(place.path(), &["tui", "run"], &TRUE_COLOURS, (120, 40));
    terminal.wait_for("bit-identical");
    terminal.type_keys("\x1b[F");
    terminal.wait_for("step 100");
    terminal.type_keys("\x03");
    assert_eq!(terminal.ended_and_restored(), 0);

    place.call(&["tui"]).refused(2, &["needs a terminal"]);
    let mut changed = start(
        place.path(),
        &["tui", "run", "--set", "cfl=0.1"],
        &[],
        (120, 40),
    );
    changed.wait_for("its scene cannot be changed");
    assert_eq!(changed.ended_and_restored(), 2);
}

#[test]
fn a_signal_gives_the_terminal_back_and_keeps_the_state() {
    for signal in ["TERM", "INT", "HUP", "QUIT"] {
        let place = Workplace::new();
        let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (100, 30));
        terminal.wait_for("step 3");
        terminal.signal(signal);
        assert_eq!(terminal.ended_and_restored(), 130, "{signal}");
        let shown = terminal.text();
        assert!(
            shown.contains("loschmidt tui runs/dam-break-1"),
            "{signal}: {shown}"
        );
    }
}

#[test]
fn a_terminal_that_goes_away_ends_the_program_and_the_state_is_kept() {
    let place = Workplace::new();
    let terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (100, 30));
    terminal.wait_for("step 3");
    assert_eq!(terminal.close(), 130);
    assert_eq!(place.manifest("runs/dam-break-1")["status"], "watched");
}

#[test]
fn the_bare_program_opens_the_dashboard_on_a_terminal() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &[], &[], (100, 30));
    terminal.wait_for("5,000 particles");
    terminal.type_keys("\x1b[H");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
}

#[test]
fn without_colours_and_resized_it_still_plays() {
    let place = Workplace::new();
    let none = [("NO_COLOR", "1"), ("COLORTERM", "truecolor")];
    let mut terminal = start(place.path(), &SMALL, &none, (200, 60));
    terminal.wait_for("step 1");
    assert!(!terminal.is_coloured());
    for (columns, rows) in [(60, 20), (90, 25), (30, 8), (100, 30)] {
        terminal.resize(columns, rows);
        terminal.wait_for(if columns < 60 {
            "at least 60 x 20"
        } else {
            "ENTROPY"
        });
    }
    terminal.type_keys("?");
    terminal.wait_for("reverse time");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
}

#[test]
fn a_picture_is_written_beside_and_never_over_another() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (120, 40));
    terminal.wait_for("forward");
    terminal.type_keys(" ");
    terminal.wait_for("paused");
    terminal.type_keys("p");
    terminal.wait_for("picture: dam-break-step-");
    terminal.type_keys("p");
    terminal.wait_for("-2.png");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
    let pictures = std::fs::read_dir(place.path()).expect("a directory");
    let pictures = pictures.flatten().filter(|entry| {
        let path = entry.path();
        path.extension().is_some_and(|extension| extension == "png")
    });
    assert_eq!(pictures.count(), 2);
}

#[test]
fn a_scene_with_a_mistake_is_refused_before_the_screen_is_taken() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &["tui", "dam-brake"], &[], (100, 30));
    terminal.wait_for("dam-break");
    assert_eq!(terminal.ended_and_restored(), 2);
    let piped = loschmidt(place.path(), &["tui", "dam-break"])
        .output()
        .expect("an end");
    let error = String::from_utf8(piped.stderr).expect("UTF-8");
    assert_eq!(
        (piped.status.code(), error.lines().count()),
        (Some(2), 1),
        "{error}"
    );
}

#[test]
fn a_stopped_dashboard_gives_the_terminal_back_and_takes_it_again() {
    let place = Workplace::new();
    let mut terminal = start(place.path(), &SMALL, &TRUE_COLOURS, (120, 40));
    terminal.wait_for("step 3");
    terminal.signal("TSTP");
    terminal.wait_until_given_back();
    terminal.signal("CONT");
    terminal.wait_for("forward");
    terminal.type_keys(" ");
    terminal.wait_for("paused");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
}

#[test]
fn a_state_that_cannot_be_kept_here_is_kept_elsewhere() {
    let place = Workplace::new();
    // A file in the place of the folder: also one who may write everything cannot.
    std::fs::write(place.join("runs"), "in the way").expect("a file");
    std::fs::create_dir(place.join("elsewhere")).expect("a directory");
    let elsewhere = place.join("elsewhere").to_str().expect("UTF-8").to_owned();
    let environment = [("TMPDIR", elsewhere.as_str())];
    let mut terminal = start(place.path(), &SMALL, &environment, (200, 40));
    terminal.wait_for("step 3");
    // Who has only watched leaves nothing.
    terminal.type_keys("b");
    terminal.wait_for("last bit flipped");
    terminal.type_keys("q");
    assert_eq!(terminal.ended_and_restored(), 0);
    let kept = "elsewhere/runs/dam-break-1";
    assert!(terminal.text().contains(kept), "{}", terminal.text());
    assert_eq!(place.manifest(kept)["status"], "watched");
}

#[test]
fn a_signal_while_a_scene_is_set_up_ends_the_dashboard() {
    let place = Workplace::new();
    // The positions of 31,000 particles, which take half a minute.
    let call = [
        "tui",
        "dam-break",
        "--set=particle_spacing=0.008",
        "--set=density_correction=isc",
    ];
    let mut terminal = start(place.path(), &call, &TRUE_COLOURS, (100, 30));
    terminal.wait_for("dam-break");
    std::thread::sleep(std::time::Duration::from_secs(1));
    let began = std::time::Instant::now();
    terminal.signal("TERM");
    assert_eq!(terminal.ended_and_restored(), 130);
    assert!(began.elapsed() < std::time::Duration::from_secs(10));
}
