//! What friction does to one particle between its sums over pairs.

use super::super::fields::{
    COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, ENTROPY, ENTROPY_COPY, HEAT, NORMAL, ONE, RUBBED,
    RUBBING, TAKEN,
};
use super::super::helium::Helium;
use super::super::parameters::HeliumParameters;
use super::passes::{Normal, Rubbed, Rubbing};
use crate::fault::{Fault, FaultKind};
use crate::fields::VELOCITY;
use crate::number::{Arithmetic, Quantity, Word, root};
use crate::points::PointPass;
use crate::values;
use crate::values::Values;

values! {
    /// The state of one copy beside the velocity.
    pub struct Whole {
        velocity: [T; D],
        counterflow: [T; D],
        entropy: T,
        density: T,
    }

    /// Both copies.
    pub struct Twice {
        counterflow: [T; D],
        counterflow_copy: [T; D],
        entropy: T,
        entropy_copy: T,
    }

    /// What moves a particle.
    pub struct Pushed {
        rubbed: Rubbed<T, D>,
        normal: Normal<T, D>,
        entropy: T,
    }

    /// What is moved, and what the heat of it needs.
    pub struct Moved {
        velocity: [T; D],
        counterflow: [T; D],
        counterflow_copy: [T; D],
        rubbing: Rubbing<T, D>,
        heat: T,
    }

    /// What warms a particle.
    pub struct Heated {
        heat: T,
        counterflow: [T; D],
        density: T,
    }

    /// Both entropies.
    pub struct Entropies {
        first: T,
        second: T,
    }

    /// What both sums need of a wall.
    pub struct Beside {
        normal: Normal<T, D>,
        rubbing: Rubbing<T, D>,
    }
}

/// Both copies become their mean, up to a quantum: what one gains, the other loses.
#[derive(Clone, Copy, Debug)]
pub struct Merge;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Merge {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = Twice<T, D>;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[COUNTERFLOW, COUNTERFLOW_COPY, ENTROPY, ENTROPY_COPY];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], write: &mut Twice<A::Word, D>) -> Result<(), Fault> {
        let merge = |first: &mut A::Word, second: &mut A::Word| {
            let half = A::Word::ZERO.add_rounded(0.5 * first.difference(*second));
            let half = half.unwrap_or(A::Word::ZERO);
            *first = first.plus(half.negated());
            *second = second.plus(half);
        };
        let copies = write.counterflow.iter_mut();
        for (first, second) in copies.zip(&mut write.counterflow_copy) {
            merge(first, second);
        }
        merge(&mut write.entropy, &mut write.entropy_copy);
        Ok(())
    }
}

/// What friction needs of a particle.
#[derive(Clone, Copy, Debug)]
pub struct FindNormal {
    pub(super) helium: Helium,
    /// A speed quantum, m/s.
    pub(super) speed: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for FindNormal {
    type Read<T: Copy> = Whole<T, D>;
    type Write<T: Copy> = Normal<T, D>;
    const READ: &'static [usize] = &[VELOCITY, COUNTERFLOW, ENTROPY, DENSITY];
    const WRITE: &'static [usize] = &[NORMAL];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Whole<A::Word, D>,
        write: &mut Normal<A::Word, D>,
    ) -> Result<(), Fault> {
        let helium = &self.helium;
        let density = read.density.quanta() / ONE;
        let excess = helium.entropy * (read.entropy.quanta() / ONE);
        let normal = helium.normal_fraction_at(excess);
        if !(normal > 0.0 && normal <= 1.0) {
            return Err(Fault::new(FaultKind::NormalFraction, id));
        }
        let ratio = (1.0 - normal) / normal;
        let stretch = root::<D>(density);
        let mut squared = 0.0;
        for d in 0..D {
            let u = stretch * read.counterflow[d].quanta();
            squared += u * u;
            let v = read.velocity[d].quanta() + ratio * u;
            write.velocity[d] = A::Word::of_real(v);
        }
        let warming = helium.warming(excess, squared * (self.speed * self.speed));
        let temperature = helium.temperature + warming;
        if temperature <= 0.0 {
            return Err(Fault::new(FaultKind::Temperature, id));
        }
        write.square = A::Word::of_real(temperature * temperature);
        write.inverse = A::Word::of_real(1.0 / density);
        write.conducting = write.inverse;
        Ok(())
    }
}

/// Nothing has rubbed yet.
#[derive(Clone, Copy, Debug)]
pub struct NotRubbed;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NotRubbed {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = Rubbed<T, D>;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[RUBBED];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], write: &mut Rubbed<A::Word, D>) -> Result<(), Fault> {
        *write = Rubbed::from_fn(|_| A::Word::ZERO);
        Ok(())
    }
}

/// v and u change by the impulse of friction; heats begin with what was conducted.
#[derive(Clone, Copy, Debug)]
pub struct Push {
    pub(super) helium: Helium,
    /// Whether u follows v.
    pub(super) pulls: bool,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Push {
    type Read<T: Copy> = Pushed<T, D>;
    type Write<T: Copy> = Moved<T, D>;
    const READ: &'static [usize] = &[RUBBED, NORMAL, ENTROPY];
    const WRITE: &'static [usize] = &[VELOCITY, COUNTERFLOW, COUNTERFLOW_COPY, RUBBING, HEAT];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Pushed<A::Word, D>,
        write: &mut Moved<A::Word, D>,
    ) -> Result<(), Fault> {
        let fault = Fault::new(FaultKind::VelocityRange, id);
        let inverse = read.normal.inverse.real();
        let excess = self.helium.entropy * (read.entropy.quanta() / ONE);
        let normal = self.helium.normal_fraction_at(excess);
        // Where there is no superfluid component, u means nothing and is left alone.
        let reduced = if self.pulls { root::<D>(inverse) } else { 0.0 };
        for d in 0..D {
            let impulse = read.rubbed.impulse[d];
            write.velocity[d] = write.velocity[d].plus(impulse);
            let pull = A::Word::ZERO.add_rounded(reduced * impulse.quanta());
            let pull = pull.ok_or(fault)?;
            write.counterflow[d] = write.counterflow[d].plus(pull);
            write.counterflow_copy[d] = write.counterflow_copy[d].plus(pull);
            let words = [
                write.velocity[d],
                write.counterflow[d],
                write.counterflow_copy[d],
            ];
            if !words.iter().all(|word| word.in_range()) {
                return Err(fault);
            }
            let before = read.normal.velocity[d].real();
            write.rubbing.before[d] = A::Word::of_real(before);
            // u follows v, so that v_n changes by Δv/χ_n.
            let middle = before + 0.5 * (impulse.quanta() / normal);
            write.rubbing.middle[d] = A::Word::of_real(middle);
        }
        write.rubbing.inverse = read.normal.inverse;
        write.heat = read.rubbed.heat;
        Ok(())
    }
}

/// The entropies that a heat makes, with which the energy (15) grows by it.
#[derive(Clone, Copy, Debug)]
pub struct Warm {
    pub(super) helium: Helium,
    /// A speed quantum, m/s.
    pub(super) speed: f64,
    /// A quantum of heat, J/kg.
    pub(super) heat: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Warm {
    type Read<T: Copy> = Heated<T, D>;
    type Write<T: Copy> = Entropies<T, D>;
    const READ: &'static [usize] = &[HEAT, COUNTERFLOW, DENSITY];
    const WRITE: &'static [usize] = &[ENTROPY, ENTROPY_COPY];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Heated<A::Word, D>,
        write: &mut Entropies<A::Word, D>,
    ) -> Result<(), Fault> {
        let fault = Fault::new(FaultKind::EntropyRange, id);
        let stretch = root::<D>(read.density.quanta() / ONE) * self.speed;
        let mut squared = 0.0;
        for w in &read.counterflow {
            let u = stretch * w.quanta();
            squared += u * u;
        }
        let excess = self.helium.entropy * (write.first.quanta() / ONE);
        let growth = self
            .helium
            .growth(excess, squared, read.heat.quanta() * self.heat);
        let quanta = growth / self.helium.entropy * ONE;
        let quanta = A::Word::ZERO.add_rounded(quanta).ok_or(fault)?;
        write.first = write.first.plus(quanta);
        write.second = write.second.plus(quanta);
        if write.first.in_range() && write.second.in_range() {
            Ok(())
        } else {
            Err(fault)
        }
    }
}

/// What friction and conduction need of a wall.
#[derive(Clone, Debug)]
pub struct WallNormal<const D: usize> {
    pub(super) parameters: HeliumParameters<D>,
    /// Id of the first particle of the walls.
    pub(super) first: u64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for WallNormal<D> {
    type Read<T: Copy> = T;
    type Write<T: Copy> = Beside<T, D>;
    const READ: &'static [usize] = &[DENSITY];
    const WRITE: &'static [usize] = &[NORMAL, RUBBING];
    fn at(&self, id: u64, density: &A::Word, write: &mut Beside<A::Word, D>) -> Result<(), Fault> {
        let p = &self.parameters;
        let part = p.wall_of(id - self.first);
        let inverse = 1.0 / (density.quanta() / ONE);
        let velocity = part.velocity.map(|v| v / p.scale.speed_quantum());
        let velocity = velocity.map(A::Word::of_real);
        let rough = A::Word::of_real(if part.rough { inverse } else { 0.0 });
        let temperature = p.helium.temperature;
        write.normal = Normal {
            velocity,
            square: A::Word::of_real(temperature * temperature),
            inverse: rough,
            conducting: A::Word::of_real(inverse * part.conduction),
        };
        write.rubbing = Rubbing {
            before: velocity,
            middle: velocity,
            inverse: rough,
        };
        Ok(())
    }
}

/// What walls take: the heat that they conduct, and J·v of what rubs against a lid.
#[derive(Clone, Copy, Debug)]
pub struct Take {
    /// The square of a speed quantum in quanta of what is taken.
    pub(super) work: f64,
    /// A quantum of heat in these.
    pub(super) heat: f64,
}

values! {
    /// What a wall receives, and how it moves.
    pub struct Received {
        rubbed: Rubbed<T, D>,
        normal: Normal<T, D>,
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Take {
    type Read<T: Copy> = Received<T, D>;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[RUBBED, NORMAL];
    const WRITE: &'static [usize] = &[TAKEN];
    fn at(&self, id: u64, read: &Received<A::Word, D>, taken: &mut A::Word) -> Result<(), Fault> {
        let mut work = 0.0;
        for (impulse, v) in read.rubbed.impulse.iter().zip(&read.normal.velocity) {
            work += impulse.quanta() * v.real();
        }
        let heat = read.rubbed.heat.quanta() * self.heat;
        let sum = taken.add_rounded(heat + work * self.work);
        *taken = sum
            .filter(|sum| sum.in_range())
            .ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}
