//! Mutual friction of the two components.
//!
//! Where the components flow through each other, vortex lines of the superfluid one grow and
//! scatter the normal one. Between them acts a force of A ρ_s ρ_n |v_ns|² v_ns per volume, with
//! v_ns = v_n - v_s = u/χ_n; the liquid as a whole does not feel it, and
//!
//! du/dt = -A ρ |u/χ_n|² u  at fixed v, ρ and χ_n.
//!
//! Its solution after a time step is taken, which is stable for any A:
//!
//! u ← E u, E = 1/√(1 + 2 A ρ |u/χ_n|² dt).
//!
//! The energy (χ_s/χ_n) u² (1 - E²)/2 per mass that the counterflow loses becomes heat.
//!
//! Source: C. J. Gorter & J. H. Mellink, Physica 15 (1949) 285. W. F. Vinen, Proc. R. Soc. A 240
//! (1957) 114. The paper on superfluid helium has no such force.

use super::super::fields::{COUNTERFLOW, COUNTERFLOW_COPY, DENSITY, ENTROPY, HEAT, ONE};
use super::super::helium::Helium;
use crate::fault::{Fault, FaultKind};
use crate::number::{Arithmetic, Quantity, root, sqrt};
use crate::points::PointPass;
use crate::values;

values! {
    /// Where the components are.
    pub struct Here {
        density: T,
        entropy: T,
    }

    /// What is slowed, and the heat of it.
    pub struct Slowed {
        counterflow: [T; D],
        counterflow_copy: [T; D],
        heat: T,
    }
}

/// Mutual friction during a time step.
#[derive(Clone, Copy, Debug)]
pub struct Mutual {
    pub(super) helium: Helium,
    /// 2 A ρ0 dt, s²/m².
    pub(super) strength: f64,
    /// A speed quantum, m/s.
    pub(super) speed: f64,
    /// A quantum of heat, J/kg.
    pub(super) heat: f64,
}

impl<A: Arithmetic, const D: usize> PointPass<A, D> for Mutual {
    type Read<T: Copy> = Here<T, D>;
    type Write<T: Copy> = Slowed<T, D>;
    const READ: &'static [usize] = &[DENSITY, ENTROPY];
    const WRITE: &'static [usize] = &[COUNTERFLOW, COUNTERFLOW_COPY, HEAT];
    #[inline(always)]
    fn at(
        &self,
        id: u64,
        read: &Here<A::Word, D>,
        write: &mut Slowed<A::Word, D>,
    ) -> Result<(), Fault> {
        let fault = Fault::new(FaultKind::VelocityRange, id);
        let density = read.density.quanta() / ONE;
        let excess = self.helium.entropy * (read.entropy.quanta() / ONE);
        let normal = self.helium.normal_fraction_at(excess);
        let stretch = root::<D>(density) * self.speed;
        let squared = |w: &[A::Word; D]| {
            w.iter().fold(0.0, |sum, w| {
                let u = stretch * w.quanta();
                sum + u * u
            })
        };
        let before = squared(&write.counterflow);
        let decay = self.strength * density * (before / (normal * normal));
        let lost = 1.0 - 1.0 / sqrt(1.0 + decay);
        let copies = write.counterflow.iter_mut();
        for (first, second) in copies.zip(&mut write.counterflow_copy) {
            let change = A::Word::ZERO.add_rounded(-(lost * first.quanta()));
            let change = change.ok_or(fault)?;
            *first = first.plus(change);
            *second = second.plus(change);
        }
        let after = squared(&write.counterflow);
        let heat = self.helium.counterflow_energy(excess, before - after);
        let sum = write.heat.add_rounded(heat / self.heat);
        write.heat = sum.ok_or(Fault::new(FaultKind::TermRange, id))?;
        Ok(())
    }
}
