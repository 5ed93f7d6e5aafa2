//! The tables of kicks and drifts.

use loschmidt_core::Symplectic;
use loschmidt_core::integrator::{
    INTEGRATORS, Integrator, PEFRL, STORMER_VERLET, SUZUKI, Stage, by_name,
};
use loschmidt_core::{Fixed, Parameters, Serial};
use loschmidt_tests::permitted;
use loschmidt_tests::small::{Recipe, central, position, velocity, water};

fn sums(row: &Integrator) -> (f64, f64) {
    row.stages
        .iter()
        .fold((0.0, 0.0), |(kick, drift), stage| match stage {
            Stage::Kick(c) => (kick + c, drift),
            Stage::Drift(c) => (kick, drift + c),
            Stage::Lift(_) | Stage::Counterkick(_) | Stage::Relax => {
                panic!("{} does more than kick and drift", row.name)
            }
        })
}

#[test]
fn every_table_reads_the_same_from_both_ends() {
    for row in INTEGRATORS {
        let mut back = row.stages.to_vec();
        back.reverse();
        assert_eq!(row.stages, back, "{}", row.name);
    }
}

#[test]
fn kicks_and_drifts_each_sum_to_one_step() {
    for row in INTEGRATORS {
        let (kick, drift) = sums(row);
        assert!(
            (kick - 1.0).abs() <= permitted::COEFFICIENT_SUM,
            "{} {kick}",
            row.name
        );
        assert!(
            (drift - 1.0).abs() <= permitted::COEFFICIENT_SUM,
            "{} {drift}",
            row.name
        );
    }
}

#[test]
fn kicks_and_drifts_alternate() {
    for row in INTEGRATORS {
        for pair in row.stages.windows(2) {
            let same = matches!(
                pair,
                [Stage::Kick(_), Stage::Kick(_)] | [Stage::Drift(_), Stage::Drift(_)]
            );
            assert!(!same, "{}", row.name);
        }
    }
}

#[test]
fn force_evaluations_are_those_between_drifts() {
    // The last kick of a step and the first of the next share an evaluation.
    for row in INTEGRATORS {
        let drifts = row
            .stages
            .iter()
            .filter(|s| matches!(s, Stage::Drift(_)))
            .count();
        let shared = matches!(row.stages[0], Stage::Kick(_));
        let evaluations = if shared { drifts } else { drifts - 1 };
        assert_eq!(row.evaluations as usize, evaluations, "{}", row.name);
    }
}

#[test]
fn rows_are_found_by_their_names() {
    for row in INTEGRATORS {
        assert_eq!(by_name(row.name), Some(row));
    }
    assert_eq!(by_name("leapfrog"), None);
}

/// The coefficients as the papers print them.
#[test]
fn coefficients_are_those_of_the_papers() {
    let (xi, lambda, chi) = (
        "0.1786178958448091E+00".parse::<f64>().unwrap(),
        "-0.2123418310626054E+00".parse::<f64>().unwrap(),
        "-0.6626458266981849E-01".parse::<f64>().unwrap(),
    );
    use Stage::{Drift, Kick};
    assert_eq!(
        PEFRL.stages[..5],
        [
            Drift(xi),
            Kick((1.0 - 2.0 * lambda) / 2.0),
            Drift(chi),
            Kick(lambda),
            Drift(1.0 - 2.0 * (chi + xi))
        ]
    );
    // 1/(4 - 4^(1/3)), from 40 digits.
    let p: f64 = "0.4144907717943757371423540628607614957117"
        .parse()
        .unwrap();
    assert_eq!(
        SUZUKI.stages[..6],
        [
            Kick(p / 2.0),
            Drift(p),
            Kick(p),
            Drift(p),
            Kick((1.0 - 3.0 * p) / 2.0),
            Drift(1.0 - 4.0 * p)
        ]
    );
    assert_eq!(STORMER_VERLET.stages, [Kick(0.5), Drift(1.0), Kick(0.5)]);
}

const START: ([f64; 2], [f64; 2]) = ([1.3, 0.3], [0.0, 1.5]);
const TIME: f64 = 4.0;

fn orbit(integrator: &'static Integrator, steps: u64) -> [f64; 4] {
    let parameters = Parameters {
        gravity: central(),
        integrator,
        time_step: TIME / steps as f64,
        ..water()
    };
    let mut recipe = Recipe::empty(parameters);
    recipe.fluid.push(START);
    let mut system = recipe.build::<Fixed, Symplectic<Fixed, 2>>();
    system.advance(steps, &Serial).unwrap();
    let (x, v) = (position(&mut system, 0), velocity(&mut system, 0));
    [x[0], x[1], v[0], v[1]]
}

/// The same orbit by classical Runge–Kutta in plain doubles.
fn reference() -> [f64; 4] {
    let mass = central::<2>().central.unwrap();
    let rate = |y: [f64; 4]| {
        let x = [y[0] - mass.centre[0], y[1] - mass.centre[1]];
        let r2 = x[0] * x[0] + x[1] * x[1] + mass.softening * mass.softening;
        let f = -mass.strength / (r2 * r2.sqrt());
        [y[2], y[3], f * x[0], f * x[1]]
    };
    let n = 40_000;
    let dt = TIME / f64::from(n);
    let mut y = [START.0[0], START.0[1], START.1[0], START.1[1]];
    let at = |y: [f64; 4], k: [f64; 4], c: f64| std::array::from_fn(|i| y[i] + c * dt * k[i]);
    for _ in 0..n {
        let k1 = rate(y);
        let k2 = rate(at(y, k1, 0.5));
        let k3 = rate(at(y, k2, 0.5));
        let k4 = rate(at(y, k3, 1.0));
        y = std::array::from_fn(|i| y[i] + dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

#[test]
fn every_row_has_its_order_on_a_smooth_orbit() {
    let exact = reference();
    for (row, steps) in [(&STORMER_VERLET, 400), (&PEFRL, 100), (&SUZUKI, 100)] {
        let error = |steps| {
            let y = orbit(row, steps);
            let squares: f64 = (0..4).map(|i| (y[i] - exact[i]).powi(2)).sum();
            squares.sqrt()
        };
        let (coarse, fine) = (error(steps), error(2 * steps));
        let order = (coarse / fine).log2();
        assert!(
            (order - f64::from(row.order)).abs() < permitted::ORDER,
            "{}: {coarse:e} {fine:e} {order}",
            row.name
        );
    }
}
