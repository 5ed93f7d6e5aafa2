//! A system in vectors.

use loschmidt_core::neighbours::Cells;
use loschmidt_core::number::{Quantity, Real};
use loschmidt_core::state::DensityRole;
use loschmidt_core::{Arithmetic, Forces, Progress, Scratch, State, System, Walls};

/// Owns what the core borrows.
#[derive(Debug)]
pub(crate) struct Storage<A: Arithmetic, const D: usize> {
    id: Vec<u64>,
    position: Vec<[A::Length; D]>,
    velocity: Vec<[A::Speed; D]>,
    density: Vec<A::Density>,
    density_role: DensityRole,
    wall_position: Vec<[A::Length; D]>,
    wall_velocity: Vec<[A::Speed; D]>,
    wall_density: Vec<A::Density>,
    pub progress: Progress,
    scratch: OwnedScratch<A, D>,
}

#[derive(Debug)]
struct OwnedScratch<A: Arithmetic, const D: usize> {
    density: Vec<A::Density>,
    pressure: Vec<A::Real>,
    impulse: Vec<[A::Speed; D]>,
    start: Vec<u32>,
    order: Vec<u32>,
    wall_start: Vec<u32>,
    wall_order: Vec<u32>,
    wall_density: Vec<A::Density>,
    wall_density_fixed: Vec<A::Density>,
    wall_pressure: Vec<A::Real>,
}

impl<A: Arithmetic, const D: usize> Storage<A, D> {
    /// Zeroed memory for `id.len()` fluid particles with these ids and for `walls` wall particles.
    pub fn new(
        id: Vec<u64>,
        walls: usize,
        density_role: DensityRole,
        forces: &Forces<A, D>,
    ) -> Self {
        let n = id.len();
        let zero = A::Real::from_f64(0.0);
        Self {
            id,
            position: vec![[A::Length::ZERO; D]; n],
            velocity: vec![[A::Speed::ZERO; D]; n],
            density: vec![A::Density::ZERO; n],
            density_role,
            wall_position: vec![[A::Length::ZERO; D]; walls],
            wall_velocity: vec![[A::Speed::ZERO; D]; walls],
            wall_density: vec![A::Density::ZERO; walls],
            progress: Progress::default(),
            scratch: OwnedScratch {
                density: vec![A::Density::ZERO; n],
                pressure: vec![zero; n],
                impulse: vec![[A::Speed::ZERO; D]; n],
                start: vec![0; forces.grid().buckets() + 1],
                order: vec![0; n],
                wall_start: vec![0; forces.wall_grid().buckets() + 1],
                wall_order: vec![0; walls],
                wall_density: vec![A::Density::ZERO; walls],
                wall_density_fixed: vec![A::Density::ZERO; walls],
                wall_pressure: vec![zero; walls],
            },
        }
    }

    /// The borrowed view that the core works on.
    pub fn system(&mut self) -> System<'_, A, D> {
        let scratch = &mut self.scratch;
        System {
            state: State {
                id: &mut self.id,
                position: &mut self.position,
                velocity: &mut self.velocity,
                density: &mut self.density,
                density_role: self.density_role,
            },
            walls: Walls {
                position: &mut self.wall_position,
                velocity: &mut self.wall_velocity,
                density: &mut self.wall_density,
            },
            scratch: Scratch {
                density: &mut scratch.density,
                pressure: &mut scratch.pressure,
                impulse: &mut scratch.impulse,
                cells: Cells {
                    start: &mut scratch.start,
                    order: &mut scratch.order,
                },
                wall_cells: Cells {
                    start: &mut scratch.wall_start,
                    order: &mut scratch.wall_order,
                },
                wall_density: &mut scratch.wall_density,
                wall_density_fixed: &mut scratch.wall_density_fixed,
                wall_pressure: &mut scratch.wall_pressure,
            },
            progress: &mut self.progress,
        }
    }
}

/// Bytes that [`Storage`] takes for so many particles and buckets.
pub(crate) fn bytes(dimension: u64, fluid: u64, walls: u64, buckets: u64) -> u64 {
    // Per fluid particle: id, position, velocity, density; density, pressure, impulse, order.
    let per_fluid = 8 * (1 + dimension + dimension + 1) + 8 * (1 + 1 + dimension) + 4;
    // Per wall particle: position, velocity, density; two densities, pressure, order.
    let per_wall = 8 * (dimension + dimension + 1) + 8 * 3 + 4;
    fluid * per_fluid + walls * per_wall + 4 * (buckets + 2)
}
