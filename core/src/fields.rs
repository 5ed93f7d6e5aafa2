//! Fields: what a particle consists of, declared once, and the memory that holds it.
//!
//! A model declares a list of [`Field`]s. Everything that must know of what a particle consists
//! reads that list: storage, checks of capacity, estimates of memory, digest, snapshot, reversal,
//! reordering. The first three fields of every model are the position, the velocity and, as
//! scratch, the impulse.
//!
//! A [`Set`] is the particles of one kind (those that move, or the walls) on lent memory: one slice
//! of words for each field, particle after particle. Fields of the *state* are what a run is;
//! *scratch* is computed from the state in every step and never stored or compared.

use crate::fault::CapacityError;
use crate::number::{Arithmetic, Quantity, Scale, Word};
use crate::values::Values;

/// Place of the position in every model's list.
pub const POSITION: usize = 0;
/// Place of the velocity in every model's list.
pub const VELOCITY: usize = 1;
/// Place of the impulses of the present kick in every model's list.
pub const IMPULSE: usize = 2;
/// Most fields that a model may declare.
pub const MAX_FIELDS: usize = 16;

/// What reversing time does to a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeParity {
    /// Kept (positions, densities).
    Even,
    /// Changes sign (velocities).
    Odd,
}

/// What one word of a field counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantum {
    /// [`Scale::length_quantum`].
    Length,
    /// [`Scale::speed_quantum`].
    Speed,
    /// [`Scale::density_quantum`].
    Density,
    /// Nothing: the word holds a double. For scratch only.
    Real,
}

impl Quantum {
    /// SI units for each quantum.
    #[must_use]
    pub fn size(self, scale: &Scale) -> f64 {
        match self {
            Self::Length => scale.length_quantum(),
            Self::Speed => scale.speed_quantum(),
            Self::Density => scale.density_quantum(),
            Self::Real => 1.0,
        }
    }
}

/// How many words a field has in D dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// One.
    Scalar,
    /// D.
    Vector,
    /// D(D + 1)/2.
    Symmetric,
    /// D².
    Matrix,
    /// So many in the plane and in space: sums of several kinds that a pass adds at once.
    Several {
        /// Words in two dimensions.
        plane: usize,
        /// Words in three dimensions.
        space: usize,
    },
}

/// What a field is to the particles of one set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A part of what a run is.
    State,
    /// Computed from the state.
    Scratch,
    /// These particles do not have it.
    Absent,
}

/// A named field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name in digests, snapshots and messages.
    pub name: &'static str,
    /// Words for each particle.
    pub rank: Rank,
    /// Unit of a word.
    pub quantum: Quantum,
    /// Behaviour under time reversal.
    pub parity: TimeParity,
    /// What it is to the particles that move.
    pub particles: Role,
    /// What it is to the walls.
    pub walls: Role,
}

impl Field {
    /// A field of the state of particles that move; walls do not have it.
    #[must_use]
    pub const fn state(
        name: &'static str,
        rank: Rank,
        quantum: Quantum,
        parity: TimeParity,
    ) -> Self {
        Self {
            name,
            rank,
            quantum,
            parity,
            particles: Role::State,
            walls: Role::Absent,
        }
    }

    /// Scratch of particles that move; walls do not have it.
    #[must_use]
    pub const fn scratch(name: &'static str, rank: Rank, quantum: Quantum) -> Self {
        Self {
            particles: Role::Scratch,
            ..Self::state(name, rank, quantum, TimeParity::Even)
        }
    }

    /// The same field, with this role on walls too.
    #[must_use]
    pub const fn on_walls(self, walls: Role) -> Self {
        Self { walls, ..self }
    }

    /// The same field, with this role on particles that move.
    #[must_use]
    pub const fn on_particles(self, particles: Role) -> Self {
        Self { particles, ..self }
    }

    /// What the field is to the particles of a set.
    #[must_use]
    pub const fn role(&self, side: Side) -> Role {
        match side {
            Side::Particles => self.particles,
            Side::Walls => self.walls,
        }
    }

    /// Words for each particle of a set.
    #[must_use]
    pub const fn words(&self, side: Side, dimension: usize) -> usize {
        match (self.role(side), self.rank) {
            (Role::Absent, _) => 0,
            (_, Rank::Scalar) => 1,
            (_, Rank::Vector) => dimension,
            (_, Rank::Symmetric) => dimension * (dimension + 1) / 2,
            (_, Rank::Matrix) => dimension * dimension,
            (_, Rank::Several { plane, space }) => match dimension {
                2 => plane,
                _ => space,
            },
        }
    }
}

/// x, as every model declares it.
pub const POSITION_FIELD: Field =
    Field::state("position", Rank::Vector, Quantum::Length, TimeParity::Even).on_walls(Role::State);

/// v of the particles that move.
pub const VELOCITY_FIELD: Field =
    Field::state("velocity", Rank::Vector, Quantum::Speed, TimeParity::Odd);

/// J, the impulse per mass of the present kick.
pub const IMPULSE_FIELD: Field = Field::scratch("impulse", Rank::Vector, Quantum::Speed);

/// Which particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Those that move.
    Particles,
    /// Those that stand still.
    Walls,
}

/// Words for each particle of a set with these fields.
#[must_use]
pub const fn words_each(fields: &[Field], side: Side, dimension: usize) -> usize {
    let (mut sum, mut f) = (0, 0);
    while f < fields.len() {
        sum += fields[f].words(side, dimension);
        f += 1;
    }
    sum
}

/// Fields of the state of a set, with their places in the list.
pub fn state_fields(
    fields: &'static [Field],
    side: Side,
) -> impl Iterator<Item = (usize, &'static Field)> + Clone {
    let all = fields.iter().enumerate();
    all.filter(move |(_, field)| field.role(side) == Role::State)
}

/// One field of a set, to be read as numbers.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a, W> {
    words: &'a [W],
    each: usize,
    real: bool,
}

impl<W: Word> Column<'_, W> {
    /// Component c of the particle in this place, in quanta.
    #[inline(always)]
    #[must_use]
    pub fn value(&self, place: usize, c: usize) -> f64 {
        let word = self.words[place * self.each + c];
        if self.real {
            word.real()
        } else {
            word.quanta()
        }
    }
}

/// What is read of the particle in this place: the components of the first column, then those of
/// the next.
#[inline(always)]
pub fn read<V: Values<f64>, W: Word>(columns: &[Column<'_, W>], place: usize) -> V {
    match columns {
        // Most passes read one field; it needs no search for the column of a component.
        [column] if column.each == V::COUNT => {
            let words = &column.words[place * V::COUNT..][..V::COUNT];
            if column.real {
                V::from_fn(
                    #[inline(always)]
                    |c| words[c].real(),
                )
            } else {
                V::from_fn(
                    #[inline(always)]
                    |c| words[c].quanta(),
                )
            }
        }
        _ => V::from_fn(|c| value_of(columns, place, c)),
    }
}

/// Number c of those of several columns.
fn value_of<W: Word>(columns: &[Column<'_, W>], place: usize, mut c: usize) -> f64 {
    for column in columns {
        if c < column.each {
            return column.value(place, c);
        }
        c -= column.each;
    }
    unreachable!("the pass reads more numbers than its fields hold")
}

/// Refuses memory that is too small.
///
/// # Errors
/// Names it.
pub fn check_capacity(
    what: &'static str,
    needed: usize,
    given: usize,
) -> Result<(), CapacityError> {
    if needed <= given {
        Ok(())
    } else {
        Err(CapacityError {
            what,
            needed,
            given,
        })
    }
}

/// Particles of one kind, to be read.
#[derive(Clone, Copy, Debug)]
pub struct SetView<'a, A: Arithmetic, const D: usize> {
    /// Identity, given by the initial lattice order; travels with the storage. Walls count on from
    /// the last particle that moves.
    pub id: &'a [u64],
    fields: &'static [Field],
    columns: [&'a [A::Word]; MAX_FIELDS],
}

impl<'a, A: Arithmetic, const D: usize> SetView<'a, A, D> {
    /// Positions, in length quanta.
    #[inline]
    #[must_use]
    pub fn position(&self) -> &'a [[A::Length; D]] {
        self.vectors(POSITION)
    }

    /// Velocities, in speed quanta.
    #[inline]
    #[must_use]
    pub fn velocity(&self) -> &'a [[A::Speed; D]] {
        self.vectors(VELOCITY)
    }

    /// The words of a field.
    #[inline]
    #[must_use]
    pub fn words(&self, field: usize) -> &'a [A::Word] {
        self.columns[field]
    }

    /// A scalar field in a number type of its own.
    #[inline]
    #[must_use]
    pub fn scalars<Q: bytemuck::Pod>(&self, field: usize) -> &'a [Q] {
        bytemuck::cast_slice(self.columns[field])
    }

    /// A field of several components in a number type of its own.
    #[inline]
    #[must_use]
    pub fn vectors<Q: bytemuck::Pod, const C: usize>(&self, field: usize) -> &'a [[Q; C]] {
        self.scalars::<Q>(field).as_chunks().0
    }

    /// A field as a pass reads it.
    #[must_use]
    pub fn column(&self, field: usize, side: Side) -> Column<'a, A::Word> {
        Column {
            words: self.columns[field],
            each: self.fields[field].words(side, D),
            real: self.fields[field].quantum == Quantum::Real,
        }
    }
}

/// Particles of one kind, in any storage order.
#[derive(Debug)]
pub struct Set<'a, A: Arithmetic, const D: usize> {
    /// Identity; see [`SetView::id`].
    pub id: &'a mut [u64],
    side: Side,
    fields: &'static [Field],
    columns: [&'a mut [A::Word]; MAX_FIELDS],
}

impl<'a, A: Arithmetic, const D: usize> Set<'a, A, D> {
    /// As many particles as there are ids, their words in `memory` with room for `room` of them:
    /// all words of the first field, then all of the next.
    ///
    /// # Errors
    /// The memory is smaller than `room * words_each(…)`, or there are more ids than room.
    pub fn over(
        id: &'a mut [u64],
        memory: &'a mut [A::Word],
        room: usize,
        fields: &'static [Field],
        side: Side,
    ) -> Result<Self, CapacityError> {
        check_capacity("fields of a particle", fields.len(), MAX_FIELDS)?;
        check_capacity("particles", id.len(), room)?;
        let words = room.saturating_mul(words_each(fields, side, D));
        check_capacity("words of the particles", words, memory.len())?;
        let mut columns: [&mut [A::Word]; MAX_FIELDS] = Default::default();
        let mut rest = memory;
        for (column, field) in columns.iter_mut().zip(fields) {
            let each = field.words(side, D);
            let (own, others) = rest.split_at_mut(each * room);
            *column = &mut own[..each * id.len()];
            rest = others;
        }
        Ok(Self {
            id,
            side,
            fields,
            columns,
        })
    }

    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// True without particles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Which particles these are.
    #[must_use]
    pub fn side(&self) -> Side {
        self.side
    }

    /// What a particle consists of.
    #[must_use]
    pub fn fields(&self) -> &'static [Field] {
        self.fields
    }

    /// All of it, to be read.
    #[must_use]
    pub fn view(&self) -> SetView<'_, A, D> {
        SetView {
            id: self.id,
            fields: self.fields,
            columns: self.columns.each_ref().map(|column| &**column),
        }
    }

    /// Some fields to be written and all others to be read; the lent ones are empty in the view.
    #[must_use]
    pub fn lend<const N: usize>(
        &mut self,
        fields: [usize; N],
    ) -> (SetView<'_, A, D>, [&mut [A::Word]; N]) {
        let mut columns: [&[A::Word]; MAX_FIELDS] = Default::default();
        let mut lent = [const { None }; N];
        for (f, (column, all)) in columns.iter_mut().zip(&mut self.columns).enumerate() {
            match fields.iter().position(|&field| field == f) {
                Some(k) => lent[k] = Some(&mut **all),
                None => *column = all,
            }
        }
        let view = SetView {
            id: self.id,
            fields: self.fields,
            columns,
        };
        (view, lent.map(Option::unwrap_or_default))
    }

    /// Positions, in length quanta.
    #[must_use]
    pub fn position(&self) -> &[[A::Length; D]] {
        self.view().position()
    }

    /// Velocities, in speed quanta.
    #[must_use]
    pub fn velocity(&self) -> &[[A::Speed; D]] {
        self.view().velocity()
    }

    /// The words of a field.
    #[must_use]
    pub fn words(&self, field: usize) -> &[A::Word] {
        self.columns[field]
    }

    /// The words of a field, to be written.
    #[must_use]
    pub fn words_mut(&mut self, field: usize) -> &mut [A::Word] {
        self.columns[field]
    }

    /// Positions, to be written.
    #[must_use]
    pub fn position_mut(&mut self) -> &mut [[A::Length; D]] {
        self.vectors_mut(POSITION)
    }

    /// Velocities, to be written.
    #[must_use]
    pub fn velocity_mut(&mut self) -> &mut [[A::Speed; D]] {
        self.vectors_mut(VELOCITY)
    }

    /// A field of several components in a number type of its own, to be written.
    #[must_use]
    pub fn vectors_mut<Q: bytemuck::Pod, const C: usize>(&mut self, field: usize) -> &mut [[Q; C]] {
        bytemuck::cast_slice_mut::<_, Q>(self.columns[field])
            .as_chunks_mut()
            .0
    }

    /// The 64 bits of component c of a field, as digests and snapshots have them.
    #[inline]
    #[must_use]
    pub fn word(&self, field: usize, c: usize, place: usize) -> i64 {
        let each = self.fields[field].words(self.side, D);
        self.columns[field][place * each + c].to_word()
    }

    /// Sets component c of a field.
    #[inline]
    pub fn set_word(&mut self, field: usize, c: usize, place: usize, word: i64) {
        let each = self.fields[field].words(self.side, D);
        self.columns[field][place * each + c] = A::Word::from_word(word);
    }

    /// Ids and the words of every field, with the words for each particle: for who reorders them.
    pub fn parts(&mut self) -> (&mut [u64], impl Iterator<Item = (usize, &mut [A::Word])>) {
        let side = self.side;
        let fields = self.fields.iter().zip(&mut self.columns);
        let words = fields.map(move |(field, words)| (field.words(side, D), &mut **words));
        (self.id, words)
    }

    /// Turns time round: every odd field of the state changes sign. Twice is the identity, bit for
    /// bit.
    pub fn reverse(&mut self) {
        for (f, field) in state_fields(self.fields, self.side) {
            if field.parity == TimeParity::Odd {
                for word in &mut *self.columns[f] {
                    *word = word.negated();
                }
            }
        }
    }

    /// Some fields to be read and some to be written, of all particles.
    ///
    /// # Panics
    /// A field is in both lists, or one of them has more than [`MAX_OPERANDS`].
    #[must_use]
    pub fn operands(&mut self, read: &[usize], write: &[usize]) -> Operands<'_, A::Word> {
        let operand = |field: &Field| field.words(self.side, D);
        let mut operands = Operands {
            id: self.id,
            read: [const { &[] }; MAX_OPERANDS],
            read_each: [0; MAX_OPERANDS],
            write: Default::default(),
            write_each: [0; MAX_OPERANDS],
        };
        for (f, column) in self.columns.iter_mut().enumerate() {
            let place = |list: &[usize]| list.iter().position(|&field| field == f);
            if let Some(k) = place(write) {
                assert!(!read.contains(&f), "field {f} is read and written");
                operands.write[k] = column;
                operands.write_each[k] = operand(&self.fields[f]);
            } else if let Some(k) = place(read) {
                operands.read[k] = column;
                operands.read_each[k] = operand(&self.fields[f]);
            }
        }
        operands
    }
}

/// Most fields that a point pass reads, and most that it writes.
pub const MAX_OPERANDS: usize = 4;

/// What a point pass works on, of some consecutive particles.
#[derive(Debug)]
pub struct Operands<'a, W> {
    id: &'a [u64],
    read: [&'a [W]; MAX_OPERANDS],
    read_each: [usize; MAX_OPERANDS],
    write: [&'a mut [W]; MAX_OPERANDS],
    write_each: [usize; MAX_OPERANDS],
}

impl<'a, W: Word> Operands<'a, W> {
    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// True without particles.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// The first `particles`, and the rest: for executors that share them out.
    #[must_use]
    pub fn split_at(self, particles: usize) -> (Self, Self) {
        let (id, other_id) = self.id.split_at(particles);
        let mut first = Self { id, ..self };
        let mut second = Self {
            id: other_id,
            read: [const { &[] }; MAX_OPERANDS],
            write: Default::default(),
            ..first
        };
        for k in 0..MAX_OPERANDS {
            (first.read[k], second.read[k]) =
                first.read[k].split_at(particles * first.read_each[k]);
            let all = core::mem::take(&mut first.write[k]);
            (first.write[k], second.write[k]) = all.split_at_mut(particles * first.write_each[k]);
        }
        (first, second)
    }

    /// The id of the particle in this place.
    #[inline(always)]
    #[must_use]
    pub fn id(&self, place: usize) -> u64 {
        self.id[place]
    }

    /// What is read of the particle in this place.
    #[inline(always)]
    #[must_use]
    pub fn read<V: Values<W>>(&self, place: usize) -> V {
        if V::COUNT == self.read_each[0] {
            let words = &self.read[0][place * V::COUNT..][..V::COUNT];
            return V::from_fn(
                #[inline(always)]
                |c| words[c],
            );
        }
        V::from_fn(|c| {
            let (k, c) = operand_of(&self.read_each, c);
            self.read[k][place * self.read_each[k] + c]
        })
    }

    /// What is to be written of the particle in this place, as it is.
    #[inline(always)]
    #[must_use]
    pub fn load<V: Values<W>>(&self, place: usize) -> V {
        if V::COUNT == self.write_each[0] {
            let words = &self.write[0][place * V::COUNT..][..V::COUNT];
            return V::from_fn(
                #[inline(always)]
                |c| words[c],
            );
        }
        V::from_fn(|c| {
            let (k, c) = operand_of(&self.write_each, c);
            self.write[k][place * self.write_each[k] + c]
        })
    }

    /// Writes.
    #[inline(always)]
    pub fn store<V: Values<W>>(&mut self, place: usize, values: V) {
        if V::COUNT == self.write_each[0] {
            let words = &mut self.write[0][place * V::COUNT..][..V::COUNT];
            for (c, word) in words.iter_mut().enumerate() {
                *word = values.get(c);
            }
            return;
        }
        for c in 0..V::COUNT {
            let (k, within) = operand_of(&self.write_each, c);
            self.write[k][place * self.write_each[k] + within] = values.get(c);
        }
    }
}

/// Which operand holds number c, and which of its numbers it is.
#[inline(always)]
fn operand_of(each: &[usize; MAX_OPERANDS], mut c: usize) -> (usize, usize) {
    let mut k = 0;
    while c >= each[k] {
        c -= each[k];
        k += 1;
    }
    (k, c)
}
