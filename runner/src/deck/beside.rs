//! A second player that goes wherever the first one goes, in the other arithmetic: the same scene,
//! the same steps, the same turns. What is done to the first by hand is not done to it.

use super::messages::{Beside, Report};
use super::opening::Opening;
use crate::player::{Arrow, Player};
use crate::run::{Row, RunError};
use crate::saved::{ArithmeticKind, SavedState};
use crate::simulation::Options;
use loschmidt_core::Fault;

/// The player and the state that is gone back to when a step of either fails.
pub(super) struct Companion {
    player: Player,
    good: (SavedState, i64, Arrow),
}

impl Companion {
    /// At home, in the arithmetic that the opening does not ask for.
    pub fn new(opening: &Opening) -> Result<Self, RunError> {
        let arithmetic = match opening.options.arithmetic {
            ArithmeticKind::Fixed => ArithmeticKind::Float,
            ArithmeticKind::Float => ArithmeticKind::Fixed,
        };
        let options = Options {
            arithmetic,
            ..opening.options
        };
        let initial = opening.scene.initial_state()?;
        let player = Player::new(opening.scene.clone(), initial, options)?;
        let good = (player.home().clone(), 0, Arrow::Forward);
        Ok(Self { player, good })
    }

    /// So many steps along its arrow.
    pub fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        self.player.advance(steps)
    }

    pub fn turn(&mut self) {
        self.player.turn();
    }

    /// So many steps along physical time, back where negative. Floating point goes back as it
    /// does on a way back: turned, with what that costs it.
    pub fn walk(&mut self, steps: i64) -> Result<(), Fault> {
        let against = (steps < 0) != (self.player.arrow() == Arrow::Backward);
        if against {
            self.player.turn();
        }
        let walked = self.player.advance(steps.unsigned_abs());
        if against {
            self.player.turn();
        }
        walked
    }

    pub fn keep_good(&mut self) {
        let player = &mut self.player;
        self.good = (player.save(), player.position(), player.arrow());
    }

    pub fn back_to_good(&mut self) {
        let (state, position, arrow) = &self.good;
        // It came from this very player: it fits.
        let _ = self.player.restore(state, *position, *arrow);
    }

    pub fn measure(&mut self, travel: Arrow) -> Result<Report, Fault> {
        let leg = match travel {
            Arrow::Forward => 1,
            Arrow::Backward => 2,
        };
        let row = Row::measure(&mut self.player, leg)?;
        // A seek goes against the arrow without turning it.
        let row = match travel == self.player.arrow() {
            true => row,
            false => row.turned(),
        };
        let row = Box::new(row);
        Ok(Report::Beside(Beside::Row { row, travel }))
    }

    pub fn picture(&mut self) -> Result<Report, Fault> {
        let mut points = Box::default();
        self.player.points(&mut points)?;
        Ok(Report::Beside(Beside::Picture(points)))
    }
}
