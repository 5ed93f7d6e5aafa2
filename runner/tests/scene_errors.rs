//! Every broken scene gives its expected message, whole and to the letter.

use std::fs;
use std::path::{Path, PathBuf};

use loschmidt_runner::scene::{ProblemKind, SceneError, Source, load, resolve};

fn broken_scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/broken-scenes");
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder of broken scenes exists")
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    paths.sort();
    paths
}

/// The message of a scene that must fail, with the file shown by its name alone.
fn message(path: &Path) -> String {
    let outcome = load(&Source::Path(path.to_owned()), &[]).and_then(|scene| scene.initial_state());
    let error = outcome.err().map(|error| error.to_string());
    let message = error.unwrap_or_else(|| panic!("{} is not broken", path.display()));
    let name = path.file_name().expect("a file").to_string_lossy();
    message.replace(&*path.to_string_lossy(), &name) + "\n"
}

/// `UPDATE_EXPECTED=1` rewrites the messages; read the difference before committing it.
#[test]
fn every_broken_scene_gives_its_expected_message() {
    let update = std::env::var_os("UPDATE_EXPECTED").is_some();
    let scenes = broken_scenes();
    assert!(scenes.len() >= 20, "only {} broken scenes", scenes.len());
    let mut failures = Vec::new();
    for path in scenes {
        let expected_path = path.with_extension("txt");
        let found = message(&path);
        if update {
            fs::write(&expected_path, &found).expect("a writable folder");
        }
        // A checkout may have turned the ends of lines.
        let expected = fs::read_to_string(&expected_path).map(|text| text.replace("\r\n", "\n"));
        match expected {
            Ok(expected) if expected == found => {}
            Ok(expected) => failures.push(format!("--- expected\n{expected}--- found\n{found}")),
            Err(error) => failures.push(format!("{}: {error}", expected_path.display())),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

const DROP: &str = r#"
particle_spacing = 0.1
turnaround = 1.0
fluid.sound_speed = 10.0
[[region]]
kind = "fluid"
shape.circle = { centre = [0.0, 0.0], radius = 0.5 }
"#;

fn refusal(text: &str, overrides: &[&str]) -> SceneError {
    let source = Source::Text {
        name: "drop.toml".to_owned(),
        text: text.to_owned(),
    };
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    load(&source, &overrides).expect_err("the scene is broken")
}

#[test]
fn a_mistake_in_an_override_is_shown_in_the_override() {
    let cases = [
        (
            "fluid.sound_sped=60",
            "error: unknown key `sound_sped` in `[fluid]`\n --> --set\n  |\n  | fluid.sound_sped=60\n  |       ^^^^^^^^^^\nhelp: did you mean `sound_speed`?",
        ),
        (
            "particle_spacing = -1",
            "error: `particle_spacing` is out of range: -1.0 m\n --> --set\n  |\n  | particle_spacing = -1\n  |                    ^^\nhelp: allowed: greater than 0 m",
        ),
        (
            "region.3.kind=wall",
            "error: `region` has no element `3`\n --> --set\n  |\n  | region.3.kind=wall\n  |        ^\nhelp: `region` has 1 element, number 0",
        ),
        (
            "region[0].shape.circle.radius=[1",
            "error: unclosed array\n --> --set\n  |\n  | region[0].shape.circle.radius=[1\n  |                                 ^\nhelp: expected `]`",
        ),
        (
            "model=standart",
            "error: `model` cannot be \"standart\"\n --> --set\n  |\n  | model=standart\n  |       ^^^^^^^^\nhelp: did you mean \"standard\"?\nhelp: allowed: \"symplectic\", \"standard\", \"filtered\", \"solid\", \"solid-midpoint\", \"viscous\", \"superfluid\", \"superfluid-dissipative\" or \"superfluid-paper\"",
        ),
        (
            "particle_spacing.x=1",
            "error: `particle_spacing` is a number, it has no parts\n",
        ),
        (
            "turnarond=",
            "error: unknown key `turnarond`\n --> --set\n  |\n  | turnarond=\n  | ^^^^^^^^^\nhelp: did you mean `turnaround`?",
        ),
        (
            "cfl 0.1",
            "error: an override needs an equals sign\n --> --set\n  |\n  | cfl 0.1\n  | ^^^^^^^\nhelp: write `path=value`, for instance `--set fluid.sound_speed=60`",
        ),
        (
            "fluid..sound_speed=1",
            "error: this is not a path\n --> --set\n  |\n  | fluid..sound_speed=1\n",
        ),
        ("cfl=0.1\nsupport=2", "error: an override sets one key\n"),
    ];
    for (text, expected) in cases {
        let found = refusal(DROP, &[text]).to_string();
        assert!(
            found.starts_with(expected),
            "{text}:\n{found}\n\n{expected}"
        );
    }
}

#[test]
fn every_mistake_is_reported_in_the_order_of_the_text() {
    let text = DROP
        .replace("0.1", "-0.1")
        .replace("1.0", "true")
        .replace("0.5", "0");
    let SceneError::Invalid(problems) = refusal(&text, &["cfl=9", "support=0"]) else {
        panic!("not a list of problems");
    };
    let kinds: Vec<_> = problems
        .iter()
        .map(|problem| {
            let line = problem.place.line.as_ref().and_then(|line| line.number);
            (problem.kind, line)
        })
        .collect();
    use ProblemKind::{OutOfRange, WrongType};
    assert_eq!(
        kinds,
        [
            (OutOfRange, Some(2)),
            (WrongType, Some(3)),
            (OutOfRange, Some(7)),
            (OutOfRange, None),
            (OutOfRange, None),
        ]
    );
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = std::env::temp_dir().join(format!("loschmidt-scene-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a temporary folder");
    let latin = folder.join("latin.toml");
    fs::write(&latin, b"particle_spacing = 0.1\nname = \"gr\xfcn\"\n").expect("a file");
    let cases = [
        (folder.join("none.toml"), "does not exist"),
        (folder.clone(), "is a folder"),
        (latin, "line 2"),
    ];
    for (path, reason) in &cases {
        let error = load(&Source::Path(path.clone()), &[]).expect_err("no scene");
        let message = error.to_string();
        assert!(message.starts_with("error: "), "{message}");
        assert!(message.contains(&*path.to_string_lossy()), "{message}");
        assert!(message.contains(reason), "{message}");
    }
    fs::remove_dir_all(&folder).expect("the folder is ours");
}

#[test]
fn an_unknown_name_is_answered_with_the_nearest_one() {
    let error = resolve("dam-brake").expect_err("no such scene");
    assert_eq!(
        error.to_string(),
        "error: no scene is called `dam-brake`\nhelp: did you mean `dam-break`?\nhelp: the scenes are `dam-break`, `dam-break-3d`, `colliding-drops`, `rotating-drop`, `gresho-vortex`, `kepler-ring`, `beryllium-plate`, `twisting-column`, `colliding-rings`, `cantilever`, `taylor-couette`, `lid-driven-cavity`, `second-sound`, `second-sound-steep`, \
         `counterflow`, `normal-cavity` and `fountain`; a file is given by its path"
    );
    assert_eq!(
        resolve("dam-break").expect("a scene of the catalogue"),
        Source::Catalogue("dam-break".to_owned())
    );
    assert_eq!(
        resolve("mine.toml").expect("a path"),
        Source::Path("mine.toml".into())
    );
}

#[test]
fn nesting_without_end_is_refused_and_not_followed() {
    let deep = 100_000;
    let texts = [
        format!("{}=1", vec!["a"; deep].join(".")),
        format!("a = {}", "[".repeat(deep)),
        format!("[{}]", vec!["a"; deep].join(".")),
        format!("shape = {}", "{ union = [".repeat(deep)),
    ];
    for text in &texts {
        let shown: String = text.chars().take(20).collect();
        let error = refusal(text, &[]);
        assert!(matches!(error, SceneError::Invalid(_)), "{shown}");
        let error = refusal(DROP, &[text.as_str()]);
        assert!(matches!(error, SceneError::Invalid(_)), "{shown}");
    }
}

/// The whole message is read: the text of a hundred thousand mistakes took half a minute.
#[test]
fn of_very_many_mistakes_the_first_twenty_are_told() {
    const MANY: usize = 100_000;
    let lines: String = (0..MANY).map(|n| format!("foo{n} = {n}\n")).collect();
    let regions = "[[region]]\nkind = \"flud\"\n".repeat(MANY);
    let member = "{ circle = { centre = [0, 0], radius = \"a\" } }, ";
    let union = format!("shape.union = [{}]\n", member.repeat(MANY));
    let head = "particle_spacing = 0.1\nturnaround = 1.0\nfluid.sound_speed = 10.0\n";
    for (rest, first) in [
        (lines, "unknown key `foo0`\n --> scene.toml:4:1\n"),
        (regions, "`kind` cannot be \"flud\"\n --> scene.toml:5:8\n"),
        (
            format!("[[region]]\nkind = \"fluid\"\n{union}"),
            "`radius`: expected a number in m, found a string\n --> scene.toml:6:55\n",
        ),
    ] {
        let source = Source::Text {
            name: "scene.toml".to_owned(),
            text: format!("{head}{rest}"),
        };
        let message = load(&source, &[]).expect_err("mistakes").to_string();
        assert!(message.starts_with(&format!("error: {first}")), "{message}");
        assert_eq!(message.matches("error: ").count(), 20, "{message}");
        assert!(message.ends_with("\n\nand more: the first 20 mistakes are told"));
        assert!(message.lines().all(|line| line.chars().count() < 1000));
    }
}

#[test]
fn a_text_longer_than_any_scene_is_not_read() {
    let path = std::env::temp_dir().join(format!("loschmidt-long-{}.toml", std::process::id()));
    let file = fs::File::create(&path).expect("a file");
    // A hole: nothing is written.
    file.set_len(1 << 40).expect("a long file");
    let error = load(&Source::Path(path.clone()), &[]).expect_err("too long");
    fs::remove_file(&path).expect("removed");
    let message = error.to_string();
    assert!(message.contains("is longer than 16 MiB"), "{message}");
}

/// A hundred thousand regions took minutes.
#[test]
fn a_scene_of_very_many_regions_is_read() {
    const MANY: usize = 100_000;
    let region = |n: usize| {
        let (x, end) = (0.2 * n as f64, 0.2 * (n + 1) as f64);
        format!(
            "[[region]]\nkind = \"fluid\"\n\
             shape.rectangle = {{ min = [{x:.1}, 0.0], max = [{end:.1}, 1.0] }}\n"
        )
    };
    let head = "particle_spacing = 0.1\nturnaround = 1.0\nfluid.sound_speed = 10.0\n";
    let regions: String = (0..MANY).map(region).collect();
    let source = Source::Text {
        name: "scene.toml".to_owned(),
        text: format!("{head}{regions}"),
    };
    let scene = load(&source, &[]).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene.regions.len(), MANY);
    assert!(scene.time_step() > 0.0);
}
