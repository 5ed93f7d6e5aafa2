//! `movie`: pictures, GIF, what is refused, and an interruption.

use crate::program::{Workplace, files_below};
use std::fs;
use std::path::PathBuf;

/// 200 particles, 800 steps out and 800 back.
const SMALL: [&str; 7] = [
    "movie",
    "dam-break",
    "--set",
    "particle_spacing=0.1",
    "--set",
    "turnaround=0.4",
    "--size=320x240",
];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let mut all = SMALL.to_vec();
    all.extend(more);
    all
}

/// A picture in the repository.
fn hourglass() -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let path = path.join("../examples/pictures/hourglass.png");
    path.to_str().expect("UTF-8").to_owned()
}

#[test]
fn what_cannot_be_written_is_told_before_the_first_picture() {
    let place = Workplace::new();
    fs::create_dir(place.join("folder.mp4")).expect("a directory");
    for (more, code, words) in [
        (["--gif=none/x.gif", "--out=frames"], 3, ["none/x.gif"; 2]),
        (["--mp4=none/x.mp4", "--out=frames"], 3, ["none/x.mp4"; 2]),
        (
            ["--mp4=folder.mp4", "--force"],
            2,
            ["folder.mp4", "no file"],
        ),
        (["--gif=/dev/full", "--force"], 2, ["/dev/full", "no file"]),
    ] {
        place.call(&with(&more)).refused(code, &words);
        assert_eq!(files_below(&place.join(".")).len(), 0, "{more:?}");
    }
}

#[test]
fn a_movie_is_pictures_and_a_gif_and_says_what_came_home() {
    let place = Workplace::new();
    let tint = hourglass();
    let movie = [
        "--tint",
        &tint,
        "--compare=float",
        "--seconds=1",
        "--fps=8",
        "--gif=movie.gif",
        "--out=frames",
    ];
    let ended = place.call(&with(&movie)).with_code(0);
    for words in [
        "8 pictures in frames\n",
        "movie.gif, ",
        "simulated ",
        ", drawn ",
        "fixed point came home: every bit",
        "floating point ",
    ] {
        assert!(ended.stdout.contains(words), "no {words:?} in {ended:#?}");
    }
    assert!(
        ended
            .stderr
            .starts_with("8 pictures of 320x240, written to frames\n")
    );
    let names: Vec<_> = files_below(&place.join("frames")).into_keys().collect();
    let mut expected: Vec<_> = (0..8).map(|n| format!("frame-{n:05}.png")).collect();
    expected.splice(0..0, [".lock".to_owned()]);
    expected.push("movie.json".to_owned());
    assert_eq!(
        names,
        expected.iter().map(PathBuf::from).collect::<Vec<_>>()
    );
    let bytes = fs::read(place.join("movie.gif")).expect("a GIF");
    assert!(bytes.starts_with(b"GIF89a"));
    // Once more: nothing to do but the GIF, which is there.
    place
        .call(&with(&movie))
        .refused(3, &["movie.gif exists already"]);
    fs::remove_file(place.join("movie.gif")).expect("removed");
    let again = place.call(&with(&movie)).with_code(0);
    assert!(again.stderr.contains("; 8 are there"), "{again:#?}");
    assert!(bytes == fs::read(place.join("movie.gif")).expect("a GIF"));
}

#[test]
fn a_view_that_cannot_be_is_refused_in_words() {
    let place = Workplace::new();
    for (more, words) in [
        ("--view=0,0,4", ["four numbers in m", "--view"]),
        ("--view=4,0,0,2", ["first below the third", "--view"]),
        ("--view=0,0,inf,2", ["four numbers in m", "--view"]),
        ("--zoom=0", ["from 0.01 to 1000", "--zoom"]),
        ("--zoom=x", ["from 0.01 to 1000", "--zoom"]),
        ("--orbit", ["in the plane", "--orbit"]),
    ] {
        place.call(&with(&[more])).refused(2, &words);
    }
    let both = ["--view", "-1,-1,1,1", "--zoom=2"];
    place
        .call(&with(&both))
        .refused(2, &["cannot be used with"]);
    let space = ["movie", "dam-break-3d", "--view=0,0,1,1"];
    place.call(&space).refused(2, &["--view", "in space"]);
    assert_eq!(files_below(&place.join(".")).len(), 0);
}

#[test]
fn a_view_that_was_asked_for_is_another_picture() {
    let place = Workplace::new();
    let first = |more: &[&str]| {
        let short = [
            &["--seconds=0.1", "--quiet", "--force", "--out=frames"],
            more,
        ]
        .concat();
        place.call(&with(&short)).with_code(0);
        fs::read(place.join("frames/frame-00000.png")).expect("a picture")
    };
    let whole = first(&[]);
    let views = [first(&["--view=-1,-1,1,1"]), first(&["--zoom=2"])];
    assert!(views.iter().all(|view| *view != whole) && views[0] != views[1]);
}

#[test]
fn quiet_is_quiet() {
    let place = Workplace::new();
    let ended = place
        .call(&with(&["--seconds=0.2", "--quiet"]))
        .with_code(0);
    assert_eq!(ended.stderr, "");
    let expected = "6 pictures in movies/dam-break-1\n\
                    fixed point came home: every bit of the last state equals the first\n";
    assert_eq!(ended.stdout, expected);
}

#[test]
fn a_finished_run_gives_as_many_pictures_as_it_has_frames() {
    let place = Workplace::new();
    place.run(
        "run",
        &[&SMALL[1..6], &["--set", "output.frames=8"]].concat(),
    );
    let ended = place.call(&["movie", "run", "--out=frames"]).with_code(0);
    assert!(
        ended.stdout.starts_with("9 pictures in frames\nread "),
        "{ended:#?}"
    );
    let longer = place.call(&["movie", "run", "--seconds=12"]);
    longer.refused(
        2,
        &[
            "stored 9 frames",
            "360 pictures",
            "--seconds 0.3",
            "run/scene.toml",
        ],
    );
    let compared = place.call(&["movie", "run", "--compare=float"]);
    compared.refused(2, &["--compare needs a simulation", "run/scene.toml"]);
    assert!(!place.join("movies").exists());
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let place = Workplace::new();
    fs::write(place.join("text.png"), "no picture").expect("a file");
    for (arguments, words) in [
        (&["--fps=0"][..], &["--fps", "1..=100"][..]),
        (&["--seconds=-1"], &["--seconds", "at most 3600 s"]),
        (&["--seconds=0.01"], &["0 pictures", "2 to 100000"]),
        (&["--color=speeed"], &["speed", "initial-height"]),
        (&["--tint=none.png"], &["none.png cannot be read"]),
        (&["--tint=text.png"], &["text.png cannot be read"]),
        (
            &["--tint=text.png", "--color=speed"],
            &["cannot be used with"],
        ),
        (
            &["--set=particle_spacin=1"],
            &["did you mean `particle_spacing`?"],
        ),
    ] {
        place.call(&with(arguments)).refused(2, words);
    }
    for size in ["--size=12", "--size=64x9999", "--size=-64x64", "--size=axb"] {
        place
            .call(&["movie", "dam-break", size])
            .refused(2, &["--size", "such as 1280x720", "64 to 7680 pixels"]);
    }
    place
        .call(&["movie", "dam-brake"])
        .refused(2, &["did you mean `dam-break`?"]);
    assert!(!place.join("movies").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupted_movie_goes_on_with_the_command_it_prints() {
    use crate::program::{end, signal, wait_for};
    let place = Workplace::new();
    let whole = with(&["--seconds=3", "--out=whole", "--quiet"]);
    place.call(&whole).with_code(0);
    let child = place.start(&with(&["--seconds=3", "--quiet"]));
    let out = place.join("movies/dam-break-1");
    wait_for("picture", || out.join("frame-00020.png").is_file());
    signal(&child, "INT");
    let ended = end(child).refused(130, &["interrupted after ", "; go on with\n"]);
    let command = ended.stderr.lines().last().expect("a line").trim();
    let words: Vec<&str> = command.split(' ').skip(1).collect();
    assert_eq!(
        words,
        with(&["--seconds=3", "--quiet", "--out", "movies/dam-break-1"])
    );
    place.call(&words).with_code(0);
    assert!(files_below(&place.join("whole")) == files_below(&out));
}

#[cfg(unix)]
#[test]
fn a_broken_picture_of_an_interrupted_movie_is_drawn_anew() {
    use crate::program::{end, signal, wait_for};
    let place = Workplace::new();
    place
        .call(&with(&["--seconds=2", "--out=whole", "--quiet"]))
        .with_code(0);
    let again = with(&["--seconds=2", "--out=broken"]);
    let child = place.start(&again);
    wait_for("picture", || place.join("broken/frame-00020.png").is_file());
    signal(&child, "INT");
    end(child).with_code(130);
    let picture = place.join("broken/frame-00007.png");
    let bytes = fs::read(&picture).expect("a picture");
    fs::write(&picture, &bytes[..bytes.len() / 2]).expect("a file");
    let ended = place.call(&again).with_code(0);
    assert!(ended.stderr.contains("; 7 are there\n"), "{ended:#?}");
    assert!(files_below(&place.join("whole")) == files_below(&place.join("broken")));
}

#[cfg(unix)]
#[test]
fn a_movie_of_a_run_at_work_says_so() {
    use crate::program::{end, signal, wait_for_lines};
    let place = Workplace::new();
    let child = place.start(&["run", "dam-break", "--set=particle_spacing=0.04", "--out=a"]);
    wait_for_lines(&place.join("a"), 20);
    place.call(&["movie", "a"]).refused(
        2,
        &["the run in a is at work at this moment", "of 10000 steps"],
    );
    signal(&child, "KILL");
    end(child);
    place
        .call(&["movie", "a"])
        .refused(2, &["has not finished", "loschmidt resume a"]);
}
