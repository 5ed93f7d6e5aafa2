//! The parameters of elastic bodies.

use super::{Bounds, fastest, first, max_buckets};
use crate::scene::{InitialState, Scene};
use loschmidt_core::Scale;
use loschmidt_core::schemes::solid::{Parameters, Part};

/// The core's parameters of a scene of elastic bodies; those of another scene are refused by every
/// model.
#[must_use]
pub fn solid_parameters<const D: usize>(scene: &Scene, initial: &InitialState) -> Parameters<D> {
    let bounds = Bounds::of(initial);
    let (_, bodies) = scene.bodies();
    let material = scene.solid.map(|solid| solid.material());
    let part = |part: &crate::scene::InitialPart| Part {
        first: part.first,
        body: part.body as u8,
        held: part.held,
    };
    Parameters {
        support_radius: scene.support_radius(),
        particle_spacing: scene.particle_spacing,
        time_step: scene.time_step(),
        reference_density: scene.reference_density(),
        // A scene has one material, and at most as many bodies as there is room for.
        materials: (0..bodies).filter_map(|_| material).collect(),
        parts: initial.parts.iter().map(part).collect(),
        gravity: first(scene.gravity.uniform),
        scale: Scale::with_headroom(
            bounds.farthest.max(scene.support_radius()),
            scene.sound_speed().max(fastest(initial)),
            scene.reference_density(),
        ),
        extent: first(bounds.extent),
        max_buckets: max_buckets(initial.fluid.len()),
    }
}
