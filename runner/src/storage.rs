//! A system in vectors.

use crate::drive::Held;
use loschmidt_core::fields::{Field, Side, words_each};
use loschmidt_core::model::Model;
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::Quantity;
use loschmidt_core::set::Set;
use loschmidt_core::{Arithmetic, Clock, System};

/// Owns what the core borrows.
#[derive(Debug)]
pub(crate) struct Storage<A: Arithmetic, const D: usize> {
    fields: &'static [Field],
    grids: [Grid<D>; 2],
    id: Vec<u64>,
    wall_id: Vec<u64>,
    particles: Vec<A::Word>,
    walls: Vec<A::Word>,
    start: Vec<u32>,
    order: Vec<u32>,
    wall_start: Vec<u32>,
    wall_order: Vec<u32>,
    pub clock: Clock,
    pub held: Held,
}

impl<A: Arithmetic, const D: usize> Storage<A, D> {
    /// Zeroed memory for `id.len()` particles with these ids and for `walls` wall particles.
    pub fn new<M: Model<A, D>>(model: &M, id: Vec<u64>, walls: usize) -> Self {
        let n = id.len();
        let grids = model.grids().map(Clone::clone);
        let words = |side, count| vec![A::Word::ZERO; count * words_each(M::FIELDS, side, D)];
        Self {
            fields: M::FIELDS,
            id,
            wall_id: vec![0; walls],
            particles: words(Side::Particles, n),
            walls: words(Side::Walls, walls),
            start: vec![0; grids[0].buckets() + 1],
            order: vec![0; n],
            wall_start: vec![0; grids[1].buckets() + 1],
            wall_order: vec![0; walls],
            grids,
            clock: Clock::default(),
            held: Held::default(),
        }
    }

    /// The borrowed view that the core works on, and what its scratch holds.
    pub fn parts(&mut self) -> (System<'_, A, D>, &mut Held) {
        let (n, w) = (self.id.len(), self.wall_id.len());
        let of_particles = Set::over(
            &mut self.id,
            &mut self.particles,
            n,
            self.fields,
            Side::Particles,
        );
        let of_walls = Set::over(
            &mut self.wall_id,
            &mut self.walls,
            w,
            self.fields,
            Side::Walls,
        );
        let [grid, wall_grid] = &self.grids;
        let system = System {
            // `new` has made as much memory as these fields take.
            particles: of_particles.unwrap_or_else(|error| unreachable!("{error}")),
            walls: of_walls.unwrap_or_else(|error| unreachable!("{error}")),
            grids: [grid, wall_grid],
            cells: Cells {
                start: &mut self.start,
                order: &mut self.order,
            },
            wall_cells: Cells {
                start: &mut self.wall_start,
                order: &mut self.wall_order,
            },
            clock: &mut self.clock,
        };
        (system, &mut self.held)
    }

    /// The borrowed view that the core works on.
    pub fn system(&mut self) -> System<'_, A, D> {
        self.parts().0
    }
}

/// Bytes that [`Storage`] takes for so many particles and buckets.
pub(crate) fn bytes(
    fields: &[Field],
    dimension: usize,
    particles: u64,
    walls: u64,
    buckets: u64,
) -> u64 {
    // Beside its words a particle has an id, and a place in the order of the cells.
    let each = |side| 8 * (1 + words_each(fields, side, dimension) as u64) + 4;
    particles * each(Side::Particles) + walls * each(Side::Walls) + 4 * (buckets + 2)
}
