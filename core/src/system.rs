//! A system: particles, walls, the cells in which both are found, and the clock.

use crate::executor::Executor;
use crate::fault::Fault;
use crate::fields::{Role, Side, VELOCITY};
use crate::neighbours::{Cells, CellsView, Grid};
use crate::number::{Arithmetic, Quantity};
use crate::pairs::{PairPass, Sources, Targets};
use crate::set::{Column, Set, SetView};

/// Where a run stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clock {
    /// Whole steps taken over all legs.
    pub step: u64,
    /// Whether the model has set up the state: once, at step 0.
    pub initialised: bool,
}

/// Everything a step works on.
#[derive(Debug)]
pub struct System<'a, A: Arithmetic, const D: usize> {
    /// What moves.
    pub particles: Set<'a, A, D>,
    /// What stands still.
    pub walls: Set<'a, A, D>,
    /// Geometry of the particles' cells, and of the walls'.
    pub grids: [&'a Grid<D>; 2],
    /// The particles in cells.
    pub cells: Cells<'a>,
    /// The walls in cells.
    pub wall_cells: Cells<'a>,
    /// Step counter.
    pub clock: &'a mut Clock,
}

/// A sum over pairs: who receives it, from whom, what is read of both, and where it is kept.
#[derive(Clone, Copy, Debug)]
pub struct Sum<'a> {
    /// Who receives.
    pub to: Side,
    /// Who contributes.
    pub from: Side,
    /// Fields of both that the pass reads.
    pub read: &'a [usize],
    /// Field of the receivers that is added to.
    pub into: usize,
}

impl<'a> Sum<'a> {
    /// What particles that move receive from those of one side.
    #[must_use]
    pub const fn to_particles(from: Side, read: &'a [usize], into: usize) -> Self {
        Self {
            to: Side::Particles,
            from,
            read,
            into,
        }
    }

    /// What walls receive from those of one side.
    #[must_use]
    pub const fn to_walls(from: Side, read: &'a [usize], into: usize) -> Self {
        Self {
            to: Side::Walls,
            ..Self::to_particles(from, read, into)
        }
    }
}

/// Most fields that a pair pass reads.
pub const MAX_READ: usize = 8;

impl<A: Arithmetic, const D: usize> System<'_, A, D> {
    /// Makes the particles findable at their present positions. With `for_others`, also for walls
    /// and for energies over pairs ([`sum_over_pairs`](crate::observe::sum_over_pairs)): needed
    /// where the model has such.
    pub fn locate<E: Executor>(&mut self, exec: &E, for_others: bool) {
        let (particles, cells) = (&mut self.particles, &mut self.cells);
        exec.locate(self.grids[0], particles, cells, for_others);
    }

    /// Makes the walls findable. They stand still: once is enough.
    pub fn locate_walls<E: Executor>(&mut self, exec: &E) {
        exec.locate_walls(self.grids[1], &self.walls, &mut self.wall_cells);
    }

    /// Adds the terms of a pass to a field.
    ///
    /// # Errors
    /// As [`Executor::sum`].
    pub fn sum<E: Executor, P: PairPass<D>>(
        &mut self,
        exec: &E,
        pass: &P,
        sum: Sum<'_>,
    ) -> Result<(), Fault> {
        let Self {
            particles,
            walls,
            grids,
            cells,
            wall_cells,
            ..
        } = self;
        let (receivers, others) = match sum.to {
            Side::Particles => (particles, walls),
            Side::Walls => (walls, particles),
        };
        let (of_receivers, [out]) = receivers.lend([sum.into]);
        let of_sources = if sum.to == sum.from {
            of_receivers
        } else {
            others.view()
        };
        let (grid, cells) = match sum.from {
            Side::Particles => (grids[0], cells.view()),
            Side::Walls => (grids[1], wall_cells.view()),
        };
        let read_of_receivers = columns(&of_receivers, sum.read, sum.to);
        let read_of_sources = columns(&of_sources, sum.read, sum.from);
        let to: Targets<'_, A, D> = Targets {
            position: of_receivers.position(),
            read: &read_of_receivers,
            id: of_receivers.id,
            same_set: sum.to == sum.from,
        };
        let from: Sources<'_, A, D> = Sources {
            grid,
            cells,
            position: of_sources.position(),
            read: &read_of_sources,
        };
        exec.sum(pass, &to, &from, out)
    }

    /// Cells and geometry of one side, and its particles: what a diagnostic gathers from.
    #[must_use]
    pub fn side(&self, side: Side) -> (SetView<'_, A, D>, CellsView<'_>, &Grid<D>) {
        match side {
            Side::Particles => (self.particles.view(), self.cells.view(), self.grids[0]),
            Side::Walls => (self.walls.view(), self.wall_cells.view(), self.grids[1]),
        }
    }

    /// Gives the walls their ids, which count on from the last particle's place, and velocities of
    /// zero, where they have some to be read.
    pub fn prepare_walls(&mut self) {
        let first = self.particles.len() as u64;
        for (w, id) in self.walls.id.iter_mut().enumerate() {
            *id = first + w as u64;
        }
        let velocity = self.walls.fields().get(VELOCITY);
        if velocity.is_some_and(|field| field.walls == Role::Scratch) {
            self.walls.words_mut(VELOCITY).fill(A::Word::ZERO);
        }
    }

    /// Turns time round; positions and so forces stay as they are.
    pub fn reverse(&mut self) {
        self.particles.reverse();
        self.walls.reverse();
    }
}

/// These fields of a set, as a pass reads them.
#[must_use]
pub fn columns<'a, A: Arithmetic, const D: usize>(
    view: &SetView<'a, A, D>,
    fields: &[usize],
    side: Side,
) -> heapless::Vec<Column<'a, A::Word>, MAX_READ> {
    fields.iter().map(|&f| view.column(f, side)).collect()
}
