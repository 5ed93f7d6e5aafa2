//! Kicks and drifts: how forces and velocities enter the state.
//!
//! - kick(c):  v ← v + J, J = R(c dt g) + Σ R(pressure term) + Σ R(repulsion) + Σ R(wall term)
//! - drift(c): x ← x + R(c dt v)
//!
//! dt is the time step, c the entry of the integrator table.

use super::forces::Forces;
use super::passes::{DensityPass, PressurePass};
use super::state_equation::StateEquation;
use crate::chain::{Chain, ChainSet, ChainSums, nothing};
use crate::executor::{Executor, Ids, Targets};
use crate::fault::{Fault, FaultKind};
use crate::number::{Arithmetic, Quantity, Real};
use crate::state::{State, System};

/// -κ m p/ρ² as a function of ρ/ρ0, in the units of [`PressurePass`].
#[derive(Clone, Copy, Debug)]
struct PressureFactor<R> {
    factor: R,
    state_equation: StateEquation,
}

impl<R: Real> PressureFactor<R> {
    #[inline]
    fn at(&self, relative_density: R, id: u64) -> Result<R, Fault> {
        if relative_density > R::from_f64(0.0) {
            let equation = self.state_equation;
            Ok(self.factor * equation.pressure_over_density_squared(relative_density))
        } else {
            Err(Fault::new(FaultKind::DensityNotPositive, id))
        }
    }
}

/// ρ_i = Σ m W + C_a, and with it the impulses of gravity and pressure.
struct DensitiesAndImpulses<'a, A: Arithmetic, const D: usize> {
    forces: &'a Forces<A, D>,
    first: DensityPass<A::Real>,
    second: PressurePass<A::Real>,
    pressure: PressureFactor<A::Real>,
    uniform: Option<[A::Speed; D]>,
    duration: f64,
    id: &'a [u64],
    position: &'a [[A::Length; D]],
    constant: &'a [A::Density],
}

impl<A: Arithmetic, const D: usize> Chain<A, D, 1, 1, D> for DensitiesAndImpulses<'_, A, D> {
    type FirstSum = A::Density;
    type Word = A::Real;
    type SecondSum = A::Speed;
    type First = DensityPass<A::Real>;
    type Second = PressurePass<A::Real>;

    fn first(&self) -> &Self::First {
        &self.first
    }
    fn second(&self) -> &Self::Second {
        &self.second
    }
    #[inline]
    fn start(&self, _: usize) -> [A::Density; 1] {
        [self.forces.own_density()]
    }
    #[inline]
    fn finish(&self, i: usize, [sum]: [A::Density; 1]) -> [A::Density; 1] {
        [sum.plus(self.constant[i])]
    }
    #[inline]
    fn between(&self, i: usize, [density]: &[A::Density; 1]) -> Result<[A::Real; 1], Fault> {
        let relative = self.forces.relative_density(*density);
        Ok([self.pressure.at(relative, self.id[i])?])
    }
    #[inline]
    fn resume(&self, i: usize) -> Result<[A::Speed; D], Fault> {
        self.forces
            .gravity(self.uniform, &self.position[i], self.duration)
            .ok_or_else(|| Fault::new(FaultKind::TermRange, self.id[i]))
    }
}

impl<A: Arithmetic, const D: usize> Forces<A, D> {
    /// Uniform gravity in a kick of `duration` seconds, in speed quanta; `None` out of range.
    fn uniform_gravity(&self, duration: f64) -> Option<[A::Speed; D]> {
        let s = self.parameters().scale;
        let mut impulse = [A::Speed::ZERO; D];
        for (i, g) in impulse.iter_mut().zip(self.parameters().gravity.uniform) {
            *i = i.add_rounded(duration * g / s.speed_quantum())?;
        }
        Some(impulse)
    }

    /// The uniform one and, where there is one, the attraction of a mass at this position.
    #[inline]
    fn gravity(
        &self,
        uniform: Option<[A::Speed; D]>,
        x: &[A::Length; D],
        duration: f64,
    ) -> Option<[A::Speed; D]> {
        if self.parameters().gravity.central.is_none() {
            return uniform;
        }
        self.central_gravity(uniform?, x, duration)
    }

    /// Adds the attraction of a mass.
    fn central_gravity(
        &self,
        mut impulse: [A::Speed; D],
        x: &[A::Length; D],
        duration: f64,
    ) -> Option<[A::Speed; D]> {
        let s = self.parameters().scale;
        if let Some(central) = &self.parameters().gravity.central {
            let soft = central.softening / s.length_quantum();
            let (x_ic, r2) = crate::pairs::separation::<A, D>(x, self.centre());
            let r2 = r2.to_f64() + soft * soft;
            let units = s.length_quantum() * s.length_quantum() * s.speed_quantum();
            let factor = (duration * central.strength / units) / (r2 * libm::sqrt(r2));
            for (i, x) in impulse.iter_mut().zip(x_ic) {
                *i = i.add_rounded(-(factor * x.to_f64()))?;
            }
        }
        Some(impulse)
    }

    /// Fills the scratch with the impulses of a kick of `c` time steps, from its densities.
    fn impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        let duration = c * self.parameters().time_step;
        self.pressures(system, exec, duration)?;
        let impulse = core::mem::take(&mut system.scratch.impulse);
        let result = self.sum_impulses(system, exec, duration, impulse);
        system.scratch.impulse = impulse;
        result
    }

    fn sum_impulses<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        duration: f64,
        impulse: &mut [[A::Speed; D]],
    ) -> Result<(), Fault> {
        let State { id, position, .. } = &system.state;
        let uniform = self.uniform_gravity(duration);
        exec.for_each(impulse, |i, out| {
            *out = self
                .gravity(uniform, &position[i], duration)
                .ok_or_else(|| Fault::new(FaultKind::TermRange, id[i]))?;
            Ok(())
        })?;
        let pressure = system.scratch.pressure.as_chunks().0;
        let mut to = Targets {
            position,
            read: pressure,
            id: Ids::Listed(id),
            same_set: true,
        };
        let pass = self.pressure_pass();
        exec.sum(&pass, &to, &self.fluid(system, pressure), impulse)?;
        if self.has_dummies(system) {
            to.same_set = false;
            let walls = self.walls(system, system.scratch.wall_pressure.as_chunks().0);
            exec.sum(&pass, &to, &walls, impulse)?;
        }
        self.add_short_impulses(system, exec, duration, impulse)
    }

    /// Adds the impulses of very near particles, if they repel each other.
    fn add_anti_clump_impulses<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        duration: f64,
        impulse: &mut [[A::Speed; D]],
    ) -> Result<(), Fault> {
        let Some(pass) = self.anti_clump_pass(duration) else {
            return Ok(());
        };
        let mut to = Targets {
            position: &*system.state.position,
            read: nothing(),
            id: Ids::Listed(system.state.id),
            same_set: true,
        };
        exec.sum(&pass, &to, &self.fluid(system, nothing()), impulse)?;
        if self.has_dummies(system) {
            to.same_set = false;
            exec.sum(&pass, &to, &self.walls(system, nothing()), impulse)?;
        }
        Ok(())
    }

    /// Adds the impulses of the conservative wall, if there is one, and of very near particles.
    fn add_short_impulses<E: Executor>(
        &self,
        system: &System<'_, A, D>,
        exec: &E,
        duration: f64,
        impulse: &mut [[A::Speed; D]],
    ) -> Result<(), Fault> {
        self.add_anti_clump_impulses(system, exec, duration, impulse)?;
        let Some(pass) = self.wall_pass(duration) else {
            return Ok(());
        };
        let to = Targets {
            position: &*system.state.position,
            read: nothing(),
            id: Ids::Listed(system.state.id),
            same_set: false,
        };
        exec.sum(&pass, &to, &self.walls(system, nothing()), impulse)
    }

    /// Densities at these positions and the impulses of a kick of `c` time steps, in one go; not
    /// for dummy walls, whose densities stand in between.
    pub(super) fn densities_and_impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        let duration = c * self.parameters().time_step;
        let scratch = &mut system.scratch;
        let density = core::mem::take(&mut scratch.density);
        let pressure = core::mem::take(&mut scratch.pressure);
        let impulse = core::mem::take(&mut scratch.impulse);
        let State {
            id,
            position,
            density: constant,
            ..
        } = &system.state;
        let chain = DensitiesAndImpulses {
            forces: self,
            first: self.density_pass(),
            second: self.pressure_pass(),
            pressure: self.pressure_factor(duration),
            uniform: self.uniform_gravity(duration),
            duration,
            id,
            position,
            constant,
        };
        let set = ChainSet {
            grid: self.grid(),
            cells: system.scratch.cells.view(),
            position,
            id,
        };
        let sums = ChainSums {
            first: density.as_chunks_mut().0,
            words: pressure.as_chunks_mut().0,
            second: &mut *impulse,
        };
        let result = exec
            .chain(&chain, &set, sums)
            .and_then(|()| self.add_short_impulses(system, exec, duration, impulse));
        let scratch = &mut system.scratch;
        scratch.density = density;
        scratch.pressure = pressure;
        scratch.impulse = impulse;
        result?;
        system.progress.density_current = true;
        system.progress.impulse_for = Some(c.to_bits());
        Ok(())
    }

    /// -κ m p/ρ² of fluid and dummies, in the units of [`PressurePass`].
    fn pressures<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        duration: f64,
    ) -> Result<(), Fault> {
        let of = self.pressure_factor(duration);
        let of = |density, id| of.at(self.relative_density(density), id);
        let dummies = self.has_dummies(system);
        let n = system.state.len() as u64;
        let System { state, scratch, .. } = system;
        let (density, id) = (&*scratch.density, &*state.id);
        exec.for_each(scratch.pressure, |i, out| {
            *out = of(density[i], id[i])?;
            Ok(())
        })?;
        if dummies {
            let density = &*scratch.wall_density;
            exec.for_each(scratch.wall_pressure, |i, out| {
                *out = of(density[i], n + i as u64)?;
                Ok(())
            })?;
        }
        Ok(())
    }

    fn pressure_factor(&self, duration: f64) -> PressureFactor<A::Real> {
        let p = self.parameters();
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        let factor = (duration * p.mass) * (p.sound_speed * p.sound_speed / p.reference_density);
        PressureFactor {
            factor: A::Real::from_f64(-(factor * units)),
            state_equation: p.state_equation,
        }
    }

    /// v ← v + R(c dt a), from the densities in the scratch. Impulses are kept until a drift: two
    /// kicks of the same share at the same positions add the same integers.
    pub(super) fn kick<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        self.update_impulses(system, exec, c)?;
        let State { id, velocity, .. } = &mut system.state;
        let (id, impulse) = (&**id, &*system.scratch.impulse);
        exec.for_each(velocity, |i, v| kicked(v, &impulse[i], id[i]))
    }

    fn update_impulses<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        if system.progress.impulse_for != Some(c.to_bits()) {
            system.progress.impulse_for = None;
            self.impulses(system, exec, c)?;
            system.progress.impulse_for = Some(c.to_bits());
        }
        Ok(())
    }

    /// Length quanta of a drift of `c` time steps with one speed quantum.
    fn drift_factor(&self, c: f64) -> A::Real {
        let s = self.parameters().scale;
        let units = s.speed_quantum() / s.length_quantum();
        A::Real::from_f64((c * self.parameters().time_step) * units)
    }

    /// x ← x + R(c dt v).
    pub(super) fn drift<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        c: f64,
    ) -> Result<(), Fault> {
        system.progress.impulse_for = None;
        system.progress.density_current = false;
        let factor = self.drift_factor(c);
        let State {
            id,
            position,
            velocity,
            ..
        } = &mut system.state;
        let (id, velocity) = (&**id, &**velocity);
        exec.for_each(position, |i, x| drifted(x, &velocity[i], factor, id[i]))
    }

    /// A kick and the drift after it, in one go through the particles. With `owed`, the same kick is
    /// added twice: the step that has just been counted still owes it.
    pub(super) fn kick_and_drift<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        kick: f64,
        owed: bool,
        drift: f64,
    ) -> Result<(), Fault> {
        self.update_impulses(system, exec, kick)?;
        system.progress.impulse_for = None;
        system.progress.density_current = false;
        let factor = self.drift_factor(drift);
        let State {
            id,
            position,
            velocity,
            ..
        } = &mut system.state;
        let (id, impulse) = (&**id, &*system.scratch.impulse);
        let counted = system.progress.step;
        exec.for_both(position, velocity, |i, x, v| {
            if owed {
                kicked(v, &impulse[i], id[i]).map_err(|fault| fault.at_step(counted))?;
            }
            kicked(v, &impulse[i], id[i])
                .and_then(|()| drifted(x, v, factor, id[i]))
                .map_err(|fault| fault.at_step(counted + 1))
        })
    }
}

/// v ← v + J.
#[inline]
fn kicked<Q: Quantity, const D: usize>(v: &mut [Q; D], j: &[Q; D], id: u64) -> Result<(), Fault> {
    let mut inside = true;
    for (v, j) in v.iter_mut().zip(j) {
        *v = v.plus(*j);
        inside &= v.in_range();
    }
    if inside {
        Ok(())
    } else {
        Err(Fault::new(FaultKind::VelocityRange, id))
    }
}

/// x ← x + R(factor v).
#[inline]
fn drifted<R: Real, X: Quantity, V: Quantity, const D: usize>(
    x: &mut [X; D],
    v: &[V; D],
    factor: R,
    id: u64,
) -> Result<(), Fault> {
    let mut inside = true;
    for (x, v) in x.iter_mut().zip(v) {
        let moved = x.add_rounded(v.quanta::<R>() * factor);
        inside &= moved.is_some_and(Quantity::in_range);
        *x = moved.unwrap_or(*x);
    }
    if inside {
        Ok(())
    } else {
        Err(Fault::new(FaultKind::PositionRange, id))
    }
}
