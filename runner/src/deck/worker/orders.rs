//! What the user commands.

use super::Worker;
use crate::deck::messages::{Command, Meddling, Perturbation, Refusal, Report, Seek};
use crate::player::Arrow;
use loschmidt_core::Reversibility;
use std::time::Instant;

impl Worker {
    pub(super) fn obey(&mut self, command: Command) {
        match command {
            Command::Play(play) => self.play(play),
            Command::Turn => self.turn(),
            Command::StepBy(steps) => {
                let under_way = self.seek.map(|seek| seek.target);
                self.seek_to(under_way.unwrap_or(self.player.position()) + steps);
            }
            Command::Seek(target) => self.seek_to(target),
            Command::Cancel => {
                if self.seek.take().is_some() {
                    self.pause();
                    (self.tell)(Report::SeekEnded(false));
                }
            }
            Command::Pace(pace) => {
                self.pace = pace;
                self.clock.set_rate(pace / self.player.scene().time_step());
            }
            Command::Reuse(points) => {
                self.spare = Some(points);
                return;
            }
            Command::Flip(particle) => {
                self.player.flip_last_bit(particle);
                self.meddled(Perturbation::Flipped(particle));
            }
            Command::Switch(arithmetic) => match self.player.switch_arithmetic(arithmetic) {
                Ok(()) => self.meddled(Perturbation::Switched(arithmetic)),
                Err(why) => (self.tell)(Report::Refused(why.into())),
            },
            Command::Keep { path, rows } => {
                let report = match self
                    .keeper
                    .keep(&mut self.player, &path, &rows, &self.meddling)
                {
                    Ok(()) => Report::Kept(path),
                    Err(why) => Report::NotKept(why.to_string()),
                };
                (self.tell)(report);
            }
        }
        self.report();
    }

    pub(super) fn play(&mut self, play: bool) {
        self.seek = None;
        if play {
            self.playing = true;
            self.clock.restart(Instant::now());
        } else {
            self.pause();
        }
    }

    pub(super) fn pause(&mut self) {
        self.playing = false;
        self.stand();
        let travel = self.player.arrow();
        self.measure(travel, false);
    }

    pub(super) fn turn(&mut self) {
        // Floating point may turn: to see it fail is an experiment. What has no way back may not.
        let returns = matches!(
            self.player.reversibility(),
            Reversibility::BitExact | Reversibility::UpToRounding
        );
        if let (false, Err(why)) = (returns, self.player.can_seek()) {
            return (self.tell)(Report::Refused(why.into()));
        }
        self.seek = None;
        self.player.turn();
        if let Some(companion) = &mut self.companion {
            companion.turn();
        }
        self.keep_good();
        self.travel = self.player.arrow();
        self.stand();
        (self.tell)(Report::Turned(self.player.arrow()));
    }

    pub(super) fn seek_to(&mut self, target: i64) {
        let position = self.player.position();
        if target < 0 && position == 0 && self.seek.is_none() {
            return (self.tell)(Report::Refused(Refusal::Start));
        }
        let target = target.max(0);
        if (target < position || self.player.arrow() == Arrow::Backward)
            && let Err(why) = self.player.can_seek()
        {
            return (self.tell)(Report::Refused(why.into()));
        }
        self.playing = false;
        self.clock.restart(Instant::now());
        if target != position {
            self.seek = Some(Seek {
                from: position,
                target,
            });
        } else {
            self.pause();
            (self.tell)(Report::SeekEnded(true));
        }
    }

    pub(super) fn meddled(&mut self, what: Perturbation) {
        let meddling = Meddling {
            what,
            position: self.player.position(),
            time: self.player.time(),
        };
        self.meddling.push(meddling);
        // One particle at least is astray from now on, if any way is known.
        self.astray = self.astray.map(|n| n.max(1));
        self.measured = false;
        self.keep_good();
        self.stand();
        (self.tell)(Report::Meddled(meddling));
    }
}
