//! The speed histogram and reduced Boltzmann entropy.
//!
//! With f_k = n_k/(N Δv) and v_k the midpoint of bin k, eq. (17) and its 3D form:
//!
//! - 2D: S = -Σ f_k ln(f_k/v_k) Δv,   equilibrium S = 1 + ln(kT/m)                        (20)
//! - 3D: S = -Σ f_k ln(f_k/v_k²) Δv,  equilibrium S = 3/2 + (3/2) ln(2π kT/m) - ln(4π)
//!
//! kT/m (m²/s²) comes either from the kinetic energy, kT/m = 2E/(D N m) (21), or from a least
//! squares fit of the Maxwell–Boltzmann distribution to the histogram,
//!
//! - 2D: f(v) = (m/kT) v exp(-m v²/2kT)                                                    (19)
//! - 3D: f(v) = (2/π)^(1/2) (m/kT)^(3/2) v² exp(-m v²/2kT)
//!
//! The bins are the same for a whole run: 100 equal ones up to the model's largest speed (c/6 for
//! water), faster particles in the last and counted. S depends on the bins.

use super::Moving;
use crate::number::{Arithmetic, Quantity};
use core::f64::consts::PI;

/// Number of bins.
pub const BINS: usize = 100;

/// Speeds of the fluid particles, counted.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedHistogram {
    /// Dimension of the flow, 2 or 3.
    pub dimension: usize,
    /// Δv, m/s.
    pub bin_width: f64,
    /// Particles in each bin.
    pub counts: [u32; BINS],
    /// How many of the last bin are faster than its end.
    pub beyond: u32,
    /// 2E/(D N m): kT/m by the kinetic energy, m²/s².
    pub temperature_of_energy: f64,
}

impl SpeedHistogram {
    /// Counts the speeds in bins of this width, m/s.
    pub(super) fn measure<A: Arithmetic, const D: usize>(
        moving: &Moving<'_, '_, A, D>,
        bin_width: f64,
        speed_quantum: f64,
    ) -> Self {
        let mut counts = [0; BINS];
        let mut beyond = 0;
        let mut sum = 0i128;
        let mut n = 0u64;
        for (_, v) in moving.iter() {
            n += 1;
            let v2 = v.iter().fold(0i128, |sum, v| {
                let v = i128::from(v.whole_quanta());
                sum + v * v
            });
            sum += v2;
            let bin = libm::sqrt(v2 as f64) * speed_quantum / bin_width;
            if bin < BINS as f64 {
                counts[bin as usize] += 1;
            } else {
                counts[BINS - 1] += 1;
                beyond += 1;
            }
        }
        let n = n.max(1) as f64;
        Self {
            dimension: D,
            bin_width,
            counts,
            beyond,
            temperature_of_energy: sum as f64 * (speed_quantum * speed_quantum) / (D as f64 * n),
        }
    }

    /// Speed at the middle of bin k, m/s.
    #[must_use]
    pub fn midpoint(&self, k: usize) -> f64 {
        (k as f64 + 0.5) * self.bin_width
    }

    /// f_k, s/m.
    #[must_use]
    pub fn density(&self, k: usize) -> f64 {
        let n: u64 = self.counts.iter().map(|&c| u64::from(c)).sum();
        f64::from(self.counts[k]) / (n.max(1) as f64 * self.bin_width)
    }

    /// Reduced Boltzmann entropy (17).
    #[must_use]
    pub fn entropy(&self) -> f64 {
        let mut s = 0.0;
        for k in 0..BINS {
            let f = self.density(k);
            if f > 0.0 {
                let v = self.midpoint(k);
                let weight = if self.dimension == 2 { v } else { v * v };
                s -= f * libm::log(f / weight) * self.bin_width;
            }
        }
        s
    }

    /// The equilibrium entropy of the kinetic energy (21); `None` at rest.
    #[must_use]
    pub fn equilibrium_of_energy(&self) -> Option<f64> {
        equilibrium_entropy(self.dimension, self.temperature_of_energy)
    }

    /// The Maxwell–Boltzmann density of speeds at temperature kT/m, s/m.
    #[must_use]
    pub fn maxwell_boltzmann(&self, temperature: f64, v: f64) -> f64 {
        let e = libm::exp(-0.5 * v * v / temperature);
        if self.dimension == 2 {
            v / temperature * e
        } else {
            libm::sqrt(2.0 / (PI * temperature)) * (v * v / temperature) * e
        }
    }

    /// kT/m that fits the histogram best in the least-squares sense, m²/s²; `None` at rest.
    ///
    /// The misfit is scanned on a logarithmic grid around the temperature of the energy, so that a
    /// second minimum is not mistaken for the first, and the best interval is halved by golden
    /// sections until its width is 10^-9 of the value.
    #[must_use]
    pub fn fitted_temperature(&self) -> Option<f64> {
        let start = self.temperature_of_energy;
        if start.is_nan() || start <= 0.0 {
            return None;
        }
        let misfit = |log_t: f64| {
            let t = libm::exp(log_t);
            (0..BINS).fold(0.0, |sum, k| {
                let d = self.density(k) - self.maxwell_boltzmann(t, self.midpoint(k));
                sum + d * d
            })
        };
        const STEP: f64 = 0.125;
        let centre = libm::log(start);
        let mut best = (misfit(centre), centre);
        for i in -64..=32 {
            let log_t = centre + STEP * f64::from(i);
            let m = misfit(log_t);
            if m < best.0 {
                best = (m, log_t);
            }
        }
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let (mut a, mut b) = (best.1 - STEP, best.1 + STEP);
        while b - a > 1e-9 {
            let x1 = b - GOLDEN * (b - a);
            let x2 = a + GOLDEN * (b - a);
            if misfit(x1) < misfit(x2) {
                b = x2;
            } else {
                a = x1;
            }
        }
        Some(libm::exp(0.5 * (a + b)))
    }

    /// The equilibrium entropy of the fitted temperature (20); `None` at rest.
    #[must_use]
    pub fn equilibrium_of_fit(&self) -> Option<f64> {
        equilibrium_entropy(self.dimension, self.fitted_temperature()?)
    }
}

/// Equilibrium value of the reduced entropy at kT/m (m²/s²), eq. (20) and its 3D form; `None`
/// for a temperature of zero.
#[must_use]
pub fn equilibrium_entropy(dimension: usize, temperature: f64) -> Option<f64> {
    if temperature.is_nan() || temperature <= 0.0 {
        return None;
    }
    Some(match dimension {
        2 => 1.0 + libm::log(temperature),
        _ => 1.5 + 1.5 * libm::log(2.0 * PI * temperature) - libm::log(4.0 * PI),
    })
}
