//! The twisting column: Figs. 5 to 7 of the paper on solids.

use super::budget_chart;
use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use crate::svg::{self, Chart};
use loschmidt_runner::Player;
use std::f64::consts::PI;

/// Height, m.
const HEIGHT: f64 = 6.0;

/// c_0 of the rubber, m/s, and its square plus 4/3 of the square of c_s, m²/s².
const SPEED: f64 = 715.3361;
const STEP_SPEED_SQUARED: f64 = SPEED * SPEED + 4.0 / 3.0 * 71.89398 * 71.89398;

/// Twist of the top and energies in time.
#[derive(Clone, Debug, Default)]
struct Seen {
    /// Time in s and angle in degrees.
    twist: Vec<[f64; 2]>,
    /// Time in s and kinetic, elastic and penalty energy over the kinetic energy at the start.
    energies: [Vec<[f64; 2]>; 3],
    /// Largest energy error up to 0.1 s, of the kinetic energy at the start.
    error: f64,
}

impl Seen {
    /// The largest twist, with its time.
    fn largest(&self) -> [f64; 2] {
        let start = [0.0; 2];
        let twists = self.twist.iter().copied();
        twists.fold(start, |most, now| if now[1] > most[1] { now } else { most })
    }

    /// When the twist is gone again.
    fn untwisted(&self) -> Option<f64> {
        let [turn, _] = self.largest();
        let pairs = self.twist.windows(2);
        let mut through = pairs.filter(|p| p[0][0] > turn && p[0][1] > 0.0 && p[1][1] <= 0.0);
        through.next().map(|pair| {
            let [[t, a], [u, b]] = [pair[0], pair[1]];
            t + (u - t) * a / (a - b)
        })
    }
}

/// The mean angle by which the top has turned since the last look, degrees.
fn turned(player: &mut Player, top: &[usize], angles: &mut [f64]) -> f64 {
    let state = player.save();
    let mut sum = 0.0;
    for (&n, last) in top.iter().zip(angles) {
        let [x, y, _] = state.position(n);
        let now = y.atan2(x);
        // The nearest of all angles that look alike: between two looks the top turns by little.
        let step = (now - *last + 3.0 * PI).rem_euclid(2.0 * PI) - PI;
        *last = now;
        sum -= step;
    }
    (sum / top.len().max(1) as f64).to_degrees()
}

fn twist(lab: &mut Lab<'_>, cells: u32, penalty: f64, courant: f64) -> Result<Seen, LabError> {
    let spacing = 1.0 / f64::from(cells) / 2.0_f64.cbrt();
    let half = 0.5 / f64::from(cells);
    let set = [
        format!("particle_spacing={spacing}"),
        format!("solid.penalty={penalty}"),
        format!("region.0.shape.box.max=[0.5, 0.5, {half}]"),
        format!("region.1.shape.box.min=[-0.5, -0.5, {half}]"),
        "cfl=".to_owned(),
        format!(
            "time_step={}",
            courant * spacing / STEP_SPEED_SQUARED.sqrt()
        ),
    ];
    let options = lab.options();
    let mut player = lab.player(&scene("twisting-column", &set)?, options)?;
    let home = player.home().clone();
    let top: Vec<usize> = (0..home.id.len())
        .filter(|&n| home.position(n)[2] > HEIGHT - 2.0 * half)
        .collect();
    let mut angles: Vec<f64> = top
        .iter()
        .map(|&n| home.position(n)[1].atan2(home.position(n)[0]))
        .collect();
    let first = player.measure()?.energies;
    let unit = first.get("kinetic");
    let (end, looks) = (0.22, 440);
    let steps = (end / player.scene().time_step()).round() as u64;
    let mut seen = Seen::default();
    let (mut taken, mut angle) = (0, 0.0);
    for look in 1..=looks {
        let next = steps * look / looks;
        lab.advance(&format!("column, {cells} cells"), &mut player, next - taken)?;
        taken = next;
        let t = player.time();
        angle += turned(&mut player, &top, &mut angles);
        seen.twist.push([t, angle]);
        let energies = player.measure()?.energies;
        let kinds = [
            energies.get("kinetic"),
            energies.get("bulk") + energies.get("shear"),
            energies.get("penalty"),
        ];
        for (curve, energy) in seen.energies.iter_mut().zip(kinds) {
            curve.push([t, energy / unit]);
        }
        if t <= 0.1 {
            seen.error = seen
                .error
                .max((energies.total() - first.total()).abs() / unit);
        }
    }
    Ok(seen)
}

pub fn column(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Solids, Figs. 5 to 7: the twisting column",
        "Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, section 4.2: a \
         rubber column of 1 m by 1 m by 6 m on a body-centred lattice, its lowest layer held. The \
         twist is that of the uppermost cell; the paper's penalty of ten times the bulk speed.",
    );
    let sizes: &[(u32, f64)] = lab.size(&[(4, 0.1)], &[(4, 0.05), (6, 0.05), (8, 0.1), (12, 0.1)]);
    let mut rows = Vec::new();
    let mut chart = Chart {
        title: "Twist of the top".to_owned(),
        x_label: "t / s".to_owned(),
        y_label: "angle / degrees".to_owned(),
        ..Chart::default()
    };
    for &(cells, courant) in sizes {
        let seen = twist(lab, cells, 10.0, courant)?;
        let [at, largest] = seen.largest();
        let back = seen.untwisted();
        rows.push(vec![
            cells.to_string(),
            format!("{courant}"),
            format!("{largest:.0}"),
            format!("{at:.4}"),
            back.map_or("-".to_owned(), |t| format!("{t:.4}")),
            format!("{:.1e}", seen.error),
        ]);
        let place = chart.series.len();
        let label = format!("{cells} cells across");
        chart
            .series
            .push(svg::line(&label, place, seen.twist.iter().copied()));
        if cells == 4 {
            section.check_at_full_size(
                lab.quick(),
                "4 cells across: error of the energy up to 0.1 s, of the kinetic energy at the start",
                format!("{:.1e} at a Courant number of {courant}", seen.error),
                "4e-7 at 0.05",
                "at most 4e-7",
                seen.error <= 4e-7,
            );
            section.check(
                "4 cells across: the column untwists",
                back.map_or("it does not".to_owned(), |t| format!("at {t:.3} s")),
                "it does (Fig. 7)",
                "between 0.19 and 0.22 s",
                back.is_some_and(|t| (0.19..0.22).contains(&t)),
            );
            budget(lab, &mut section, &seen)?;
        }
    }
    section.table(
        "Twist and return; a linear estimate (St-Venant) has 348 degrees at 0.091 s and 0.182 s",
        &[
            "cells across",
            "Courant number",
            "largest twist, degrees",
            "at, s",
            "back through zero, s",
            "energy error to 0.1 s",
        ],
        rows,
    );
    section.note(
        "The twist falls with the number of cells, towards the estimate from above: a coarse column \
         is too soft at its surface.",
    );
    lab.figure(
        &mut section,
        "column-twist",
        &chart.svg(),
        "The column turns by more than a whole turn, rests, and untwists.",
    )?;
    Ok(section)
}

/// Fig. 6.
fn budget(lab: &Lab<'_>, section: &mut Section, seen: &Seen) -> Result<(), LabError> {
    let chart = budget_chart("Fig. 6", "t / s", &seen.energies);
    lab.figure(
        section,
        "column-energies",
        &chart.svg(),
        "Four cells across.",
    )
}
