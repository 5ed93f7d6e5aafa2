//! Water that begins at rest under gravity: densities whose pressure carries what lies above.
//!
//! The force on a particle is -m Σ V ρ0 (p_a/ρ_a² + p_b/ρ_b²) ∇W, with V = m/ρ0. On a lattice of one
//! volume for each particle it is -k m ρ0 d(p/ρ²)/dy where p/ρ² is linear in y, with k the response
//! of the lattice ([`lattice_response`]), nearly 1. So it balances the gravity g (m/s²) to the last
//! digit where
//!
//! ρ0 p/ρ² = g d/k,
//!
//! with d the depth (m) below the surface of the region. The state equation gives ρ, and ρ - ρ0
//! is added to the constant C_a of the particle. Dummy particles within the reach of a region continue its
//! pressure. At the free surface, whose rows have no neighbours above, the balance is not exact.

use super::geometry::{AxisBox, Vector3, around_both, grown};
use super::initial::{GivenField, InitialState};
use super::region::Region;
use super::response::lattice_response;
use super::types::Scene;
use super::wcsph::{DensityCorrection, EquationOfState, Fluid, WallModel};
use super::words::{LatticeKind, RegionKind};
use loschmidt_core::schemes::wcsph::StateEquation;

/// The field of the model that takes what the first density has above ρ0, kg/m³.
const FIELD: &str = "density_constant";

/// A region of water at rest.
struct Pool {
    bounds: AxisBox,
    /// Height of the surface, m.
    surface: f64,
    /// k.
    response: f64,
}

impl Scene {
    /// Gives water and dummies what their first densities have above the reference density.
    pub(super) fn set_hydrostatic(
        &self,
        state: &mut InitialState,
        placed: &[(usize, RegionKind, usize)],
    ) {
        let Some(fluid) = self.fluid else { return };
        if self.water.density_correction != DensityCorrection::Hydrostatic {
            return;
        }
        let gravity = self.gravity.uniform;
        let g = gravity.iter().map(|x| x * x).sum::<f64>().sqrt();
        let height = |x: &Vector3| -(0..3).map(|k| x[k] * gravity[k]).sum::<f64>() / g;
        let excess = |pool: &Pool, x: &Vector3| {
            let depth = (pool.surface - height(x)).max(0.0);
            [excess(&fluid, g * depth / pool.response), 0.0, 0.0]
        };
        let mut values = vec![[0.0; 3]; state.fluid.len()];
        let mut pools = Vec::new();
        let of_model = placed.iter().filter(|(_, kind, _)| kind.is_of_the_model());
        let starts: Vec<_> = of_model
            .map(|&(number, _, start)| (number, start))
            .collect();
        for (n, &(number, start)) in starts.iter().enumerate() {
            let end = starts.get(n + 1).map_or(state.fluid.len(), |next| next.1);
            let points = &state.fluid[start..end];
            let Some(pool) = self.pool(&self.regions[number], points, &height) else {
                continue;
            };
            for (value, x) in values[start..end].iter_mut().zip(points) {
                *value = excess(&pool, x);
            }
            pools.push(pool);
        }
        state.added.push(GivenField {
            name: FIELD,
            values,
        });
        if self.water.wall_model != WallModel::Dummy {
            return;
        }
        let of_wall = |x: &Vector3| {
            let near = pools.iter().find(|pool| within(&pool.bounds, x));
            near.map_or([0.0; 3], |pool| excess(pool, x))
        };
        state.wall_added.push(GivenField {
            name: FIELD,
            values: state.wall.iter().map(of_wall).collect(),
        });
    }

    fn pool(
        &self,
        region: &Region,
        points: &[Vector3],
        height: &impl Fn(&Vector3) -> f64,
    ) -> Option<Pool> {
        let bounds = points.iter().map(|x| (*x, *x)).reduce(around_both)?;
        let highest = points.iter().map(height).reduce(f64::max)?;
        let kind = region
            .lattice
            .unwrap_or(LatticeKind::natural(self.dimension));
        let response = lattice_response(kind, self.support);
        Some(Pool {
            bounds: grown(bounds, [self.support_radius(); 3]),
            surface: highest + 0.5 * self.particle_spacing,
            // A spiral has no one direction.
            response: response.map_or(1.0, |response| -response.density),
        })
    }
}

fn within(bounds: &AxisBox, x: &Vector3) -> bool {
    (0..3).all(|k| bounds.0[k] <= x[k] && x[k] <= bounds.1[k])
}

/// ρ - ρ0 (kg/m³) where ρ0 p/ρ² is this (J/kg).
fn excess(fluid: &Fluid, wanted: f64) -> f64 {
    let equation = match fluid.equation_of_state {
        EquationOfState::Tait => StateEquation::Tait,
        EquationOfState::Linear => StateEquation::Linear,
    };
    let wanted = wanted / (fluid.sound_speed * fluid.sound_speed);
    // Newton's iteration, with the slope (1 + ...) of both equations near the reference density.
    let mut x = 1.0 + wanted;
    for _ in 0..STEPS {
        x += wanted - equation.pressure_over_density_squared(x);
    }
    fluid.reference_density * (x - 1.0)
}

/// The error falls by the factor of the compression in each, a hundredth or less.
const STEPS: usize = 30;
