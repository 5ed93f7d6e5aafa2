//! Sums of floating-point numbers that do not depend on their order.

use loschmidt_core::exact::ExactSum;
use loschmidt_core::number::{Accumulate, Grain, PairSum, power_of_two, round};
use loschmidt_core::rounding::FineSum;
use loschmidt_tests::generator::Generator;
use proptest::prelude::*;

fn sum(terms: &[f64]) -> ExactSum {
    terms
        .iter()
        .fold(ExactSum::default(), |sum, &x| sum.plus(x))
}

/// The sum over pairs of a floating-point state.
fn fine(terms: &[f64], grain: Grain) -> f64 {
    let sum = terms
        .iter()
        .try_fold(FineSum::empty(grain), |sum, &x| sum.accumulate(x));
    sum.expect("in range").added_to(0.0)
}

/// A bound of terms, and terms within it; beyond 2^51 a bound is none.
fn bounded() -> impl Strategy<Value = (f64, Vec<f64>)> {
    let bound = (-40..=51i32, 1.0..2.0f64).prop_map(|(e, x)| x * 2f64.powi(e));
    (bound, prop::collection::vec(-1.0..=1.0f64, 0..60)).prop_map(|(bound, shares)| {
        let most = bound.min(power_of_two(51).next_down());
        (bound, shares.iter().map(|x| x * most).collect())
    })
}

proptest! {
    #[test]
    fn a_sum_over_pairs_in_floating_point_has_no_order(
        (bound, mut terms) in bounded(),
        seed in any::<u64>(),
    ) {
        let grain = Grain::under(bound);
        let first = fine(&terms, grain);
        Generator::new(seed).shuffle(terms.len(), |a, b| terms.swap(a, b));
        prop_assert_eq!(fine(&terms, grain).to_bits(), first.to_bits());
        // Half a grain for each term, which is at most 2^-51 of the bound and at most a quantum.
        let exact: f64 = terms.iter().fold(ExactSum::default(), |sum, &x| sum.plus(x)).value();
        let grain = (bound * power_of_two(-50)).min(1.0);
        let rounded = first.abs() * f64::EPSILON + terms.len() as f64 * power_of_two(-60);
        prop_assert!((first - exact).abs() <= 0.5 * grain * terms.len() as f64 + rounded);
    }

    /// What a sweep does: grains are counted by adding the rounder, and added as 64-bit integers.
    #[test]
    fn grains_that_were_counted_elsewhere_give_the_same_sum(
        (bound, terms) in bounded(),
        word in -1e15..1e15f64,
    ) {
        prop_assume!(bound < power_of_two(51));
        let grain = Grain::under(bound);
        let rounder = grain.rounder();
        let bits = |x: f64| x.to_bits() as i64;
        let grains = terms.iter().map(|x| bits(x + rounder) - bits(rounder)).sum();
        let sum = FineSum::grains_added_to(grains, grain, word);
        prop_assert_eq!(sum, word + fine(&terms, grain));
        prop_assert_eq!(Grain::QUANTUM.rounder() + 1.5, 3.0 * power_of_two(51) + 2.0);
        prop_assert_eq!(round(1.5), Some(2));
    }

    #[test]
    fn no_order_and_no_partition_changes_a_bit(
        mut terms in prop::collection::vec(prop_oneof![-1.0..1.0f64, -1e12..1e12f64, -1e-15..1e-15f64], 0..50),
        cut in any::<prop::sample::Index>(),
        seed in any::<u64>(),
    ) {
        let first = sum(&terms);
        let (left, right) = terms.split_at(cut.index(terms.len() + 1));
        prop_assert_eq!(sum(left).merged(sum(right)), first);
        Generator::new(seed).shuffle(terms.len(), |a, b| terms.swap(a, b));
        prop_assert_eq!(sum(&terms), first);
        prop_assert_eq!(sum(&terms).value().to_bits(), first.value().to_bits());
    }

    #[test]
    fn multiples_of_the_resolution_are_summed_exactly(terms in prop::collection::vec(-1i64 << 52..1 << 52, 0..50)) {
        let floats: Vec<f64> = terms.iter().map(|&n| n as f64 * 2f64.powi(-60)).collect();
        let exact: i128 = terms.iter().map(|&n| i128::from(n)).sum();
        prop_assert_eq!(sum(&floats).value(), exact as f64 * 2f64.powi(-60));
    }

    #[test]
    fn the_sum_of_negatives_is_the_negative(terms in prop::collection::vec(-1e3..1e3f64, 0..50)) {
        let negative: Vec<f64> = terms.iter().map(|x| -x).collect();
        prop_assert_eq!(sum(&negative).value(), -sum(&terms).value());
    }
}

#[test]
fn a_term_beyond_the_range_is_none_of_a_sum_over_pairs() {
    for grain in [1.0, f64::INFINITY, f64::NAN].map(Grain::under) {
        let add = |x| {
            FineSum::empty(grain)
                .accumulate(x)
                .map(|sum| sum.added_to(1.0))
        };
        assert_eq!(add(2.0), Some(3.0));
        assert_eq!(add(power_of_two(51)), None);
        assert_eq!(add(-f64::INFINITY), None);
        assert_eq!(add(f64::NAN), None);
    }
}

#[test]
fn what_is_too_large_saturates_and_a_nan_counts_as_zero() {
    assert_eq!(sum(&[f64::NAN, 1.0]), sum(&[1.0]));
    let largest = sum(&[f64::INFINITY]);
    assert_eq!(sum(&[f64::MAX, 1.0, f64::MAX]), largest);
    assert_eq!(largest.value(), 2f64.powi(67));
    assert_eq!(sum(&[f64::NEG_INFINITY]).value(), -2f64.powi(67));
}
