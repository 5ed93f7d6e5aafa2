//! What the fast executor keeps from step to step.

use super::lanes::{ROW, Reals};
use super::layout::Layout;
use super::sums::Sums;
use super::walls::NearWalls;
use loschmidt_core::Arithmetic;
use loschmidt_core::number::larger;
use loschmidt_core::pairs::{PairPass, Targets, read_count};
use loschmidt_core::set::read;
use loschmidt_core::values::Values;

/// Arguments of the terms of three strips in turn.
pub(super) type Arguments = [Vec<Reals>; 3];

/// What outlives a step.
#[derive(Debug, Default)]
pub(super) struct Memory {
    pub layout: Layout,
    /// What a pass reads, by row.
    pub words: Vec<Reals>,
    /// First and second sums of each part.
    pub sums: Vec<[Sums; 2]>,
    /// Arguments of the terms of three strips, for each part.
    pub arguments: Vec<Arguments>,
    /// Largest magnitude of a pressure in the last kick of water, for a kick of one second.
    pub pressure: f64,
    pub walls: NearWalls,
}

/// Terms of this magnitude and more, in quanta, are out of range: 2^51.
pub(super) const LIMIT: f64 = (1u64 << 51) as f64;

impl Memory {
    /// Copies what the pass reads into rows; returns the largest magnitudes.
    pub fn load<A, P, const D: usize>(&mut self, to: &Targets<'_, A, D>) -> P::Read<f64>
    where
        A: Arithmetic,
        P: PairPass<D>,
    {
        let each = read_count::<P, D>();
        if each == 0 {
            return P::Read::<f64>::from_fn(|_| 0.0);
        }
        let layout = &self.layout;
        self.words
            .resize(layout.all_rows() * each, Reals::default());
        let parts = layout.split_rows(&mut self.words, each);
        let largest = layout.for_parts(parts, |strips, rows| {
            let mut largest = vec![0.0; each];
            let first_row = layout.rows_of(&strips).start;
            for strip in &layout.strips[strips] {
                let rows = &mut rows[(strip.rows().start - first_row) * each..];
                let rows = &mut rows[..strip.rows().len() * each];
                // The last row may hold fewer particles than slots: the rest must not keep old
                // numbers, which a sweep would load along with the others.
                if let Some(last) = rows.len().checked_sub(each) {
                    rows[last..].fill(Reals::default());
                }
                for (k, place) in strip.places().enumerate() {
                    let row = &mut rows[k / ROW * each..][..each];
                    let values: P::Read<f64> = read(to.read, place);
                    for (c, row) in row.iter_mut().enumerate() {
                        let value = values.get(c);
                        row.0[k % ROW] = value;
                        largest[c] = larger(largest[c], value);
                    }
                }
            }
            largest
        });
        P::Read::<f64>::from_fn(|c| {
            let parts = largest.iter().map(|part| part[c]);
            parts.fold(0.0, larger)
        })
    }
}
