//! Second sound in superfluid helium: Figs. 5 and 6 of the third paper.
//!
//! - ε_1 = max over time of the root mean square of s - s_exact, over A s0      (27, with its 1/N)
//! - ε_2 = max over time of |E - E(0)|, over the energy of the wave             (28)
//!
//! The paper refers ε_2 to a total that contains T0 s0 of every particle, beside which the wave is
//! small; here it is the wave that counts. Speeds are read off where the amplitude of the standing
//! wave passes through zero for the first time.

use super::slope;
use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use crate::svg::{self, Chart, Style};
use loschmidt_runner::Player;
use std::f64::consts::PI;

/// L, m.
const LENGTH: f64 = 0.01;
/// Looks at a period.
const LOOKS: u64 = 200;

/// What is run.
#[derive(Clone, Copy)]
struct Wave {
    /// N, particles across.
    across: u32,
    /// M: a time step is h/(M u_1).
    steps: f64,
    /// A.
    amplitude: f64,
    operators: &'static str,
    model: &'static str,
}

/// The wave of the paper's figures with the reversible scheme.
const WAVE: Wave = Wave {
    across: 50,
    steps: 20.0,
    amplitude: 0.01,
    operators: "renormalised",
    model: "superfluid",
};

/// What was seen of a run.
struct Seen {
    /// ε_1.
    entropy_error: f64,
    /// ε_2.
    energy_error: f64,
    /// Speed of second sound over u_2.
    speed: f64,
    /// The entropy at x = y = L/4, as (s - s0)/(A s0), in time.
    probe: Vec<[f64; 2]>,
    /// L √2/u_2, s.
    period: f64,
    /// Whether the last state is the first after as many steps back; where that was asked.
    returned: Option<bool>,
}

fn shape(x: &[f64; 3]) -> f64 {
    (PI * x[0] / LENGTH).sin() * (PI * x[1] / LENGTH).sin()
}

/// A look at the wave: its amplitude, its root mean square distance from a standing one of
/// amplitude `exact`, and its value near x = y = L/4; all over A s0.
fn look(player: &mut Player, wave: &Wave, exact: f64) -> Result<[f64; 3], LabError> {
    let spacing = player.scene().particle_spacing;
    let helium = player.scene().superfluid.map(|it| it.helium());
    let reference = helium.map_or(f64::NAN, |helium| helium.entropy);
    let frame = player.frame()?;
    let column = frame.columns.iter().find(|c| c.measure.name == "entropy");
    let entropies = column.map_or(&[][..], |column| &column.values);
    let (mut product, mut square, mut error) = (0.0, 0.0, 0.0);
    let mut near = [0.0; 2];
    for (x, s) in frame.position.iter().zip(entropies) {
        let (p, s) = (shape(x), (s - reference) / (wave.amplitude * reference));
        product += p * s;
        square += p * p;
        error += (s - exact * p) * (s - exact * p);
        let away = (x[0] - 0.25 * LENGTH).hypot(x[1] - 0.25 * LENGTH) / (2.0 * spacing);
        let weight = (1.0 - away * away).max(0.0);
        near = [near[0] + weight * s, near[1] + weight];
    }
    let count = entropies.len() as f64;
    Ok([product / square, (error / count).sqrt(), near[0] / near[1]])
}

/// One period of a wave, and back where that is asked for.
fn run(lab: &mut Lab<'_>, wave: &Wave, back: bool) -> Result<Seen, LabError> {
    let set = [
        format!("particle_spacing={}", LENGTH / f64::from(wave.across)),
        // The support is twice the paper's h.
        format!("cfl={}", 0.5 / wave.steps),
        format!("region.0.entropy.wave={}", wave.amplitude),
        format!("superfluid.operators={}", wave.operators),
        format!("model={}", wave.model),
    ];
    let options = lab.options();
    let mut player = lab.player(&scene("second-sound", &set)?, options)?;
    let helium = player.scene().superfluid.map(|it| it.helium());
    let period = 2f64.sqrt() * LENGTH / helium.map_or(f64::NAN, |helium| helium.second_sound());
    let name = format!(
        "{}, {}, N = {}, M = {}, A = {}",
        wave.model, wave.operators, wave.across, wave.steps, wave.amplitude
    );
    let steps = (period / player.scene().time_step()).round() as u64;
    let first = player.measure()?.energies.total();
    let mut seen = Seen {
        entropy_error: 0.0,
        energy_error: 0.0,
        speed: f64::NAN,
        probe: Vec::new(),
        period,
        returned: None,
    };
    let (mut before, mut taken) = ([0.0, 1.0], 0);
    for n in 1..=LOOKS {
        let next = steps * n / LOOKS;
        lab.advance(&name, &mut player, next - taken)?;
        taken = next;
        let time = player.time();
        let [amplitude, error, near] = look(&mut player, wave, (2.0 * PI * time / period).cos())?;
        let energy = player.measure()?.energies.total();
        seen.entropy_error = seen.entropy_error.max(error);
        seen.energy_error = seen.energy_error.max((energy - first).abs() / first);
        seen.probe.push([time, near]);
        if seen.speed.is_nan() && amplitude < 0.0 {
            let zero = before[0] + (time - before[0]) * before[1] / (before[1] - amplitude);
            seen.speed = 0.25 * period / zero;
        }
        before = [time, amplitude];
    }
    if back {
        player.turn();
        lab.advance(&format!("{name}, back"), &mut player, steps)?;
        player.turn();
        seen.returned = Some(player.compare_with_home().is_exact());
    }
    Ok(seen)
}

pub fn sound(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Superfluid helium, Figs. 5 and 6: second sound",
        "Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III B: a standing wave \
         of second sound at 1.9 K on a square of 1 cm with free surfaces, on Vogel's spiral, h = 3 dr, \
         one period. The domain lies around the origin, the entropy of the paper's scheme advances by \
         dt, and both errors are referred to the wave.",
    );
    resolution(lab, &mut section)?;
    time_steps(lab, &mut section)?;
    section.note(
        "Both operators are right inside; what is slow is the wave at the free surface, where the \
         paper's simple gradient lacks half of its neighbours. Its speed is low by about h/L.",
    );
    Ok(section)
}

/// ε_1, the speed and Fig. 6 over the resolution, with both operators.
fn resolution(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let sizes: &[u32] = lab.size(&[25, 50], &[25, 50, 100, 200, 300]);
    let mut rows = Vec::new();
    let mut convergence = [Vec::new(), Vec::new()];
    let mut probe = Chart {
        title: "Fig. 6: entropy at x = y = L/4".to_owned(),
        x_label: "t / ms".to_owned(),
        y_label: "(s - s0)/(A s0)".to_owned(),
        ..Chart::default()
    };
    let mut finest = [f64::NAN; 2];
    for (o, operators) in ["renormalised", "paper"].into_iter().enumerate() {
        for &across in sizes {
            let finest_of_all = across == 300;
            let wave = Wave {
                across,
                operators,
                steps: if finest_of_all { 50.0 } else { WAVE.steps },
                ..WAVE
            };
            let of_checks = across == 50 && o == 0;
            let seen = run(lab, &wave, of_checks)?;
            if of_checks {
                checks(section, &seen);
            }
            rows.push(vec![
                operators.to_owned(),
                across.to_string(),
                format!("{}", wave.steps),
                format!("{:.4}", seen.speed),
                format!("{:.4}", seen.entropy_error),
                format!("{:.1e}", seen.energy_error),
            ]);
            convergence[o].push([f64::from(across), seen.entropy_error]);
            finest[o] = seen.entropy_error;
            if Some(&across) == sizes.last() {
                let curve = seen.probe.iter().map(|[t, s]| [1e3 * t, *s]);
                let label = format!("{operators}, N = {across}");
                probe.series.push(svg::line(&label, o, curve));
                if o == 1 {
                    let exact = seen.probe.iter().map(|[t, _]| {
                        let s = 0.5 * (2.0 * PI * t / seen.period).cos();
                        [1e3 * t, s]
                    });
                    probe
                        .series
                        .push(svg::styled("(25)", 2, Style::Dashed, exact));
                }
            }
        }
    }
    section.table(
        "A = 0.01, the reversible scheme",
        &["operators", "N", "M", "speed over u_2", "ε_1", "ε_2"],
        rows,
    );
    section.check_at_full_size(
        lab.quick(),
        "renormalised operators, finest resolution: ε_1",
        format!("{:.4}", finest[0]),
        "the paper's: satisfactory, below 0.01",
        "below 0.01",
        finest[0] < 0.01,
    );
    section.measure(
        "the paper's operators, finest resolution: ε_1",
        format!("{:.4}", finest[1]),
        "below 0.01",
    );
    let chart = Chart {
        title: "Fig. 5, left: error of the entropy".to_owned(),
        x_label: "N".to_owned(),
        y_label: "ε_1".to_owned(),
        x_log: true,
        y_log: true,
        series: ["renormalised", "paper"]
            .into_iter()
            .zip(convergence)
            .enumerate()
            .map(|(n, (name, points))| svg::styled(name, n, Style::LineDots, points.into_iter()))
            .collect(),
        ..Chart::default()
    };
    lab.figure(section, "sound-resolution", &chart.svg(), "")?;
    lab.figure(
        section,
        "sound-probe",
        &probe.svg(),
        "Means over two spacings around the place.",
    )
}

fn checks(section: &mut Section, seen: &Seen) {
    section.check(
        "N = 50, M = 20: every bit of the last state equals the first",
        if seen.returned == Some(true) {
            "yes"
        } else {
            "no"
        },
        "not done before",
        "yes",
        seen.returned == Some(true),
    );
    section.check(
        "N = 50, M = 20: ε_2",
        format!("{:.1e}", seen.energy_error),
        "",
        "at most 1e-8",
        seen.energy_error <= 1e-8,
    );
    section.check(
        "N = 50, renormalised operators: speed of second sound over u_2",
        format!("{:.4}", seen.speed),
        "",
        "within 2 %",
        (seen.speed - 1.0).abs() <= 0.02,
    );
}

/// ε_2 over the time step, with both integrators.
fn time_steps(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let across = lab.size(25, 50);
    let mut chart = Chart {
        title: format!("Fig. 5, right: error of the energy, N = {across}"),
        x_label: "M".to_owned(),
        y_label: "ε_2".to_owned(),
        x_log: true,
        y_log: true,
        ..Chart::default()
    };
    let mut rows = Vec::new();
    let models = [("superfluid", "reversible"), ("superfluid-paper", "paper")];
    for (n, (model, name)) in models.into_iter().enumerate() {
        for (k, amplitude) in [0.01, 0.05].into_iter().enumerate() {
            let mut points = Vec::new();
            for steps in [5.0, 10.0, 20.0] {
                let wave = Wave {
                    across,
                    steps,
                    amplitude,
                    model,
                    operators: "paper",
                };
                points.push([steps, run(lab, &wave, false)?.energy_error]);
            }
            let logs = points.iter().map(|[m, e]| [m.ln(), e.ln()]);
            let order = -slope(logs).unwrap_or(f64::NAN);
            let mut row = vec![name.to_owned(), amplitude.to_string()];
            row.extend(points.iter().map(|[_, e]| format!("{e:.1e}")));
            row.push(format!("{order:.2}"));
            rows.push(row);
            if (n, k) == (0, 0) {
                section.check(
                    "A = 0.01, the reversible scheme: order of ε_2 in the time step",
                    format!("{order:.2}"),
                    "",
                    "2 within 0.5",
                    (order - 2.0).abs() <= 0.5,
                );
            }
            let label = format!("{name}, A = {amplitude}");
            let points = points.into_iter();
            let series = svg::styled(&label, 2 * n + k, Style::LineDots, points);
            chart.series.push(series);
        }
    }
    section.table(
        "ε_2 with the paper's operators",
        &["integrator", "A", "M = 5", "10", "20", "order"],
        rows,
    );
    lab.figure(
        section,
        "sound-energy",
        &chart.svg(),
        "Both integrators, the same operators and time steps.",
    )
}
