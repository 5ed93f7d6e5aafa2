//! Sums of floating-point numbers that do not depend on their order.

use loschmidt_core::exact::ExactSum;
use loschmidt_tests::generator::Generator;
use proptest::prelude::*;

fn sum(terms: &[f64]) -> ExactSum {
    terms
        .iter()
        .fold(ExactSum::default(), |sum, &x| sum.plus(x))
}

proptest! {
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
fn what_is_too_large_saturates_and_a_nan_counts_as_zero() {
    assert_eq!(sum(&[f64::NAN, 1.0]), sum(&[1.0]));
    let largest = sum(&[f64::INFINITY]);
    assert_eq!(sum(&[f64::MAX, 1.0, f64::MAX]), largest);
    assert_eq!(largest.value(), 2f64.powi(67));
    assert_eq!(sum(&[f64::NEG_INFINITY]).value(), -2f64.powi(67));
}
