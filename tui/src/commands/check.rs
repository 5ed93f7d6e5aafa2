//! `check`: what a scene takes, without running it.

use super::{print, sense};
use crate::cli::SceneArguments;
use crate::exit::{Failure, NOT_EXACT, USAGE};
use crate::progress::{duration, frame_bytes};
use loschmidt_core::Fault;
use loschmidt_runner::figures::quantity;
use loschmidt_runner::run::Plan;
use loschmidt_runner::scene::{
    InitialState, Region, RegionKind, Relaxation, Scene, Solid, Superfluid, Velocity, Viscous,
    lattice_response, load, resolve,
};
use loschmidt_runner::setup;
use loschmidt_runner::{Options, Player};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Steps are tried for about this long to estimate the time of a run.
const TRIAL: Duration = Duration::from_millis(500);

/// Tells what a scene takes.
pub fn check(arguments: &SceneArguments) -> Result<ExitCode, Failure> {
    let scene = load(&resolve(&arguments.scene)?, &arguments.overrides())?;
    let needed = setup::estimated_bytes(&scene);
    setup::check_memory(&scene).map_err(loschmidt_runner::RunError::from)?;
    let initial = scene.initial_state()?;
    let particles = particles(&scene, &initial);
    let makes_sense = sense::lines(&scene, &initial);
    let plan = Plan::of(&scene);
    let dt = scene.time_step();
    let options = Options::default();
    let mut player = Player::new(scene, initial, options)
        .map_err(|error| Failure::new(USAGE, format!("error: {error}")))?;
    let limits = setup::force_limit(&mut player);
    let pace = pace(&mut player, &plan);
    let fails = pace.is_err();

    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<22}{value}\n");
    line("scene", player.scene().name.clone());
    line("particles", particles);
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
            setup::bytes_for_people(frames * frame_bytes(player.home()))
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
            Err(fault) => format!("none: the run will fail, {fault}"),
        },
    );
    line("time step", quantity(dt, "s", 5));
    let mut limit = |name: &str, limit: Option<f64>, rule: &str| {
        let verdict = match limit {
            None => "none".to_owned(),
            Some(limit) if dt <= limit => format!("{}, kept ({rule})", quantity(limit, "s", 5)),
            Some(limit) => format!("{}, EXCEEDED ({rule})", quantity(limit, "s", 5)),
        };
        line(name, verdict);
    };
    let fixed = setup::fixed_limits(player.scene());
    let rules: &[(&str, &str)] = if player.scene().superfluid.is_some() {
        &[
            ("acoustic", "0.4 h/u_1"),
            (
                "viscous",
                "0.125 h²/nu for the paper's h, nu = mu/(chi_n rho0)",
            ),
            (
                "conductive",
                "0.125 h²/nu for the paper's h, nu = beta T0/(C rho0)",
            ),
        ]
    } else if player.scene().has_distortion() {
        &[(
            "elastic",
            "0.4 h/sqrt(c_L² + 4 c_p²), half of the stability limit",
        )]
    } else {
        &[
            ("acoustic", "0.4 h/c"),
            (
                "wall",
                "0.5 r_wall/sqrt(2 E), a quarter of the stability limit of the contact",
            ),
        ]
    };
    for &(name, rule) in rules {
        let of_name = fixed
            .iter()
            .find(|(n, _)| *n == name)
            .map(|(_, limit)| *limit);
        // Helium without friction has no limits of it.
        if of_name.is_some() || player.scene().superfluid.is_none() {
            limit(&format!("  {name} limit"), of_name, rule);
        }
    }
    let rule = "0.25 sqrt(h/a), a the largest acceleration at the start";
    match limits {
        Ok(force) => limit("  force limit", force, rule),
        Err(fault) => line("  force limit", format!("unknown: {fault}")),
    }
    text += &makes_sense;
    text += &materials(player.scene());
    if let Some(superfluid) = &player.scene().superfluid {
        text += &helium(player.scene(), superfluid);
    }
    if let Some(fluid) = &player.scene().viscous {
        text += &viscous(player.scene(), fluid);
    }
    let printed = print(&text)?;
    Ok(if fails {
        ExitCode::from(NOT_EXACT)
    } else {
        printed
    })
}

/// How many particles there are of each sort.
fn particles(scene: &Scene, initial: &InitialState) -> String {
    let all = initial.fluid.len();
    if scene.viscous.is_none() {
        return match scene.solid {
            Some(_) => format!("{all} solid"),
            None => format!("{all} fluid, {} wall", initial.wall.len()),
        };
    }
    // Walls come last.
    let first = initial.parts.iter().find(|part| part.held);
    let walls = first.map_or(0, |part| all - part.first as usize);
    format!("{} fluid, {walls} wall", all - walls)
}

/// Up to so many relaxation times in a step the viscosity of a steady shear was found to be exact.
const MOST_RELAXATIONS: f64 = 4.0;

/// What the fluid is at the time step of the scene.
fn viscous(scene: &Scene, fluid: &Viscous) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<22}{value}\n");
    let material = fluid.material();
    line("material", "viscous fluid".to_owned());
    line("  viscosity", quantity(fluid.viscosity, "m²/s", 5));
    let (tau, dt) = (fluid.relaxation_time(), scene.time_step());
    let time = quantity(tau, "s", 5);
    line(
        "  relaxation time",
        if dt > MOST_RELAXATIONS * tau {
            format!(
                "{time}, of which a step takes {:.3}: TOO MANY, the fluid is thicker than \
                 said; choose a smaller `shear_speed` or `cfl`",
                dt / tau
            )
        } else {
            format!("{time}, of which a step takes {:.3}", dt / tau)
        },
    );
    let (c_l, c_s) = (material.longitudinal_speed(), material.shear_speed);
    line(
        "  waves",
        format!("{c_l:.1} m/s longitudinal, {c_s:.1} m/s shear"),
    );
    if fluid.relaxation == Relaxation::Paper {
        let x = 6.0 * dt / tau;
        line(
            "  in effect",
            format!(
                "{:.3} of the viscosity, for the paper's relaxation makes the fluid too thin",
                x / (x.exp() - 1.0)
            ),
        );
    }
    text
}

/// What the helium is, and how far its waves go.
fn helium(scene: &Scene, superfluid: &Superfluid) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<22}{value}\n");
    let helium = superfluid.helium();
    let (chi, t) = (helium.normal_fraction, helium.temperature);
    let second = helium.second_sound();
    let material = if second > 0.0 {
        format!("superfluid helium at {t} K")
    } else {
        "the normal component of helium alone".to_owned()
    };
    line("material", material);
    line("  normal component", format!("{:.2} %", 100.0 * chi));
    line("  first sound", format!("{:.2} m/s", helium.sound_speed));
    if second > 0.0 {
        let crossing = scene.support_radius() / (second * scene.time_step());
        line(
            "  second sound",
            format!("{second:.2} m/s, {crossing:.0} steps for a support radius"),
        );
    }
    let slope = helium.fraction_slope;
    if slope != 0.0 {
        let ends = [-chi / slope, (1.0 - chi) / slope];
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        line(
            "  range of entropies",
            format!(
                "s0 {low:+.0} to {high:+.0} J/(kg K), s0 = {} J/(kg K)",
                helium.entropy
            ),
        );
    }
    let operators = superfluid.operators.word();
    line("  operators", operators.to_owned());
    if superfluid.mutual_friction > 0.0 {
        line(
            "mutual friction",
            format!("{} m s/kg", superfluid.mutual_friction),
        );
    }
    if let Some(heater) = superfluid.heater {
        line("heater", format!("{} W", heater.power));
    }
    if let Some(leak) = superfluid.superleak {
        let share = scene.time_step() / leak.time;
        line(
            "superleak",
            format!("holds for {share:.3} of its times in a step"),
        );
    }
    walls(scene, &mut line);
    text
}

/// What the walls of helium are, a line for each region of them.
fn walls(scene: &Scene, line: &mut impl FnMut(&str, String)) {
    let wall = |region: &&Region| region.kind == RegionKind::Wall;
    for (n, region) in scene.regions.iter().filter(wall).enumerate() {
        let rubs = match (region.smooth, &region.velocity[..]) {
            (true, _) => "smooth".to_owned(),
            (false, [Velocity::Uniform(v)]) => {
                format!("a lid of {:.3} m/s", v[0].hypot(v[1]).hypot(v[2]))
            }
            (false, _) => "rough".to_owned(),
        };
        let heat = match region.conduction {
            Some(beta) => format!("takes heat with {beta} W/(m K²)"),
            None => "adiabatic".to_owned(),
        };
        line(&format!("wall {n}"), format!("{rubs}, {heat}"));
    }
}

/// What the bodies are made of, those of one material together, on the lattice of the scene.
fn materials(scene: &Scene) -> String {
    let solids = scene.solids();
    let mut text = String::new();
    for (n, solid) in solids.iter().enumerate() {
        if solids[..n].contains(solid) {
            continue;
        }
        let same = (n..solids.len()).filter(|&m| solids[m] == *solid);
        let numbers: Vec<String> = same.map(|m| m.to_string()).collect();
        if numbers.len() < solids.len() {
            text += &format!("{:<22}{}\n", "bodies", numbers.join(", "));
        }
        text += &elastic(scene, solid);
    }
    text
}

/// What a material is on the lattice of the scene.
fn elastic(scene: &Scene, solid: &Solid) -> String {
    let material = solid.material();
    let constants = material.constants(solid.reference_density);
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<22}{value}\n");
    line(
        "material",
        format!("{}, small strains", solid.energy.word()),
    );
    let pascal = |x: f64| quantity(x, "Pa", 5);
    line("  Young's modulus", pascal(constants.youngs_modulus));
    line(
        "  Poisson's ratio",
        format!("{:.4}", constants.poissons_ratio),
    );
    line("  bulk modulus", pascal(constants.bulk_modulus));
    line("  shear modulus", pascal(constants.shear_modulus));
    let (c_l, c_s) = (material.longitudinal_speed(), material.shear_speed);
    line(
        "  waves",
        format!("{c_l:.1} m/s longitudinal, {c_s:.1} m/s shear"),
    );
    let (h, p) = (
        scene.support / 2.0,
        material.penalty_speed / material.bulk_speed,
    );
    line("lattice", format!("h/dr = {h}, c_p/c_0 = {p:.3}"));
    if let Some(through) = scene.spacings_through() {
        let excess = 100.0 * SOFTNESS / through;
        let enough = (SOFTNESS / WANTED).ceil();
        line(
            "thickness",
            format!(
                "{through:.0} particles through the thinnest part: in bending up to about \
                 {excess:.0} % too soft; {enough} for {:.0} %",
                100.0 * WANTED
            ),
        );
    }
    let mut seen = Vec::new();
    for kind in scene.regions.iter().filter_map(|region| region.lattice) {
        let Some(response) = lattice_response(kind, scene.support) else {
            continue;
        };
        if seen.contains(&kind) {
            continue;
        }
        seen.push(kind);
        let stiffness = response.bulk_stiffness(p);
        let verdict = if (stiffness - 1.0).abs() > SPOILT {
            "SPOILT by the penalty: set solid.penalty to 1"
        } else {
            "as given"
        };
        line(
            &format!("  {}", kind.word()),
            format!("{stiffness:.3} of the stiffness in bulk, {verdict}"),
        );
    }
    text
}

/// A beam of N particles through its thickness bends too far by up to about this over N: the gradient
/// sees the strain of a point half a support within the surface. At Poisson's ratio 0.3 and ten
/// particles it is 1.16 of the theory, at 0.4 it is 1.04 (`loschmidt reproduce cantilever`).
const SOFTNESS: f64 = 1.7;

/// The error in bending that is small enough.
const WANTED: f64 = 0.03;

/// Relative change of the bulk stiffness by the lattice from which on it is worth a warning.
const SPOILT: f64 = 0.05;

/// Seconds of a step, after the first one: the first steps of the run are taken, as `run` would, for
/// a while.
fn pace(player: &mut Player, plan: &Plan) -> Result<f64, Fault> {
    let mut step = || {
        if player.steps_taken() == plan.out && plan.back > 0 {
            player.turn();
        }
        player.advance(1)
    };
    let mut began = Instant::now();
    let most = plan.total().min(1001);
    let mut timed = 0;
    for taken in 0..most {
        step()?;
        if taken == 0 && most > 1 {
            began = Instant::now();
            continue;
        }
        timed += 1;
        if began.elapsed() >= TRIAL {
            break;
        }
    }
    Ok(began.elapsed().as_secs_f64() / f64::from(timed.max(1)))
}
