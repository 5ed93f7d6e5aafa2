//! The arguments of `movie`.

use super::ExecutorName;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use loschmidt_viewer::theme_name::ThemeName;
use loschmidt_viewer::{Colormap, Colouring};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Arguments of `movie`.
#[derive(Args, Debug)]
pub struct MovieArguments {
    /// A scene file, the name of a scene of the catalogue, or the directory of a finished run,
    /// whose frames are then drawn without simulating again
    pub scene: String,
    /// Override a key of the scene; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Directory of the pictures [default: movies/SCENE-N, the next free N]; an interrupted movie
    /// in it is continued
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace an earlier movie
    #[arg(long)]
    pub force: bool,
    /// Print neither progress nor times
    #[arg(long, short)]
    pub quiet: bool,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (usize, usize),
    /// Pictures per second
    #[arg(
        long,
        value_name = "N",
        default_value = "30",
        value_parser = clap::value_parser!(u32).range(1..=100)
    )]
    pub fps: u32,
    /// Length of the movie; the pictures are evenly paced, home is the first and the last
    /// [default: 12, or what a finished run has frames for]
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub seconds: Option<f64>,
    /// What the colours say: some are columns of one model alone
    #[arg(long, value_name = "NAME", default_value = "speed", value_parser = colouring())]
    pub color: Colouring,
    /// Colour map [default: the one that suits the colours]
    #[arg(long)]
    pub colormap: Option<ColormapName>,
    /// Colours of everything else
    #[arg(long, default_value = "dark")]
    pub theme: ThemeName,
    /// A picture (PNG, JPEG, WebP, …) laid over the initial state: every particle takes its colour
    /// from it
    #[arg(long, value_name = "PICTURE", conflicts_with_all = ["color", "colormap"])]
    pub tint: Option<PathBuf>,
    /// Show this rectangle of a scene in the plane, m [default: the view follows the fluid]
    #[arg(
        long,
        value_name = "XMIN,YMIN,XMAX,YMAX",
        value_parser = rectangle,
        allow_hyphen_values = true,
        conflicts_with = "zoom"
    )]
    pub view: Option<[f64; 4]>,
    /// Magnify the middle of the picture
    #[arg(long, value_name = "FACTOR", value_parser = zoom)]
    pub zoom: Option<f64>,
    /// Go once around a scene in space
    #[arg(long)]
    pub orbit: bool,
    /// Show the same scene beside it in another arithmetic
    #[arg(long)]
    pub compare: Option<CompareName>,
    /// Make a GIF of the pictures, too
    #[arg(long, value_name = "FILE")]
    pub gif: Option<PathBuf>,
    /// Make an MP4 of the pictures, too; needs ffmpeg
    #[arg(long, value_name = "FILE")]
    pub mp4: Option<PathBuf>,
    /// Threads of the executor [default: as many as there are processors]
    #[arg(long, value_name = "N", value_parser = super::threads)]
    pub threads: Option<NonZeroUsize>,
    /// Who walks the particles [default: fast]
    #[arg(long)]
    pub executor: Option<ExecutorName>,
}

/// What a movie can be compared with.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum CompareName {
    /// Floating point, which does not return
    Float,
}

/// Reads what the colours say.
fn colouring() -> impl TypedValueParser<Value = Colouring> {
    let values = Colouring::known().into_iter().map(|colouring| {
        let help = match &colouring {
            Colouring::Speed => "Speed".to_owned(),
            Colouring::InitialHeight => "Height at the start".to_owned(),
            Colouring::Displacement => "Distance from the place at the start".to_owned(),
            other => {
                let title = other.title();
                let (first, rest) = title.split_at(1);
                first.to_uppercase() + rest
            }
        };
        PossibleValue::new(colouring.name()).help(help)
    });
    PossibleValuesParser::new(values).map(|name| Colouring::by_name(&name).unwrap_or_default())
}

/// Names of the colour maps.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum ColormapName {
    /// Blue, green, yellow
    Viridis,
    /// Purple, orange, yellow
    Magma,
    /// Blue, grey, yellow
    Cividis,
    /// Blue, grey, red, for numbers with a middle
    Coolwarm,
}

impl From<ColormapName> for Colormap {
    fn from(name: ColormapName) -> Self {
        match name {
            ColormapName::Viridis => Self::Viridis,
            ColormapName::Magma => Self::Magma,
            ColormapName::Cividis => Self::Cividis,
            ColormapName::Coolwarm => Self::CoolWarm,
        }
    }
}

/// Sizes of a picture in pixels, smallest and largest.
const SIZES: [usize; 2] = [64, 7680];

fn size(text: &str) -> Result<(usize, usize), String> {
    let allowed = |n: &usize| (SIZES[0]..=SIZES[1]).contains(n);
    let parsed = text.split_once('x').and_then(|(width, height)| {
        let side = |text: &str| text.parse().ok().filter(allowed);
        Some((side(width)?, side(height)?))
    });
    let [smallest, largest] = SIZES;
    parsed.ok_or_else(|| {
        format!("allowed: WIDTHxHEIGHT, such as 1280x720, both from {smallest} to {largest} pixels")
    })
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(s) if s > 0.0 && s <= 3600.0 => Ok(s),
        _ => Err("allowed: a number above 0 and at most 3600 s".to_owned()),
    }
}

fn rectangle(text: &str) -> Result<[f64; 4], String> {
    let sides: Result<Vec<f64>, _> = text.split(',').map(|side| side.trim().parse()).collect();
    match sides.as_deref() {
        Ok(&[left, bottom, right, top])
            if left < right
                && bottom < top
                && [left, bottom, right, top].iter().all(|x| x.abs() < 1e30) =>
        {
            Ok([left, bottom, right, top])
        }
        _ => Err(
            "allowed: four numbers in m, such as 0,0,4,2.5, the first below the third and the \
             second below the fourth"
                .to_owned(),
        ),
    }
}

/// Magnifications of a movie, smallest and largest.
const ZOOMS: [f64; 2] = [0.01, 1000.0];

fn zoom(text: &str) -> Result<f64, String> {
    let [smallest, largest] = ZOOMS;
    match text.parse::<f64>() {
        Ok(factor) if (smallest..=largest).contains(&factor) => Ok(factor),
        _ => Err(format!(
            "allowed: a number from {smallest} to {largest}; 1 shows the whole scene"
        )),
    }
}
