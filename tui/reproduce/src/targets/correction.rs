//! Fig. 1: the initial state correction on squares.

use crate::lab::{Lab, LabError};
use crate::section::Section;
use crate::svg::{self, Chart, Field, Style};
use loschmidt_runner::isc::{Convergence, CorrectionSettings, correct};
use std::time::Instant;

/// Columns and rows of particles.
const SIZES: [[usize; 2]; 3] = [[50, 50], [100, 100], [200, 400]];

struct Corrected {
    report: Convergence,
    seconds: f64,
    /// Positions and relative densities before every step and at the end.
    stages: Vec<(Vec<[f64; 2]>, Vec<f64>)>,
}

fn corrected([columns, rows]: [usize; 2]) -> Option<Corrected> {
    let spacing = 1.0 / columns as f64;
    let at = |i: usize| (i as f64 + 0.5) * spacing;
    let mut fluid: Vec<[f64; 2]> = (0..columns * rows)
        .map(|n| [at(n % columns), at(n / columns)])
        .collect();
    let settings =
        CorrectionSettings::new(spacing, 3.0 * spacing, 1000.0 * spacing * spacing, 1000.0);
    let mut stages = Vec::new();
    let began = Instant::now();
    let report = correct(&mut fluid, &settings, |x, rho| {
        if columns == SIZES[0][0] {
            let relative = rho.iter().map(|rho| rho / 1000.0).collect();
            stages.push((x.to_vec(), relative));
        }
    });
    Some(Corrected {
        report: report.ok()?,
        seconds: began.elapsed().as_secs_f64(),
        stages,
    })
}

pub fn fig1(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Fig. 1: initial state correction",
        "Squares and a column of particles on a square lattice, support 3 spacings, disturbed by up to a tenth of a spacing; Newton with conjugate gradients on the Schur complement, to 1e-10.",
    );
    let sizes = lab.size(&SIZES[..2], &SIZES[..]);
    let mut rows = Vec::new();
    let mut chart = Chart {
        title: "Convergence".to_owned(),
        x_label: "Newton step".to_owned(),
        y_label: "largest |ρ − ρ_0| / ρ_0".to_owned(),
        y_log: true,
        ..Chart::default()
    };
    for (k, &size) in sizes.iter().enumerate() {
        lab.check()?;
        let name = format!("{} x {}", size[0], size[1]);
        lab.say(&format!("  {name}"));
        let Some(done) = lab.set_up(move || corrected(size))? else {
            section.check(&name, "did not converge", "7 steps", "converges", false);
            continue;
        };
        let steps = done.report.steps.len();
        let inner: usize = done.report.steps.iter().map(|s| s.iterations).sum();
        rows.push(vec![
            name.clone(),
            (size[0] * size[1]).to_string(),
            steps.to_string(),
            inner.to_string(),
            format!("{:.1}", done.seconds),
            format!("{:.1e}", done.report.error),
            format!("{:.2}", done.report.displacement * size[0] as f64),
        ]);
        let errors = done.report.steps.iter().map(|s| s.error);
        let errors = errors.chain([done.report.error]).enumerate();
        chart.series.push(svg::styled(
            &name,
            k,
            Style::LineDots,
            errors.map(|(n, e)| [n as f64, e]),
        ));
        if k == 0 {
            let holds = (7..=9).contains(&steps) && done.report.error <= 1e-10;
            let ours = format!("{steps} to {:.1e}", done.report.error);
            section.check(
                "Newton steps on the square",
                ours,
                "7 to 1e-10",
                "7 to 9 to 1e-10",
                holds,
            );
            lab.figure(&mut section, "fig1", &pictures(&done), "The square of 50 x 50 particles before and after the correction, coloured by the density (4). The paper's square needed 7 iterations.")?;
        }
        if size == SIZES[2] {
            let ours = format!("{:.1} s", done.seconds);
            section.check(
                "80,000 particles",
                ours,
                "",
                "under a minute on 2 cores",
                done.seconds < 60.0,
            );
        }
    }
    section.table(
        "The correction by size",
        &[
            "square",
            "particles",
            "Newton steps",
            "CG iterations",
            "seconds",
            "final error",
            "farthest moved, spacings",
        ],
        rows,
    );
    lab.figure(
        &mut section,
        "fig1-convergence",
        &chart.svg(),
        "The error falls quadratically once the surface has found its place.",
    )?;
    Ok(section)
}

fn pictures(done: &Corrected) -> String {
    let picture = |n: usize, title: String| {
        let (points, values) = done.stages[n].clone();
        Field {
            title,
            bounds: [[-0.03, -0.03], [1.03, 1.03]],
            diameter: 0.02,
            points,
            values,
            range: [0.5, 1.05],
            label: "density over ρ_0".to_owned(),
            walls: Vec::new(),
        }
    };
    let last = done.stages.len() - 1;
    svg::fields(
        &[
            picture(0, "disturbed lattice".to_owned()),
            picture(2.min(last), "after 2 steps".to_owned()),
            picture(last, format!("after {last} steps")),
        ],
        3,
        300.0,
    )
}
