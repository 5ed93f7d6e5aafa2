//! A cantilever under its own weight against the beam formula: how soft thin bodies are.

use crate::lab::{Lab, LabError, scene};
use crate::section::Section;

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
    section.note(
        "A thin body is too soft: the gradient at a free surface sees the strain of a point about half \
         a support within it.",
    );
    Ok(section)
}
