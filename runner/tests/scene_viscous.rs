//! What scenes of viscous fluids mean, and bodies of several materials.

use loschmidt_core::schemes::solid::{Motion, ShearEnergy};
use loschmidt_runner::scene::{Model, Relaxation, Scene, Source, WallVelocity, load};
use loschmidt_runner::setup::fluid_parameters;

fn read(text: &str, overrides: &[&str]) -> Scene {
    let source = Source::Text {
        name: "box.toml".to_owned(),
        text: text.to_owned(),
    };
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    load(&source, &overrides).unwrap_or_else(|error| panic!("{error}"))
}

const BOX: &str = r#"
particle_spacing = 0.1
end = 1
model = "viscous"
[viscous]
reference_density = 1
bulk_speed = 20
shear_speed = 10
viscosity = 0.05
[[region]]
kind = "wall"
shape.rectangle = { min = [0, -0.2], max = [1, 0] }
[[region]]
kind = "fluid"
shape.rectangle = { min = [0, 0], max = [1, 1] }
[[region]]
kind = "wall"
shape.rectangle = { min = [0, 1], max = [1, 1.2] }
velocity.uniform = [1, 0]
[[region]]
kind = "wall"
shape.annulus = { centre = [3, 0], inner = 0.5, outer = 0.7 }
velocity = { rotation = 2, centre = [3, 0] }
"#;

#[test]
fn keys_of_a_viscous_fluid_are_read_and_absent_ones_have_their_defaults() {
    let scene = read(BOX, &[]);
    assert_eq!(scene.model, Model::Viscous);
    assert_eq!((scene.fluid, scene.solid), (None, None));
    let viscous = scene.viscous.expect("a fluid");
    assert_eq!(viscous.relaxation, Relaxation::Exact);
    assert_eq!(viscous.wall_velocity, WallVelocity::Mirrored);
    assert_eq!((viscous.penalty, viscous.start), (0.0, 0.0));
    assert_eq!(viscous.material().energy, ShearEnergy::Dpr);
    // 6 nu/c_s².
    assert!((viscous.relaxation_time() - 0.003).abs() < 1e-15);
    // 0.2 of 0.3 m over sqrt(400 + 4/3 100) m/s.
    let expected = 0.06 / (1600.0_f64 / 3.0).sqrt();
    assert!((scene.time_step() / expected - 1.0).abs() < 1e-15);
    assert_eq!(scene.reference_density(), 1.0);
}

#[test]
fn walls_are_held_parts_that_know_the_way_to_the_flow_and_how_they_move() {
    let scene = read(BOX, &[]);
    let state = scene.initial_state().expect("a state");
    assert!(state.wall.is_empty(), "walls carry what the flow carries");
    let held: Vec<bool> = state.parts.iter().map(|part| part.held).collect();
    // The flow has the first ids, wherever it stands in the file.
    assert_eq!(held, [false, true, true, true]);
    assert!(state.parts.iter().all(|part| part.body == 0));
    assert_eq!(state.parts[1].motion, Motion::Still);
    assert_eq!(state.parts[2].motion, Motion::Slides([1.0, 0.0, 0.0]));
    let turns = Motion::Turns {
        rate: [0.0, 0.0, 2.0],
        centre: [3.0, 0.0, 0.0],
    };
    assert_eq!(state.parts[3].motion, turns);
    let ways = state.given("wall offset").expect("ways to the surface");
    assert_eq!(ways.len(), state.fluid.len());
    for (id, (x, way)) in state.fluid.iter().zip(ways).enumerate() {
        let part = state.parts.iter().rposition(|part| part.first <= id as u64);
        let expected = match part {
            Some(1) => [0.0, -x[1], 0.0],
            Some(2) => [0.0, 1.0 - x[1], 0.0],
            // Flow, and a wall without flow in reach.
            _ => [0.0; 3],
        };
        for (a, b) in way.iter().zip(expected) {
            assert!((a - b).abs() < 1e-8, "{x:?}: {way:?} is not {expected:?}");
        }
    }
    let (fluid, walls) = scene.estimated_particles();
    assert_eq!((fluid as usize, walls), (state.fluid.len(), 0));
    let parameters = fluid_parameters::<2>(&scene, &state);
    assert_eq!(parameters.bodies.materials.len(), 1);
    assert_eq!(parameters.bodies.parts[3].motion, turns);
}

#[test]
fn a_printed_viscous_scene_reads_back_as_the_same_scene() {
    for overrides in [
        &[][..],
        &[
            "viscous.relaxation=paper",
            "viscous.wall_velocity=plain",
            "cfl=0.05",
        ],
        &["viscous.start=0.5", "viscous.penalty=0.1"],
    ] {
        let scene = read(BOX, overrides);
        let printed = scene.to_toml();
        assert_eq!(read(&printed, &[]), scene, "{printed}");
        assert_eq!(read(&printed, &[]).to_toml(), printed);
    }
}

#[test]
fn the_cavity_and_the_cylinders_are_those_of_the_paper() {
    let catalogued = |name: &str| {
        load(&Source::Catalogue(name.to_owned()), &[]).unwrap_or_else(|error| panic!("{error}"))
    };
    let cavity = catalogued("lid-driven-cavity");
    let state = cavity.initial_state().expect("a state");
    let lid = state.parts[2];
    assert_eq!(lid.motion, Motion::Slides([1.0, 0.0, 0.0]));
    // 40 by 40, and two rows around it without the outer corners.
    assert_eq!(state.parts[1].first, 1600);
    assert_eq!(state.fluid.len() - lid.first as usize, 42 + 40);
    let couette = catalogued("taylor-couette");
    let state = couette.initial_state().expect("a state");
    let area = std::f64::consts::PI * 3.0 / couette.particle_spacing.powi(2);
    assert!((state.parts[1].first as f64 / area - 1.0).abs() < 2e-3);
}

const RODS: &str = r#"
particle_spacing = 0.1
turnaround = 1
model = "solid"
[solid]
reference_density = 1000
bulk_speed = 30
shear_speed = 20
[[region]]
kind = "solid"
shape.rectangle = { min = [0, 0], max = [1, 1] }
[[region]]
kind = "solid"
body = "soft"
material = { shear_speed = 5, energy = "neo-hookean" }
shape.rectangle = { min = [2, 0], max = [3, 1] }
[[region]]
kind = "solid"
body = "soft"
held = true
shape.rectangle = { min = [3, 0], max = [3.2, 1] }
[[region]]
kind = "solid"
material.bulk_speed = 60
shape.rectangle = { min = [5, 0], max = [6, 1] }
"#;

#[test]
fn bodies_may_differ_in_their_material() {
    let scene = read(RODS, &[]);
    let solids = scene.solids();
    assert_eq!(solids.len(), 3);
    assert_eq!((solids[0].bulk_speed, solids[0].shear_speed), (30.0, 20.0));
    assert_eq!((solids[1].bulk_speed, solids[1].shear_speed), (30.0, 5.0));
    assert_eq!(solids[1].material().energy, ShearEnergy::NeoHookean);
    assert_eq!(solids[2].bulk_speed, 60.0);
    // A region takes the material of its body.
    assert_eq!(scene.regions[2].material, scene.regions[1].material);
    // The stiffest body sets the time step.
    let stiff = 3600.0 + 4.0 / 3.0 * 400.0 + 4.0 * 3600.0;
    let expected = 0.06 / f64::sqrt(stiff);
    assert!((scene.time_step() / expected - 1.0).abs() < 1e-15);
    let printed = scene.to_toml();
    assert_eq!(read(&printed, &[]), scene, "{printed}");
}
