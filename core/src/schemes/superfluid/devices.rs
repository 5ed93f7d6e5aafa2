//! Heater and superleak, where helium has friction.
//!
//! The heater gives a particle, in a step, the heat Ẇ dt w_a/(m Σ w) per mass, where w is the
//! kernel at its distance from the heater: in all Ẇ dt, up to rounding. (Eq. (30) has the
//! convolution alone, whose sum over particles is Ẇ only about.)
//!
//! The superleak holds the normal component: after each half kick
//!
//! v ← v - (1 - E) χ_n v_n, E = exp(-κ φ/τ), φ = W/W(0) at the distance from a plate,
//!
//! with v_s fixed, which solves its equation of motion in (29), (30) for any κ/τ; here φ is a pure
//! number, so that τ is a time. The energy χ_n v_n² (1 - E²)/2 becomes heat of the particle.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III C.

use super::fields::{
    COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, ENTROPY, ENTROPY_COPY, HEAT, HEATING, ONE,
};
use super::helium::Helium;
use super::parameters::{Heater, Superleak};
use super::walls::metres;
use crate::fault::{Fault, FaultKind};
use crate::fields::{POSITION, VELOCITY};
use crate::kernel::WendlandC2;
use crate::number::{Arithmetic, Quantity, root, sqrt};
use crate::points::PointPass;
use crate::values;

/// The share of every particle in the heat: W/W(0), in quanta of sums.
#[derive(Clone, Debug)]
pub struct Weigh<const D: usize> {
    pub(super) heater: Heater<D>,
    /// A length quantum, m.
    pub(super) length: f64,
}

/// W/W(0) at a distance r, with the radius where it vanishes.
fn profile(r: f64, radius: f64) -> f64 {
    let kernel = WendlandC2::new(2, radius, 1.0);
    if r < radius {
        kernel.value(r) / kernel.value(0.0)
    } else {
        0.0
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Weigh<D> {
    type Read<T: Copy> = [T; D];
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[POSITION];
    const WRITE: &'static [usize] = &[HEATING];
    fn at(&self, id: u64, x: &[A::Word; D], share: &mut A::Word) -> Result<(), Fault> {
        let x = metres(x, self.length);
        let mut squared = 0.0;
        for (x, place) in x.iter().zip(&self.heater.place) {
            squared += (x - place) * (x - place);
        }
        let weight = profile(sqrt(squared), self.heater.radius);
        let word = A::Word::ZERO.add_rounded(weight * ONE);
        *share = word.ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}

/// Heats grow by the shares times a factor.
#[derive(Clone, Copy, Debug)]
pub struct Give {
    /// Quanta of heat for a quantum of a share.
    pub(super) factor: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Give {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[HEATING];
    const WRITE: &'static [usize] = &[HEAT];
    fn at(&self, id: u64, share: &A::Word, heat: &mut A::Word) -> Result<(), Fault> {
        let sum = heat.add_rounded(self.factor * share.quanta());
        *heat = sum.ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}

/// The superleak during a kick.
#[derive(Clone, Debug)]
pub struct Hold<const D: usize> {
    pub(super) leak: Superleak<D>,
    pub(super) helium: Helium,
    /// Duration of the kick over τ.
    pub(super) times: f64,
    /// A length quantum, m.
    pub(super) length: f64,
    /// A speed quantum, m/s.
    pub(super) speed: f64,
}

values! {
    /// Where a particle is, and how dense.
    pub struct There {
        position: [T; D],
        density: T,
    }

    /// All that moves or warms.
    pub struct Flow {
        velocity: [T; D],
        counterflow: [T; D],
        counterflow_copy: [T; D],
        entropy: T,
        entropy_copy: T,
    }
}

impl<const D: usize> Hold<D> {
    /// The distance of a place, m, from the plate.
    fn distance(&self, x: &[f64; D]) -> f64 {
        let mut squared = 0.0;
        for ((x, centre), half) in x.iter().zip(&self.leak.centre).zip(&self.leak.half) {
            let beyond = ((x - centre).abs() - half).max(0.0);
            squared += beyond * beyond;
        }
        sqrt(squared)
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Hold<D> {
    type Read<T: Copy> = There<T, D>;
    type Write<T: Copy> = Flow<T, D>;
    const READ: &'static [usize] = &[POSITION, DENSITY];
    const WRITE: &'static [usize] = &[
        VELOCITY,
        COUNTERFLOW,
        COUNTERFLOW_COPY,
        ENTROPY,
        ENTROPY_COPY,
    ];
    fn at(
        &self,
        id: u64,
        read: &There<A::Word, D>,
        write: &mut Flow<A::Word, D>,
    ) -> Result<(), Fault> {
        let x = metres(&read.position, self.length);
        let share = profile(self.distance(&x), self.leak.radius);
        if share <= 0.0 {
            return Ok(());
        }
        let kept = libm::exp(-(self.times * share));
        let density = read.density.quanta() / ONE;
        let (stretch, reduced) = (root::<D>(density), root::<D>(1.0 / density));
        let entropies = write.entropy.quanta() + write.entropy_copy.quanta();
        let excess = self.helium.entropy * (0.5 * entropies / ONE);
        let normal = self.helium.normal_fraction_at(excess);
        let fault = Fault::new(FaultKind::VelocityRange, id);
        let [mut normal_squared, mut flow_squared] = [0.0; 2];
        for d in 0..D {
            let both = write.counterflow[d].quanta() + write.counterflow_copy[d].quanta();
            let u = stretch * (0.5 * both);
            // χ_n v_n = χ_n v + χ_s u.
            let momentum = normal * write.velocity[d].quanta() + (1.0 - normal) * u;
            let impulse = -((1.0 - kept) * momentum);
            let of_normal = momentum / normal * self.speed;
            normal_squared += of_normal * of_normal;
            let after = (u + impulse) * self.speed;
            flow_squared += after * after;
            let words = [
                (&mut write.velocity[d], impulse),
                (&mut write.counterflow[d], reduced * impulse),
                (&mut write.counterflow_copy[d], reduced * impulse),
            ];
            for (word, change) in words {
                let sum = word.add_rounded(change);
                *word = sum.filter(|sum| sum.in_range()).ok_or(fault)?;
            }
        }
        let heat = 0.5 * normal * normal_squared * (1.0 - kept * kept);
        let growth = self.helium.growth(excess, flow_squared, heat);
        let quanta = growth / self.helium.entropy * ONE;
        for word in [&mut write.entropy, &mut write.entropy_copy] {
            let sum = word.add_rounded(quanta).filter(|sum| sum.in_range());
            *word = sum.ok_or(Fault::new(FaultKind::EntropyRange, id))?;
        }
        Ok(())
    }
}
