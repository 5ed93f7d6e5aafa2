//! The keys of the time step, which is given by one of two.

use super::builder::{Builder, Here};
use super::declare::Keys;
use super::page::{Page, number};
use super::schema::{Family, Range, SceneKey, ValueType, key};
use super::spec::Entry;
use super::{solid, viscous};

/// How the time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepRule {
    /// The Courant number: time step = number * support radius / speed, the
    /// [`step_speed`](super::Scene::step_speed).
    Cfl(f64),
    /// The time step itself, s.
    Seconds(f64),
}

const CFL: SceneKey = key("cfl", ValueType::Number)
    .within(Range::AboveUpTo(0.0, 2.0))
    .or(0.2)
    .means("Courant number: time step = cfl * h / sound_speed");

/// As [`CFL`], with what it means where particles carry a distortion: see [`Solid::step_speed`](super::Solid::step_speed).
const CFL_OF_DISTORTION: SceneKey = CFL.means(
    "Courant number: time step = cfl * h / sqrt(c_L² + 4 c_p²), \
     c_L the speed of longitudinal waves",
);

const TIME_STEP: SceneKey = key("time_step", ValueType::Number)
    .unit("s")
    .within(Range::Above(0.0))
    .means("time step, in place of cfl");

impl Keys for StepRule {
    const KEYS: &'static [SceneKey] = &[CFL, TIME_STEP];
    const FAMILY: Option<Family> = None;

    /// Of two that are given, the one in an override counts.
    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Self {
        let cfl = here.table.get(CFL.name);
        let seconds = here.table.get(TIME_STEP.name);
        match (cfl, seconds) {
            (_, None) => return Self::Cfl(builder.number(here, CFL.name)),
            (Some(cfl), Some(seconds)) if cfl.key.is_override() && !seconds.key.is_override() => {
                return Self::Cfl(builder.number(here, CFL.name));
            }
            (Some(cfl), Some(seconds)) if cfl.key.is_override() == seconds.key.is_override() => {
                let place = |entry: &Entry| (entry.key.text, entry.key.start);
                let (earlier, later) = if place(cfl) < place(seconds) {
                    (cfl, seconds)
                } else {
                    (seconds, cfl)
                };
                builder.conflict(
                    format!("`{}` is given although `{}` is", later.name, earlier.name),
                    later.key,
                    "the time step follows from one of `cfl` and `time_step`: remove the other"
                        .to_owned(),
                );
            }
            _ => {}
        }
        Self::Seconds(builder.number(here, TIME_STEP.name))
    }

    fn print(values: Option<&Self>, page: &mut Page) {
        let (cfl, seconds) = match values {
            Some(Self::Cfl(cfl)) => (Some(number(*cfl)), None),
            Some(Self::Seconds(seconds)) => (None, Some(number(*seconds))),
            None => (None, None),
        };
        let key = if page.is_of(solid::FAMILY) || page.is_of(viscous::FAMILY) {
            &CFL_OF_DISTORTION
        } else {
            &CFL
        };
        page.value_of(key, cfl);
        page.value(TIME_STEP.name, seconds);
    }
}
