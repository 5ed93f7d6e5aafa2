//! Runs whose numbers end: typed, with particle and step, and with the last good state.

use loschmidt_core::{Fault, FaultKind};
use loschmidt_runner::output::{RunDirectory, RunStatus, Snapshot};
use loschmidt_runner::ranged_fault::RangedFault;
use loschmidt_runner::scene::Scene;
use loschmidt_runner::{Options, Run, RunError};
use loschmidt_tests::program::{
    every_way, fastest, player, run, scene, scene_of, serial, threads, try_run,
};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

/// Sixteen particles on their way out of the range of positions, 4 m here.
fn thrown() -> Scene {
    scene_of(
        r#"
        particle_spacing = 0.1
        turnaround = 1.0
        domain = 4.0
        fluid.sound_speed = 40
        [[region]]
        kind = "fluid"
        shape.rectangle = { min = [0, 0], max = [0.4, 0.4] }
        velocity.uniform = [10, 1]
        "#,
    )
}

/// The standard scheme, which ends by itself.
fn standard(turnaround: &str) -> Scene {
    let set = ["particle_spacing=0.2", "model=standard", "cfl=0.4"];
    let turnaround = format!("turnaround={turnaround}");
    let mut set = set.to_vec();
    set.push(&turnaround);
    scene("dam-break", &set)
}

fn fault_of(result: Result<loschmidt_runner::Outcome, RunError>) -> (Fault, f64, Option<PathBuf>) {
    match result {
        Err(RunError::Fault {
            fault,
            time,
            snapshot,
        }) => (fault.fault, time, snapshot),
        other => panic!("no fault: {other:?}"),
    }
}

/// Lets a scene run into its fault in a directory; what it leaves must be the state one step
/// before.
fn assert_leaves_the_state_one_step_before(scene: &Scene, options: Options, out: &Path) -> Fault {
    let mut run = Run::start(scene.clone(), options, Some((out, false))).expect("a start");
    let plan = *run.plan();
    let (fault, time, snapshot) = fault_of(run.execute(|_| {}, &AtomicBool::new(false)));
    assert_eq!(time, fault.step as f64 * scene.time_step());

    let path = snapshot.expect("a snapshot");
    assert_eq!(path, RunDirectory::snapshot_path(out, "latest"));
    let snapshot = Snapshot::read(&path).expect("a snapshot");
    assert_eq!(snapshot.state.step, fault.step - 1);
    let mut there = player(scene.clone(), serial());
    there
        .advance(plan.out.min(fault.step - 1))
        .expect("in range");
    if fault.step - 1 > plan.out {
        there.turn();
        there.advance(fault.step - 1 - plan.out).expect("in range");
    }
    assert_eq!(snapshot.state, there.save());
    assert_eq!(snapshot.position, there.position());
    assert_eq!(snapshot.arrow, there.arrow());
    // And the next step is the one that cannot be taken, whoever tries.
    assert_eq!(there.advance(1), Err(fault));

    let manifest = RunDirectory::read_manifest(out).expect("a manifest");
    assert_eq!(manifest.status, RunStatus::Failed);
    let ending = RangedFault::of(&there, fault);
    assert_eq!(manifest.failure, Some(ending.to_string()));
    assert_eq!(manifest.steps, fault.step - 1);
    assert_eq!(manifest.digest.last, snapshot.digest().to_string());
    let resumed = Run::resume(out, |_| options).err().expect("refused");
    assert!(matches!(resumed, RunError::Ended { failed: true, .. }));
    fault
}

#[test]
fn the_last_good_state_is_the_one_before_the_step_that_failed() {
    let place = TempDir::new().expect("a directory");
    let out = |name: &str| place.path().join(name);
    let position = assert_leaves_the_state_one_step_before(&thrown(), threads(2), &out("position"));
    assert_eq!(position.kind, FaultKind::PositionRange);
    // On the way out and on the way back.
    let first = assert_leaves_the_state_one_step_before(&standard("2.0"), threads(2), &out("out"));
    let turn = standard("1.2");
    let second = assert_leaves_the_state_one_step_before(&turn, serial(), &out("back"));
    println!("{position}\n{first}\n{second}");
    assert!(first.step > 600);
    assert!(second.step > 600, "after the turnaround");
}

#[test]
fn a_fault_leaves_the_same_state_for_any_cadence_of_output() {
    let place = TempDir::new().expect("a directory");
    let dam = ["particle_spacing=0.1", "output.snapshots=2"];
    // Terms, velocities and positions that end: in the closing kick, which is joined with the
    // opening one of the next step, and in the drift.
    let scenes = [
        ("dam-break", dam, "cfl=0.9"),
        ("dam-break", dam, "cfl=2"),
        ("dam-break", dam, "wall.energy=1e6"),
        (
            "colliding-drops",
            ["particle_spacing=0.2", dam[1]],
            "cfl=1.5",
        ),
    ];
    let mut kinds = Vec::new();
    for (n, (name, set, fault)) in scenes.into_iter().enumerate() {
        let mut found = Vec::new();
        for (k, options) in [serial(), fastest(2)].into_iter().enumerate() {
            for rows in ["2", "7", "1000"] {
                let rows = format!("output.rows={rows}");
                let scene = scene(name, &[set[0], set[1], fault, &rows]);
                let out = place.path().join(format!("{n}-{k}-{}", found.len()));
                let mut run = Run::start(scene, options, Some((&out, false))).expect("a start");
                let (fault, _, path) = fault_of(run.execute(|_| {}, &AtomicBool::new(false)));
                let left = Snapshot::read(&path.expect("a snapshot")).expect("a snapshot");
                let manifest = RunDirectory::read_manifest(&out).expect("a manifest");
                assert_eq!(manifest.status, RunStatus::Failed);
                found.push((fault, left.state, manifest.steps, manifest.digest.last));
            }
        }
        assert!(found.iter().all(|one| *one == found[0]), "{name}, {fault}");
        kinds.push(found[0].0.kind);
    }
    use FaultKind::{PositionRange, TermRange, VelocityRange};
    assert_eq!(
        kinds,
        [TermRange, VelocityRange, VelocityRange, PositionRange]
    );
}

#[test]
fn every_executor_finds_the_same_fault() {
    for scene in [thrown(), standard("2.0")] {
        let faults: Vec<Fault> = every_way()
            .into_iter()
            .map(|options| fault_of(try_run(scene.clone(), options).0).0)
            .collect();
        assert!(faults.iter().all(|fault| *fault == faults[0]), "{faults:?}");
    }
}

#[test]
fn how_often_a_run_records_does_not_move_its_fault() {
    let faults: Vec<Fault> = ["2", "37", "100000"]
        .into_iter()
        .map(|rows| {
            let mut scene = standard("2.0");
            scene.output.rows = rows.parse().expect("a number");
            fault_of(try_run(scene, serial()).0).0
        })
        .collect();
    assert!(faults.iter().all(|fault| *fault == faults[0]), "{faults:?}");
}

#[test]
fn the_standard_scheme_breaks_down_where_the_symplectic_one_goes_on() {
    let set = [
        "particle_spacing=0.02",
        "turnaround=",
        "end=1.0",
        "model=standard",
    ];
    let (result, rows) = try_run(scene("dam-break", &set), fastest(2));
    let (fault, time, _) = fault_of(result);
    let last = rows.last().expect("rows");
    println!(
        "spacing 0.02 m: {fault}, t = {time} s; total energy of the last row {} J, at the start {} J",
        last.total, rows[0].total
    );
    assert!(time < 1.0);
    // The symplectic scheme at this spacing goes to 1 s and back in run_dam_break.rs; here at
    // twice.
    let set = [
        "particle_spacing=0.04",
        "turnaround=",
        "end=1.0",
        "model=standard",
    ];
    let (fault, time, _) = fault_of(try_run(scene("dam-break", &set), fastest(2)).0);
    println!("spacing 0.04 m: {fault}, t = {time} s");
    assert!(time < 1.0);
    let (outcome, _) = run(scene("dam-break", &set[..3]), fastest(2));
    assert_eq!(outcome.steps, 5_000);
}
