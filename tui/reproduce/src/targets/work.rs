//! Beyond the paper: what precision costs with every integrator.
//!
//! Work is counted in force evaluations for each second of flow. On the dam break precision is the
//! largest error of the energy over the energy released; on a smooth flow, a turning drop held
//! together by a central attraction and far from walls and collisions, it is the distance from the
//! same flow at a much smaller step, and the slopes show the orders of the integrators.

use crate::lab::{Lab, LabError, Past, scene, scene_of};
use crate::section::Section;
use crate::svg::{self, Chart, Style};
use loschmidt_core::integrator::INTEGRATORS;
use loschmidt_runner::ArithmeticKind::Fixed;
use loschmidt_runner::SavedState;
use loschmidt_runner::run::EnergyBalance;

/// What `--preset accurate` sets.
pub const ACCURATE: [&str; 2] = loschmidt_runner::scene::preset::ACCURATE;

/// Largest energy error over the energy released.
fn error(past: &Past) -> f64 {
    let balance = EnergyBalance::of(&past.rows);
    balance
        .and_then(|b| b.max_error_over_released)
        .unwrap_or(f64::NAN)
}

pub fn work(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Beyond the paper: work and precision",
        "The dam break one way to 1 s, and a turning drop in a central attraction to 0.1 s, with every integrator at several time steps.",
    );
    dam_break(lab, &mut section)?;
    smooth(lab, &mut section)?;
    accurate(lab, &mut section)?;
    Ok(section)
}

fn dam_break(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let spacing = lab.size("particle_spacing=0.05", "particle_spacing=0.02");
    let mut chart = Chart {
        title: "Dam break".to_owned(),
        x_label: "force evaluations for each second of flow".to_owned(),
        y_label: "energy error over released".to_owned(),
        x_log: true,
        y_log: true,
        ..Chart::default()
    };
    let mut rows = Vec::new();
    for (k, row) in INTEGRATORS.iter().enumerate() {
        let mut points = Vec::new();
        for cfl in ["0.4", "0.2", "0.1", "0.05"] {
            let set = [
                spacing.to_owned(),
                format!("integrator={}", row.name),
                format!("cfl={cfl}"),
                "turnaround=".to_owned(),
                "end=1.0".to_owned(),
                "output.frames=0".to_owned(),
            ];
            let past = lab.run(
                &format!("work-{}-{cfl}", row.name),
                scene("dam-break", &set)?,
                Fixed,
            )?;
            let evaluations = f64::from(row.evaluations) / past.scene.time_step();
            if past.failure.is_none() {
                let error = error(&past);
                points.push([evaluations, error]);
                rows.push(vec![
                    row.name.to_owned(),
                    cfl.to_owned(),
                    format!("{evaluations:.0}"),
                    format!("{error:.1e}"),
                ]);
            } else {
                rows.push(vec![
                    row.name.to_owned(),
                    cfl.to_owned(),
                    format!("{evaluations:.0}"),
                    "the numbers end".to_owned(),
                ]);
            }
        }
        chart.series.push(svg::styled(
            row.name,
            k,
            Style::LineDots,
            points.into_iter(),
        ));
    }
    section.table(
        "Dam break: force evaluations for each second of flow, and the energy error over released",
        &["integrator", "cfl", "evaluations", "error"],
        rows,
    );
    lab.figure(section, "work-dam-break", &chart.svg(), "Collisions with the wall, whose force has a kink, and with other particles limit what a higher order gains.")
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
    section.note("On the smooth flow Störmer-Verlet is of second order throughout. The fourth-order rows reach their order only while no neighbour enters or leaves the kernel within a step: Wendland's C2 kernel has a force with two continuous derivatives there, and the error of a crossing is of third order in the step.");
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
