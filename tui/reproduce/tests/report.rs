//! A reduced report: targets hold, go on after an interruption, and make pages that stand alone.

use loschmidt_reproduce::reference::{at, distance, koshizuka_oka, violeau};
use loschmidt_reproduce::{Lab, LabError, Section, Target, report};
use loschmidt_runner::Options;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

fn lab<'a>(dir: &Path, stop: &'a AtomicBool, force: bool) -> Result<Lab<'a>, LabError> {
    Lab::open(dir, true, force, Options::default(), stop, |_| {})
}

/// Every element that is opened is closed.
fn assert_well_formed(text: &str) {
    let mut reader = quick_xml::Reader::from_str(text);
    loop {
        match reader.read_event() {
            Ok(quick_xml::events::Event::Eof) => break,
            Ok(_) => {}
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn the_published_curves_are_those_of_their_sources() {
    let (experiment, violeau) = (koshizuka_oka(), violeau());
    assert_eq!((experiment.len(), violeau.len()), (13, 16));
    // Both start with a column one wide and end near four.
    for curve in [&experiment, &violeau] {
        assert!(curve[0][1] < 1.2 && curve[curve.len() - 1][1] > 3.6);
        assert!(
            curve
                .windows(2)
                .all(|p| p[0][0] < p[1][0] && p[0][1] < p[1][1])
        );
    }
    // The simulation runs ahead of the experiment.
    let (rms, mean) = distance(&violeau, &experiment);
    assert!((rms - 0.21).abs() < 0.005, "{rms}");
    assert!(mean > 0.0);
}

#[test]
fn between_points_a_curve_is_straight_and_beyond_them_it_is_not_there() {
    let curve = [[0.0, 1.0], [1.0, 3.0], [2.0, 2.0]];
    assert_eq!(at(&curve, 0.25), Some(1.5));
    assert_eq!(at(&curve, 2.0), Some(2.0));
    assert_eq!(at(&curve, 2.5), None);
    let shifted = curve.map(|p| [p[0], p[1] + 0.5]);
    assert_eq!(distance(&shifted, &curve), (0.5, 0.5));
}

#[test]
fn a_quick_report_holds_and_its_pages_stand_alone() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("report");
    let stop = AtomicBool::new(false);
    let mut lab = lab(&out, &stop, false).expect("a lab");
    let targets = [Target::Fig2, Target::Fig5, Target::Fig6];
    let mut sections = Vec::new();
    for target in targets {
        let section = target.reproduce(&mut lab).expect("it works");
        assert!(section.holds(), "{section:?}");
        for figure in &section.figures {
            assert_well_formed(&fs::read_to_string(out.join(&figure.file)).expect("a figure"));
        }
        sections.push(section);
    }
    report::write(&lab, &sections).expect("pages");
    let html = fs::read_to_string(out.join("report.html")).expect("a page");
    for section in &sections {
        assert!(html.contains(&section.title.replace('&', "&amp;")));
    }
    let figures: usize = sections.iter().map(|s| s.figures.len()).sum();
    assert_eq!(html.matches("<svg").count(), figures);
    // Nothing is fetched from elsewhere.
    for fetch in ["src=", "href=", "@import", "url("] {
        assert!(!html.contains(fetch), "{fetch}");
    }
    let markdown = fs::read_to_string(out.join("report.md")).expect("a page");
    assert_eq!(markdown.matches("![").count(), figures);

    // A second call takes everything from the first.
    let before = fs::read_to_string(out.join("runs/dam-break/manifest.json")).expect("a run");
    for (target, section) in targets.iter().zip(&sections) {
        assert_eq!(target.reproduce(&mut lab).expect("it works"), *section);
    }
    let after = fs::read_to_string(out.join("runs/dam-break/manifest.json")).expect("a run");
    assert_eq!(before, after);
}

#[test]
fn an_interrupted_report_goes_on_and_finds_the_same() {
    let dir = tempfile::tempdir().expect("a directory");
    let (whole, broken) = (dir.path().join("whole"), dir.path().join("broken"));
    let stop = AtomicBool::new(false);
    let mut first = lab(&whole, &stop, false).expect("a lab");
    let expected = Target::Fig6.reproduce(&mut first).expect("it works");

    let halt = AtomicBool::new(false);
    let interrupted = {
        let halt = &halt;
        let mut lab = Lab::open(&broken, true, false, Options::default(), halt, |news| {
            if let loschmidt_reproduce::News::Progress { done, total, .. } = news
                && 3 * done > total
            {
                halt.store(true, Ordering::Relaxed);
            }
        })
        .expect("a lab");
        Target::Fig6.reproduce(&mut lab)
    };
    assert!(matches!(interrupted, Err(LabError::Interrupted)));
    let mut lab = lab(&broken, &stop, false).expect("the same lab");
    let section = Target::Fig6.reproduce(&mut lab).expect("it goes on");
    assert_eq!(section.findings, expected.findings);
}

#[test]
fn a_directory_of_other_origin_is_left_alone() {
    let dir = tempfile::tempdir().expect("a directory");
    let stop = AtomicBool::new(false);
    fs::write(dir.path().join("thesis.tex"), "mine").expect("a file");
    for force in [false, true] {
        let refused = lab(dir.path(), &stop, force);
        assert!(matches!(refused, Err(LabError::Occupied { .. })));
    }
    assert_eq!(fs::read_dir(dir.path()).expect("entries").count(), 1);
}

#[test]
fn with_force_sections_are_made_anew_and_other_files_stay() {
    let dir = tempfile::tempdir().expect("a directory");
    let stop = AtomicBool::new(false);
    let section = Section {
        target: "fig6".to_owned(),
        ..Section::default()
    };
    let first = lab(dir.path(), &stop, false).expect("a lab");
    first.keep(&section).expect("a section");
    fs::write(dir.path().join("notes.json"), "{}").expect("a file");
    let again = lab(dir.path(), &stop, false).expect("the same lab");
    assert_eq!(again.kept("fig6"), Some(section));
    let anew = lab(dir.path(), &stop, true).expect("the lab again");
    assert_eq!(anew.kept("fig6"), None);
    assert!(dir.path().join("notes.json").exists());
}
