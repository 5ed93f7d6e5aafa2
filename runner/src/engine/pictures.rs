//! What is looked at: frames and points of a state whose densities are known.

use super::{AnyExecutor, on_threads};
use crate::frame::{Frame, FrameColumn};
use crate::points::{Points, PointsPart, speed};
use loschmidt_core::model::Model;
use loschmidt_core::number::Quantity;
use loschmidt_core::set::SetView;
use loschmidt_core::{Arithmetic, Scale, System};
use rayon::prelude::*;

/// Fewest particles of a picture worth a thread of their own.
const PART: usize = 4096;

/// The state in SI units, the particles at these places.
pub(super) fn frame<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &System<'_, A, D>,
    model: &M,
    places: &[usize],
) -> Frame {
    let view = system.particles.view();
    let (position, velocity) = (view.position(), view.velocity());
    let scale = model.scale();
    let (lq, sq) = (scale.length_quantum(), scale.speed_quantum());
    let walls = system.walls.position().iter();
    let held = M::HELD.filter(|_| M::HELD_IS_WALL);
    let is_held = |&i: &usize| held.is_some_and(|field| view.words(field)[i] != A::Word::ZERO);
    let (held, places): (Vec<usize>, Vec<usize>) = places.iter().copied().partition(is_held);
    let walls = walls.chain(held.iter().map(|&i| &position[i]));
    let columns = M::COLUMNS.iter().enumerate();
    let columns = columns.map(|(c, &measure)| FrameColumn {
        measure,
        values: places.iter().map(|&i| model.column(c, &view, i)).collect(),
    });
    Frame {
        dimension: D,
        step: system.clock.step,
        particle_mass: model.settings().mass,
        id: places.iter().map(|&i| view.id[i]).collect(),
        position: places.iter().map(|&i| si(&position[i], lq)).collect(),
        velocity: places.iter().map(|&i| si(&velocity[i], sq)).collect(),
        columns: columns.collect(),
        wall_position: walls.map(|x| si(x, lq)).collect(),
        ..Frame::default()
    }
}

/// The same as it is drawn, the particles as they are stored. Pictures are taken while a run goes
/// on, many a second: every thread of the executor takes its part.
pub(super) fn points<A: Arithmetic, M: Model<A, D>, const D: usize>(
    system: &System<'_, A, D>,
    model: &M,
    executor: &AnyExecutor,
    points: &mut Points,
) {
    if M::HELD_IS_WALL {
        // Such walls stand among the particles: they are told apart one by one.
        let mut places: Vec<usize> = (0..system.particles.len()).collect();
        places.sort_unstable_by_key(|&place| system.particles.id[place]);
        *points = Points::from(&frame(system, model, &places));
        return;
    }
    let scale = model.scale();
    let lq = scale.length_quantum();
    points.resize(D, system.particles.len(), M::COLUMNS);
    points.step = system.clock.step;
    let walls = system.walls.position().iter();
    points.wall_position.clear();
    points
        .wall_position
        .extend(walls.map(|x| si(x, lq).map(|x| x as f32)));
    let view = system.particles.view();
    let parts = points.parts(PART);
    on_threads(executor, || {
        parts.into_par_iter().for_each(|part| {
            pulp::Arch::new().dispatch(
                #[inline(always)]
                || fill(part, &view, model, &scale),
            )
        });
    });
}

/// Compiled for the vectors that the processor has; every operation is rounded by itself in all of
/// them.
#[inline(always)]
fn fill<A: Arithmetic, M: Model<A, D>, const D: usize>(
    part: PointsPart<'_>,
    view: &SetView<'_, A, D>,
    model: &M,
    scale: &Scale,
) {
    let (lq, sq) = (scale.length_quantum(), scale.speed_quantum());
    let range = part.first..part.first + part.id.len();
    part.id.copy_from_slice(&view.id[range.clone()]);
    let positions = &view.position()[range.clone()];
    for (axis, list) in part.position.into_iter().take(D).enumerate() {
        for (to, x) in list.iter_mut().zip(positions) {
            *to = (x[axis].quanta() * lq) as f32;
        }
    }
    let velocities = &view.velocity()[range.clone()];
    for (to, v) in part.speed.iter_mut().zip(velocities) {
        *to = speed(si(v, sq));
    }
    for (column, list) in part.columns.into_iter().enumerate() {
        for (to, place) in list.iter_mut().zip(range.clone()) {
            *to = model.column(column, view, place) as f32;
        }
    }
}

#[inline(always)]
fn si<Q: Quantity, const D: usize>(x: &[Q; D], quantum: f64) -> [f64; 3] {
    let mut out = [0.0; 3];
    for (o, x) in out.iter_mut().zip(x) {
        *o = x.quanta() * quantum;
    }
    out
}
