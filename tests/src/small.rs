//! Small systems, the same recipe for every scheme, dimension and arithmetic.

use crate::generator::Generator;
use loschmidt_core::digest::Digest;
use loschmidt_core::fields::{POSITION, state_fields};
use loschmidt_core::integrator::STORMER_VERLET;
use loschmidt_core::model::{Relax, SetupError};
use loschmidt_core::number::{Arithmetic, Quantity};
use loschmidt_core::owned::{self, Owned};
use loschmidt_core::schemes::wcsph::{
    Central, DensityCorrection, Filter, Gravity, StateEquation, Wall, Water,
};
use loschmidt_core::{
    Diagnostics, Filtered, Fixed, Model, Parameters, Scale, Serial, Standard, Symplectic, System,
};

/// Distance of neighbours on the lattice, m.
pub const SPACING: f64 = 0.125;
/// Fluid particles that a small system holds.
pub const FLUID: usize = 256;
/// Wall particles that it holds.
pub const WALLS: usize = 512;
/// Words for each of its grids.
pub const BUCKETS: usize = 1025;

/// Words of memory for its fields: enough for three dimensions, and so for two.
pub const MEMORY: usize = owned::words(
    <Symplectic<Fixed, 3> as Model<Fixed, 3>>::FIELDS,
    3,
    FLUID,
    WALLS,
);

/// A small system.
pub type Small<M, const D: usize, A = Fixed> = Owned<A, M, D, FLUID, WALLS, BUCKETS, MEMORY>;

/// A scheme of water: made from its parameters.
pub trait Scheme<A: Arithmetic, const D: usize>: Model<A, D> {
    /// The scheme with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    fn of(parameters: Parameters<D>) -> Result<Self, SetupError>;
    /// What the schemes share.
    fn water(&self) -> &Water<A, D>;
}

impl<A: Arithmetic, const D: usize> Scheme<A, D> for Symplectic<A, D> {
    fn of(parameters: Parameters<D>) -> Result<Self, SetupError> {
        Self::new(parameters)
    }
    fn water(&self) -> &Water<A, D> {
        self.water()
    }
}

impl<A: Arithmetic, const D: usize> Scheme<A, D> for Standard<A, D> {
    fn of(parameters: Parameters<D>) -> Result<Self, SetupError> {
        Self::new(parameters)
    }
    fn water(&self) -> &Water<A, D> {
        self.water()
    }
}

impl<A: Arithmetic, const D: usize> Scheme<A, D> for Filtered<A, D> {
    fn of(parameters: Parameters<D>) -> Result<Self, SetupError> {
        Filter::filtered(parameters)
    }
    fn water(&self) -> &Water<A, D> {
        self.0.scheme().water()
    }
}

/// Water at a sound speed of 20 m/s: no gravity, no walls, support of three spacings.
#[must_use]
pub fn water<const D: usize>() -> Parameters<D> {
    Parameters {
        support_radius: 3.0 * SPACING,
        time_step: 0.2 * 3.0 * SPACING / 20.0,
        mass: 1000.0 * SPACING.powi(D as i32),
        reference_density: 1000.0,
        sound_speed: 20.0,
        state_equation: StateEquation::Tait,
        density_correction: DensityCorrection::Constant,
        gravity: Gravity {
            uniform: [0.0; D],
            central: None,
        },
        wall: Wall::None,
        anti_clump: None,
        filter_every: 0,
        integrator: &STORMER_VERLET,
        scale: Scale::with_headroom(4.0, 20.0, 1000.0),
        extent: [2.0; D],
        max_buckets: BUCKETS - 1,
    }
}

/// 9.81 m/s² downwards: along the last axis.
#[must_use]
pub fn downwards<const D: usize>() -> Gravity<D> {
    let mut uniform = [0.0; D];
    uniform[D - 1] = -9.81;
    Gravity {
        uniform,
        central: None,
    }
}

/// A fixed mass at 0.3 m along every axis.
#[must_use]
pub fn central<const D: usize>() -> Gravity<D> {
    Gravity {
        uniform: [0.0; D],
        central: Some(Central {
            centre: [0.3; D],
            strength: 3.0,
            softening: 0.2,
        }),
    }
}

/// The conservative wall of a dam break 1 m high.
#[must_use]
pub fn conservative() -> Wall {
    Wall::Conservative {
        energy: 98.1,
        radius: 1.05 * SPACING,
        softening: 0.25 * SPACING,
    }
}

/// Particles to be: what a system is built from.
#[derive(Clone, Debug)]
pub struct Recipe<const D: usize> {
    /// Of the model.
    pub parameters: Parameters<D>,
    /// Position (m) and velocity (m/s) of each.
    pub fluid: Vec<([f64; D], [f64; D])>,
    /// Positions, m.
    pub walls: Vec<[f64; D]>,
}

/// Every index of a lattice of `size`, the first axis fastest.
pub fn lattice<const D: usize>(size: [i64; D]) -> impl Iterator<Item = [i64; D]> {
    (0..size.iter().product::<i64>()).map(move |mut rest| {
        size.map(|n| {
            let i = rest % n;
            rest /= n;
            i
        })
    })
}

impl<const D: usize> Recipe<D> {
    /// No particles.
    #[must_use]
    pub fn empty(parameters: Parameters<D>) -> Self {
        Self {
            parameters,
            fluid: Vec::new(),
            walls: Vec::new(),
        }
    }

    /// A resting block of `size` lattice points, its corner half a spacing from the origin.
    #[must_use]
    pub fn block(parameters: Parameters<D>, size: [i64; D]) -> Self {
        let mut recipe = Self::empty(parameters);
        for index in lattice(size) {
            let position = index.map(|i| (i as f64 + 0.5) * SPACING);
            recipe.fluid.push((position, [0.0; D]));
        }
        recipe
    }

    /// The same block in a box of `inside` lattice points with walls of `layers` on all sides.
    #[must_use]
    pub fn boxed(parameters: Parameters<D>, size: [i64; D], inside: [i64; D], layers: i64) -> Self {
        let mut recipe = Self::block(parameters, size);
        for index in lattice(inside.map(|n| n + 2 * layers)) {
            let index: [i64; D] = index.map(|i| i - layers);
            if (0..D).any(|d| index[d] < 0 || index[d] >= inside[d]) {
                recipe.walls.push(index.map(|i| (i as f64 + 0.5) * SPACING));
            }
        }
        recipe
    }

    /// With velocities of up to `speed` along every axis.
    #[must_use]
    pub fn stirred(mut self, seed: u64, speed: f64) -> Self {
        let mut generator = Generator::new(seed);
        for (_, v) in &mut self.fluid {
            *v = generator.vector(speed);
        }
        self
    }

    /// With positions moved by up to `distance` along every axis.
    #[must_use]
    pub fn jittered(mut self, seed: u64, distance: f64) -> Self {
        let mut generator = Generator::new(seed);
        for (x, _) in &mut self.fluid {
            let shift: [f64; D] = generator.vector(distance);
            *x = core::array::from_fn(|d| x[d] + shift[d]);
        }
        self
    }

    /// The particles in a system of any scheme and arithmetic; not yet initialised.
    ///
    /// # Panics
    /// If they do not fit.
    #[must_use]
    pub fn place<A: Arithmetic, M: Scheme<A, D>>(&self) -> Box<Small<M, D, A>> {
        let model = M::of(self.parameters).expect("parameters in range");
        let mut system = Box::new(Small::new(model).expect("buckets and words"));
        for (x, v) in &self.fluid {
            system.push_fluid(*x, *v).expect("room for the fluid");
        }
        for x in &self.walls {
            system.push_wall(*x).expect("room for the walls");
        }
        system
    }

    /// Placed and initialised.
    ///
    /// # Panics
    /// If they do not fit.
    #[must_use]
    pub fn build<A: Arithmetic, M: Scheme<A, D>>(&self) -> Box<Small<M, D, A>> {
        let mut system = self.place::<A, M>();
        system.initialise(&Serial).expect("densities in range");
        system
    }

    /// The reversible scheme in fixed point.
    #[must_use]
    pub fn symplectic(&self) -> Box<Small<Symplectic<Fixed, D>, D>> {
        self.build()
    }
}

/// A dam of 4 x 6 particles in a closed box with gravity, in two dimensions.
#[must_use]
pub fn dam_2d(
    wall: Wall,
    integrator: &'static loschmidt_core::integrator::Integrator,
) -> Recipe<2> {
    let parameters = Parameters {
        gravity: downwards(),
        wall,
        integrator,
        ..water()
    };
    Recipe::boxed(parameters, [4, 6], [9, 7], 2)
}

/// A dam of 2 x 2 x 3 particles in a closed box with gravity, in three dimensions.
#[must_use]
pub fn dam_3d(
    wall: Wall,
    integrator: &'static loschmidt_core::integrator::Integrator,
) -> Recipe<3> {
    let parameters = Parameters {
        gravity: downwards(),
        wall,
        integrator,
        ..water()
    };
    Recipe::boxed(parameters, [2, 2, 3], [4, 3, 4], 2)
}

/// Measures.
///
/// # Panics
/// If the densities are out of range.
#[must_use]
pub fn measure<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
) -> Diagnostics {
    let (model, mut system) = system.parts();
    Diagnostics::measure(model, &mut system, &Serial).expect("densities in range")
}

/// Moves component `d` of the particle in this place by `quanta`.
pub fn displace<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
    place: usize,
    d: usize,
    quanta: i64,
) {
    let (_, mut system) = system.parts();
    let word = system.particles.word(POSITION, d, place);
    system.particles.set_word(POSITION, d, place, word + quanta);
}

/// Stores the fluid in another order.
pub fn shuffle<A: Arithmetic, const D: usize>(system: &mut System<'_, A, D>, seed: u64) {
    let particles = system.particles.len();
    let (id, fields) = system.particles.parts();
    let mut fields: Vec<_> = fields.collect();
    Generator::new(seed).shuffle(particles, |a, b| {
        id.swap(a, b);
        for (each, words) in &mut fields {
            for c in 0..*each {
                words.swap(a * *each + c, b * *each + c);
            }
        }
    });
}

/// Every word of the state, by id.
pub fn words<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
) -> Vec<(u64, Vec<i64>)> {
    words_of(&system.parts().1)
}

/// Every word of the state of a system, by id.
#[must_use]
pub fn words_of<A: Arithmetic, const D: usize>(system: &System<'_, A, D>) -> Vec<(u64, Vec<i64>)> {
    let set = &system.particles;
    let fields = state_fields(set.fields(), set.side());
    let mut all: Vec<(u64, Vec<i64>)> = (0..set.len())
        .map(|place| {
            let components = fields.clone().flat_map(|(f, field)| {
                let components = 0..field.words(set.side(), D);
                components.map(move |c| (f, c))
            });
            let words = components.map(|(f, c)| set.word(f, c, place)).collect();
            (set.id[place], words)
        })
        .collect();
    all.sort();
    all
}

/// The digests of the first state, after `steps` steps, and after the return.
///
/// # Panics
/// If the run leaves the number range.
pub fn there_and_back<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
    steps: u64,
) -> [Digest; 3] {
    let first = system.digest();
    system.advance(steps, &Serial).expect("in range");
    let far = system.digest();
    system.reverse();
    system.advance(steps, &Serial).expect("in range");
    system.reverse();
    [first, far, system.digest()]
}

/// Velocity of the particle in this place, m/s.
pub fn velocity<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
    place: usize,
) -> [f64; D] {
    let quantum = system.model().scale().speed_quantum();
    let (_, system) = system.parts();
    system.particles.velocity()[place].map(|v| v.quanta() * quantum)
}

/// Position of the particle in this place, m.
pub fn position<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &mut Small<M, D, A>,
    place: usize,
) -> [f64; D] {
    let quantum = system.model().scale().length_quantum();
    let (_, system) = system.parts();
    system.particles.position()[place].map(|x| x.quanta() * quantum)
}
