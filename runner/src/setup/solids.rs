//! The parameters of bodies and fluids whose particles carry a distortion.

use super::{Bounds, fastest, first, max_buckets, reach};
use crate::scene::{InitialState, Scene};
use loschmidt_core::schemes::solid::{FluidParameters, Parameters, Part, Relaxation, WallVelocity};

/// The core's parameters of a scene of elastic bodies; those of another scene are refused by every
/// model.
#[must_use]
pub fn solid_parameters<const D: usize>(scene: &Scene, initial: &InitialState) -> Parameters<D> {
    let bounds = Bounds::of(initial);
    let part = |part: &crate::scene::InitialPart| Part {
        first: part.first,
        body: part.body as u8,
        held: part.held,
        motion: part.motion,
    };
    Parameters {
        support_radius: scene.support_radius(),
        particle_spacing: scene.particle_spacing,
        time_step: scene.time_step(),
        reference_density: scene.reference_density(),
        // A scene has at most as many bodies as there is room for.
        materials: scene.materials().into_iter().collect(),
        parts: initial.parts.iter().map(part).collect(),
        gravity: first(scene.gravity.uniform),
        scale: reach::scale(
            scene,
            initial,
            scene.sound_speed().max(fastest(initial)),
            scene.reference_density(),
        ),
        extent: first(bounds.extent),
        max_buckets: max_buckets(initial.fluid.len()),
    }
}

/// The core's parameters of a scene of a viscous fluid; those of another scene are refused by every
/// model.
#[must_use]
pub fn fluid_parameters<const D: usize>(
    scene: &Scene,
    initial: &InitialState,
) -> FluidParameters<D> {
    let viscous = scene.viscous;
    FluidParameters {
        bodies: solid_parameters(scene, initial),
        relaxation_time: viscous.map_or(f64::NAN, |viscous| viscous.relaxation_time()),
        relaxation: viscous.map_or(Relaxation::Exact, |viscous| viscous.law()),
        wall_velocity: viscous.map_or(WallVelocity::Plain, |viscous| viscous.pretended()),
        start: viscous.map_or(0.0, |viscous| viscous.start),
    }
}
