//! Constitutive laws of helium II near a reference temperature.
//!
//! With the excess x = s - s0 of specific entropy, the counterflow u = v - v_s and ϱ = ρ/ρ0:
//!
//! - χ_n = χ_n0 + χ' x, the fraction of the normal component; χ_s = 1 - χ_n      (8)
//! - p = u_1² (ρ - ρ0)                                                           (12)
//! - T = T0 (1 + x/C) - (χ'/2) |u/χ_n|²                                          (13)
//! - u_2² = χ_s0 T0 s0²/(χ_n0 C), the speed of second sound                      (14)
//! - e = v²/2 + (χ_s/χ_n) u²/2 + u_1² (ln ϱ + 1/ϱ - 1) + T0 x + T0 x²/(2C)       (15)
//!
//! The last term of T is not printed in (13), which is for helium at rest: T is the derivative of
//! (15) by s at a fixed u, and only with it is energy kept where helium flows.
//!
//! Source: Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, with the values of Table I,
//! which are those of Donnelly & Barenghi, J. Phys. Chem. Ref. Data 27 (1998) 1217.

use crate::number::sqrt;

/// Helium II near a temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helium {
    /// T0, K.
    pub temperature: f64,
    /// ρ0, kg/m³.
    pub reference_density: f64,
    /// s0, J/(kg K).
    pub entropy: f64,
    /// χ_n0.
    pub normal_fraction: f64,
    /// χ', kg K/J.
    pub fraction_slope: f64,
    /// u_1, m/s; less than that of helium, so that the time step may be longer.
    pub sound_speed: f64,
    /// C, J/(kg K).
    pub heat_capacity: f64,
}

impl Helium {
    /// At 1.65 K: Table I, fountain effect.
    pub const AT_1_65_K: Self = Self {
        temperature: 1.65,
        reference_density: 145.2,
        entropy: 335.0,
        normal_fraction: 0.1934,
        fraction_slope: 5.851e-4,
        sound_speed: 40.0,
        heat_capacity: 1861.0,
    };

    /// At 1.9 K: Table I, second sound.
    pub const AT_1_90_K: Self = Self {
        temperature: 1.9,
        reference_density: 145.5,
        entropy: 725.5,
        normal_fraction: 0.4195,
        fraction_slope: 5.697e-4,
        sound_speed: 40.0,
        heat_capacity: 3902.0,
    };

    /// χ_n at an excess of entropy, J/(kg K).
    #[must_use]
    #[inline(always)]
    pub fn normal_fraction_at(&self, excess: f64) -> f64 {
        self.normal_fraction + self.fraction_slope * excess
    }

    /// T - T0, K, at an excess of entropy and with u², m²/s², of the counterflow u = v - v_s.
    #[must_use]
    #[inline(always)]
    pub fn warming(&self, excess: f64, counterflow_squared: f64) -> f64 {
        let normal = self.normal_fraction_at(excess);
        let flow = 0.5 * self.fraction_slope * (counterflow_squared / (normal * normal));
        self.temperature * (excess / self.heat_capacity) - flow
    }

    /// p, Pa, at a density relative to ρ0.
    #[must_use]
    pub fn pressure(&self, density: f64) -> f64 {
        self.reference_density * (self.sound_speed * self.sound_speed) * (density - 1.0)
    }

    /// u_2, m/s.
    #[must_use]
    pub fn second_sound(&self) -> f64 {
        let fractions = (1.0 - self.normal_fraction) / self.normal_fraction;
        let squares = self.temperature * (self.entropy * self.entropy) / self.heat_capacity;
        sqrt(fractions * squares)
    }

    /// The energy of the counterflow, J/kg.
    #[must_use]
    pub fn counterflow_energy(&self, excess: f64, counterflow_squared: f64) -> f64 {
        let normal = self.normal_fraction_at(excess);
        0.5 * ((1.0 - normal) / normal) * counterflow_squared
    }

    /// The energy of compression, J/kg, at a density ϱ relative to ρ0, given as ϱ - 1.
    #[must_use]
    pub fn compression_energy(&self, compression: f64) -> f64 {
        let logarithm = libm::log1p(compression);
        let squared = self.sound_speed * self.sound_speed;
        squared * (logarithm - compression / (1.0 + compression))
    }

    /// The energy of warmth beyond T0 x, J/kg: T0 x²/(2C).
    #[must_use]
    pub fn thermal_energy(&self, excess: f64) -> f64 {
        self.temperature / (2.0 * self.heat_capacity) * (excess * excess)
    }

    /// By how much the excess of entropy grows, J/(kg K), where the energy grows by `heat`, J/kg,
    /// with a given u², m²/s², of the counterflow.
    #[must_use]
    pub fn growth(&self, excess: f64, counterflow_squared: f64, heat: f64) -> f64 {
        let capacity = self.temperature / self.heat_capacity;
        let first = self.normal_fraction_at(excess);
        let mut growth = 0.0;
        // Newton's iteration: the energy is all but linear.
        for _ in 0..3 {
            let last = self.normal_fraction_at(excess + growth);
            let thermal = growth * (self.temperature + capacity * (excess + 0.5 * growth));
            let share = self.fraction_slope * growth / (first * last);
            let flow = 0.5 * counterflow_squared * share;
            let missing = heat - (thermal - flow);
            let warming = self.warming(excess + growth, counterflow_squared);
            growth += missing / (self.temperature + warming);
        }
        growth
    }
}
