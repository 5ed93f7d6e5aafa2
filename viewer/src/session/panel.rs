//! The panel of parameters: what a scene can be started anew with.

use super::request::{Answer, MOST_THREADS, Request};
use crate::keys::Key;
use loschmidt_runner::Options;
use loschmidt_runner::scene::Scene;

/// The panel of parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Panel {
    /// The key of the speed of sound, which depends on the model.
    sound: &'static str,
    /// Values as they are typed, in the order of [`Panel::FIELDS`].
    pub values: [String; 4],
    /// The values before.
    pub before: [String; 4],
    /// The field that is edited.
    pub field: usize,
    /// Whether the field is untouched, so that typing replaces it.
    fresh: bool,
    /// Why the values were refused.
    pub problem: Option<String>,
}

impl Panel {
    /// Name, unit and key of a scene.
    pub const FIELDS: [(&'static str, &'static str, &'static str); 4] = [
        ("particle spacing", "m", "particle_spacing"),
        ("sound speed", "m/s", "fluid.sound_speed"),
        ("integrator", "", "integrator"),
        ("threads", "", ""),
    ];
    /// What the integrator can be.
    const INTEGRATORS: [&'static str; 3] = ["stormer-verlet", "pefrl", "suzuki"];
    /// The field of the integrator, which is chosen and not typed.
    const INTEGRATOR: usize = 2;
    /// The field of the speed of sound; its key in a scene of water.
    const SOUND: usize = 1;
    /// Its keys in scenes of solids and of viscous fluids.
    const SOUND_OF_DISTORTION: [&'static str; 2] = ["solid.bulk_speed", "viscous.bulk_speed"];
    /// The field of the threads, which are no key of a scene.
    const THREADS: usize = 3;

    /// The panel of a scene that is open.
    #[must_use]
    pub fn new(scene: &Scene, options: &Options) -> Self {
        let solid = scene.solid.map(|solid| solid.bulk_speed);
        let viscous = scene.viscous.map(|viscous| viscous.bulk_speed);
        let [of_solids, of_viscous] = Self::SOUND_OF_DISTORTION;
        let (sound, speed) = match (solid, viscous) {
            (Some(speed), _) => (of_solids, speed),
            (None, Some(speed)) => (of_viscous, speed),
            (None, None) => (Self::FIELDS[Self::SOUND].2, scene.sound_speed()),
        };
        let values = [
            scene.particle_spacing.to_string(),
            speed.to_string(),
            scene.integrator.word().to_owned(),
            options.threads.to_string(),
        ];
        Self {
            before: values.clone(),
            values,
            sound,
            field: 0,
            fresh: true,
            problem: None,
        }
    }

    /// A field as it is shown: where it is edited, with these marks before and behind what is
    /// chosen, and behind what is typed.
    #[must_use]
    pub fn shown(&self, field: usize, [before, behind, cursor]: [char; 3]) -> String {
        let value = &self.values[field];
        match (field == Self::INTEGRATOR, field == self.field) {
            (true, true) => format!("{before} {value} {behind}"),
            (false, true) => format!("{value}{cursor}"),
            _ => value.clone(),
        }
    }

    /// What a key does in it. `open`: what is open.
    pub fn key(&mut self, key: Key, open: &Request) -> Answer {
        let last = Self::FIELDS.len() - 1;
        let typed = self.field != Self::INTEGRATOR;
        self.problem = None;
        match key {
            Key::Escape => return Answer::Close,
            Key::Enter => match self.request(open) {
                Ok(request) => return Answer::Open(request),
                Err(why) => self.problem = Some(why),
            },
            Key::Up | Key::BackTab => self.edit(self.field.checked_sub(1).unwrap_or(last)),
            Key::Down | Key::Tab => self.edit((self.field + 1) % (last + 1)),
            Key::Right | Key::Space if !typed => self.choose(1),
            Key::Left if !typed => self.choose(Self::INTEGRATORS.len() - 1),
            Key::Backspace if typed => {
                self.fresh = false;
                self.values[self.field].pop();
            }
            // Also what no number has in it: an error says more than a key that does nothing.
            Key::Char(c) if typed && !c.is_control() => {
                let value = &mut self.values[self.field];
                if self.fresh {
                    value.clear();
                }
                self.fresh = false;
                if value.len() < 16 {
                    value.push(c);
                }
            }
            _ => {}
        }
        Answer::Stay
    }

    fn edit(&mut self, field: usize) {
        self.field = field;
        self.fresh = true;
    }

    fn choose(&mut self, by: usize) {
        let all = Self::INTEGRATORS;
        let now = &self.values[Self::INTEGRATOR];
        let place = all.iter().position(|name| name == now).unwrap_or(0);
        self.values[Self::INTEGRATOR] = all[(place + by) % all.len()].to_owned();
    }

    /// What is opened when the values are taken.
    fn request(&self, open: &Request) -> Result<Request, String> {
        let mut set = open.set.clone();
        let mut changed = false;
        for (n, (_, _, key)) in Self::FIELDS.iter().enumerate() {
            let key = if n == Self::SOUND { self.sound } else { *key };
            if n != Self::THREADS && self.values[n] != self.before[n] {
                set.retain(|old| !old.starts_with(&format!("{key}=")));
                set.push(format!("{key}={}", self.values[n]));
                changed = true;
            }
        }
        let threads = match self.values[Self::THREADS].parse::<usize>() {
            Ok(n) if (1..=MOST_THREADS).contains(&n) => n,
            _ => return Err(format!("threads: a whole number from 1 to {MOST_THREADS}")),
        };
        // A run is what it is; its scene can be played otherwise.
        let base = match changed {
            true => open.anew(),
            false => open.clone(),
        };
        Ok(Request {
            set,
            threads: Some(threads),
            ..base
        })
    }
}
