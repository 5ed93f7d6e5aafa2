//! How long a run will take.

use super::plan::Plan;
use crate::player::{Arrow, Player};
use crate::saved::ArithmeticKind;
use std::time::{Duration, Instant};

/// The time of a run is estimated by steps that take about this long.
const TRIAL: Duration = Duration::from_millis(100);

/// At most so many of them.
const MOST: u64 = 50;

/// Seconds that the run of a player at home will take, by some of its first steps, which are then
/// taken back; `None` where that would not leave the state as it was (in floating point, and away
/// from home), and where nothing can be said. Particles in disorder take up to twice as long.
pub(super) fn expected_seconds(player: &mut Player, plan: &Plan) -> Option<f64> {
    if player.steps_taken() > 0 || player.options().arithmetic == ArithmeticKind::Float {
        return None;
    }
    let home = player.home().clone();
    let most = (plan.out / 100).min(MOST);
    // The first step is slower.
    let mut result = player.advance(1);
    let began = Instant::now();
    let mut steps = 0;
    while result.is_ok() && steps < most && began.elapsed() < TRIAL {
        result = player.advance(1);
        steps += 1;
    }
    let seconds = began.elapsed().as_secs_f64();
    player.restore(&home, 0, Arrow::Forward).ok()?;
    let known = result.is_ok() && steps > 0;
    known.then(|| seconds / steps as f64 * plan.total() as f64)
}
