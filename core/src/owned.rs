//! A system that owns its memory, in vectors of fixed capacity.
//!
//! ```
//! use loschmidt_core::integrator::STORMER_VERLET;
//! use loschmidt_core::owned::{Owned, words};
//! use loschmidt_core::schemes::wcsph::{DensityCorrection, Gravity, StateEquation, Wall};
//! use loschmidt_core::{Fixed, Model, Parameters, Scale, Serial, Symplectic};
//!
//! let spacing = 0.1; // m
//! let parameters = Parameters {
//!     support_radius: 3.0 * spacing,
//!     time_step: 0.2 * 3.0 * spacing / 20.0,  // 0.2 h/c
//!     mass: 1000.0 * spacing * spacing,       // reference density times the area of a particle
//!     reference_density: 1000.0,
//!     sound_speed: 20.0,
//!     state_equation: StateEquation::Tait,
//!     density_correction: DensityCorrection::Constant,
//!     gravity: Gravity { uniform: [0.0, -9.8], central: None },
//!     wall: Wall::None,
//!     anti_clump: None,
//!     filter_every: 0,
//!     integrator: &STORMER_VERLET,
//!     scale: Scale::with_headroom(1.0, 20.0, 1000.0),
//!     extent: [1.0, 1.0],
//!     max_buckets: 64,                        // so that B = 65 is enough
//! };
//! type Water = Symplectic<Fixed, 2>;
//! const WORDS: usize = words(<Water as Model<Fixed, 2>>::FIELDS, 2, 25, 0);
//! let model = Water::new(parameters)?;
//! let mut drop = Owned::<Fixed, _, 2, 25, 0, 65, WORDS>::new(model)?;
//! for i in 0..25 {
//!     let at = |k: i32| (f64::from(k) + 0.5) * spacing;
//!     drop.push_fluid([at(i % 5), at(i / 5)], [0.0, 0.0])?;
//! }
//! drop.initialise(&Serial)?;                  // once, after the last particle
//! let home = drop.digest();
//! drop.advance(100, &Serial)?;
//! drop.reverse();
//! drop.advance(100, &Serial)?;
//! drop.reverse();                             // velocities along time again, as at home
//! assert_eq!(drop.digest(), home);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! For targets without an allocator, and for small systems in tests. Capacities are const
//! generics: N fluid particles, W wall particles, B >= buckets + 1 words for each grid, and K words
//! of memory for the fields ([`words`]). A push beyond the capacity gives the particle back.

use crate::executor::Executor;
use crate::fault::check_capacity;
use crate::fault::{CapacityError, Fault};
use crate::fields::{Field, Side, words_each};
use crate::model::Model;
use crate::neighbours::{Cells, Grid};
use crate::number::{Arithmetic, Quantity, Scale};
use crate::set::Set;
use crate::system::{Clock, System};
use heapless::Vec;

/// Words of memory that so many particles and walls with these fields take.
#[must_use]
pub const fn words(fields: &[Field], dimension: usize, particles: usize, walls: usize) -> usize {
    particles * words_each(fields, Side::Particles, dimension)
        + walls * words_each(fields, Side::Walls, dimension)
}

/// A system in arrays and `heapless` vectors.
#[derive(Debug)]
pub struct Owned<
    A: Arithmetic,
    M,
    const D: usize,
    const N: usize,
    const W: usize,
    const B: usize,
    const K: usize,
> {
    model: M,
    id: Vec<u64, N>,
    wall_id: Vec<u64, W>,
    memory: [A::Word; K],
    clock: Clock,
    /// Whether the model has seen the walls since the last push.
    walls_placed: bool,
    start: [u32; B],
    order: [u32; N],
    wall_start: [u32; B],
    wall_order: [u32; W],
}

/// A particle was not taken.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PushError<const D: usize> {
    /// The vectors are full; the particle comes back.
    #[error("no room for another particle")]
    Full {
        /// m.
        position: [f64; D],
    },
    /// A coordinate or velocity is outside the range of the scale.
    #[error("the particle is outside the number range")]
    Range {
        /// m.
        position: [f64; D],
    },
}

impl<A, M, const D: usize, const N: usize, const W: usize, const B: usize, const K: usize>
    Owned<A, M, D, N, W, B, K>
where
    A: Arithmetic,
    M: Model<A, D>,
{
    /// An empty system.
    ///
    /// # Errors
    /// B is smaller than one of the grids needs, or K than [`words`] says.
    pub fn new(model: M) -> Result<Self, CapacityError> {
        let [grid, wall_grid] = model.grids().map(Grid::buckets);
        check_capacity("cell start", 1 + grid.max(wall_grid), B)?;
        check_capacity("words of memory", words(M::FIELDS, D, N, W), K)?;
        Ok(Self {
            model,
            id: Vec::new(),
            wall_id: Vec::new(),
            memory: [A::Word::ZERO; K],
            clock: Clock::default(),
            walls_placed: false,
            start: [0; B],
            order: [0; N],
            wall_start: [0; B],
            wall_order: [0; W],
        })
    }

    fn scale(&self) -> Scale {
        self.model.scale()
    }

    /// Adds a fluid particle at `position` (m) with `velocity` (m/s); ids count from 0.
    ///
    /// # Errors
    /// The particle comes back when there is no room or it is out of range.
    pub fn push_fluid(
        &mut self,
        position: [f64; D],
        velocity: [f64; D],
    ) -> Result<(), PushError<D>> {
        let scale = self.scale();
        let range = PushError::Range { position };
        let x = to_quanta(position, scale.length_quantum()).ok_or(range)?;
        let v = to_quanta(velocity, scale.speed_quantum()).ok_or(range)?;
        let place = self.id.len();
        self.id
            .push(place as u64)
            .map_err(|_| PushError::Full { position })?;
        self.walls_placed = false;
        let (_, mut system) = self.parts();
        system.particles.position_mut()[place] = x;
        system.particles.velocity_mut()[place] = v;
        Ok(())
    }

    /// Adds a wall particle at `position` (m).
    ///
    /// # Errors
    /// The particle comes back when there is no room or it is out of range.
    pub fn push_wall(&mut self, position: [f64; D]) -> Result<(), PushError<D>> {
        let x = to_quanta(position, self.scale().length_quantum())
            .ok_or(PushError::Range { position })?;
        let place = self.wall_id.len();
        self.wall_id
            .push(0)
            .map_err(|_| PushError::Full { position })?;
        self.walls_placed = false;
        let (_, mut system) = self.parts();
        system.walls.position_mut()[place] = x;
        Ok(())
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Model and system, the latter on borrowed memory.
    pub fn parts(&mut self) -> (&M, System<'_, A, D>) {
        let grids = self.model.grids();
        let [buckets, wall_buckets] = grids.map(Grid::buckets);
        let (n, w) = (self.id.len(), self.wall_id.len());
        let of_particles = N * words_each(M::FIELDS, Side::Particles, D);
        let (memory, wall_memory) = self.memory.split_at_mut(of_particles);
        let particles = Set::over(&mut self.id, memory, N, M::FIELDS, Side::Particles);
        let walls = Set::over(&mut self.wall_id, wall_memory, W, M::FIELDS, Side::Walls);
        let system = System {
            // `new` has compared all sizes.
            particles: particles.unwrap_or_else(|error| unreachable!("{error}")),
            walls: walls.unwrap_or_else(|error| unreachable!("{error}")),
            grids,
            cells: Cells {
                start: &mut self.start[..=buckets],
                order: &mut self.order[..n],
            },
            wall_cells: Cells {
                start: &mut self.wall_start[..=wall_buckets],
                order: &mut self.wall_order[..w],
            },
            clock: &mut self.clock,
        };
        (&self.model, system)
    }

    /// Sets up what follows from the initial positions; after the last particle.
    ///
    /// # Errors
    /// As [`Model::initialise`].
    pub fn initialise<E: Executor>(&mut self, exec: &E) -> Result<(), Fault> {
        self.walls_placed = true;
        let (model, mut system) = self.parts();
        model.initialise(&mut system, exec)
    }

    /// Takes `steps` steps.
    ///
    /// # Errors
    /// As [`Model::step`].
    pub fn advance<E: Executor>(&mut self, steps: u64, exec: &E) -> Result<(), Fault> {
        let placed = core::mem::replace(&mut self.walls_placed, true);
        let (model, mut system) = self.parts();
        if !placed && system.clock.initialised {
            model.place_walls(&mut system, exec)?;
        }
        (0..steps).try_for_each(|_| model.step(&mut system, exec))
    }

    /// Turns time round.
    pub fn reverse(&mut self) {
        self.parts().1.reverse();
    }

    /// The digest of the present state.
    pub fn digest(&mut self) -> crate::Digest {
        let scale = self.scale();
        let (_, mut system) = self.parts();
        system.prepare_walls();
        crate::digest::digest(&system, &scale)
    }
}

/// SI components in quanta, rounded once; `None` out of range.
pub fn to_quanta<Q: Quantity, const D: usize>(si: [f64; D], quantum: f64) -> Option<[Q; D]> {
    let mut out = [Q::ZERO; D];
    for (o, s) in out.iter_mut().zip(si) {
        *o = o.add_rounded(s / quantum)?;
        if !o.in_range() {
            return None;
        }
    }
    Some(out)
}
