//! Errors of a scene, each printed whole: what is wrong, where it stands, what would be right.

use std::error::Error;
use std::fmt;
use std::io;

use super::catalogue::catalogue;
use super::schema::listed;
use crate::isc::NotConverged;

/// Why there is no scene, or no initial state of a scene.
///
/// `Display` gives the complete message for a terminal; it begins with `error: `.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The text or an override is wrong; every mistake found is listed.
    #[error("{0}")]
    Invalid(Problems),
    /// A name that is neither a scene of the catalogue nor a path.
    #[error("error: no scene is called `{name}`{}", scene_help(*.nearest))]
    UnknownScene {
        /// The name asked for.
        name: String,
        /// The catalogue's name most like it.
        nearest: Option<&'static str>,
    },
    /// There is no such file.
    #[error(
        "error: the scene file `{path}` does not exist\nhelp: `loschmidt scenes` lists the \
         scenes that need no file"
    )]
    NotFound {
        /// The path as it was given.
        path: String,
    },
    /// The path names a folder.
    #[error("error: `{path}` is a folder, not a scene file")]
    Directory {
        /// The path as it was given.
        path: String,
    },
    /// The system refused to read the file.
    #[error("error: the scene file `{path}` cannot be read: {reason}")]
    Unreadable {
        /// The path as it was given.
        path: String,
        /// What the system said.
        #[source]
        reason: io::Error,
    },
    /// The file is not text.
    #[error(
        "error: the scene file `{path}` is not UTF-8 text: line {line} holds other bytes\nhelp: \
         save it as UTF-8"
    )]
    NotUtf8 {
        /// The path as it was given.
        path: String,
        /// The first line that is not UTF-8, counted from 1.
        line: usize,
    },
    /// The file is longer than any scene.
    #[error(
        "error: the scene file `{path}` is longer than {limit} MiB\nhelp: shapes of many parts can \
         be drawn by fewer, larger ones"
    )]
    TooLong {
        /// The path as it was given.
        path: String,
        /// Mebibytes that are allowed.
        limit: u64,
    },
    /// The regions hold no particle that a model moves.
    #[error(
        "error: scene `{scene}` has no {kind} particle at a particle spacing of \
         {particle_spacing:?} m\nhelp: a {kind} region must hold at least one node of its \
         lattice, the first of which lies half a spacing inside its lower corner"
    )]
    NoFluid {
        /// Name of the scene.
        scene: String,
        /// Particle spacing, m.
        particle_spacing: f64,
        /// Fluid or solid.
        kind: &'static str,
    },
    /// A region without a particle.
    #[error(
        "error: region {} of scene `{scene}` ({}) holds no particle at a particle spacing of \
         {particle_spacing:?} m\nhelp: {help}",
        .region.0,
        .region.1
    )]
    EmptyRegion {
        /// Name of the scene.
        scene: String,
        /// Number of the region in file order, from 0, and its description.
        region: (usize, String),
        /// Particle spacing, m.
        particle_spacing: f64,
        /// What may be done.
        help: String,
    },
    /// The initial state correction found no positions of equal density.
    #[error(
        "error: scene `{scene}`: {reason}\nhelp: set `density_correction` to \"constant\", or \
         change the lattice or the shape of the fluid"
    )]
    NotCorrected {
        /// Name of the scene.
        scene: String,
        /// How far it came.
        #[source]
        reason: NotConverged,
    },
    /// Two regions fill one place.
    #[error(
        "error: two regions of scene `{scene}` overlap, at ({}): {}\n  \
         region {}: {}\n  region {}: {}\n\
         help: regions may touch but not overlap: \
         subtract one shape from the other with `difference`{}\n\
         help: `overlap = \"allow\"` fills both as they are",
        coordinates(.point),
        overlap(*.apart),
        .regions[0].0,
        .regions[0].1,
        .regions[1].0,
        .regions[1].1,
        if .apart.is_some() {
            ", and make their sizes and distances multiples of `particle_spacing`"
        } else {
            ""
        }
    )]
    Overlap {
        /// Name of the scene.
        scene: String,
        /// Numbers of the regions in file order, from 0, and their descriptions.
        regions: Box<[(usize, String); 2]>,
        /// A particle there, m; as many coordinates as dimensions.
        point: Vec<f64>,
        /// How near the particles of both are to each other there, in spacings; `None` where a
        /// particle of one lies in the shape of the other without being near to any of its.
        apart: Option<f64>,
    },
    /// Two bodies start within the reach of each other's forces.
    #[error(
        "error: two bodies of scene `{scene}` start too near to each other, at ({})\n  \
         region {}: {}\n  region {}: {}\n\
         help: particles of different bodies begin at least one support radius apart, {reach} m; \
         regions of one `body` may touch",
        coordinates(.point),
        .regions[0].0,
        .regions[0].1,
        .regions[1].0,
        .regions[1].1
    )]
    BodiesTooNear {
        /// Name of the scene.
        scene: String,
        /// Numbers of the regions in file order, from 0, and their descriptions.
        regions: Box<[(usize, String); 2]>,
        /// The point, m; as many coordinates as dimensions.
        point: Vec<f64>,
        /// The least distance, m.
        reach: f64,
    },
    /// More particles than 32-bit indices can hold.
    #[error(
        "error: scene `{scene}` would have about {particles} particles; at most {limit} are \
         possible\nhelp: raise `particle_spacing`, which is {particle_spacing:?} m"
    )]
    TooManyParticles {
        /// Name of the scene.
        scene: String,
        /// Estimated number of particles, fluid and wall.
        particles: u64,
        /// The most that is allowed.
        limit: u64,
        /// Particle spacing, m.
        particle_spacing: f64,
    },
    /// A shape whose parts lie so far apart that its bounds cannot be searched.
    #[error(
        "error: the shape of region {region} of scene `{scene}` spreads over {nodes} lattice \
         nodes, too many to search\nhelp: give every part of the shape its own `[[region]]`, or \
         raise `particle_spacing`"
    )]
    TooSparse {
        /// Name of the scene.
        scene: String,
        /// Number of the region in file order, from 0.
        region: usize,
        /// Number of lattice nodes in the bounds of the shape.
        nodes: u64,
    },
    /// Particles start outside of what the scene says they may come to.
    #[error(
        "error: the particles of scene `{scene}` start as far as {reach:?} m from the origin along \
         an axis, and `domain` is {domain:?} m\nhelp: allowed: at least {reach:?} m, with room for \
         where they go"
    )]
    OutsideDomain {
        /// Name of the scene.
        scene: String,
        /// Largest coordinate, m.
        reach: f64,
        /// The largest one that was allowed, m.
        domain: f64,
    },
    /// So far from the origin that neighbouring lattice nodes round to one number.
    #[error(
        "error: region {region} of scene `{scene}` reaches {reach:?} m from the origin, too far \
         for a particle spacing of {particle_spacing:?} m: rounding would bend its lattice\n\
         help: move the scene towards the origin or raise `particle_spacing`"
    )]
    TooFar {
        /// Name of the scene.
        scene: String,
        /// Number of the region in file order, from 0.
        region: usize,
        /// Largest coordinate, m.
        reach: f64,
        /// Particle spacing, m.
        particle_spacing: f64,
    },
}

fn scene_help(nearest: Option<&str>) -> String {
    let names: Vec<String> = catalogue()
        .iter()
        .map(|entry| format!("`{}`", entry.name))
        .collect();
    let suggestion = nearest.map_or(String::new(), |name| {
        format!("\nhelp: did you mean `{name}`?")
    });
    format!(
        "{suggestion}\nhelp: the scenes are {}; a file is given by its path",
        listed(&names, "and")
    )
}

fn overlap(apart: Option<f64>) -> String {
    match apart {
        Some(apart) => {
            format!("their particles are {apart:.2} spacings apart there, at least 0.8 are wanted")
        }
        None => "a particle of one lies in the shape of the other".to_owned(),
    }
}

fn coordinates(point: &[f64]) -> String {
    let numbers: Vec<String> = point.iter().map(|x| format!("{x:?}")).collect();
    numbers.join(", ")
}

/// What sort of mistake a [`Problem`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ProblemKind {
    /// The text is not TOML.
    Syntax,
    /// A key that does not exist.
    UnknownKey,
    /// A value of the wrong type or length.
    WrongType,
    /// A value of the right type that is not allowed.
    OutOfRange,
    /// A key that must be given is not.
    MissingKey,
    /// Values that exclude each other.
    Conflict,
    /// An override that names no place in the scene.
    Override,
}

/// One mistake in the text of a scene or in an override.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// What sort of mistake it is.
    pub kind: ProblemKind,
    /// What is wrong, in one line.
    pub message: String,
    /// Where it stands.
    pub place: Place,
    /// What would be right: ranges, units, names.
    pub help: Vec<String>,
}

/// A place in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file's path, `--set` for an override.
    pub file: String,
    /// The line and the characters on it; `None` stands for the whole file.
    pub line: Option<Line>,
    /// Order of the place among all texts, by which messages are sorted.
    pub(super) order: (usize, usize),
}

/// The part of a line that a message points at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Number of the line from 1; `None` in an override, which has only one.
    pub number: Option<usize>,
    /// Column of the first character from 1, in characters.
    pub column: usize,
    /// Number of characters pointed at, at least 1.
    pub width: usize,
    /// The whole line, or so much of it around the place as fits on a screen.
    pub text: String,
    /// Characters of the line before `text`.
    pub(super) before: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(line) = &self.line else {
            return write!(f, " --> {}", self.file);
        };
        let number = line.number.map_or(" ".to_owned(), |n| n.to_string());
        let gutter = " ".repeat(number.len());
        match line.number {
            Some(n) => writeln!(f, "{gutter}--> {}:{n}:{}", self.file, line.column)?,
            None => writeln!(f, "{gutter}--> {}", self.file)?,
        }
        // A tab stays a tab under the line, so that the caret stands below its character.
        let padding: String = line
            .text
            .chars()
            .chain(std::iter::repeat(' '))
            .take(line.column - 1 - line.before)
            .map(|c| if c == '\t' { '\t' } else { ' ' })
            .collect();
        writeln!(f, "{gutter} |")?;
        writeln!(f, "{number} | {}", line.text)?;
        write!(f, "{gutter} | {padding}{}", "^".repeat(line.width))
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}\n{}", self.message, self.place)?;
        for help in &self.help {
            write!(f, "\nhelp: {help}")?;
        }
        Ok(())
    }
}

/// The mistakes of one scene in the order of their places; there is at least one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems {
    /// Those that are told.
    told: Vec<Problem>,
    /// How many others were found.
    others: usize,
}

/// So many mistakes are told.
const MOST_TOLD: usize = 20;

/// After so many mistakes no more are looked for: a reader of the messages has enough, and a text
/// that is no scene at all is not taken apart line by line.
pub(super) const MOST_FOUND: usize = 100;

impl Problems {
    /// Sorts the mistakes by place, and keeps the first.
    pub(super) fn new(mut problems: Vec<Problem>) -> Self {
        problems.sort_by_key(|problem| problem.place.order);
        let others = problems.len().saturating_sub(MOST_TOLD);
        problems.truncate(MOST_TOLD);
        Self {
            told: problems,
            others,
        }
    }

    /// The mistakes that are told, in the order of their places.
    pub fn iter(&self) -> std::slice::Iter<'_, Problem> {
        self.told.iter()
    }
}

impl<'a> IntoIterator for &'a Problems {
    type Item = &'a Problem;
    type IntoIter = std::slice::Iter<'a, Problem>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.told.iter().enumerate() {
            if index > 0 {
                write!(f, "\n\n")?;
            }
            write!(f, "{problem}")?;
        }
        let (told, others) = (self.told.len(), self.others);
        if told + others >= MOST_FOUND {
            write!(f, "\n\nand more: the first {told} mistakes are told")?;
        } else if others > 0 {
            write!(f, "\n\nand {others} more mistakes")?;
        }
        Ok(())
    }
}

impl Error for Problems {}
