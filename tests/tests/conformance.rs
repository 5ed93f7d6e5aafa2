//! Every executor, on every instruction set of this machine and any number of threads, leaves the
//! bits of the plain reference: the same digests, and where the numbers end the same fault.

use loschmidt_core::integrator::STORMER_VERLET;
use loschmidt_core::schemes::wcsph::Gravity;
use loschmidt_core::{Arithmetic, Fault, Filtered, Fixed, Float, Parameters, Standard, Symplectic};
use loschmidt_runner::fast::Backend;
use loschmidt_runner::scene::{InitialState, Scene};
use loschmidt_runner::{ArithmeticKind, Options, Player};
use loschmidt_tests::conformance;
use loschmidt_tests::conformance::{check_scene, disordered};
use loschmidt_tests::generator::Generator;
use loschmidt_tests::program::{backends, fast, scene, scene_of, threads};
use proptest::prelude::*;

conformance! {
    symplectic_in_the_plane: Symplectic<Fixed, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05"];
    symplectic_with_dummies_in_the_plane: Symplectic<Fixed, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "wall_model=dummy"];
    symplectic_in_space: Symplectic<Fixed, 3>, "dam-break-3d",
        ["particle_spacing=0.04", "cfl=0.05"];
    symplectic_with_dummies_in_space: Symplectic<Fixed, 3>, "dam-break-3d",
        ["particle_spacing=0.05", "cfl=0.05", "wall_model=dummy"];
    standard_in_the_plane: Standard<Fixed, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "model=standard"];
    standard_with_dummies_in_the_plane: Standard<Fixed, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "model=standard", "wall_model=dummy"];
    standard_in_space: Standard<Fixed, 3>, "dam-break-3d",
        ["particle_spacing=0.04", "cfl=0.05", "model=standard"];
    standard_with_dummies_in_space: Standard<Fixed, 3>, "dam-break-3d",
        ["particle_spacing=0.05", "cfl=0.05", "model=standard", "wall_model=dummy"];
    floating_in_space: Symplectic<Float, 3>, "dam-break-3d",
        ["particle_spacing=0.04", "cfl=0.05"];
    floating_with_dummies_in_the_plane: Symplectic<Float, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "wall_model=dummy"];
    floating_standard_in_the_plane: Standard<Float, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "model=standard"];
    // Twelve steps and three filterings, one of them in the last.
    filtered_in_the_plane: Filtered<Fixed, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "turnaround=", "end=1",
         "model=filtered", "filter_every=4"];
    filtered_with_dummies_in_the_plane: Filtered<Fixed, 2>, "dam-break",
        ["particle_spacing=0.02", "cfl=0.05", "turnaround=", "end=1",
         "model=filtered", "filter_every=4", "wall_model=dummy"];
    filtered_in_space: Filtered<Fixed, 3>, "dam-break-3d",
        ["particle_spacing=0.04", "cfl=0.05", "turnaround=", "end=1",
         "model=filtered", "filter_every=4"];
    filtered_with_dummies_in_space: Filtered<Fixed, 3>, "dam-break-3d",
        ["particle_spacing=0.05", "cfl=0.05", "turnaround=", "end=1",
         "model=filtered", "filter_every=4", "wall_model=dummy"];
}

/// The digests of a player after these numbers of steps, or the fault on the way.
fn digests(
    scene: &Scene,
    initial: &InitialState,
    options: Options,
    steps: &[u64],
) -> Result<Vec<String>, Fault> {
    let mut player = Player::new(scene.clone(), initial.clone(), options).unwrap();
    let mut found = vec![player.digest().to_string()];
    for &step in steps {
        player.advance(step - player.steps_taken())?;
        player.measure()?;
        found.push(player.digest().to_string());
    }
    Ok(found)
}

fn check_in<A: Arithmetic>(scene: &Scene, initial: &InitialState, steps: &[u64]) {
    let difference = check_scene::<A>(scene, initial, steps);
    difference.unwrap_or_else(|difference| panic!("{difference}"));
}

fn check(scene: &Scene, initial: &InitialState, steps: &[u64]) {
    check_in::<Fixed>(scene, initial, steps);
}

/// In floating point too: its sums have no order either.
fn check_both(scene: &Scene, initial: &InitialState, steps: &[u64]) {
    check(scene, initial, steps);
    check_in::<Float>(scene, initial, steps);
}

#[test]
fn on_a_disordered_dam_break_in_the_plane() {
    // 7,200 particles: several parts for several threads.
    let set = ["particle_spacing=0.016666666666666666", "cfl=0.05"];
    let scene = scene("dam-break", &set);
    check_both(&scene, &disordered(&scene, 1), &[1, 2, 25]);
}

#[test]
fn on_a_disordered_dam_break_in_the_plane_for_many_steps() {
    let scene = scene("dam-break", &["particle_spacing=0.05", "cfl=0.05"]);
    check_both(&scene, &disordered(&scene, 2), &[1, 2, 25, 500]);
}

#[test]
fn on_a_disordered_dam_break_in_space() {
    let scene = scene("dam-break-3d", &["particle_spacing=0.04", "cfl=0.05"]);
    check(&scene, &disordered(&scene, 3), &[1, 2, 25]);
}

#[test]
fn with_dummy_walls_every_integrator_and_the_standard_scheme() {
    for name in ["dam-break", "dam-break-3d"] {
        for set in [
            "wall_model=dummy",
            "integrator=pefrl",
            "integrator=suzuki",
            "model=standard",
            "fluid.equation_of_state=linear",
            "density_correction=none",
            "fluid.anti_clump_pressure=1e4",
        ] {
            let scene = scene(name, &["particle_spacing=0.1", "cfl=0.05", set]);
            check(&scene, &disordered(&scene, 4), &[1, 2, 25]);
        }
        for set in ["model=standard", "fluid.anti_clump_pressure=1e4"] {
            let set = ["particle_spacing=0.1", "wall_model=dummy", set];
            let scene = scene(name, &set);
            check_both(&scene, &disordered(&scene, 5), &[1, 2, 25]);
        }
    }
}

#[test]
fn around_an_attracting_mass() {
    let scene = scene_of(
        "particle_spacing = 0.03\nend = 1.0\nfluid.sound_speed = 20\n\
         gravity.central = { centre = [0.1, 0.2], strength = 2, softening = 0.1 }\n\
         [[region]]\nkind = \"fluid\"\nlattice = \"hexagonal\"\n\
         shape.annulus = { centre = [0, 0], inner = 0.3, outer = 0.6 }\n\
         velocity = { rotation = 3.0 }\n",
    );
    check(&scene, &scene.initial_state().unwrap(), &[1, 2, 25, 500]);
}

#[test]
fn where_the_numbers_end_the_same_particle_is_named_in_the_same_step() {
    let scene = scene("dam-break", &["particle_spacing=0.05", "cfl=2.0"]);
    let initial = scene.initial_state().unwrap();
    assert!(digests(&scene, &initial, threads(2), &[500]).is_err());
    check_both(&scene, &initial, &[500]);
}

/// Within a step the stage that comes first is the one whose fault is told, whatever the ids.
#[test]
fn of_two_faults_in_one_step_the_one_of_the_earlier_stage_is_told() {
    the_earlier_of_two_faults_is_told::<Fixed>();
    the_earlier_of_two_faults_is_told::<Float>();
}

fn the_earlier_of_two_faults_is_told<A: Arithmetic>() {
    let parameters = Parameters {
        // Half a metre per second and kick; less than 32 m, less than 2048 m/s.
        gravity: Gravity {
            uniform: [1024.0, 0.0],
            central: None,
        },
        integrator: &STORMER_VERLET,
        ..crate::faults::units()
    };
    // One leaves the positions in the drift of step n, one the velocities in one of its kicks.
    for (n, kick) in [(1, 0.0), (1, 0.5), (2, 0.0), (2, 0.5), (3, 0.0)] {
        let steps = f64::from(n - 1);
        let leaving = [0.0, 32.0 - (steps + 0.5) / 1024.0, 0.0];
        let fast = [2047.75 - steps - kick, 0.0, 0.0];
        let particles = [(leaving, [0.0, 1.0, 0.0]), ([-20.0, 0.0, 0.0], fast)];
        for order in [[0, 1], [1, 0]] {
            let initial = InitialState {
                fluid: order.map(|i| particles[i].0).to_vec(),
                fluid_velocity: order.map(|i| particles[i].1).to_vec(),
                ..InitialState::default()
            };
            let model = || Symplectic::<A, 2>::new(parameters).unwrap();
            for looked_at in [&[1, 2, 3, 4][..], &[4]] {
                conformance::check(model, &initial, looked_at).unwrap_or_else(|difference| {
                    panic!("step {n}, kick {kick}, order {order:?}, {looked_at:?}: {difference}")
                });
            }
        }
    }
}

#[test]
fn a_crowd_and_a_crowd_that_is_just_allowed() {
    let scene = cloud_scene(2);
    for n in [2047u32, 2048, 2500] {
        let fluid: Vec<_> = (0..n).map(|i| [1e-6 * f64::from(i), 0.0, 0.0]).collect();
        check_both(&scene, &cloud(fluid), &[1]);
    }
}

#[test]
fn a_channel_longer_than_a_meeting_can_name() {
    // 30,000 columns: four particles of a strip above one another are 120,000, more than 16 bits
    // count.
    let scene = scene_of(
        "particle_spacing = 0.1\nend = 1.0\ntime_step = 1e-5\nfluid.sound_speed = 10\n\
         wall_model = \"none\"\ndensity_correction = \"none\"\n[[region]]\nkind = \"fluid\"\n\
         shape.rectangle = { min = [0, 0], max = [3000, 0.8] }\n",
    );
    let mut initial = scene.initial_state().unwrap();
    let mut generator = Generator::new(6);
    for x in &mut initial.fluid {
        x[0] += 0.02 * generator.signed();
        x[1] += 0.02 * generator.signed();
    }
    let reference = digests(&scene, &initial, threads(2), &[2]);
    assert!(reference.is_ok(), "{reference:?}");
    let found = digests(&scene, &initial, fast(Backend::best(), 2), &[2]);
    assert_eq!(found, reference);
    // And it says who summed.
    let mut player = Player::new(scene, initial, fast(Backend::best(), 2)).unwrap();
    player.advance(1).unwrap();
    assert_eq!(player.backend(), "serial");
}

#[test]
fn a_run_says_what_its_sums_were_made_with() {
    let scene = scene_of(
        "particle_spacing = 0.1\nend = 1.0\ntime_step = 1e-5\nfluid.sound_speed = 10\n\
         [[region]]\nkind = \"fluid\"\nshape.rectangle = { min = [0, 0], max = [1, 1] }\n",
    );
    let backend = |options: Options| {
        let initial = scene.initial_state().unwrap();
        let mut player = Player::new(scene.clone(), initial, options).unwrap();
        player.advance(2).unwrap();
        player.backend()
    };
    for at_work in backends() {
        for arithmetic in [ArithmeticKind::Fixed, ArithmeticKind::Float] {
            let options = Options {
                arithmetic,
                ..fast(at_work, 1)
            };
            assert_eq!(backend(options), at_work.name(), "{arithmetic:?}");
        }
    }
    assert_eq!(backend(threads(2)), "serial");
}

fn cloud_scene(dimension: usize) -> Scene {
    let shape = if dimension == 2 { "rectangle" } else { "box" };
    let (min, max) = ([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]);
    scene_of(&format!(
        "dimension = {dimension}\nparticle_spacing = 0.1\nend = 1.0\ntime_step = 1e-5\n\
         fluid.sound_speed = 10\nwall_model = \"none\"\n\
         [[region]]\nkind = \"fluid\"\nshape.{shape} = {{ min = {:?}, max = {:?} }}\n",
        &min[..dimension],
        &max[..dimension]
    ))
}

fn cloud(fluid: Vec<[f64; 3]>) -> InitialState {
    InitialState {
        fluid_velocity: vec![[0.0; 3]; fluid.len()],
        fluid,
        ..InitialState::default()
    }
}

/// A point of a cloud: anywhere, on the edge of a strip or a cell, or on another point.
fn point() -> impl Strategy<Value = [f64; 3]> {
    let anywhere = prop::array::uniform3(-1.0..1.0f64);
    // The support radius is 0.3: multiples of it and of its 1.1-fold are edges.
    let edge = prop::array::uniform3(-3..=3i32).prop_map(|k| k.map(|k| 0.33 * f64::from(k)));
    let place = prop::array::uniform3(-2..=2i32).prop_map(|k| k.map(|k| 0.0375 * f64::from(k)));
    let clump = prop::array::uniform3(-0.01..0.01f64);
    prop_oneof![4 => anywhere, 1 => edge, 1 => place, 2 => clump]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn on_random_clouds(
        points in prop::collection::vec(point(), 1..150),
        dimension in 2..=3usize,
        flyer in prop::option::of(1.0..5.0f64),
        gap in 0.0..0.8f64,
    ) {
        let scene = cloud_scene(dimension);
        let mut points: Vec<_> = points
            .into_iter()
            // A gap leaves strips empty.
            .map(|x| if x[1] > 0.0 { [x[0], x[1] + gap, x[2]] } else { x })
            .map(|x| if dimension == 2 { [x[0], x[1], 0.0] } else { x })
            .collect();
        if let Some(far) = flyer {
            points.push([-far, far, 0.0]);
        }
        let cloud = cloud(points);
        prop_assert_eq!(check_scene::<Fixed>(&scene, &cloud, &[1, 2, 25]), Ok(()));
        prop_assert_eq!(check_scene::<Float>(&scene, &cloud, &[1, 12]), Ok(()));
    }
}
