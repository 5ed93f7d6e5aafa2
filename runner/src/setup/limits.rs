//! A time step that is small enough by the forces at work.

use crate::player::Player;
use loschmidt_core::Fault;

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
