//! Models of one's own, written outside this package.
//!
//! A program that has such a model registers it before it reads a scene; from then on scenes may
//! say `model = "NAME"`, and players, runs, their resumption, movies and pictures know it.
//! `examples/lennard_jones.rs` is one.

use crate::scene::{self, InitialState, Scene};
use crate::simulation::{BuildError, Options, Simulation};
use loschmidt_core::Arithmetic;
use loschmidt_core::fields::Field;
use loschmidt_core::model::{Measure, Model};
use std::sync::{PoisonError, RwLock};

/// Makes a simulation of a scene, in the arithmetic that the options ask for: one in another is
/// refused.
pub type Build = fn(&Scene, &InitialState, &Options) -> Result<Box<dyn Simulation>, BuildError>;

/// A model of one's own.
#[derive(Clone, Copy, Debug)]
pub struct OwnModel {
    /// Its word in scenes. It reads the same keys as the models of water do.
    pub name: &'static str,
    /// The dimension that it is written for.
    pub dimension: usize,
    /// Makes a simulation of a scene, by [`crate::simulate`].
    pub build: Build,
    /// Its [`FIELDS`](loschmidt_core::Model::FIELDS): they say how much memory a scene takes.
    pub fields: &'static [Field],
    /// Its [`COLUMNS`](loschmidt_core::Model::COLUMNS).
    pub columns: &'static [Measure],
}

impl OwnModel {
    /// A model of this name.
    #[must_use]
    pub fn new<A: Arithmetic, M: Model<A, D>, const D: usize>(
        name: &'static str,
        build: Build,
    ) -> Self {
        Self {
            name,
            dimension: D,
            build,
            fields: M::FIELDS,
            columns: M::COLUMNS,
        }
    }
}

static OWN: RwLock<Vec<OwnModel>> = RwLock::new(Vec::new());

/// Makes a model known to this program. One that is registered again takes the place of the first.
pub fn register(model: OwnModel) {
    let mut own = OWN.write().unwrap_or_else(PoisonError::into_inner);
    own.retain(|other| other.name != model.name);
    own.push(model);
    scene::Model::know(model.name);
}

/// The columns of all of them.
pub(crate) fn columns() -> Vec<Measure> {
    let own = OWN.read().unwrap_or_else(PoisonError::into_inner);
    own.iter()
        .flat_map(|model| model.columns)
        .copied()
        .collect()
}

/// The model of this name.
pub(crate) fn find(name: &str) -> Option<OwnModel> {
    let own = OWN.read().unwrap_or_else(PoisonError::into_inner);
    own.iter().find(|model| model.name == name).copied()
}
