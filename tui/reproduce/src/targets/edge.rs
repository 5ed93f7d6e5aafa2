//! Fig. 4: the leading edge of the dam break against experiment and simulation.

use crate::lab::{Lab, LabError, Past, scene};
use crate::reference::{self, distance};
use crate::section::Section;
use crate::svg::{self, Chart, Style};
use loschmidt_runner::ArithmeticKind;

/// X(T) of a run: column 1 m wide, T = t (2 g/l)^(1/2).
pub fn edge(past: &Past) -> Vec<[f64; 2]> {
    let g = past.scene.gravity.uniform[1].abs();
    // The edge of the water is half a spacing beyond its outermost particle.
    let half = 0.5 * past.scene.particle_spacing;
    let rows = past.out();
    rows.map(|row| [row.time_s * (2.0 * g).sqrt(), row.front_m + half])
        .collect()
}

pub fn fig4(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let spacings = lab.size(["0.04", "0.02"], ["0.02", "0.01"]);
    let mut section = Section::new(
        "Fig. 4: the leading edge",
        "Table 1 one way to T = 3.05, with the constants C_a and with the corrected initial state; T = t √(2g/l), X = edge/l, the edge half a spacing beyond the outermost particle.",
    );
    let (experiment, violeau) = (reference::koshizuka_oka(), reference::violeau());
    // Violeau's own distance from the experiment, which ours is measured by.
    let (of_violeau, _) = distance(&violeau, &experiment);
    let mut chart = Chart {
        title: "Fig. 4: leading edge".to_owned(),
        x_label: "T = t √(2g/l)".to_owned(),
        y_label: "X = edge / l".to_owned(),
        series: vec![
            svg::styled(
                "experiment (Koshizuka & Oka 1996)",
                6,
                Style::Dots,
                experiment.iter().copied(),
            ),
            svg::styled(
                "simulation (Violeau 2012)",
                2,
                Style::Dashed,
                violeau.iter().copied(),
            ),
        ],
        ..Chart::default()
    };
    let mut rows = Vec::new();
    for (k, spacing) in spacings.iter().enumerate() {
        for (c, (correction, label)) in [("constant", "C_a"), ("isc", "ISC")].iter().enumerate() {
            let set = [
                format!("particle_spacing={spacing}"),
                format!("density_correction={correction}"),
                "turnaround=".to_owned(),
                "end=0.689".to_owned(),
                "output.frames=0".to_owned(),
            ];
            let name = format!("fig4-{correction}-{spacing}");
            let past = lab.run(&name, scene("dam-break", &set)?, ArithmeticKind::Fixed)?;
            let curve = edge(&past);
            let (to_violeau, mean) = distance(&curve, &violeau);
            let (to_experiment, mean_experiment) = distance(&curve, &experiment);
            let way = |mean: f64| if mean > 0.0 { "ahead" } else { "behind" };
            rows.push(vec![
                (*label).to_owned(),
                (*spacing).to_owned(),
                format!("{to_violeau:.3}"),
                format!("{:.3} {}", mean.abs(), way(mean)),
                format!("{to_experiment:.3}"),
                format!("{:.3} {}", mean_experiment.abs(), way(mean_experiment)),
            ]);
            if k == 1 {
                let what = format!("{label}, {spacing} m");
                section.check_at_full_size(
                    lab.quick(),
                    &format!("{what}: rms distance to Violeau"),
                    format!("{to_violeau:.3}"),
                    "close",
                    "at most 0.12",
                    to_violeau <= 0.12,
                );
                section.check_at_full_size(
                    lab.quick(),
                    &format!("{what}: rms distance to the experiment"),
                    format!("{to_experiment:.3}"),
                    &format!("Violeau's own: {of_violeau:.3}"),
                    &format!("at most {:.3}", of_violeau + 0.05),
                    to_experiment <= of_violeau + 0.05,
                );
                chart
                    .series
                    .push(svg::line(&format!("ours, {what}"), c, curve.into_iter()));
            }
        }
    }
    section.table(
        "Distance of X(T) from the published curves",
        &[
            "correction",
            "spacing, m",
            "rms to Violeau",
            "mean",
            "rms to experiment",
            "mean",
        ],
        rows,
    );
    section.note("The water runs ahead of the experiment, as Violeau's does: there is neither friction at the floor nor a gate that has to be pulled up, and the edge is the foremost particle, not the foremost layer.");
    lab.figure(
        &mut section,
        "fig4",
        &chart.svg(),
        "The caption of the paper's figure has lost the 2 of T = t √(2g/l).",
    )?;
    Ok(section)
}
