//! A cantilever under its own weight against the beam formula, and a bar that hangs: how stiff bodies
//! are.

use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use std::f64::consts::PI;

/// Length and thickness, m.
const LENGTH: f64 = 0.2;
const THICKNESS: f64 = 0.02;
/// Gravity, m/s².
const GRAVITY: f64 = 1.111111;
/// Time of half a swing, s: about where the end is lowest.
const HALF_SWING: f64 = 0.19;

/// Young's modulus, Pa, and density, kg/m³, of the scene.
const YOUNGS_MODULUS: f64 = 1.4e6;
const DENSITY: f64 = 1000.0;

/// Shear modulus for a Poisson's ratio, Pa.
fn shear_modulus(poisson: f64) -> f64 {
    YOUNGS_MODULUS / (2.0 * (1.0 + poisson))
}

/// Displacement at x of the beam of Euler and Bernoulli in plane strain, with the share of shear
/// (5/6 of the section carries it), m.
fn beam(x: f64, poisson: f64) -> f64 {
    let density = DENSITY;
    let plane = YOUNGS_MODULUS / (1.0 - poisson * poisson);
    let shear = shear_modulus(poisson);
    let s = x / LENGTH;
    let bending = 3.0 * density * GRAVITY * LENGTH.powi(4) / (2.0 * plane * THICKNESS * THICKNESS);
    let sliding = density * GRAVITY * LENGTH * LENGTH / (2.0 * (5.0 / 6.0) * shear);
    bending * s * s * (6.0 - 4.0 * s + s * s) / 3.0 + sliding * (2.0 * s - s * s)
}

/// The lowest place of the end in the first swing over twice the static displacement, and the
/// energy error over the elastic energy there.
fn swing(lab: &mut Lab<'_>, through: u32, poisson: f64) -> Result<[f64; 2], LabError> {
    let spacing = THICKNESS / f64::from(through);
    let bulk_modulus = YOUNGS_MODULUS / (3.0 * (1.0 - 2.0 * poisson));
    let speed = |modulus: f64| (modulus / DENSITY).sqrt();
    let set = [
        format!("particle_spacing={spacing}"),
        format!("solid.bulk_speed={}", speed(bulk_modulus)),
        format!("solid.shear_speed={}", speed(shear_modulus(poisson))),
    ];
    let options = lab.options();
    let mut player = lab.player(&scene("cantilever", &set)?, options)?;
    let home = player.home().clone();
    let end: Vec<usize> = (0..home.id.len())
        .filter(|&n| home.position(n)[0] > LENGTH - spacing)
        .collect();
    let mean =
        |y: &dyn Fn(usize) -> f64| end.iter().map(|&n| y(n)).sum::<f64>() / end.len().max(1) as f64;
    let place = mean(&|n| home.position(n)[0]);
    let first = player.measure()?.energies.total();
    let steps = (HALF_SWING / player.scene().time_step()).round() as u64;
    let (mut lowest, mut error, mut elastic) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (looks, mut taken) = (200, 0);
    for look in 1..=looks {
        let next = steps * look / looks;
        lab.advance(
            &format!("beam of {through} rows"),
            &mut player,
            next - taken,
        )?;
        taken = next;
        let state = player.save();
        lowest = lowest.max(mean(&|n| home.position(n)[1] - state.position(n)[1]));
        let energies = player.measure()?.energies;
        error = error.max((energies.total() - first).abs());
        elastic = elastic.max(energies.get("bulk") + energies.get("shear"));
    }
    Ok([lowest / (2.0 * beam(place, poisson)), error / elastic])
}

pub fn cantilever(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Solids: a cantilever under its own weight",
        "A clamped rubber beam of ten thicknesses is let go and swings to twice its static \
         displacement. Its lowest place, over twice that of the beam of Euler and Bernoulli in plane \
         strain with the share of shear, at several numbers of rows through the thickness.",
    );
    let sizes: &[u32] = lab.size(&[5, 10], &[10, 20, 40]);
    let mut rows = Vec::new();
    let mut found = Vec::new();
    for poisson in [0.4, 0.3] {
        found.clear();
        for &through in sizes {
            let [ratio, error] = swing(lab, through, poisson)?;
            rows.push(vec![
                format!("{poisson}"),
                through.to_string(),
                format!("{ratio:.3}"),
                format!("{error:.1e}"),
            ]);
            found.push(ratio);
        }
    }
    section.table(
        "Lowest place of the end",
        &[
            "Poisson's ratio",
            "rows",
            "over twice the beam formula",
            "energy error, of the elastic energy",
        ],
        rows,
    );
    let last = found.len() - 1;
    let limit = 2.0 * found[last] - found[last - 1];
    section.check_at_full_size(
        lab.quick(),
        "Poisson's ratio 0.3, extrapolated to a fine lattice, of first order",
        format!("{limit:.3}"),
        "",
        "1 within 0.03",
        (limit - 1.0).abs() <= 0.03,
    );
    bar(lab, &mut section)?;
    section.note(
        "A thin body is too soft: the gradient at a free surface sees the strain of a point about half \
         a support within it.",
    );
    Ok(section)
}

/// Strain of the hanging bar at its clamp.
const STRAIN: f64 = 5e-3;

/// Young's modulus and Poisson's ratio of a bar that hangs from its clamp, over those of its
/// material: means over four periods of its longest wave, with the weights of Hann's window, in which
/// waves vanish whatever their exact period.
///
/// In plane strain u(x) = (ρ g/E')(L x - x²/2), E' = E/(1 - ν²), and the bar becomes thinner by
/// ν' = ν/(1 - ν) times its strain.
fn hang(lab: &mut Lab<'_>, through: u32, energy: &str, poisson: f64) -> Result<[f64; 2], LabError> {
    let plane = YOUNGS_MODULUS / (1.0 - poisson * poisson);
    let gravity = STRAIN * plane / (DENSITY * LENGTH);
    let shear = shear_modulus(poisson);
    // What c_0 stands for differs between the energies.
    let bulk = match energy {
        "dpr" => YOUNGS_MODULUS / (3.0 * (1.0 - 2.0 * poisson)),
        _ => YOUNGS_MODULUS * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
    };
    let set = [
        format!("particle_spacing={}", THICKNESS / f64::from(through)),
        format!("solid.energy={energy}"),
        format!("solid.bulk_speed={}", (bulk / DENSITY).sqrt()),
        format!("solid.shear_speed={}", (shear / DENSITY).sqrt()),
        format!("gravity.uniform=[{gravity}, 0]"),
    ];
    let options = lab.options();
    let mut player = lab.player(&scene("cantilever", &set)?, options)?;
    let home = player.home().clone();
    let spacing = player.scene().particle_spacing;
    let near = |x: f64, at: f64| (x - at).abs() < 0.05 * LENGTH;
    let period = 4.0 * LENGTH * (DENSITY / plane).sqrt();
    let steps = (4.0 * period / player.scene().time_step()).round() as u64;
    let (looks, mut taken) = (400, 0);
    let (mut weights, mut sums) = (0.0, [0.0; 3]);
    let name = format!("hanging bar of {through} rows, {energy}");
    for look in 1..=looks {
        let next = steps * look / looks;
        lab.advance(&name, &mut player, next - taken)?;
        taken = next;
        let state = player.save();
        // Mean displacement along an axis of the particles that are meant.
        let mean = |axis: usize, meant: &dyn Fn([f64; 3]) -> bool| {
            let all = 0..home.id.len();
            let of = all.filter(|&n| meant(home.position(n)));
            let moved = of.map(|n| state.position(n)[axis] - home.position(n)[axis]);
            let (count, sum) = moved.fold((0.0, 0.0), |(n, sum), u| (n + 1.0, sum + u));
            sum / f64::max(count, 1.0)
        };
        let edge = 0.5 * (THICKNESS - spacing);
        let middle = 0.5 * LENGTH;
        let longer =
            mean(0, &|x| near(x[0], 0.75 * LENGTH)) - mean(0, &|x| near(x[0], 0.25 * LENGTH));
        let up = mean(1, &|x| near(x[0], middle) && x[1] > edge - 0.1 * spacing);
        let down = mean(1, &|x| near(x[0], middle) && x[1] < 0.1 * spacing - edge);
        let weight = (PI * (look as f64 - 0.5) / looks as f64).sin().powi(2);
        weights += weight;
        for (sum, x) in sums.iter_mut().zip([longer, up, down]) {
            *sum += weight * x;
        }
    }
    let [longer, up, down] = sums.map(|sum| sum / weights);
    // Between a quarter and three quarters of the length the strain is on average that halfway.
    let strain = longer / (0.5 * LENGTH);
    let found = DENSITY * gravity * 0.5 * LENGTH / strain;
    let thinner = (down - up) / (THICKNESS - spacing);
    let ratio = thinner / strain;
    Ok([found / plane, ratio / (poisson / (1.0 - poisson))])
}

/// The moduli of a bar.
fn bar(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let mut rows = Vec::new();
    let mut worst = 0.0_f64;
    let sizes: [u32; 2] = lab.size([5, 10], [10, 20]);
    for energy in ["dpr", "neo-hookean"] {
        for poisson in [0.4, 0.3] {
            let mut found = [[0.0; 2]; 2];
            for (found, through) in found.iter_mut().zip(sizes) {
                *found = hang(lab, through, energy, poisson)?;
                rows.push(vec![
                    energy.to_owned(),
                    format!("{poisson}"),
                    through.to_string(),
                    format!("{:.3}", found[0]),
                    format!("{:.3}", found[1]),
                ]);
            }
            let [coarse, fine] = found;
            let limit: [f64; 2] = std::array::from_fn(|k| 2.0 * fine[k] - coarse[k]);
            worst = limit.iter().fold(worst, |m, x| m.max((x - 1.0).abs()));
            rows.push(vec![
                energy.to_owned(),
                format!("{poisson}"),
                "extrapolated".to_owned(),
                format!("{:.3}", limit[0]),
                format!("{:.3}", limit[1]),
            ]);
        }
    }
    section.table(
        "A bar that hangs from its clamp: moduli over those of the formulas",
        &[
            "energy",
            "Poisson's ratio",
            "rows",
            "E/(1 - nu²)",
            "nu/(1 - nu)",
        ],
        rows,
    );
    section.check_at_full_size(
        lab.quick(),
        "Young's modulus and Poisson's ratio of both energies, extrapolated: largest deviation",
        format!("{:.1} %", 100.0 * worst),
        "",
        "at most 3 %",
        worst <= 0.03,
    );
    Ok(())
}
