//! Walls of a fluid: held particles that carry a distortion, pretend to move, and do work.
//!
//! A wall particle w at a depth d_w below the surface of its wall takes part in velocity gradients
//! with the velocity of the flow continued through the surface,
//!
//! v_w = u + Σ W (u - v_f) min(d_w/d_f, 3/2)/Σ W,
//!
//! over the particles f of the flow within reach; u is the velocity of the wall at the nearest point
//! of its surface, and d_f, at least half a spacing, the height of f above the plane that touches
//! the wall there. Without flow in reach, or where the scene asks for plain walls, v_w = u. The
//! depth and the direction are those of the particle's *wall offset*, which leads to that point.
//!
//! Shear acts on the pretended velocity, pressure on the real one: the work that a wall does in a
//! kick is -(J_shear · v_w + J_rest · dx/dt).
//!
//! Source of the mirror: J. P. Morris, P. J. Fox & Y. Zhu, J. Comput. Phys. 136 (1997) 214. Which
//! velocity walls have is what decides the accuracy of these flows; the paper leaves it open.

use super::super::fields::{BESIDE, EXCHANGED, FORCES, HELD, ONE, ONE_ENERGY, WALL_OFFSET};
use super::super::parameters::{Motion, Parameters};
use super::super::passes::SplitForce;
use super::super::updates::Fall;
use crate::fault::{Fault, FaultKind};
use crate::fields::{IMPULSE, POSITION, VELOCITY};
use crate::kernel::Reach;
use crate::number::{Arithmetic, Lanes, Quantity, Word};
use crate::pairs::{PairPass, Parity};
use crate::points::PointPass;
use crate::shears::Drift;
use crate::values;
use crate::values::Values;

/// The largest ratio of depth to height.
const MOST_RATIO: f64 = 1.5;

values! {
    /// What the sums beside a wall need of a particle.
    pub struct Beholding {
        /// v, in speed quanta.
        velocity: [T; D],
        /// The way to the surface, in length quanta; 0 in the flow.
        offset: [T; D],
        /// 1 in a wall, 0 in the flow.
        held: T,
    }

    /// Sums over the flow beside a wall particle, with q the ratio of its depth to the height.
    pub struct Beside {
        /// Σ V0 W.
        weight: T,
        /// Σ V0 W q.
        ratio: T,
        /// Σ V0 W q v_f, in speed quanta.
        flow: [T; D],
    }
}

/// The sums beside walls. A pair of which one is in a wall and the other in the flow gives both the
/// same; what the flow receives is of no use.
#[derive(Clone, Copy, Debug)]
pub struct BesidePass {
    pub(super) reach: Reach,
    /// V0 in units that make a term pure quanta.
    pub(super) volume: f64,
    /// V0.
    pub(super) share: f64,
    /// The least height, in length quanta.
    pub(super) least: f64,
}

impl<const D: usize> PairPass<D> for BesidePass {
    type Read<T: Copy> = Beholding<T, D>;
    type Term<T: Copy> = Beside<T, D>;
    const PARITY: Beside<Parity, D> = Beside {
        weight: Parity::Symmetric,
        ratio: Parity::Symmetric,
        flow: [Parity::Symmetric; D],
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, largest: &Beholding<f64, D>) -> f64 {
        let value = self.reach.kernel.value_at(0.0).abs() * MOST_RATIO;
        let speed = largest.velocity.iter().fold(0.0, |a: f64, v| a.max(*v));
        // 1 but for states that somebody else has written.
        let (mixed, flows) = (
            2.0 * largest.held * (1.0 + largest.held),
            1.0 + largest.held,
        );
        1.001 * value * mixed * (self.volume.abs()).max(2.0 * flows * speed * self.share.abs())
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        argument: L,
        i: &Beholding<L, D>,
        j: &Beholding<L, D>,
    ) -> Beside<L, D> {
        let one = argument.splat(1.0);
        let (flows_i, flows_j) = (one - i.held, one - j.held);
        // 1 where one is held and the other is not; the offset of the one that is.
        let mixed = i.held * flows_j + j.held * flows_i;
        let (mut along, mut depth) = (argument.splat(0.0), argument.splat(0.0));
        for (d, x) in x_ij.iter().enumerate() {
            let offset = i.offset[d] + j.offset[d];
            along = along + *x * offset;
            depth = depth + offset * offset;
        }
        let depth = depth.root();
        // A quantum more, for a depth of zero.
        let along = (j.held - i.held) * along / (depth + one);
        let least = argument.splat(self.least);
        let height = least + (along - depth - least).positive_part();
        let most = argument.splat(MOST_RATIO);
        let ratio = most - (most - depth / height).positive_part();
        let value = self.reach.kernel.value_at(argument) * mixed;
        let weight = value * argument.splat(self.volume);
        let share = value * argument.splat(self.share) * ratio;
        let mut flow = *x_ij;
        for (d, flow) in flow.iter_mut().enumerate() {
            *flow = share * (flows_i * i.velocity[d] + flows_j * j.velocity[d]);
        }
        Beside {
            weight,
            ratio: weight * ratio,
            flow,
        }
    }
}

/// Fields that are read as [`Beholding`].
pub(super) const READ_OF_BESIDE: &[usize] = &[VELOCITY, WALL_OFFSET, HELD];

/// A field of sums ← 0, of the sums beside walls and of forces.
macro_rules! nothing {
    ($(#[$doc:meta])* $name:ident: $values:ident into $field:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl<A: Arithmetic, const D: usize> PointPass<A, D> for $name {
            type Read<T: Copy> = [T; 0];
            type Write<T: Copy> = $values<T, D>;
            const READ: &'static [usize] = &[];
            const WRITE: &'static [usize] = &[$field];
            #[inline(always)]
            fn at(
                &self,
                _: u64,
                _: &[A::Word; 0],
                sums: &mut $values<A::Word, D>,
            ) -> Result<(), Fault> {
                *sums = $values::from_fn(|_| A::Word::ZERO);
                Ok(())
            }
        }
    };
}
nothing! {
    /// Nothing beside walls yet.
    NothingBeside: Beside into BESIDE
}
nothing! {
    /// No forces yet.
    NoForces: SplitForce into FORCES
}

/// ω × y; in the plane the third components do not count.
fn cross(w: &[f64; 3], y: &[f64; 3]) -> [f64; 3] {
    [
        w[1] * y[2] - w[2] * y[1],
        w[2] * y[0] - w[0] * y[2],
        w[0] * y[1] - w[1] * y[0],
    ]
}

/// Words as lengths, m.
fn metres<W: Word, const D: usize>(words: &[W; D], quantum: f64) -> [f64; 3] {
    let mut x = [0.0; 3];
    for (x, word) in x.iter_mut().zip(words) {
        *x = word.quanta() * quantum;
    }
    x
}

impl Motion {
    /// The velocity of the wall at x (m), m/s.
    #[must_use]
    pub fn velocity(&self, x: &[f64; 3]) -> [f64; 3] {
        match self {
            Self::Still => [0.0; 3],
            Self::Slides(velocity) => *velocity,
            Self::Turns { rate, centre } => cross(
                rate,
                &[x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]],
            ),
        }
    }

    /// The velocity of a particle of the wall at x: one that slides stays where it is.
    fn real_velocity(&self, x: &[f64; 3]) -> [f64; 3] {
        match self {
            Self::Slides(_) => [0.0; 3],
            other => other.velocity(x),
        }
    }
}

/// v ← what a wall particle pretends to have.
#[derive(Clone, Debug)]
pub struct Pretend<const D: usize> {
    pub(super) parameters: Parameters<D>,
    pub(super) mirrored: bool,
    /// Share of the full speed of the walls.
    pub(super) progress: f64,
}

values! {
    /// A particle of a wall.
    pub struct Walled {
        position: [T; D],
        offset: [T; D],
        held: T,
        beside: Beside<T, D>,
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Pretend<D> {
    type Read<T: Copy> = Walled<T, D>;
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[POSITION, WALL_OFFSET, HELD, BESIDE];
    const WRITE: &'static [usize] = &[VELOCITY];
    fn at(
        &self,
        id: u64,
        read: &Walled<A::Word, D>,
        velocity: &mut [A::Word; D],
    ) -> Result<(), Fault> {
        if read.held.whole_quanta() == 0 {
            return Ok(());
        }
        let scale = &self.parameters.scale;
        let (length, speed) = (scale.length_quantum(), scale.speed_quantum());
        let mut surface = metres(&read.position, length);
        for (x, way) in surface.iter_mut().zip(metres(&read.offset, length)) {
            *x += way;
        }
        let of_wall = self.parameters.part_of(id).motion.velocity(&surface);
        let weight = read.beside.weight.quanta() / ONE;
        for (d, velocity) in velocity.iter_mut().enumerate() {
            let mut v = self.progress * of_wall[d] / speed;
            if self.mirrored && weight > 0.0 {
                let ratio = read.beside.ratio.quanta() / ONE;
                v += (v * ratio - read.beside.flow[d].quanta()) / weight;
            }
            let word = A::Word::ZERO.add_rounded(v);
            let fault = Fault::new(FaultKind::VelocityRange, id);
            *velocity = word.filter(|word| word.in_range()).ok_or(fault)?;
        }
        Ok(())
    }
}

/// A drift of what is not held.
#[derive(Clone, Copy, Debug)]
pub struct FlowDrift {
    pub(super) drift: Drift,
}

values! {
    /// What a drift reads.
    pub struct Drifting {
        velocity: [T; D],
        held: T,
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for FlowDrift {
    type Read<T: Copy> = Drifting<T, D>;
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[VELOCITY, HELD];
    const WRITE: &'static [usize] = &[POSITION];
    #[inline(always)]
    fn at(&self, id: u64, read: &Drifting<A::Word, D>, x: &mut [A::Word; D]) -> Result<(), Fault> {
        if read.held.whole_quanta() != 0 {
            return Ok(());
        }
        PointPass::<A, D>::at(&self.drift, id, &read.velocity, x)
    }
}

/// x and the way to the surface ← turned with their wall, in a drift.
///
/// With b = dt ω/2 a rotation (Cayley's, by the angle 2 atan |b|) adds
/// 2 (b × y + b × (b × y))/(1 + b²) to y.
#[derive(Clone, Debug)]
pub struct Carry<const D: usize> {
    pub(super) parameters: Parameters<D>,
    /// Half of the drift's duration, s, times the share of the full speed of the walls.
    pub(super) half: f64,
}

values! {
    /// What turns with a wall.
    pub struct Carried {
        position: [T; D],
        offset: [T; D],
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Carry<D> {
    type Read<T: Copy> = T;
    type Write<T: Copy> = Carried<T, D>;
    const READ: &'static [usize] = &[HELD];
    const WRITE: &'static [usize] = &[POSITION, WALL_OFFSET];
    fn at(&self, id: u64, held: &A::Word, write: &mut Carried<A::Word, D>) -> Result<(), Fault> {
        if held.whole_quanta() == 0 {
            return Ok(());
        }
        let Motion::Turns { rate, centre } = self.parameters.part_of(id).motion else {
            return Ok(());
        };
        let quantum = self.parameters.scale.length_quantum();
        let b = rate.map(|w| self.half * w);
        let factor = 2.0 / (1.0 + (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]));
        let turn = |words: &mut [A::Word; D], centre: [f64; 3]| {
            let mut y = metres(words, quantum);
            for (y, centre) in y.iter_mut().zip(centre) {
                *y -= centre;
            }
            let once = cross(&b, &y);
            let twice = cross(&b, &once);
            for (d, word) in words.iter_mut().enumerate() {
                let moved = word.add_rounded(factor * (once[d] + twice[d]) / quantum);
                let fault = Fault::new(FaultKind::PositionRange, id);
                *word = moved.filter(|word| word.in_range()).ok_or(fault)?;
            }
            Ok(())
        };
        turn(&mut write.position, centre)?;
        turn(&mut write.offset, [0.0; 3])
    }
}

/// J ← the whole impulse, but nothing for what is held.
#[derive(Clone, Copy, Debug)]
pub struct Collect<W, const D: usize> {
    pub(super) fall: Fall<W, D>,
}

values! {
    /// The parts of an impulse, and who receives it.
    pub struct Received {
        forces: SplitForce<T, D>,
        held: T,
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Collect<A::Word, D> {
    type Read<T: Copy> = Received<T, D>;
    type Write<T: Copy> = [T; D];
    const READ: &'static [usize] = &[FORCES, HELD];
    const WRITE: &'static [usize] = &[IMPULSE];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Received<A::Word, D>,
        impulse: &mut [A::Word; D],
    ) -> Result<(), Fault> {
        *impulse = [A::Word::ZERO; D];
        if read.held.whole_quanta() != 0 {
            return Ok(());
        }
        let fall = self
            .fall
            .impulse
            .ok_or(Fault::new(FaultKind::TermRange, id))?;
        for (d, impulse) in impulse.iter_mut().enumerate() {
            *impulse = fall[d].plus(read.forces.shear[d]).plus(read.forces.rest[d]);
        }
        Ok(())
    }
}

/// The work that the forces of a kick do on a wall.
#[derive(Clone, Debug)]
pub struct Work<W, const D: usize> {
    pub(super) parameters: Parameters<D>,
    pub(super) fall: Fall<W, D>,
    /// Share of the full speed of the walls.
    pub(super) progress: f64,
    /// The unit of exchanged energy, J/kg.
    pub(super) unit: f64,
}

values! {
    /// A particle of a wall that is pushed.
    pub struct Pushed {
        forces: SplitForce<T, D>,
        velocity: [T; D],
        position: [T; D],
        held: T,
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Work<A::Word, D> {
    type Read<T: Copy> = Pushed<T, D>;
    type Write<T: Copy> = [T; 2];
    const READ: &'static [usize] = &[FORCES, VELOCITY, POSITION, HELD];
    const WRITE: &'static [usize] = &[EXCHANGED];
    fn at(
        &self,
        id: u64,
        read: &Pushed<A::Word, D>,
        exchanged: &mut [A::Word; 2],
    ) -> Result<(), Fault> {
        if read.held.whole_quanta() == 0 {
            return Ok(());
        }
        let scale = &self.parameters.scale;
        let speed = scale.speed_quantum();
        let x = metres(&read.position, scale.length_quantum());
        let real = self.parameters.part_of(id).motion.real_velocity(&x);
        let fault = Fault::new(FaultKind::TermRange, id);
        let fall = self.fall.impulse.ok_or(fault)?;
        let mut work = 0.0;
        for d in 0..D {
            let shear = read.forces.shear[d].quanta() * (read.velocity[d].quanta() * speed);
            let rest = fall[d].plus(read.forces.rest[d]).quanta();
            work += speed * (shear + rest * (self.progress * real[d]));
        }
        let sum = exchanged[1].add_rounded(work * (ONE_ENERGY / self.unit));
        exchanged[1] = sum.filter(|sum| sum.in_range()).ok_or(fault)?;
        Ok(())
    }
}

const _: () = {
    // What the sums read is what they are told of.
    assert!(<Beholding<f64, 2> as Values<f64>>::COUNT == 5);
};
