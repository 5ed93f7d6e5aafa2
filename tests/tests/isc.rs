//! The initial state correction: every first density is the reference density, without constants.

use loschmidt_core::kernel::WendlandC2;
use loschmidt_runner::isc::{Convergence, CorrectionSettings, correct};
use loschmidt_runner::scene::{DensityCorrection, InitialState, Scene};
use loschmidt_runner::{Options, Player};
use loschmidt_tests::permitted;
use loschmidt_tests::program::{
    assert_same_way_back, fastest, run, scene, scene_of, serial, shuffled, threads,
};

const SPACING: f64 = 0.02;

fn settings<const D: usize>() -> CorrectionSettings {
    let mass = 1000.0 * SPACING.powi(D as i32);
    CorrectionSettings::new(SPACING, 3.0 * SPACING, mass, 1000.0)
}

fn square(side: usize) -> Vec<[f64; 2]> {
    let at = |i: usize| (i as f64 + 0.5) * SPACING;
    (0..side * side)
        .map(|n| [at(n % side), at(n / side)])
        .collect()
}

fn corrected(side: usize) -> (Vec<[f64; 2]>, Convergence) {
    let mut fluid = square(side);
    let report = correct(&mut fluid, &settings::<2>(), |_, _| {}).expect("it converges");
    (fluid, report)
}

/// Largest |ρ - ρ0|/ρ0, every particle with every other.
fn error<const D: usize>(fluid: &[[f64; D]]) -> f64 {
    let settings = settings::<D>();
    let kernel = WendlandC2::new(D, settings.support_radius, 1.0);
    let density = |a: &[f64; D]| -> f64 {
        let weight = |b: &[f64; D]| {
            let r2: f64 = (0..D).map(|d| (a[d] - b[d]).powi(2)).sum();
            settings.mass * kernel.value(r2.sqrt())
        };
        fluid.iter().map(weight).sum()
    };
    let off = |a| (density(a) / settings.reference_density - 1.0).abs();
    fluid.iter().map(off).fold(0.0, f64::max)
}

#[test]
fn on_the_square_it_takes_seven_to_nine_steps_to_ten_digits() {
    assert!(error(&square(50)) > 0.4, "nothing was to be corrected");
    let (fluid, report) = corrected(50);
    println!("{report:?}");
    assert!((7..=9).contains(&report.steps.len()));
    assert!(report.error <= 1e-10);
    assert!(error(&fluid) <= 1e-10 + permitted::DENSITY_SUM);
    assert!(report.displacement < 1.5 * SPACING);
}

#[test]
fn it_converges_quadratically() {
    let (_, report) = corrected(40);
    let errors: Vec<f64> = report.steps.iter().map(|step| step.rms_error).collect();
    let last = &errors[errors.len() - 3..];
    // The factor depends on the state; what matters is that digits double.
    for pair in last.windows(2) {
        let order = pair[1].ln() / pair[0].ln();
        assert!(order > permitted::NEWTON_ORDER, "{errors:?}");
    }
}

#[test]
fn no_number_of_threads_changes_a_bit_of_it() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        pool.install(|| corrected(40))
    };
    let (fluid, report) = with(1);
    for threads in [2, 3, 8] {
        assert_eq!(with(threads), (fluid.clone(), report.clone()), "{threads}");
    }
}

/// The same bits on every machine, and another seed gives others.
#[test]
fn its_bits_are_those_written_here() {
    let digest = |settings: &CorrectionSettings| {
        let mut fluid = square(20);
        correct(&mut fluid, settings, |_, _| {}).expect("it converges");
        let words = fluid.iter().flatten().map(|x| x.to_bits());
        words.fold(0u64, |hash, word| {
            (hash.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        })
    };
    assert_eq!(digest(&settings::<2>()), 16_518_165_426_695_587_424);
    let other = CorrectionSettings {
        seed: 1,
        ..settings::<2>()
    };
    assert_ne!(digest(&other), digest(&settings::<2>()));
}

#[test]
fn what_cannot_be_corrected_is_an_error() {
    let mut four = square(2);
    let error = correct(&mut four, &settings::<2>(), |_, _| {}).expect_err("too few");
    assert!(error.error > 1e-3, "{error}");
    assert!(error.to_string().contains("did not converge"));
}

/// Regions of every kind, in plane and space, on every lattice.
const REGIONS: [&str; 6] = [
    "lattice = \"square\"\nshape.circle = { centre = [0, 0], radius = 0.5 }",
    "lattice = \"hexagonal\"\nshape.ellipse = { centre = [0, 0], axes = [0.6, 0.4] }",
    "lattice = \"hexagonal\"\nshape.rectangle = { min = [0, 0], max = [1, 0.6] }",
    "lattice = \"square\"\nshape.annulus = { centre = [0, 0], inner = 0.2, outer = 0.5 }",
    "lattice = \"square\"\nshape.polygon = { points = [[0, 0], [1, 0.2], [0.3, 1]] }",
    "shape.difference = [{ rectangle = { min = [0, 0], max = [1, 1] } }, { circle = { centre = [0.5, 1], radius = 0.3 } }]",
];

fn corrected_scene(dimension: usize, spacing: f64, wall_model: &str, regions: &str) -> Scene {
    scene_of(&format!(
        "particle_spacing = {spacing:?}\nturnaround = 0.05\ndimension = {dimension}\ndensity_correction = \"isc\"\nwall_model = \"{wall_model}\"\nfluid.sound_speed = 20.0\n{regions}"
    ))
}

/// Largest |ρ - ρ0|/ρ0 of the simulation at its start.
fn first_error(scene: &Scene, options: Options) -> f64 {
    let initial = scene
        .initial_state()
        .unwrap_or_else(|error| panic!("{error}"));
    let mut player = Player::new(scene.clone(), initial, options).expect("a simulation");
    let rho0 = scene.reference_density();
    let frame = player.frame().expect("densities");
    let density = frame.column("density").expect("a column");
    let off = density.iter().map(|rho| (rho / rho0 - 1.0).abs());
    off.fold(0.0, f64::max)
}

#[test]
fn on_every_region_and_lattice_the_simulation_starts_at_the_reference_density() {
    for region in REGIONS {
        let text = format!("[[region]]\nkind = \"fluid\"\n{region}");
        let scene = corrected_scene(2, 0.04, "none", &text);
        let error = first_error(&scene, serial());
        assert!(error < permitted::CORRECTED_DENSITY, "{region}: {error:e}");
    }
    let cube = "[[region]]\nkind = \"fluid\"\nshape.box = { min = [0, 0, 0], max = [0.8, 0.6, 1] }";
    let error = first_error(&corrected_scene(3, 0.1, "none", cube), serial());
    assert!(error < permitted::CORRECTED_DENSITY, "{error:e}");
}

/// Dummies belong to the density and are moved with the fluid: a box whose particles do not fit it
/// exactly could not be corrected otherwise.
#[test]
fn dummy_walls_are_corrected_with_the_fluid() {
    for lattice in ["square", "hexagonal", "vogel"] {
        let text = format!(
            "[[region]]\nkind = \"fluid\"\nlattice = \"{lattice}\"\nshape.rectangle = {{ min = [0, 0], max = [1, 0.6] }}\n[[region]]\nkind = \"wall\"\nshape.layer = {{ around.rectangle = {{ min = [0, 0], max = [1, 0.6] }}, depth = 2.5 }}"
        );
        let corrected = corrected_scene(2, 0.04, "dummy", &text);
        let mut plain = corrected.clone();
        plain.water.density_correction = DensityCorrection::None;
        let initial = |scene: &Scene| -> InitialState { scene.initial_state().expect("a state") };
        let (corrected_state, plain_state) = (initial(&corrected), initial(&plain));
        assert_eq!(corrected_state.wall.len(), plain_state.wall.len());
        assert_ne!(corrected_state.wall, plain_state.wall);
        let error = first_error(&corrected, serial());
        assert!(error < permitted::CORRECTED_DENSITY, "{lattice}: {error:e}");
    }
}

/// A velocity field holds where the particles are, not where their lattice was.
#[test]
fn particles_start_with_the_velocity_of_where_they_were_moved_to() {
    let text = "[[region]]\nkind = \"fluid\"\nshape.circle = { centre = [0, 0], radius = 0.3 }\nvelocity.rotation = 2.0";
    let state = corrected_scene(2, 0.04, "none", text)
        .initial_state()
        .expect("a state");
    for (x, v) in state.fluid.iter().zip(&state.fluid_velocity) {
        assert_eq!(*v, [-2.0 * x[1], 2.0 * x[0], 0.0]);
    }
}

#[test]
fn the_corrected_dam_break_has_no_constants_and_returns_exactly() {
    let set = [
        "particle_spacing=0.05",
        "turnaround=0.1",
        "density_correction=isc",
    ];
    let mut first = None;
    for options in [
        serial(),
        shuffled(threads(2), 1),
        fastest(3),
        Options::default(),
    ] {
        let (outcome, rows) = run(scene("dam-break", &set), options);
        assert_eq!(outcome.reversed_exactly, Some(true), "{options:?}");
        assert_same_way_back(&rows);
        let digests = *first.get_or_insert_with(|| outcome.digest.clone()) == outcome.digest;
        assert!(digests, "{options:?}");
    }
    let scene = scene("dam-break", &set);
    let initial = scene.initial_state().expect("a state");
    let mut player = Player::new(scene, initial, fastest(2)).expect("a simulation");
    assert!(player.save().fields[2].words.iter().all(|&c| c == 0));
}
