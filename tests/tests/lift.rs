//! A row of integers goes to u e^M by operations that their negatives undo.

use loschmidt_core::lift::lift;
use loschmidt_core::number::{Whole, exp};
use loschmidt_tests::generator::Generator;
use loschmidt_tests::permitted;
use proptest::prelude::*;

type Matrix<const D: usize> = [[f64; D]; D];

fn product<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..D).map(|k| a[i][k] * b[k][j]).sum()))
}

fn negated<const D: usize>(m: &Matrix<D>) -> Matrix<D> {
    m.map(|row| row.map(|x| -x))
}

fn traceless<const D: usize>(mut m: Matrix<D>) -> Matrix<D> {
    let mean = (0..D).map(|i| m[i][i]).sum::<f64>() / D as f64;
    (0..D).for_each(|i| m[i][i] -= mean);
    m
}

/// e^M by its series.
fn exponential<const D: usize>(m: &Matrix<D>) -> Matrix<D> {
    let mut sum: Matrix<D> =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let mut power = sum;
    for n in 1..20 {
        power = product(&power, m).map(|row| row.map(|x| x / f64::from(n)));
        for (sum, power) in sum.iter_mut().flatten().zip(power.as_flattened()) {
            *sum += power;
        }
    }
    sum
}

fn size<const D: usize>(m: &Matrix<D>) -> f64 {
    m.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn one<const D: usize>(bits: i32) -> [[Whole; D]; D] {
    let unit = 1i64 << bits;
    std::array::from_fn(|i| {
        std::array::from_fn(|j| Whole::from_bits(if i == j { unit } else { 0 }))
    })
}

fn values<const D: usize>(rows: &[[Whole; D]; D], bits: i32) -> Matrix<D> {
    rows.map(|row| row.map(|x| x.to_bits() as f64 / 2f64.powi(bits)))
}

fn lift_all<const D: usize>(rows: &mut [[Whole; D]; D], m: &Matrix<D>) {
    for row in rows {
        assert!(lift(row, m));
    }
}

/// Words of any length, and matrices of which some hit ties of the rounding.
fn any_matrix<const D: usize>() -> impl Strategy<Value = Matrix<D>> {
    let entry = prop_oneof![3 => -0.5..0.5f64, 1 => (-8..8i32).prop_map(|k| f64::from(k) / 8.0)];
    prop::collection::vec(entry, D * D).prop_map(|x| {
        traceless(std::array::from_fn(|i| {
            std::array::from_fn(|j| x[i * D + j])
        }))
    })
}

fn any_row<const D: usize>() -> impl Strategy<Value = [i64; D]> {
    (2..50u32).prop_flat_map(|bits| {
        let range = -(1i64 << bits)..(1i64 << bits);
        prop::array::uniform::<_, D>(range)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn the_negative_undoes_it_in_the_plane(row in any_row::<2>(), m in any_matrix::<2>()) {
        let first = row.map(Whole::from_bits);
        let mut u = first;
        prop_assert!(lift(&mut u, &m) && lift(&mut u, &negated(&m)));
        prop_assert_eq!(u, first);
    }

    #[test]
    fn the_negative_undoes_it_in_space(row in any_row::<3>(), m in any_matrix::<3>()) {
        let first = row.map(Whole::from_bits);
        let mut u = first;
        prop_assert!(lift(&mut u, &m) && lift(&mut u, &negated(&m)));
        prop_assert_eq!(u, first);
    }
}

/// Half of M leaves an eighth of the error.
fn check_order<const D: usize>() {
    let mut generator = Generator::new(1);
    let mut sums = [0.0; 2];
    for _ in 0..200 {
        let m = traceless(std::array::from_fn(|_| generator.vector::<D>(0.05)));
        for (sum, factor) in sums.iter_mut().zip([1.0, 0.5]) {
            let m = m.map(|row| row.map(|x| factor * x));
            let mut rows = one::<D>(48);
            lift_all(&mut rows, &m);
            let mut difference = values(&rows, 48);
            let exact = exponential(&m);
            for (d, e) in difference.iter_mut().flatten().zip(exact.as_flattened()) {
                *d -= e;
            }
            *sum += size(&difference);
        }
    }
    let ratio = sums[0] / sums[1];
    assert!((ratio - 8.0).abs() < permitted::ORDER_OF_A_LIFT, "{ratio}");
}

#[test]
fn it_is_the_exponential_to_third_order() {
    check_order::<2>();
    check_order::<3>();
}

/// Largest |G - 1| on the way through so many lifts.
fn strain(
    axis: [f64; 3],
    angle: f64,
    steps: u32,
    lift: impl Fn(&mut [Whole; 3], &Matrix<3>),
) -> f64 {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = axis.map(|x| x / length * angle);
    let m = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let mut rows = one::<3>(48);
    let mut largest = 0.0f64;
    for step in 1..=steps {
        rows.iter_mut().for_each(|row| lift(row, &m));
        if step % 100 == 0 {
            let a = values(&rows, 48);
            let transposed = std::array::from_fn(|i| std::array::from_fn(|j| a[j][i]));
            let mut g = product(&transposed, &a);
            (0..3).for_each(|i| g[i][i] -= 1.0);
            largest = largest.max(size(&g));
        }
    }
    largest
}

/// One component after another by each of the others: exact too, but see below.
fn shears(row: &mut [Whole; 3], m: &Matrix<3>) {
    const PAIRS: [(usize, usize); 6] = [(1, 0), (0, 1), (2, 1), (1, 2), (2, 0), (0, 2)];
    for &(to, from) in PAIRS.iter().chain(PAIRS.iter().rev()) {
        let x = 0.5 * m[from][to] * row[from].to_bits() as f64;
        row[to] += Whole::from_bits(x.round_ties_even() as i64);
    }
}

#[test]
fn in_steady_rotation_about_an_oblique_axis_no_strain_grows() {
    let seven = |row: &mut [Whole; 3], m: &Matrix<3>| assert!(lift(row, m));
    let axis = [1.0, 2.0, 3.0];
    let [short, long] = [10_000, 100_000].map(|steps| strain(axis, 0.01, steps, seven));
    assert!(long < permitted::STRAIN_OF_A_ROTATION, "{long:e}");
    assert!(long < 3.0 * short, "{short:e} {long:e}");
    // What this guards against: the palindrome of single shears strains without end.
    let [short, long] = [10_000, 100_000].map(|steps| strain(axis, 0.01, steps, shears));
    assert!(long > 5.0 * short, "{short:e} {long:e}");
}

#[test]
fn the_determinant_stays() {
    let mut generator = Generator::new(2);
    let mut rows = one::<3>(48);
    for _ in 0..10_000 {
        let m = traceless(std::array::from_fn(|_| generator.vector::<3>(0.02)));
        lift_all(&mut rows, &m);
        // And back, so that the entries stay of order one; in another order.
        let back = negated(&m);
        let half = back.map(|row| row.map(|x| 0.5 * x));
        lift_all(&mut rows, &half);
        lift_all(&mut rows, &half);
    }
    let a = values(&rows, 48);
    let minor = |i: usize, j: usize| a[1][i] * a[2][j] - a[1][j] * a[2][i];
    let det = a[0][0] * minor(1, 2) - a[0][1] * minor(0, 2) + a[0][2] * minor(0, 1);
    assert!(
        (det - 1.0).abs() < permitted::DETERMINANT,
        "{:e}",
        det - 1.0
    );
}

#[test]
fn what_leaves_the_range_is_told() {
    let mut row = [Whole::from_bits((1 << 51) - 1), Whole::from_bits(1)];
    assert!(!lift(&mut row, &[[0.5, 0.0], [0.0, -0.5]]));
    let mut row = [Whole::from_bits(1), Whole::from_bits(1)];
    assert!(!lift(&mut row, &[[f64::NAN, 0.0], [0.0, 0.0]]));
}

#[test]
fn the_exponential_of_a_number_is_that_of_the_library() {
    for k in -400..=400 {
        let x = f64::from(k) * 0.01;
        let error = (exp(x) / x.exp() - 1.0).abs();
        assert!(error < permitted::EXPONENTIAL, "{x}: {error:e}");
    }
    assert_eq!(exp(0.0), 1.0);
}
