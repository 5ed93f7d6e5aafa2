//! The engine behind every [`Simulation`]: a model, its memory and an executor of known types.

mod pictures;

use crate::executor::{AnyExecutor, ExecutorKind, Rayon};
use crate::fast::Fast;
use crate::frame::Frame;
use crate::points::Points;
use crate::random::SplitMix64;
use crate::saved::{ArithmeticKind, SavedState};
use crate::scene::InitialState;
use crate::simulation::{BuildError, Options, Simulation};
use crate::storage::Storage;
use loschmidt_core::number::Quantity;
use loschmidt_core::owned::to_quanta;
use loschmidt_core::{
    Arithmetic, Diagnostics, Digest, Executor, Fault, Forces, Model, Parameters, Progress,
    Reversibility, Serial,
};
use rayon::prelude::*;

/// Fewest particles of a copy worth a thread of their own.
const PART: usize = 4096;

pub(crate) struct Engine<A: Arithmetic, M, const D: usize> {
    model: M,
    storage: Storage<A, D>,
    executor: AnyExecutor,
    /// The executor has given its memory back, and what the scratch holds fits nothing any more.
    released: bool,
}

impl<A: Arithmetic, M: Model<A, D>, const D: usize> Engine<A, M, D> {
    pub(crate) fn new(
        parameters: Parameters<D>,
        particles: &InitialState,
        options: &Options,
    ) -> Result<Self, BuildError> {
        let scale = parameters.scale;
        let forces = Forces::new(parameters)?;
        let n = particles.fluid.len();
        let mut order: Vec<u64> = (0..n as u64).collect();
        if let Some(seed) = options.shuffle {
            shuffle(&mut order, seed);
        }
        let walls = particles.wall.len();
        let mut storage = Storage::new(order, walls, M::DENSITY_ROLE, &forces);
        let system = storage.system();
        for (place, &id) in system.state.id.iter().enumerate() {
            let range = BuildError::Range { particle: id };
            let i = id as usize;
            system.state.position[place] =
                to_quanta(first(particles.fluid[i]), scale.length_quantum())
                    .ok_or(BuildError::Range { particle: id })?;
            system.state.velocity[place] =
                to_quanta(first(particles.fluid_velocity[i]), scale.speed_quantum())
                    .ok_or(range)?;
        }
        for (w, x) in particles.wall.iter().enumerate() {
            let particle = (n + w) as u64;
            system.walls.position[w] = to_quanta(first(*x), scale.length_quantum())
                .ok_or(BuildError::Range { particle })?;
        }
        let executor = match options.executor {
            ExecutorKind::Serial => AnyExecutor::Serial(Serial),
            ExecutorKind::Rayon => AnyExecutor::Rayon(Rayon::new(options.threads)?),
            ExecutorKind::Fast => {
                AnyExecutor::Fast(Box::new(Fast::new(options.threads, options.backend)?))
            }
        };
        let mut engine = Self {
            model: M::new(forces),
            storage,
            executor,
            released: false,
        };
        engine.with_executor(Initialise)?;
        Ok(engine)
    }

    /// Calls `task` with the executor's own type.
    fn with_executor<T: Task<A, M, D>>(&mut self, task: T) -> T::Output {
        let mut system = self.storage.system();
        let model = &self.model;
        match &self.executor {
            AnyExecutor::Serial(exec) => task.run(model, &mut system, exec),
            AnyExecutor::Rayon(exec) => exec.install(|| task.run(model, &mut system, exec)),
            AnyExecutor::Fast(exec) => exec.install(|| task.run(model, &mut system, &**exec)),
        }
    }

    /// To be called before anything that looks for neighbours.
    fn wake(&mut self) {
        if std::mem::take(&mut self.released) {
            self.storage.progress.invalidate();
        }
    }

    fn forces(&self) -> &Forces<A, D> {
        self.model.forces()
    }

    /// Has the densities of the present state in the scratch.
    fn know_density(&mut self) -> Result<(), Fault> {
        if !self.storage.progress.density_is_current() {
            self.wake();
            self.with_executor(UpdateDensity)?;
        }
        Ok(())
    }

    /// Places of the particles in id order.
    fn places(&mut self) -> Vec<usize> {
        let system = self.storage.system();
        let mut place = vec![0; system.state.len()];
        for (p, id) in system.state.id.iter().enumerate() {
            place[*id as usize] = p;
        }
        place
    }
}

/// Something done with model, system and executor of known types.
trait Task<A: Arithmetic, M: Model<A, D>, const D: usize>: Send {
    type Output: Send;
    fn run<E: Executor>(
        self,
        model: &M,
        system: &mut loschmidt_core::System<'_, A, D>,
        exec: &E,
    ) -> Self::Output;
}

macro_rules! task {
    ($name:ident $(($field:ident: $ty:ty))?, $output:ty, |$model:ident, $system:ident, $exec:ident $(, $arg:ident)?| $body:expr) => {
        struct $name$(($ty))?;
        impl<A: Arithmetic, M: Model<A, D>, const D: usize> Task<A, M, D> for $name {
            type Output = $output;
            fn run<E: Executor>(
                self,
                $model: &M,
                $system: &mut loschmidt_core::System<'_, A, D>,
                $exec: &E,
            ) -> Self::Output {
                $(let $arg = self.0;)?
                $body
            }
        }
    };
}

task!(Initialise, Result<(), Fault>, |model, system, exec| model.initialise(system, exec));
task!(Advance(steps: u64), Result<(), Fault>, |model, system, exec, steps| {
    model.steps(system, exec, steps)
});
task!(Measure, Result<Diagnostics, Fault>, |model, system, exec| {
    Diagnostics::measure(model, system, exec)
});
task!(UpdateDensity, Result<(), Fault>, |model, system, exec| {
    let step = system.progress.step;
    model.update_density(system, exec).map_err(|fault| fault.at_step(step))
});

impl<A: Arithmetic, M: Model<A, D> + Send, const D: usize> Simulation for Engine<A, M, D> {
    fn step(&self) -> u64 {
        self.storage.progress.step
    }

    fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        self.wake();
        self.with_executor(Advance(steps))
    }

    fn reverse(&mut self) {
        self.storage.system().reverse();
    }

    fn reversibility(&self) -> Reversibility {
        M::REVERSIBILITY
    }

    fn measure(&mut self) -> Result<Diagnostics, Fault> {
        self.wake();
        self.with_executor(Measure)
    }

    fn digest(&mut self) -> Digest {
        let scale = self.forces().parameters().scale;
        loschmidt_core::digest::digest(&self.storage.system(), &scale)
    }

    fn save(&mut self) -> SavedState {
        let places = self.places();
        let scale = self.forces().parameters().scale;
        let step = self.step();
        let system = self.storage.system();
        let state = &system.state;
        let fields = state.fields().into_iter().enumerate().map(|(f, field)| {
            let components = field.components;
            let mut words = vec![0; places.len() * components];
            let copy = || {
                words
                    .par_chunks_exact_mut(components)
                    .with_min_len(PART)
                    .zip(&places)
                    .for_each(|(words, &place)| {
                        for (c, word) in words.iter_mut().enumerate() {
                            *word = state.word(f, c, place);
                        }
                    });
            };
            on_threads(&self.executor, copy);
            (field.name.to_owned(), words)
        });
        SavedState {
            dimension: D,
            arithmetic: kind::<A>(),
            scale,
            step,
            id: (0..state.len() as u64).collect(),
            fields: fields.collect(),
            wall_position: words(system.walls.position.iter().flatten()),
            wall_density: words(system.walls.density.iter()),
        }
    }

    fn restore(&mut self, saved: &SavedState) -> Result<(), BuildError> {
        let foreign = |what| Err(BuildError::Foreign(what));
        let places = self.places();
        let scale = self.forces().parameters().scale;
        let mut system = self.storage.system();
        let fields = system.state.fields();
        if saved.dimension != D || saved.id.len() != places.len() {
            return foreign("it has another number of particles or dimensions");
        }
        if saved.scale != scale || saved.arithmetic != kind::<A>() {
            return foreign("it has other units or another arithmetic");
        }
        if saved.wall_density.len() != system.walls.position.len()
            || saved.wall_position.len() != D * system.walls.position.len()
        {
            return foreign("it has other walls");
        }
        let fits = saved.fields.len() == fields.len()
            && fields.iter().zip(&saved.fields).all(|(f, (name, words))| {
                f.name == name && words.len() == f.components * places.len()
            });
        if !fits {
            return foreign("it has other fields");
        }
        for (f, (_, words)) in saved.fields.iter().enumerate() {
            let components = fields[f].components;
            for (n, &place) in places.iter().enumerate() {
                for c in 0..components {
                    system
                        .state
                        .set_word(f, c, place, words[n * components + c]);
                }
            }
        }
        let walls = &mut system.walls;
        for (x, &w) in walls
            .position
            .iter_mut()
            .flatten()
            .zip(&saved.wall_position)
        {
            *x = A::Length::from_word(w);
        }
        for (x, &w) in walls.density.iter_mut().zip(&saved.wall_density) {
            *x = A::Density::from_word(w);
        }
        *system.progress = Progress::at_step(saved.step);
        Ok(())
    }

    fn release(&mut self) {
        if let AnyExecutor::Fast(fast) = &self.executor {
            fast.release();
            self.released = true;
        }
    }

    fn frame(&mut self) -> Result<Frame, Fault> {
        self.know_density()?;
        let places = self.places();
        let p = *self.forces().parameters();
        Ok(pictures::frame(&self.storage.system(), &p, &places))
    }

    fn points(&mut self, points: &mut Points) -> Result<(), Fault> {
        self.know_density()?;
        let p = *self.forces().parameters();
        pictures::points(&self.storage.system(), &p, &self.executor, points);
        Ok(())
    }

    fn backend(&self) -> String {
        match &self.executor {
            AnyExecutor::Fast(exec) => exec.backend_at_work(),
            _ => "serial".to_owned(),
        }
    }

    fn pool(&self) -> Option<Rayon> {
        match &self.executor {
            AnyExecutor::Serial(_) => None,
            AnyExecutor::Rayon(exec) => Some(exec.clone()),
            AnyExecutor::Fast(exec) => Some(exec.threads().clone()),
        }
    }

    fn flip_last_bit(&mut self, id: u64) {
        let system = self.storage.system();
        if let Some(place) = system.state.id.iter().position(|&i| i == id) {
            let x = &mut system.state.position[place][0];
            *x = A::Length::from_word(x.to_word() ^ 1);
            system.progress.invalidate();
        }
    }
}

/// Does what is done in parallel on the executor's threads.
fn on_threads(executor: &AnyExecutor, work: impl FnOnce() + Send) {
    match executor {
        AnyExecutor::Serial(_) => work(),
        AnyExecutor::Rayon(exec) => exec.install(work),
        AnyExecutor::Fast(exec) => exec.install(work),
    }
}

fn words<'a, Q: Quantity>(values: impl Iterator<Item = &'a Q>) -> Vec<i64> {
    values.map(|v| v.to_word()).collect()
}

fn first<const D: usize>(x: [f64; 3]) -> [f64; D] {
    std::array::from_fn(|d| x[d])
}

fn kind<A: Arithmetic>() -> ArithmeticKind {
    if A::EXACT {
        ArithmeticKind::Fixed
    } else {
        ArithmeticKind::Float
    }
}

/// Fisher–Yates.
fn shuffle(items: &mut [u64], seed: u64) {
    let mut random = SplitMix64::new(seed);
    for i in (1..items.len()).rev() {
        let j = (random.bits() % (i as u64 + 1)) as usize;
        items.swap(i, j);
    }
}
