//! Beyond the paper: how a perturbation at the turnaround spoils the return.
//!
//! All coordinates are moved by ε quanta of 2^-46 m, up or down by the seeded toss of a coin, when
//! time is turned at t; the return error is the root mean square distance from home. A chaotic flow
//! makes it ε exp(λ t) until it saturates at the size of the box. λ is the Lyapunov exponent.

use super::slope;
use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use crate::svg::{self, Chart, Style};
use loschmidt_runner::{Player, SavedState};

/// Moves every coordinate by so many quanta, the signs from SplitMix64.
fn perturbed(state: &SavedState, quanta: i64) -> SavedState {
    let mut state = state.clone();
    let mut random: u64 = 1876;
    for word in &mut state.fields[0].words {
        random = random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = random;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        *word += if (z ^ (z >> 31)) & 1 == 0 {
            quanta
        } else {
            -quanta
        };
    }
    state
}

/// Root mean square distance of the particles from home, m.
fn distance(home: &SavedState, now: &SavedState) -> f64 {
    let square = |n| {
        let (a, b) = (home.position(n), now.position(n));
        (0..3).map(|d| (a[d] - b[d]).powi(2)).sum::<f64>()
    };
    let n = home.id.len();
    ((0..n).map(square).sum::<f64>() / n as f64).sqrt()
}

/// Goes back from a saved turnaround with a perturbation; returns the distance from home.
fn echo_error(
    lab: &mut Lab<'_>,
    player: &mut Player,
    turned: &SavedState,
    quanta: i64,
) -> Result<f64, LabError> {
    let position = turned.step as i64;
    player.restore(
        &perturbed(turned, quanta),
        position,
        loschmidt_runner::Arrow::Backward,
    )?;
    lab.advance("echo", player, turned.step)?;
    player.turn();
    let home = player.home().clone();
    Ok(distance(&home, &player.save()))
}

pub fn echo(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let spacing = lab.size("0.05", "0.02");
    let scene = scene("dam-break", &[format!("particle_spacing={spacing}")])?;
    let mut section = Section::new(
        "Beyond the paper: fidelity of the echo",
        format!(
            "The dam break with a spacing of {spacing} m. Time is turned at t, every coordinate is moved by ε there, and the run goes back to the start."
        ),
    );
    let mut player = lab.player(&scene, lab.options())?;
    let quantum = player.home().scale.length_quantum();
    // The states at each turnaround, velocities already reversed.
    let times: Vec<f64> = (1..=10).map(|k| 0.1 * f64::from(k)).collect();
    let mut turned = Vec::new();
    for t in &times {
        let goal = (t / scene.time_step()).round() as u64;
        let ahead = goal - player.steps_taken();
        lab.advance("echo, out", &mut player, ahead)?;
        player.turn();
        turned.push(player.save());
        player.turn();
    }
    let mut chart = Chart {
        title: "Return error by the time of the turnaround".to_owned(),
        x_label: "t, s".to_owned(),
        y_label: "rms distance from home, m".to_owned(),
        y_log: true,
        ..Chart::default()
    };
    let mut first = Vec::new();
    for (k, exponent) in [0u32, 10, 20].into_iter().enumerate() {
        let quanta = 1i64 << exponent;
        let mut points = Vec::new();
        for (t, state) in times.iter().zip(&turned) {
            points.push([*t, echo_error(lab, &mut player, state, quanta)?]);
        }
        let label = format!("ε = {:.1e} m", quanta as f64 * quantum);
        chart.series.push(svg::styled(
            &label,
            k,
            Style::LineDots,
            points.iter().copied(),
        ));
        if k == 0 {
            first = points;
        }
    }
    lab.figure(&mut section, "echo", &chart.svg(), "The return error grows exponentially with the time spent, and in proportion to the perturbation, until it is as large as the flow.")?;
    // Between the noise of the numbers and saturation.
    let growing: Vec<[f64; 2]> = first
        .iter()
        .copied()
        .filter(|p| p[1] > 4.0 * quantum && p[1] < 1e-3)
        .collect();
    let exact = echo_error(lab, &mut player, &turned[4], 0)?;
    section.check(
        "without a perturbation",
        format!("{exact} m"),
        "",
        "0",
        exact == 0.0,
    );
    let logarithms = growing.iter().map(|p| [p[0], libm::log(p[1])]);
    if let Some(lambda) = slope(logarithms) {
        section.check(
            "Lyapunov exponent from the smallest perturbation",
            format!("{lambda:.1} /s"),
            "",
            "positive",
            lambda > 0.0,
        );
        section.measure(
            "a perturbation grows tenfold in",
            format!("{:.3} s", libm::log(10.0) / lambda),
            "",
        );
        let digits = libm::log(1.0 / quantum) / lambda;
        section.measure(
            "so the 46 binary digits of a position are used up after about",
            format!("{digits:.2} s"),
            "",
        );
    }
    fidelity(lab, &mut player, &turned, quantum, &mut section)?;
    Ok(section)
}

/// Return error by perturbation, at three turnarounds.
fn fidelity(
    lab: &mut Lab<'_>,
    player: &mut Player,
    turned: &[SavedState],
    quantum: f64,
    section: &mut Section,
) -> Result<(), LabError> {
    let mut chart = Chart {
        title: "Return error by perturbation".to_owned(),
        x_label: "ε, m".to_owned(),
        y_label: "rms distance from home, m".to_owned(),
        x_log: true,
        y_log: true,
        ..Chart::default()
    };
    for (k, index) in [0usize, 2, 4].into_iter().enumerate() {
        let mut points = Vec::new();
        for exponent in (0..=36).step_by(6) {
            let quanta = 1i64 << exponent;
            let error = echo_error(lab, player, &turned[index], quanta)?;
            points.push([quanta as f64 * quantum, error]);
        }
        if k == 0 {
            // From 2^12 quanta: below, the roundings on the way are perturbations too.
            let linear = points[2..5].iter().map(|p| p.map(libm::log));
            if let Some(power) = slope(linear) {
                section.check(
                    "power of ε in the return error, turned at 0.1 s",
                    format!("{power:.2}"),
                    "",
                    "1 to within 0.1",
                    (power - 1.0).abs() < 0.1,
                );
            }
        }
        let label = format!("turned at {:.1} s", 0.1 + 0.2 * k as f64);
        chart
            .series
            .push(svg::styled(&label, k, Style::LineDots, points.into_iter()));
    }
    lab.figure(section, "echo-fidelity", &chart.svg(), "Early on the return error is proportional to the perturbation; late, the smallest one is as bad as any.")
}
