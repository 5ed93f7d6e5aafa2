//! The number formats and their one rounding.

use loschmidt_core::number::{LIMIT_BITS, Length, Quantity, Speed, power_of_two, round};
use loschmidt_core::{Scale, owned::to_quanta};
use proptest::prelude::*;

const LIMIT: f64 = LIMIT_BITS as f64;

/// The integer nearest to x, ties to even, without any floating-point addition.
fn nearest(x: f64) -> i64 {
    let below = x.floor();
    let rest = x - below; // exact: both are multiples of the ulp of x
    let up = rest > 0.5 || (rest == 0.5 && (below as i64) % 2 != 0);
    below as i64 + i64::from(up)
}

fn in_range() -> impl Strategy<Value = f64> {
    prop_oneof![
        // Every exponent, uniformly over bit patterns.
        any::<u64>()
            .prop_map(f64::from_bits)
            .prop_filter("in range", |x| x.abs() < LIMIT),
        -LIMIT..LIMIT,
        -8.0..8.0f64,
        // Ties and their neighbours.
        (-(1i64 << 50)..1 << 50, -1..=1i64).prop_map(|(n, ulps)| {
            let tie = n as f64 + 0.5;
            f64::from_bits((tie.to_bits() as i64 + ulps) as u64)
        }),
        // The last numbers before the limit.
        (1..4096u64).prop_map(|ulps| f64::from_bits(LIMIT.to_bits() - ulps)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn rounding_is_odd(x in in_range()) {
        let there = round(x).unwrap();
        prop_assert_eq!(round(-x), Some(-there));
    }

    #[test]
    fn rounding_goes_to_the_nearest_integer_and_ties_to_even(x in in_range()) {
        let rounded = round(x).unwrap();
        prop_assert_eq!(rounded, nearest(x));
        prop_assert_eq!(rounded, x.round_ties_even() as i64);
    }

    #[test]
    fn rounding_refuses_what_is_out_of_range(bits in any::<u64>()) {
        let x = f64::from_bits(bits);
        prop_assert_eq!(round(x).is_some(), x.abs() < LIMIT);
    }

    #[test]
    fn adding_a_rounded_number_and_its_negative_is_the_identity(word in -LIMIT_BITS..LIMIT_BITS, x in in_range()) {
        let start = Length::from_word(word);
        let back = start.add_rounded(x).unwrap().add_rounded(-x).unwrap();
        prop_assert_eq!(start, back);
    }

    #[test]
    fn differences_of_numbers_in_range_are_exact(a in -LIMIT_BITS + 1..LIMIT_BITS, b in -LIMIT_BITS + 1..LIMIT_BITS) {
        let (x, y) = (Length::from_word(a), Length::from_word(b));
        prop_assert!(x.in_range() && y.in_range());
        let difference: f64 = x.difference(y);
        prop_assert_eq!(difference as i128, i128::from(a) - i128::from(b));
        prop_assert_eq!(y.difference(x), -difference);
        prop_assert_eq!(x.quanta() as i64, a);
    }

    #[test]
    fn words_are_inverses_of_numbers(word in any::<i64>()) {
        prop_assert_eq!(Length::from_word(word).to_word(), word);
        prop_assert_eq!(Speed::from_word(word).to_word(), word);
        let float = <f64 as Quantity>::from_word(word);
        if !float.is_nan() && word != i64::MIN {
            prop_assert_eq!(Quantity::to_word(float), word);
        }
    }

    #[test]
    fn a_number_is_in_range_up_to_the_limit(word in any::<i64>()) {
        let expected = i128::from(word).abs() < i128::from(LIMIT_BITS);
        prop_assert_eq!(Length::from_word(word).in_range(), expected);
    }

    #[test]
    fn a_cell_holds_its_coordinates(word in -LIMIT_BITS..LIMIT_BITS, size in 2..1i64 << 50) {
        let cell = Length::from_word(word).cell(size);
        let (low, high) = (i128::from(cell) * i128::from(size), (i128::from(cell) + 1) * i128::from(size));
        prop_assert!(low <= i128::from(word) && i128::from(word) < high);
    }

    #[test]
    fn headroom_is_the_smallest_power_of_two_that_leaves_it(
        extent in 1e-9..1e9f64, speed in 1e-6..1e6f64, density in 1e-3..1e5f64
    ) {
        let scale = Scale::with_headroom(extent, speed, density);
        for (limit, wanted) in [
            (LIMIT * scale.length_quantum(), 6.0 * extent),
            (LIMIT * scale.speed_quantum(), 16.0 * speed),
            (LIMIT * scale.density_quantum(), 2.0 * density),
        ] {
            prop_assert!(limit >= wanted && limit < 2.0 * wanted, "{limit} {wanted}");
        }
    }
}

#[test]
fn rounding_refuses_nan_infinity_and_the_limit_itself() {
    for x in [f64::NAN, f64::INFINITY, LIMIT, f64::MAX] {
        assert_eq!(round(x), None);
        assert_eq!(round(-x), None);
        assert_eq!(Length::ZERO.add_rounded(x), None);
        assert_eq!(<f64 as Quantity>::ZERO.add_rounded(x), None);
    }
    // The largest number that is accepted rounds to the limit, for either sign.
    let last = LIMIT.next_down();
    assert_eq!(round(last), Some(LIMIT_BITS));
    assert_eq!(round(-last), Some(-LIMIT_BITS));
}

#[test]
fn the_limit_of_the_state_holds_for_either_sign() {
    for word in [LIMIT_BITS, -LIMIT_BITS, i64::MIN, i64::MAX] {
        assert!(!Length::from_word(word).in_range());
    }
    for word in [LIMIT_BITS - 1, 1 - LIMIT_BITS, 0] {
        assert!(Length::from_word(word).in_range());
    }
    for x in [f64::NAN, f64::INFINITY, LIMIT, -LIMIT] {
        assert!(!Quantity::in_range(x));
    }
}

#[test]
fn the_dam_break_of_the_paper_gets_exponents_zero() {
    let scale = Scale::with_headroom(4.0, 120.0, 1000.0);
    let zero = Scale {
        length_exponent: 0,
        speed_exponent: 0,
        density_exponent: 0,
    };
    assert_eq!(scale, zero);
    assert_eq!(scale.length_quantum(), power_of_two(-46));
    assert_eq!(scale.speed_quantum(), power_of_two(-40));
    assert_eq!(scale.density_quantum(), power_of_two(-40));
    // 2^51 quanta: 32 m, 2048 m/s, 2048 kg/m³.
    assert_eq!(LIMIT * scale.length_quantum(), 32.0);
    assert_eq!(LIMIT * scale.speed_quantum(), 2048.0);
    assert_eq!(LIMIT * scale.density_quantum(), 2048.0);
}

#[test]
fn a_power_of_two_is_its_own_headroom() {
    // 2 x 1024 = 2^11 exactly; a hair more needs one exponent more.
    let exponent = |density| Scale::with_headroom(1.0, 1.0, density).density_exponent;
    assert_eq!(exponent(1024.0), 0);
    assert_eq!(exponent(1024.0f64.next_up()), 1);
    assert_eq!(exponent(1024.0f64.next_down()), 0);
}

#[test]
fn a_negative_zero_is_a_zero() {
    assert_eq!(round(-0.0f64), Some(0));
    assert_eq!(Quantity::to_word(-0.0f64), 0);
    assert_eq!(Quantity::to_word(0.0f64), 0);
    let minus: Option<[f64; 2]> = to_quanta([-0.0, 0.0], 1.0);
    assert_eq!(minus.unwrap().map(f64::to_bits), [0, 0]);
    let fixed: Option<[Length; 1]> = to_quanta([-0.0], 1.0);
    assert_eq!(fixed.unwrap()[0].to_word(), 0);
}

#[test]
fn negation_is_an_involution_on_bits() {
    for word in [0, 1, -1, LIMIT_BITS - 1, 1 - LIMIT_BITS] {
        let v = Speed::from_word(word);
        assert_eq!(v.negated().to_word(), -word);
        assert_eq!(v.negated().negated(), v);
    }
}

#[test]
fn si_numbers_are_rounded_once_and_refused_out_of_range() {
    let quantum = power_of_two(-46);
    let there: Option<[Length; 1]> = to_quanta([0.1], quantum);
    assert_eq!(there.unwrap()[0].to_word(), nearest(0.1 * 2f64.powi(46)));
    for x in [32.0, -32.0, f64::NAN, 32.0f64.next_down()] {
        assert_eq!(to_quanta::<Length, 1>([x], quantum), None, "{x}");
    }
}
