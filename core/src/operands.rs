//! What a point pass works on: some fields of some consecutive particles.

use crate::number::Word;
use crate::values::Values;

/// Most fields that a point pass reads, and most that it writes.
pub const MAX_OPERANDS: usize = 6;

/// What a point pass works on, of some consecutive particles.
#[derive(Debug)]
pub struct Operands<'a, W> {
    pub(crate) id: &'a [u64],
    pub(crate) read: [&'a [W]; MAX_OPERANDS],
    pub(crate) read_each: [usize; MAX_OPERANDS],
    pub(crate) write: [&'a mut [W]; MAX_OPERANDS],
    pub(crate) write_each: [usize; MAX_OPERANDS],
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
        let mut walk = Walk::default();
        // Numbers are asked for one after another.
        V::from_fn(
            #[inline(always)]
            |_| {
                let (k, c) = walk.next(&self.read_each);
                self.read[k][place * self.read_each[k] + c]
            },
        )
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
        let mut walk = Walk::default();
        V::from_fn(
            #[inline(always)]
            |_| {
                let (k, c) = walk.next(&self.write_each);
                self.write[k][place * self.write_each[k] + c]
            },
        )
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
        let mut walk = Walk::default();
        for c in 0..V::COUNT {
            let (k, within) = walk.next(&self.write_each);
            self.write[k][place * self.write_each[k] + within] = values.get(c);
        }
    }
}

/// Where the next number of a particle is: in which operand, and which of its numbers it is.
#[derive(Default)]
struct Walk {
    operand: usize,
    within: usize,
}

impl Walk {
    #[inline(always)]
    fn next(&mut self, each: &[usize; MAX_OPERANDS]) -> (usize, usize) {
        // A field that these particles do not have holds no numbers.
        while self.within >= each[self.operand] {
            self.operand += 1;
            self.within = 0;
        }
        self.within += 1;
        (self.operand, self.within - 1)
    }
}
