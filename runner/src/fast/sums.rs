//! What the sweeps add to: sums by row of slots, one for each part of the strips.

use super::lanes::{ROW, Words};
use super::layout::Strip;
use loschmidt_core::Arithmetic;
use loschmidt_core::number::{Grain, PairSum};
use std::ops::Range;

/// Sums by row of slots.
#[derive(Debug, Default)]
pub(super) struct Sums {
    /// Components of row `first_row`, then those of the next.
    pub rows: Vec<Words>,
    /// First row that has sums.
    pub first_row: usize,
    /// Records of the particles of the strip at hand, see the sweep.
    pub records: Vec<Words>,
}

impl Sums {
    /// Zeroes for `components` in each of these rows.
    pub fn clear(&mut self, rows: Range<usize>, components: usize) {
        self.first_row = rows.start;
        self.rows.clear();
        self.rows.resize(rows.len() * components, Words::default());
    }

    /// Room for `components` in each of these rows, whatever is in it.
    pub fn prepare(&mut self, rows: Range<usize>, components: usize) {
        self.first_row = rows.start;
        self.rows.resize(rows.len() * components, Words::default());
    }

    /// Zeroes in these rows, as far as there is room for them.
    pub fn clear_some(&mut self, rows: Range<usize>, components: usize) {
        let place = |row: usize| ((row - self.first_row) * components).min(self.rows.len());
        let rows = place(rows.start)..place(rows.end);
        self.rows[rows].fill(Words::default());
    }

    /// Component k of a slot.
    #[inline(always)]
    pub fn of(&self, components: usize, slot: usize, k: usize) -> i64 {
        self.rows[(slot / ROW - self.first_row) * components + k].0[slot % ROW]
    }
}

/// Those of the sums, one for each part, to which this strip belongs.
pub(super) fn contributors<'a>(
    components: usize,
    sums: &[&'a Sums],
    strip: &Strip,
) -> Vec<&'a Sums> {
    let row = strip.slot / ROW;
    let covers = |sums: &&&Sums| {
        row.checked_sub(sums.first_row)
            .is_some_and(|row| row * components < sums.rows.len())
    };
    sums.iter().filter(covers).copied().collect()
}

/// Adds what a slot has received in all parts.
#[inline(always)]
pub(super) fn add_received<A: Arithmetic>(
    words: &mut [A::Word],
    grains: &[Grain],
    contributors: &[&Sums],
    slot: usize,
) {
    let components = words.len();
    for (k, word) in words.iter_mut().enumerate() {
        let mut received = 0i64;
        for sums in contributors {
            received = received.wrapping_add(sums.of(components, slot, k));
        }
        *word = A::Sum::grains_added_to(received, grains[k], *word);
    }
}
