//! Barotropic state equations p(ρ), with the internal energy that belongs to each.
//!
//! With x = ρ/ρ0, c the sound speed and dε = p/ρ² dρ:
//!
//! | | p | ε, zero at ρ0 |
//! |---|---|---|
//! | Tait, eq. (2) | (c² ρ0/7)(x⁷ - 1) | (c²/42)(x⁶ + 6/x - 7) |
//! | linear | c² (ρ - ρ0) | c² (ln x + 1/x - 1) |
//!
//! Eq. (3) of the paper leaves ε at c²/6 for x = 1; here the constant is taken off. The Tait energy
//! is computed as (c²/42)(x-1)²(x⁵ + 2x⁴ + 3x³ + 4x² + 5x + 6)/x, the same polynomial without the
//! cancellation near x = 1.

/// Which p(ρ).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateEquation {
    /// Eq. (2) of the paper, exponent 7.
    Tait,
    /// p = c²(ρ - ρ0).
    Linear,
}

impl StateEquation {
    /// p/ρ² divided by c²/ρ0, as a function of x = ρ/ρ0; dimensionless.
    #[inline]
    pub fn pressure_over_density_squared(self, x: f64) -> f64 {
        let x2 = x * x;
        match self {
            Self::Tait => {
                let x4 = x2 * x2;
                ((x4 * x2) * x - 1.0) / (7.0 * x2)
            }
            Self::Linear => (x - 1.0) / x2,
        }
    }

    /// Pressure divided by c² ρ0; dimensionless.
    #[must_use]
    #[inline]
    pub fn pressure(self, x: f64) -> f64 {
        match self {
            Self::Tait => {
                let x2 = x * x;
                let x4 = x2 * x2;
                ((x4 * x2) * x - 1.0) / 7.0
            }
            Self::Linear => x - 1.0,
        }
    }

    /// Internal energy per mass divided by c², zero at x = 1; dimensionless.
    #[must_use]
    pub fn internal_energy(self, x: f64) -> f64 {
        let y = x - 1.0;
        match self {
            Self::Tait => {
                let sum = ((((x + 2.0) * x + 3.0) * x + 4.0) * x + 5.0) * x + 6.0;
                y * y * sum / (42.0 * x)
            }
            Self::Linear => libm::log(x) - y / x,
        }
    }
}
