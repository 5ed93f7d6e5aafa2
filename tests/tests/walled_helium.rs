//! Helium in a vessel: walls, a lid, a heater and a superleak.

use loschmidt_core::number::Quantity;
use loschmidt_core::schemes::superfluid::{
    COUNTERFLOW, Friction, Heater, HeliumParameters, Operators, PaperSuperfluid, Superfluid,
    Superleak, WallPart,
};
use loschmidt_core::set::Set;
use loschmidt_core::{Arithmetic, Diagnostics, FaultKind, Fixed, Float, Model, Serial};
use loschmidt_runner::scene::InitialState;
use loschmidt_tests::conformance::{self, Plain};
use loschmidt_tests::helium::{SPACING, drop, stirred, wall_in};
use loschmidt_tests::permitted;

type Word = <Fixed as Arithmetic>::Word;

const OPERATORS: [Operators; 2] = [Operators::Paper, Operators::Renormalised];

/// Stirred helium in an open vessel.
fn vessel<const D: usize>(counts: [usize; D], speed: f64, seed: u64) -> InitialState {
    let mut state = stirred(counts, speed, 0.05, seed);
    wall_in(&mut state, counts);
    state
}

fn filled<const D: usize>(operators: Operators) -> HeliumParameters<D> {
    let mut parameters = drop::<D>(operators);
    parameters.gravity[D - 1] = -9.8;
    parameters.surface = Some(1e-3);
    parameters.walls = [WallPart::default()].into_iter().collect();
    parameters
}

/// The same with all that can be around it.
fn furnished<const D: usize>(operators: Operators) -> HeliumParameters<D> {
    let mut parameters = filled::<D>(operators);
    parameters.viscosity = 1e-3;
    parameters.diffusion = 20.0;
    parameters.mutual_friction = 600.0;
    let mut lid = [0.0; D];
    lid[0] = 0.5;
    let part = |first, rough, conduction, velocity| WallPart {
        first,
        rough,
        conduction,
        velocity,
    };
    parameters.walls = [
        part(0, true, 200.0, lid),
        part(60, false, 0.0, [0.0; D]),
        part(90, true, 0.0, [0.0; D]),
    ]
    .into_iter()
    .collect();
    parameters.heater = Some(heater());
    parameters.superleak = Some(leak());
    parameters
}

fn heater<const D: usize>() -> Heater<D> {
    Heater {
        place: [0.0; D],
        power: 50.0,
        radius: 3.0 * SPACING,
    }
}

fn leak<const D: usize>() -> Superleak<D> {
    let mut half = [SPACING; D];
    half[D - 1] = 0.0;
    Superleak {
        centre: [-2.0 * SPACING; D],
        half,
        radius: 1.5 * SPACING,
        time: 1e-6,
    }
}

fn plain<M: Model<Fixed, D>, const D: usize>(model: M, state: &InitialState) -> Plain<M, D> {
    let mut plain = Plain::new(model, state);
    plain.initialise().unwrap();
    plain
}

fn steps<M: Model<Fixed, D>, const D: usize>(plain: &mut Plain<M, D>, steps: u64) {
    for _ in 0..steps {
        let (model, mut system) = plain.parts();
        model.step(&mut system, &Serial).unwrap();
    }
}

fn look<M: Model<Fixed, D>, const D: usize>(plain: &mut Plain<M, D>) -> Diagnostics {
    let (model, mut system) = plain.parts();
    Diagnostics::measure(model, &mut system, &Serial).unwrap()
}

#[test]
fn in_a_vessel_every_executor_leaves_the_bits_of_the_plain_steps() {
    for operators in OPERATORS {
        let state = vessel([12, 9], 2.0, 1);
        let model = || Superfluid::<Fixed, 2>::new(filled(operators)).unwrap();
        conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    }
    let state = vessel([5, 5, 4], 2.0, 2);
    let model = || Superfluid::<Fixed, 3>::new(filled(Operators::Renormalised)).unwrap();
    conformance::check(model, &state, &[1, 6]).unwrap_or_else(|e| panic!("{e}"));
    let state = vessel([12, 9], 2.0, 7);
    let model = || Superfluid::<Float, 2>::new(filled(Operators::Paper)).unwrap();
    conformance::check(model, &state, &[1, 6]).unwrap_or_else(|e| panic!("{e}"));
    let state = vessel([12, 9], 1.0, 3);
    let model = || PaperSuperfluid::<Fixed, 2>::new(filled(Operators::Paper)).unwrap();
    conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn with_lid_heater_and_superleak_every_executor_leaves_the_bits_of_the_plain_steps() {
    let state = vessel([12, 9], 2.0, 4);
    let model = || Friction::<Fixed, 2>::superfluid(furnished::<2>(Operators::Paper)).unwrap();
    conformance::check(model, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
    let state = vessel([5, 5, 4], 2.0, 5);
    let model =
        || Friction::<Fixed, 3>::superfluid(furnished::<3>(Operators::Renormalised)).unwrap();
    conformance::check(model, &state, &[1, 6]).unwrap_or_else(|e| panic!("{e}"));
    let state = vessel([12, 9], 2.0, 6);
    let normal = || {
        let mut parameters = furnished::<2>(Operators::Paper);
        parameters.helium.normal_fraction = 1.0;
        parameters.helium.fraction_slope = 0.0;
        parameters.suction = true;
        Friction::<Fixed, 2>::superfluid(parameters).unwrap()
    };
    conformance::check(normal, &state, &[1, 2, 12]).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn helium_in_a_vessel_returns_to_its_first_bit() {
    fn returns<const D: usize>(counts: [usize; D], there: u64) {
        for operators in OPERATORS {
            let mut parameters = filled::<D>(operators);
            parameters.suction = operators == Operators::Paper;
            let model = Superfluid::<Fixed, D>::new(parameters).unwrap();
            let mut helium = plain(model, &vessel(counts, 2.0, 7));
            let digest = |helium: &mut Plain<Superfluid<Fixed, D>, D>| {
                let (model, system) = helium.parts();
                loschmidt_core::digest::digest(&system, &model.scale())
            };
            let home = digest(&mut helium);
            steps(&mut helium, there);
            assert_ne!(digest(&mut helium), home);
            helium.parts().1.reverse();
            steps(&mut helium, there);
            helium.parts().1.reverse();
            assert_eq!(digest(&mut helium), home, "{operators:?}");
        }
    }
    returns([12, 9], 150);
    returns([5, 5, 4], 40);
}

/// The change of all energies together over that of the one that changes most, in short steps.
fn open_balance<M: Model<Fixed, D>, const D: usize>(model: M, state: &InitialState) -> f64 {
    let mut helium = plain(model, state);
    // The first step is the one in which densities leave what they are at the start.
    steps(&mut helium, 100);
    let before = look(&mut helium);
    steps(&mut helium, 20);
    let after = look(&mut helium);
    let kinds = before.energies.iter().zip(after.energies.iter());
    let changes: Vec<f64> = kinds.map(|((_, a), (_, b))| b - a).collect();
    let most = changes.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    changes.iter().sum::<f64>() / most
}

#[test]
fn walls_and_the_liquid_keep_their_energy_together() {
    fn check<const D: usize>(counts: [usize; D]) {
        for operators in OPERATORS {
            for suction in [false, true] {
                let mut parameters = filled::<D>(operators);
                parameters.time_step *= 1e-3;
                parameters.suction = suction;
                let model = Superfluid::<Fixed, D>::new(parameters).unwrap();
                let error = open_balance(model, &vessel(counts, 2.0, 8)).abs();
                println!("{operators:?}, suction {suction}: {error:e}");
                assert!(error < permitted::ENERGY_OF_SHORT_STEPS, "{error:e}");
            }
        }
    }
    check([10, 8]);
    check([5, 5, 4]);
}

#[test]
fn what_lid_heater_and_superleak_give_and_take_is_in_the_balance() {
    type Change = fn(&mut HeliumParameters<2>);
    let all: [(&str, Change); 6] = [
        ("all", |_| {}),
        ("lid", |p| {
            (p.heater, p.superleak) = (None, None);
            p.walls.iter_mut().for_each(|wall| wall.conduction = 0.0);
        }),
        ("cold wall", |p| {
            (p.heater, p.superleak) = (None, None);
            p.walls.iter_mut().for_each(|wall| wall.velocity = [0.0; 2]);
        }),
        ("heater", |p| {
            p.superleak = None;
            p.walls = [WallPart::default()].into_iter().collect();
        }),
        ("superleak", |p| {
            (p.heater, p.mutual_friction) = (None, 0.0);
            p.walls = [WallPart::default()].into_iter().collect();
        }),
        ("mutual friction", |p| {
            (p.heater, p.superleak) = (None, None);
            (p.viscosity, p.diffusion) = (0.0, 0.0);
            p.walls = [WallPart::default()].into_iter().collect();
        }),
    ];
    for (name, change) in all {
        for operators in OPERATORS {
            let mut parameters = furnished::<2>(operators);
            parameters.time_step *= 0.02;
            change(&mut parameters);
            let drives = !["superleak", "mutual friction"].contains(&name);
            let model = Friction::superfluid(parameters).unwrap();
            let state = vessel([10, 8], 2.0, 9);
            let error = open_balance(model.clone(), &state).abs();
            println!("{name}, {operators:?}: {error:e}");
            assert!(error < permitted::ENERGY_OF_FRICTION, "{name}: {error:e}");
            let mut helium = plain(model, &state);
            steps(&mut helium, 50);
            assert_eq!(look(&mut helium).energies.get("drive") != 0.0, drives);
        }
    }
}

#[test]
fn a_heater_gives_its_power() {
    let mut parameters = drop::<2>(Operators::Paper);
    parameters.heater = Some(heater());
    let (power, step) = (50.0, parameters.time_step);
    let model = Friction::superfluid(parameters).unwrap();
    let mut helium = plain(model, &stirred([10, 8], 0.0, 0.0, 10));
    let before = look(&mut helium).energies;
    steps(&mut helium, 1);
    let after = look(&mut helium).energies;
    let given = power * step;
    assert!((after.get("drive") + given).abs() < 1e-9 * given);
    let inner = |e: loschmidt_core::Energies| e.total() - e.get("drive");
    let gained = inner(after) - inner(before);
    println!("{gained:e} of {given:e}");
    assert!(
        (gained - given).abs() < 1e-6 * given,
        "{gained:e} {given:e}"
    );
}

#[test]
fn a_heater_without_liquid_ends_the_run() {
    let mut parameters = drop::<2>(Operators::Paper);
    let far = Heater {
        place: [1.0, 0.0],
        ..heater()
    };
    parameters.heater = Some(far);
    let model = Friction::superfluid(parameters).unwrap();
    let mut helium = plain(model, &stirred([6, 6], 0.0, 0.0, 11));
    let (model, mut system) = helium.parts();
    let fault = model.step(&mut system, &Serial).unwrap_err();
    assert_eq!((fault.kind, fault.step), (FaultKind::HeaterDry, 1));
}

/// A speed, given in its quanta, of the particle that is nearest to the origin, m/s.
fn in_the_middle<M: Model<Fixed, 2>>(
    helium: &mut Plain<M, 2>,
    speed: impl Fn(&Set<'_, Fixed, 2>, usize) -> f64,
) -> f64 {
    let (model, system) = helium.parts();
    let places = system.particles.position().iter();
    let distances = places.map(|x| x.map(Quantity::quanta)).enumerate();
    let distances = distances.map(|(place, [x, y])| (place, x.hypot(y)));
    let nearest = distances.min_by(|(_, a), (_, b)| a.total_cmp(b));
    let place = nearest.expect("particles").0;
    speed(&system.particles, place) * model.scale().speed_quantum()
}

#[test]
fn a_superleak_holds_the_normal_component_and_lets_the_other_pass() {
    // One plate for all of the drop, which moves as a whole and has a counterflow.
    let mut parameters = drop::<2>(Operators::Paper);
    let helium = parameters.helium;
    let step = parameters.time_step;
    let time = 40.0 * step;
    parameters.superleak = Some(Superleak {
        centre: [0.0; 2],
        half: [1.0; 2],
        radius: SPACING,
        time,
    });
    let mut state = stirred([9, 9], 0.0, 0.0, 12);
    let (v, u) = (0.01, 0.02);
    state.fluid_velocity.fill([v, 0.0, 0.0]);
    for given in &mut state.given {
        if given.name == "counterflow" {
            given.values.fill([u, 0.0, 0.0]);
        }
    }
    let mut drop = plain(Friction::superfluid(parameters).unwrap(), &state);
    steps(&mut drop, 10);
    let velocity = in_the_middle(&mut drop, |set, place| set.velocity()[place][0].quanta());
    // χ_n v_n decays by 1/e in the time of the plate, and v_s stays; sound has not come so far.
    let normal = helium.normal_fraction;
    let momentum = normal * v + (1.0 - normal) * u;
    let expected = v - momentum * (1.0 - (-10.0 * step / time).exp());
    println!("{velocity} {expected}");
    assert!(
        (velocity - expected).abs() < 1e-3 * v,
        "{velocity} {expected}"
    );
}

#[test]
fn mutual_friction_slows_the_counterflow_as_its_equation_says() {
    let mut parameters = drop::<2>(Operators::Paper);
    // So short that second sound between neighbours, of their disorder, does not count.
    parameters.time_step *= 0.1;
    let (helium, u, steps_taken) = (parameters.helium, 0.02, 10.0);
    let between = u / helium.normal_fraction;
    let rate = helium.reference_density * between * between;
    // After ten steps A ρ |v_ns|² t is 1.
    let time = steps_taken * parameters.time_step;
    parameters.mutual_friction = 1.0 / (rate * time);
    let mut state = stirred([13, 13], 0.0, 0.0, 13);
    for given in &mut state.given {
        if given.name == "counterflow" {
            given.values.fill([u, 0.0, 0.0]);
        }
    }
    let mut drop = plain(Friction::superfluid(parameters).unwrap(), &state);
    steps(&mut drop, steps_taken as u64);
    let left = in_the_middle(&mut drop, |set, place| {
        set.view().vectors::<Word, 2>(COUNTERFLOW)[place][0].quanta()
    });
    let expected = u / 3_f64.sqrt();
    println!("{left} {expected}");
    assert!((left - expected).abs() < 1e-3 * u, "{left} {expected}");
    let velocity = in_the_middle(&mut drop, |set, place| set.velocity()[place][0].quanta());
    assert!(velocity.abs() < 1e-3 * u, "{velocity}");
}

#[test]
fn liquid_that_begins_with_its_hydrostatic_pressure_stays_at_rest() {
    let counts = [20, 14];
    let level = 0.5 * 14.0 * SPACING;
    let fall = |surface: Option<f64>| {
        let mut parameters = filled::<2>(Operators::Paper);
        parameters.gravity = [0.0, -9.8];
        parameters.surface = surface;
        let mut state = loschmidt_tests::bodies::block(counts);
        let factor = SPACING / loschmidt_tests::bodies::SPACING;
        state
            .fluid
            .iter_mut()
            .for_each(|x| *x = x.map(|x| x * factor));
        wall_in(&mut state, counts);
        let mut helium = plain(Superfluid::<Fixed, 2>::new(parameters).unwrap(), &state);
        steps(&mut helium, 600);
        look(&mut helium).energies.get("kinetic")
    };
    let (rests, falls) = (fall(Some(level)), fall(None));
    println!("{rests:e} J, {falls:e} J");
    assert!(rests < 0.02 * falls, "{rests:e} {falls:e}");
}
