//! Sums over another set that stands still: walls.
//!
//! Few particles are near a wall. When the layout is made, those within reach + skin of a wall
//! particle are listed, each with its wall particles; until the layout is made anew no other can
//! come within reach.

use super::layout::{Layout, key};
use loschmidt_core::number::Quantity;
use loschmidt_core::pairs::{
    Gathering, PairPass, Sources, Targets, add, empty, grains, term_count,
};
use loschmidt_core::values::Values;
use loschmidt_core::{Arithmetic, Fault};

/// Who is near the walls.
#[derive(Debug, Default)]
pub(super) struct NearWalls {
    /// Of which walls, with what reach, in which layout.
    of: Option<((usize, usize), i64, u64)>,
    /// A place, and where its wall particles end in `walls`.
    near: Vec<(u32, u32)>,
    /// Wall particles, place after place.
    walls: Vec<u32>,
    /// A place and a wall particle.
    pairs: Vec<(u32, u32)>,
}

impl NearWalls {
    /// The walls may have moved.
    pub fn forget(&mut self) {
        self.of = None;
    }

    /// Adds to every `out[i]` the terms of particle i with the walls.
    ///
    /// # Errors
    /// As [`loschmidt_core::Executor::sum`].
    pub fn sum<A: Arithmetic, P: PairPass<D>, const D: usize>(
        &mut self,
        layout: &Layout,
        pass: &P,
        to: &Targets<'_, A, D>,
        from: &Sources<'_, A, D>,
        out: &mut [A::Word],
    ) -> Result<(), Fault> {
        let of = (key(from.position), from.grid.reach(), layout.version);
        if self.of != Some(of) {
            self.list::<A, D>(layout, to.position, from.position, from.grid.reach() as f64);
            self.of = Some(of);
        }
        let mut first: Option<Fault> = None;
        let grains = grains(pass, to);
        let mut start = 0;
        for &(place, end) in &self.near {
            let walls = &self.walls[start..end as usize];
            start = end as usize;
            let place = place as usize;
            let out = &mut out[place * term_count::<P, D>()..][..term_count::<P, D>()];
            let mut sum: P::Term<A::Sum> = empty::<A, _>(|k| grains.get(k));
            let mut gathering = Gathering::new(pass, to, place, from, &mut sum);
            gathering.add(walls);
            let result = gathering.end();
            add::<A, _>(&sum, out);
            if let Err(kind) = result {
                let fault = Fault::new(kind, to.id[place]);
                first = Some(first.map_or(fault, |other| other.first(fault)));
            }
        }
        first.map_or(Ok(()), Err)
    }

    fn list<A: Arithmetic, const D: usize>(
        &mut self,
        layout: &Layout,
        fluid: &[[A::Length; D]],
        walls: &[[A::Length; D]],
        reach: f64,
    ) {
        let radius = reach + layout.skin;
        self.pairs.clear();
        for (w, x) in walls.iter().enumerate() {
            let x = x.map(Quantity::quanta);
            for place in layout.near::<D>(&x, radius).flatten() {
                let mut r2 = 0.0;
                for (f, x) in fluid[place].iter().zip(&x) {
                    let difference = f.quanta() - x;
                    r2 += difference * difference;
                }
                if r2 <= radius * radius {
                    self.pairs.push((place as u32, w as u32));
                }
            }
        }
        self.pairs.sort_unstable();
        self.near.clear();
        self.walls.clear();
        for &(place, wall) in &self.pairs {
            self.walls.push(wall);
            let end = self.walls.len() as u32;
            match self.near.last_mut() {
                Some(near) if near.0 == place => near.1 = end,
                _ => self.near.push((place, end)),
            }
        }
    }
}
