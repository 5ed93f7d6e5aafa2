//! The movie of a reversal, on small scenes.

use loschmidt_runner::run::Run;
use loschmidt_runner::scene::{Scene, Source, load, resolve};
use loschmidt_runner::{ArithmeticKind, Frame, Options, Plan, Player};
use loschmidt_viewer::draw::PictureLayout;
use loschmidt_viewer::movie::{
    Ending, Movie, MovieError, MovieStyle, Schedule, Stored, gif, picture_name,
};
use loschmidt_viewer::{Home, Look, Picture, Raster, Rect, Rgb, Theme, picture};
use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use tempfile::TempDir;

const SIZE: (usize, usize) = (320, 180);

fn scene(set: &[&str]) -> Scene {
    let set: Vec<String> = set.iter().map(|&text| text.to_owned()).collect();
    load(&resolve("dam-break").expect("a scene"), &set).expect("a scene")
}

/// 200 particles, 1000 steps out and 1000 back.
fn small() -> Scene {
    scene(&["particle_spacing=0.1", "turnaround=0.5"])
}

fn player(scene: &Scene, arithmetic: ArithmeticKind) -> Player {
    let initial = scene.initial_state().expect("particles");
    let options = Options {
        arithmetic,
        ..Options::default()
    };
    Player::new(scene.clone(), initial, options).expect("a player")
}

fn style(pictures: usize) -> MovieStyle {
    MovieStyle {
        size: SIZE,
        fps: 7,
        pictures,
        ..MovieStyle::default()
    }
}

fn create(path: &Path, force: bool, style: MovieStyle) -> Result<Movie, MovieError> {
    Movie::create(path, force, style, "dam-break", "a run")
}

fn simulate(movie: &mut Movie, scene: &Scene) -> Result<Ending, MovieError> {
    let players = vec![player(scene, ArithmeticKind::Fixed)];
    movie.simulate(players, |_| {}, &AtomicBool::new(false))
}

/// The same, interrupted after some pictures.
fn interrupt(movie: &mut Movie, scene: &Scene, pictures: usize) {
    let stop = AtomicBool::new(false);
    let players = vec![player(scene, ArithmeticKind::Fixed)];
    let result = movie.simulate(
        players,
        |progress| {
            if progress.done == pictures {
                stop.store(true, Ordering::Relaxed);
            }
        },
        &stop,
    );
    match result {
        Err(MovieError::Interrupted { done, .. }) => assert_eq!(done, pictures),
        other => panic!("{other:?}"),
    }
}

fn picture(path: &Path, n: usize) -> Raster {
    let file = File::open(path.join(picture_name(n))).expect("a picture");
    picture::read(BufReader::new(file), Rgb(0)).expect("a PNG")
}

fn home(scene: &Scene) -> (Home, Frame) {
    let frame = player(scene, ArithmeticKind::Fixed).frame();
    let frame = frame.expect("a frame");
    (Home::new(scene, &frame), frame)
}

fn fields(scene: &Scene, panes: usize) -> Vec<Rect> {
    PictureLayout::new(&home(scene).0, &Look::default(), panes, SIZE.0, SIZE.1).fields
}

/// A picture without two equal pixels.
fn motley() -> Picture {
    let mut raster = Raster::new(40, 80, Rgb(0));
    for (n, pixel) in raster.pixels_mut().iter_mut().enumerate() {
        *pixel = (n as u32).wrapping_mul(2_654_435_761) & 0xff_ffff;
    }
    Picture::new(raster)
}

#[test]
fn fixed_point_brings_the_picture_home_and_floating_point_does_not() {
    let place = TempDir::new().expect("a directory");
    let scene = scene(&["particle_spacing=0.05"]);
    let style = MovieStyle {
        tint: Some(motley()),
        ..style(5)
    };
    let mut movie = create(place.path(), false, style).expect("a movie");
    let players = [ArithmeticKind::Fixed, ArithmeticKind::Float];
    let players = players.map(|arithmetic| player(&scene, arithmetic));
    let ending = movie.simulate(players.into(), |_| {}, &AtomicBool::new(false));
    let ending = ending.expect("an end");
    let exact: Vec<bool> = ending
        .iter()
        .map(|fate| fate.home.expect("it was to come home").is_exact())
        .collect();
    assert_eq!(exact, [true, false]);
    let [first, middle, last] = [0, 2, 4].map(|n| picture(place.path(), n));
    let [left, right] = fields(&scene, 2)[..] else {
        panic!("two fields")
    };
    assert!(first.part(left) == last.part(left));
    assert!(first.part(left) != middle.part(left));
    // What differs on the right is not a speck: the fluid covers a fifth of the field.
    let (before, after) = (first.part(right), last.part(right));
    let pairs = before.pixels().iter().zip(after.pixels());
    let differ = pairs.filter(|(a, b)| a != b).count();
    assert!(20 * differ > right.width * right.height, "{differ} pixels");
}

#[test]
fn pictures_are_evenly_paced_and_mirrored_in_the_turnaround() {
    let scene = small();
    let plan = Plan::of(&scene);
    assert_eq!((plan.out, plan.total()), (1000, 2000));
    for pictures in [2, 3, 7, 180, 5000] {
        let schedule = Schedule::new(&plan, pictures);
        let steps: Vec<u64> = (0..pictures).map(|n| schedule.step(n)).collect();
        assert_eq!((steps[0], steps[pictures - 1]), (0, 2000));
        let paces = steps.windows(2).map(|pair| pair[1] - pair[0]);
        let (slowest, fastest) = (paces.clone().min(), paces.max());
        assert!(fastest.zip(slowest).is_some_and(|(f, s)| f <= s + 1));
        for (there, back) in steps.iter().zip(steps.iter().rev()) {
            assert_eq!(plan.position(*there), plan.position(*back));
        }
    }
}

#[test]
fn the_arrow_turns_once_and_points_backward_at_the_end() {
    let schedule = Schedule::new(&Plan::of(&small()), 181);
    let turn = |n| schedule.turn(n, 30).expect("a turn");
    assert_eq!((turn(0), turn(90), turn(180)), (0.0, 0.5, 1.0));
    assert!((1..181).all(|n| turn(n) >= turn(n - 1)));
    let one_way = Plan::of(&scene(&["turnaround=", "end=0.1"]));
    assert_eq!(Schedule::new(&one_way, 181).turn(90, 30), None);
}

#[test]
fn an_interrupted_export_goes_on_to_the_same_pictures() {
    let place = TempDir::new().expect("a directory");
    let (whole, broken) = (place.path().join("whole"), place.path().join("broken"));
    let scene = small();
    let mut movie = create(&whole, false, style(9)).expect("a movie");
    simulate(&mut movie, &scene).expect("an end");
    // On the way out, on the way back, and without the state that was kept.
    for (pictures, keep) in [(3, true), (6, true), (7, false)] {
        let mut movie = create(&broken, false, style(9)).expect("a movie");
        interrupt(&mut movie, &scene, pictures);
        drop(movie);
        let state = broken.join("state-0.snapshot");
        assert!(state.is_file());
        if !keep {
            fs::remove_file(state).expect("removed");
        }
        let before = fs::metadata(broken.join(picture_name(1))).expect("a picture");
        let mut movie = create(&broken, false, style(9)).expect("the same movie");
        assert_eq!(movie.found(), pictures);
        interrupt(&mut movie, &scene, pictures + 1);
        drop(movie);
        let after = fs::metadata(broken.join(picture_name(1))).expect("a picture");
        assert_eq!(before.modified().ok(), after.modified().ok());
    }
    let mut movie = create(&broken, false, style(9)).expect("the same movie");
    let ending = simulate(&mut movie, &scene).expect("an end");
    assert!(ending[0].home.is_some_and(|home| home.is_exact()));
    drop(movie);
    let files = |path: &Path| {
        let mut names: Vec<_> = fs::read_dir(path)
            .expect("a directory")
            .map(|entry| entry.expect("an entry").file_name())
            .collect();
        names.sort();
        names
    };
    assert_eq!(files(&whole), files(&broken));
    for name in files(&whole) {
        let bytes = |path: &Path| fs::read(path.join(&name)).expect("a file");
        assert!(bytes(&whole) == bytes(&broken), "{name:?}");
    }
}

#[test]
fn a_directory_that_holds_something_else_is_refused() {
    let place = TempDir::new().expect("a directory");
    let path = place.path().join("movie");
    fs::create_dir(&path).expect("a directory");
    fs::write(path.join("notes.txt"), "mine").expect("a file");
    let refused = create(&path, false, style(3)).err();
    assert!(matches!(refused, Some(MovieError::Foreign(_))));
    let scene = small();
    let mut movie = create(&path, true, style(3)).expect("a movie between the files");
    let second = create(&path, true, style(3)).err();
    assert!(matches!(second, Some(MovieError::InUse(_))));
    simulate(&mut movie, &scene).expect("an end");
    drop(movie);
    let other = create(&path, false, style(2)).err();
    assert!(matches!(other, Some(MovieError::OtherMovie(_))));
    assert!(create(&path, false, style(3)).expect("there").is_finished());
    let shorter = create(&path, true, style(2)).expect("replaced");
    assert_eq!((shorter.found(), shorter.is_finished()), (0, false));
    assert!(!path.join(picture_name(0)).exists());
    assert!(path.join("notes.txt").is_file());
}

#[test]
fn a_finished_run_is_drawn_from_its_frames() {
    let place = TempDir::new().expect("a directory");
    let (run, drawn, simulated) = (
        place.path().join("run"),
        place.path().join("drawn"),
        place.path().join("simulated"),
    );
    let scene = scene(&["particle_spacing=0.1", "turnaround=0.5", "output.frames=8"]);
    let mut running = Run::start(scene.clone(), Options::default(), Some((&run, false)));
    let running = running.as_mut().expect("a run");
    assert!(matches!(
        Stored::open(&run).err(),
        Some(MovieError::AtWork { .. })
    ));
    running
        .execute(|_| {}, &AtomicBool::new(false))
        .expect("an end");
    let stored = Stored::open(&run).expect("a run");
    assert_eq!(stored.frames(), 9);
    let mut movie = create(&drawn, false, style(9)).expect("a movie");
    let never = AtomicBool::new(false);
    movie.render(&stored, |_| {}, &never).expect("an end");
    let mut movie = create(&simulated, false, style(9)).expect("a movie");
    simulate(&mut movie, &scene).expect("an end");
    let field = fields(&scene, 1)[0];
    for n in 0..9 {
        let [a, b] = [&drawn, &simulated].map(|path| picture(path, n).part(field));
        assert!(a == b, "picture {n}");
    }
    let mut longer = create(&place.path().join("longer"), false, style(10)).expect("a movie");
    let refused = longer.render(&stored, |_| {}, &never).expect_err("refused");
    assert!(matches!(
        refused,
        MovieError::FewFrames {
            stored: 9,
            wanted: 10,
            ..
        }
    ));
}

/// A drop that falls three times its width.
fn falling(place: &Path) -> Scene {
    let path = place.join("drop.toml");
    let text = "particle_spacing = 0.1\nturnaround = 0.78\nfluid.sound_speed = 20.0\n\
                gravity.uniform = [0.0, -9.8]\noutput = { rows = 8, frames = 8, snapshots = 1 }\n\
                region = [{ kind = \"fluid\", shape.circle = { centre = [0.0, 3.0], radius = 0.5 } }]\n";
    fs::write(&path, text).expect("a file");
    load(&Source::Path(path), &[]).expect("a scene")
}

/// Pixels of the field that show fluid.
fn covered(picture: &Raster, field: Rect) -> usize {
    let field = picture.part(field);
    let ground = Theme::DARK.background.0;
    let pixels = field.pixels().iter();
    pixels.filter(|&&pixel| pixel != ground).count()
}

#[test]
fn a_drop_that_falls_stays_in_the_picture() {
    let place = TempDir::new().expect("a directory");
    let [run, drawn, simulated, broken] =
        ["run", "drawn", "simulated", "broken"].map(|name| place.path().join(name));
    let scene = falling(place.path());
    let mut running = Run::start(scene.clone(), Options::default(), Some((&run, false)));
    let running = running.as_mut().expect("a run");
    let never = AtomicBool::new(false);
    running.execute(|_| {}, &never).expect("an end");
    let stored = Stored::open(&run).expect("a run");
    let tall = || MovieStyle {
        look: Look {
            panel: false,
            ..Look::default()
        },
        size: (160, 400),
        ..style(9)
    };
    let whole = Rect::new(0, 0, 160, 400);
    // Frames that are there are all shown by the same camera.
    let mut movie = create(&drawn, false, tall()).expect("a movie");
    movie.render(&stored, |_| {}, &never).expect("an end");
    let seen: Vec<usize> = (0..9)
        .map(|n| covered(&picture(&drawn, n), whole))
        .collect();
    for n in [2, 4, 7, 8] {
        assert!(seen[n].abs_diff(seen[0]) < seen[0] / 10, "{seen:?}");
    }
    // Where they are not there yet, the camera follows, and comes back.
    let mut movie = create(&simulated, false, tall()).expect("a movie");
    simulate(&mut movie, &scene).expect("an end");
    let views = |path: &Path| [0, 4, 8].map(|n| picture(path, n));
    let [first, middle, last] = views(&simulated);
    assert!(first == last);
    let [near, far] = [&first, &middle].map(|picture| covered(picture, whole));
    assert!(far < near && far > seen[4] / 2, "{near} {far} {seen:?}");
    let mut movie = create(&broken, false, tall()).expect("a movie");
    interrupt(&mut movie, &scene, 4);
    drop(movie);
    let mut movie = create(&broken, false, tall()).expect("the same movie");
    simulate(&mut movie, &scene).expect("an end");
    assert!(views(&broken) == [first, middle, last]);
}

#[test]
fn a_gif_shows_the_pictures_in_their_time() {
    let place = TempDir::new().expect("a directory");
    let scene = small();
    let path = place.path().join("frames");
    let mut movie = create(&path, false, style(9)).expect("a movie");
    simulate(&mut movie, &scene).expect("an end");
    let file = place.path().join("movie.gif");
    gif::write(&movie, &file, false).expect("a GIF");
    let again = gif::write(&movie, &file, false).err();
    assert!(matches!(again, Some(MovieError::Exists(_))));

    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options
        .read_info(BufReader::new(File::open(&file).expect("a file")))
        .expect("a GIF");
    let mut shown = Raster::new(SIZE.0, SIZE.1, Rgb(0));
    let (mut n, mut time) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        let (pixels, _) = frame.buffer.as_chunks::<4>();
        for (k, &[r, g, b, alpha]) in pixels.iter().enumerate() {
            let (x, y) = (k % frame.width as usize, k / frame.width as usize);
            let (x, y) = (x + frame.left as usize, y + frame.top as usize);
            if alpha > 0 {
                shown.pixels_mut()[y * SIZE.0 + x] = Rgb::of([r, g, b]).0;
            }
        }
        let expected = picture(&path, n);
        let far = |(a, b): (&u32, &u32)| {
            let (a, b) = (Rgb(*a).channels(), Rgb(*b).channels());
            (0..3).any(|c| a[c].abs_diff(b[c]) > 48)
        };
        let pairs = shown.pixels().iter().zip(expected.pixels());
        let wrong = pairs.clone().filter(|&pair| far(pair)).count();
        // 256 colours are not all: one pixel in a thousand may be far off.
        assert!(wrong <= SIZE.0 * SIZE.1 / 1000, "{wrong} in picture {n}");
        let equal = pairs.filter(|(a, b)| a == b).count();
        assert!(equal > SIZE.0 * SIZE.1 / 2, "the grounds are exact");
        time += u32::from(frame.delay);
        n += 1;
    }
    assert_eq!(n, 9);
    // 9/7 s in hundredths, and the rest at the end.
    assert_eq!(time, 129 + 150);
}
