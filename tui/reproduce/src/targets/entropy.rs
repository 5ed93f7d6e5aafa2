//! Fig. 6: the speeds at 2 s, and the entropy out and back.

use super::{dam_break, same_way_back};
use crate::lab::{Lab, LabError};
use crate::section::Section;
use crate::svg::{self, Chart, Style};
use loschmidt_core::observe::{BINS, SpeedHistogram};
use loschmidt_runner::SavedState;

/// Speeds of the fluid, sorted, m/s.
fn speeds(state: &SavedState) -> Vec<f64> {
    let speed = |n| {
        let v = state.velocity(n);
        (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
    };
    let mut speeds: Vec<f64> = (0..state.id.len()).map(speed).collect();
    speeds.sort_by(f64::total_cmp);
    speeds
}

/// The run's own histogram: 100 bins up to c/6.
fn histogram(speeds: &[f64], sound_speed: f64) -> SpeedHistogram {
    let bin_width = sound_speed / (6.0 * BINS as f64);
    let mut counts = [0; BINS];
    let mut beyond = 0;
    for v in speeds {
        let bin = (v / bin_width) as usize;
        beyond += u32::from(bin >= BINS);
        counts[bin.min(BINS - 1)] += 1;
    }
    let square: f64 = speeds.iter().map(|v| v * v).sum();
    SpeedHistogram {
        dimension: 2,
        bin_width,
        counts,
        beyond,
        temperature_of_energy: square / (2.0 * speeds.len().max(1) as f64),
    }
}

/// Largest distance of the distribution of the sorted speeds from that of kT/m, and the speed
/// there.
fn kolmogorov_smirnov(speeds: &[f64], temperature: f64) -> f64 {
    let n = speeds.len() as f64;
    speeds.iter().enumerate().fold(0.0, |largest: f64, (k, v)| {
        let expected = 1.0 - libm::exp(-0.5 * v * v / temperature);
        let (below, above) = (k as f64 / n, (k + 1) as f64 / n);
        largest
            .max((expected - below).abs())
            .max((above - expected).abs())
    })
}

pub fn fig6(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let past = dam_break(lab)?;
    let mut section = Section::new(
        "Fig. 6: the second law, and back",
        format!(
            "The dam break of Table 1 with a spacing of {} m, turned at 2 s; 100 bins of the speed up to c/6 = 20 m/s, fixed for the whole run.",
            past.scene.particle_spacing
        ),
    );
    let speeds = speeds(&past.state("turnaround")?);
    let histogram = histogram(&speeds, past.scene.sound_speed());
    let entropy = histogram.entropy();
    if let (Some(of_energy), Some(of_fit), Some(temperature)) = (
        histogram.equilibrium_of_energy(),
        histogram.equilibrium_of_fit(),
        histogram.fitted_temperature(),
    ) {
        section.check(
            "entropy at 2 s",
            format!("{entropy:.4}"),
            "close to S_eq(E)",
            &format!("within 0.15 of S_eq(E) = {of_energy:.4}"),
            (entropy - of_energy).abs() <= 0.15,
        );
        section.measure("S_eq of the fitted temperature", format!("{of_fit:.4}"), "");
        section.measure("fitted kT/m", format!("{temperature:.4} m²/s²"), "");
        let ks = kolmogorov_smirnov(&speeds, temperature);
        section.measure(
            "Kolmogorov-Smirnov distance of the speeds to the fit",
            format!("{ks:.4}"),
            "",
        );
        let ks = kolmogorov_smirnov(&speeds, histogram.temperature_of_energy);
        section.measure(
            "the same to the Maxwellian of the energy",
            format!("{ks:.4}"),
            "",
        );
        let points = |f: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
            (0..BINS / 2)
                .map(|k| [histogram.midpoint(k), f(k)])
                .collect()
        };
        let chart = Chart {
            title: "Fig. 6, left: speeds at t = 2 s".to_owned(),
            x_label: "v, m/s".to_owned(),
            y_label: "f(v), s/m".to_owned(),
            y_range: Some([
                0.0,
                1.15 * points(&|k| histogram.density(k))
                    .iter()
                    .fold(0.0, |m: f64, p| m.max(p[1])),
            ]),
            series: vec![
                svg::styled(
                    "particles",
                    5,
                    Style::Bars,
                    points(&|k| histogram.density(k)).into_iter(),
                ),
                svg::line(
                    "Maxwell-Boltzmann (19), fitted",
                    1,
                    points(&|k| histogram.maxwell_boltzmann(temperature, histogram.midpoint(k)))
                        .into_iter(),
                ),
            ],
            ..Chart::default()
        };
        lab.figure(&mut section, "fig6-left", &chart.svg(), "The speeds of the particles just before time is turned, and the Maxwell-Boltzmann distribution fitted to them.")?;
    }
    let same = same_way_back(&past);
    section.check(
        "the two branches",
        if same { "equal, bit for bit" } else { "differ" },
        "coincide",
        "equal, bit for bit",
        same,
    );
    section.check(
        "the last state",
        if past.returned == Some(true) {
            "is the first, bit for bit"
        } else {
            "is another"
        },
        "returns",
        "is the first",
        past.returned == Some(true),
    );
    let moving = |row: &&loschmidt_runner::run::Row| row.time_s > 0.0;
    let chart = Chart {
        title: "Fig. 6, right: entropy, out and back".to_owned(),
        x_label: "t, s".to_owned(),
        y_label: "reduced Boltzmann entropy".to_owned(),
        series: vec![
            // The way back lies on the way out, and the equilibria nearly on one another.
            svg::styled(
                "out",
                0,
                Style::Broad,
                past.out().map(|row| [row.time_s, row.entropy]),
            ),
            svg::styled(
                "back",
                1,
                Style::Dashed,
                past.back().map(|row| [row.time_s, row.entropy]),
            ),
            svg::styled(
                "equilibrium of the energy (21)",
                2,
                Style::DashDotted,
                past.out()
                    .filter(moving)
                    .filter_map(|row| Some([row.time_s, row.equilibrium_entropy_of_energy?])),
            ),
            svg::styled(
                "equilibrium of the fit (20)",
                6,
                Style::Dotted,
                past.out()
                    .filter(moving)
                    .filter_map(|row| Some([row.time_s, row.equilibrium_entropy_of_fit?])),
            ),
        ],
        y_range: Some([-4.2, 4.0]),
        ..Chart::default()
    };
    lab.figure(&mut section, "fig6-right", &chart.svg(), "The entropy climbs to its equilibrium on the way out and comes down again on the way back, through the same values.")?;
    Ok(section)
}

#[cfg(test)]
mod tests {
    use super::{histogram, kolmogorov_smirnov};

    /// Quantiles of the Maxwellian of kT/m = 4 m²/s².
    fn quantiles(n: usize) -> Vec<f64> {
        let quantile = |k: usize| {
            let p = (k as f64 + 0.5) / n as f64;
            libm::sqrt(-8.0 * libm::log(1.0 - p))
        };
        (0..n).map(quantile).collect()
    }

    #[test]
    fn quantiles_of_a_maxwellian_lie_half_a_step_from_it() {
        let speeds = quantiles(1000);
        let distance = kolmogorov_smirnov(&speeds, 4.0);
        assert!((distance - 0.0005).abs() < 1e-9, "{distance}");
        assert!(kolmogorov_smirnov(&speeds, 5.0) > 0.05);
    }

    #[test]
    fn a_histogram_of_them_has_their_temperature_and_entropy() {
        let histogram = histogram(&quantiles(10_000), 120.0);
        assert_eq!(histogram.beyond, 0);
        assert!((histogram.temperature_of_energy / 4.0 - 1.0).abs() < 0.01);
        let equilibrium = histogram.equilibrium_of_energy().expect("motion");
        assert!((histogram.entropy() - equilibrium).abs() < 0.02);
    }
}
