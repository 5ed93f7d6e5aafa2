//! The keys of the elastic models: what the bodies are made of.

use super::declare::keys;
use super::schema::Family;
use super::schema::IfAbsent::{Number, Required, Word};
use super::schema::Range::{Above, Any, AtLeast};
use super::words::words;
use loschmidt_core::schemes::solid::{Material, ShearEnergy};

/// The models that have these keys.
pub(super) const FAMILY: Family = "elastic";
/// The same, for declarations.
pub(super) const ELASTIC: Option<Family> = Some(FAMILY);

keys! {
    /// The material of the bodies. In the plane a density is per area, kg/m².
    #[derive(Copy)]
    Solid of ELASTIC, table Header "`[solid]`" {
        reference_density: f64 = Required, Above(0.0),
            "density of the unstrained body", "kg/m³";
        bulk_speed: f64 = Required, Above(0.0),
            "c_0: density times its square is the bulk modulus (dpr) or Lamé's first parameter \
             (neo-hookean)", "m/s";
        shear_speed: f64 = Required, Above(0.0),
            "c_s, the speed of shear waves: density times its square is the shear modulus", "m/s";
        penalty: f64 = Number(1.0), AtLeast(0.0),
            "c_p/c_0, the strength of the penalty that keeps particles from pairing under tension; \
             much more than 1 stiffens the lattice, 0 lets bodies tear";
        energy: ElasticEnergy = Word(ElasticEnergy::Dpr.word()), Any,
            "energy of shear: of Dumbser, Peshkov and Romenski, or neo-Hookean";
    }
}

words! {
    /// Energy as a function of the distortion.
    ElasticEnergy {
        /// (c_s²/4) |dev G|².
        Dpr = "dpr",
        /// (c_s²/2) (tr B - 3 + 2 ln det A).
        NeoHookean = "neo-hookean",
    }
}

impl Solid {
    /// The material as the core has it.
    #[must_use]
    pub fn material(&self) -> Material {
        Material {
            bulk_speed: self.bulk_speed,
            shear_speed: self.shear_speed,
            penalty_speed: self.penalty * self.bulk_speed,
            energy: match self.energy {
                ElasticEnergy::Dpr => ShearEnergy::Dpr,
                ElasticEnergy::NeoHookean => ShearEnergy::NeoHookean,
            },
        }
    }

    /// The speed that limits the time step, m/s: of longitudinal waves, and of the waves that the
    /// penalty carries between neighbours. On the lattices of the scene language, and for supports
    /// of 2.4 to 4 spacings, the stiffest of those is 3.1 to 4.1 times as stiff for each unit of
    /// c_p² as the stiffest one of the bulk is for each of c_0².
    #[must_use]
    pub fn step_speed(&self) -> f64 {
        step_speed(&self.material())
    }
}

/// See [`Solid::step_speed`].
pub(super) fn step_speed(material: &Material) -> f64 {
    let (longitudinal, penalty) = (material.longitudinal_speed(), material.penalty_speed);
    (longitudinal * longitudinal + PENALTY_STIFFNESS * (penalty * penalty)).sqrt()
}

/// See [`Solid::step_speed`].
const PENALTY_STIFFNESS: f64 = 4.0;
