//! From a scene to a simulation: the parameters of the core, its units, and the memory it takes.

mod helium;
mod limits;
mod reach;
mod sense;
mod solids;

pub use crate::memory::{MemoryError, MemoryLimit, available_memory, bytes_for_people};
pub use helium::{FlowSpeeds, flow_speeds, helium_parameters};
pub use limits::{fixed_limits, force_limit};
pub use reach::{Reach, enclosure, length_range, reach};
pub use sense::{Sense, WANTED, WallSense, sense};
pub use solids::{fluid_parameters, solid_parameters};

use crate::engine::simulate;
use crate::isc;
use crate::memory;
use crate::model_list::for_each_model;
use crate::own::{self, OwnModel};
use crate::saved::ArithmeticKind;
use crate::scene::{self, InitialState, Scene, Vector3};
use crate::simulation::{BuildError, Options, Simulation};
use crate::storage;
use loschmidt_core::fields::{Field, Side, state_fields};
use loschmidt_core::integrator::{Integrator, PEFRL, STORMER_VERLET, SUZUKI};
use loschmidt_core::model::{Measure, Model};
use loschmidt_core::schemes::solid::{Midpoint, Relaxing, Solid, Viscous};
use loschmidt_core::schemes::superfluid::{
    DissipativeSuperfluid, Friction, PaperSuperfluid, Superfluid,
};
use loschmidt_core::schemes::wcsph::{
    AntiClump, Central, DensityCorrection, Filter, Gravity, StateEquation, Wall,
};
use loschmidt_core::{Arithmetic, Fixed, Float, Parameters, Standard, Symplectic};

/// Sets up the scene's simulation at step 0.
///
/// # Errors
/// [`BuildError`].
pub fn simulation(
    scene: &Scene,
    initial: &InitialState,
    options: &Options,
) -> Result<Box<dyn Simulation>, BuildError> {
    use ArithmeticKind as A;
    use scene::Dimension as D;
    if let scene::Model::Own(name) = scene.model {
        let model = own::find(name).ok_or(BuildError::UnknownModel(name))?;
        return of_ones_own(&model, scene, initial, options);
    }
    match (scene.dimension, options.arithmetic) {
        (D::Two, A::Fixed) => build::<Fixed, 2>(scene, initial, options),
        (D::Two, A::Float) => build::<Float, 2>(scene, initial, options),
        (D::Three, A::Fixed) => build::<Fixed, 3>(scene, initial, options),
        (D::Three, A::Float) => build::<Float, 3>(scene, initial, options),
    }
}

/// Makes a simulation of a model of one's own, and looks whether it is what was asked for.
fn of_ones_own(
    model: &OwnModel,
    scene: &Scene,
    initial: &InitialState,
    options: &Options,
) -> Result<Box<dyn Simulation>, BuildError> {
    let unsuited = |what| BuildError::Unsuited {
        model: model.name,
        what,
    };
    if scene.dimension.axes() != model.dimension {
        return Err(unsuited("this dimension"));
    }
    let mut simulation = (model.build)(scene, initial, options)?;
    if simulation.save().arithmetic != options.arithmetic {
        return Err(unsuited("this arithmetic"));
    }
    Ok(simulation)
}

/// Makes the model of a scene out of the list.
macro_rules! build_models {
    (
        $(
            $(#[$doc:meta])*
            $variant:ident = $word:literal, keys $family:ident, made by $made:path, from $from:ident,
            except [$($exclusion:expr),* $(,)?];
        )+
    ) => {
        fn build<A: Arithmetic, const D: usize>(
            scene: &Scene,
            initial: &InitialState,
            options: &Options,
        ) -> Result<Box<dyn Simulation>, BuildError> {
            match scene.model {
                $(scene::Model::$variant => {
                    let model = $made($from::<D>(scene, initial))?;
                    simulate::<A, _, D>(model, initial, options)
                })+
                scene::Model::Own(name) => Err(BuildError::UnknownModel(name)),
            }
        }
    };
}
for_each_model!(build_models);

/// What the models of a family declare, in one dimension or the other.
macro_rules! declared {
    ($scene:expr, $what:ident) => {{
        let plane = $scene.dimension == scene::Dimension::Two;
        match ($scene.solid, $scene.viscous, $scene.superfluid) {
            (Some(_), ..) if plane => <Solid<Fixed, 2> as Model<Fixed, 2>>::$what,
            (Some(_), ..) => <Solid<Fixed, 3> as Model<Fixed, 3>>::$what,
            (None, Some(_), _) if plane => <Viscous<Fixed, 2> as Model<Fixed, 2>>::$what,
            (None, Some(_), _) => <Viscous<Fixed, 3> as Model<Fixed, 3>>::$what,
            (None, None, Some(_)) if $scene.model == scene::Model::SuperfluidDissipative => {
                <DissipativeSuperfluid<Fixed, 2> as Model<Fixed, 2>>::$what
            }
            (None, None, Some(_)) => <Superfluid<Fixed, 2> as Model<Fixed, 2>>::$what,
            (None, None, None) => <Symplectic<Fixed, 2> as Model<Fixed, 2>>::$what,
        }
    }};
}

/// What is recorded of a particle of the scene besides position and velocity.
#[must_use]
pub fn columns(scene: &Scene) -> &'static [Measure] {
    own_of(scene).map_or_else(|| declared!(scene, COLUMNS), |model| model.columns)
}

/// The columns of every model that this program knows.
#[must_use]
pub fn every_column() -> Vec<Measure> {
    let mut all = <Symplectic<Fixed, 2> as Model<Fixed, 2>>::COLUMNS.to_vec();
    let viscous = <Viscous<Fixed, 3> as Model<Fixed, 3>>::COLUMNS.iter();
    let superfluid = <Superfluid<Fixed, 3> as Model<Fixed, 3>>::COLUMNS.iter();
    let own = own::columns();
    for measure in viscous.chain(superfluid).chain(&own) {
        if !all.contains(measure) {
            all.push(*measure);
        }
    }
    all
}

/// What a particle of the scene consists of.
fn fields(scene: &Scene) -> &'static [Field] {
    own_of(scene).map_or_else(|| declared!(scene, FIELDS), |model| model.fields)
}

fn own_of(scene: &Scene) -> Option<OwnModel> {
    match scene.model {
        scene::Model::Own(name) => own::find(name),
        _ => None,
    }
}

/// The core's parameters of a scene.
#[must_use]
pub fn parameters<const D: usize>(scene: &Scene, initial: &InitialState) -> Parameters<D> {
    let bounds = Bounds::of(initial);
    let particles = initial.fluid.len() + initial.wall.len();
    let fluid = fluid(scene);
    Parameters {
        support_radius: scene.support_radius(),
        time_step: scene.time_step(),
        mass: scene.particle_mass(),
        reference_density: fluid.reference_density,
        sound_speed: fluid.sound_speed,
        state_equation: match fluid.equation_of_state {
            scene::EquationOfState::Tait => StateEquation::Tait,
            scene::EquationOfState::Linear => StateEquation::Linear,
        },
        density_correction: match scene.water.density_correction {
            scene::DensityCorrection::Constant | scene::DensityCorrection::Hydrostatic => {
                DensityCorrection::Constant
            }
            scene::DensityCorrection::Isc | scene::DensityCorrection::None => {
                DensityCorrection::None
            }
        },
        gravity: Gravity {
            uniform: first(scene.gravity.uniform),
            central: scene.gravity.central.map(|central| Central {
                centre: first(central.centre),
                strength: central.strength,
                softening: central.softening,
            }),
        },
        wall: wall(scene),
        anti_clump: (fluid.anti_clump_pressure > 0.0).then_some(AntiClump {
            pressure: fluid.anti_clump_pressure,
            support_radius: fluid.anti_clump_radius * scene.particle_spacing,
        }),
        filter_every: scene.water.filter_every,
        integrator: integrator(scene.integrator),
        scale: reach::scale(
            scene,
            initial,
            // A flow that begins faster than its sound needs room for its speed.
            fluid.sound_speed.max(fastest(initial)),
            fluid.reference_density,
        ),
        extent: first(bounds.extent),
        max_buckets: max_buckets(particles),
    }
}

/// The material of a scene of water. Other scenes have none: what stands for it is refused by every
/// model.
fn fluid(scene: &Scene) -> scene::Fluid {
    scene.fluid.unwrap_or(scene::Fluid {
        reference_density: f64::NAN,
        sound_speed: f64::NAN,
        equation_of_state: scene::EquationOfState::Tait,
        anti_clump_pressure: 0.0,
        anti_clump_radius: 0.5,
    })
}

/// A scene's integrator as a row of the core's table.
#[must_use]
pub fn integrator(integrator: scene::Integrator) -> &'static Integrator {
    match integrator {
        scene::Integrator::StormerVerlet => &STORMER_VERLET,
        scene::Integrator::Pefrl => &PEFRL,
        scene::Integrator::Suzuki => &SUZUKI,
    }
}

fn wall(scene: &Scene) -> Wall {
    match (scene.water.wall_model, scene.wall) {
        (scene::WallModel::Conservative, Some(wall)) => Wall::Conservative {
            energy: wall.energy,
            radius: wall.radius * scene.particle_spacing,
            softening: wall.softening,
        },
        (scene::WallModel::Dummy, _) => Wall::Dummy,
        // A conservative wall without parameters is a scene without wall particles.
        (scene::WallModel::Conservative | scene::WallModel::None, _) => Wall::None,
    }
}

/// The largest speed at the start, m/s.
fn fastest(initial: &InitialState) -> f64 {
    largest(&initial.fluid_velocity)
}

/// The largest length of these.
fn largest(vectors: &[Vector3]) -> f64 {
    let length = |v: &Vector3| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    vectors.iter().map(length).fold(0.0, f64::max)
}

fn max_buckets(particles: usize) -> usize {
    2 * particles
}

fn first<const D: usize>(x: Vector3) -> [f64; D] {
    std::array::from_fn(|d| x[d])
}

/// Where the particles are at the start.
struct Bounds {
    /// Largest |coordinate|, m.
    farthest: f64,
    /// Size of the bounding box, m.
    extent: Vector3,
}

impl Bounds {
    fn of(initial: &InitialState) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for x in initial.fluid.iter().chain(&initial.wall) {
            for d in 0..3 {
                low[d] = low[d].min(x[d]);
                high[d] = high[d].max(x[d]);
            }
        }
        let farthest = (0..3).fold(f64::MIN_POSITIVE, |f: f64, d| {
            f.max(low[d].abs()).max(high[d].abs())
        });
        Self {
            farthest,
            extent: std::array::from_fn(|d| (high[d] - low[d]).max(0.0)),
        }
    }
}

/// Bytes that a run of the scene takes at most, estimated before anything is allocated: the
/// system, the initial state, the saved states at home and at the last good step, one frame.
#[must_use]
pub fn estimated_bytes(scene: &Scene) -> u64 {
    let (fluid, walls) = scene.estimated_particles();
    let dimension = match scene.dimension {
        scene::Dimension::Two => 2,
        scene::Dimension::Three => 3,
    };
    let buckets = 2 * max_buckets((fluid + walls) as usize) as u64;
    let system = storage::bytes(fields(scene), dimension, fluid, walls, buckets);
    let initial = 48 * fluid + 24 * walls;
    let saved = 3 * saved_bytes(fields(scene), dimension, fluid, walls);
    let frame = 72 * fluid + 24 * walls;
    let correction = match scene.water.density_correction {
        scene::DensityCorrection::Isc => {
            isc::estimated_bytes(dimension as u64, scene.support, fluid)
        }
        scene::DensityCorrection::Constant
        | scene::DensityCorrection::Hydrostatic
        | scene::DensityCorrection::None => 0,
    };
    // What the correction takes is given back before the rest is taken.
    initial + correction.max(system + saved + frame)
}

/// Bytes of a saved state: every word of the state, and an id for each particle.
fn saved_bytes(fields: &'static [Field], dimension: usize, fluid: u64, walls: u64) -> u64 {
    let words = |side| {
        let fields = state_fields(fields, side);
        fields
            .map(|(_, field)| field.words(side, dimension) as u64)
            .sum::<u64>()
    };
    8 * ((words(Side::Particles) + 1) * fluid + words(Side::Walls) * walls)
}

/// Compares the estimate with what there is, before anything is allocated.
///
/// # Errors
/// The scene is too large.
pub fn check_memory(scene: &Scene) -> Result<(), MemoryError> {
    memory::check(estimated_bytes(scene))
}
