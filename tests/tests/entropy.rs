//! The speed histogram, its entropy and its temperature.

use loschmidt_core::observe::{BINS, SpeedHistogram, equilibrium_entropy};
use loschmidt_core::owned::{Owned, words};
use loschmidt_core::{Diagnostics, Fixed, Model, Parameters, Serial, Symplectic};
use loschmidt_tests::generator::Generator;
use loschmidt_tests::permitted;
use loschmidt_tests::small::{Recipe, SPACING, lattice, measure, water};
use std::f64::consts::PI;

const PARTICLES: usize = 2000;
const SOUND_SPEED: f64 = 120.0;
/// Words for the fields in three dimensions, and so in two.
const MEMORY: usize = words(
    <Symplectic<Fixed, 3> as Model<Fixed, 3>>::FIELDS,
    3,
    PARTICLES,
    0,
);

/// The histogram of fluid particles with these velocities.
fn histogram<const D: usize>(velocities: &[[f64; D]]) -> SpeedHistogram {
    type Many<const D: usize> = Owned<Fixed, Symplectic<Fixed, D>, D, PARTICLES, 0, 2049, MEMORY>;
    let parameters = Parameters {
        sound_speed: SOUND_SPEED,
        max_buckets: 2048,
        ..water::<D>()
    };
    let model = Symplectic::new(parameters).unwrap();
    let mut system: Box<Many<D>> = Box::new(Owned::new(model).unwrap());
    for (index, v) in lattice([13, 13, 13]).zip(velocities) {
        let position = std::array::from_fn(|d| {
            // In the plane the layers lie side by side.
            let beside = if D == 2 && d == 0 { 13 * index[2] } else { 0 };
            SPACING * ((index[d] + beside) as f64 - 84.0)
        });
        system.push_fluid(position, *v).unwrap();
    }
    system.initialise(&Serial).unwrap();
    let (model, mut system) = system.parts();
    Diagnostics::measure(model, &mut system, &Serial)
        .unwrap()
        .histogram
}

/// Fraction of particles slower than v thermal speeds.
fn slower(dimension: usize, v: f64) -> f64 {
    if dimension == 2 {
        return 1.0 - (-0.5 * v * v).exp();
    }
    // Simpson's rule.
    let n = 400;
    let step = v / f64::from(n);
    let f = |x: f64| (2.0 / PI).sqrt() * x * x * (-0.5 * x * x).exp();
    let sum: f64 = (0..n)
        .map(|k| {
            let x = f64::from(k) * step;
            f(x) + 4.0 * f(x + 0.5 * step) + f(x + step)
        })
        .sum();
    sum * step / 6.0
}

/// Velocities whose speeds are the quantiles of the Maxwellian at kT/m.
fn maxwellian<const D: usize>(temperature: f64) -> Vec<[f64; D]> {
    let mut generator = Generator::new(9);
    (0..PARTICLES)
        .map(|i| {
            let wanted = (i as f64 + 0.5) / PARTICLES as f64;
            let (mut low, mut high) = (0.0, 12.0);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if slower(D, middle) < wanted {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let direction: [f64; D] = generator.vector(1.0);
            let norm = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
            direction.map(|x| x / norm * (low * temperature.sqrt()))
        })
        .collect()
}

fn equilibrium_is_recognised<const D: usize>() {
    for temperature in [2.0, 6.0, 12.0] {
        let h = histogram(&maxwellian::<D>(temperature));
        let exact = equilibrium_entropy(D, temperature).unwrap();
        for (what, s) in [
            ("entropy", h.entropy()),
            ("of energy", h.equilibrium_of_energy().unwrap()),
            ("of fit", h.equilibrium_of_fit().unwrap()),
        ] {
            assert!(
                (s - exact).abs() < permitted::ENTROPY,
                "{D} {temperature} {what} {s} {exact}"
            );
        }
        for t in [h.temperature_of_energy, h.fitted_temperature().unwrap()] {
            let error = t / temperature - 1.0;
            assert!(
                error.abs() < permitted::TEMPERATURE,
                "{D} {temperature} {error}"
            );
        }
    }
}

#[test]
fn the_bins_of_water_are_as_wide_as_files_of_earlier_programs_have_them() {
    // c/6 divided by the number of bins is another double for some of these.
    for c in 1..40 {
        let mut recipe = Recipe::block(water::<3>(), [2, 2, 2]);
        recipe.parameters.sound_speed = f64::from(c);
        let width = measure(&mut recipe.symplectic()).histogram.bin_width;
        assert_eq!(width, f64::from(c) / (6.0 * BINS as f64));
    }
}

#[test]
fn maxwellian_speeds_have_the_equilibrium_entropy_and_their_temperature_in_the_plane() {
    equilibrium_is_recognised::<2>();
}

#[test]
fn maxwellian_speeds_have_the_equilibrium_entropy_and_their_temperature_in_space() {
    equilibrium_is_recognised::<3>();
}

#[test]
fn the_fit_sees_the_bulk_and_the_energy_a_few_fast_ones() {
    let mut velocities = maxwellian::<2>(4.0);
    for v in velocities.iter_mut().take(20) {
        *v = [60.0, 0.0];
    }
    let h = histogram(&velocities);
    assert_eq!(h.beyond, 20);
    let error = h.fitted_temperature().unwrap() / 4.0 - 1.0;
    assert!(
        error.abs() < permitted::TEMPERATURE_WITH_OUTLIERS,
        "{error}"
    );
    assert!(h.temperature_of_energy > 20.0);
}

#[test]
fn equal_speeds_have_less_entropy_than_equilibrium() {
    let mut generator = Generator::new(1);
    let velocities: Vec<[f64; 2]> = (0..PARTICLES)
        .map(|_| {
            let a = PI * generator.signed();
            [3.05 * a.cos(), 3.05 * a.sin()]
        })
        .collect();
    let h = histogram(&velocities);
    assert!(h.entropy() < h.equilibrium_of_energy().unwrap() - 1.0);
}

#[test]
fn bins_are_a_hundred_equal_ones_up_to_a_sixth_of_the_sound_speed() {
    let width = SOUND_SPEED / 600.0;
    let speeds = [
        0.0,
        0.1 * width,
        0.9 * width,
        1.5 * width,
        98.5 * width,
        99.5 * width,
    ];
    let h = histogram(&speeds.map(|v| [v, 0.0]));
    assert_eq!(BINS, 100);
    assert_eq!(h.bin_width, width);
    let mut counts = [0; BINS];
    (counts[0], counts[1], counts[98], counts[99]) = (3, 1, 1, 1);
    assert_eq!((h.counts, h.beyond), (counts, 0));
    assert_eq!(h.midpoint(1), 1.5 * width);
}

#[test]
fn faster_particles_count_in_the_last_bin_and_are_counted() {
    let h = histogram(&[[0.0, -20.0], [15.0, 15.0], [19.9, 0.0], [200.0, 0.0]]);
    assert_eq!((h.counts[99], h.beyond), (4, 3));
    let all: f64 = (0..BINS).map(|k| h.density(k) * h.bin_width).sum();
    assert!((all - 1.0).abs() < permitted::HISTOGRAM_SUM);
}

#[test]
fn at_rest_entropy_is_finite_and_equilibrium_is_none() {
    let h = histogram(&[[0.0; 3]; 50]);
    assert!(h.entropy().is_finite());
    assert_eq!(h.temperature_of_energy, 0.0);
    assert_eq!(h.fitted_temperature(), None);
    assert_eq!(h.equilibrium_of_energy(), None);
    assert_eq!(h.equilibrium_of_fit(), None);
    for bad in [0.0, -1.0, f64::NAN] {
        assert_eq!(equilibrium_entropy(2, bad), None);
    }
    // Of nothing at all.
    let h = histogram::<2>(&[]);
    assert_eq!((h.entropy(), h.fitted_temperature()), (0.0, None));
}

#[test]
fn the_same_speeds_in_another_order_give_equal_bits() {
    let mut velocities = maxwellian::<3>(5.0);
    let first = histogram(&velocities);
    Generator::new(4).shuffle(velocities.len(), |a, b| velocities.swap(a, b));
    let second = histogram(&velocities);
    assert_eq!(first, second);
    assert_eq!(first.entropy().to_bits(), second.entropy().to_bits());
    assert_eq!(
        first.fitted_temperature().map(f64::to_bits),
        second.fitted_temperature().map(f64::to_bits)
    );
}

/// -∫ f ln(f/weight) dv over 12 thermal speeds, and ∫ f dv.
fn integrals(h: &SpeedHistogram, temperature: f64) -> [f64; 2] {
    let n = 4000;
    let step = 12.0 * temperature.sqrt() / f64::from(n);
    let term = |k: i32| {
        let v = f64::from(k) * step;
        let f = h.maxwell_boltzmann(temperature, v);
        if f > 0.0 {
            let weight = if h.dimension == 2 { v } else { v * v };
            [-f * (f / weight).ln(), f]
        } else {
            [0.0; 2]
        }
    };
    let mut sums = [0.0; 2];
    for k in 0..=n {
        let weight = if k == 0 || k == n {
            1.0
        } else {
            f64::from(2 + 2 * (k % 2))
        };
        let t = term(k);
        sums = [sums[0] + weight * t[0], sums[1] + weight * t[1]];
    }
    sums.map(|s| s * step / 3.0)
}

#[test]
fn equilibrium_formulas_are_the_integrals_of_the_maxwellian() {
    for h in [histogram(&[[1.0; 2]]), histogram(&[[1.0; 3]])] {
        for temperature in [0.1, 1.0, 7.3] {
            let [s, one] = integrals(&h, temperature);
            assert!((one - 1.0).abs() < permitted::ENTROPY_INTEGRAL);
            let formula = equilibrium_entropy(h.dimension, temperature).unwrap();
            assert!(
                (s - formula).abs() < permitted::ENTROPY_INTEGRAL,
                "{} {s} {formula}",
                h.dimension
            );
        }
    }
}
