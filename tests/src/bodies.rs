//! Elastic bodies, the same recipe for every material, dimension and arithmetic.

use crate::generator::Generator;
use loschmidt_core::fields::{Side, words_each};
use loschmidt_core::model::Model;
use loschmidt_core::owned::Owned;
use loschmidt_core::schemes::solid::{Material, Parameters, Part, ShearEnergy, Solid};
use loschmidt_core::{Arithmetic, Fixed, Scale};
use loschmidt_runner::scene::InitialState;

/// Distance of the particles, in the sense of their volume, m.
pub const SPACING: f64 = 0.125;
/// Particles that a small body holds.
pub const PARTICLES: usize = 256;
/// Words for each of its grids.
pub const BUCKETS: usize = 1025;
/// Words of memory for its fields: enough for three dimensions, and so for two.
pub const MEMORY: usize = PARTICLES
    * words_each(
        <Solid<Fixed, 3> as Model<Fixed, 3>>::FIELDS,
        Side::Particles,
        3,
    );

/// A small body on memory of its own.
pub type Body<M, const D: usize, A = Fixed> = Owned<A, M, D, PARTICLES, 0, BUCKETS, MEMORY>;

/// A material with c_0 = 20 m/s, c_s = 12 m/s and c_p = c_0.
#[must_use]
pub fn material(energy: ShearEnergy) -> Material {
    Material {
        bulk_speed: 20.0,
        shear_speed: 12.0,
        penalty_speed: 20.0,
        energy,
    }
}

/// One free body of this material, of 1000 kg/m³, with a support of three spacings.
#[must_use]
pub fn free_body<const D: usize>(material: Material) -> Parameters<D> {
    Parameters {
        support_radius: 3.0 * SPACING,
        particle_spacing: SPACING,
        time_step: 0.1 * SPACING / material.longitudinal_speed(),
        reference_density: 1000.0,
        materials: [material].into_iter().collect(),
        parts: [Part::default()].into_iter().collect(),
        gravity: [0.0; D],
        scale: Scale::with_headroom(4.0, 40.0, 1000.0),
        extent: [4.0; D],
        max_buckets: BUCKETS - 1,
    }
}

/// A block of so many particles along each axis on the square or cubic lattice, its middle in the
/// origin, at rest.
#[must_use]
pub fn block<const D: usize>(counts: [usize; D]) -> InitialState {
    let mut fluid = vec![[0.0; 3]];
    for (d, &count) in counts.iter().enumerate() {
        let middle = (count - 1) as f64 / 2.0;
        let along = |x: &[f64; 3]| {
            let x = *x;
            (0..count).map(move |k| {
                let mut x = x;
                x[d] = (k as f64 - middle) * SPACING;
                x
            })
        };
        fluid = fluid.iter().flat_map(along).collect();
    }
    InitialState {
        fluid_velocity: vec![[0.0; 3]; fluid.len()],
        fluid,
        ..InitialState::default()
    }
}

/// The same block with velocities of up to `speed` m/s along each axis, and spinning at `spin`
/// rad/s about an oblique axis (in the plane: about the third).
pub fn stir<const D: usize>(state: &mut InitialState, speed: f64, spin: f64, seed: u64) {
    let mut generator = Generator::new(seed);
    let axis = if D == 2 {
        [0.0, 0.0, spin]
    } else {
        [0.3 * spin, 0.5 * spin, 0.8 * spin]
    };
    for (x, v) in state.fluid.iter().zip(&mut state.fluid_velocity) {
        let turning = [
            axis[1] * x[2] - axis[2] * x[1],
            axis[2] * x[0] - axis[0] * x[2],
            axis[0] * x[1] - axis[1] * x[0],
        ];
        for d in 0..D {
            v[d] = turning[d] + speed * generator.signed();
        }
    }
}

/// The state in memory of fixed size, initialised.
///
/// # Panics
/// If it does not fit.
pub fn body<A: Arithmetic, M: Model<A, D>, const D: usize>(
    model: M,
    state: &InitialState,
) -> Body<M, D, A> {
    let mut body = Body::new(model).expect("room");
    for (x, v) in state.fluid.iter().zip(&state.fluid_velocity) {
        let (x, v) = (std::array::from_fn(|d| x[d]), std::array::from_fn(|d| v[d]));
        body.push_fluid(x, v).expect("room");
    }
    body.initialise(&loschmidt_core::Serial).expect("a body");
    body
}
