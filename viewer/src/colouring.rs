//! What the colour of a particle says.

use crate::colour::{Colormap, Palette, Rgb};
use crate::home::{HeliumScales, Home};
use loschmidt_core::model::Measure;
use loschmidt_runner::scene::Scene;
use loschmidt_runner::{Points, setup};
use std::sync::Arc;

/// What the colour of a particle says.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Colouring {
    /// Its speed.
    #[default]
    Speed,
    /// One of the columns of its model.
    Column(Measure),
    /// Its height at home.
    InitialHeight,
    /// Its distance from home.
    Displacement,
    /// Colours of its own, in the order of the ids: those of a picture, by
    /// [`crate::Picture::tint`].
    Picture(Arc<[Rgb]>),
}

impl Colouring {
    /// The density of water.
    pub const DENSITY: Self = Self::Column(Measure {
        name: "density",
        unit: "kg/m³",
    });
    /// The pressure of water.
    pub const PRESSURE: Self = Self::Column(Measure {
        name: "pressure",
        unit: "Pa",
    });
    /// Those of water that a number and a legend belong to.
    pub const MEASURED: [Self; 5] = [
        Self::Speed,
        Self::DENSITY,
        Self::PRESSURE,
        Self::InitialHeight,
        Self::Displacement,
    ];

    /// Those of a model with these columns that a number and a legend belong to.
    pub fn choices(columns: impl Iterator<Item = Measure>) -> Vec<Self> {
        let columns = columns.map(Self::Column);
        let places = [Self::InitialHeight, Self::Displacement];
        std::iter::once(Self::Speed)
            .chain(columns)
            .chain(places)
            .collect()
    }

    /// Those of every model of the program that a number and a legend belong to.
    #[must_use]
    pub fn known() -> Vec<Self> {
        Self::choices(setup::every_column().into_iter())
    }

    /// The name used on the command line: small letters, and hyphens between words.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Speed => "speed".to_owned(),
            Self::Column(measure) => measure.name.to_lowercase().replace(' ', "-"),
            Self::InitialHeight => "initial-height".to_owned(),
            Self::Displacement => "displacement".to_owned(),
            Self::Picture(_) => "picture".to_owned(),
        }
    }

    /// The known one of this name.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        Self::known().into_iter().find(|c| c.name() == name)
    }

    /// Whether particles of this scene have what it shows.
    #[must_use]
    pub fn fits(&self, scene: &Scene) -> bool {
        match self {
            Self::Column(measure) => setup::columns(scene).contains(measure),
            _ => true,
        }
    }

    /// Title of the legend.
    #[must_use]
    pub fn title(&self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Column(measure) => measure.name,
            Self::InitialHeight => "initial height",
            Self::Displacement => "distance from home",
            Self::Picture(_) => "picture",
        }
    }

    /// Unit of the legend. In the plane a run is a metre deep.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Speed => "m/s",
            Self::Column(measure) => measure.unit,
            Self::InitialHeight | Self::Displacement => "m",
            Self::Picture(_) => "",
        }
    }

    /// The colour map that suits it.
    #[must_use]
    pub fn colormap(&self) -> Colormap {
        match self {
            Self::Speed | Self::Picture(_) | Self::InitialHeight => Colormap::Viridis,
            Self::Column(measure) if ONE_SIDED.contains(&measure.name) => Colormap::Viridis,
            Self::Column(_) => Colormap::CoolWarm,
            Self::Displacement => Colormap::Magma,
        }
    }

    /// The numbers at the ends of the legend, the same for a whole run.
    #[must_use]
    pub fn range(&self, home: &Home) -> [f64; 2] {
        let u2 = home.speed * home.speed;
        match self {
            Self::Speed => [0.0, round_number(home.speed)],
            Self::Column(measure) if let Some(shear_speed) = home.shear_speed => {
                range_of_a_solid(measure, home, shear_speed)
            }
            Self::Column(measure) if let Some(helium) = &home.helium => {
                range_in_helium(measure, home, helium)
            }
            Self::Column(measure) if measure.name == "density" => {
                let swing = round_number(3.0 * u2 / (home.sound_speed * home.sound_speed));
                [1.0 - swing, 1.0 + swing].map(|x| x * home.reference_density)
            }
            Self::Column(measure) if measure.name == "pressure" => {
                let swing = round_number(home.reference_density * u2);
                [-swing, swing]
            }
            Self::Column(measure) => home.range_of(measure.name),
            Self::InitialHeight => {
                let (low, high) = (home.fluid.low[home.up], home.fluid.high[home.up]);
                // The bottom of a basin is at 0 m, whatever rounding has made of it.
                let low = if low.abs() < 1e-9 * (high - low) {
                    0.0
                } else {
                    low
                };
                [low, high]
            }
            Self::Displacement => {
                let largest = home.fluid.size().into_iter().fold(0.0, f64::max);
                [0.0, round_number(largest)]
            }
            Self::Picture(_) => [0.0, 1.0],
        }
    }

    /// The number of the particle at this place in the lists, in the legend's unit.
    #[must_use]
    pub fn value(&self, points: &Points, home: &Home, place: usize) -> f64 {
        let at_home = |place: usize| {
            let id = points.id.get(place).map_or(place, |&id| id as usize);
            home.position.get(id).copied().unwrap_or_default()
        };
        match self {
            Self::Speed => points.speed[place].into(),
            Self::Column(measure) => {
                let column = points.column(measure.name);
                column.map_or(0.0, |values| values[place].into())
            }
            Self::InitialHeight => at_home(place)[home.up],
            Self::Displacement => {
                // At home it is 0: rounded as the points are.
                let (x, h) = (points.at(place), at_home(place));
                length(std::array::from_fn(|k| x[k] - f64::from(h[k] as f32)))
            }
            Self::Picture(_) => 0.0,
        }
    }
}

/// Columns that are nowhere negative.
const ONE_SIDED: [&str; 6] = [
    "von Mises stress",
    "strain energy",
    "normal speed",
    "superfluid speed",
    "counterflow speed",
    "separation",
];

/// What a column of superfluid helium can come to. Pressures follow the momentum that the
/// counterflow u carries, rho (chi_s/chi_n) u².
fn range_in_helium(measure: &Measure, home: &Home, scales: &HeliumScales) -> [f64; 2] {
    let (laws, u) = (&scales.laws, scales.flow.counterflow);
    let around = |x: f64, swing: f64| [x - swing, x + swing];
    let normal = laws.normal_fraction;
    let carried = (1.0 - normal) / normal * (u * u);
    let swing = round_number(carried / (laws.sound_speed * laws.sound_speed));
    match measure.name {
        "density" => around(1.0, swing).map(|x| x * home.reference_density),
        "pressure" => around(0.0, round_number(home.reference_density * carried)),
        "entropy" => around(laws.entropy, round_number(scales.entropy)),
        "temperature" => {
            let swing = laws.temperature * scales.entropy / laws.heat_capacity;
            around(laws.temperature, round_number(swing))
        }
        "separation" => [0.0, round_number(1e-3 * u)],
        _ => [0.0, round_number(u / normal)],
    }
}

/// What a column of an elastic body can come to: a body that moves with the speed u is strained by
/// about u/c, and its stress is about rho c u.
fn range_of_a_solid(measure: &Measure, home: &Home, shear_speed: f64) -> [f64; 2] {
    let (u, density) = (0.5 * home.speed, home.reference_density);
    let around = |x: f64, swing: f64| [x - swing, x + swing];
    match measure.name {
        "density" => around(1.0, round_number(u / home.sound_speed)).map(|x| x * density),
        "pressure" => around(0.0, round_number(density * shear_speed * u)),
        "von Mises stress" => [0.0, round_number(2.0 * density * shear_speed * u)],
        "strain energy" => [0.0, round_number(0.5 * u * u)],
        name => {
            let diagonal = matches!(name.as_bytes(), [.., a, b] if a == b);
            let swing = round_number((2.0 * u / shear_speed).min(1.0));
            around(f64::from(u8::from(diagonal)), swing)
        }
    }
}

/// The largest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is at most slightly
/// above `x`; 1 for what is not positive.
pub(crate) fn round_number(x: f64) -> f64 {
    if !(x > 0.0 && x.is_finite()) {
        return 1.0;
    }
    let mut power = 1.0;
    while power > x {
        power /= 10.0;
    }
    while power * 10.0 <= x {
        power *= 10.0;
    }
    const STEPS: [f64; 10] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
    let fits = |step: &&f64| **step * power <= x * 1.05;
    power * STEPS.iter().rfind(fits).unwrap_or(&1.0)
}

fn length(x: [f64; 3]) -> f64 {
    (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt()
}

/// Colours by number, with everything looked up beforehand.
pub(crate) struct Painter<'a> {
    colouring: &'a Colouring,
    colours: [Rgb; COLOURS],
    low: f64,
    factor: f64,
}

/// Colours of a map that are told apart.
const COLOURS: usize = 256;

impl<'a> Painter<'a> {
    pub fn new(colouring: &'a Colouring, palette: Palette, range: [f64; 2]) -> Self {
        let width = range[1] - range[0];
        Self {
            colouring,
            colours: std::array::from_fn(|n| palette.at(n as f64 / (COLOURS - 1) as f64)),
            low: range[0],
            factor: if width > 0.0 {
                COLOURS as f64 / width
            } else {
                0.0
            },
        }
    }

    /// The colour of the particle at this place.
    pub fn colour(&self, points: &Points, home: &Home, place: usize) -> Rgb {
        if let Colouring::Picture(colours) = self.colouring {
            let id = points.id.get(place).map_or(place, |&id| id as usize);
            return colours.get(id).copied().unwrap_or_default();
        }
        self.of(self.colouring.value(points, home, place))
    }

    /// The colours of as many particles as `colours` has room for, from this place on. What is
    /// asked once for all of them is not asked for each.
    #[inline(always)]
    pub fn colours(&self, points: &Points, home: &Home, first: usize, colours: &mut [Rgb]) {
        let list = match self.colouring {
            Colouring::Speed => &points.speed[..],
            Colouring::Column(measure) => points.column(measure.name).unwrap_or_default(),
            _ => {
                for (k, colour) in colours.iter_mut().enumerate() {
                    *colour = self.colour(points, home, first + k);
                }
                return;
            }
        };
        for (colour, &value) in colours
            .iter_mut()
            .zip(list.get(first..).unwrap_or_default())
        {
            *colour = self.of(value.into());
        }
    }

    /// The colour of a number.
    #[inline(always)]
    fn of(&self, value: f64) -> Rgb {
        // The conversion takes what is below, and NaN, to 0.
        let n = ((value - self.low) * self.factor) as u32;
        self.colours[n.min(COLOURS as u32 - 1) as usize]
    }
}
