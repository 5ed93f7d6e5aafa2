//! State and scratch, both on lent memory.
//!
//! The *state* is what a run is: ids, positions, velocities and one density field, integers all.
//! It is a list of named fields ([`Field`]); digest, snapshot and reversal walk that list and know
//! nothing else about a model. The *scratch* (densities, pressures, impulses, cells) is rebuilt
//! from the state whenever it is needed, and never digested or stored.

use crate::fault::CapacityError;
use crate::neighbours::Cells;
use crate::number::{Arithmetic, Quantity};

/// What reversing time does to a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeParity {
    /// Kept (positions, densities).
    Even,
    /// Changes sign (velocities).
    Odd,
}

/// Which quantum a field counts in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantum {
    /// [`crate::Scale::length_quantum`].
    Length,
    /// [`crate::Scale::speed_quantum`].
    Speed,
    /// [`crate::Scale::density_quantum`].
    Density,
}

/// A named field of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name in digests and snapshots.
    pub name: &'static str,
    /// 64-bit words per particle.
    pub components: usize,
    /// Unit of one step of the integer.
    pub quantum: Quantum,
    /// Behaviour under time reversal.
    pub parity: TimeParity,
}

/// Meaning of the density field of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DensityRole {
    /// C_a of eq. (5): computed once, constant ever after.
    Constant,
    /// The density itself, integrated in time (the standard scheme).
    Evolved,
}

/// The fluid: one element per particle in every slice, in any storage order.
#[derive(Debug)]
pub struct State<'a, A: Arithmetic, const D: usize> {
    /// Identity, given by the initial lattice order; travels with the storage.
    pub id: &'a mut [u64],
    /// Positions.
    pub position: &'a mut [[A::Length; D]],
    /// Velocities.
    pub velocity: &'a mut [[A::Speed; D]],
    /// See [`DensityRole`].
    pub density: &'a mut [A::Density],
    /// What `density` means.
    pub density_role: DensityRole,
}

impl<A: Arithmetic, const D: usize> State<'_, A, D> {
    /// The fields, in the order of digest and snapshot.
    #[must_use]
    pub fn fields(&self) -> [Field; 3] {
        [
            Field {
                name: "position",
                components: D,
                quantum: Quantum::Length,
                parity: TimeParity::Even,
            },
            Field {
                name: "velocity",
                components: D,
                quantum: Quantum::Speed,
                parity: TimeParity::Odd,
            },
            Field {
                name: match self.density_role {
                    DensityRole::Constant => "density_constant",
                    DensityRole::Evolved => "density",
                },
                components: 1,
                quantum: Quantum::Density,
                parity: TimeParity::Even,
            },
        ]
    }

    /// Number of fluid particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// True without fluid.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// The word of field number `field`, component `c`, of the particle in this place.
    #[must_use]
    pub fn word(&self, field: usize, c: usize, place: usize) -> i64 {
        match field {
            0 => self.position[place][c].to_word(),
            1 => self.velocity[place][c].to_word(),
            _ => self.density[place].to_word(),
        }
    }

    /// Sets the word of field number `field`, component `c`.
    pub fn set_word(&mut self, field: usize, c: usize, place: usize, word: i64) {
        match field {
            0 => self.position[place][c] = A::Length::from_word(word),
            1 => self.velocity[place][c] = A::Speed::from_word(word),
            _ => self.density[place] = A::Density::from_word(word),
        }
    }

    /// Turns time round: every odd field changes sign. Twice is the identity, bit for bit.
    pub fn reverse(&mut self) {
        for (f, field) in self.fields().into_iter().enumerate() {
            if field.parity == TimeParity::Odd {
                self.negate(f);
            }
        }
    }

    /// Changes the sign of field number `field`.
    fn negate(&mut self, field: usize) {
        fn all<Q: Quantity, const C: usize>(words: &mut [[Q; C]]) {
            for word in words.iter_mut().flatten() {
                *word = word.negated();
            }
        }
        match field {
            0 => all(self.position),
            1 => all(self.velocity),
            _ => self.density.iter_mut().for_each(|w| *w = w.negated()),
        }
    }
}

/// The walls: fixed particles.
#[derive(Debug)]
pub struct Walls<'a, A: Arithmetic, const D: usize> {
    /// Positions.
    pub position: &'a mut [[A::Length; D]],
    /// Velocities: zero, for walls that stand still.
    pub velocity: &'a mut [[A::Speed; D]],
    /// Of dummy walls, with the meaning that the fluid's has ([`DensityRole`]); zero for others.
    pub density: &'a mut [A::Density],
}

/// Memory for what is rebuilt in every step. Contents on entry do not matter.
#[derive(Debug)]
pub struct Scratch<'a, A: Arithmetic, const D: usize> {
    /// Densities.
    pub density: &'a mut [A::Density],
    /// p/ρ² times the factors of the present kick.
    pub pressure: &'a mut [A::Real],
    /// Impulses per mass of the present kick.
    pub impulse: &'a mut [[A::Speed; D]],
    /// The fluid in cells.
    pub cells: Cells<'a>,
    /// The walls in cells; sorted once.
    pub wall_cells: Cells<'a>,
    /// Densities of dummy walls.
    pub wall_density: &'a mut [A::Density],
    /// The part of a dummy's density that comes from other dummies and C_a: constant.
    pub wall_density_fixed: &'a mut [A::Density],
    /// p/ρ² of dummy walls.
    pub wall_pressure: &'a mut [A::Real],
}

/// What the scratch holds at the moment; a fresh one holds nothing and must be initialised.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Whole steps taken over all legs.
    pub step: u64,
    pub(crate) initialised: bool,
    pub(crate) walls_sorted: bool,
    pub(crate) density_current: bool,
    /// The kick coefficient, as bits, whose impulses are in the scratch.
    pub(crate) impulse_for: Option<u64>,
}

impl Progress {
    /// At this step, with nothing computed: after loading a snapshot or writing to the state.
    #[must_use]
    pub fn at_step(step: u64) -> Self {
        Self {
            step,
            initialised: true,
            ..Self::default()
        }
    }
    /// True where the scratch holds the densities of the present positions.
    #[must_use]
    pub fn density_is_current(&self) -> bool {
        self.density_current
    }
    /// Positions (or densities) were changed from outside: everything is computed anew.
    pub fn invalidate(&mut self) {
        *self = Self {
            step: self.step,
            initialised: self.initialised,
            ..Self::default()
        };
    }
}

/// Everything a step works on.
#[derive(Debug)]
pub struct System<'a, A: Arithmetic, const D: usize> {
    /// Fluid.
    pub state: State<'a, A, D>,
    /// Walls.
    pub walls: Walls<'a, A, D>,
    /// Rebuilt from the state.
    pub scratch: Scratch<'a, A, D>,
    /// Step counter and what the scratch holds.
    pub progress: &'a mut Progress,
}

impl<A: Arithmetic, const D: usize> System<'_, A, D> {
    /// Checks that the lent slices fit one another and the grids.
    ///
    /// # Errors
    /// Names the first slice that is too small or of the wrong length.
    pub fn check_capacity(&self, buckets: usize, wall_buckets: usize) -> Result<(), CapacityError> {
        let n = self.state.id.len();
        let w = self.walls.position.len();
        let s = &self.scratch;
        let same = [
            ("position", n, self.state.position.len()),
            ("velocity", n, self.state.velocity.len()),
            ("density", n, self.state.density.len()),
            ("scratch density", n, s.density.len()),
            ("pressure", n, s.pressure.len()),
            ("impulse", n, s.impulse.len()),
            ("cell order", n, s.cells.order.len()),
            ("cell start", buckets + 1, s.cells.start.len()),
            ("wall velocity", w, self.walls.velocity.len()),
            ("wall density field", w, self.walls.density.len()),
            ("wall cell order", w, s.wall_cells.order.len()),
            (
                "wall cell start",
                wall_buckets + 1,
                s.wall_cells.start.len(),
            ),
            ("wall density", w, s.wall_density.len()),
            ("fixed wall density", w, s.wall_density_fixed.len()),
            ("wall pressure", w, s.wall_pressure.len()),
        ];
        for (what, needed, given) in same {
            if needed != given {
                return Err(CapacityError {
                    what,
                    needed,
                    given,
                });
            }
        }
        Ok(())
    }

    /// Turns time round; positions and so forces stay as they are.
    pub fn reverse(&mut self) {
        self.state.reverse();
    }
}
