//! What fluxes need of a particle, and what kicks and lifts do to it.

use super::super::fields::{
    CARRIER, COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, ENTROPY, ENTROPY_COPY, FLUXES, GRADIENT,
    INFLOW, INVERSE, ONE, ONE_RATE, PULL, RATES,
};
use super::super::helium::Helium;
use super::super::passes::{Carrier, Fluxes};
use crate::fault::{Fault, FaultKind};
use crate::fields::{IMPULSE, VELOCITY};
use crate::lift::lift;
use crate::matrix::trace;
use crate::number::{Arithmetic, Quantity, Word, root};
use crate::points::PointPass;
use crate::values;
use crate::values::Symmetric;

values! {
    /// What a carrier follows from.
    pub struct Flowing {
        counterflow: [T; D],
        entropy: T,
        density: T,
        inverse: Symmetric<T, D>,
        velocity: [T; D],
    }

    /// What a kick follows from.
    pub struct Summed {
        fluxes: Fluxes<T, D>,
        carrier: Carrier<T, D>,
        inverse: Symmetric<T, D>,
        entropy: T,
        density: T,
    }

    /// What a kick adds.
    pub struct Added {
        impulse: [T; D],
        pull: [T; D],
        inflow: T,
    }

    /// What a kick changes.
    pub struct Kicked {
        velocity: [T; D],
        counterflow: [T; D],
        entropy: T,
    }

    /// A velocity gradient, as its two factors.
    pub struct Strain {
        gradient: [[T; D]; D],
        density: T,
    }

    /// What a lift changes.
    pub struct Copies {
        first: [T; D],
        second: [T; D],
    }

    /// Two velocities, or what is added to them.
    pub struct Two {
        velocity: [T; D],
        counterflow: [T; D],
    }
}

/// H̃⁻¹ x.
#[inline(always)]
fn applied<W: Word, const D: usize>(inverse: &Symmetric<W, D>, x: &[f64; D]) -> [f64; D] {
    let mut y = [0.0; D];
    for (y, row) in y.iter_mut().zip(&inverse.rows) {
        let mut sum = row[0].real() * x[0];
        for (a, x) in row.iter().zip(x).skip(1) {
            sum += a.real() * x;
        }
        *y = sum;
    }
    y
}

/// What fluxes need of a particle, from one copy or the other.
///
/// With `PAPER` the counterflow is u itself, and what is carried is v_n; else it is w = u ϱ^(-1/D),
/// and q is carried.
#[derive(Clone, Copy, Debug)]
pub struct Carry<const COPY: bool, const PAPER: bool> {
    pub(in super::super) helium: Helium,
    /// A speed quantum, m/s.
    pub(in super::super) speed: f64,
    /// What makes pressures those of the kick: 1, or 0 where there are none.
    pub(in super::super) pressed: f64,
}

impl<A: Arithmetic, const COPY: bool, const PAPER: bool, const D: usize> PointPass<A, D>
    for Carry<COPY, PAPER>
{
    type Read<T: Copy> = Flowing<T, D>;
    type Write<T: Copy> = Carrier<T, D>;
    const READ: &'static [usize] = if COPY {
        &[COUNTERFLOW_COPY, ENTROPY_COPY, DENSITY, INVERSE, VELOCITY]
    } else {
        &[COUNTERFLOW, ENTROPY, DENSITY, INVERSE, VELOCITY]
    };
    const WRITE: &'static [usize] = &[CARRIER];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Flowing<A::Word, D>,
        write: &mut Carrier<A::Word, D>,
    ) -> Result<(), Fault> {
        let helium = &self.helium;
        let density = read.density.quanta() / ONE;
        let inverse = 1.0 / density;
        let relative = 1.0 + read.entropy.quanta() / ONE;
        let excess = helium.entropy * (read.entropy.quanta() / ONE);
        let normal = helium.normal_fraction_at(excess);
        if !(normal > 0.0 && normal <= 1.0) {
            return Err(Fault::new(FaultKind::NormalFraction, id));
        }
        let ratio = (1.0 - normal) / normal;
        let stretch = if PAPER { 1.0 } else { root::<D>(density) };
        let u = read.counterflow.map(|w| w.quanta() * stretch);
        let mut squared = u[0] * u[0];
        for u in &u[1..] {
            squared += u * u;
        }
        let mut carried = u.map(|u| ratio * u);
        let share = relative * inverse;
        let flux = applied(&read.inverse, &carried).map(|j| share * j);
        if PAPER {
            for (c, v) in carried.iter_mut().zip(&read.velocity) {
                *c += v.quanta();
            }
        }
        let warming = helium.warming(excess, squared * (self.speed * self.speed));
        if helium.temperature + warming <= 0.0 {
            return Err(Fault::new(FaultKind::Temperature, id));
        }
        let sound = helium.sound_speed * helium.sound_speed;
        let compression = (read.density.quanta() - ONE) / ONE;
        let pressure = self.pressed * (sound * (compression * (inverse * inverse)));
        write.counterflow = u.map(A::Word::of_real);
        write.weight = A::Word::of_real(ratio * inverse);
        write.carried = carried.map(A::Word::of_real);
        write.flux = flux.map(A::Word::of_real);
        write.warmth = A::Word::of_real(helium.entropy * warming);
        write.pressure = A::Word::of_real(pressure);
        Ok(())
    }
}

/// What a kick adds, from the sums: the impulse, the pull on the counterflow, and the entropy.
#[derive(Clone, Copy, Debug)]
pub struct Add<W, const COPY: bool, const PAPER: bool, const D: usize> {
    /// The pull of gravity, in speed quanta; none where it is out of range.
    pub(in super::super) fall: Option<[W; D]>,
}

impl<A: Arithmetic, const COPY: bool, const PAPER: bool, const D: usize> PointPass<A, D>
    for Add<A::Word, COPY, PAPER, D>
{
    type Read<T: Copy> = Summed<T, D>;
    type Write<T: Copy> = Added<T, D>;
    const READ: &'static [usize] = if COPY {
        &[FLUXES, CARRIER, INVERSE, ENTROPY_COPY, DENSITY]
    } else {
        &[FLUXES, CARRIER, INVERSE, ENTROPY, DENSITY]
    };
    const WRITE: &'static [usize] = &[IMPULSE, PULL, INFLOW];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Summed<A::Word, D>,
        write: &mut Added<A::Word, D>,
    ) -> Result<(), Fault> {
        let out = Fault::new(FaultKind::TermRange, id);
        let (fluxes, carrier) = (&read.fluxes, &read.carrier);
        let fall = self.fall.ok_or(out)?;
        for (d, fall) in fall.iter().enumerate() {
            // From each of two copies comes one half of the momentum; from a single one, all of it.
            let half = fluxes.momentum[d];
            let momentum = if PAPER { half.plus(half) } else { half };
            let own = momentum.plus(fluxes.pressure[d]);
            write.impulse[d] = own.plus(*fall);
        }
        write.inflow = fluxes.entropy;
        let u = carrier.counterflow.map(Word::real);
        let relative = 1.0 + read.entropy.quanta() / ONE;
        let warmed = applied(&read.inverse, &fluxes.warming.map(Quantity::quanta));
        let inverse = 1.0 / (read.density.quanta() / ONE);
        let reduced = if PAPER { 1.0 } else { root::<D>(inverse) };
        for (d, pull) in write.pull.iter_mut().enumerate() {
            let mut stretched = fluxes.stretching[d][0].quanta() * u[0];
            for (m, u) in fluxes.stretching[d].iter().zip(&u).skip(1) {
                stretched += m.quanta() * u;
            }
            let own = inverse * (stretched / ONE_RATE + relative * warmed[d]);
            let x = reduced * (2.0 * fluxes.momentum[d].quanta() + own);
            *pull = A::Word::ZERO.add_rounded(x).ok_or(out)?;
        }
        Ok(())
    }
}

/// The sum, and whether it is in range.
#[inline(always)]
fn sum<W: Quantity, const D: usize>(a: &[W; D], b: &[W; D]) -> ([W; D], bool) {
    let (mut out, mut inside) = (*a, true);
    for (a, b) in out.iter_mut().zip(b) {
        *a = a.plus(*b);
        inside &= a.in_range();
    }
    (out, inside)
}

/// v ← v + J, and with `COPY` W and S, else w and s, advance by what was prepared.
#[derive(Clone, Copy, Debug)]
pub struct Kick<const COPY: bool>;

impl<A: Arithmetic, const COPY: bool, const D: usize> PointPass<A, D> for Kick<COPY> {
    type Read<T: Copy> = Added<T, D>;
    type Write<T: Copy> = Kicked<T, D>;
    const READ: &'static [usize] = &[IMPULSE, PULL, INFLOW];
    const WRITE: &'static [usize] = if COPY {
        &[VELOCITY, COUNTERFLOW_COPY, ENTROPY_COPY]
    } else {
        &[VELOCITY, COUNTERFLOW, ENTROPY]
    };
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Added<A::Word, D>,
        write: &mut Kicked<A::Word, D>,
    ) -> Result<(), Fault> {
        let (velocity, slow) = sum(&write.velocity, &read.impulse);
        let (counterflow, slow_too) = sum(&write.counterflow, &read.pull);
        let entropy = write.entropy.plus(read.inflow);
        *write = Kicked {
            velocity,
            counterflow,
            entropy,
        };
        if !(slow && slow_too) {
            Err(Fault::new(FaultKind::VelocityRange, id))
        } else if entropy.in_range() {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::EntropyRange, id))
        }
    }
}

/// w ← w exp(c dt (N - (tr N/D) 1)), and W: with N = K/ϱ for the gradient of the velocity, both
/// follow the motion, and u its change of volume by ϱ.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// c.
    pub(in super::super) share: f64,
    /// The square of the largest |w - W|, in speed quanta.
    pub(in super::super) most_squared: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Stretch {
    type Read<T: Copy> = Strain<T, D>;
    type Write<T: Copy> = Copies<T, D>;
    const READ: &'static [usize] = &[GRADIENT, DENSITY];
    const WRITE: &'static [usize] = &[COUNTERFLOW, COUNTERFLOW_COPY];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Strain<A::Word, D>,
        write: &mut Copies<A::Word, D>,
    ) -> Result<(), Fault> {
        let factor = self.share / (ONE_RATE * (read.density.quanta() / ONE));
        let mut m = read.gradient.map(|row| row.map(|k| factor * k.quanta()));
        let mean = trace(&m) / D as f64;
        for (i, row) in m.iter_mut().enumerate() {
            row[i] -= mean;
        }
        let inside = lift(&mut write.first, &m) & lift(&mut write.second, &m);
        let mut apart = 0.0;
        for (first, second) in write.first.iter().zip(&write.second) {
            let difference = first.difference(*second);
            apart += difference * difference;
        }
        if !inside {
            Err(Fault::new(FaultKind::VelocityRange, id))
        } else if apart < self.most_squared {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::CopiesApart, id))
        }
    }
}

/// dv and du of half a step ← what was prepared.
#[derive(Clone, Copy, Debug)]
pub struct KeepRates;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for KeepRates {
    type Read<T: Copy> = Two<T, D>;
    type Write<T: Copy> = Two<T, D>;
    const READ: &'static [usize] = &[IMPULSE, PULL];
    const WRITE: &'static [usize] = &[RATES];
    #[inline(always)]
    fn at(&self, _: u64, read: &Two<A::Word, D>, write: &mut Two<A::Word, D>) -> Result<(), Fault> {
        *write = *read;
        Ok(())
    }
}

/// v and u advance by the rates.
#[derive(Clone, Copy, Debug)]
pub struct TakeRates;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for TakeRates {
    type Read<T: Copy> = Two<T, D>;
    type Write<T: Copy> = Two<T, D>;
    const READ: &'static [usize] = &[RATES];
    const WRITE: &'static [usize] = &[VELOCITY, COUNTERFLOW];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Two<A::Word, D>,
        write: &mut Two<A::Word, D>,
    ) -> Result<(), Fault> {
        let (velocity, slow) = sum(&write.velocity, &read.velocity);
        let (counterflow, slow_too) = sum(&write.counterflow, &read.counterflow);
        *write = Two {
            velocity,
            counterflow,
        };
        if slow && slow_too {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::VelocityRange, id))
        }
    }
}

/// s ← s + what flows in.
#[derive(Clone, Copy, Debug)]
pub struct Flow;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Flow {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[INFLOW];
    const WRITE: &'static [usize] = &[ENTROPY];
    #[inline(always)]
    fn at(&self, id: u64, inflow: &A::Word, entropy: &mut A::Word) -> Result<(), Fault> {
        *entropy = entropy.plus(*inflow);
        if entropy.in_range() {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::EntropyRange, id))
        }
    }
}
