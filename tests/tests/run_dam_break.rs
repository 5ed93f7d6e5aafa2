//! The dam break of Kincl & Pavelka (2023), out and back, as a whole.

use loschmidt_runner::run::Row;
use loschmidt_runner::{Options, Outcome};
use loschmidt_tests::program::{
    assert_same_way_back, every_way, fastest, float, run, scene, serial, shuffled, threads,
};

/// Digest of the first state at spacing 0.02 m: 5000 particles of water, 1508 of walls.
const HOME: &str = "b613df923636cef25005d7e559dd5ab2";
/// Digest after 10,000 steps, t = 1 s.
const TURNAROUND: &str = "44573a75641b1588be7ef6951204b24b";

fn out_and_back(options: Options) -> (Outcome, Vec<Row>) {
    let (outcome, rows) = run(scene("dam-break", &["particle_spacing=0.02"]), options);
    assert_eq!(outcome.steps, 20_000);
    assert_eq!(outcome.particles, 5_000);
    assert_eq!(outcome.digest.initial, HOME);
    assert_eq!(outcome.digest.turnaround.as_deref(), Some(TURNAROUND));
    assert_eq!(outcome.digest.last, HOME);
    assert_eq!(outcome.reversed_exactly, Some(true));
    assert_eq!(outcome.max_return_error_m, Some(0.0));
    assert_same_way_back(&rows);
    (outcome, rows)
}

#[test]
fn on_two_threads_it_returns_to_the_first_bit_and_is_the_flow_of_the_paper() {
    let (outcome, rows) = out_and_back(fastest(2));

    assert!(rows.len() >= 1_000);
    let entropy = outcome.entropy.turnaround.expect("a turnaround");
    let equilibrium = outcome.entropy.equilibrium_turnaround.expect("motion");
    println!("entropy {entropy}, in equilibrium {equilibrium}");
    assert!(entropy > 2.5);
    assert!((entropy - equilibrium).abs() < 0.15);
    assert_eq!(outcome.entropy.initial, outcome.entropy.last);

    let at_700_ms = rows
        .iter()
        .find(|row| row.position == 7_000)
        .expect("a row");
    println!("edge at {} s: {} m", at_700_ms.time_s, at_700_ms.front_m);
    assert!(at_700_ms.front_m > 3.8);

    let error = outcome.energy.max_error_over_released.expect("a fall");
    println!("energy error over released {error:e}");
    assert!(error <= 1.5e-3);
}

#[test]
fn the_reference_executor_with_shuffled_storage_finds_the_same_digests() {
    // The flow of the paper, coarser.
    let found = |options| run(scene("dam-break", &["particle_spacing=0.05"]), options);
    let (reference, rows) = found(shuffled(serial(), 1));
    let (outcome, other_rows) = found(fastest(2));
    assert_eq!(reference.reversed_exactly, Some(true));
    assert_same_way_back(&rows);
    assert_eq!(reference.digest, outcome.digest);
    assert_eq!(rows, other_rows);
}

/// The digests of home and turnaround, which must be the same for every way to walk the particles,
/// as must all rows.
fn digests_in_every_way(name: &str, set: &[&str]) -> [String; 2] {
    let (digests, _) = every_way()
        .into_iter()
        .map(|options| {
            let (outcome, rows) = run(scene(name, set), options);
            assert_eq!(outcome.reversed_exactly, Some(true), "{options:?}");
            assert_eq!(outcome.digest.initial, outcome.digest.last, "{options:?}");
            assert_same_way_back(&rows);
            let turnaround = outcome.digest.turnaround.expect("a turnaround");
            ([outcome.digest.initial, turnaround], rows)
        })
        .reduce(|first, other| {
            assert_eq!(first, other);
            first
        })
        .expect("a way");
    digests
}

#[test]
fn threads_executor_and_order_of_storage_change_no_bit_in_the_plane() {
    let set = ["particle_spacing=0.04", "turnaround=0.1"];
    let [home, turnaround] = digests_in_every_way("dam-break", &set);
    assert_eq!(home, "de48b6aed699b339d1ec559cb72a4f06");
    assert_eq!(turnaround, "aef6b00048304eac6bdc73a8eed9ac1f");
}

#[test]
fn threads_executor_and_order_of_storage_change_no_bit_with_dummy_walls() {
    let set = [
        "particle_spacing=0.05",
        "turnaround=0.1",
        "wall_model=dummy",
    ];
    let [home, turnaround] = digests_in_every_way("dam-break", &set);
    assert_eq!(home, "e38240ae9efd2f23cff2722ec17d3d84");
    assert_eq!(turnaround, "9c65f409b244d6298f8a38dda3cc0252");
}

#[test]
fn threads_executor_and_order_of_storage_change_no_bit_in_space() {
    let set = ["particle_spacing=0.1", "turnaround=0.1"];
    let [home, turnaround] = digests_in_every_way("dam-break-3d", &set);
    assert_eq!(home, "28bdffe58927bf980acfa98aa2d7e8f5");
    assert_eq!(turnaround, "85232b357fc315855ec459fc28628035");
}

#[test]
fn every_integrator_returns_exactly_in_plane_and_space() {
    for integrator in ["stormer-verlet", "pefrl", "suzuki"] {
        let integrator = format!("integrator={integrator}");
        for (name, spacing) in [("dam-break", "0.1"), ("dam-break-3d", "0.125")] {
            let spacing = format!("particle_spacing={spacing}");
            let set = [integrator.as_str(), spacing.as_str(), "turnaround=0.3"];
            let (outcome, rows) = run(scene(name, &set), fastest(2));
            assert_eq!(outcome.reversed_exactly, Some(true), "{name} {set:?}");
            assert_same_way_back(&rows);
        }
    }
}

#[test]
fn floating_point_does_not_come_back() {
    let (outcome, _) = run(
        scene("dam-break", &["particle_spacing=0.04"]),
        float(threads(2)),
    );
    assert_eq!(outcome.reversed_exactly, Some(false));
    let error = outcome.max_return_error_m.expect("a way back");
    println!("return error {error} m");
    assert!(error > 0.02);
}
