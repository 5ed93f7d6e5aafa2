//! What the scratch remembers never shows: looking at a run, or forgetting, changes no bit of it.

use loschmidt_core::integrator::{INTEGRATORS, Integrator};
use loschmidt_core::model::Wall;
use loschmidt_core::number::Arithmetic;
use loschmidt_core::state::Progress;
use loschmidt_core::{Fixed, Float, Model, Serial, Standard, Symplectic};
use loschmidt_tests::small::{Recipe, Small, conservative, dam_2d, dam_3d, measure, words};

const STEPS: u64 = 30;

type Words = Vec<(u64, Vec<i64>)>;

/// Out and back, with something done between any two steps.
fn run<A: Arithmetic, M: Model<A, D>, const D: usize>(
    recipe: &Recipe<D>,
    mut between: impl FnMut(&mut Small<M, D, A>),
) -> Vec<Words> {
    let mut system = recipe.build::<A, M>();
    let mut all = Vec::new();
    for leg in 0..2 {
        for _ in 0..STEPS {
            between(&mut system);
            system.advance(1, &Serial).unwrap();
            all.push(words(&mut system));
        }
        between(&mut system);
        assert_eq!(system.parts().1.progress.step, (leg + 1) * STEPS);
        system.reverse();
    }
    all
}

/// Overwrites all of the scratch, and says so.
fn forget<A: Arithmetic, M: Model<A, D>, const D: usize>(system: &mut Small<M, D, A>) {
    use loschmidt_core::number::{Quantity, Real};
    let (_, parts) = system.parts();
    let s = parts.scratch;
    let density = A::Density::from_word(0x0123_4567_89ab);
    let pressure = A::Real::from_f64(0.1);
    s.density.fill(density);
    s.pressure.fill(pressure);
    s.impulse.fill([A::Speed::from_word(77); D]);
    s.wall_density.fill(density);
    s.wall_density_fixed.fill(density);
    s.wall_pressure.fill(pressure);
    s.cells.start.fill(3);
    s.cells.order.fill(5);
    s.wall_cells.start.fill(3);
    s.wall_cells.order.fill(5);
    parts.progress.invalidate();
}

fn check<A: Arithmetic, M: Model<A, D>, const D: usize>(recipe: &Recipe<D>) {
    let plain = run::<A, M, D>(recipe, |_| ());
    let measured = run::<A, M, D>(recipe, |system| {
        let once = measure(system);
        assert_eq!(once, measure(system));
    });
    assert!(plain == measured, "measuring changed the run");
    let mut step = 0;
    let sometimes = run::<A, M, D>(recipe, |system| {
        step += 1;
        if step % 3 == 0 {
            let _ = measure(system);
        }
    });
    assert!(plain == sometimes, "measuring now and then changed the run");
    let forgetful = run::<A, M, D>(recipe, |system| forget(system));
    assert!(plain == forgetful, "rebuilding the scratch changed the run");
    let resumed = run::<A, M, D>(recipe, |system| {
        let (_, parts) = system.parts();
        *parts.progress = Progress::at_step(parts.progress.step);
    });
    assert!(plain == resumed, "a fresh progress changed the run");
    let both = run::<A, M, D>(recipe, |system| {
        forget(system);
        let _ = measure(system);
    });
    assert!(plain == both, "measuring after rebuilding changed the run");
}

fn everywhere<const D: usize>(dam: impl Fn(Wall, &'static Integrator) -> Recipe<D>) {
    for wall in [conservative(), Wall::Dummy] {
        for integrator in INTEGRATORS {
            let recipe = dam(wall, integrator).stirred(6, 1.0);
            check::<Fixed, Symplectic<Fixed, D>, D>(&recipe);
        }
        let recipe = dam(wall, INTEGRATORS[0]).stirred(6, 0.1);
        check::<Fixed, Standard<Fixed, D>, D>(&recipe);
        check::<Float, Symplectic<Float, D>, D>(&recipe);
    }
}

#[test]
fn measuring_and_rebuilding_change_no_bit_of_a_run_in_the_plane() {
    everywhere(dam_2d);
}

#[test]
fn measuring_and_rebuilding_change_no_bit_of_a_run_in_space() {
    everywhere(dam_3d);
}

#[test]
fn diagnostics_on_the_way_back_have_the_bits_of_the_way_out() {
    for integrator in INTEGRATORS {
        for wall in [conservative(), Wall::Dummy] {
            let mut system = dam_2d(wall, integrator).stirred(6, 1.0).symplectic();
            let mut out = Vec::new();
            for _ in 0..STEPS {
                out.push(measure(&mut system));
                system.advance(1, &Serial).unwrap();
            }
            system.reverse();
            while let Some(there) = out.pop() {
                system.advance(1, &Serial).unwrap();
                let back = measure(&mut system);
                assert_eq!(back.energies, there.energies);
                assert_eq!(back.histogram, there.histogram);
                assert_eq!(back.momentum_quanta, there.momentum_quanta.map(|p| -p));
                assert_eq!(
                    back.angular_momentum_quanta,
                    there.angular_momentum_quanta.map(|l| -l)
                );
            }
        }
    }
}

#[test]
fn initialising_again_gives_the_same_constants() {
    let mut system = dam_3d(Wall::Dummy, INTEGRATORS[0]).symplectic();
    let first = system.digest();
    forget(&mut system);
    system.initialise(&Serial).unwrap();
    assert_eq!(system.digest(), first);
}
