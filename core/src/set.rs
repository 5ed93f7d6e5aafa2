//! Sets of particles, on lent memory.
//!
//! A [`Set`] is the particles of one kind (those that move, or the walls): one slice of words for
//! each field of the model's declaration, particle after particle. A [`SetView`] reads it, a
//! [`Column`] is one field of it as a pass reads it.

use crate::fault::{CapacityError, check_capacity};
use crate::fields::{Field, MAX_FIELDS, POSITION, Quantum, Side, TimeParity, VELOCITY, words_each};
use crate::number::{Arithmetic, Quantity, Word};
use crate::operands::{MAX_OPERANDS, Operands};
use crate::values::Values;

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

    /// Turns time round: every odd field changes sign, of the state and, so that a kick which is
    /// prepared remains that of the state, of the scratch. Twice is the identity, bit for bit.
    pub fn reverse(&mut self) {
        for (field, column) in self.fields.iter().zip(&mut self.columns) {
            if field.parity == TimeParity::Odd {
                for word in &mut **column {
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
