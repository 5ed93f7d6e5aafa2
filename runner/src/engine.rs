//! The engine behind every [`Simulation`]: a model, its memory and an executor of known types.

mod pictures;

use crate::drive::{self, Drive, Held};
use crate::executor::{AnyExecutor, ExecutorKind};
use crate::fast::Fast;
use crate::frame::Frame;
use crate::points::Points;
use crate::pool::Rayon;
use crate::random::SplitMix64;
use crate::saved::{ArithmeticKind, SavedField, SavedState};
use crate::scene::InitialState;
use crate::simulation::{BuildError, Options, Simulation};
use crate::storage::Storage;
use loschmidt_core::fields::{Side, TimeParity, state_fields};
use loschmidt_core::model::Model;
use loschmidt_core::number::Quantity;
use loschmidt_core::owned::to_quanta;
use loschmidt_core::set::Set;
use loschmidt_core::{
    Arithmetic, Clock, Diagnostics, Digest, Fault, Reversibility, Scale, Serial, System,
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

/// Sets up a simulation of any model at step 0: what the model computes once is computed.
///
/// # Errors
/// [`BuildError`].
pub fn simulate<A: Arithmetic, M: Model<A, D>, const D: usize>(
    model: M,
    particles: &InitialState,
    options: &Options,
) -> Result<Box<dyn Simulation>, BuildError> {
    Ok(Box::new(Engine::<A, M, D>::new(model, particles, options)?))
}

impl<A: Arithmetic, M: Model<A, D>, const D: usize> Engine<A, M, D> {
    pub(crate) fn new(
        model: M,
        particles: &InitialState,
        options: &Options,
    ) -> Result<Self, BuildError> {
        let scale = model.scale();
        let n = particles.fluid.len();
        let mut order: Vec<u64> = (0..n as u64).collect();
        if let Some(seed) = options.shuffle {
            shuffle(&mut order, seed);
        }
        let mut storage = Storage::new(&model, order, particles.wall.len());
        let mut system = storage.system();
        let (length, speed) = (scale.length_quantum(), scale.speed_quantum());
        for place in 0..n {
            let particle = system.particles.id[place];
            let range = BuildError::Range { particle };
            let x = to_quanta(first(particles.fluid[particle as usize]), length);
            let v = to_quanta(first(particles.fluid_velocity[particle as usize]), speed);
            let (Some(x), Some(v)) = (x, v) else {
                return Err(range);
            };
            system.particles.position_mut()[place] = x;
            system.particles.velocity_mut()[place] = v;
        }
        particles
            .put_given(&mut system.particles, &scale)
            .map_err(|particle| BuildError::Range { particle })?;
        particles
            .put_given(&mut system.walls, &scale)
            .map_err(|particle| BuildError::Range { particle })?;
        for (w, x) in particles.wall.iter().enumerate() {
            let particle = (n + w) as u64;
            system.walls.position_mut()[w] =
                to_quanta(first(*x), length).ok_or(BuildError::Range { particle })?;
        }
        let executor = match options.executor {
            ExecutorKind::Serial => AnyExecutor::Serial(Serial),
            ExecutorKind::Rayon => AnyExecutor::Rayon(Rayon::new(options.threads)?),
            ExecutorKind::Fast => {
                AnyExecutor::Fast(Box::new(Fast::new(options.threads, options.backend)?))
            }
        };
        let mut engine = Self {
            model,
            storage,
            executor,
            released: false,
        };
        engine.with_executor(Initialise)?;
        engine.add(particles, &scale)?;
        Ok(engine)
    }

    /// Adds what the scene adds to fields that the model has made.
    fn add(&mut self, particles: &InitialState, scale: &Scale) -> Result<(), BuildError> {
        if particles.added.is_empty() && particles.wall_added.is_empty() {
            return Ok(());
        }
        let mut system = self.storage.system();
        particles
            .add_to(&mut system.particles, scale)
            .and_then(|()| particles.add_to(&mut system.walls, scale))
            .map_err(|particle| BuildError::Range { particle })?;
        // What walls add to each other does not change any more, and holds these fields.
        self.with_executor(PlaceWalls)?;
        Ok(())
    }

    /// Calls `task` with the executor's own type.
    fn with_executor<T: EngineTask<A, M, D>>(&mut self, task: T) -> T::Output {
        let (mut system, held) = self.storage.parts();
        let model = &self.model;
        match &self.executor {
            AnyExecutor::Serial(exec) => task.run(model, &mut system, held, exec),
            AnyExecutor::Rayon(exec) => exec.install(|| task.run(model, &mut system, held, exec)),
            AnyExecutor::Fast(exec) => exec.install(|| task.run(model, &mut system, held, &**exec)),
        }
    }

    /// To be called before anything that looks for neighbours.
    fn wake(&mut self) {
        if std::mem::take(&mut self.released) {
            self.storage.held = Held::default();
        }
    }

    /// Has what diagnostics and pictures read of the present state in the scratch.
    fn refresh(&mut self) -> Result<(), Fault> {
        if self.storage.held.refreshed {
            return Ok(());
        }
        self.wake();
        self.with_executor(Refresh)
    }

    /// Places of the particles in id order.
    fn places(&mut self) -> Vec<usize> {
        let system = self.storage.system();
        let mut place = vec![0; system.particles.len()];
        for (p, id) in system.particles.id.iter().enumerate() {
            place[*id as usize] = p;
        }
        place
    }
}

/// Something done with model, system and executor of known types.
trait EngineTask<A: Arithmetic, M: Model<A, D>, const D: usize>: Send {
    type Output: Send;
    fn run<E: Drive + Sync>(
        self,
        model: &M,
        system: &mut System<'_, A, D>,
        held: &mut Held,
        exec: &E,
    ) -> Self::Output;
}

macro_rules! task {
    ($name:ident $(($field:ident: $ty:ty))?, |$model:ident, $system:ident, $held:ident, $exec:ident $(, $arg:ident)?| $body:expr) => {
        struct $name$(($ty))?;
        impl<A: Arithmetic, M: Model<A, D>, const D: usize> EngineTask<A, M, D> for $name {
            type Output = Result<(), Fault>;
            fn run<E: Drive + Sync>(
                self,
                $model: &M,
                $system: &mut System<'_, A, D>,
                $held: &mut Held,
                $exec: &E,
            ) -> Self::Output {
                $(let $arg = self.0;)?
                $body
            }
        }
    };
}

task!(Initialise, |model, system, held, exec| {
    *held = Held::default();
    model.initialise(system, exec)
});
task!(PlaceWalls, |model, system, held, exec| {
    *held = Held::default();
    model.place_walls(system, exec)
});
task!(Advance(steps: u64), |model, system, held, exec, steps| {
    drive::advance(model, system, exec, held, steps)
});
task!(Refresh, |model, system, held, exec| {
    *held = Held::default();
    let step = system.clock.step;
    model
        .refresh(system, exec)
        .map_err(|fault| fault.at_step(step))?;
    *held = Held::refreshed();
    Ok(())
});

impl<A: Arithmetic, M: Model<A, D>, const D: usize> Simulation for Engine<A, M, D> {
    fn step(&self) -> u64 {
        self.storage.clock.step
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
        self.refresh()?;
        Diagnostics::of(&self.model, &self.storage.system())
    }

    fn digest(&mut self) -> Digest {
        let scale = self.model.scale();
        loschmidt_core::digest::digest(&self.storage.system(), &scale)
    }

    fn save(&mut self) -> SavedState {
        let places = self.places();
        let (scale, step) = (self.model.scale(), self.step());
        let system = self.storage.system();
        let walls: Vec<usize> = (0..system.walls.len()).collect();
        SavedState {
            dimension: D,
            arithmetic: kind::<A>(),
            scale,
            step,
            id: (0..places.len() as u64).collect(),
            fields: saved_fields(&self.executor, &system.particles, &places),
            walls: walls.len(),
            wall_fields: saved_fields(&self.executor, &system.walls, &walls),
        }
    }

    fn restore(&mut self, saved: &SavedState) -> Result<(), BuildError> {
        let foreign = |what| Err(BuildError::Foreign(what));
        let places = self.places();
        let scale = self.model.scale();
        let mut system = self.storage.system();
        if saved.dimension != D || saved.id.len() != places.len() {
            return foreign("it has another number of particles or dimensions");
        }
        if saved.scale != scale || saved.arithmetic != kind::<A>() {
            return foreign("it has other units or another arithmetic");
        }
        let walls: Vec<usize> = (0..system.walls.len()).collect();
        if saved.walls != walls.len() || !fits(&system.walls, &saved.wall_fields) {
            return foreign("it has other walls");
        }
        if !fits(&system.particles, &saved.fields) {
            return foreign("it has other fields");
        }
        put(&mut system.particles, &saved.fields, &places);
        put(&mut system.walls, &saved.wall_fields, &walls);
        *system.clock = Clock {
            step: saved.step,
            initialised: true,
        };
        self.with_executor(PlaceWalls)?;
        Ok(())
    }

    fn release(&mut self) {
        if let AnyExecutor::Fast(fast) = &self.executor {
            fast.release();
            self.released = true;
        }
    }

    fn frame(&mut self) -> Result<Frame, Fault> {
        self.refresh()?;
        let places = self.places();
        Ok(pictures::frame(
            &self.storage.system(),
            &self.model,
            &places,
        ))
    }

    fn points(&mut self, points: &mut Points) -> Result<(), Fault> {
        self.refresh()?;
        let system = self.storage.system();
        pictures::points(&system, &self.model, &self.executor, points);
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
        let mut system = self.storage.system();
        if let Some(place) = system.particles.id.iter().position(|&i| i == id) {
            let x = &mut system.particles.position_mut()[place][0];
            *x = A::Length::from_word(x.to_word() ^ 1);
            self.storage.held = Held::default();
        }
    }
}

/// The fields of a set, the particles at these places.
fn saved_fields<A: Arithmetic, const D: usize>(
    executor: &AnyExecutor,
    set: &Set<'_, A, D>,
    places: &[usize],
) -> Vec<SavedField> {
    let fields = state_fields(set.fields(), set.side()).map(|(f, field)| {
        let components = field.words(set.side(), D);
        let mut words = vec![0; places.len() * components];
        let copy = || {
            words
                .par_chunks_exact_mut(components)
                .with_min_len(PART)
                .zip(places)
                .for_each(|(words, &place)| {
                    for (c, word) in words.iter_mut().enumerate() {
                        *word = set.word(f, c, place);
                    }
                });
        };
        on_threads(executor, copy);
        SavedField {
            name: field.name.to_owned(),
            odd: field.parity == TimeParity::Odd,
            words,
        }
    });
    fields.collect()
}

/// Whether saved fields are those of a set.
fn fits<A: Arithmetic, const D: usize>(set: &Set<'_, A, D>, saved: &[SavedField]) -> bool {
    let fields = state_fields(set.fields(), set.side());
    let same = |((_, field), saved): ((_, &loschmidt_core::fields::Field), &SavedField)| {
        // Format 1.0 does not name the fields of walls.
        let name = set.side() == Side::Walls || field.name == saved.name;
        name && saved.words.len() == field.words(set.side(), D) * set.len()
    };
    fields.clone().count() == saved.len() && fields.zip(saved).all(same)
}

/// Puts saved fields back, the n-th particle to the n-th of these places.
fn put<A: Arithmetic, const D: usize>(
    set: &mut Set<'_, A, D>,
    saved: &[SavedField],
    places: &[usize],
) {
    let fields = state_fields(set.fields(), set.side()).zip(saved);
    for ((f, field), saved) in fields {
        let components = field.words(set.side(), D);
        for (words, &place) in saved.words.chunks_exact(components).zip(places) {
            for (c, word) in words.iter().enumerate() {
                set.set_word(f, c, place, *word);
            }
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
