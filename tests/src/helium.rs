//! Drops of helium, the same recipe for every dimension and arithmetic.

use crate::generator::Generator;
use loschmidt_core::Scale;
use loschmidt_core::schemes::superfluid::{Helium, HeliumParameters, Operators};
use loschmidt_runner::scene::{GivenField, InitialState};

/// Distance of the particles, m.
pub const SPACING: f64 = 2e-4;

/// A drop at 1.9 K with a support of three spacings, the step a tenth of what sound takes to cross a
/// spacing.
#[must_use]
pub fn drop<const D: usize>(operators: Operators) -> HeliumParameters<D> {
    let helium = Helium::AT_1_90_K;
    HeliumParameters {
        support_radius: 3.0 * SPACING,
        particle_spacing: SPACING,
        time_step: 0.1 * SPACING / helium.sound_speed,
        helium,
        operators,
        first_excess: 0.0,
        viscosity: 0.0,
        diffusion: 0.0,
        mutual_friction: 0.0,
        most_separation: f64::INFINITY,
        gravity: [0.0; D],
        surface: None,
        walls: core::iter::empty().collect(),
        suction: false,
        heater: None,
        superleak: None,
        speed_bin: 0.1,
        scale: Scale::with_headroom(4e-3, helium.sound_speed, helium.reference_density),
        extent: [4e-3; D],
        max_buckets: 1024,
    }
}

/// Puts four layers of walls under and beside such a block, on its lattice.
pub fn wall_in<const D: usize>(state: &mut InitialState, counts: [usize; D]) {
    const DEPTH: usize = 4;
    let around = crate::bodies::block(counts.map(|count| count + 2 * DEPTH));
    let factor = SPACING / crate::bodies::SPACING;
    let inside = |x: &[f64; 3]| {
        (0..D).all(|d| {
            let half = 0.5 * counts[d] as f64 * SPACING;
            // It is open above.
            x[d] > -half && (x[d] < half || d == D - 1)
        })
    };
    let places = around.fluid.iter().map(|x| x.map(|x| x * factor));
    state.wall = places.filter(|x| !inside(x)).collect();
}

/// So many particles along each axis on the square or cubic lattice, each moved by up to a tenth of
/// a spacing, with velocities and a counterflow of up to `speed` m/s and entropies that differ by up
/// to `warmth` of the reference.
#[must_use]
pub fn stirred<const D: usize>(
    counts: [usize; D],
    speed: f64,
    warmth: f64,
    seed: u64,
) -> InitialState {
    let mut generator = Generator::new(seed);
    let mut state = crate::bodies::block(counts);
    let factor = SPACING / crate::bodies::SPACING;
    let n = state.fluid.len();
    let mut vector = |most: f64| {
        let mut x = [0.0; 3];
        for x in &mut x[..D] {
            *x = most * generator.signed();
        }
        x
    };
    for (x, v) in state.fluid.iter_mut().zip(&mut state.fluid_velocity) {
        let by = vector(0.1 * SPACING);
        for (x, by) in x.iter_mut().zip(by) {
            *x = *x * factor + by;
        }
        *v = vector(speed);
    }
    for (name, most) in [("counterflow", speed), ("entropy", warmth)] {
        let values = (0..n).map(|_| vector(most)).collect();
        state.given.push(GivenField { name, values });
    }
    state
}
