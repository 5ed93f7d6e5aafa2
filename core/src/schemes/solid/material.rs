//! Materials: energy and stress of a distortion, elastic constants, wave speeds.
//!
//! With G = (A_whole)ᵀ A_whole, the energies per mass are
//!
//! - bulk            ε_0 = (c_0²/2) (ρ/ρ0 - 1)²                                      (29)
//! - shear, DPR      ε_s = (c_s²/4) |dev G|²                                         (31)
//! - shear, neo-Hookean   ε_s = (c_s²/2) (tr B - 3 + 2 ln det A_whole),  B = G⁻¹     (35)
//!
//! and S = Aᵀ ∂ε_s/∂A is c_s² G dev G, or -c_s² (B - 1). In the plane (plane strain) A has a third
//! diagonal entry that stays 1: dev subtracts a third of the trace of all three.
//!
//! | | DPR | neo-Hookean |
//! |---|---|---|
//! | ρ0 c_0² | bulk modulus K | Lamé's first parameter λ |
//! | ρ0 c_s² | shear modulus μ | shear modulus μ |
//! | longitudinal waves c_L² | c_0² + 4/3 c_s² | c_0² + 2 c_s² |
//!
//! Source: Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, section 3.4;
//! Dumbser, Peshkov, Romenski & Zanotti, J. Comput. Phys. 314 (2016) 824.

use crate::matrix::{Matrix, inverse, metric, product, trace};
use crate::number::{exp, sqrt};

/// Which shear energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShearEnergy {
    /// Of Dumbser, Peshkov and Romenski, eq. (31).
    Dpr,
    /// Eq. (35).
    NeoHookean,
}

/// What a body is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// c_0, m/s.
    pub bulk_speed: f64,
    /// c_s, m/s.
    pub shear_speed: f64,
    /// c_p of the tensile penalty, m/s.
    pub penalty_speed: f64,
    /// The shear energy.
    pub energy: ShearEnergy,
}

/// Elastic constants for small strains, for a density ρ0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticConstants {
    /// Bulk modulus K, Pa.
    pub bulk_modulus: f64,
    /// Shear modulus μ, Pa.
    pub shear_modulus: f64,
    /// Young's modulus E, Pa.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν.
    pub poissons_ratio: f64,
}

impl Material {
    /// c_L, the speed of longitudinal waves in an unbounded body, m/s.
    #[must_use]
    pub fn longitudinal_speed(&self) -> f64 {
        let (b, s) = (self.bulk_speed, self.shear_speed);
        let share = match self.energy {
            ShearEnergy::Dpr => 4.0 / 3.0,
            ShearEnergy::NeoHookean => 2.0,
        };
        sqrt(b * b + share * (s * s))
    }

    /// The elastic constants at this density, kg/m³.
    #[must_use]
    pub fn constants(&self, density: f64) -> ElasticConstants {
        let squared = self.bulk_speed * self.bulk_speed;
        let shear_modulus = density * (self.shear_speed * self.shear_speed);
        let bulk_modulus = match self.energy {
            ShearEnergy::Dpr => density * squared,
            ShearEnergy::NeoHookean => density * squared + 2.0 / 3.0 * shear_modulus,
        };
        ElasticConstants {
            bulk_modulus,
            shear_modulus,
            youngs_modulus: 9.0 * bulk_modulus * shear_modulus
                / (3.0 * bulk_modulus + shear_modulus),
            poissons_ratio: (3.0 * bulk_modulus - 2.0 * shear_modulus)
                / (2.0 * (3.0 * bulk_modulus + shear_modulus)),
        }
    }

    /// ε_0, J/kg.
    #[must_use]
    pub fn bulk_energy(&self, relative_density: f64) -> f64 {
        let x = relative_density - 1.0;
        0.5 * (self.bulk_speed * self.bulk_speed) * (x * x)
    }

    /// ρ0 ∂ε_0/∂ρ, m²/s².
    #[inline(always)]
    #[must_use]
    pub fn bulk_stress(&self, relative_density: f64) -> f64 {
        (self.bulk_speed * self.bulk_speed) * (relative_density - 1.0)
    }

    /// Energy of the tensile penalty (39), J/kg.
    #[must_use]
    pub fn penalty_energy(&self, clumping: f64) -> f64 {
        0.5 * (self.penalty_speed * self.penalty_speed) * (clumping * clumping)
    }

    /// S, m²/s², of G.
    #[inline(always)]
    #[must_use]
    pub fn shear_stress<const D: usize>(&self, metric: &Matrix<D>) -> Matrix<D> {
        let squared = self.shear_speed * self.shear_speed;
        let mut stress = match self.energy {
            ShearEnergy::Dpr => product(metric, &deviator(metric).0),
            ShearEnergy::NeoHookean => {
                let mut b = inverse(metric);
                for (i, row) in b.iter_mut().enumerate() {
                    row[i] -= 1.0;
                    for x in row {
                        *x = -*x;
                    }
                }
                b
            }
        };
        for x in stress.as_flattened_mut() {
            *x *= squared;
        }
        stress
    }

    /// ε_s, J/kg, of G and ln(det A_whole).
    #[must_use]
    pub fn shear_energy<const D: usize>(&self, metric: &Matrix<D>, log_determinant: f64) -> f64 {
        let squared = self.shear_speed * self.shear_speed;
        match self.energy {
            ShearEnergy::Dpr => {
                let (dev, of_third_axis) = deviator(metric);
                let mut sum = of_third_axis * of_third_axis;
                for x in dev.as_flattened() {
                    sum += x * x;
                }
                0.25 * squared * sum
            }
            ShearEnergy::NeoHookean => {
                let stretched = trace(&inverse(metric)) - D as f64;
                0.5 * squared * (stretched + 2.0 * log_determinant)
            }
        }
    }
}

/// dev G within the axes that are simulated, and in the plane its entry along the third.
#[inline(always)]
pub(super) fn deviator<const D: usize>(metric: &Matrix<D>) -> (Matrix<D>, f64) {
    let along_third = if D == 2 { 1.0 } else { 0.0 };
    let mean = (trace(metric) + along_third) / 3.0;
    let mut dev = *metric;
    for (i, row) in dev.iter_mut().enumerate() {
        row[i] -= mean;
    }
    let of_third_axis = if D == 2 { 1.0 - mean } else { 0.0 };
    (dev, of_third_axis)
}

/// G of a distortion e^θ A.
#[inline(always)]
#[must_use]
pub fn whole_metric<const D: usize>(distortion: &Matrix<D>, log_volume: f64) -> Matrix<D> {
    let mut g = metric(distortion);
    let factor = exp(2.0 * log_volume);
    for x in g.as_flattened_mut() {
        *x *= factor;
    }
    g
}
