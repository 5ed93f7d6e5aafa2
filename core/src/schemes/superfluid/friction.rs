//! Friction of the normal component and diffusion of heat, which make a superfluid dissipative.
//!
//! After every step of the reversible scheme the two copies of the state are merged, and then, at
//! fixed positions and densities, with g = V0 W'/r and ϱ = ρ/ρ0,
//!
//! - v and u change by Δv = dt Σ 2 (D + 2) (μ/ρ0) g (v_n,ij·x_ij) x_ij/((r² + η²) ϱ_i ϱ_j)   (19)
//! - a particle receives the heat of conduction, dt Σ (β/ρ0) g (T_i² - T_j²)/(ϱ_i ϱ_j), per mass
//! - and of friction, half of what each pair loses, with the mean of v_n before and after:
//!   -dt Σ (D + 2) (μ/ρ0) g (v_n,ij·x_ij) (v̄_n,ij·x_ij)/((r² + η²) ϱ_i ϱ_j)
//! - s changes so that the energy (15) grows by that heat.
//!
//! v_s feels no friction. The energy of a particle changes by v̄_n·Δv, exactly, so nothing is lost
//! but by rounding. Heat instead of entropy is what is conducted: β g (T_i² - T_j²) is what the
//! paper's entropy flux 2 β g (T_i - T_j) and the production of its (23) come to together, and it is
//! the negative for the partner. (The second factor of (23) is printed twice too large.) η is a
//! tenth of the paper's h.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, sections II B and II D.

use super::fields::{
    COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, ENTROPY, ENTROPY_COPY, HEAT, NORMAL, ONE, ONE_WARMTH,
    RUBBED, RUBBING,
};
use super::helium::Helium;
use super::liquid::Liquid;
use super::parameters::HeliumParameters;
use super::reversible::Doubled;
use crate::executor::Executor;
use crate::fault::{Fault, FaultKind};
use crate::fields::{Side, VELOCITY};
use crate::integrator::Stage;
use crate::kernel::Reach;
use crate::model::{Dissipative, Model, Relax, SetupError};
use crate::number::{Arithmetic, Lanes, Quantity, Word, root};
use crate::pairs::{PairPass, Parity};
use crate::points::PointPass;
use crate::system::{Sum, System};
use crate::values;
use crate::values::Values;

/// Superfluid helium with friction.
pub type DissipativeSuperfluid<A, const D: usize> = Dissipative<Friction<A, D>>;

/// The friction, and the scheme between two of it.
#[derive(Clone, Debug)]
pub struct Friction<A: Arithmetic, const D: usize> {
    scheme: Doubled<A, D, true>,
}

values! {
    /// What friction needs of a particle.
    pub struct Normal {
        /// v_n, in speed quanta.
        velocity: [T; D],
        /// T², K².
        square: T,
        /// 1/ϱ.
        inverse: T,
    }

    /// What it gives.
    pub struct Rubbed {
        /// Δv, in speed quanta.
        impulse: [T; D],
        /// Conducted heat.
        heat: T,
    }

    /// What its heat needs.
    pub struct Rubbing {
        /// v_n before, in speed quanta.
        before: [T; D],
        /// The mean of v_n before and after.
        middle: [T; D],
        /// 1/ϱ.
        inverse: T,
    }

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
}

/// Impulses of friction and conducted heat.
#[derive(Clone, Copy, Debug)]
pub struct FrictionPass {
    reach: Reach,
    /// η², in squared length quanta.
    softening: f64,
    /// dt V0 2 (D + 2) μ/ρ0.
    friction: f64,
    /// dt V0 β/ρ0 in units that make heats their quanta.
    conduction: f64,
}

/// Heat of friction.
#[derive(Clone, Copy, Debug)]
pub struct HeatPass {
    of: FrictionPass,
    /// -dt V0 (D + 2) μ/ρ0 in units that make heats their quanta.
    heat: f64,
}

impl FrictionPass {
    /// W'/(r (r² + η²) ϱ_i ϱ_j), and the difference of two velocities along x_ij.
    #[inline(always)]
    fn factor<L: Lanes, const D: usize>(&self, x_ij: &[L; D], q: L, i: L, j: L) -> L {
        let mut r2 = x_ij[0] * x_ij[0];
        for x in &x_ij[1..] {
            r2 = r2 + *x * *x;
        }
        let slope = self.reach.kernel.derivative_over_r_at(q);
        slope * (i * j) / (r2 + q.splat(self.softening))
    }
}

/// (a - b)·x.
#[inline(always)]
fn along<L: Lanes, const D: usize>(x: &[L; D], a: &[L; D], b: &[L; D]) -> L {
    let mut sum = (a[0] - b[0]) * x[0];
    for d in 1..D {
        sum = sum + (a[d] - b[d]) * x[d];
    }
    sum
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |a: f64, x| a.max(*x))
}

impl<const D: usize> PairPass<D> for FrictionPass {
    type Read<T: Copy> = Normal<T, D>;
    type Term<T: Copy> = Rubbed<T, D>;
    const PARITY: Rubbed<Parity, D> = Rubbed {
        impulse: [Parity::Antisymmetric; D],
        heat: Parity::Antisymmetric,
    };
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.reach.squared
    }
    fn bound(&self, most: &Normal<f64, D>) -> f64 {
        // (v·x) x/(r² + η²) does not exceed D v.
        let slope = self.reach.kernel.derivative_over_r_at(0.0).abs();
        let shared = slope * most.inverse * most.inverse;
        let velocity = 2.0 * largest(&most.velocity) * D as f64 * self.friction;
        let heat = most.square * self.conduction;
        1.001 * shared * velocity.max(heat)
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(
        &self,
        x_ij: &[L; D],
        q: L,
        i: &Normal<L, D>,
        j: &Normal<L, D>,
    ) -> Rubbed<L, D> {
        let factor = self.factor(x_ij, q, i.inverse, j.inverse);
        let push = factor * along(x_ij, &i.velocity, &j.velocity) * q.splat(self.friction);
        let mut impulse = *x_ij;
        for x in &mut impulse {
            *x = push * *x;
        }
        let slope = self.reach.kernel.derivative_over_r_at(q) * (i.inverse * j.inverse);
        Rubbed {
            impulse,
            heat: slope * (i.square - j.square) * q.splat(self.conduction),
        }
    }
}

impl<const D: usize> PairPass<D> for HeatPass {
    type Read<T: Copy> = Rubbing<T, D>;
    type Term<T: Copy> = T;
    const PARITY: Parity = Parity::Symmetric;
    #[inline(always)]
    fn reach_squared(&self) -> f64 {
        self.of.reach.squared
    }
    fn bound(&self, most: &Rubbing<f64, D>) -> f64 {
        let slope = self.of.reach.kernel.derivative_over_r_at(0.0).abs();
        let speeds = 4.0 * largest(&most.before) * largest(&most.middle) * (D * D) as f64;
        1.001 * slope * most.inverse * most.inverse * speeds * self.heat.abs()
    }
    #[inline(always)]
    fn argument<L: Lanes>(&self, r2: L) -> L {
        self.of.reach.kernel.q(r2.root())
    }
    #[inline(always)]
    fn term<L: Lanes>(&self, x_ij: &[L; D], q: L, i: &Rubbing<L, D>, j: &Rubbing<L, D>) -> L {
        let factor = self.of.factor(x_ij, q, i.inverse, j.inverse);
        let before = along(x_ij, &i.before, &j.before);
        let middle = along(x_ij, &i.middle, &j.middle);
        factor * (before * middle) * q.splat(self.heat)
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
    helium: Helium,
    /// A speed quantum, m/s.
    speed: f64,
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
    helium: Helium,
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
        let reduced = root::<D>(inverse);
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
    helium: Helium,
    /// A speed quantum, m/s.
    speed: f64,
    /// A quantum of heat, J/kg.
    heat: f64,
}

impl Warm {
    /// By how much the excess of entropy grows, J/(kg K), where the energy grows by `heat`, J/kg.
    #[inline(always)]
    fn growth(&self, excess: f64, squared: f64, heat: f64) -> f64 {
        let helium = &self.helium;
        let capacity = helium.temperature / helium.heat_capacity;
        let first = helium.normal_fraction_at(excess);
        let mut growth = 0.0;
        // Newton's iteration: the energy is all but linear.
        for _ in 0..3 {
            let last = helium.normal_fraction_at(excess + growth);
            let thermal = growth * (helium.temperature + capacity * (excess + 0.5 * growth));
            let flow = 0.5 * squared * (helium.fraction_slope * growth / (first * last));
            let missing = heat - (thermal - flow);
            let warming = helium.warming(excess + growth, squared);
            growth += missing / (helium.temperature + warming);
        }
        growth
    }
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
        let growth = self.growth(excess, squared, read.heat.quanta() * self.heat);
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

/// The passes of helium with these parameters.
fn passes<const D: usize>(p: &HeliumParameters<D>, reach: Reach) -> (FrictionPass, HeatPass) {
    let (length, speed) = (p.scale.length_quantum(), p.scale.speed_quantum());
    // The paper's h is half of the support.
    let softening = p.support_radius / 20.0 / length;
    let share = p.time_step * p.volume() / p.helium.reference_density;
    let of_pair = share * (D as f64 + 2.0) * p.viscosity;
    let unit = heat_quantum(p);
    let friction = FrictionPass {
        reach,
        softening: softening * softening,
        friction: 2.0 * of_pair,
        conduction: share * p.diffusion / unit,
    };
    let heat = HeatPass {
        of: friction,
        heat: -of_pair * (speed * speed / unit),
    };
    (friction, heat)
}

/// J/kg.
fn heat_quantum<const D: usize>(p: &HeliumParameters<D>) -> f64 {
    p.heat_speed() * p.heat_speed() / ONE_WARMTH
}

impl<A: Arithmetic, const D: usize> Friction<A, D> {
    /// Helium with these parameters.
    ///
    /// # Errors
    /// A number out of range.
    pub fn superfluid(
        parameters: HeliumParameters<D>,
    ) -> Result<DissipativeSuperfluid<A, D>, SetupError> {
        let scheme = Doubled::new(parameters)?;
        Ok(Dissipative(Self { scheme }))
    }

    /// What all superfluid schemes share.
    #[must_use]
    pub fn liquid(&self) -> &Liquid<D> {
        self.scheme.liquid()
    }

    /// The sums of friction.
    #[must_use]
    pub fn friction_passes(&self) -> (FrictionPass, HeatPass) {
        passes(self.liquid().parameters(), self.liquid().reach())
    }
}

impl<A: Arithmetic, const D: usize> Relax<A, D> for Friction<A, D> {
    type Scheme = Doubled<A, D, true>;

    fn scheme(&self) -> &Doubled<A, D, true> {
        &self.scheme
    }

    fn stages(&self, step: u64) -> impl Iterator<Item = Stage> {
        self.scheme.stages(step).chain([Stage::Relax])
    }

    /// The kick before has left the sums over positions, and nothing moves here.
    fn relax<E: Executor>(&self, system: &mut System<'_, A, D>, exec: &E) -> Result<(), Fault> {
        let p = self.liquid().parameters();
        let (helium, speed) = (p.helium, p.scale.speed_quantum());
        let (friction, heat) = self.friction_passes();
        exec.points(&Merge, &mut system.particles)?;
        exec.points(&FindNormal { helium, speed }, &mut system.particles)?;
        exec.points(&NotRubbed, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, &[NORMAL], RUBBED);
        system.sum(exec, &friction, sum)?;
        exec.points(&Push { helium }, &mut system.particles)?;
        let sum = Sum::to_particles(Side::Particles, &[RUBBING], HEAT);
        system.sum(exec, &heat, sum)?;
        let warm = Warm {
            helium,
            speed,
            heat: heat_quantum(p),
        };
        exec.points(&warm, &mut system.particles)
    }
}
