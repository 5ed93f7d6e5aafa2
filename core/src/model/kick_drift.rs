//! Kicks and drifts: how forces and velocities enter the state.
//!
//! - kick(c):  v ← v + J, J = R(c dt g) + Σ R(pressure term) + Σ R(repulsion) + Σ R(wall term)
//! - drift(c): x ← x + R(c dt v)
//!
//! dt is the time step, c the entry of the integrator table.

use super::forces::{Forces, nothing};
use crate::executor::{Executor, Ids, Targets};
use crate::fault::{Fault, FaultKind};
use crate::number::{Arithmetic, Quantity, Real};
use crate::state::{State, System};

impl<A: Arithmetic, const D: usize> Forces<A, D> {
    /// Gravity in a kick of `duration` seconds at this position, in speed quanta.
    fn gravity(&self, x: &[A::Length; D], duration: f64) -> Option<[A::Speed; D]> {
        let s = self.parameters().scale;
        let mut impulse = [A::Speed::ZERO; D];
        for (i, g) in impulse.iter_mut().zip(self.parameters().gravity.uniform) {
            *i = i.add_rounded(duration * g / s.speed_quantum())?;
        }
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
        exec.for_each(impulse, |i, out| {
            *out = self
                .gravity(&position[i], duration)
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
        if let Some(pass) = self.anti_clump_pass(duration) {
            let mut to = Targets {
                position,
                read: nothing(),
                id: Ids::Listed(id),
                same_set: true,
            };
            exec.sum(&pass, &to, &self.fluid(system, nothing()), impulse)?;
            if self.has_dummies(system) {
                to.same_set = false;
                exec.sum(&pass, &to, &self.walls(system, nothing()), impulse)?;
            }
        }
        if let Some(pass) = self.wall_pass(duration) {
            let to = Targets {
                position,
                read: nothing(),
                id: Ids::Listed(id),
                same_set: false,
            };
            exec.sum(&pass, &to, &self.walls(system, nothing()), impulse)?;
        }
        Ok(())
    }

    /// -κ m p/ρ² of fluid and dummies, in the units of [`PressurePass`].
    fn pressures<E: Executor>(
        &self,
        system: &mut System<'_, A, D>,
        exec: &E,
        duration: f64,
    ) -> Result<(), Fault> {
        let p = self.parameters();
        let units = p.scale.length_quantum() / p.scale.speed_quantum();
        let factor = (duration * p.mass) * (p.sound_speed * p.sound_speed / p.reference_density);
        let factor = A::Real::from_f64(-(factor * units));
        let of = |density: A::Density, id: u64| {
            let x = self.relative_density(density);
            if x > A::Real::from_f64(0.0) {
                Ok(factor * p.state_equation.pressure_over_density_squared(x))
            } else {
                Err(Fault::new(FaultKind::DensityNotPositive, id))
            }
        };
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

    /// v ← v + R(c dt a), from the densities in the scratch. Impulses are kept until a drift: two
    /// kicks of the same share at the same positions add the same integers.
    pub(super) fn kick<E: Executor>(
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
        let State { id, velocity, .. } = &mut system.state;
        let (id, impulse) = (&**id, &*system.scratch.impulse);
        exec.for_each(velocity, |i, v| {
            for (v, j) in v.iter_mut().zip(impulse[i]) {
                *v = v.plus(j);
            }
            if v.iter().all(|v| v.in_range()) {
                Ok(())
            } else {
                Err(Fault::new(FaultKind::VelocityRange, id[i]))
            }
        })
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
        let s = self.parameters().scale;
        let units = s.speed_quantum() / s.length_quantum();
        let factor = A::Real::from_f64((c * self.parameters().time_step) * units);
        let State {
            id,
            position,
            velocity,
            ..
        } = &mut system.state;
        let (id, velocity) = (&**id, &**velocity);
        exec.for_each(position, |i, x| {
            let mut inside = true;
            for (x, v) in x.iter_mut().zip(&velocity[i]) {
                let moved = x.add_rounded(v.quanta::<A::Real>() * factor);
                inside &= moved.is_some_and(Quantity::in_range);
                *x = moved.unwrap_or(*x);
            }
            if inside {
                Ok(())
            } else {
                Err(Fault::new(FaultKind::PositionRange, id[i]))
            }
        })
    }
}
