//! From a scene of superfluid helium to the parameters of its models.

use super::{Bounds, fastest, first, largest, max_buckets, reach};
use crate::scene::{
    InitialState, InitialWall, Region, RegionKind, Scene, Vector3, Velocity, WallPressure,
};
use loschmidt_core::observe::BINS;
use loschmidt_core::schemes::superfluid::{
    Heater, Helium, HeliumParameters, Operators, Superleak, WallPart,
};

/// The core's parameters of a scene of superfluid helium; those of another scene are refused by
/// every model.
#[must_use]
pub fn helium_parameters<const D: usize>(
    scene: &Scene,
    initial: &InitialState,
) -> HeliumParameters<D> {
    let bounds = Bounds::of(initial);
    let superfluid = scene.superfluid;
    let helium = superfluid.map_or(Helium::AT_1_90_K, |it| it.helium());
    let counterflow = initial.given("counterflow").map_or(0.0, largest);
    let excess = initial.given("entropy").map_or(0.0, largest);
    let lids: Vec<Vector3> = scene.regions.iter().map(lid_velocity).collect();
    let whole = fastest(initial).max(largest(&lids));
    let flow = flow_speeds(&helium, excess, counterflow, whole);
    HeliumParameters {
        support_radius: scene.support_radius(),
        particle_spacing: scene.particle_spacing,
        time_step: scene.time_step(),
        helium,
        operators: superfluid.map_or(Operators::default(), |it| it.operators()),
        first_excess: initial.given("entropy").map_or(0.0, mean),
        viscosity: superfluid.map_or(0.0, |it| it.viscosity),
        diffusion: superfluid.map_or(0.0, |it| it.diffusion),
        mutual_friction: superfluid.map_or(0.0, |it| it.mutual_friction),
        most_separation: superfluid
            .and_then(|it| it.separation)
            .unwrap_or(f64::INFINITY),
        gravity: first(scene.gravity.uniform),
        surface: superfluid.and_then(|it| it.surface),
        // A scene with more parts was refused.
        walls: initial
            .walls
            .iter()
            .map(|wall| wall_part(scene, wall))
            .collect(),
        suction: superfluid.is_some_and(|it| it.walls == WallPressure::PushAndPull),
        heater: superfluid.and_then(|it| it.heater).map(|heater| Heater {
            place: first(heater.place),
            power: heater.power,
            radius: heater.radius,
        }),
        superleak: superfluid
            .and_then(|it| it.superleak)
            .map(|leak| Superleak {
                centre: first(leak.centre),
                half: first(leak.half),
                radius: leak.radius,
                time: leak.time,
            }),
        speed_bin: flow.whole / BINS as f64,
        scale: reach::scale(
            scene,
            initial,
            helium.sound_speed.max(fastest(initial)).max(counterflow),
            helium.reference_density,
        ),
        extent: first(bounds.extent),
        max_buckets: max_buckets(initial.fluid.len()),
    }
}

/// What a wall is.
fn wall_part<const D: usize>(scene: &Scene, wall: &InitialWall) -> WallPart<D> {
    let region = &scene.regions[wall.region];
    WallPart {
        first: wall.first,
        rough: !region.smooth,
        conduction: region.conduction.unwrap_or(0.0),
        velocity: first(lid_velocity(region)),
    }
}

/// The velocity with which a wall rubs, m/s.
fn lid_velocity(region: &Region) -> Vector3 {
    match (region.kind, &region.velocity[..]) {
        (RegionKind::Wall, [Velocity::Uniform(velocity)]) => *velocity,
        _ => [0.0; 3],
    }
}

/// The mean of a scalar.
fn mean(values: &[Vector3]) -> f64 {
    let sum: f64 = values.iter().map(|x| x[0]).sum();
    sum / values.len().max(1) as f64
}

/// The speeds that helium comes to, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowSpeeds {
    /// Of the liquid as a whole.
    pub whole: f64,
    /// Of the counterflow v - v_s.
    pub counterflow: f64,
}

/// The speeds that helium comes to, from the largest |s - s0|/s0 and the largest speeds (m/s) of
/// the counterflow and of the whole at the start.
///
/// In a standing wave of second sound of the relative amplitude A the counterflow u reaches
/// A u_2 χ_n/χ_s. It drives the whole by its momentum flux, (χ_s/χ_n) u²; in the end disorder shares
/// its energy among both.
#[must_use]
pub fn flow_speeds(helium: &Helium, excess: f64, counterflow: f64, whole: f64) -> FlowSpeeds {
    let normal = helium.normal_fraction;
    let ratio = (1.0 - normal) / normal;
    let sound = helium.second_sound();
    let wave = if ratio > 0.0 {
        excess * sound / ratio
    } else {
        0.0
    };
    let u = counterflow.max(wave);
    let driven = if sound > 0.0 {
        DRIVEN * ratio * (u * u) / sound
    } else {
        0.0
    };
    let speeds = FlowSpeeds {
        whole: driven.min(2.0 * u).max(2.0 * whole),
        counterflow: u.max(whole),
    };
    // At rest, something that is not nothing.
    let least = 0.01 * helium.sound_speed;
    let or_least = |speed: f64| if speed > 0.0 { speed } else { least };
    FlowSpeeds {
        whole: or_least(speeds.whole),
        counterflow: or_least(speeds.counterflow),
    }
}

/// The fastest particles of a wave that has dissolved, over (χ_s/χ_n) u²/u_2: in the scene
/// `second-sound-steep` none was faster than 12 times this.
const DRIVEN: f64 = 14.0;
