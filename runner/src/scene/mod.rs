//! The scene language: from a TOML text to the first positions and velocities.
//!
//! ```text
//! Source --read--> text --parse, --set--> spec (what was written, with places)
//!        --check, build--> Scene (validated, SI) --initial_state--> InitialState (f64)
//! ```
//!
//! Each key is declared once, with its type, unit, range, default and meaning (module `declare`):
//! those of every scene in `types`, `forces`, `step` and `region_keys`, those of the weakly
//! compressible models in `wcsph`, of elastic ones in `solid`, of the viscous one in `viscous`, of
//! superfluids in `superfluid`; `model` is the table of models.
//! [`Scene::to_toml`] prints a scene with all keys, unit and meaning beside each. Every mistake of a
//! text is reported, each with file, line, caret and help, in one [`SceneError`].
//!
//! The initial state is the same bit for bit on every machine: node coordinates, membership in
//! shapes and velocities use `+ - * / sqrt` and comparisons alone, and for spirals, bending,
//! twist and waves the functions of `libm`; every coordinate comes from an integer index (see
//! [`Scene::initial_state`]).
//!
//! ```
//! use loschmidt_runner::scene::{load, Source};
//!
//! let text = r#"
//!     particle_spacing = 0.1
//!     turnaround = 0.5
//!     fluid.sound_speed = 40
//!     gravity.uniform = [0, -9.8]
//!     [[region]]
//!     kind = "fluid"
//!     shape.rectangle = { min = [0, 0], max = [1, 2] }
//! "#;
//! let source = Source::Text { name: "column.toml".into(), text: text.into() };
//! let scene = load(&source, &["particle_spacing=0.05".into()])?;
//! assert_eq!(scene.initial_state()?.fluid.len(), 800);
//! # Ok::<(), loschmidt_runner::scene::SceneError>(())
//! ```

mod build;
mod builder;
mod catalogue;
mod check;
mod declare;
mod error;
mod exclusive;
mod filled;
mod filling;
mod forces;
mod geometry;
mod helium;
mod hierarchy;
mod hydrostatic;
mod initial;
mod lattice;
mod model;
mod nearest;
mod overlap;
mod overrides;
mod page;
pub mod preset;
mod print;
mod region;
mod region_keys;
mod regions;
mod response;
mod schema;
mod shape;
mod solid;
mod source;
mod spec;
mod step;
mod stretch;
mod superfluid;
mod surface;
mod text;
mod thickness;
mod types;
mod values;
mod velocity;
mod viscous;
mod wcsph;
mod words;

pub use catalogue::{CatalogueEntry, catalogue};
pub use error::{Line, Place, Problem, ProblemKind, Problems, SceneError};
pub use filled::Filled;
pub use forces::{CentralGravity, Gravity};
pub use geometry::Vector3;
pub use initial::{GivenField, InitialPart, InitialState, InitialWall};
pub use model::Model;
pub use region::{MaterialOfBody, Region, Velocity};
pub use response::{LatticeResponse, lattice_response};
pub use shape::Shape;
pub use solid::{ElasticEnergy, Solid};
pub use source::{Source, resolve};
pub use step::StepRule;
pub use stretch::stretched_density;
pub use superfluid::{
    Counterflow, FirstEntropy, Heater, HeliumAt, Operators, Superfluid, Superleak, WallPressure,
};
pub use types::{Output, Scene};
pub use viscous::{Relaxation, Viscous, WallVelocity};
pub use wcsph::{DensityCorrection, EquationOfState, Fluid, WallModel, WallPotential, Water};
pub use words::{Dimension, Integrator, LatticeKind, Overlap, RegionKind};

/// Reads a scene, merges the overrides `path=value` into it in their order, and validates
/// the result.
///
/// # Errors
///
/// [`SceneError::Invalid`] with every mistake of the text and of the overrides (a syntax
/// error stands alone); [`SceneError::UnknownScene`], [`SceneError::NotFound`],
/// [`SceneError::Directory`], [`SceneError::Unreadable`] or [`SceneError::NotUtf8`] when
/// there is no text to read.
pub fn load(source: &Source, overrides: &[String]) -> Result<Scene, SceneError> {
    let mut spec = spec::SceneSpec::parse(source.read()?)?;
    let mut problems = Vec::new();
    for text in overrides {
        if let Err(problem) = overrides::apply(&mut spec, text) {
            problems.push(*problem);
        }
    }
    if problems.is_empty() {
        build::build(&spec)
    } else {
        Err(SceneError::Invalid(Problems::new(problems)))
    }
}
