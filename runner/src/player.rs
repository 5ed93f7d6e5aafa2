//! The player: moves along time in both directions.
//!
//! Physical time is counted in whole steps from home, the initial state. The player has an arrow:
//! forward, or backward after a turn, when every velocity is reversed. **Going back is integrating
//! back**; no history is stored. Dashboard, window and headless run are faces of it.

use crate::frame::Frame;
use crate::points::Points;
use crate::pool::Rayon;
use crate::saved::{ArithmeticKind, SavedState};
use crate::scene::{InitialState, Scene};
use crate::setup;
use crate::simulation::{BuildError, Options, Simulation};
use loschmidt_core::{Diagnostics, Digest, Fault, Reversibility};
use std::ops::ControlFlow;
use thiserror::Error;

/// Direction of motion along physical time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrow {
    /// As in the scene.
    Forward,
    /// All velocities reversed.
    Backward,
}

impl Arrow {
    /// The other one.
    #[must_use]
    pub fn turned(self) -> Self {
        match self {
            Self::Forward => Self::Backward,
            Self::Backward => Self::Forward,
        }
    }
    fn sign(self) -> i64 {
        match self {
            Self::Forward => 1,
            Self::Backward => -1,
        }
    }
}

/// Why the player did not move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum PlayerError {
    /// The numbers ended.
    #[error(transparent)]
    Fault(#[from] Fault),
    /// Seeking needs the way back, and this model has none.
    #[error("the scheme is not symmetric in time: it cannot be integrated backwards")]
    Irreversible,
    /// Seeking needs the way back, and floating-point sums do not return.
    #[error("floating-point arithmetic does not return to where it came from")]
    FloatingPoint,
    /// Seeking needs the way back, and what a filter took out is gone.
    #[error("the model takes energy out of the flow for good: it cannot be integrated backwards")]
    Dissipative,
}

/// How far a state is from home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// Digest at home.
    pub home: Digest,
    /// Digest of the present state, velocities along physical time.
    pub present: Digest,
    /// Largest distance of a particle from its home, m.
    pub error: f64,
    /// Particles whose position is not, to the last bit, that at home.
    pub astray: usize,
}

impl Return {
    /// True where every bit is as it was.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.home == self.present
    }
}

/// A simulation with a position in time.
pub struct Player {
    scene: Scene,
    options: Options,
    simulation: Box<dyn Simulation>,
    /// What is no part of a saved state: the parts of the initial one, and what was given besides
    /// places and velocities.
    initial: InitialState,
    home: SavedState,
    home_digest: Digest,
    position: i64,
    farthest: i64,
    arrow: Arrow,
}

impl Player {
    /// At home, arrow forward.
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn new(scene: Scene, initial: InitialState, options: Options) -> Result<Self, BuildError> {
        let mut simulation = setup::simulation(&scene, &initial, &options)?;
        // Places and velocities are those of home.
        let initial = InitialState {
            fluid: Vec::new(),
            fluid_velocity: Vec::new(),
            wall: Vec::new(),
            ..initial
        };
        Ok(Self {
            initial,
            home: simulation.save(),
            home_digest: simulation.digest(),
            scene,
            options,
            simulation,
            position: 0,
            farthest: 0,
            arrow: Arrow::Forward,
        })
    }

    /// The player as it was at `position` with this arrow.
    ///
    /// # Errors
    /// The state does not belong to the scene.
    pub fn restore(
        &mut self,
        saved: &SavedState,
        position: i64,
        arrow: Arrow,
    ) -> Result<(), BuildError> {
        self.simulation.restore(saved)?;
        self.position = position;
        self.farthest = self.farthest.max(position);
        self.arrow = arrow;
        Ok(())
    }

    /// Notes that an earlier part of the run has reached this position.
    pub(crate) fn reached(&mut self, position: i64) {
        self.farthest = self.farthest.max(position);
    }

    /// Takes `home` as the home state, instead of the scene's: for a run that is resumed.
    ///
    /// # Errors
    /// The state does not belong to the scene.
    pub fn restore_home(&mut self, home: SavedState) -> Result<(), BuildError> {
        self.restore(&home, 0, Arrow::Forward)?;
        self.home_digest = self.simulation.digest();
        self.home = home;
        Ok(())
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
    /// How it is run.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }
    /// Threads at work.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.options.threads_at_work()
    }
    /// How many particles there are but for walls.
    #[must_use]
    pub fn particles(&self) -> u64 {
        self.home.id.len() as u64 - self.held_walls()
    }

    /// How many of the particles are walls of a viscous fluid.
    #[must_use]
    pub fn held_walls(&self) -> u64 {
        if self.scene.viscous.is_none() {
            return 0;
        }
        let first = self.initial.parts.iter().find(|part| part.held);
        first.map_or(0, |part| self.home.id.len() as u64 - part.first)
    }

    /// The state at home.
    #[must_use]
    pub fn home(&self) -> &SavedState {
        &self.home
    }
    /// Its digest.
    #[must_use]
    pub fn home_digest(&self) -> Digest {
        self.home_digest
    }
    /// kg m/s of a quantum of Σ v (per m of depth in 2D).
    #[must_use]
    pub fn momentum_unit(&self) -> f64 {
        self.home.scale.speed_quantum() * self.scene.particle_mass()
    }
    /// Steps from home along physical time.
    #[must_use]
    pub fn position(&self) -> i64 {
        self.position
    }
    /// Largest position reached.
    #[must_use]
    pub fn farthest(&self) -> i64 {
        self.farthest
    }
    /// Direction of motion.
    #[must_use]
    pub fn arrow(&self) -> Arrow {
        self.arrow
    }
    /// Physical time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.position as f64 * self.scene.time_step()
    }
    /// Steps taken over all legs.
    #[must_use]
    pub fn steps_taken(&self) -> u64 {
        self.simulation.step()
    }
    /// What turning round can promise.
    #[must_use]
    pub fn reversibility(&self) -> Reversibility {
        self.simulation.reversibility()
    }

    /// Takes `steps` steps along the arrow.
    ///
    /// # Errors
    /// The numbers ended; the state is then of no use until it is restored.
    pub fn advance(&mut self, steps: u64) -> Result<(), Fault> {
        self.simulation.advance(steps)?;
        self.position += self.arrow.sign() * steps as i64;
        self.farthest = self.farthest.max(self.position);
        Ok(())
    }

    /// Turns time round: all velocities are reversed. Allowed for every model; whether the way
    /// back leads home is another matter.
    pub fn turn(&mut self) {
        self.simulation.reverse();
        self.arrow = self.arrow.turned();
    }

    /// Whether both directions of time can be sought in.
    ///
    /// # Errors
    /// Why not: the model or its arithmetic cannot go back.
    pub fn can_seek(&self) -> Result<(), PlayerError> {
        match self.reversibility() {
            Reversibility::BitExact => Ok(()),
            Reversibility::UpToRounding => Err(PlayerError::FloatingPoint),
            Reversibility::Irreversible => Err(PlayerError::Irreversible),
            Reversibility::Dissipative => Err(PlayerError::Dissipative),
        }
    }

    /// Goes to `target` (steps from home) by integrating there, and keeps the arrow it had.
    /// `between` is called after every `chunk` steps with the position and may break off.
    ///
    /// # Errors
    /// The way leads back and the model or its arithmetic cannot go back; or the numbers ended.
    pub fn seek(
        &mut self,
        target: i64,
        chunk: u64,
        mut between: impl FnMut(i64) -> ControlFlow<()>,
    ) -> Result<(), PlayerError> {
        let arrow = self.arrow;
        let way = if target < self.position {
            Arrow::Backward
        } else {
            Arrow::Forward
        };
        if target == self.position {
            return Ok(());
        }
        if way == Arrow::Backward || arrow == Arrow::Backward {
            self.can_seek()?;
        }
        if way != arrow {
            self.turn();
        }
        let result = loop {
            let left = target.abs_diff(self.position);
            if left == 0 {
                break Ok(());
            }
            if let Err(fault) = self.advance(left.min(chunk.max(1))) {
                break Err(fault.into());
            }
            if between(self.position).is_break() {
                break Ok(());
            }
        };
        if self.arrow != arrow {
            self.turn();
        }
        result
    }

    /// Flips the last bit of the first coordinate of a particle: the smallest perturbation there
    /// is.
    pub fn flip_last_bit(&mut self, particle: u64) {
        self.simulation.flip_last_bit(particle);
    }

    /// Goes on in the other arithmetic from the present state.
    ///
    /// # Errors
    /// [`BuildError`]; the player is unchanged then.
    pub fn switch_arithmetic(&mut self, arithmetic: ArithmeticKind) -> Result<(), BuildError> {
        if arithmetic == self.options.arithmetic {
            return Ok(());
        }
        let options = Options {
            arithmetic,
            ..self.options
        };
        let home = self.home.initial_state();
        let initial = InitialState {
            fluid: home.fluid,
            fluid_velocity: home.fluid_velocity,
            wall: home.wall,
            ..self.initial.clone()
        };
        let mut other = setup::simulation(&self.scene, &initial, &options)?;
        other.restore(&self.simulation.save().converted(arithmetic))?;
        self.simulation = other;
        self.options = options;
        Ok(())
    }

    /// Energies, momenta and speeds at present.
    ///
    /// # Errors
    /// As a step.
    pub fn measure(&mut self) -> Result<Diagnostics, Fault> {
        self.simulation.measure()
    }

    /// A copy of the present state, velocities along the arrow.
    pub fn save(&mut self) -> SavedState {
        self.simulation.save()
    }

    /// The digest of the present state with its velocities along physical time, whatever the arrow.
    pub fn digest(&mut self) -> Digest {
        self.with_arrow_forward(|simulation| simulation.digest())
    }

    fn with_arrow_forward<T>(&mut self, look: impl FnOnce(&mut dyn Simulation) -> T) -> T {
        let backward = self.arrow == Arrow::Backward;
        if backward {
            self.simulation.reverse();
        }
        let result = look(&mut *self.simulation);
        if backward {
            self.simulation.reverse();
        }
        result
    }

    /// How the present state differs from home. Digests are equal only in the same arithmetic; the
    /// distance is measured in either.
    pub fn compare_with_home(&mut self) -> Return {
        let digest = self.digest();
        let present = self.with_arrow_forward(|simulation| simulation.save());
        let home = if present.arithmetic == self.home.arithmetic {
            &self.home
        } else {
            &self.home.converted(present.arithmetic)
        };
        let d = present.dimension;
        let astray = present
            .positions()
            .chunks(d)
            .zip(home.positions().chunks(d))
            .filter(|(a, b)| a != b)
            .count();
        Return {
            home: self.home_digest,
            present: digest,
            error: present.largest_distance(home),
            astray,
        }
    }

    /// Gives back memory that only steps need, before something large is made of the state. The
    /// next step costs two more.
    pub fn release(&mut self) {
        self.simulation.release();
    }

    /// What the pair sums so far were made with: an instruction set, `serial` for the plain
    /// traversal, or both.
    #[must_use]
    pub fn backend(&self) -> String {
        self.simulation.backend()
    }

    /// The threads that take the steps, where there are others than the caller's.
    #[must_use]
    pub fn pool(&self) -> Option<Rayon> {
        self.simulation.pool()
    }

    /// The present state in SI units, as files are made of it.
    ///
    /// # Errors
    /// As a step.
    pub fn frame(&mut self) -> Result<Frame, Fault> {
        let mut frame = self.simulation.frame()?;
        frame.step = self.position.unsigned_abs();
        frame.time = self.time();
        frame.elapsed = self.steps_taken() as f64 * self.scene.time_step();
        frame.way_back = self.arrow == Arrow::Backward;
        Ok(frame)
    }

    /// What is drawn of it, in the memory of earlier points.
    ///
    /// # Errors
    /// As a step; the points are of no use then.
    pub fn points(&mut self, points: &mut Points) -> Result<(), Fault> {
        self.simulation.points(points)?;
        points.step = self.position.unsigned_abs();
        points.time = self.time();
        points.way_back = self.arrow == Arrow::Backward;
        Ok(())
    }
}
