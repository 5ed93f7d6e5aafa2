//! Runs of the scenes of superfluid helium.

use loschmidt_runner::Player;
use loschmidt_runner::run::Row;
use loschmidt_runner::scene::Scene;
use loschmidt_tests::permitted;
use loschmidt_tests::program::{
    assert_same_way_back, every_way, fastest, player, run, scene, serial,
};
use std::f64::consts::PI;

/// Golden values, each with a line in the changelog when it changes. Small editions of the scenes:
/// name, what is set, steps, digests at home and after them.
const GOLDEN: [(&str, &[&str], u64, [&str; 2]); 7] = [
    (
        "second-sound",
        &["particle_spacing=0.0005"],
        100,
        [
            "64569bcf3fcee3bb9ad455dcdeee4635",
            "ef2e2bf88cef720b186ac95419e16d5f",
        ],
    ),
    (
        "second-sound-steep",
        &["particle_spacing=0.0005"],
        200,
        [
            "be07a74251d17427a32a5e1060aee8d0",
            "7c78a76ee96907134f7b7fff4ba6bc26",
        ],
    ),
    (
        "counterflow",
        &["particle_spacing=0.0005"],
        200,
        [
            "bc39bc0707d00444fe9af2897a233032",
            "eb9c691da24563a852dc22e4a7747f77",
        ],
    ),
    (
        "second-sound",
        &["particle_spacing=0.0005", "model=superfluid-paper"],
        100,
        [
            "45ff67077708f498773821a66225d7f7",
            "60811c0a27f682ef3e16d2f8564938e8",
        ],
    ),
    (
        "second-sound",
        &[
            "particle_spacing=0.0005",
            "model=superfluid-dissipative",
            "turnaround=",
            "end=1e-3",
            "superfluid.viscosity=1e-3",
            "superfluid.diffusion=50",
        ],
        100,
        [
            "64569bcf3fcee3bb9ad455dcdeee4635",
            "5cab135d76294804f7dfae00478b54c5",
        ],
    ),
    (
        "fountain",
        &["particle_spacing=0.0004"],
        60,
        [
            "aec41ba6bed7b11fbf230f280ae0da4b",
            "f397c91c7c44c5a641950e21481e660f",
        ],
    ),
    (
        "normal-cavity",
        &["particle_spacing=0.1"],
        100,
        [
            "b58217df86be6480b650dd3affb661c5",
            "80d1557617e1517eba43a8ff9c70aa2f",
        ],
    ),
];

/// What gives the scene of second sound friction.
const FRICTION: [&str; 4] = [
    "model=superfluid-dissipative",
    "turnaround=",
    "superfluid.viscosity=1e-3",
    "superfluid.diffusion=50",
];

fn golden(n: usize) -> (Scene, u64, [&'static str; 2]) {
    let (name, set, steps, digests) = GOLDEN[n];
    (scene(name, set), steps, digests)
}

/// Every executor, instruction set, number of threads and order of storage: the same digests, and
/// back to the first bit where there is a way back.
fn check(n: usize, returns: bool) {
    let (scene, steps, digests) = golden(n);
    for options in every_way() {
        let mut player = player(scene.clone(), options);
        let home = player.digest();
        player.advance(steps).unwrap();
        let found = [home.to_string(), player.digest().to_string()];
        assert_eq!(found, digests, "{}, {options:?}", scene.name);
        player.turn();
        player.advance(steps).unwrap();
        player.turn();
        assert_eq!(
            player.digest() == home,
            returns,
            "{}, {options:?}",
            scene.name
        );
    }
}

#[test]
fn golden_digests_of_second_sound_on_every_executor() {
    check(0, true);
}

#[test]
fn golden_digests_of_steep_second_sound_on_every_executor() {
    check(1, true);
}

#[test]
fn golden_digests_of_counterflow_on_every_executor() {
    check(2, true);
}

#[test]
fn golden_digests_of_helium_with_friction_on_every_executor() {
    check(4, false);
}

#[test]
fn golden_digests_of_the_fountain_on_every_executor() {
    check(5, false);
}

#[test]
fn golden_digests_of_the_normal_cavity_on_every_executor() {
    check(6, false);
}

#[test]
fn golden_digests_of_the_papers_integrator_on_every_executor() {
    check(3, false);
}

/// The amplitude of the standing wave in the entropies, of that at the start.
fn amplitude(player: &mut Player, length: f64) -> f64 {
    let frame = player.frame().unwrap();
    let column = frame.columns.iter().find(|c| c.measure.name == "entropy");
    let entropies = &column.expect("entropies").values;
    let wave = |x: &[f64; 3]| (PI * x[0] / length).sin() * (PI * x[1] / length).sin();
    let waves = frame.position.iter().map(wave);
    let [product, square] = waves.zip(entropies).fold([0.0; 2], |[a, b], (wave, s)| {
        [a + wave * (s - 725.5), b + wave * wave]
    });
    product / square / (0.01 * 725.5)
}

/// When the amplitude first passes through zero, over a quarter of L sqrt(2)/u_2: the speed of
/// second sound over that of the theory is its inverse.
fn slowness(set: &[&str]) -> f64 {
    let mut player = player(scene("second-sound", set), fastest(2));
    let quarter = 0.25 * 2f64.sqrt() * 0.01 / 18.83;
    let (mut before, mut time) = (1.0, 0.0);
    loop {
        player.advance(10).unwrap();
        let now = amplitude(&mut player, 0.01);
        if now < 0.0 {
            let step = player.time() - time;
            return (time + step * before / (before - now)) / quarter;
        }
        (before, time) = (now, player.time());
    }
}

/// At N = 25 the paper's operators have 0.871 of the speed, the renormalised ones 0.970: what a
/// program by somebody else found for the same equations.
#[test]
fn renormalised_operators_carry_second_sound_faster() {
    let coarse = "particle_spacing=0.0004";
    let ours = slowness(&[coarse]);
    let paper = slowness(&[coarse, "superfluid.operators=paper"]);
    println!("speeds {} {}", 1.0 / ours, 1.0 / paper);
    assert!(
        (1.0 / ours - 0.970).abs() < permitted::SECOND_SOUND,
        "{ours}"
    );
    assert!(
        (1.0 / paper - 0.871).abs() < permitted::SECOND_SOUND,
        "{paper}"
    );
}

fn waves(rows: &[Row]) -> f64 {
    rows[0].total
}

#[test]
fn energy_is_kept_ten_thousand_times_better_than_by_the_papers_integrator() {
    let set = |model: &'static str| {
        let model = if model == "superfluid" {
            "model=superfluid"
        } else {
            "model=superfluid-paper"
        };
        [
            "particle_spacing=0.0004",
            "superfluid.operators=paper",
            model,
        ]
    };
    let (ours, rows) = run(scene("second-sound", &set("superfluid")), fastest(2));
    assert_eq!(ours.reversed_exactly, Some(true));
    assert!(ours.momentum.exactly_constant);
    assert_same_way_back(&rows);
    let error = ours.energy.max_error / waves(&rows);
    let (paper, rows) = run(scene("second-sound", &set("paper")), fastest(2));
    assert_eq!(paper.reversed_exactly, Some(false));
    let of_paper = paper.energy.max_error / waves(&rows);
    println!("energy errors {error:e} {of_paper:e}");
    assert!(error < permitted::ENERGY_OF_SECOND_SOUND, "{error:e}");
    assert!(of_paper > 1e3 * error, "{of_paper:e} {error:e}");
    let entropy = &ours.totals["thermodynamic_entropy_J_per_K"];
    assert_eq!(entropy.initial, entropy.last);
    assert_eq!(entropy.initial, entropy.largest);
    let separation = &ours.totals["separation_of_counterflow_m_per_s"];
    assert!(separation.largest > 0.0 && separation.last == 0.0);
}

/// What the wave loses, the heat has; entropy never falls, and the copies stay together.
#[test]
fn friction_turns_second_sound_into_heat() {
    let mut set = vec!["particle_spacing=0.0004", "end=1.5e-3"];
    set.extend(FRICTION);
    let (outcome, rows) = run(scene("second-sound", &set), fastest(2));
    assert_eq!(outcome.reversed_exactly, None);
    assert!(outcome.momentum.exactly_constant);
    let last = rows.last().unwrap();
    assert!(rows[0].energy("heat").abs() < 1e-9 * waves(&rows));
    let heat = last.energy("heat");
    println!(
        "heat {heat:e} of {:e}, error {:e}",
        waves(&rows),
        outcome.energy.max_error
    );
    assert!(heat > 0.03 * waves(&rows));
    assert!(outcome.energy.max_error < permitted::ENERGY_OF_FRICTION * heat);
    let entropy = |row: &Row| row.total_of("thermodynamic_entropy_J_per_K").unwrap();
    assert!(
        rows.windows(2)
            .all(|pair| entropy(&pair[1]) >= entropy(&pair[0]))
    );
    let separation = &outcome.totals["separation_of_counterflow_m_per_s"];
    assert!(separation.largest < 1e-9, "{}", separation.largest);
}

/// A saved state goes on with another executor as if nothing had happened: that of the paper's
/// integrator too, whose first half kick takes what the last step has kept.
#[test]
fn saved_helium_goes_on() {
    for n in [1, 3, 4, 5, 6] {
        let (scene, steps, digests) = golden(n);
        let mut first = player(scene.clone(), serial());
        first.advance(steps / 2).unwrap();
        let saved = first.save();
        let mut second = player(scene, fastest(2));
        let (position, arrow) = (first.position(), first.arrow());
        second.restore(&saved, position, arrow).unwrap();
        second.advance(steps - steps / 2).unwrap();
        assert_eq!(second.digest().to_string(), digests[1]);
    }
}
