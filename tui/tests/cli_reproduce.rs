//! `reproduce`, and the presets: what is worked out, kept, refused and resumed.

use crate::program::Workplace;
use std::fs;

const FIG2: [&str; 4] = ["reproduce", "fig2", "--quick", "--out"];

fn fig2(out: &str) -> Vec<&str> {
    FIG2.into_iter().chain([out]).collect()
}

#[test]
fn a_target_leaves_a_report_and_is_kept_and_another_report_is_not_put_over_it() {
    let place = Workplace::new();
    let first = place.call(&fig2("report")).with_code(0);
    for words in [
        "Fig. 2: the standard scheme gains energy",
        "holds    standard: ",
        "written to report/report.html",
    ] {
        assert!(first.stdout.contains(words), "{first:#?}");
    }
    assert!(!first.stdout.contains("FAILS"));
    assert!(!first.stderr.contains("kept from before"));
    for file in ["report.html", "report.md", "fig2.svg", "fig2.json"] {
        assert!(place.join("report").join(file).exists(), "{file}");
    }
    let page = fs::read_to_string(place.join("report/report.html")).expect("a page");
    assert!(page.contains("<svg") && page.contains("Energy error"));

    // Again: nothing is worked out anew.
    let section = fs::read(place.join("report/fig2.json")).expect("a section");
    let again = place.call(&fig2("report")).with_code(0);
    assert!(
        again.stderr.contains("fig2: kept from before"),
        "{again:#?}"
    );
    assert_eq!(again.stdout, first.stdout);

    // The report of another size, without --force.
    place
        .call(&["reproduce", "fig2", "--out", "report"])
        .refused(3, &["report", "holds a quick report", "--out", "--force"]);
    assert_eq!(
        fs::read(place.join("report/fig2.json")).expect("a section"),
        section
    );

    // With --force the section is worked out again, from the runs that are there.
    let mut forced = fig2("report");
    forced.push("--force");
    let forced = place.call(&forced).with_code(0);
    assert!(!forced.stderr.contains("kept from before"));
    assert_eq!(forced.stdout, first.stdout);
}

#[test]
fn a_directory_of_other_origin_is_refused_even_with_force() {
    let place = Workplace::new();
    fs::create_dir(place.join("thesis")).expect("a directory");
    fs::write(place.join("thesis/chapter.tex"), "mine").expect("a file");
    for more in [&[][..], &["--force"]] {
        let mut call = fig2("thesis");
        call.extend(more);
        place
            .call(&call)
            .refused(3, &["thesis", "is not the directory of a report"]);
    }
    let entries = fs::read_dir(place.join("thesis")).expect("entries");
    assert_eq!(entries.count(), 1);
}

#[test]
fn unknown_targets_and_presets_are_told_the_nearest_and_all() {
    let place = Workplace::new();
    place.call(&["reproduce", "fig22"]).refused(
        2,
        &["'fig22'", "similar value exists: 'fig2'", "table2", "echo"],
    );
    place
        .call(&["reproduce", "fig2", "--threads", "0"])
        .refused(2, &["--threads"]);
    let call = ["run", "dam-break", "--preset", "accurat"];
    place
        .call(&call)
        .refused(2, &["'accurat'", "similar value exists: 'accurate'"]);
    let entries = fs::read_dir(place.path()).expect("entries");
    assert_eq!(entries.count(), 0, "nothing was begun");
}

#[test]
fn help_lists_every_target_and_the_preset_with_what_it_keeps() {
    let place = Workplace::new();
    let help = place.call(&["reproduce", "--help"]).with_code(0).stdout;
    for name in [
        "all", "fig1", "fig2", "fig3", "fig4", "fig5", "fig6", "table2", "kepler", "claims",
        "echo", "work", "--quick", "--force",
    ] {
        assert!(help.contains(name), "{name}");
    }
    let help = place.call(&["run", "--help"]).with_code(0).stdout;
    for words in ["--preset", "accurate", "1e-4 of the energy released"] {
        assert!(help.contains(words), "{words}");
    }
}

#[test]
fn the_preset_is_a_set_of_overrides_that_later_ones_override() {
    let place = Workplace::new();
    let scene = ["particle_spacing=0.1", "turnaround=0.02"];
    let arguments = |more: &[&'static str]| {
        let mut all = vec!["dam-break", "--preset", "accurate"];
        all.extend(scene.iter().chain(more).flat_map(|&s| ["--set", s]));
        all
    };
    let result = place.run("preset", &arguments(&[]));
    assert_eq!(result["reversed_exactly"], true);
    place.run("overridden", &arguments(&["cfl=0.2"]));
    let line = |run: &str, key: &str| {
        let path = place.join(&format!("{run}/scene.toml"));
        let text = fs::read_to_string(path).expect("a scene");
        let line = text.lines().find(|line| line.starts_with(key));
        let words = line.expect("the key").split_whitespace();
        words.take(3).collect::<Vec<_>>().join(" ")
    };
    for run in ["preset", "overridden"] {
        assert_eq!(line(run, "integrator"), "integrator = \"pefrl\"");
    }
    assert_eq!(line("preset", "cfl"), "cfl = 0.4");
    assert_eq!(line("overridden", "cfl"), "cfl = 0.2");
}

#[cfg(unix)]
#[test]
fn an_interrupted_report_says_how_to_go_on_and_finds_what_an_uninterrupted_one_finds() {
    use crate::program::{end, signal, wait_for_lines};
    let place = Workplace::new();
    let whole = ["reproduce", "fig5", "--quick", "--quiet", "--out", "whole"];
    let whole = place.call(&whole).with_code(0);
    let child = place.start(&["reproduce", "fig5", "--quick", "--out", "broken"]);
    wait_for_lines(&place.join("broken/runs/dam-break"), 300);
    signal(&child, "INT");
    let again = "loschmidt reproduce fig5 --quick --out broken";
    end(child).refused(130, &["interrupted; what is done is kept", again]);
    assert!(!place.join("broken/fig5.json").exists());
    let arguments: Vec<&str> = again.split_whitespace().skip(1).collect();
    let ended = place.call(&arguments).with_code(0);
    assert_eq!(ended.stdout, whole.stdout.replace("whole/", "broken/"));
    for figure in ["fig5.svg", "fig9.svg"] {
        let read = |report: &str| fs::read(place.join(report).join(figure)).expect("a figure");
        assert_eq!(read("broken"), read("whole"));
    }
}

/// The correction of 80,000 particles, which takes half a minute.
#[cfg(unix)]
#[test]
fn a_signal_is_heard_while_nothing_but_a_set_up_is_under_way() {
    use crate::program::{end, signal};
    let place = Workplace::new();
    let child = place.start(&["reproduce", "fig1", "--out", "r"]);
    std::thread::sleep(std::time::Duration::from_secs(3));
    let began = std::time::Instant::now();
    signal(&child, "TERM");
    end(child).refused(130, &["interrupted; what is done is kept"]);
    assert!(began.elapsed() < std::time::Duration::from_secs(10));
    assert!(!place.join("r/fig1.json").exists());
}
