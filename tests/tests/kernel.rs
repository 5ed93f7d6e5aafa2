//! Wendland's C2 kernel.

use loschmidt_core::kernel::WendlandC2;
use loschmidt_tests::permitted;
use std::f64::consts::PI;

const SUPPORT: f64 = 0.37;

fn kernel(dimension: usize) -> WendlandC2 {
    WendlandC2::new(dimension, SUPPORT, 1.0)
}

/// Simpson's rule.
fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let n = 2000;
    let step = (to - from) / f64::from(n);
    let weight = |k| match k {
        0 => 1.0,
        k if k == n => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=n)
        .map(|k| weight(k) * f(from + f64::from(k) * step))
        .sum();
    sum * step / 3.0
}

#[test]
fn it_integrates_to_one_in_the_plane() {
    let w = kernel(2);
    let all = integral(0.0, SUPPORT, |r| 2.0 * PI * r * w.value(r));
    assert!((all - 1.0).abs() < permitted::KERNEL_INTEGRAL, "{all}");
}

#[test]
fn it_integrates_to_one_in_space() {
    let w = kernel(3);
    let all = integral(0.0, SUPPORT, |r| 4.0 * PI * r * r * w.value(r));
    assert!((all - 1.0).abs() < permitted::KERNEL_INTEGRAL, "{all}");
}

#[test]
fn derivative_over_r_is_the_derivative_of_the_value_over_r() {
    for dimension in [2, 3] {
        let w = kernel(dimension);
        let unit = w.value(0.0) / (SUPPORT * SUPPORT);
        let d = 1e-5 * SUPPORT;
        for k in 5..=110 {
            let r = f64::from(k) * 0.01 * SUPPORT;
            let numerical = (w.value(r + d) - w.value(r - d)) / (2.0 * d) / r;
            let error = (w.derivative_over_r(r) - numerical).abs() / unit;
            assert!(
                error < permitted::KERNEL_DERIVATIVE,
                "{dimension} {r} {error}"
            );
        }
    }
}

/// What stands for the change of a sum with the width of the kernel, against differences of W in h
/// and in r.
#[test]
fn structural_functions_are_the_derivatives_by_the_support() {
    for dimension in [2, 3] {
        let w = kernel(dimension);
        let d = 1e-5;
        let [wider, narrower] =
            [1.0 + d, 1.0 - d].map(|f| WendlandC2::new(dimension, f * SUPPORT, 1.0));
        for k in 5..=110 {
            let r = f64::from(k) * 0.01 * SUPPORT;
            let structural = w.structural_at(w.q(r));
            let numerical = (wider.value(r) - narrower.value(r)) / (2.0 * d);
            let error = (structural - numerical).abs() / w.value(0.0);
            assert!(
                error < permitted::KERNEL_DERIVATIVE,
                "{dimension} {r} {error}"
            );

            let slope = w.structural_derivative_over_r_at(w.q(r));
            let numerical =
                (wider.derivative_over_r(r) - narrower.derivative_over_r(r)) / (2.0 * d);
            let error = (slope - numerical).abs() / w.value(0.0) * (SUPPORT * SUPPORT);
            assert!(
                error < permitted::KERNEL_DERIVATIVE,
                "{dimension} {r} {error}"
            );
        }
    }
}

#[test]
fn it_vanishes_at_the_support_and_beyond() {
    for dimension in [2, 3] {
        let w = WendlandC2::new(dimension, 0.25, 1.0);
        for r in [0.25, 0.25f64.next_up(), 0.3, 1e9] {
            assert_eq!(w.value(r), 0.0);
            assert_eq!(w.derivative_over_r(r), 0.0);
            assert_eq!(w.structural_at(w.q(r)), 0.0);
            assert_eq!(w.structural_derivative_over_r_at(w.q(r)), 0.0);
        }
        assert!(w.value(0.25f64.next_down()) > 0.0);
        assert!(w.derivative_over_r(0.25f64.next_down()) < 0.0);
    }
}

#[test]
fn it_is_positive_and_falls_inside() {
    for dimension in [2, 3] {
        let w = kernel(dimension);
        let mut last = f64::INFINITY;
        for k in 0..100 {
            let r = f64::from(k) * 0.01 * SUPPORT;
            assert!(w.value(r) > 0.0 && w.value(r) < last);
            assert!(w.derivative_over_r(r) < 0.0);
            last = w.value(r);
        }
    }
}

#[test]
fn coincident_particles_exert_no_force() {
    // W'/r is finite at r = 0, so (W'/r) x is zero there.
    for dimension in [2, 3] {
        let slope = kernel(dimension).derivative_over_r(0.0);
        assert!(slope.is_finite() && slope < 0.0);
        assert_eq!(slope * 0.0, 0.0);
    }
}

#[test]
fn a_unit_that_is_a_power_of_two_changes_no_bit() {
    let quantum = 2f64.powi(-46);
    for dimension in [2, 3] {
        let (metres, quanta) = (
            kernel(dimension),
            WendlandC2::new(dimension, SUPPORT, quantum),
        );
        for k in 0..=40 {
            let r = f64::from(k) * 0.01;
            assert_eq!(metres.value(r), quanta.value(r / quantum));
            assert_eq!(
                metres.derivative_over_r(r),
                quanta.derivative_over_r(r / quantum)
            );
        }
    }
}
