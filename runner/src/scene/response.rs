//! How the sums over a lattice answer to a change of volume.
//!
//! Where all distances grow by the factor 1 + ε, the volume of D dimensions grows by 1 + D ε, and on
//! a lattice with one particle in each unit of volume, W the kernel and V0 = 1,
//!
//! - d(ρ/ρ0)/d ln V = Σ (W'/r) r²/D, in the continuum -1
//! - d(λ/ρ0)/d ln V = Σ s r²/D, with s = (1/r) d(h dW/dh)/dr, in the continuum 0
//!
//! over all nodes but the one in the middle. The bulk energy and the penalty together are then as
//! stiff as a bulk modulus of ρ0 c_0² ((dρ/d ln V)² + (c_p/c_0)² (dλ/d ln V)²).

use super::words::LatticeKind;
use loschmidt_core::kernel::WendlandC2;

/// Derivatives of the sums by the logarithm of the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticeResponse {
    /// d(ρ/ρ0)/d ln V.
    pub density: f64,
    /// d(λ/ρ0)/d ln V.
    pub clumping: f64,
}

impl LatticeResponse {
    /// The stiffness in bulk in units of ρ0 c_0², for this c_p/c_0.
    #[must_use]
    pub fn bulk_stiffness(&self, penalty: f64) -> f64 {
        self.density * self.density + (penalty * penalty) * (self.clumping * self.clumping)
    }
}

/// Steps from a node to its neighbours, for one node in each unit of volume; none for a spiral,
/// which is no lattice.
pub(super) fn steps(kind: LatticeKind) -> Option<(usize, [[f64; 3]; 3])> {
    Some(match kind {
        LatticeKind::Square => (2, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]]),
        LatticeKind::Hexagonal => {
            let pitch = (2.0 / 3.0_f64.sqrt()).sqrt();
            let row = pitch * 3.0_f64.sqrt() / 2.0;
            (2, [[pitch, 0.0, 0.0], [pitch / 2.0, row, 0.0], [0.0; 3]])
        }
        LatticeKind::Vogel => return None,
        LatticeKind::Cubic => (3, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        LatticeKind::BodyCentred => {
            let half = libm::cbrt(2.0) / 2.0;
            let signs = [[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];
            (3, signs.map(|row| row.map(|sign: f64| sign * half)))
        }
    })
}

/// The response of a lattice at this support radius, in spacings; none for what is no lattice.
#[must_use]
pub fn lattice_response(kind: LatticeKind, support: f64) -> Option<LatticeResponse> {
    let (dimension, steps) = steps(kind)?;
    let kernel = WendlandC2::new(dimension, support, 1.0);
    // Every node within reach is met: the planes of a lattice are at least 0.7 spacings apart.
    let most = (support / 0.7).ceil() as i32;
    let third = if dimension == 2 { 0..=0 } else { -most..=most };
    let mut response = LatticeResponse {
        density: 0.0,
        clumping: 0.0,
    };
    for i in -most..=most {
        for j in -most..=most {
            for k in third.clone() {
                let n = [i, j, k].map(f64::from);
                let along = |d: usize| (0..3).map(|s| n[s] * steps[s][d]).sum::<f64>();
                let r2 = (0..3).map(|d| along(d) * along(d)).sum::<f64>();
                let (q, share) = (kernel.q(r2.sqrt()), r2 / dimension as f64);
                response.density += kernel.derivative_over_r_at(q) * share;
                response.clumping += kernel.structural_derivative_over_r_at(q) * share;
            }
        }
    }
    Some(response)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Computed with another program, to six digits.
    #[test]
    fn lattices_answer_as_they_were_found_to() {
        use LatticeKind::{BodyCentred, Cubic, Hexagonal, Square};
        for (kind, support, density, clumping) in [
            (Hexagonal, 3.0, -0.994327, 0.074819),
            (Hexagonal, 3.2, -0.991967, 0.001569),
            (Square, 3.0, -0.997399, -0.023957),
            (Square, 3.2, -0.995806, 0.057251),
            (BodyCentred, 3.0, -0.997111, 0.052455),
            (BodyCentred, 3.2, -0.995415, -0.000060),
            (Cubic, 3.0, -1.000619, -0.046892),
            (Cubic, 3.2, -0.999892, 0.044985),
        ] {
            let found = lattice_response(kind, support).expect("a lattice");
            let error = (found.density - density)
                .abs()
                .max((found.clumping - clumping).abs());
            assert!(error < 1e-6, "{kind:?} {support}: {found:?}");
        }
        assert_eq!(lattice_response(LatticeKind::Vogel, 3.0), None);
    }

    #[test]
    fn the_papers_settings_stiffen_its_lattices() {
        let plate = lattice_response(LatticeKind::Hexagonal, 3.0).expect("a lattice");
        assert!((plate.bulk_stiffness(10.0) - 1.55).abs() < 0.005);
        assert!((plate.bulk_stiffness(1.0) - 0.994).abs() < 0.005);
        let column = lattice_response(LatticeKind::BodyCentred, 3.0).expect("a lattice");
        assert!((column.bulk_stiffness(10.0) - 1.27).abs() < 0.005);
    }
}
