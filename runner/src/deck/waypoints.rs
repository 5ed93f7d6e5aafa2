//! Waypoints: who is not on the way home.
//!
//! Going back is integrating back, and needs no history. To *count*, while it happens, the
//! particles that have left the way they came, the way out leaves marks: 32 bits per particle,
//! hashed from its position and velocity along physical time, at some of the states of the series.
//! On the way back the same states are hashed again. Two different states of a particle share a
//! mark once in 2³².
//!
//! In floating point, positions and velocities are rounded to whole quanta first, the unit of the
//! fixed-point state that it is compared with.

use crate::player::Arrow;
use crate::saved::{ArithmeticKind, SavedState};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Most memory for marks, bytes.
const MEMORY: usize = 64 << 20;

/// Fewest particles worth a thread of their own.
const PART: usize = 4096;

/// The marks of the way out.
#[derive(Debug)]
pub(super) struct Waypoints {
    /// Steps between marks.
    every: i64,
    /// Marks kept at most.
    most: usize,
    marks: BTreeMap<i64, Vec<u32>>,
}

impl Waypoints {
    /// None yet. `every`: steps between rows; marks are made at multiples of it, and thinned out to
    /// keep within memory.
    pub fn new(every: i64, particles: usize) -> Self {
        Self {
            every: every.max(1),
            most: (MEMORY / (4 * particles.max(1))).clamp(16, 4096),
            marks: BTreeMap::new(),
        }
    }

    /// On the way out: leaves marks at this position.
    pub fn mark(&mut self, position: i64, state: &SavedState, arrow: Arrow) {
        if position % self.every != 0 {
            return;
        }
        self.marks.insert(position, marks(state, arrow));
        if self.marks.len() > self.most {
            self.every *= 2;
            let every = self.every;
            self.marks.retain(|position, _| position % every == 0);
        }
    }

    /// On the way back: particles whose mark is another one; `None` without marks at this position.
    pub fn astray(&self, position: i64, state: &SavedState, arrow: Arrow) -> Option<usize> {
        let then = self.marks.get(&position)?;
        let now = marks(state, arrow);
        Some(then.iter().zip(&now).filter(|(a, b)| a != b).count())
    }
}

fn marks(state: &SavedState, arrow: Arrow) -> Vec<u32> {
    let d = state.dimension;
    let quanta = |word: i64| match state.arithmetic {
        ArithmeticKind::Fixed => word,
        ArithmeticKind::Float => f64::from_bits(word as u64).round_ties_even() as i64,
    };
    let position = state.positions().par_chunks(d);
    let velocity = state.velocities().par_chunks(d);
    position
        .zip(velocity)
        .with_min_len(PART)
        .map(|(x, v)| {
            let v = v.iter().map(|&v| match arrow {
                Arrow::Forward => quanta(v),
                Arrow::Backward => quanta(v).wrapping_neg(),
            });
            let words = x.iter().map(|&x| quanta(x)).chain(v);
            let hash = words.fold(0u64, |hash, word| mix(hash ^ word as u64));
            (hash >> 32) as u32
        })
        .collect()
}

/// The finaliser of SplitMix64: every bit of the result depends on every bit of its argument.
fn mix(x: u64) -> u64 {
    let z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
