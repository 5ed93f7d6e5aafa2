//! The lid-driven cavity with the normal component of helium alone: Figs. 1 to 4 of the paper on
//! superfluid helium.

use super::cavity::{Fluid, HEAD, Seen, Setting, convergence, lines, row, run};
use crate::lab::{Lab, LabError};
use crate::section::Section;
use crate::svg::{self, Chart, Style};

/// The normal component of helium alone.
const NORMAL: Fluid = Fluid {
    scene: "normal-cavity",
    viscosity: "superfluid.viscosity",
};

/// Figs. 1 to 4 of the paper on superfluid helium: the same box, with the normal component alone.
pub fn normal_cavity(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Superfluid helium, Figs. 1 to 4: the lid-driven cavity",
        "Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III A: the two-fluid \
         model without a superfluid component, in a box of 1 m under a lid of 1 m/s, against the \
         velocities along the middle lines of Ghia, Ghia & Shin, J. Comput. Phys. 48 (1982) 387. h = \
         3 dr, dummy walls six deep. Velocities are means over the last 0.3 of the run (10 s at Re \
         100, 20 s at 400; the paper: 40 s).",
    );
    let sizes: [&[u32]; 2] = lab.size([&[20, 40], &[]], [&[42, 84, 168], &[42, 84, 168]]);
    let slopes = ["0.998", "1.189"];
    let (mut rows, mut speeds, mut curves) = (Vec::new(), Vec::new(), Vec::new());
    for (n, (reynolds, end)) in [(100, 10.0), (400, 20.0)].into_iter().enumerate() {
        let (mut errors, mut runs) = (Vec::new(), Vec::new());
        for &across in sizes[n] {
            let setting = Setting {
                fluid: NORMAL,
                reynolds,
                across,
                end,
                // With the scene's 0.1 the distances are the same to the third digit.
                set: &["cfl=0.4"],
            };
            let seen = run(lab, setting)?;
            rows.push(row(setting, "dummies", &seen));
            let largest = seen.largest[0].max(seen.largest[1]);
            errors.push([1.0 / f64::from(across), largest]);
            runs.push((across, seen));
        }
        if errors.is_empty() {
            continue;
        }
        let paper = format!("{} for N from 24 to 336", slopes[n]);
        convergence(&mut section, reynolds, &errors, &paper);
        let figure = ["Fig. 1", "Fig. 2"][n];
        lines(
            lab,
            &mut section,
            ["normal-cavity", figure],
            reynolds,
            &runs,
        )?;
        let label = format!("Re {reynolds}");
        let points = errors.iter().map(|[dr, e]| [1.0 / dr, *e]);
        curves.push(svg::styled(&label, n, Style::LineDots, points));
        if let Some((_, finest)) = runs.pop() {
            balance(&mut section, reynolds, &finest);
            let title = format!("Fig. 3: streamlines, Re {reynolds}");
            let svg = streamlines(title, &finest.streamlines);
            lab.figure(
                &mut section,
                &format!("normal-cavity-{reynolds}-lines"),
                &svg,
                "",
            )?;
            speeds.push(finest.speed);
        }
    }
    section.table("Distance from the reference, m/s", &HEAD, rows);
    let chart = Chart {
        title: "Fig. 4: largest distance from the reference".to_owned(),
        x_label: "N".to_owned(),
        y_label: "m/s".to_owned(),
        x_log: true,
        y_log: true,
        series: curves,
        ..Chart::default()
    };
    lab.figure(&mut section, "normal-cavity-convergence", &chart.svg(), "")?;
    let svg = svg::fields(&speeds, 2, 300.0);
    lab.figure(
        &mut section,
        "normal-cavity-speed",
        &svg,
        "Speed at the end.",
    )?;
    Ok(section)
}

fn balance(section: &mut Section, reynolds: u32, seen: &Seen) {
    section.check(
        &format!("Re {reynolds}: energies and heat less the work of the lid, over the work"),
        format!("{:.1e}", seen.budget.error),
        "",
        "at most 5e-3",
        seen.budget.error.abs() <= 5e-3,
    );
}

/// Streamlines in the box.
fn streamlines(title: String, lines: &[Vec<[f64; 2]>]) -> String {
    let chart = Chart {
        title,
        x_label: "x / m".to_owned(),
        y_label: "y / m".to_owned(),
        x_range: Some([0.0, 1.0]),
        y_range: Some([0.0, 1.0]),
        series: lines
            .iter()
            .map(|line| svg::line("", 0, line.iter().copied()))
            .collect(),
        ..Chart::default()
    };
    chart.svg()
}
