//! Stages of a step, and integrators as tables of kicks and drifts.
//!
//! A step of size dt is a symmetric composition of the two exact shears
//!
//! - kick(c):  v ← v + R(c dt a(x))
//! - drift(c): x ← x + R(c dt v)
//!
//! Each adds to one half of the state an integer that depends on the other half alone, so it is
//! undone by its negative; and because the table reads the same from both ends and R is odd, a step
//! taken with reversed velocities undoes a step. Every entry is rounded by itself.
//!
//! | row | order | force evaluations a step | source |
//! |---|---|---|---|
//! | [`STORMER_VERLET`] | 2 | 1 | L. Verlet, Phys. Rev. 159 (1967) 98 |
//! | [`PEFRL`] | 4 | 4 | Omelyan, Mryglod & Folk, Comput. Phys. Commun. 146 (2002) 188 |
//! | [`SUZUKI`] | 4 | 5 | M. Suzuki, Phys. Lett. A 146 (1990) 319 |

/// One part of a step; the coefficient multiplies the time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// Velocities advance by the impulse of the forces.
    Kick(f64),
    /// Positions advance with the velocity.
    Drift(f64),
    /// What else a particle carries advances with the motion.
    Lift(f64),
    /// Where a part of the state is held twice: velocities and the second copy advance by what
    /// follows from the first one. A kick of such a model is the same from the second to the first.
    Counterkick(f64),
    /// Many states become one.
    Relax,
}

use Stage::{Drift, Kick};

/// A symmetric table of kicks and drifts.
#[derive(Debug, PartialEq)]
pub struct Integrator {
    /// Name used in scenes and snapshots.
    pub name: &'static str,
    /// Order of accuracy in the time step.
    pub order: u32,
    /// Force evaluations in each step of a long run.
    pub evaluations: u32,
    /// The table.
    pub stages: &'static [Stage],
}

/// Störmer–Verlet, kick–drift–kick.
pub static STORMER_VERLET: Integrator = Integrator {
    name: "stormer-verlet",
    order: 2,
    evaluations: 1,
    stages: &[Kick(0.5), Drift(1.0), Kick(0.5)],
};

const XI: f64 = 0.178_617_895_844_809_1;
const LAMBDA: f64 = -0.212_341_831_062_605_4;
const CHI: f64 = -0.066_264_582_669_818_5;

/// Position-extended Forest–Ruth-like: Omelyan's optimised fourth order.
pub static PEFRL: Integrator = Integrator {
    name: "pefrl",
    order: 4,
    evaluations: 4,
    stages: &[
        Drift(XI),
        Kick(0.5 - LAMBDA),
        Drift(CHI),
        Kick(LAMBDA),
        Drift(1.0 - 2.0 * (CHI + XI)),
        Kick(LAMBDA),
        Drift(CHI),
        Kick(0.5 - LAMBDA),
        Drift(XI),
    ],
};

/// 1/(4 - 4^(1/3)) = 0.41449077179437573714…, to the nearest double.
const P: f64 = 0.414_490_771_794_375_7;

/// Suzuki's five-fold composition of Störmer–Verlet; the kicks where two copies meet are one entry.
pub static SUZUKI: Integrator = Integrator {
    name: "suzuki",
    order: 4,
    evaluations: 5,
    stages: &[
        Kick(0.5 * P),
        Drift(P),
        Kick(P),
        Drift(P),
        Kick(0.5 * (1.0 - 3.0 * P)),
        Drift(1.0 - 4.0 * P),
        Kick(0.5 * (1.0 - 3.0 * P)),
        Drift(P),
        Kick(P),
        Drift(P),
        Kick(0.5 * P),
    ],
};

/// All rows.
pub static INTEGRATORS: [&Integrator; 3] = [&STORMER_VERLET, &PEFRL, &SUZUKI];

/// The row of this name.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static Integrator> {
    INTEGRATORS.into_iter().find(|row| row.name == name)
}
