//! Fields of the state that a scene gives besides positions and velocities.

use crate::scene::{GivenField, InitialState, Vector3};
use loschmidt_core::fields::Side;
use loschmidt_core::number::Quantity;
use loschmidt_core::set::Set;
use loschmidt_core::{Arithmetic, Scale};

impl InitialState {
    /// The given values of a field.
    #[must_use]
    pub fn given(&self, name: &str) -> Option<&[Vector3]> {
        let field = self.given.iter().find(|field| field.name == name);
        field.map(|field| field.values.as_slice())
    }

    /// Puts every given field that the particles have into the set, whatever its storage order; of
    /// walls those that are given of walls.
    ///
    /// # Errors
    /// The id of a particle whose value is out of the number range.
    pub fn put_given<A: Arithmetic, const D: usize>(
        &self,
        set: &mut Set<'_, A, D>,
        scale: &Scale,
    ) -> Result<(), u64> {
        let all = match set.side() {
            Side::Particles => &self.given,
            Side::Walls => &self.wall_given,
        };
        self.put(all, set, scale, |_| A::Word::ZERO)
    }

    /// Adds every field that a scene adds to what the model has made of the first state, as
    /// [`InitialState::put_given`] puts those that are given.
    ///
    /// # Errors
    /// The id of a particle whose value is out of the number range.
    pub fn add_to<A: Arithmetic, const D: usize>(
        &self,
        set: &mut Set<'_, A, D>,
        scale: &Scale,
    ) -> Result<(), u64> {
        let all = match set.side() {
            Side::Particles => &self.added,
            Side::Walls => &self.wall_added,
        };
        self.put(all, set, scale, |word| word)
    }

    /// Puts fields into the set, each on what is made of the word that is there.
    fn put<A: Arithmetic, const D: usize>(
        &self,
        all: &[GivenField],
        set: &mut Set<'_, A, D>,
        scale: &Scale,
        start: impl Fn(A::Word) -> A::Word,
    ) -> Result<(), u64> {
        for given in all {
            let fields = set.fields();
            let Some(f) = fields.iter().position(|field| field.name == given.name) else {
                continue;
            };
            let each = fields[f].words(set.side(), D);
            let quantum = fields[f].quantum.size(scale);
            for place in 0..set.len() {
                // Walls have no ids yet, and keep their order.
                let (id, n) = match set.side() {
                    Side::Particles => (set.id[place], set.id[place] as usize),
                    Side::Walls => ((self.fluid.len() + place) as u64, place),
                };
                for (c, x) in given.values[n].iter().enumerate().take(each) {
                    let at = &mut set.words_mut(f)[place * each + c];
                    let word = start(*at).add_rounded(x / quantum);
                    *at = word.filter(|word| word.in_range()).ok_or(id)?;
                }
            }
        }
        Ok(())
    }
}
