//! Many steps at once: what the reference computes twice is computed once, and added twice.
//!
//! A model's step is a list of stages; what a stage adds is prepared, then applied
//! ([`loschmidt_core::model`]). Where a step closes with the kick that the next one opens with, the
//! positions in between are the same, and so are the integers: they are prepared once. Executors
//! may prepare in a way of their own, and apply kicks and the drift after them in one go. The
//! conformance suite holds all of it to the bits of [`Model::step`], and to its faults.

use loschmidt_core::integrator::Stage;
use loschmidt_core::model::Model;
use loschmidt_core::{Arithmetic, Executor, Fault, FaultKind, Serial, System};

/// What the scratch of a system holds at the moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Held {
    /// The kick whose impulses were prepared at the present positions.
    prepared: Option<Stage>,
    /// What [`Model::refresh`] leaves.
    pub refreshed: bool,
    /// Sums that depend on positions alone: no particle has moved since they were taken.
    in_place: bool,
}

impl Held {
    /// What [`Model::refresh`] has just left.
    pub fn refreshed() -> Self {
        Self {
            prepared: None,
            refreshed: true,
            in_place: true,
        }
    }
}

/// Stages that are applied together: a kick, the same kick of the step after, and a drift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    /// Of the first stage.
    pub step: u64,
    pub first: Stage,
    /// Whether the next step opens with the same kick.
    pub again: bool,
    /// The drift that follows, and its step.
    pub drift: Option<(u64, f64)>,
}

impl Group {
    /// One stage after another, as the model does it.
    pub fn in_turn<A: Arithmetic, M: Model<A, D>, E: Executor, const D: usize>(
        self,
        model: &M,
        system: &mut System<'_, A, D>,
        exec: &E,
    ) -> Result<(), Fault> {
        let mut apply = |stage, step: u64| {
            // What moves with time asks the clock.
            system.clock.step = step - 1;
            let result = model.apply(stage, system, exec);
            result.map_err(|fault: Fault| fault.at_step(step))
        };
        apply(self.first, self.step)?;
        if self.again {
            apply(self.first, self.step + 1)?;
        }
        match self.drift {
            Some((step, c)) => apply(Stage::Drift(c), step),
            None => Ok(()),
        }
    }
}

/// An executor that takes many steps.
pub(crate) trait Drive: Executor + Sized {
    /// Leaves what [`Model::prepare`] leaves, or where no particle has moved
    /// [`Model::prepare_in_place`].
    fn prepare<A: Arithmetic, M: Model<A, D>, const D: usize>(
        &self,
        model: &M,
        stage: Stage,
        in_place: bool,
        system: &mut System<'_, A, D>,
    ) -> Result<(), Fault> {
        if in_place {
            model.prepare_in_place(stage, system, self)
        } else {
            model.prepare(stage, system, self)
        }
    }

    /// Leaves what applying the stages in turn leaves.
    fn apply<A: Arithmetic, M: Model<A, D>, const D: usize>(
        &self,
        model: &M,
        group: Group,
        system: &mut System<'_, A, D>,
    ) -> Result<(), Fault> {
        group.in_turn(model, system, self)
    }
}

impl Drive for Serial {}

/// Takes `steps` steps: the same bits as one [`Model::step`] after another, and the same fault.
pub(crate) fn advance<A: Arithmetic, M: Model<A, D>, E: Drive, const D: usize>(
    model: &M,
    system: &mut System<'_, A, D>,
    exec: &E,
    held: &mut Held,
    steps: u64,
) -> Result<(), Fault> {
    let first = system.clock.step + 1;
    if steps > 0 && !system.clock.initialised {
        return Err(Fault::new(FaultKind::NotInitialised, 0).at_step(first));
    }
    let all =
        (first..first + steps).flat_map(|step| model.stages(step).map(move |stage| (step, stage)));
    let mut all = all.peekable();
    while let Some((step, stage)) = all.next() {
        if held.prepared != Some(stage) {
            let in_place = std::mem::take(held).in_place;
            exec.prepare(model, stage, in_place, system)
                .map_err(|fault| fault.at_step(step))?;
            // A drift sums nothing, so after it there is nothing to be kept either.
            held.in_place = in_place || !matches!(stage, Stage::Drift(_));
        }
        let mut group = Group {
            step,
            first: stage,
            again: false,
            drift: None,
        };
        let mut last = step;
        if matches!(stage, Stage::Kick(_)) {
            *held = Held {
                prepared: Some(stage),
                ..Held::refreshed()
            };
            let same = |(next, again): &(u64, Stage)| *again == stage && *next == step + 1;
            if let Some((next, _)) = all.next_if(same) {
                group.again = true;
                last = next;
            }
            if let Some(&(next, Stage::Drift(c))) = all.peek() {
                all.next();
                group.drift = Some((next, c));
                last = next;
            }
        }
        if group.drift.is_some() || !matches!(stage, Stage::Kick(_)) {
            let moved = group.drift.is_some() || matches!(stage, Stage::Drift(_));
            *held = Held {
                in_place: held.in_place && !moved,
                ..Held::default()
            };
        }
        exec.apply(model, group, system)?;
        let goes_on = all.peek().is_some_and(|(next, _)| *next == last);
        system.clock.step = if goes_on { last - 1 } else { last };
    }
    Ok(())
}
