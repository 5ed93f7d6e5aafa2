//! `movie`: a run out and back as pictures, GIF and MP4.

use super::print;
use crate::cli::{MovieArguments, WorkArguments};
use crate::exit::{Failure, USAGE, tell};
use crate::progress::Pictures;
use crate::stop::Stop;
use loschmidt_runner::figures::quantity;
use loschmidt_runner::plain::quote;
use loschmidt_runner::scene::{self, Dimension, Scene};
use loschmidt_runner::{ArithmeticKind, Options, Player, RunError, setup};
use loschmidt_viewer::movie::{
    CameraPath, Ending, Fate, Movie, MovieError, MovieStyle, Stored, free_directory,
};
use loschmidt_viewer::movie::{gif, mp4, target};
use loschmidt_viewer::{Colouring, Look, Picture, View};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// Length of a movie, s, where nothing else says.
const SECONDS: f64 = 12.0;

/// Pictures of a movie at most: their numbers have five digits.
const MOST_PICTURES: usize = 100_000;

/// Makes a movie.
pub fn movie(arguments: &MovieArguments) -> Result<ExitCode, Failure> {
    let stop = Stop::new()?;
    for file in [&arguments.gif, &arguments.mp4].into_iter().flatten() {
        target::check(file, arguments.force)?;
    }
    if let Some(path) = arguments.mp4.as_ref().filter(|_| !mp4::is_available()) {
        return Err(MovieError::FfmpegMissing(path.clone()).into());
    }
    let tint = arguments.tint.as_deref().map(Picture::open).transpose()?;
    let path = Path::new(&arguments.scene);
    if Stored::is_run(path) {
        return of_run(arguments, tint, path, &stop);
    }
    let scene = scene::load(&scene::resolve(&arguments.scene)?, &arguments.set)?;
    of_scene(arguments, tint, scene, &stop)
}

fn of_scene(
    arguments: &MovieArguments,
    tint: Option<Picture>,
    scene: Scene,
    stop: &Stop,
) -> Result<ExitCode, Failure> {
    let style = style(arguments, tint, SECONDS, &scene)?;
    let options = options(arguments)?;
    let arithmetics: &[ArithmeticKind] = match arguments.compare {
        None => &[ArithmeticKind::Fixed],
        Some(_) => &[ArithmeticKind::Fixed, ArithmeticKind::Float],
    };
    let identity = format!("simulated {arithmetics:?}\n{}", scene.to_toml());
    setup::check_memory(&scene).map_err(RunError::from)?;
    let initial = scene.initial_state()?;
    stop.wait_for_steps();
    let mut movie = create(arguments, style, &scene.name, &identity)?;
    announce(arguments, &movie);
    let mut ending = Ending::new();
    if !movie.is_finished() {
        let mut players = Vec::new();
        for &arithmetic in arithmetics {
            let options = Options {
                arithmetic,
                ..options
            };
            let player = Player::new(scene.clone(), initial.clone(), options);
            players.push(player.map_err(RunError::from)?);
        }
        let mut display = Pictures::new(arguments.quiet);
        let result = movie.simulate(players, |progress| display.show(progress), stop.asked());
        display.finish();
        ending = result.map_err(|error| how_to_go_on(arguments, &movie, error))?;
    }
    finish(arguments, &movie, &ending)
}

fn of_run(
    arguments: &MovieArguments,
    tint: Option<Picture>,
    path: &Path,
    stop: &Stop,
) -> Result<ExitCode, Failure> {
    let simulates = [
        (!arguments.set.is_empty(), "--set"),
        (arguments.compare.is_some(), "--compare"),
    ];
    if let Some((_, flag)) = simulates.into_iter().find(|(given, _)| *given) {
        return Err(Failure::new(
            USAGE,
            format!(
                "error: {flag} needs a simulation, and the frames of a finished run are only drawn\n\
                 help: to simulate it again, give its scene: {}",
                quote(&path.join("scene.toml"))
            ),
        ));
    }
    let run = Stored::open(path)?;
    let seconds = run.frames() as f64 / f64::from(arguments.fps);
    let style = style(arguments, tint, seconds, run.scene())?;
    run.suffices(&style)?;
    stop.wait_for_steps();
    let mut movie = create(arguments, style, &run.scene().name, &run.identity())?;
    announce(arguments, &movie);
    if !movie.is_finished() {
        let mut display = Pictures::new(arguments.quiet);
        let result = movie.render(&run, |progress| display.show(progress), stop.asked());
        display.finish();
        result.map_err(|error| how_to_go_on(arguments, &movie, error))?;
    }
    finish(arguments, &movie, &Ending::new())
}

fn options(arguments: &MovieArguments) -> Result<Options, Failure> {
    let work = WorkArguments {
        threads: arguments.threads,
        executor: arguments.executor,
        backend: None,
        quiet: arguments.quiet,
        json: false,
    };
    work.options(Options::default())
}

fn style(
    arguments: &MovieArguments,
    tint: Option<Picture>,
    seconds: f64,
    scene: &Scene,
) -> Result<MovieStyle, Failure> {
    refuse_foreign_colours(&arguments.color, scene)?;
    refuse_foreign_views(arguments, scene)?;
    let seconds = arguments.seconds.unwrap_or(seconds);
    let pictures = (seconds * f64::from(arguments.fps)).round() as usize;
    if !(2..=MOST_PICTURES).contains(&pictures) {
        return Err(Failure::new(
            USAGE,
            format!(
                "error: {seconds} s at {} pictures per second are {pictures} pictures\n\
                 help: allowed are 2 to {MOST_PICTURES}",
                arguments.fps
            ),
        ));
    }
    Ok(MovieStyle {
        size: arguments.size,
        fps: arguments.fps,
        pictures,
        look: Look {
            colouring: arguments.color.clone(),
            colormap: arguments.colormap.map(Into::into),
            theme: arguments.theme.into(),
            view: View::default().zoomed(arguments.zoom.unwrap_or(1.0)),
            ..Look::default()
        },
        tint,
        camera: CameraPath {
            rectangle: arguments.view,
            orbit: arguments.orbit,
        },
    })
}

/// A rectangle of the plane for a scene in space, and the other way round.
fn refuse_foreign_views(arguments: &MovieArguments, scene: &Scene) -> Result<(), Failure> {
    let space = scene.dimension == Dimension::Three;
    let (flag, place, help) = match (arguments.view, arguments.orbit, space) {
        (Some(_), _, true) => (
            "--view",
            "in space",
            "--zoom and --orbit are for scenes in space",
        ),
        (_, true, false) => (
            "--orbit",
            "in the plane",
            "--view and --zoom are for scenes in the plane",
        ),
        _ => return Ok(()),
    };
    Err(Failure::new(
        USAGE,
        format!(
            "error: {flag} cannot be used: `{}` is {place}\nhelp: {help}",
            scene.name
        ),
    ))
}

/// Colours by a number that the particles of the scene do not have.
fn refuse_foreign_colours(colouring: &Colouring, scene: &Scene) -> Result<(), Failure> {
    if colouring.fits(scene) {
        return Ok(());
    }
    let columns = setup::columns(scene).iter().copied();
    let names: Vec<String> = Colouring::choices(columns)
        .iter()
        .map(Colouring::name)
        .collect();
    Err(Failure::new(
        USAGE,
        format!(
            "error: particles of `{}` have no {}\nhelp: they have {}",
            scene.name,
            colouring.title(),
            names.join(", ")
        ),
    ))
}

fn create(
    arguments: &MovieArguments,
    style: MovieStyle,
    scene: &str,
    identity: &str,
) -> Result<Movie, Failure> {
    let out = arguments.out.clone();
    let out = out.unwrap_or_else(|| free_directory(scene));
    Ok(Movie::create(
        &out,
        arguments.force,
        style,
        scene,
        identity,
    )?)
}

fn announce(arguments: &MovieArguments, movie: &Movie) {
    if arguments.quiet {
        return;
    }
    let style = movie.style();
    let (width, height) = style.size;
    let found = match movie.found() {
        0 => String::new(),
        found => format!("; {found} are there"),
    };
    tell(&format!(
        "{} pictures of {width}x{height}, written to {}{found}",
        style.pictures,
        movie.path().display()
    ));
}

/// An interruption ends with the command that goes on.
fn how_to_go_on(arguments: &MovieArguments, movie: &Movie, error: MovieError) -> Failure {
    if !matches!(error, MovieError::Interrupted { .. }) {
        return error.into();
    }
    let mut words: Vec<String> = std::env::args_os()
        .skip(1)
        .map(|word| quote(Path::new(&word)))
        .collect();
    if arguments.out.is_none() {
        words.extend(["--out".to_owned(), quote(movie.path())]);
    }
    Failure::new(
        crate::exit::INTERRUPTED,
        format!("{error}; go on with\n    loschmidt {}", words.join(" ")),
    )
}

/// Makes the files that were asked for, and tells what there is.
fn finish(arguments: &MovieArguments, movie: &Movie, ending: &[Fate]) -> Result<ExitCode, Failure> {
    let mut text = format!(
        "{} pictures in {}\n",
        movie.style().pictures,
        movie.path().display()
    );
    let mut file = |path: &PathBuf| {
        let bytes = std::fs::metadata(path).map_or(0, |data| data.len());
        let size = setup::bytes_for_people(bytes);
        text += &format!("{}, {size}\n", path.display());
    };
    if let Some(path) = &arguments.gif {
        gif::write(movie, path, arguments.force)?;
        file(path);
    }
    if let Some(path) = &arguments.mp4 {
        let by_hand = mp4::command(movie, path, quote);
        mp4::write(movie, path, arguments.force, by_hand)?;
        file(path);
    }
    if !arguments.quiet {
        text += &times(movie);
    }
    for fate in ending {
        text += &sentence(fate);
    }
    print(&text)
}

/// Where the time went.
fn times(movie: &Movie) -> String {
    let times = &movie.times;
    if times.pictures == 0 {
        return String::new();
    }
    let seconds = |time: Duration| format!("{:.1} s", time.as_secs_f64());
    let source = if times.reading > Duration::ZERO {
        format!("read {}", seconds(times.reading))
    } else {
        format!("simulated {}", seconds(times.simulating))
    };
    format!(
        "{source}, drawn {} ({:.1} ms a picture), written {}\n",
        seconds(times.drawing),
        1e3 * times.drawing.as_secs_f64() / f64::from(times.pictures),
        seconds(times.writing)
    )
}

/// Whether a run came home.
fn sentence(fate: &Fate) -> String {
    let arithmetic = match fate.arithmetic {
        ArithmeticKind::Fixed => "fixed",
        ArithmeticKind::Float => "floating",
    };
    match fate.home {
        None => String::new(),
        Some(home) if home.is_exact() => {
            format!("{arithmetic} point came home: every bit of the last state equals the first\n")
        }
        Some(home) => {
            let far = quantity(home.error, "m", 3);
            format!("{arithmetic} point did not come home: a particle is up to {far} away\n")
        }
    }
}
