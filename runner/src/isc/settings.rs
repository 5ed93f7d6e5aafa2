//! What the correction needs to know, and the tolerance and limits of its steps.

/// What the correction needs to know. Lengths in m, densities in kg/m³ (2D: kg/m²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectionSettings {
    /// Particle spacing.
    pub spacing: f64,
    /// h, where the kernel vanishes.
    pub support_radius: f64,
    /// Mass of every particle, kg (2D: kg/m).
    pub mass: f64,
    /// ρ0.
    pub reference_density: f64,
    /// Largest |ρ - ρ0|/ρ0 that is accepted.
    pub tolerance: f64,
    /// Most Newton steps.
    pub most_steps: usize,
    /// Largest distance, in spacings, that a particle is first moved by.
    pub jitter: f64,
    /// Longest displacement of a particle in one step, in spacings: a step that would move one
    /// farther is shortened as a whole. Short steps disturb the lattice less, and there are more of
    /// them.
    pub longest: f64,
    /// Seed of the generator of these distances.
    pub seed: u64,
}

impl CorrectionSettings {
    /// The settings of a scene: 1e-10 within 40 steps, a jitter of a tenth of a spacing.
    #[must_use]
    pub fn new(spacing: f64, support_radius: f64, mass: f64, reference_density: f64) -> Self {
        Self {
            spacing,
            support_radius,
            mass,
            reference_density,
            tolerance: 1e-10,
            most_steps: 40,
            jitter: 0.1,
            longest: 1.0,
            seed: 1876,
        }
    }
}
