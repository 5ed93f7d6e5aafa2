//! Home: what a picture has to know of a scene besides the frame.
//!
//! The initial places of the particles (for height, displacement and the tint), the box that the
//! view shows (see [`crate::framing`]), and the scales of speed and pressure by which colours are
//! chosen, so that one colour means the same in all frames of a run:
//!
//! - speed U = max(√(2 g H), twice the fastest first velocity), H the height of the fluid (m) along
//!   the gravity g (m/s²); a tenth of the sound speed where both are zero; in helium at least what
//!   the counterflow drives it to,
//! - pressure ρ₀ U², density ρ₀ (1 ± 3 U²/c²).

use loschmidt_core::model::Measure;
use loschmidt_core::schemes::superfluid::Helium;
use loschmidt_runner::Frame;
use loschmidt_runner::frame::FrameColumn;
use loschmidt_runner::scene::{Dimension, RegionKind, Scene};
use loschmidt_runner::setup::{self, FlowSpeeds};

/// A box along the axes, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Box3 {
    /// Lower corner, m.
    pub low: [f64; 3],
    /// Upper corner, m.
    pub high: [f64; 3],
}

impl Box3 {
    /// The smallest box around these points; `None` without points.
    pub fn around<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Option<Self> {
        points
            .map(|&x| Self { low: x, high: x })
            .reduce(Self::joined)
    }

    /// The smallest box around both.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
        }
    }

    /// Sizes, m.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        std::array::from_fn(|k| self.high[k] - self.low[k])
    }

    /// Centre, m.
    #[must_use]
    pub fn centre(&self) -> [f64; 3] {
        std::array::from_fn(|k| 0.5 * (self.low[k] + self.high[k]))
    }

    /// The box with its faces moved out by so much, m, along so many axes.
    pub(crate) fn grown(self, by: f64, axes: usize) -> Self {
        let by = |k: usize| if k < axes { by } else { 0.0 };
        Self {
            low: std::array::from_fn(|k| self.low[k] - by(k)),
            high: std::array::from_fn(|k| self.high[k] + by(k)),
        }
    }
}

/// The scales of superfluid helium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeliumScales {
    /// Its laws.
    pub laws: Helium,
    /// Of its motions.
    pub flow: FlowSpeeds,
    /// Of |s - s0|, J/(kg K).
    pub entropy: f64,
}

impl HeliumScales {
    /// By the entropies and the counterflow at home.
    fn of(laws: Helium, frame: &Frame) -> Self {
        let largest = |name: &str, from: f64| {
            let column = frame.columns.iter().find(|c| c.measure.name == name);
            let values = column.into_iter().flat_map(|column| &column.values);
            values.fold(0.0, |most: f64, x| most.max((x - from).abs()))
        };
        let excess = largest("entropy", laws.entropy) / laws.entropy;
        let counterflow = laws.normal_fraction * largest("counterflow speed", 0.0);
        let flow = setup::flow_speeds(&laws, excess, counterflow, fastest(frame));
        // A flow of this speed turns into waves of about this amplitude, and the other way round.
        let normal = laws.normal_fraction;
        let sound = laws.second_sound();
        let wave = if sound > 0.0 {
            flow.counterflow / sound * ((1.0 - normal) / normal)
        } else {
            0.0
        };
        Self {
            laws,
            flow,
            entropy: laws.entropy * excess.max(wave.min(1.0)),
        }
    }

    /// Of helium that is at rest at home and comes to about this speed, m/s, by a heater or by
    /// gravity: s0 times a difference of temperatures is the energy per mass that drives it, of which
    /// the flow has a part.
    fn driven(self, speed: f64) -> Self {
        let laws = self.laws;
        let warming = DRIVING * speed * speed / laws.entropy;
        Self {
            flow: FlowSpeeds {
                whole: speed,
                counterflow: speed,
            },
            entropy: laws.heat_capacity / laws.temperature * warming,
            ..self
        }
    }
}

/// What drives a flow over the square of its speed, in the scene `fountain` about.
const DRIVING: f64 = 4.0;

/// What stays the same in all pictures of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Home {
    /// Name of the scene.
    pub name: String,
    /// 2 or 3.
    pub dimension: usize,
    /// Side of the square or cube that a particle stands for, m.
    pub spacing: f64,
    /// Density without pressure, kg/m³.
    pub reference_density: f64,
    /// Sound speed, m/s.
    pub sound_speed: f64,
    /// Of shear waves in an elastic body, m/s; none in other matter.
    pub shear_speed: Option<f64>,
    /// What helium comes to; none in other matter.
    pub helium: Option<HeliumScales>,
    /// The scale U of speeds, m/s.
    pub speed: f64,
    /// The axis against gravity: 0 x, 1 y, 2 z. It is y where there is no gravity.
    pub up: usize,
    /// Places of the fluid at home, m, in the order of the ids.
    pub position: Vec<[f64; 3]>,
    /// The box around the fluid at home, m.
    pub fluid: Box3,
    /// The box that the view shows, m: it may grow with the fluid.
    pub shown: Box3,
    /// The box by whose shape the parts of a picture are laid out, m: that of the first view, so
    /// that none of them hops while the view grows.
    pub laid_out: Box3,
    /// The box around the walls, m.
    pub walls: Option<Box3>,
    /// Physical time of the turnaround, or of the end of a one-way run, s.
    pub span: f64,
    /// The columns of the model, with the least and the greatest value at home.
    pub columns: Vec<(Measure, [f64; 2])>,
}

impl Home {
    /// The home of a scene. `frame`: its first frame.
    #[must_use]
    pub fn new(scene: &Scene, frame: &Frame) -> Self {
        let dimension = match scene.dimension {
            Dimension::Two => 2,
            Dimension::Three => 3,
        };
        let spacing = scene.particle_spacing;
        let span = scene.steps_out() as f64 * scene.time_step();
        let nothing = Box3 {
            low: [0.0; 3],
            high: [0.0; 3],
        };
        let fluid = Box3::around(frame.position.iter())
            .map_or(nothing, |b| b.grown(0.5 * spacing, dimension));
        let walls =
            Box3::around(frame.wall_position.iter()).map(|b| b.grown(0.5 * spacing, dimension));
        let gravity = scene.gravity.uniform;
        let up = (0..3)
            .filter(|&k| gravity[k] != 0.0)
            .max_by(|&a, &b| gravity[a].abs().total_cmp(&gravity[b].abs()))
            // A column in space stands along z.
            .unwrap_or(if scene.solid.is_some() {
                dimension - 1
            } else {
                1
            });
        let fall = 2.0 * gravity[up].abs() * fluid.size()[up];
        let speed = fall.sqrt().max(2.0 * fastest(frame));
        let speed = speed.max(fastest_wall(scene, frame));
        let heated = scene.superfluid.is_some_and(|it| it.heater.is_some());
        let helium = scene.superfluid.map(|it| {
            let scales = HeliumScales::of(it.helium(), frame);
            if heated && speed > 0.0 {
                scales.driven(speed)
            } else {
                scales
            }
        });
        let shown = Self::first_view(fluid, walls, dimension);
        Self {
            name: scene.name.clone(),
            dimension,
            spacing,
            reference_density: scene.reference_density(),
            sound_speed: scene.sound_speed(),
            shear_speed: scene.solid.map(|solid| solid.shear_speed),
            helium,
            speed: if let Some(scales) = helium {
                speed.max(scales.flow.whole)
            } else if speed > 0.0 {
                speed
            } else {
                0.1 * scene.sound_speed()
            },
            up,
            position: frame.position.clone(),
            fluid,
            shown,
            laid_out: shown,
            walls,
            span,
            columns: frame.columns.iter().map(extremes).collect(),
        }
    }

    /// A range for a column: that at home, and its own width to either side.
    pub(crate) fn range_of(&self, name: &str) -> [f64; 2] {
        let mut columns = self.columns.iter();
        let Some((_, [low, high])) = columns.find(|(measure, _)| measure.name == name) else {
            return [0.0, 1.0];
        };
        let width = if high > low {
            high - low
        } else {
            high.abs().max(1.0)
        };
        [low - width, high + width]
    }
}

/// A column with its least and its greatest value.
fn extremes(column: &FrameColumn) -> (Measure, [f64; 2]) {
    let values = || column.values.iter().copied().filter(|x| x.is_finite());
    let range = match values().next() {
        None => [0.0, 1.0],
        Some(first) => [
            values().fold(first, f64::min),
            values().fold(first, f64::max),
        ],
    };
    (column.measure, range)
}

fn length(v: &[f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// The largest speed of walls, m/s.
fn fastest_wall(scene: &Scene, frame: &Frame) -> f64 {
    let walls = scene
        .regions
        .iter()
        .filter(|region| region.kind == RegionKind::Wall);
    let moving = walls.filter(|region| !region.velocity.is_empty());
    let speeds = moving.filter_map(|region| {
        let at = |x: &[f64; 3]| length(&region.velocity_at(*x));
        frame.wall_position.iter().map(at).reduce(f64::max)
    });
    speeds.fold(0.0, f64::max)
}

/// The largest speed, m/s.
fn fastest(frame: &Frame) -> f64 {
    frame.velocity.iter().map(length).fold(0.0, f64::max)
}
