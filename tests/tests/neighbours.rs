//! The torus of cells against every pair.

use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::{LIMIT_BITS, Length, Quantity};
use proptest::prelude::*;

/// How often each particle of `position` is met around `x`.
fn met<Q: Quantity, const D: usize>(grid: &Grid<D>, position: &[[Q; D]], x: &[Q; D]) -> Vec<u32> {
    let mut start = vec![7; grid.buckets() + 1];
    let mut order = vec![7; position.len()];
    let mut cells = Cells {
        start: &mut start,
        order: &mut order,
    };
    cells.sort(grid, position);
    let mut times = vec![0; position.len()];
    cells.view().around(grid, x, |run| {
        run.iter().for_each(|&j| times[j as usize] += 1)
    });
    times
}

/// Every particle within reach is met exactly once, no other more than once.
fn check<const D: usize>(
    reach: i64,
    grid: &Grid<D>,
    words: &[[i64; D]],
) -> Result<(), TestCaseError> {
    let fixed: Vec<[Length; D]> = words.iter().map(|x| x.map(Length::from_word)).collect();
    let float: Vec<[f64; D]> = words.iter().map(|x| x.map(|x| x as f64)).collect();
    for (i, x) in words.iter().enumerate() {
        let times = met(grid, &fixed, &fixed[i]);
        prop_assert_eq!(&times, &met(grid, &float, &float[i]));
        for (j, y) in words.iter().enumerate() {
            let r2: i128 = (0..D).map(|d| i128::from(x[d] - y[d]).pow(2)).sum();
            let near = r2 <= i128::from(reach) * i128::from(reach);
            prop_assert!(times[j] <= 1, "{j} is met {} times around {i}", times[j]);
            prop_assert!(times[j] == 1 || !near, "{j} is not met around {i}");
        }
    }
    Ok(())
}

/// Coordinates that like to lie on edges of cells, on one point, and far away.
fn coordinate(reach: i64) -> impl Strategy<Value = i64> {
    let cell = reach + 2;
    prop_oneof![
        6 => -6 * cell..6 * cell,
        3 => (-6..6i64, -1..=1i64).prop_map(move |(n, off)| n * cell + off),
        1 => (-6..6i64, -1..=1i64).prop_map(move |(n, off)| n * cell + off * reach),
        1 => Just(0),
        1 => prop_oneof![Just(LIMIT_BITS - 1), Just(1 - LIMIT_BITS), 1 - LIMIT_BITS..LIMIT_BITS],
    ]
}

/// Clouds; some of them with every particle twice.
fn cloud<const D: usize>(reach: i64) -> impl Strategy<Value = Vec<[i64; D]>> {
    let one = prop::array::uniform::<_, D>(coordinate(reach));
    (prop::collection::vec(one, 1..40), any::<bool>()).prop_map(|(mut all, twice)| {
        if twice {
            all.extend(all.clone());
        }
        all
    })
}

fn grid<const D: usize>(reach: i64) -> impl Strategy<Value = Grid<D>> {
    let extent = prop::array::uniform::<_, D>(0..20 * reach);
    (extent, 1..600usize).prop_map(move |(extent, most)| Grid::new(reach, extent, most))
}

/// The reach and all that depends on it.
fn scene<const D: usize>() -> impl Strategy<Value = (i64, Grid<D>, Vec<[i64; D]>)> {
    prop_oneof![1..5i64, 1000..2000i64, 1i64 << 40..1 << 41]
        .prop_flat_map(|reach| (Just(reach), grid(reach), cloud(reach)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn in_the_plane_every_neighbour_is_met_exactly_once((reach, grid, cloud) in scene::<2>()) {
        check(reach, &grid, &cloud)?;
    }

    #[test]
    fn in_space_every_neighbour_is_met_exactly_once((reach, grid, cloud) in scene::<3>()) {
        check(reach, &grid, &cloud)?;
    }

    #[test]
    fn the_number_of_buckets_is_bounded(reach in 1..1i64 << 50, extent in prop::array::uniform3(0..i64::MAX), most in 0..5000usize) {
        let buckets = Grid::new(reach, extent, most).buckets();
        prop_assert!((27..=most.max(27)).contains(&buckets), "{buckets}");
    }

    #[test]
    fn sorting_puts_every_particle_in_one_place((_, grid, cloud) in scene::<2>()) {
        let position: Vec<[Length; 2]> = cloud.iter().map(|x| x.map(Length::from_word)).collect();
        let (mut start, mut order) = (vec![9; grid.buckets() + 1], vec![9; position.len()]);
        Cells { start: &mut start, order: &mut order }.sort(&grid, &position);
        prop_assert_eq!(start[0], 0);
        prop_assert_eq!(start[grid.buckets()] as usize, position.len());
        prop_assert!(start.is_sorted());
        order.sort_unstable();
        prop_assert!(order.iter().enumerate().all(|(k, &i)| k == i as usize));
    }
}

#[test]
fn one_particle_meets_itself_once() {
    let grid = Grid::new(10, [100; 2], 100);
    for x in [0, -1, 12, 1 - LIMIT_BITS, LIMIT_BITS - 1] {
        let all = [[Length::from_word(x); 2]];
        assert_eq!(met(&grid, &all, &all[0]), [1]);
    }
}

#[test]
fn an_empty_set_has_no_neighbours() {
    let grid = Grid::new(10, [100; 3], 1000);
    assert!(met::<Length, 3>(&grid, &[], &[Length::ZERO; 3]).is_empty());
}

#[test]
fn a_far_flyer_costs_no_memory() {
    let grid = Grid::new(1000, [10_000; 2], 10_000);
    let near = grid.buckets();
    let far = [[Length::from_word(LIMIT_BITS - 1); 2], [Length::ZERO; 2]];
    assert_eq!(near, 100);
    assert_eq!(met(&grid, &far, &far[0])[0], 1);
}
