//! Beyond the paper: what precision costs with every integrator, and what limits the order.
//!
//! Work is counted in force evaluations for each second of flow. Precision is the largest error of
//! the energy over the energy released (over the kinetic energy where nothing falls). One thing at
//! a time is changed: the dam break has the conservative wall of eq. (7), whose force -dU/dr rises
//! from zero at r_wall with a kink, or a wall of dummies, whose force is the fluid's; two drops
//! collide without any wall. A force with a kink makes one step in error by the square of its
//! length whatever the integrator, and there are as many collisions however short the steps are:
//! second order. Where neighbours enter the support, Wendland's C2 kernel has a force like (1 -
//! r/h)³: such a step is in error by the fourth power, which a method of fourth order does not
//! notice.
//!
//! On a smooth flow, a turning drop held together by a central attraction and far from walls and
//! collisions, precision is the distance from the same flow at a much smaller step.

use super::slope;
use crate::lab::{Lab, LabError, Past, scene, scene_of};
use crate::section::Section;
use crate::svg::{self, Chart, Style};
use loschmidt_core::integrator::INTEGRATORS;
use loschmidt_runner::ArithmeticKind::Fixed;
use loschmidt_runner::SavedState;
use loschmidt_runner::run::EnergyBalance;

/// What `--preset accurate` sets.
pub const ACCURATE: [&str; 2] = loschmidt_runner::scene::preset::ACCURATE;

/// Largest energy error over the energy released, or over the largest kinetic energy where gravity
/// releases none.
fn error(past: &Past) -> f64 {
    let Some(balance) = EnergyBalance::of(&past.rows) else {
        return f64::NAN;
    };
    let kinetic = past
        .rows
        .iter()
        .map(|row| row.energy("kinetic"))
        .fold(0.0, f64::max);
    balance
        .max_error_over_released
        .unwrap_or(balance.max_error / kinetic)
}

pub fn work(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let spacing = lab.size(0.05, 0.025);
    let mut section = Section::new(
        "Beyond the paper: work and precision",
        format!(
            "The dam break one way to 1 s with a spacing of {spacing} m, with the conservative wall and with dummies; two drops of 0.05 m spacing that collide without a wall, to 0.6 s; a turning drop in a central attraction, to 0.1 s; with every integrator at several time steps."
        ),
    );
    let flows = [
        Flow {
            name: "conservative wall",
            title: "Dam break, conservative wall",
            scene: "dam-break",
            set: vec![format!("particle_spacing={spacing}"), "end=1.0".to_owned()],
            kink: true,
        },
        Flow {
            name: "dummy wall",
            title: "Dam break, dummy wall",
            scene: "dam-break",
            set: vec![
                format!("particle_spacing={spacing}"),
                "end=1.0".to_owned(),
                "wall_model=dummy".to_owned(),
            ],
            kink: false,
        },
        Flow {
            name: "colliding drops",
            title: "Colliding drops, no wall",
            scene: "colliding-drops",
            set: vec!["particle_spacing=0.05".to_owned(), "end=0.6".to_owned()],
            kink: false,
        },
    ];
    let mut rows = Vec::new();
    for flow in &flows {
        precision(lab, &mut section, flow, &mut rows)?;
    }
    section.table(
        "Largest energy error over the energy released (drops: over the kinetic energy) by cfl, and its slope",
        &["flow", "integrator", "0.4", "0.2", "0.1", "0.05", "slope"],
        rows,
    );
    section.note("What limits the order on the dam break is the wall: its force (7) begins with a kink at r_wall, and there every integrator is of second order. With dummies in its place, or without a wall, the rows of fourth order have their order, collisions of particles included; so the limited smoothness of Wendland's C2 kernel costs none of it.");
    smooth(lab, &mut section)?;
    accurate(lab, &mut section)?;
    Ok(section)
}

/// A flow on which every integrator is tried.
struct Flow {
    name: &'static str,
    title: &'static str,
    scene: &'static str,
    set: Vec<String>,
    /// Whether a force in it has a kink.
    kink: bool,
}

const CFLS: [&str; 4] = ["0.4", "0.2", "0.1", "0.05"];

/// The energy error of a flow with every integrator and time step.
fn precision(
    lab: &mut Lab<'_>,
    section: &mut Section,
    flow: &Flow,
    rows: &mut Vec<Vec<String>>,
) -> Result<(), LabError> {
    let mut chart = Chart {
        title: flow.title.to_owned(),
        x_label: "force evaluations for each second of flow".to_owned(),
        y_label: "largest relative energy error".to_owned(),
        x_log: true,
        y_log: true,
        ..Chart::default()
    };
    for (k, row) in INTEGRATORS.iter().enumerate() {
        let mut points = Vec::new();
        let mut cells = vec![flow.name.to_owned(), row.name.to_owned()];
        for cfl in CFLS {
            let mut set = flow.set.clone();
            set.extend(
                ["turnaround=", "output.frames=0"]
                    .map(str::to_owned)
                    .into_iter()
                    .chain([format!("integrator={}", row.name), format!("cfl={cfl}")]),
            );
            let name = format!("work-{}-{}-{cfl}", flow.name.replace(' ', "-"), row.name);
            let past = lab.run(&name, scene(flow.scene, &set)?, Fixed)?;
            if past.failure.is_some() {
                cells.push("ends".to_owned());
                continue;
            }
            let error = error(&past);
            points.push([f64::from(row.evaluations) / past.scene.time_step(), error]);
            cells.push(format!("{error:.1e}"));
        }
        let order = slope(points.iter().map(|p| [-libm::log(p[0]), libm::log(p[1])]));
        cells.push(order.map_or(String::new(), |order| format!("{order:.2}")));
        rows.push(cells);
        if let Some(order) = order {
            let what = format!("{}: slope of {}", flow.name, row.name);
            let of_table = f64::from(row.order);
            let (asked, holds) = if flow.kink && row.order > 2 {
                ("below 3: the kink limits it".to_owned(), order < 3.0)
            } else {
                let asked = format!("{} to within 0.7", row.order);
                (asked, (order - of_table).abs() < 0.7)
            };
            section.check(&what, format!("{order:.2}"), "", &asked, holds);
        }
        chart.series.push(svg::styled(
            row.name,
            k,
            Style::LineDots,
            points.into_iter(),
        ));
    }
    let caption = if flow.kink {
        "The wall's force has a kink: second order for all."
    } else {
        "No force has a kink: the orders of the integrators."
    };
    let file = format!("work-{}", flow.name.replace(' ', "-"));
    lab.figure(section, &file, &chart.svg(), caption)
}

const DROP: &str = "particle_spacing = 0.05\nturnaround = 0.1\nfluid.sound_speed = 20\nwall_model = \"none\"\n\
    gravity.central = { centre = [0, 0], strength = 2.0, softening = 0.5 }\n\
    [[region]]\nkind = \"fluid\"\nlattice = \"hexagonal\"\nshape.circle = { centre = [0, 0], radius = 0.5 }\n\
    velocity = { rotation = 2.0 }\n";

/// The drop after 0.1 s in so many steps.
fn drop(lab: &mut Lab<'_>, integrator: &str, steps: u32) -> Result<SavedState, LabError> {
    let text = format!(
        "integrator = \"{integrator}\"\ntime_step = {:?}\n{DROP}",
        0.1 / f64::from(steps)
    );
    let scene = scene_of("drop", &text)?;
    let mut player = lab.player(&scene, lab.options())?;
    lab.advance("drop", &mut player, u64::from(steps))?;
    Ok(player.save())
}

fn smooth(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let reference = drop(lab, "suzuki", lab.size(1600, 6400))?;
    let rms = |state: &SavedState| {
        let n = state.id.len();
        let square = |i| {
            let (a, b) = (state.position(i), reference.position(i));
            (0..2).map(|d| (a[d] - b[d]).powi(2)).sum::<f64>()
        };
        ((0..n).map(square).sum::<f64>() / n as f64).sqrt()
    };
    let mut chart = Chart {
        title: "Turning drop".to_owned(),
        x_label: "force evaluations for each second of flow".to_owned(),
        y_label: "rms distance from the exact flow, m".to_owned(),
        x_log: true,
        y_log: true,
        ..Chart::default()
    };
    let mut all: Vec<Vec<[f64; 2]>> = Vec::new();
    for (k, row) in INTEGRATORS.iter().enumerate() {
        let mut points = Vec::new();
        for steps in [25, 50, 100, 200, 400] {
            let state = drop(lab, row.name, steps)?;
            points.push([f64::from(row.evaluations * steps) * 10.0, rms(&state)]);
        }
        all.push(points.clone());
        chart.series.push(svg::styled(
            row.name,
            k,
            Style::LineDots,
            points.into_iter(),
        ));
    }
    // What the rounding of the state and the reference leave is no error of the integrators.
    let lowest = all
        .iter()
        .flatten()
        .fold(f64::INFINITY, |low, p| low.min(p[1]));
    for (row, points) in INTEGRATORS.iter().zip(&all) {
        let above: Vec<_> = points.iter().filter(|p| p[1] > 30.0 * lowest).collect();
        if let [.., a, b] = above[..] {
            let order = -libm::log(b[1] / a[1]) / libm::log(b[0] / a[0]);
            section.check(
                &format!("turning drop: order of {} above the rounding", row.name),
                format!("{order:.2}"),
                &row.order.to_string(),
                "the table's to within 0.5",
                (order - f64::from(row.order)).abs() < 0.5,
            );
        }
    }
    lab.figure(
        section,
        "work-smooth",
        &chart.svg(),
        "Where the forces are smooth the slopes are the orders of the integrators.",
    )
}

fn accurate(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let spacing = lab.size("particle_spacing=0.04", "particle_spacing=0.02");
    let base = ["turnaround=", "end=1.0", "output.frames=0", spacing].map(str::to_owned);
    let plain = lab.run("accurate-plain", scene("dam-break", &base)?, Fixed)?;
    let set = [&base[..], &ACCURATE.map(str::to_owned)].concat();
    let past = lab.run("accurate", scene("dam-break", &set)?, Fixed)?;
    let found = error(&past);
    section.check(
        "preset `accurate`: energy error over released",
        format!("{found:.1e} (without it {:.1e})", error(&plain)),
        "",
        "at most 1e-4",
        found <= 1e-4,
    );
    let evaluations = |past: &Past| {
        let row = loschmidt_runner::setup::integrator(past.scene.integrator);
        f64::from(row.evaluations) / past.scene.time_step()
    };
    section.measure(
        "preset `accurate`: its cost",
        format!(
            "{:.1} times the force evaluations",
            evaluations(&past) / evaluations(&plain)
        ),
        "",
    );
    Ok(())
}
