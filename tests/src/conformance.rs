//! The conformance suite: whoever walks the particles leaves the bits of the core's plain step.
//!
//! The reference is [`Model::step`] with [`Serial`] on plain vectors ([`Plain`]), which prepares
//! and applies every stage by itself. Held to it, as simulations of the runner, are its serial
//! executor, the plain parallel one, and the fast one with every instruction set of this machine on
//! 1, 2 and 5 threads: the same digests and diagnostics, and where the numbers end the same fault.
//!
//! A model of its own needs three lines in a test:
//!
//! ```text
//! let initial = conformance::disordered(&scene, 1);
//! conformance::check(|| MyModel::new(…).unwrap(), &initial, &[1, 2, 12])
//!     .unwrap_or_else(|difference| panic!("{difference}"));
//! ```

use crate::generator::Generator;
use crate::program::{backends, fast, serial, threads};
use crate::small::Scheme;
use loschmidt_core::fields::{Side, words_each};
use loschmidt_core::neighbours::{Cells, Grid};
use loschmidt_core::number::Quantity;
use loschmidt_core::owned::to_quanta;
use loschmidt_core::set::Set;
use loschmidt_core::{
    Arithmetic, Clock, Diagnostics, Digest, Fault, Filtered, Fixed, Model, Reversibility, Serial,
    Standard, Symplectic, System,
};
use loschmidt_runner::scene::{self, Dimension, InitialState, Scene};
use loschmidt_runner::{BuildError, Options, Simulation, setup, simulate};

/// A model on vectors, stepped by the core alone.
#[derive(Debug)]
pub struct Plain<M, const D: usize, A: Arithmetic = Fixed> {
    model: M,
    id: [Vec<u64>; 2],
    memory: [Vec<A::Word>; 2],
    start: [Vec<u32>; 2],
    order: [Vec<u32>; 2],
    clock: Clock,
}

impl<A: Arithmetic, M: Model<A, D>, const D: usize> Plain<M, D, A> {
    /// With these particles and walls; not yet initialised.
    ///
    /// # Panics
    /// If one of them is out of range.
    #[must_use]
    pub fn new(model: M, initial: &InitialState) -> Self {
        let counts = [initial.fluid.len(), initial.wall.len()];
        let buckets = model.grids().map(Grid::buckets);
        let words = |side, count| vec![A::Word::ZERO; count * words_each(M::FIELDS, side, D)];
        let mut plain = Self {
            model,
            id: [(0..counts[0] as u64).collect(), vec![0; counts[1]]],
            memory: [
                words(Side::Particles, counts[0]),
                words(Side::Walls, counts[1]),
            ],
            start: buckets.map(|buckets| vec![0; buckets + 1]),
            order: counts.map(|count| vec![0; count]),
            clock: Clock::default(),
        };
        let scale = plain.model.scale();
        let quanta = |x: [f64; 3]| std::array::from_fn::<f64, D, _>(|d| x[d]);
        let length = |x: &[f64; 3]| {
            to_quanta::<A::Length, D>(quanta(*x), scale.length_quantum()).expect("in range")
        };
        let speed = |v: &[f64; 3]| {
            to_quanta::<A::Speed, D>(quanta(*v), scale.speed_quantum()).expect("in range")
        };
        let (_, mut system) = plain.parts();
        let positions = system.particles.position_mut().iter_mut();
        positions
            .zip(&initial.fluid)
            .for_each(|(x, si)| *x = length(si));
        let velocities = system.particles.velocity_mut().iter_mut();
        let si = &initial.fluid_velocity;
        velocities.zip(si).for_each(|(v, si)| *v = speed(si));
        let given = initial.put_given(&mut system.particles, &scale);
        given.expect("in range");
        let given = initial.put_given(&mut system.walls, &scale);
        given.expect("in range");
        let walls = system.walls.position_mut().iter_mut();
        walls.zip(&initial.wall).for_each(|(x, si)| *x = length(si));
        plain
    }

    /// Model and system.
    ///
    /// # Panics
    /// Never: the memory was made for the fields.
    pub fn parts(&mut self) -> (&M, System<'_, A, D>) {
        let [id, wall_id] = &mut self.id;
        let [memory, wall_memory] = &mut self.memory;
        let [start, wall_start] = &mut self.start;
        let [order, wall_order] = &mut self.order;
        let (n, w) = (id.len(), wall_id.len());
        let particles = Set::over(id, memory, n, M::FIELDS, Side::Particles);
        let walls = Set::over(wall_id, wall_memory, w, M::FIELDS, Side::Walls);
        let system = System {
            particles: particles.expect("memory"),
            walls: walls.expect("memory"),
            grids: self.model.grids(),
            cells: Cells { start, order },
            wall_cells: Cells {
                start: wall_start,
                order: wall_order,
            },
            clock: &mut self.clock,
        };
        (&self.model, system)
    }

    /// See [`Model::initialise`].
    ///
    /// # Errors
    /// The model's.
    pub fn initialise(&mut self) -> Result<(), Fault> {
        let (model, mut system) = self.parts();
        model.initialise(&mut system, &Serial)
    }
}

/// What is stepped and looked at.
trait Run {
    fn advance(&mut self, steps: u64) -> Result<(), Fault>;
    fn reverse(&mut self);
    fn digest(&mut self) -> Digest;
    fn measure(&mut self) -> Result<Diagnostics, Fault>;
}

impl<A: Arithmetic, M: Model<A, D>, const D: usize> Run for Plain<M, D, A> {
    fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        let (model, mut system) = self.parts();
        (0..steps).try_for_each(|_| model.step(&mut system, &Serial))
    }
    fn reverse(&mut self) {
        self.parts().1.reverse();
    }
    fn digest(&mut self) -> Digest {
        let scale = self.model.scale();
        loschmidt_core::digest::digest(&self.parts().1, &scale)
    }
    fn measure(&mut self) -> Result<Diagnostics, Fault> {
        let (model, mut system) = self.parts();
        Diagnostics::measure(model, &mut system, &Serial)
    }
}

impl Run for Box<dyn Simulation> {
    fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        (**self).advance(steps)
    }
    fn reverse(&mut self) {
        (**self).reverse();
    }
    fn digest(&mut self) -> Digest {
        (**self).digest()
    }
    fn measure(&mut self) -> Result<Diagnostics, Fault> {
        (**self).measure()
    }
}

/// Everything that was seen, up to the fault that ended it.
#[derive(Clone, Debug, Default, PartialEq)]
struct Trace {
    digests: Vec<Digest>,
    diagnostics: Vec<Diagnostics>,
    fault: Option<Fault>,
}

/// Looks at a run after these numbers of steps, and after as many on the way back.
fn trace<R: Run>(run: Result<R, Fault>, steps: &[u64]) -> Trace {
    let mut trace = Trace::default();
    trace.fault = run
        .and_then(|mut run| follow(&mut run, steps, &mut trace))
        .err();
    trace
}

fn follow(run: &mut impl Run, steps: &[u64], trace: &mut Trace) -> Result<(), Fault> {
    trace.digests.push(run.digest());
    for way in 0..2 {
        let mut taken = 0;
        for &step in steps {
            run.advance(step - taken)?;
            taken = step;
            trace.digests.push(run.digest());
            // What is looked at on the way changes nothing.
            trace.diagnostics.push(run.measure()?);
        }
        run.reverse();
        if way == 1 {
            trace.digests.push(run.digest());
        }
    }
    Ok(())
}

/// Every executor but the core's. More threads than a state is divided among are no harm.
#[must_use]
pub fn executors() -> Vec<Options> {
    let fast = backends().flat_map(|backend| [1, 2, 5].map(|n| fast(backend, n)));
    [serial(), threads(2)].into_iter().chain(fast).collect()
}

/// Holds every executor to the core's plain steps of a model, looked at after these numbers of
/// them.
///
/// # Errors
/// The first difference.
///
/// # Panics
/// If there can be no such simulation.
pub fn check<A: Arithmetic, M: Model<A, D>, const D: usize>(
    model: impl Fn() -> M,
    initial: &InitialState,
    steps: &[u64],
) -> Result<(), String> {
    let mut plain = Plain::<M, D, A>::new(model(), initial);
    let reference = trace(plain.initialise().map(|()| plain), steps);
    if reference.fault.is_none() && M::REVERSIBILITY == Reversibility::BitExact {
        let home = reference.digests.first();
        if home != reference.digests.last() {
            return Err("the plain steps do not return".to_owned());
        }
    }
    for options in executors() {
        let simulation = match simulate::<A, M, D>(model(), initial, &options) {
            Ok(simulation) => Ok(simulation),
            Err(BuildError::Fault(fault)) => Err(fault),
            Err(other) => panic!("{other}"),
        };
        let found = trace(simulation, steps);
        let part = if found.fault != reference.fault {
            format!("{:?} instead of {:?}", found.fault, reference.fault)
        } else if found.digests != reference.digests {
            format!(
                "digests {:?} instead of {:?}",
                found.digests, reference.digests
            )
        } else if found.diagnostics != reference.diagnostics {
            "other diagnostics".to_owned()
        } else {
            continue;
        };
        return Err(format!("{options:?}: {part}"));
    }
    Ok(())
}

/// The same for the model of a scene, which must be this one.
///
/// # Errors
/// The first difference.
pub fn check_scheme<A: Arithmetic, M: Scheme<A, D>, const D: usize>(
    scene: &Scene,
    initial: &InitialState,
    steps: &[u64],
) -> Result<(), String> {
    assert_eq!(scene.dimension.axes(), D);
    let parameters = setup::parameters::<D>(scene, initial);
    check(|| M::of(parameters).expect("in range"), initial, steps)
}

/// The same for whatever model a scene has.
///
/// # Errors
/// The first difference.
///
/// # Panics
/// If the model of the scene is not one of water.
pub fn check_scene<A: Arithmetic>(
    scene: &Scene,
    initial: &InitialState,
    steps: &[u64],
) -> Result<(), String> {
    use scene::Model as M;
    match (&scene.model, scene.dimension) {
        (M::Symplectic, Dimension::Two) => {
            check_scheme::<A, Symplectic<A, 2>, 2>(scene, initial, steps)
        }
        (M::Symplectic, Dimension::Three) => {
            check_scheme::<A, Symplectic<A, 3>, 3>(scene, initial, steps)
        }
        (M::Standard, Dimension::Two) => {
            check_scheme::<A, Standard<A, 2>, 2>(scene, initial, steps)
        }
        (M::Standard, Dimension::Three) => {
            check_scheme::<A, Standard<A, 3>, 3>(scene, initial, steps)
        }
        (M::Filtered, Dimension::Two) => {
            check_scheme::<A, Filtered<A, 2>, 2>(scene, initial, steps)
        }
        (M::Filtered, Dimension::Three) => {
            check_scheme::<A, Filtered<A, 3>, 3>(scene, initial, steps)
        }
        (other, _) => panic!("{other:?} is no model of water"),
    }
}

/// Lattice particles moved by up to a third of a spacing, with velocities: disordered, but not so
/// violent that the run ends.
///
/// # Panics
/// If the scene has no initial state.
#[must_use]
pub fn disordered(scene: &Scene, seed: u64) -> InitialState {
    let mut initial = scene.initial_state().unwrap_or_else(|e| panic!("{e}"));
    let mut generator = Generator::new(seed);
    let axes = scene.dimension.axes();
    for (x, v) in initial.fluid.iter_mut().zip(&mut initial.fluid_velocity) {
        for d in 0..axes {
            x[d] += 0.3 * scene.particle_spacing * generator.signed();
            v[d] += generator.signed();
        }
    }
    initial
}

/// Tests that hold every executor to a model's plain steps, a line each: the name of the test, the
/// model, and a scene of the catalogue with what is set in it.
///
/// ```ignore
/// conformance! {
///     my_model_in_the_plane: MyModel<Fixed, 2>, "dam-break", ["model=my-model"];
/// }
/// ```
#[macro_export]
macro_rules! conformance {
    ($($name:ident: $model:ty, $scene:literal, [$($set:expr),* $(,)?];)+) => {$(
        #[test]
        fn $name() {
            let scene = $crate::program::scene($scene, &[$($set),*]);
            let initial = $crate::conformance::disordered(&scene, 1);
            $crate::conformance::check_scheme::<_, $model, _>(&scene, &initial, &[1, 2, 12])
                .unwrap_or_else(|difference| panic!("{difference}"));
        }
    )+};
}
