//! What scenes of elastic bodies mean: their keys, bodies and clamps, and first velocities.

use loschmidt_core::schemes::solid::Motion;
use loschmidt_runner::scene::{
    ElasticEnergy, InitialPart, InitialState, LatticeKind, Model, Scene, SceneError, Source,
    StepRule, Velocity, load,
};

fn try_read(text: &str, overrides: &[&str]) -> Result<Scene, SceneError> {
    let source = Source::Text {
        name: "beam.toml".to_owned(),
        text: text.to_owned(),
    };
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    load(&source, &overrides)
}

fn read(text: &str, overrides: &[&str]) -> Scene {
    try_read(text, overrides).unwrap_or_else(|error| panic!("{error}"))
}

fn catalogued(name: &str) -> Scene {
    load(&Source::Catalogue(name.to_owned()), &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn state(scene: &Scene) -> InitialState {
    scene
        .initial_state()
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Reads what a scene prints.
fn reprinted(scene: &Scene) -> Scene {
    let printed = scene.to_toml();
    try_read(&printed, &[]).unwrap_or_else(|error| panic!("{error}\n{printed}"))
}

fn assert_close(found: f64, expected: f64, relative: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(error <= relative, "{found:?} is not {expected:?}");
}

const HEAD: &str = r#"
particle_spacing = 0.1
turnaround = 1
model = "solid"
[solid]
reference_density = 1000
bulk_speed = 30
shear_speed = 20
"#;

/// A beam, and a clamp that continues it without saying on which lattice.
const CLAMPED: &str = r#"
[[region]]
kind = "solid"
body = "beam"
lattice = "hexagonal"
shape.rectangle = { min = [0, 0], max = [2, 0.5] }
[[region]]
kind = "solid"
body = "beam"
held = true
shape.rectangle = { min = [-0.5, 0], max = [0, 0.5] }
"#;

const BLOCK: &str = r#"
[[region]]
kind = "solid"
shape.rectangle = { min = [0, 0], max = [1, 1] }
"#;

fn clamped() -> Scene {
    read(&[HEAD, CLAMPED].concat(), &[])
}

fn block(overrides: &[&str]) -> Scene {
    read(&[HEAD, BLOCK].concat(), overrides)
}

#[test]
fn keys_of_a_solid_are_read_and_absent_ones_have_their_defaults() {
    let scene = block(&[]);
    assert_eq!(scene.model, Model::Solid);
    assert_eq!(scene.fluid, None, "a solid is no fluid");
    let solid = scene.solid.expect("a material");
    assert_eq!(solid.reference_density, 1000.0);
    assert_eq!((solid.bulk_speed, solid.shear_speed), (30.0, 20.0));
    assert_eq!(solid.penalty, 1.0);
    assert_eq!(solid.material().penalty_speed, 30.0, "as the bulk speed");
    assert_eq!(solid.energy, ElasticEnergy::Dpr);
    assert_eq!(scene.step, StepRule::Cfl(0.2));
    let region = &scene.regions[0];
    assert_eq!((region.body.as_deref(), region.held), (None, false));

    let set = [
        "solid.penalty=0",
        "solid.energy=neo-hookean",
        "model=solid-midpoint",
        "region.0.body=block",
    ];
    let scene = block(&set);
    assert_eq!(scene.model, Model::SolidMidpoint);
    let solid = scene.solid.expect("a material");
    assert_eq!(solid.material().penalty_speed, 0.0, "none at all");
    assert_eq!(solid.energy, ElasticEnergy::NeoHookean);
    assert_eq!(scene.regions[0].body.as_deref(), Some("block"));
}

#[test]
fn a_solid_has_the_speed_of_longitudinal_waves_and_a_step_that_knows_the_penalty() {
    let scene = block(&[]);
    assert_eq!(scene.reference_density(), 1000.0);
    assert_close(scene.particle_mass(), 10.0, 1e-15);
    // c_0² + 4/3 c_s² = 900 + 1600/3, and c_0² + 2 c_s² = 900 + 800.
    assert_close(scene.sound_speed(), (4300.0_f64 / 3.0).sqrt(), 1e-15);
    let neo_hookean = block(&["solid.energy=neo-hookean"]);
    assert_close(neo_hookean.sound_speed(), 1700_f64.sqrt(), 1e-15);
    // 0.2 of the support radius, 0.3 m, over sqrt(1700 + 4 · 900) m/s.
    assert_close(neo_hookean.time_step(), 0.06 / 5300_f64.sqrt(), 1e-15);
    let free = block(&["solid.energy=neo-hookean", "solid.penalty=0"]);
    assert_close(free.time_step(), 0.06 / 1700_f64.sqrt(), 1e-15);
    assert_eq!(block(&["time_step=1e-3"]).time_step(), 1e-3);
}

#[test]
fn a_printed_solid_reads_back_as_the_same_scene() {
    let bending = "region.0.velocity={ bending = 2.0, wave_number = 3.0, a1 = 1.0, a2 = 0.5 }";
    for scene in [
        clamped(),
        block(&[]),
        block(&["solid.penalty=0", "solid.energy=neo-hookean"]),
        block(&["time_step=1e-3", "model=solid-midpoint", bending]),
        catalogued("twisting-column"),
    ] {
        assert_eq!(reprinted(&scene), scene);
    }
}

#[test]
fn the_print_of_a_scene_says_what_its_courant_number_means() {
    let printed = block(&[]).to_toml();
    assert!(printed.contains("time step = cfl * h / sqrt(c_L² + 4 c_p²)"));
    assert!(!printed.contains("cfl * h / sound_speed"), "{printed}");
    let water = catalogued("dam-break").to_toml();
    assert!(water.contains("Courant number: time step = cfl * h / sound_speed\n"));
    assert!(!water.contains("c_L"), "{water}");
}

#[test]
fn keys_of_other_models_are_not_printed() {
    let printed = block(&[]).to_toml();
    for key in ["[fluid]", "[wall]", "wall_model", "density_correction"] {
        assert!(!printed.contains(key), "{key} in\n{printed}");
    }
    for key in ["[solid]", "penalty = 1.0", "held = false", "# body = …"] {
        assert!(printed.contains(key), "no {key} in\n{printed}");
    }
    let water = catalogued("dam-break").to_toml();
    for key in ["[solid]", "held =", "body =", "bending", "wave_number"] {
        assert!(!water.contains(key), "{key} in\n{water}");
    }
}

/// Bits, so that equal means equal.
fn sorted(points: &[[f64; 3]]) -> Vec<[u64; 3]> {
    let mut bits: Vec<_> = points.iter().map(|p| p.map(f64::to_bits)).collect();
    bits.sort_unstable();
    bits
}

#[test]
fn a_clamp_continues_the_lattice_of_its_body() {
    let scene = clamped();
    let hexagonal = Some(LatticeKind::Hexagonal);
    assert_eq!(scene.regions[0].lattice, hexagonal);
    assert_eq!(scene.regions[1].lattice, hexagonal, "that of the body");
    let state = state(&scene);
    let (beam, clamp) = state.fluid.split_at(state.parts[1].first as usize);
    assert!(!clamp.is_empty() && clamp.iter().all(|p| p[0] < 0.0));
    // Every particle of the clamp lies in a row of the beam, whole pitches away.
    let pitch = 0.1 * (2.0 / 3_f64.sqrt()).sqrt();
    for p in clamp {
        let continues = |q: &&[f64; 3]| {
            let pitches = (q[0] - p[0]) / pitch;
            q[1].to_bits() == p[1].to_bits() && (pitches - pitches.round()).abs() < 1e-9
        };
        assert!(beam.iter().any(|q| continues(&q)), "{p:?}");
    }
    // A body of its own begins a lattice of its own, too near to the other one.
    let split = read(&[HEAD, CLAMPED].concat(), &["region.1.body=other"]);
    assert_eq!(split.regions[1].lattice, Some(LatticeKind::Square));
    let outcome = split.initial_state();
    assert!(matches!(outcome, Err(SceneError::BodiesTooNear { .. })));
}

#[test]
fn a_body_in_two_regions_has_the_particles_of_the_body_in_one() {
    let whole = state(&block(&["region.0.lattice=hexagonal"])).fluid;
    let halves = r#"
[[region]]
kind = "solid"
body = "block"
lattice = "hexagonal"
shape.rectangle = { min = [0, 0], max = [1, 0.43] }
[[region]]
kind = "solid"
body = "block"
held = true
shape.rectangle = { min = [0, 0.43], max = [1, 1] }
"#;
    let halves = read(&[HEAD, halves].concat(), &[]);
    assert_eq!(sorted(&state(&halves).fluid), sorted(&whole));
}

#[test]
fn the_estimate_counts_a_body_on_its_own_lattice() {
    for name in [
        "beryllium-plate",
        "twisting-column",
        "colliding-rings",
        "cantilever",
    ] {
        let scene = catalogued(name);
        let count = state(&scene).fluid.len() as u64;
        assert_eq!(scene.estimated_particles(), (count, 0), "{name}");
    }
    let scene = clamped();
    let count = state(&scene).fluid.len() as u64;
    assert_eq!(scene.estimated_particles(), (count, 0));
}

#[test]
fn every_region_is_a_part_of_a_body() {
    let regions = r#"
[[region]]
kind = "solid"
body = "a"
shape.rectangle = { min = [0, 0], max = [1, 0.2] }
[[region]]
kind = "solid"
shape.rectangle = { min = [3, 0], max = [4, 0.3] }
[[region]]
kind = "solid"
body = "a"
held = true
shape.rectangle = { min = [-0.3, 0], max = [0, 0.2] }
[[region]]
kind = "solid"
shape.rectangle = { min = [6, 0], max = [7, 0.1] }
"#;
    let scene = read(&[HEAD, regions].concat(), &[]);
    assert_eq!(scene.bodies(), (vec![0, 1, 0, 2], 3));
    let state = state(&scene);
    let part = |first, body, held| InitialPart {
        first,
        body,
        held,
        motion: Motion::Still,
    };
    let expected = [
        part(0, 0, false),
        part(20, 1, false),
        part(50, 0, true),
        part(56, 2, false),
    ];
    assert_eq!(state.parts, expected);
    assert_eq!(state.fluid.len(), 66);
    assert!(state.wall.is_empty());
    assert_eq!(state.fluid_velocity, vec![[0.0; 3]; 66]);
}

#[test]
fn water_has_no_parts() {
    assert!(state(&catalogued("colliding-drops")).parts.is_empty());
}

#[test]
fn bending_and_twist_have_the_velocities_of_the_paper() {
    let bending = Velocity::Bending {
        peak: 2.0,
        wave_number: 4.0,
        shape: [3.0, 5.0],
        start: -0.5,
    };
    // s = 0 at the start: 2 (3 · 0 - 5 · 2).
    assert_eq!(bending.at([-0.5, 7.0, 0.0]), [0.0, -20.0, 0.0]);
    // s = 1: sinh 1 + sin 1 = 2.0166721784516979, cosh 1 + cos 1 = 2.0833829406833835.
    let [x, y, z] = bending.at([-0.25, 7.0, 0.0]);
    assert_eq!((x, z), (0.0, 0.0));
    let expected = 2.0 * (3.0 * 2.016_672_178_451_698 - 5.0 * 2.083_382_940_683_383_5);
    assert_close(y, expected, 1e-14);

    let twist = Velocity::Twist {
        rate: 105.0,
        height: 6.0,
    };
    assert_eq!(twist.at([0.5, 0.25, 0.0]), [0.0, -0.0, 0.0]);
    // At the top sin π/2 = 1, at a third of the height sin π/6 = 1/2.
    let [x, y, z] = twist.at([0.5, 0.25, 6.0]);
    assert_eq!([x, y, z], [105.0 * 0.25, -105.0 * 0.5, 0.0]);
    let [x, y, _] = twist.at([0.5, 0.25, 2.0]);
    assert_close(x, 0.5 * 105.0 * 0.25, 1e-15);
    assert_close(y, -0.5 * 105.0 * 0.5, 1e-15);
}

#[test]
fn a_misspelt_companion_of_a_velocity_gives_one_message() {
    let velocity = "region.0.velocity={ bending = 1, wavenumber = 2, a1 = 1, a2 = 1 }";
    let error = try_read(&[HEAD, BLOCK].concat(), &[velocity]).expect_err("a misspelt key");
    let SceneError::Invalid(problems) = error else {
        panic!("not a list of problems");
    };
    let messages: Vec<&str> = problems.iter().map(|p| p.message.as_str()).collect();
    assert_eq!(messages, ["unknown key `wavenumber` in a `velocity`"]);
}

/// c_0 and c_s of neo-Hookean material from Young's modulus, Poisson's ratio and density.
fn neo_hookean(modulus: f64, ratio: f64, density: f64) -> (f64, f64) {
    let shear = modulus / (2.0 * (1.0 + ratio));
    let lame = ratio * modulus / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
    ((lame / density).sqrt(), (shear / density).sqrt())
}

fn assert_speeds(scene: &Scene, expected: (f64, f64)) {
    let solid = scene.solid.expect("a material");
    assert_close(solid.bulk_speed, expected.0, 1e-6);
    assert_close(solid.shear_speed, expected.1, 1e-6);
}

#[test]
fn the_plate_is_that_of_the_paper() {
    let scene = catalogued("beryllium-plate");
    assert_speeds(&scene, (9046.59, 9046.59));
    assert_eq!(scene.reference_density(), 1845.0);
    let [Velocity::Bending { peak, shape, .. }] = scene.regions[0].velocity[..] else {
        panic!("the plate does not bend");
    };
    assert_close(peak, 4.3369e-5 * 2.3597e5, 1e-6);
    assert_eq!(shape, [56.6368, 57.6455]);
    let state = state(&scene);
    let area = state.fluid.len() as f64 * scene.particle_spacing * scene.particle_spacing;
    assert_close(area, 6e-4, 0.05);
    // The ends swing against the middle.
    let at = |x: f64| {
        let near = |n: &usize| (state.fluid[*n][0] - x).abs() < 1e-3;
        let n = (0..state.fluid.len()).find(near).expect("a particle");
        state.fluid_velocity[n][1]
    };
    assert!(at(0.0) * at(0.029) < 0.0 && at(0.0) * at(-0.029) < 0.0);
}

#[test]
fn the_column_stands_on_one_held_layer() {
    let scene = catalogued("twisting-column");
    assert_speeds(&scene, neo_hookean(17e6, 0.495, 1100.0));
    // Six cells of two particles, six of them wide and deep.
    let edge = scene.particle_spacing * 2_f64.cbrt();
    assert_close(edge, 1.0 / 6.0, 1e-14);
    let state = state(&scene);
    assert_eq!(state.fluid.len(), 6 * 6 * 36 * 2);
    let [foot, rest] = state.parts[..] else {
        panic!("not two parts");
    };
    assert!(foot.held && !rest.held && foot.body == rest.body);
    assert_eq!(rest.first, 36);
    let layer = state.fluid[0][2].to_bits();
    assert!(state.fluid[..36].iter().all(|p| p[2].to_bits() == layer));
    assert!(state.fluid[36..].iter().all(|p| p[2].to_bits() != layer));
}

#[test]
fn the_rings_are_of_rubber_and_begin_out_of_reach() {
    let scene = catalogued("colliding-rings");
    let (bulk, shear) = neo_hookean(10e6, 0.4, 1200.0);
    assert_speeds(&scene, (bulk, shear));
    let state = state(&scene);
    let second = state.parts[1].first as usize;
    assert_eq!(state.parts[1].body, 1);
    let (left, right) = state.fluid.split_at(second);
    let distance = |p: &[f64; 3], q: &[f64; 3]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let gap = |p: &[f64; 3]| right.iter().map(|q| distance(p, q)).fold(1.0, f64::min);
    let gap = left.iter().map(gap).fold(1.0, f64::min);
    assert!(gap > scene.support_radius(), "{gap}");
    let (first, last) = (state.fluid_velocity[0], state.fluid_velocity[second]);
    assert_eq!(first, last.map(|v| -v + 0.0));
    assert_close(first[0], 0.06 * bulk, 0.01);
}

#[test]
fn the_cantilever_is_clamped_by_four_columns_and_bends_by_a_fiftieth_of_its_length() {
    let scene = catalogued("cantilever");
    let (modulus, ratio, density) = (1.4e6_f64, 0.4_f64, 1000.0_f64);
    let bulk = modulus / (3.0 * (1.0 - 2.0 * ratio));
    let shear = modulus / (2.0 * (1.0 + ratio));
    let speeds = ((bulk / density).sqrt(), (shear / density).sqrt());
    assert_speeds(&scene, speeds);
    let (length, thickness) = (0.2_f64, 0.02_f64);
    let stiffness = modulus / (1.0 - ratio * ratio);
    let load = density * -scene.gravity.uniform[1];
    let deflection = 3.0 * load * length.powi(4) / (2.0 * stiffness * thickness * thickness);
    assert_close(deflection, 0.02 * length, 1e-5);
    let state = state(&scene);
    let clamp = &state.fluid[state.parts[1].first as usize..];
    assert_eq!((clamp.len(), state.fluid.len()), (40, 1040));
    assert!(clamp.iter().all(|p| p[0] < 0.0));
}
