//! A system that owns its memory, in vectors of fixed capacity.
//!
//! ```
//! use loschmidt_core::integrator::STORMER_VERLET;
//! use loschmidt_core::model::{DensityCorrection, Gravity, StateEquation, Wall};
//! use loschmidt_core::owned::Owned;
//! use loschmidt_core::{Fixed, Forces, Model, Parameters, Scale, Serial, Symplectic};
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
//! let model = Symplectic::<Fixed, 2>::new(Forces::new(parameters)?);
//! let mut drop = Owned::<Fixed, _, 2, 25, 0, 65>::new(model)?;
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
//! generics: N fluid particles, W wall particles, and B >= buckets + 1 words for each grid. A push
//! beyond the capacity gives the particle back.

use crate::executor::Executor;
use crate::fault::{CapacityError, Fault};
use crate::model::Model;
use crate::neighbours::Cells;
use crate::number::{Arithmetic, Quantity, Scale};
use crate::state::{Progress, Scratch, State, System, Walls};
use heapless::Vec;

/// A system in `heapless` vectors.
#[derive(Debug)]
pub struct Owned<A: Arithmetic, M, const D: usize, const N: usize, const W: usize, const B: usize> {
    model: M,
    id: Vec<u64, N>,
    position: Vec<[A::Length; D], N>,
    velocity: Vec<[A::Speed; D], N>,
    density: Vec<A::Density, N>,
    wall_position: Vec<[A::Length; D], W>,
    wall_velocity: Vec<[A::Speed; D], W>,
    wall_density: Vec<A::Density, W>,
    progress: Progress,
    scratch_density: Vec<A::Density, N>,
    scratch_pressure: Vec<A::Real, N>,
    scratch_impulse: Vec<[A::Speed; D], N>,
    scratch_order: Vec<u32, N>,
    scratch_start: Vec<u32, B>,
    scratch_wall_order: Vec<u32, W>,
    scratch_wall_start: Vec<u32, B>,
    scratch_wall_density: Vec<A::Density, W>,
    scratch_wall_fixed: Vec<A::Density, W>,
    scratch_wall_pressure: Vec<A::Real, W>,
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

impl<A, M, const D: usize, const N: usize, const W: usize, const B: usize> Owned<A, M, D, N, W, B>
where
    A: Arithmetic,
    M: Model<A, D>,
{
    /// An empty system.
    ///
    /// # Errors
    /// B is smaller than one of the grids needs.
    pub fn new(model: M) -> Result<Self, CapacityError> {
        let needed = 1 + model
            .forces()
            .grid()
            .buckets()
            .max(model.forces().wall_grid().buckets());
        let mut scratch_start = Vec::new();
        let mut scratch_wall_start = Vec::new();
        let error = CapacityError {
            what: "cell start",
            needed,
            given: B,
        };
        scratch_start
            .resize(1 + model.forces().grid().buckets(), 0)
            .map_err(|_| error)?;
        scratch_wall_start
            .resize(1 + model.forces().wall_grid().buckets(), 0)
            .map_err(|_| error)?;
        Ok(Self {
            model,
            id: Vec::new(),
            position: Vec::new(),
            velocity: Vec::new(),
            density: Vec::new(),
            wall_position: Vec::new(),
            wall_velocity: Vec::new(),
            wall_density: Vec::new(),
            progress: Progress::default(),
            scratch_density: Vec::new(),
            scratch_pressure: Vec::new(),
            scratch_impulse: Vec::new(),
            scratch_order: Vec::new(),
            scratch_start,
            scratch_wall_order: Vec::new(),
            scratch_wall_start,
            scratch_wall_density: Vec::new(),
            scratch_wall_fixed: Vec::new(),
            scratch_wall_pressure: Vec::new(),
        })
    }

    fn scale(&self) -> Scale {
        self.model.forces().parameters().scale
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
        let full = PushError::Full { position };
        let x = to_quanta(position, scale.length_quantum()).ok_or(range)?;
        let v = to_quanta(velocity, scale.speed_quantum()).ok_or(range)?;
        self.id.push(self.id.len() as u64).map_err(|_| full)?;
        // All of these have the capacity of `id`, which had room.
        let _ = self.position.push(x);
        let _ = self.velocity.push(v);
        let _ = self.density.push(A::Density::ZERO);
        let _ = self.scratch_density.push(A::Density::ZERO);
        let _ = self
            .scratch_pressure
            .push(crate::number::Real::from_f64(0.0));
        let _ = self.scratch_impulse.push([A::Speed::ZERO; D]);
        let _ = self.scratch_order.push(0);
        self.progress.invalidate();
        Ok(())
    }

    /// Adds a wall particle at `position` (m).
    ///
    /// # Errors
    /// The particle comes back when there is no room or it is out of range.
    pub fn push_wall(&mut self, position: [f64; D]) -> Result<(), PushError<D>> {
        let x = to_quanta(position, self.scale().length_quantum())
            .ok_or(PushError::Range { position })?;
        self.wall_position
            .push(x)
            .map_err(|_| PushError::Full { position })?;
        let _ = self.wall_velocity.push([A::Speed::ZERO; D]);
        let _ = self.wall_density.push(A::Density::ZERO);
        let _ = self.scratch_wall_order.push(0);
        let _ = self.scratch_wall_density.push(A::Density::ZERO);
        let _ = self.scratch_wall_fixed.push(A::Density::ZERO);
        let _ = self
            .scratch_wall_pressure
            .push(crate::number::Real::from_f64(0.0));
        self.progress.invalidate();
        Ok(())
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Model and system, the latter as borrowed slices.
    pub fn parts(&mut self) -> (&M, System<'_, A, D>) {
        let system = System {
            state: State {
                id: &mut self.id,
                position: &mut self.position,
                velocity: &mut self.velocity,
                density: &mut self.density,
                density_role: M::DENSITY_ROLE,
            },
            walls: Walls {
                position: &mut self.wall_position,
                velocity: &mut self.wall_velocity,
                density: &mut self.wall_density,
            },
            scratch: Scratch {
                density: &mut self.scratch_density,
                pressure: &mut self.scratch_pressure,
                impulse: &mut self.scratch_impulse,
                cells: Cells {
                    start: &mut self.scratch_start,
                    order: &mut self.scratch_order,
                },
                wall_cells: Cells {
                    start: &mut self.scratch_wall_start,
                    order: &mut self.scratch_wall_order,
                },
                wall_density: &mut self.scratch_wall_density,
                wall_density_fixed: &mut self.scratch_wall_fixed,
                wall_pressure: &mut self.scratch_wall_pressure,
            },
            progress: &mut self.progress,
        };
        (&self.model, system)
    }

    /// Computes the density constants (or densities) of the initial state.
    ///
    /// # Errors
    /// As [`Model::initialise`].
    pub fn initialise<E: Executor>(&mut self, exec: &E) -> Result<(), Fault> {
        let (model, mut system) = self.parts();
        model.initialise(&mut system, exec)
    }

    /// Takes `steps` steps.
    ///
    /// # Errors
    /// As [`Model::step`].
    pub fn advance<E: Executor>(&mut self, steps: u64, exec: &E) -> Result<(), Fault> {
        let (model, mut system) = self.parts();
        model.steps(&mut system, exec, steps)
    }

    /// Turns time round.
    pub fn reverse(&mut self) {
        self.parts().1.reverse();
    }

    /// The digest of the present state.
    pub fn digest(&mut self) -> crate::Digest {
        let scale = self.scale();
        crate::digest::digest(&self.parts().1, &scale)
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
