//! Walls of a superfluid: dummy particles that stand still.
//!
//! They take part in densities, in the velocity gradient with the velocity 0, and in pressures,
//!
//! - ϱ_b = C_b + Σ V0 W over the liquid, P_b = u_1² (ϱ_b - 1)/ϱ_b²
//! - J_a: -κ Σ V0 (W'/r) ((P_a + P_b) x_ab + u_a (q_a·x_ab)/ϱ_a)
//!
//! where the last term is the momentum of the counterflow that the velocity gradient calls for, so
//! that energy is kept; a counterflow along the wall carries none. It is v_s that it acts on: u is
//! a matter of the liquid alone, and no entropy passes, as at a free surface. Friction and
//! conduction are those of [`friction`](super::friction).
//!
//! C_b makes ϱ_b 1 where the surroundings are full: where Σ V0 W over walls and the liquid is what is
//! given as the first C_b, or more at the start. A wall that is dry at first then does not repel what
//! comes: beside a dry place ϱ_b is less than 1, and a wall that must not pull has no pressure there.
//! Where nothing is given, the first surroundings are full.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III C, where walls
//! take part in "density and pressure computation"; the rest is ours.

use super::fields::{CARRIER, DENSITY, DENSITY_CONSTANT, ONE};
use super::helium::Helium;
use super::parameters::HeliumParameters;
use super::passes::Carrier;
use crate::fault::{Fault, FaultKind};
use crate::fields::POSITION;
use crate::kernel::Reach;
use crate::number::{Arithmetic, Lanes, Quantity, Word};
use crate::pairs::{PairPass, Parity};
use crate::points::PointPass;
use crate::values;
use crate::values::Values;

/// Σ V0 W.
#[derive(Clone, Copy, Debug)]
pub struct DensityPass {
    pub(super) reach: Reach,
    /// V0 in units that make densities quanta of sums.
    pub(super) volume: f64,
}

impl<const D: usize> PairPass<D> for DensityPass {
    type Read<T: Copy> = [T; 0];
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, _: &[f64; 0]) -> f64 {
        1.001 * self.reach.largest_value() * self.volume
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, _: &[L; D], q: L, _: &[L; 0], _: &[L; 0]) -> L {
        self.reach.kernel.value_at(q) * q.splat(self.volume)
    }
}

/// Pressures, and the momentum of the counterflow of the receiver alone.
#[derive(Clone, Copy, Debug)]
pub struct PressurePass {
    pub(super) reach: Reach,
    /// κ V0 in units that make it speed quanta.
    pub(super) pressing: f64,
    /// -κ V0/2, or the whole of it where there is one copy, in units that make it speed quanta.
    pub(super) momentum: f64,
}

impl<const D: usize> PairPass<D> for PressurePass {
    type Read<T: Copy> = Carrier<T, D>;
    type Term<T: Copy> = [T; D];
    // The liquid receives of walls; where it receives of itself there is no counterflow.
    const PARITY: [Parity; D] = [Parity::Antisymmetric; D];
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, most: &Carrier<f64, D>) -> f64 {
        let u = most.counterflow.iter().fold(0.0, |a: f64, u| a.max(*u));
        let momentum = u * u * most.weight * D as f64 * self.momentum.abs();
        let pressure = 2.0 * most.pressure * self.pressing.abs();
        1.001 * (momentum + pressure) * self.reach.largest_slope()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &Carrier<L, D>, j: &Carrier<L, D>) -> [L; D] {
        let slope = self.reach.kernel.derivative_over_r_at(q);
        let mut along = i.counterflow[0] * x_ij[0];
        for (u, x) in i.counterflow.iter().zip(x_ij).skip(1) {
            along = along + *u * *x;
        }
        let momentum = slope * q.splat(self.momentum) * (i.weight * along);
        let pressure = slope * q.splat(self.pressing) * (i.pressure + j.pressure);
        let mut impulse = *x_ij;
        for (impulse, u) in impulse.iter_mut().zip(&i.counterflow) {
            *impulse = momentum * *u - pressure * *impulse;
        }
        impulse
    }
}

/// ϱ begins with nothing.
#[derive(Clone, Copy, Debug)]
pub struct NoDensity;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for NoDensity {
    type Read<T: Copy> = [T; 0];
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[];
    const WRITE: &'static [usize] = &[DENSITY];
    #[inline(always)]
    fn at(&self, _: u64, _: &[A::Word; 0], density: &mut A::Word) -> Result<(), Fault> {
        *density = A::Word::ZERO;
        Ok(())
    }
}

/// ϱ ← ϱ + C.
#[derive(Clone, Copy, Debug)]
pub struct AddConstant;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for AddConstant {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[DENSITY_CONSTANT];
    const WRITE: &'static [usize] = &[DENSITY];
    #[inline(always)]
    fn at(&self, id: u64, constant: &A::Word, density: &mut A::Word) -> Result<(), Fault> {
        *density = density.plus(*constant);
        if density.quanta() > 0.0 {
            Ok(())
        } else {
            Err(Fault::new(FaultKind::DensityNotPositive, id))
        }
    }
}

/// C_b ← what walls add to each other's densities, less that of full surroundings.
#[derive(Clone, Copy, Debug)]
pub struct KeepDensity;

impl<A: Arithmetic, const D: usize> PointPass<A, D> for KeepDensity {
    type Read<T: Copy> = T;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[DENSITY];
    const WRITE: &'static [usize] = &[DENSITY_CONSTANT];
    #[inline(always)]
    fn at(&self, _: u64, density: &A::Word, constant: &mut A::Word) -> Result<(), Fault> {
        *constant = density.plus(constant.negated());
        Ok(())
    }
}

values! {
    /// Density and place of a particle of a wall.
    pub struct Placed {
        density: T,
        position: [T; D],
    }
}

/// C_b ← 1 + p/(ρ0 u_1²) + C_b, with the first pressure p; less what the first surroundings are
/// fuller than full.
#[derive(Clone, Debug)]
pub struct SetWallConstant<const D: usize> {
    pub(super) parameters: HeliumParameters<D>,
}

/// A position in m.
pub(super) fn metres<W: Quantity, const D: usize>(x: &[W; D], quantum: f64) -> [f64; D] {
    x.map(|x| x.quanta() * quantum)
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for SetWallConstant<D> {
    type Read<T: Copy> = Placed<T, D>;
    type Write<T: Copy> = T;
    const READ: &'static [usize] = &[DENSITY, POSITION];
    const WRITE: &'static [usize] = &[DENSITY_CONSTANT];
    fn at(&self, id: u64, read: &Placed<A::Word, D>, constant: &mut A::Word) -> Result<(), Fault> {
        let p = &self.parameters;
        let beyond = (constant.quanta() + read.density.quanta()).max(0.0);
        let x = metres(&read.position, p.scale.length_quantum());
        let first = (1.0 + p.first_compression(&x)) * ONE;
        let sum = constant.add_rounded(first - beyond);
        *constant = sum.ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}

/// What sums over pairs need of a wall: its pressure.
#[derive(Clone, Copy, Debug)]
pub struct CarryWall {
    pub(super) helium: Helium,
    /// Whether it pulls.
    pub(super) suction: bool,
    /// 1, or 0 where there are no pressures.
    pub(super) pressed: f64,
}

/// ϱ - 1 as a wall feels it.
pub(super) fn felt_compression(compression: f64, suction: bool) -> f64 {
    if suction {
        compression
    } else {
        compression.max(0.0)
    }
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for CarryWall {
    type Read<T: Copy> = T;
    type Write<T: Copy> = Carrier<T, D>;
    const READ: &'static [usize] = &[DENSITY];
    const WRITE: &'static [usize] = &[CARRIER];
    fn at(
        &self,
        _: u64,
        density: &A::Word,
        carrier: &mut Carrier<A::Word, D>,
    ) -> Result<(), Fault> {
        let compression = felt_compression((density.quanta() - ONE) / ONE, self.suction);
        let inverse = 1.0 / (density.quanta() / ONE);
        let sound = self.helium.sound_speed * self.helium.sound_speed;
        let pressure = self.pressed * (sound * (compression * (inverse * inverse)));
        *carrier = Carrier::from_fn(|_| A::Word::of_real(0.0));
        carrier.pressure = A::Word::of_real(pressure);
        Ok(())
    }
}
