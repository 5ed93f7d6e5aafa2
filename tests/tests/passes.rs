//! Pair passes keep what they declare: their bound, their reach, their parity. Named numbers are
//! walked in the order in which they were declared.

use loschmidt_core::model::Relax;
use loschmidt_core::number::{power_of_two, round};
use loschmidt_core::pairs::{PairPass, Parity, separation, term_count};
use loschmidt_core::schemes::solid::{
    self, Relaxation, Relaxing, ShearEnergy, Solid, Viscous, WallVelocity,
};
use loschmidt_core::schemes::wcsph::{AntiClump, Wall, Water};
use loschmidt_core::values::{Symmetric, Values};
use loschmidt_core::{Fixed, Parameters, Scale};
use loschmidt_tests::bodies::{free_body, material};
use loschmidt_tests::small::{conservative, water};
use proptest::prelude::*;

/// What is done with each pass of a model.
trait Check<const D: usize> {
    fn check<P: PairPass<D>>(&mut self, name: &str, pass: &P) -> Result<(), TestCaseError>;
}

/// One model of each kind with the same lengths and units.
#[derive(Debug)]
struct Models<const D: usize> {
    water: Water<Fixed, D>,
    solid: Solid<Fixed, D>,
    viscous: Viscous<Fixed, D>,
    /// Of a kick, s.
    duration: f64,
}

/// Every pass that vanishes at its reach by itself.
fn every_pass<const D: usize>(
    models: &Models<D>,
    check: &mut impl Check<D>,
) -> Result<(), TestCaseError> {
    let Models {
        water,
        solid,
        viscous,
        duration,
    } = models;
    let flow = viscous.0.scheme();
    let duration = *duration;
    check.check("velocity gradient", &solid.bodies().gradient_pass())?;
    check.check("moments", &solid.bodies().moments_pass())?;
    check.check("force of a solid", &solid.force_pass())?;
    check.check("force of a fluid", &flow.force_pass())?;
    check.check("flow beside a wall", &flow.beside_pass())?;
    check.check("density", &water.density_pass())?;
    check.check("pressure", &water.pressure_pass())?;
    check.check("continuity", &water.continuity_pass(duration))?;
    check.check("filter", &water.filter_pass())?;
    let clump = water.anti_clump_pass(duration).expect("a repulsion");
    check.check("anti-clump", &clump)?;
    let (_, energy) = water.anti_clump_energy_pass().expect("a repulsion");
    check.check("energy of anti-clump", &energy)
}

/// Two particles: which way they are apart and how far, and what is read of them.
#[derive(Clone, Debug)]
struct Pair<const D: usize> {
    direction: [f64; D],
    /// Of the reach.
    distance: f64,
    /// Largest magnitude of each number, and the numbers in units of it.
    largest: [f64; 12],
    read: [[f64; 12]; 2],
}

impl<const D: usize> Pair<D> {
    fn largest<P: PairPass<D>>(&self) -> P::Read<f64> {
        Values::from_fn(|k| self.largest[k])
    }
    fn read<P: PairPass<D>>(&self, which: usize) -> P::Read<f64> {
        Values::from_fn(|k| self.largest[k] * self.read[which][k])
    }
    /// x_ij in whole quanta, at the distance or a little nearer.
    fn separation<P: PairPass<D>>(&self, pass: &P) -> [f64; D] {
        let length = self.direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let distance = self.distance * pass.reach_squared().sqrt();
        self.direction.map(|x| (x / length * distance).trunc())
    }
}

fn squared<const D: usize>(x: &[f64; D]) -> f64 {
    separation::<loschmidt_core::Float, D>(x, &[0.0; D]).1
}

fn turned<const D: usize>(x: &[f64; D]) -> [f64; D] {
    x.map(|x| -x)
}

struct Bounded<'a, const D: usize>(&'a Pair<D>);

impl<const D: usize> Check<D> for Bounded<'_, D> {
    fn check<P: PairPass<D>>(&mut self, name: &str, pass: &P) -> Result<(), TestCaseError> {
        let x = self.0.separation(pass);
        let r2 = squared(&x);
        if r2 >= pass.reach_squared() {
            return Ok(());
        }
        let (i, j) = (self.0.read::<P>(0), self.0.read::<P>(1));
        let term = pass.term(&x, pass.argument(r2), &i, &j);
        let all = pass.bound(&self.0.largest::<P>());
        let bounds = pass.bounds(&self.0.largest::<P>());
        for k in 0..term_count::<P, D>() {
            let (number, bound) = (term.get(k), bounds.get(k));
            prop_assert!(
                number.abs() <= bound && bound <= all,
                "{name}, number {k}: {number:e} {bound:e} {all:e}"
            );
        }
        Ok(())
    }
}

struct Vanishes<'a, const D: usize>(&'a Pair<D>);

impl<const D: usize> Check<D> for Vanishes<'_, D> {
    fn check<P: PairPass<D>>(&mut self, name: &str, pass: &P) -> Result<(), TestCaseError> {
        let x = self.0.separation(pass);
        let (i, j) = (self.0.read::<P>(0), self.0.read::<P>(1));
        // Only sums whose bound is in range are taken by rows.
        let in_range = pass.bound(&self.0.largest::<P>()) < power_of_two(51);
        for factor in [1.0, 1.0f64.next_up(), 1.000_001, 2.0, 1e6, 1e36] {
            // A row holds numbers of other pairs too: x need not be of this length.
            let argument = pass.argument(factor * pass.reach_squared());
            let term = pass.term(&x, argument, &i, &j);
            for k in 0..term_count::<P, D>() {
                let number = term.get(k);
                // At the reach itself 1/h, rounded, leaves a power of 10^-16.
                let exact = factor < 1.000_001 || number == 0.0;
                prop_assert!(exact, "{name}, number {k} at {factor}: {number:e}");
                let nothing = !in_range || round(number) == Some(0);
                prop_assert!(nothing, "{name}, number {k} at {factor}: {number:e}");
            }
        }
        Ok(())
    }
}

struct Exchanged<'a, const D: usize>(&'a Pair<D>);

impl<const D: usize> Check<D> for Exchanged<'_, D> {
    fn check<P: PairPass<D>>(&mut self, name: &str, pass: &P) -> Result<(), TestCaseError> {
        let x = self.0.separation(pass);
        let (i, j) = (self.0.read::<P>(0), self.0.read::<P>(1));
        let argument = pass.argument(squared(&x));
        prop_assert_eq!(squared(&x).to_bits(), squared(&turned(&x)).to_bits());
        let there = pass.term(&x, argument, &i, &j);
        let back = pass.term(&turned(&x), argument, &j, &i);
        for k in 0..term_count::<P, D>() {
            let expected = match P::PARITY.get(k) {
                Parity::Symmetric => there.get(k),
                Parity::Antisymmetric => -there.get(k),
            };
            // All bits but the sign of a zero, which no sum of integers sees.
            let bits = |x: f64| (x + 0.0).to_bits();
            prop_assert_eq!(bits(back.get(k)), bits(expected), "{}, number {}", name, k);
        }
        Ok(())
    }
}

fn models<const D: usize>() -> impl Strategy<Value = Models<D>> {
    let sizes = (0.05..2.0f64, 0.1..=1.0f64, 0.1..1e5f64);
    let units = prop::array::uniform3(-3..6i32);
    (sizes, units, 1e-6..1e-1f64).prop_map(|((support_radius, near, pressure), units, duration)| {
        let parameters = Parameters {
            support_radius,
            anti_clump: Some(AntiClump {
                pressure,
                support_radius: near * support_radius,
            }),
            scale: Scale {
                length_exponent: units[0],
                speed_exponent: units[1],
                density_exponent: 12 + units[2],
            },
            mass: 1000.0 * (support_radius / 3.0).powi(D as i32),
            ..water()
        };
        let spacing = support_radius / 3.0;
        let bodies = solid::Parameters {
            support_radius,
            particle_spacing: spacing,
            time_step: duration,
            scale: parameters.scale,
            ..free_body(material(ShearEnergy::Dpr))
        };
        let solid = Solid::new(bodies.clone());
        let viscous = Relaxing::viscous(solid::FluidParameters {
            bodies,
            relaxation_time: duration,
            relaxation: Relaxation::Exact,
            wall_velocity: WallVelocity::Mirrored,
            start: 0.0,
        });
        Models {
            water: Water::new(parameters).expect("in range"),
            solid: solid.expect("in range"),
            viscous: viscous.expect("in range"),
            duration,
        }
    })
}

fn pair<const D: usize>() -> impl Strategy<Value = Pair<D>> {
    let distance = prop_oneof![
        4 => 0.0..1.0f64,
        2 => (0..48i32).prop_map(|e| power_of_two(-e)),
        1 => Just(0.0),
        1 => 0.999_999..1.0f64,
    ];
    let one = prop_oneof![6 => -1.0..=1.0f64, 1 => Just(1.0), 1 => Just(-1.0), 1 => Just(0.0)];
    let one = one.boxed();
    // Up to the largest number of a state.
    let largest = prop_oneof![1 => Just(0.0), 12 => (-10..=51i32).prop_map(power_of_two)];
    (
        prop::array::uniform::<_, D>(-1.0..1.0f64),
        distance,
        prop::array::uniform12(largest),
        [
            prop::array::uniform12(one.clone()),
            prop::array::uniform12(one),
        ],
    )
        .prop_filter("a direction", |(x, ..)| x.iter().any(|x| x.abs() > 0.01))
        .prop_map(|(direction, distance, largest, read)| Pair {
            direction,
            distance,
            largest,
            read,
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn no_term_exceeds_its_bound_in_the_plane(models in models::<2>(), pair in pair()) {
        every_pass(&models, &mut Bounded(&pair))?;
    }

    #[test]
    fn no_term_exceeds_its_bound_in_space(models in models::<3>(), pair in pair()) {
        every_pass(&models, &mut Bounded(&pair))?;
    }

    #[test]
    fn terms_vanish_at_their_reach_and_beyond_in_the_plane(
        models in models::<2>(),
        pair in pair(),
    ) {
        every_pass(&models, &mut Vanishes(&pair))?;
    }

    #[test]
    fn terms_vanish_at_their_reach_and_beyond_in_space(
        models in models::<3>(),
        pair in pair(),
    ) {
        every_pass(&models, &mut Vanishes(&pair))?;
    }

    #[test]
    fn the_partner_receives_what_the_parity_says_in_the_plane(
        models in models::<2>(),
        pair in pair(),
    ) {
        every_pass(&models, &mut Exchanged(&pair))?;
    }

    #[test]
    fn the_partner_receives_what_the_parity_says_in_space(
        models in models::<3>(),
        pair in pair(),
    ) {
        every_pass(&models, &mut Exchanged(&pair))?;
    }
}

/// The wall's repulsion does not vanish beyond its radius: no bound, so that no row is made of it.
#[test]
fn a_pass_that_does_not_vanish_by_itself_has_no_bound() {
    let water = Water::<Fixed, 2>::new(Parameters {
        wall: conservative(),
        ..water()
    });
    let water = water.expect("in range");
    let wall = water.wall_pass(1e-3).expect("a wall");
    let (_, energy) = water.wall_energy_pass().expect("a wall");
    let r2 = 2.0 * PairPass::<2>::reach_squared(&wall);
    assert_ne!(
        PairPass::<2>::term(&wall, &[1e12, 0.0], r2, &[], &[])[0],
        0.0
    );
    assert_eq!(PairPass::<2>::bound(&wall, &[]), f64::INFINITY);
    assert_eq!(PairPass::<2>::bound(&energy, &[]), f64::INFINITY);
    let none = Parameters {
        wall: Wall::None,
        ..*water.parameters()
    };
    let none = Water::<Fixed, 2>::new(none).expect("in range");
    assert!(none.wall_pass(1e-3).is_none() && none.wall_energy_pass().is_none());
    assert!(none.anti_clump_pass(1e-3).is_none() && none.anti_clump_energy_pass().is_none());
}

loschmidt_core::values! {
    /// One of everything.
    struct Everything {
        /// One.
        scalar: T,
        /// D.
        vector: [T; D],
        /// D(D + 1)/2.
        symmetric: Symmetric<T, D>,
        /// D².
        matrix: [[T; D]; D],
        /// None.
        nothing: [T; 0],
        /// Another struct of numbers.
        inner: Inner<T, D>,
    }
    /// A struct within a struct.
    struct Inner {
        /// D.
        first: [T; D],
        /// One.
        last: T,
    }
}

/// Numbers come back as they were put, each from its own place.
fn round_trip<V: Values<i64> + PartialEq + std::fmt::Debug>(
    count: usize,
    numbers: &[i64],
    changed: &[(usize, i64)],
) {
    assert_eq!(V::COUNT, count);
    let mut asked = Vec::new();
    let mut values = V::from_fn(|k| {
        asked.push(k);
        numbers[k]
    });
    if count > 0 {
        // In order, each at least once.
        assert!(asked.is_sorted());
        asked.dedup();
        assert_eq!(asked, (0..count).collect::<Vec<_>>());
    }
    let mut expected = numbers[..count].to_vec();
    for &(place, number) in changed.iter().filter(|_| count > 0) {
        values.set(place % count, number);
        expected[place % count] = number;
    }
    let found: Vec<i64> = (0..count).map(|k| values.get(k)).collect();
    assert_eq!(found, expected);
    assert_eq!(V::from_fn(|k| expected[k]), values);
}

fn every_round_trip<const D: usize>(numbers: &[i64], changed: &[(usize, i64)]) {
    let triangle = D * (D + 1) / 2;
    round_trip::<i64>(1, numbers, changed);
    round_trip::<[i64; 0]>(0, numbers, changed);
    round_trip::<[i64; D]>(D, numbers, changed);
    round_trip::<[[i64; D]; D]>(D * D, numbers, changed);
    round_trip::<Symmetric<i64, D>>(triangle, numbers, changed);
    round_trip::<Inner<i64, D>>(D + 1, numbers, changed);
    let all = 1 + D + triangle + D * D + D + 1;
    round_trip::<Everything<i64, D>>(all, numbers, changed);
}

proptest! {
    #[test]
    fn named_numbers_are_put_and_found_in_the_order_of_their_names(
        numbers in prop::collection::vec(any::<i64>(), 30),
        changed in prop::collection::vec((0..1000usize, any::<i64>()), 0..8),
    ) {
        every_round_trip::<2>(&numbers, &changed);
        every_round_trip::<3>(&numbers, &changed);
    }

    #[test]
    fn a_symmetric_matrix_is_symmetric(
        numbers in prop::array::uniform6(any::<i64>()),
        (place, number) in (0..6usize, any::<i64>()),
    ) {
        let mut matrix = Symmetric::<i64, 3>::from_fn(|k| numbers[k]);
        let [a, b, c, d, e, f] = numbers;
        prop_assert_eq!(matrix.rows, [[a, b, c], [b, d, e], [c, e, f]]);
        matrix.set(place, number);
        for i in 0..3 {
            for j in 0..3 {
                prop_assert_eq!(matrix.rows[i][j], matrix.rows[j][i]);
            }
        }
    }
}

#[test]
fn numbers_are_found_by_their_names() {
    let all = Everything::<i64, 2>::from_fn(|k| k as i64);
    assert_eq!((all.scalar, all.vector), (0, [1, 2]));
    assert_eq!(all.symmetric.rows, [[3, 4], [4, 5]]);
    assert_eq!((all.matrix, all.nothing), ([[6, 7], [8, 9]], []));
    assert_eq!((all.inner.first, all.inner.last), ([10, 11], 12));
}
