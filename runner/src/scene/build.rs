//! From what was written to a [`Scene`]: defaults, missing keys, and the rules that join
//! several keys.
//!
//! Values that [`check`](super::check) has already refused are replaced by NaN or another
//! stand-in, which no rule complains about, so that one mistake gives one message.

use super::check::{check, dimension};
use super::error::{Problem, ProblemKind, Problems, SceneError};
use super::nearest::nearest;
use super::regions;
use super::schema::{self, Default, Kind, Section};
use super::source::is_name_character;
use super::spec::{Entry, SceneSpec, Span, Table, Value};
use super::types::{
    CentralGravity, Dimension, Fluid, Gravity, Output, Region, RegionKind, Scene, StepRule,
    WallModel, WallPotential, whole_steps,
};
use super::values::{as_table, finite, numbers};
use super::words::Word;

/// Stands in for a table that is not in the file: all its keys have their defaults.
const EMPTY_TABLE: &Table = &Table {
    entries: Vec::new(),
};

/// The most steps of a leg; every count below it is an exact f64.
const MOST_STEPS: u64 = 1 << 48;

/// A table and where messages about what it lacks point to.
#[derive(Clone, Copy)]
pub(super) struct Here<'a> {
    pub table: &'a Table,
    /// `None` is the top level of the file.
    pub span: Option<Span>,
    pub section: Section,
    /// The key that holds the table.
    pub name: &'a str,
}

impl Here<'_> {
    /// How a message names the table.
    fn title(&self) -> String {
        match self.section {
            Section::Block
            | Section::Ball
            | Section::Ellipsoid
            | Section::Shell
            | Section::Polygon
            | Section::Layer => format!("`{}`", self.name),
            section => section.title().to_owned(),
        }
    }

    /// Whether a key that does not exist was most likely meant to be `name`.
    fn misspells(&self, name: &str) -> bool {
        let names = || schema::keys(self.section).map(|key| key.name);
        self.table.entries.iter().any(|entry| {
            names().all(|known| known != entry.name) && nearest(&entry.name, names()) == Some(name)
        })
    }
}

/// Builds the scene and collects every mistake on the way.
pub(super) fn build(spec: &SceneSpec) -> Result<Scene, SceneError> {
    let mut builder = Builder {
        spec,
        dimension: dimension(&spec.root).unwrap_or(Dimension::Two),
        problems: check(spec),
    };
    let scene = builder.scene();
    if builder.problems.is_empty() {
        Ok(scene)
    } else {
        Err(SceneError::Invalid(Problems::new(builder.problems)))
    }
}

pub(super) struct Builder<'a> {
    spec: &'a SceneSpec,
    pub dimension: Dimension,
    problems: Vec<Problem>,
}

impl<'a> Builder<'a> {
    pub fn conflict(&mut self, message: String, span: Span, help: String) {
        self.problems.push(
            self.spec
                .problem(ProblemKind::Conflict, message, span, vec![help]),
        );
    }

    pub fn out_of_range(&mut self, message: String, span: Span, help: String) {
        self.problems.push(
            self.spec
                .problem(ProblemKind::OutOfRange, message, span, vec![help]),
        );
    }

    /// Reports that a table lacks something.
    pub fn missing(&mut self, here: Here, message: String, help: Vec<String>) {
        let problem = match here.span {
            Some(span) => self
                .spec
                .problem(ProblemKind::MissingKey, message, span, help),
            None => self.spec.problem_of_the_file(message, help),
        };
        self.problems.push(problem);
    }

    /// The entry `name`; its absence is reported when the schema requires it.
    pub fn entry(&mut self, here: Here<'a>, name: &str) -> Option<&'a Entry> {
        let entry = here.table.get(name);
        if entry.is_some() {
            return entry;
        }
        let key = schema::find(here.section, name)?;
        // One message for one mistake: the misspelt key is reported already.
        if key.default == Default::Required && !here.misspells(name) {
            let message = match (here.section, key.kind) {
                (Section::Top, Kind::Table(inner) | Kind::Tables(inner)) => {
                    format!("{} is missing", inner.title())
                }
                (Section::Top, _) => format!("`{name}` is missing"),
                _ => format!("{} needs `{name}`", here.title()),
            };
            let help = match key.kind {
                Kind::Table(_) | Kind::Tables(_) => format!("it says {}", key.meaning),
                _ => format!("`{name}` ({}): {}", key.unit_label(), key.meaning),
            };
            self.missing(here, message, vec![help]);
        }
        None
    }

    /// A number; NaN stands for one that was refused or is absent without a default.
    pub fn number(&mut self, here: Here<'a>, name: &str) -> f64 {
        match self.entry(here, name) {
            Some(entry) => accepted(here, entry),
            None => match schema::find(here.section, name).map(|key| key.default) {
                Some(Default::Number(x)) => x,
                _ => f64::NAN,
            },
        }
    }

    fn optional_number(&mut self, here: Here<'a>, name: &str) -> Option<f64> {
        here.table.get(name).map(|entry| accepted(here, entry))
    }

    pub fn vector(&mut self, here: Here<'a>, name: &str) -> [f64; 3] {
        self.entry(here, name)
            .map_or([0.0; 3], |entry| numbers(&entry.node))
    }

    fn text(&mut self, here: Here<'a>, name: &str) -> Option<&'a str> {
        match &self.entry(here, name)?.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A word; `None` when it was refused or is absent without a default.
    pub fn word<W: Word>(&mut self, here: Here<'a>, name: &str) -> Option<W> {
        if here.table.get(name).is_some() {
            return W::from_word(self.text(here, name)?);
        }
        match schema::find(here.section, name)?.default {
            Default::Word(word) => W::from_word(word),
            _ => {
                self.entry(here, name);
                None
            }
        }
    }

    /// The table `name`, if there is one.
    pub fn inner(&mut self, here: Here<'a>, name: &str, section: Section) -> Option<Here<'a>> {
        let entry = self.entry(here, name)?;
        Some(Here {
            table: as_table(&entry.node)?,
            span: Some(entry.node.span),
            section,
            name: &entry.name,
        })
    }

    fn scene(&mut self) -> Scene {
        let spec = self.spec;
        let top = Here {
            table: &spec.root,
            span: None,
            section: Section::Top,
            name: "",
        };
        let fluid = self.inner(top, "fluid", Section::Fluid);
        let regions = regions::regions(self, top);
        let wall_model = self.word(top, "wall_model").unwrap_or(WallModel::None);
        let scene = Scene {
            name: self.name(top),
            description: self.text(top, "description").unwrap_or("").to_owned(),
            source: self.text(top, "source").unwrap_or("").to_owned(),
            dimension: self.dimension,
            particle_spacing: self.number(top, "particle_spacing"),
            support: self.number(top, "support"),
            step: self.step(top),
            turnaround: self.optional_number(top, "turnaround"),
            end: self.optional_number(top, "end"),
            // The stand-ins for refused words are as good as any.
            model: self.word(top, "model").unwrap_or(super::Model::Standard),
            filter_every: self.number(top, "filter_every") as u64,
            integrator: self
                .word(top, "integrator")
                .unwrap_or(super::Integrator::StormerVerlet),
            density_correction: self
                .word(top, "density_correction")
                .unwrap_or(super::DensityCorrection::None),
            wall_model,
            fluid: Fluid {
                reference_density: fluid.map_or(f64::NAN, |f| self.number(f, "reference_density")),
                sound_speed: fluid.map_or(f64::NAN, |f| self.number(f, "sound_speed")),
                equation_of_state: fluid
                    .and_then(|f| self.word(f, "equation_of_state"))
                    .unwrap_or(super::EquationOfState::Linear),
                anti_clump_pressure: fluid
                    .map_or(f64::NAN, |f| self.number(f, "anti_clump_pressure")),
                anti_clump_radius: fluid.map_or(f64::NAN, |f| self.number(f, "anti_clump_radius")),
            },
            gravity: self.gravity(top),
            wall: self.wall(top, wall_model, &regions),
            output: self.output(top),
            regions,
        };
        self.times(top, &scene);
        self.composition(top, &scene);
        self.filter(top, &scene);
        scene
    }

    /// The standard scheme is a step of its own: another integrator would be ignored silently.
    fn composition(&mut self, top: Here<'a>, scene: &Scene) {
        let verlet = super::Integrator::StormerVerlet;
        if scene.model == super::Model::Standard
            && scene.integrator != verlet
            && let Some(entry) = top.table.get("integrator")
            && top.table.get("model").is_some()
        {
            self.conflict(
                format!(
                    "`integrator = \"{}\"` does not go with `model = \"standard\"`",
                    scene.integrator.word()
                ),
                entry.node.span,
                format!(
                    "the standard scheme has a kick, a drift and a kick of its own: write `integrator = \"{}\"`, or `model = \"symplectic\"`",
                    verlet.word()
                ),
            );
        }
    }

    /// A filter cannot be undone: a scene that has one has no way back.
    fn filter(&mut self, top: Here<'a>, scene: &Scene) {
        if scene.model == super::Model::Filtered
            && let Some(entry) = top.table.get("turnaround")
        {
            self.conflict(
                "`turnaround` does not go with `model = \"filtered\"`".to_owned(),
                entry.key,
                "the filter takes noise and energy out of the flow, and nothing brings them back: write `end`, or `model = \"symplectic\"`"
                    .to_owned(),
            );
        }
    }

    fn name(&mut self, top: Here<'a>) -> String {
        let Some(name) = self.text(top, "name") else {
            return self.spec.stem.clone();
        };
        let fit = !name.is_empty() && !name.starts_with('.') && name.chars().all(is_name_character);
        if !fit && let Some(entry) = top.table.get("name") {
            self.out_of_range(
                format!("`name` cannot be \"{}\"", name.escape_debug()),
                entry.node.span,
                "runs are filed under it: letters, digits, `-`, `_` and `.`, no dot in front"
                    .to_owned(),
            );
        }
        name.to_owned()
    }

    /// The time step by `cfl` or by `time_step`; of two, the one given as an override.
    fn step(&mut self, top: Here<'a>) -> StepRule {
        let cfl = top.table.get("cfl");
        let seconds = top.table.get("time_step");
        match (cfl, seconds) {
            (_, None) => return StepRule::Cfl(self.number(top, "cfl")),
            (Some(cfl), Some(seconds)) if cfl.key.is_override() && !seconds.key.is_override() => {
                return StepRule::Cfl(self.number(top, "cfl"));
            }
            (Some(cfl), Some(seconds)) if cfl.key.is_override() == seconds.key.is_override() => {
                let both = [(cfl, "cfl"), (seconds, "time_step")];
                let [(earlier, _), (later, name)] =
                    if (cfl.key.text, cfl.key.start) < (seconds.key.text, seconds.key.start) {
                        both
                    } else {
                        [both[1], both[0]]
                    };
                self.conflict(
                    format!("`{name}` is given although `{}` is", earlier.name),
                    later.key,
                    "the time step follows from one of `cfl` and `time_step`: remove the other"
                        .to_owned(),
                );
            }
            _ => {}
        }
        StepRule::Seconds(self.number(top, "time_step"))
    }

    fn output(&mut self, top: Here<'a>) -> Output {
        let table = EMPTY_TABLE;
        let here = self.inner(top, "output", Section::Output).unwrap_or(Here {
            table,
            span: None,
            section: Section::Output,
            name: "output",
        });
        // Whole numbers within the schema's ranges, or the NaN of a refused one.
        let mut count = |name| self.number(here, name) as u64;
        Output {
            rows: count("rows"),
            frames: count("frames"),
            snapshots: count("snapshots"),
        }
    }

    fn gravity(&mut self, top: Here<'a>) -> Gravity {
        let Some(here) = self.inner(top, "gravity", Section::Gravity) else {
            return Gravity {
                uniform: [0.0; 3],
                central: None,
            };
        };
        let central = self.inner(here, "central", Section::Central);
        Gravity {
            uniform: self.vector(here, "uniform"),
            central: central.map(|central| CentralGravity {
                centre: self.vector(central, "centre"),
                strength: self.number(central, "strength"),
                softening: self.number(central, "softening"),
            }),
        }
    }

    fn wall(
        &mut self,
        top: Here<'a>,
        model: WallModel,
        regions: &[Region],
    ) -> Option<WallPotential> {
        let here = self.inner(top, "wall", Section::Wall);
        let wall = regions
            .iter()
            .position(|region| region.kind == RegionKind::Wall);
        if let (None, Some(number), WallModel::Conservative) = (top.table.get("wall"), wall, model)
        {
            self.missing(
                top,
                format!("`[wall]` is missing: region {number} is a wall, and `wall_model` is \"conservative\""),
                vec![
                    "add `[wall]` with `energy` in J/kg, about 10 g H for a column of height H in m"
                        .to_owned(),
                    "or set `wall_model` to \"dummy\" or \"none\"".to_owned(),
                ],
            );
        }
        here.map(|here| WallPotential {
            energy: self.number(here, "energy"),
            radius: self.number(here, "radius"),
            softening: self.number(here, "softening"),
        })
    }

    /// Turnaround, end and time step must give a number of steps that can be run.
    fn times(&mut self, top: Here<'a>, scene: &Scene) {
        let turnaround = top.table.get("turnaround");
        let end = top.table.get("end");
        if turnaround.is_none() && end.is_none() {
            self.missing(
                top,
                "neither `turnaround` nor `end` is given: the run would not stop".to_owned(),
                vec![
                    "`turnaround` (s): the run goes there and back".to_owned(),
                    "`end` (s) alone: a one-way run".to_owned(),
                ],
            );
        }
        if let (Some(out), Some(stop), Some(entry)) = (scene.turnaround, scene.end, end)
            && (stop <= out || stop > 2.0 * out)
        {
            self.out_of_range(
                format!("`end` does not lie on the way back: {stop:?} s"),
                entry.node.span,
                format!(
                    "allowed: greater than {out} s, where time is turned, at most {} s, where the run is back",
                    2.0 * out
                ),
            );
        }
        let step = scene.time_step();
        if step.is_nan() {
            return;
        }
        let back = scene.turnaround.zip(scene.end);
        let legs = [
            (turnaround, scene.turnaround, "`turnaround`"),
            (end, scene.end.filter(|_| turnaround.is_none()), "`end`"),
            (
                end,
                back.map(|(out, stop)| stop - out),
                "the way back to `end`",
            ),
        ];
        for (entry, time, what) in legs {
            let (Some(entry), Some(time)) = (entry, time) else {
                continue;
            };
            // NaN and times that are refused already pass both tests.
            if time > 0.0 && whole_steps(time, step) == 0 {
                self.out_of_range(
                    format!("{what} is shorter than half a time step"),
                    entry.node.span,
                    format!("the time step is {step:?} s"),
                );
            } else if whole_steps(time, step) > MOST_STEPS {
                self.out_of_range(
                    format!("{what} takes more than 2^48 steps"),
                    entry.node.span,
                    format!("the time step is {step:?} s"),
                );
            }
        }
    }
}

/// The number of an entry, or NaN when it is refused.
fn accepted(here: Here, entry: &Entry) -> f64 {
    let range = schema::find(here.section, &entry.name).map(|key| key.range);
    finite(&entry.node)
        .filter(|&x| range.is_none_or(|range| range.contains(x)))
        .unwrap_or(f64::NAN)
}
