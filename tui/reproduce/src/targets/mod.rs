//! The targets, one function each.

pub mod beam;
pub mod cavity;
pub mod claims;
pub mod column;
pub mod correction;
pub mod couette;
pub mod dam;
pub mod echo;
pub mod edge;
pub mod entropy;
mod flow;
pub mod fountain;
pub mod gresho;
pub mod normal_cavity;
pub mod plate;
pub mod sound;
pub mod work;

use crate::lab::{Lab, LabError, Past, scene};
use crate::svg::{self, Chart};
use loschmidt_runner::ArithmeticKind;
use loschmidt_runner::run::Row;

/// The dam break of Table 1 out to 2 s and back, which several figures are drawn from.
fn dam_break(lab: &mut Lab<'_>) -> Result<Past, LabError> {
    let mut set = vec![
        "turnaround=2.0".to_owned(),
        "output.rows=2000".to_owned(),
        "output.frames=8".to_owned(),
    ];
    if lab.quick() {
        set.push("particle_spacing=0.04".to_owned());
    }
    lab.run(
        "dam-break",
        scene("dam-break", &set)?,
        ArithmeticKind::Fixed,
    )
}

/// Kinetic, elastic and penalty energy of a body in time, over the kinetic one at the start.
fn budget_chart(figure: &str, x_label: &str, energies: &[Vec<[f64; 2]>; 3]) -> Chart {
    let names = ["kinetic", "elastic", "penalty"];
    let series = names.iter().zip(energies).enumerate();
    Chart {
        title: format!("{figure}: energies over the kinetic one at the start"),
        x_label: x_label.to_owned(),
        y_label: "E / K(0)".to_owned(),
        series: series
            .map(|(n, (name, points))| svg::line(name, n, points.iter().copied()))
            .collect(),
        ..Chart::default()
    }
}

/// In a few digits.
fn percent(x: f64) -> String {
    format!("{:.2} %", 100.0 * x)
}

/// Whether every row of the way back is, but for the signs of momenta, that of the way out.
fn same_way_back(past: &Past) -> bool {
    let bits = |row: &Row| {
        [
            row.energy("kinetic"),
            row.energy("internal"),
            row.energy("gravitational"),
            row.energy("wall"),
            row.total,
            row.entropy,
            row.front_m,
        ]
        .map(f64::to_bits)
    };
    let out: std::collections::BTreeMap<i64, [u64; 7]> =
        past.out().map(|row| (row.position, bits(row))).collect();
    past.back().count() > 0
        && past
            .back()
            .all(|row| out.get(&row.position) == Some(&bits(row)))
}

/// Slope of a straight line through points by least squares; `None` for fewer than two.
fn slope(points: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
    let points: Vec<[f64; 2]> = points.collect();
    if points.len() < 2 {
        return None;
    }
    let n = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    Some(sum(&|p| (p[0] - x) * (p[1] - y)) / sum(&|p| (p[0] - x) * (p[0] - x)))
}

#[cfg(test)]
mod tests {
    use super::slope;

    #[test]
    fn the_slope_of_a_straight_line_is_found_and_of_one_point_there_is_none() {
        let points = (0..5).map(|k| [f64::from(k), 3.0 - 2.5 * f64::from(k)]);
        assert!((slope(points).expect("points") + 2.5).abs() < 1e-12);
        assert_eq!(slope([[1.0, 2.0]].into_iter()), None);
    }
}
