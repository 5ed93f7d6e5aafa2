//! Taylor-Couette flow: Figs. 8 to 10 of the paper on solids and fluids.

use super::flow::{Flow, march};
use super::slope;
use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use crate::svg::{self, Chart, Field, Style};
use std::f64::consts::{PI, TAU};

/// Radii of the cylinders, m; the outer one turns at 1 rad/s.
const RADII: [f64; 2] = [1.0, 2.0];
/// From when on the profile is averaged, s.
const STEADY: f64 = 5.0;
/// Looks at a run.
const LOOKS: u64 = 160;
/// Places of the profile between the cylinders.
const PLACES: usize = 99;
/// Half the vorticity of the steady flow: how fast a distortion turns, rad/s.
const TURN: f64 = -4.0 / 3.0;

/// The steady profile (64), m/s.
fn exact(r: f64) -> f64 {
    4.0 / 3.0 * (r - 1.0 / r)
}

fn radius(k: usize) -> f64 {
    RADII[0] + (RADII[1] - RADII[0]) * (k + 1) as f64 / (PLACES + 1) as f64
}

/// What was seen of a run.
struct Seen {
    /// Mean velocity along y on the positive x axis.
    profile: Vec<[f64; 2]>,
    /// Largest error of the mean profile, and of that at the end.
    errors: [f64; 2],
    /// How fast the distortion halfway between the cylinders turned, rad/s.
    turn: f64,
    balance: f64,
    energies: Chart,
    /// Pictures of the distortion's xy entry at a few times.
    pictures: Vec<Field>,
}

/// Angle of the mean distortion of the particles halfway between the cylinders.
fn angle(flow: &Flow) -> f64 {
    let mut sums = [0.0; 2];
    let particles = flow.position.iter().zip(&flow.distortion);
    for (x, a) in particles.take(flow.flowing) {
        if (x[0].hypot(x[1]) - 1.5).abs() < 0.05 {
            sums[0] += a[2] - a[1];
            sums[1] += a[0] + a[3];
        }
    }
    sums[0].atan2(sums[1])
}

fn picture(time: f64, flow: &Flow, spacing: f64) -> Field {
    let n = flow.flowing;
    Field {
        title: format!("t = {time:.1} s"),
        bounds: [[-2.1, -2.1], [2.1, 2.1]],
        diameter: spacing,
        points: flow.position[..n].to_vec(),
        values: flow.distortion[..n].iter().map(|a| a[1]).collect(),
        range: [-1.0, 1.0],
        label: "distortion xy".to_owned(),
        walls: flow.position[n..].to_vec(),
    }
}

/// A run with so many particles between the cylinders.
fn run(lab: &mut Lab<'_>, across: u32, set: &[&str]) -> Result<Seen, LabError> {
    let spacing = 1.0 / f64::from(across);
    let (inner, outer) = (RADII[0] - 1.5 * spacing, RADII[1] + 1.5 * spacing);
    let mut all = vec![
        format!("particle_spacing={spacing}"),
        format!("region.1.shape.annulus.inner={inner}"),
        format!("region.2.shape.annulus.outer={outer}"),
    ];
    all.extend(set.iter().map(|&set| set.to_owned()));
    let options = lab.options();
    let mut player = lab.player(&scene("taylor-couette", &all)?, options)?;
    let end = player.scene().end_time();
    let mut sums = vec![0.0; PLACES];
    let mut last = vec![0.0; PLACES];
    let (mut count, mut turned, mut before) = (0.0, 0.0, None::<f64>);
    let mut since = end;
    let mut pictures = Vec::new();
    let name = format!("cylinders, 1/{across} {}", set.join(" "));
    let budget = march(lab, &name, &mut player, LOOKS, |time, flow| {
        let now = angle(flow);
        if time >= STEADY {
            for (k, (sum, last)) in sums.iter_mut().zip(&mut last).enumerate() {
                *last = flow.velocity_at([radius(k), 0.0])[1];
                *sum += *last;
            }
            count += 1.0;
            if let Some(before) = before {
                turned += (now - before + PI).rem_euclid(TAU) - PI;
            } else {
                since = time;
            }
            before = Some(now);
        }
        for wanted in [1.0, 2.0, 4.0, end] {
            if (time - wanted).abs() < 0.5 * end / LOOKS as f64 {
                pictures.push(picture(time, flow, spacing));
            }
        }
    })?;
    let profile: Vec<[f64; 2]> = sums
        .iter()
        .enumerate()
        .map(|(k, sum)| [radius(k), sum / f64::max(count, 1.0)])
        .collect();
    let worst = |v: &mut dyn Iterator<Item = [f64; 2]>| {
        v.fold(0.0, |m: f64, [r, v]| m.max((v - exact(r)).abs()))
    };
    let at_end = last.iter().enumerate().map(|(k, v)| [radius(k), *v]);
    Ok(Seen {
        errors: [
            worst(&mut profile.iter().copied()),
            worst(&mut at_end.into_iter()),
        ],
        profile,
        turn: turned / (end - since),
        balance: budget.error,
        energies: budget.chart("Fig. 10"),
        pictures,
    })
}

pub fn couette(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Viscous, Figs. 8 to 10: Taylor-Couette flow",
        "Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, section 4.3: fluid \
         between a cylinder of radius 1 m at rest and one of 2 m that turns at 1 rad/s, viscosity \
         0.1 m²/s, on Vogel's spiral, 8 s. Profiles are means over 5 to 8 s on the positive x axis; \
         their errors are the largest ones, of a speed of 2 m/s.",
    );
    let sizes: &[u32] = lab.size(&[10, 20], &[10, 20, 30, 40]);
    let mut rows = Vec::new();
    let mut convergence = Vec::new();
    let mut profiles = Chart {
        title: "Fig. 8: deviation from the exact profile".to_owned(),
        x_label: "r / m".to_owned(),
        y_label: "v - v_exact / (m/s)".to_owned(),
        ..Chart::default()
    };
    for (n, &across) in sizes.iter().enumerate() {
        let seen = run(lab, across, &[])?;
        rows.push(row(&format!("1/{across}"), "mirrored", &seen));
        convergence.push([1.0 / f64::from(across), seen.errors[0]]);
        let off = seen.profile.iter().map(|[r, v]| [*r, v - exact(*r)]);
        let label = format!("dr = 1/{across}");
        profiles.series.push(svg::line(&label, n, off));
        if across == 20 {
            checks(&mut section, &seen);
            lab.figure(
                &mut section,
                "couette-energies",
                &seen.energies.svg(),
                "dr = 1/20. Kinetic energy and heat are what the turning cylinder has put in.",
            )?;
            lab.figure(
                &mut section,
                "couette-distortion",
                &svg::fields(&seen.pictures, 4, 230.0),
                "Fig. 9: the flow is steady, the distortion turns on. The waves are the memory of \
                 how the flow began: its angle differs from radius to radius.",
            )?;
        }
    }
    for set in [
        ["viscous.wall_velocity=plain"],
        ["viscous.relaxation=paper"],
    ] {
        let (across, label) = (20, set[0].split('=').next_back().unwrap_or_default());
        let mut set = set.to_vec();
        if label == "paper" {
            // The paper's step is a tenth of the relaxation time.
            set.push("cfl=0.0305");
            if lab.quick() {
                continue;
            }
        }
        let seen = run(lab, across, &set)?;
        let label = match label {
            "plain" => "plain",
            _ => "mirrored, relaxation (52)",
        };
        rows.push(row("1/20", label, &seen));
    }
    section.table(
        "The mean profile",
        &[
            "dr",
            "walls",
            "largest error, m/s",
            "at 8 s",
            "turning of the distortion, rad/s",
            "open balance, of the work",
        ],
        rows,
    );
    order(lab, &mut section, &convergence)?;
    lab.figure(&mut section, "couette-profile", &profiles.svg(), "")?;
    section.note(
        "The profile does not contain the viscosity: the paper's relaxation shows here only in how \
         fast the flow settles.",
    );
    Ok(section)
}

fn row(spacing: &str, walls: &str, seen: &Seen) -> Vec<String> {
    vec![
        spacing.to_owned(),
        walls.to_owned(),
        format!("{:.4}", seen.errors[0]),
        format!("{:.4}", seen.errors[1]),
        format!("{:.3}", seen.turn),
        format!("{:.1e}", seen.balance),
    ]
}

/// What is asked of the run with 20 particles across.
fn checks(section: &mut Section, seen: &Seen) {
    section.check(
        "dr = 1/20: largest error of the mean profile",
        format!("{:.4} m/s", seen.errors[0]),
        "",
        "at most 0.02",
        seen.errors[0] <= 0.02,
    );
    section.check(
        "the distortion turns by half the vorticity",
        format!("{:.3} rad/s", seen.turn),
        "",
        "-4/3 within 2 %",
        (seen.turn / TURN - 1.0).abs() <= 0.02,
    );
    section.check(
        "energies and heat less the work of the cylinder, over the work",
        format!("{:.1e}", seen.balance),
        "",
        "at most 5e-3",
        seen.balance.abs() <= 5e-3,
    );
}

/// Fig. 10, left.
fn order(lab: &Lab<'_>, section: &mut Section, errors: &[[f64; 2]]) -> Result<(), LabError> {
    let logs = errors.iter().map(|[dr, e]| [dr.ln(), e.ln()]);
    let order = slope(logs).unwrap_or(f64::NAN);
    section.check(
        "order of the error in the spacing",
        format!("{order:.2}"),
        "not monotonic",
        "at least 0.7",
        order >= 0.7,
    );
    let chart = Chart {
        title: "Fig. 10: largest error of the mean profile".to_owned(),
        x_label: "dr / m".to_owned(),
        y_label: "error / (m/s)".to_owned(),
        x_log: true,
        y_log: true,
        series: vec![svg::styled("", 0, Style::LineDots, errors.iter().copied())],
        ..Chart::default()
    };
    lab.figure(section, "couette-convergence", &chart.svg(), "")
}
