//! The scenes that come with the program are what they claim to be.

use loschmidt_runner::scene::{
    EquationOfState, Scene, Source, StepRule, WallModel, WallPotential, catalogue, load,
};

fn scene(name: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    load(&Source::Catalogue(name.to_owned()), &overrides)
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn every_scene_of_the_catalogue_is_named_cited_and_read_back_from_its_print() {
    for entry in catalogue() {
        let scene = scene(entry.name, &[]);
        assert_eq!(scene.name, entry.name);
        assert_eq!(scene.source, entry.citation);
        assert!(!scene.description.is_empty());
        let printed = Source::Text {
            name: "printed.toml".to_owned(),
            text: scene.to_toml(),
        };
        assert_eq!(load(&printed, &[]).expect("the print is a scene"), scene);
    }
}

#[test]
fn every_value_in_the_catalogue_is_commented() {
    for entry in catalogue() {
        for line in entry.text.lines() {
            let is_text = ["name", "description", "source"]
                .iter()
                .any(|key| line.starts_with(&format!("{key} = ")));
            let says_itself = line.contains("kind = ") || line.contains("lattice = ");
            if line.contains(" = ") && !line.starts_with('#') && !line.ends_with('[') {
                assert!(
                    is_text || says_itself || line.contains(" # "),
                    "{}: {line}",
                    entry.name
                );
            }
        }
    }
}

#[test]
fn the_dam_break_has_the_parameters_of_table_1() {
    let scene = scene("dam-break", &[]);
    assert_eq!(scene.particle_spacing, 0.005);
    assert_eq!(scene.support, 3.0);
    assert_eq!(scene.step, StepRule::Cfl(0.2));
    assert_eq!(scene.fluid.unwrap().reference_density, 1000.0);
    assert_eq!(scene.fluid.unwrap().sound_speed, 120.0);
    assert_eq!(
        scene.fluid.unwrap().equation_of_state,
        EquationOfState::Tait
    );
    assert_eq!(scene.gravity.uniform, [0.0, -9.8, 0.0]);
    let wall = WallPotential {
        energy: 196.0,
        radius: 0.95,
        softening: 1e-6,
    };
    assert_eq!(scene.wall, Some(wall));
    assert_eq!((scene.turnaround, scene.end), (Some(1.0), None));
    assert_eq!((scene.steps_out(), scene.steps_back()), (40_000, 40_000));
    assert_eq!(scene.particle_mass(), 0.025);
}

#[test]
fn the_dam_break_has_80_000_particles_and_5_000_at_four_times_the_spacing() {
    let fine = scene("dam-break", &[]);
    assert_eq!(fine.initial_state().expect("a state").fluid.len(), 80_000);
    assert_eq!(fine.estimated_particles().0, 80_000);

    let coarse = scene("dam-break", &["particle_spacing=0.02"]);
    let state = coarse.initial_state().expect("a state");
    assert_eq!(state.fluid.len(), 5_000);
    assert_eq!((coarse.steps_out(), coarse.steps_back()), (10_000, 10_000));
    // Particle 0 is the lower left one; x runs fastest.
    assert_eq!(state.fluid[0], [0.01, 0.01, 0.0]);
    assert_eq!(state.fluid[1], [0.03, 0.01, 0.0]);
    assert_eq!(state.fluid[50], [0.01, 0.03, 0.0]);
}

#[test]
fn the_box_of_the_dam_break_is_three_rows_deep_and_open_at_the_top() {
    let scene = scene("dam-break", &["particle_spacing=0.04"]);
    let wall = scene.initial_state().expect("a state").wall;
    let spacing = scene.particle_spacing;
    let row = |x: f64| (x / spacing).round() as i64;
    let below = |x: f64| {
        wall.iter()
            .filter(|p| row(p[0] - x) == 0 && p[1] < 0.0)
            .count()
    };
    assert_eq!(below(0.02), 3, "rows below the floor");
    let left = wall.iter().filter(|p| p[0] < 0.0 && row(p[1] - 1.02) == 0);
    assert_eq!(left.count(), 3, "rows left of the box");
    assert!(wall.iter().all(|p| p[1] < 3.0), "no wall above the rim");
    let highest = wall.iter().fold(0.0, |high: f64, p| high.max(p[1]));
    assert_eq!(row(highest - 2.98), 0, "the wall reaches up to the rim");
    assert!(
        wall.iter().all(|p| p[0] < 0.0 || p[0] > 4.0 || p[1] < 0.0),
        "no wall inside the box"
    );
    // Two sides of 75 rows and a floor of 100, three deep, and four nodes in each corner.
    assert_eq!(wall.len(), 3 * (75 + 75 + 100) + 2 * 4);
}

#[test]
fn the_drops_are_turned_after_5_000_steps_and_mirror_each_other() {
    let scene = scene("colliding-drops", &[]);
    assert_eq!((scene.steps_out(), scene.steps_back()), (5_000, 5_000));
    assert_eq!(scene.water.wall_model, WallModel::None);
    assert_eq!(scene.gravity.uniform, [0.0; 3]);
    let state = scene.initial_state().expect("a state");
    assert!(state.fluid.len() <= 5_000 && state.fluid.len().is_multiple_of(2));
    assert!(state.wall.is_empty());
    let momentum: f64 = state.fluid_velocity.iter().map(|v| v[0] + v[1]).sum();
    assert_eq!(momentum, 0.0);
}

#[test]
fn the_rotating_drop_turns_rigidly_and_is_turned_after_3_000_steps() {
    let scene = scene("rotating-drop", &[]);
    assert_eq!((scene.steps_out(), scene.steps_back()), (3_000, 3_000));
    let state = scene.initial_state().expect("a state");
    assert!((1_900..2_100).contains(&state.fluid.len()));
    for (x, v) in state.fluid.iter().zip(&state.fluid_velocity) {
        assert_eq!(*v, [-2.0 * x[1], 2.0 * x[0], 0.0]);
    }
}

#[test]
fn the_dam_break_in_space_has_16_000_particles_in_an_open_box() {
    let scene = scene("dam-break-3d", &[]);
    let state = scene.initial_state().expect("a state");
    assert_eq!(state.fluid.len(), 16_000);
    assert_eq!(scene.estimated_particles().0, 16_000);
    assert_eq!(scene.estimated_particles().1, state.wall.len() as u64);
    assert!(state.wall.iter().all(|p| p[1] < 1.5));
    assert!(scene.steps_out() > 1_000);
}

#[test]
fn without_a_wall_model_no_wall_particle_is_made() {
    let scene = scene("dam-break", &["particle_spacing=0.04", "wall_model=none"]);
    assert!(scene.initial_state().expect("a state").wall.is_empty());
    assert_eq!(scene.estimated_particles().1, 0);
}

#[test]
fn the_gresho_vortex_has_the_parameters_of_table_3() {
    let scene = scene("gresho-vortex", &[]);
    assert_eq!(scene.particle_spacing, 0.01);
    assert_eq!(scene.support, 3.0);
    assert_eq!(scene.step, StepRule::Cfl(0.1));
    assert_eq!(scene.fluid.unwrap().reference_density, 1.0);
    assert_eq!(scene.fluid.unwrap().sound_speed, 20.0);
    assert_eq!(scene.fluid.unwrap().anti_clump_pressure, 10.0);
    assert_eq!(scene.fluid.unwrap().anti_clump_radius, 0.5);
    assert_eq!(scene.water.filter_every, 30);
    assert_eq!(scene.water.wall_model, WallModel::Dummy);
    let state = scene.initial_state().expect("a state");
    assert_eq!(state.fluid.len(), 10_000);
    // Two rows on every side, and three nodes in each corner: the fourth is too far from the fluid.
    assert_eq!(state.wall.len(), 4 * 2 * 100 + 4 * 3);
}

#[test]
fn the_kepler_ring_turns_ten_times_in_circles() {
    let scene = scene("kepler-ring", &[]);
    let revolution = 2.0 * std::f64::consts::PI;
    assert!((scene.steps_out() as f64 * scene.time_step() / revolution - 10.0).abs() < 1e-3);
    let mass = scene.gravity.central.expect("a mass").strength;
    let state = scene.initial_state().expect("a state");
    assert!((7_900..8_200).contains(&state.fluid.len()));
    for (x, v) in state.fluid.iter().zip(&state.fluid_velocity) {
        let r = x[0].hypot(x[1]);
        assert!((0.9..1.1).contains(&r));
        // The centrifugal acceleration is the attraction.
        let v2 = v[0] * v[0] + v[1] * v[1];
        assert!((v2 / r - mass / (r * r)).abs() < 1e-12);
    }
}
