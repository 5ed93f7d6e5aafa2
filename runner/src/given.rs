//! Fields of the state that a scene gives besides positions and velocities.

use crate::scene::{InitialState, Vector3};
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

    /// Puts every given field that the particles have into the set, whatever its storage order.
    ///
    /// # Errors
    /// The id of a particle whose value is out of the number range.
    pub fn put_given<A: Arithmetic, const D: usize>(
        &self,
        particles: &mut Set<'_, A, D>,
        scale: &Scale,
    ) -> Result<(), u64> {
        for given in &self.given {
            let fields = particles.fields();
            let Some(f) = fields.iter().position(|field| field.name == given.name) else {
                continue;
            };
            let each = fields[f].words(particles.side(), D);
            let quantum = fields[f].quantum.size(scale);
            for place in 0..particles.len() {
                let id = particles.id[place];
                let value = given.values[id as usize];
                for (c, x) in value.iter().enumerate().take(each) {
                    let word = A::Word::ZERO.add_rounded(x / quantum);
                    let word = word.filter(|word| word.in_range()).ok_or(id)?;
                    particles.words_mut(f)[place * each + c] = word;
                }
            }
        }
        Ok(())
    }
}
