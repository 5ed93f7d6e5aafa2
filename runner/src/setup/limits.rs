//! Time steps that are small enough.

use super::wall;
use crate::player::Player;
use crate::scene::Scene;
use loschmidt_core::Fault;
use loschmidt_core::schemes::wcsph::Wall;

/// Time steps that are small enough by the scene alone, s, by name:
///
/// - `acoustic`: 0.4 h/c. Störmer–Verlet lost the dam break at 0.6 and kept it at 0.4.
/// - `elastic`, in its place where particles carry a distortion: 0.4 h/sqrt(c_L² + 4 c_p²). The undeformed lattices of the
///   scene language are stable up to 0.88, for any support from 2.4 to 4 spacings.
/// - `viscous` and `conductive`, of helium with friction: 0.125 h²/ν for the paper's h, half of the
///   support, with ν = μ/(χ_n ρ0) and β T0/(C ρ0) (Morris, Fox & Zhu, J. Comput. Phys. 136 (1997)
///   214).
/// - `wall`: 0.5 r_wall/sqrt(2 E). Near r_wall the conservative wall is a spring of frequency
///   sqrt(2 E)/r_wall, stable for time steps up to four times this.
#[must_use]
pub fn fixed_limits(scene: &Scene) -> Vec<(&'static str, f64)> {
    let acoustic = 0.4 * scene.support_radius() / scene.step_speed();
    let name = if scene.has_distortion() {
        "elastic"
    } else {
        "acoustic"
    };
    let mut limits = vec![(name, acoustic)];
    if let Some(superfluid) = scene.superfluid {
        let (helium, h) = (superfluid.helium(), 0.5 * scene.support_radius());
        let capacity = helium.reference_density * helium.heat_capacity / helium.temperature;
        for (name, coefficient) in [
            (
                "viscous",
                superfluid.viscosity / (helium.normal_fraction * helium.reference_density),
            ),
            ("conductive", superfluid.diffusion / capacity),
        ] {
            if coefficient > 0.0 {
                limits.push((name, 0.125 * h * h / coefficient));
            }
        }
    }
    if let Wall::Conservative { energy, radius, .. } = wall(scene) {
        limits.push(("wall", 0.5 * radius / (2.0 * energy).sqrt()));
    }
    limits
}

/// The time step 0.25 sqrt(h/a), s, with the largest acceleration a of the player's present state;
/// `None` without forces. Takes a step to learn the accelerations, and goes back to where it was.
///
/// # Errors
/// The step failed.
pub fn force_limit(player: &mut Player) -> Result<Option<f64>, Fault> {
    let before = player.save();
    let (position, arrow) = (player.position(), player.arrow());
    let result = player.advance(1);
    let after = player.save();
    // The state came from this very player: it fits.
    let _ = player.restore(&before, position, arrow);
    result?;
    let dt = player.scene().time_step();
    let largest = (0..before.id.len())
        .map(|n| {
            let (a, b) = (before.velocity(n), after.velocity(n));
            (0..3).map(|d| ((b[d] - a[d]) / dt).powi(2)).sum::<f64>()
        })
        .fold(0.0, f64::max)
        .sqrt();
    Ok((largest > 0.0).then(|| 0.25 * (player.scene().support_radius() / largest).sqrt()))
}
