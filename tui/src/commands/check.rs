//! `check`: what a scene takes, without running it.

use super::print;
use crate::cli::SceneArguments;
use crate::exit::{Failure, USAGE};
use crate::progress::duration;
use loschmidt_core::Fault;
use loschmidt_runner::run::Plan;
use loschmidt_runner::scene::{load, resolve};
use loschmidt_runner::setup;
use loschmidt_runner::{Options, Player};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Steps are tried for about this long to estimate the time of a run.
const TRIAL: Duration = Duration::from_millis(500);

/// Bytes of a particle in the CSV and VTP files of a frame, about.
const BYTES_PER_PARTICLE: u64 = 250;

/// Tells what a scene takes.
pub fn check(arguments: &SceneArguments) -> Result<ExitCode, Failure> {
    let scene = load(&resolve(&arguments.scene)?, &arguments.overrides())?;
    let needed = setup::estimated_bytes(&scene);
    setup::check_memory(&scene).map_err(loschmidt_runner::RunError::from)?;
    let initial = scene.initial_state()?;
    let (fluid, walls) = (initial.fluid.len(), initial.wall.len());
    let plan = Plan::of(&scene);
    let dt = scene.time_step();
    let options = Options::default();
    let mut player = Player::new(scene, initial, options)
        .map_err(|error| Failure::new(USAGE, format!("error: {error}")))?;
    let limits = setup::force_limit(&mut player);
    let pace = pace(&mut player);

    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<22}{value}\n");
    line("scene", player.scene().name.clone());
    line("particles", format!("{fluid} fluid, {walls} wall"));
    let legs = match plan.back {
        0 => "one way".to_owned(),
        back => format!("{} out and {back} back", plan.out),
    };
    line("steps", format!("{} ({legs})", plan.total()));
    line(
        "memory",
        format!("about {}", setup::bytes_for_people(needed)),
    );
    let frames = plan.frames_until(plan.total()).count() as u64;
    line(
        "disk",
        format!(
            "about {} for {frames} frames",
            setup::bytes_for_people(frames * BYTES_PER_PARTICLE * (fluid + walls) as u64)
        ),
    );
    line(
        "time",
        match pace {
            Ok(pace) => format!(
                "about {} on {} threads; up to twice that once the particles are disordered",
                duration(pace * plan.total() as f64),
                player.threads()
            ),
            Err(fault) => format!("unknown: the run ends soon, {fault}"),
        },
    );
    line("time step", format!("{dt:.4e} s"));
    let mut limit = |name: &str, limit: Option<f64>, rule: &str| {
        let verdict = match limit {
            None => "none".to_owned(),
            Some(limit) if dt <= limit => format!("{limit:.4e} s, kept ({rule})"),
            Some(limit) => format!("{limit:.4e} s, EXCEEDED ({rule})"),
        };
        line(name, verdict);
    };
    let fixed = setup::fixed_limits(player.scene());
    for (name, rule) in [
        ("acoustic", "0.4 h/c"),
        (
            "wall",
            "0.5 r_wall/sqrt(2 E), a quarter of the stability limit of the contact",
        ),
    ] {
        let of_name = fixed
            .iter()
            .find(|(n, _)| *n == name)
            .map(|(_, limit)| *limit);
        limit(&format!("  {name} limit"), of_name, rule);
    }
    let rule = "0.25 sqrt(h/a), a the largest acceleration at the start";
    match limits {
        Ok(force) => limit("  force limit", force, rule),
        Err(fault) => line("  force limit", format!("unknown: {fault}")),
    }
    print(&text)
}

/// Seconds per step, tried from the initial state; the first step is left out, for it warms up.
fn pace(player: &mut Player) -> Result<f64, Fault> {
    player.advance(1)?;
    let began = Instant::now();
    let mut steps = 0;
    while steps < 1 || (began.elapsed() < TRIAL && steps < 1000) {
        player.advance(1)?;
        steps += 1;
    }
    Ok(began.elapsed().as_secs_f64() / f64::from(steps))
}
