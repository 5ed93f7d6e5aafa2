//! Every key of the scene language, once: where it stands, its type, unit, allowed
//! range, default and meaning.
//!
//! Parsing, the ranges in error messages, the nearest-key suggestions, `--set` and the
//! comments of [`Scene::to_toml`](super::Scene::to_toml) all read [`KEYS`]; a key that is
//! not in it does not exist.

use std::fmt;

use super::words::{
    DensityCorrection, Dimension, EquationOfState, Integrator, LatticeKind, Model, RegionKind,
    WallModel,
};

/// A table of the scene language; shapes nest, so a section is not yet a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    Top,
    Fluid,
    Gravity,
    Central,
    Wall,
    Output,
    Region,
    Velocity,
    Shape,
    Block,
    Ball,
    Ellipsoid,
    Shell,
    Polygon,
    Layer,
}

impl Section {
    /// How a message names the table, e.g. "`[fluid]`".
    pub fn title(self) -> &'static str {
        match self {
            Self::Top => "the top level",
            Self::Fluid => "`[fluid]`",
            Self::Gravity => "`[gravity]`",
            Self::Central => "`[gravity.central]`",
            Self::Wall => "`[wall]`",
            Self::Output => "`[output]`",
            Self::Region => "`[[region]]`",
            Self::Velocity => "a `velocity`",
            Self::Shape => "a shape",
            Self::Block => "a `rectangle` or `box`",
            Self::Ball => "a `circle` or `sphere`",
            Self::Ellipsoid => "an `ellipse` or `ellipsoid`",
            Self::Shell => "an `annulus` or `shell`",
            Self::Polygon => "a `polygon`",
            Self::Layer => "a `layer`",
        }
    }
}

/// The type of a key's value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// A string.
    Text,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// The whole number 2 or 3.
    Dimension,
    /// A finite number.
    Number,
    /// A whole number.
    Whole,
    /// As many numbers as there are dimensions.
    Vector,
    /// As many rows as there are dimensions, each a vector.
    Matrix,
    /// At least three points of the plane.
    Points,
    /// A number in 2D, a vector in 3D.
    Rotation,
    /// One table.
    Table(Section),
    /// An array of tables.
    Tables(Section),
}

/// The numbers a key allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Range {
    /// Every finite number.
    Any,
    /// Greater than the bound.
    Above(f64),
    /// The bound or more.
    AtLeast(f64),
    /// Both bounds included.
    Between(f64, f64),
    /// Greater than the first bound, at most the second.
    AboveUpTo(f64, f64),
}

impl Range {
    /// Whether `x` is allowed.
    pub fn contains(self, x: f64) -> bool {
        match self {
            Self::Any => x.is_finite(),
            Self::Above(low) => x > low,
            Self::AtLeast(low) => x >= low,
            Self::Between(low, high) => (low..=high).contains(&x),
            Self::AboveUpTo(low, high) => x > low && x <= high,
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => write!(f, "any finite number"),
            Self::Above(low) => write!(f, "greater than {low}"),
            Self::AtLeast(low) => write!(f, "{low} or more"),
            Self::Between(low, high) => write!(f, "from {low} to {high}"),
            Self::AboveUpTo(low, high) => write!(f, "greater than {low}, at most {high}"),
        }
    }
}

/// What an absent key means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Default {
    /// An error.
    Required,
    /// No value, or one that follows from other keys.
    Absent,
    /// This number.
    Number(f64),
    /// This word.
    Word(&'static str),
}

/// One key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Key {
    pub section: Section,
    pub name: &'static str,
    pub kind: Kind,
    /// The SI unit; empty for a number without one.
    pub unit: &'static str,
    pub range: Range,
    pub default: Default,
    pub meaning: &'static str,
    /// The only dimension in which the key exists, if there is one.
    pub only: Option<Dimension>,
}

impl Key {
    /// What the value is, for the first half of a comment: unit, allowed words or type.
    pub fn unit_label(&self) -> String {
        match self.kind {
            Kind::Text => "text".to_owned(),
            Kind::Choice(words) => quoted(words, "or"),
            Kind::Dimension => "2 or 3".to_owned(),
            Kind::Table(_) | Kind::Tables(_) => "table".to_owned(),
            _ if self.unit.is_empty() => "no unit".to_owned(),
            _ => self.unit.to_owned(),
        }
    }
}

/// Lists words in quotation marks: `"a", "b" or "c"`.
pub(super) fn quoted(words: &[&str], conjunction: &str) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    listed(&quoted, conjunction)
}

/// Lists phrases: `a, b or c`.
pub(super) fn listed(phrases: &[String], conjunction: &str) -> String {
    match phrases {
        [] => String::new(),
        [one] => one.clone(),
        [head @ .., last] => format!("{} {conjunction} {last}", head.join(", ")),
    }
}

/// The key `name` of `section`.
pub(super) fn find(section: Section, name: &str) -> Option<&'static Key> {
    keys(section).find(|key| key.name == name)
}

/// The keys of a section, in the order in which they are printed.
pub(super) fn keys(section: Section) -> impl Iterator<Item = &'static Key> {
    KEYS.iter().filter(move |key| key.section == section)
}

const fn key(section: Section, name: &'static str, kind: Kind, unit: &'static str) -> Key {
    Key {
        section,
        name,
        kind,
        unit,
        range: Range::Any,
        default: Default::Absent,
        meaning: "",
        only: None,
    }
}

impl Key {
    const fn within(mut self, range: Range) -> Self {
        self.range = range;
        self
    }

    const fn required(mut self) -> Self {
        self.default = Default::Required;
        self
    }

    const fn or(mut self, number: f64) -> Self {
        self.default = Default::Number(number);
        self
    }

    const fn or_word(mut self, word: &'static str) -> Self {
        self.default = Default::Word(word);
        self
    }

    const fn only(mut self, dimension: Dimension) -> Self {
        self.only = Some(dimension);
        self
    }

    const fn means(mut self, meaning: &'static str) -> Self {
        self.meaning = meaning;
        self
    }
}

use Dimension::{Three, Two};
use Kind::{Choice, Matrix, Number, Points, Rotation, Table, Tables, Text, Vector, Whole};
use Range::{Above, AboveUpTo, AtLeast, Between};
use Section::{
    Ball, Block, Central, Ellipsoid, Fluid, Gravity, Layer, Output, Polygon, Region, Shape, Shell,
    Top, Velocity, Wall,
};

/// The whole language.
#[rustfmt::skip]
pub(super) const KEYS: &[Key] = &[
    key(Top, "name", Text, "").means("short name; runs are filed under it"),
    key(Top, "description", Text, "").means("what happens in this scene"),
    key(Top, "source", Text, "").means("where the numbers come from"),
    key(Top, "dimension", Kind::Dimension, "").or(2.0).means("number of space dimensions"),
    key(Top, "particle_spacing", Number, "m").within(Above(0.0)).required().means("side of the square or cube of fluid that one particle stands for"),
    key(Top, "support", Number, "particle spacings").within(Between(1.5, 6.0)).or(3.0).means("support radius h, where the kernel vanishes"),
    key(Top, "cfl", Number, "").within(AboveUpTo(0.0, 2.0)).or(0.2).means("Courant number: time step = cfl * h / sound_speed"),
    key(Top, "time_step", Number, "s").within(Above(0.0)).means("time step, in place of cfl"),
    key(Top, "turnaround", Number, "s").within(Above(0.0)).means("time at which all velocities are reversed; absent: a one-way run"),
    key(Top, "end", Number, "s").within(Above(0.0)).means("time at which the run stops, both legs added; absent: twice the turnaround"),
    key(Top, "model", Choice(Model::WORDS), "").or_word("symplectic").means("density by summation (reversible), advanced in time, or summed with a filter of noise (dissipative)"),
    key(Top, "integrator", Choice(Integrator::WORDS), "").or_word("stormer-verlet").means("composition of drifts and kicks in a step"),
    key(Top, "filter_every", Whole, "steps").within(Between(1.0, 1e9)).or(30.0).means("interval at which the model \"filtered\" averages velocities"),
    key(Top, "density_correction", Choice(DensityCorrection::WORDS), "").or_word("constant").means("what makes the first density the reference density: a constant per particle, an initial state correction (the particles are moved), or nothing"),
    key(Top, "wall_model", Choice(WallModel::WORDS), "").or_word("conservative").means("repulsive potential, fixed fluid particles, or walls left out"),
    key(Top, "fluid", Table(Fluid), "").required().means("what the material is"),
    key(Top, "gravity", Table(Gravity), "").means("which outside forces act"),
    key(Top, "wall", Table(Wall), "").means("how a conservative wall repels"),
    key(Top, "output", Table(Output), "").means("how much a run writes; changes no bit of it"),
    key(Top, "region", Tables(Region), "").required().means("what is filled with particles, in the order of their ids"),

    key(Fluid, "reference_density", Number, "kg/m³").within(Above(0.0)).or(1000.0).means("density at which the pressure is zero"),
    key(Fluid, "sound_speed", Number, "m/s").within(Above(0.0)).required().means("numerical speed of sound, about ten times the fastest flow"),
    key(Fluid, "equation_of_state", Choice(EquationOfState::WORDS), "").or_word("tait").means("pressure as a function of density"),

    key(Fluid, "anti_clump_pressure", Number, "Pa").within(AtLeast(0.0)).or(0.0).means("strength p0 of a repulsion between particles that are very near; 0: none"),
    key(Fluid, "anti_clump_radius", Number, "particle spacings").within(AboveUpTo(0.0, 1.5)).or(0.5).means("distance at which that repulsion begins"),

    key(Gravity, "uniform", Vector, "m/s²").means("the same acceleration everywhere"),
    key(Gravity, "central", Table(Central), "").means("attraction to a point"),
    key(Central, "centre", Vector, "m").required().means("the attracting point"),
    key(Central, "strength", Number, "m³/s²").required().means("gravitational constant times mass; negative: repulsion"),
    key(Central, "softening", Number, "m").within(AtLeast(0.0)).or(0.0).means("length added in squares to the distance"),

    key(Wall, "energy", Number, "J/kg").within(Above(0.0)).required().means("depth of the wall potential; 10 g H for a column of height H"),
    key(Wall, "radius", Number, "particle spacings").within(AboveUpTo(0.0, 6.0)).or(0.95).means("distance at which the wall begins to repel"),
    key(Wall, "softening", Number, "m").within(AtLeast(0.0)).or(1e-6).means("length added in squares to the distance"),

    key(Output, "rows", Whole, "").within(Between(2.0, 1e6)).or(1000.0).means("rows of the series over both legs, at least"),
    key(Output, "frames", Whole, "").within(Between(0.0, 1e6)).or(20.0).means("particle frames over both legs, at least; 0: none"),
    key(Output, "snapshots", Whole, "").within(Between(1.0, 1e6)).or(20.0).means("snapshots of the latest state, each replacing the one before"),

    key(Region, "kind", Choice(RegionKind::WORDS), "").required().means("particles that move or particles that stay"),
    key(Region, "lattice", Choice(LatticeKind::WORDS), "").means("arrangement of fluid particles; a wall continues that of the first fluid region"),
    key(Region, "shape", Table(Shape), "").required().means("what is filled"),
    key(Region, "velocity", Table(Velocity), "").means("first velocity of the fluid; absent: at rest"),

    key(Velocity, "uniform", Vector, "m/s").means("the same velocity everywhere"),
    key(Velocity, "rotation", Rotation, "rad/s").means("angular velocity of a rigid rotation, counter-clockwise"),
    key(Velocity, "centre", Vector, "m").means("the middle of a rotation or vortex; absent: the origin"),
    key(Velocity, "gresho", Number, "m/s").only(Two).means("peak speed of Gresho's vortex: u = peak r/radius, falling to zero at twice the radius"),
    key(Velocity, "radius", Number, "m").within(Above(0.0)).or(0.2).only(Two).means("radius at which Gresho's vortex is fastest"),
    key(Velocity, "kepler", Number, "m³/s²").within(AtLeast(0.0)).only(Two).means("circular orbits around the centre: u = sqrt(strength/r)"),
    key(Velocity, "linear", Matrix, "1/s").means("matrix A of u = A x + b, row by row"),
    key(Velocity, "offset", Vector, "m/s").means("vector b of u = A x + b; absent: zero"),

    key(Shape, "rectangle", Table(Block), "").only(Two).means("rectangle along the axes"),
    key(Shape, "box", Table(Block), "").only(Three).means("box along the axes"),
    key(Shape, "circle", Table(Ball), "").only(Two).means("disc"),
    key(Shape, "sphere", Table(Ball), "").only(Three).means("ball"),
    key(Shape, "ellipse", Table(Ellipsoid), "").only(Two).means("ellipse along the axes"),
    key(Shape, "ellipsoid", Table(Ellipsoid), "").only(Three).means("ellipsoid along the axes"),
    key(Shape, "annulus", Table(Shell), "").only(Two).means("disc with a round hole"),
    key(Shape, "shell", Table(Shell), "").only(Three).means("ball with a round hole"),
    key(Shape, "polygon", Table(Polygon), "").only(Two).means("polygon by its corners, even-odd rule"),
    key(Shape, "union", Tables(Shape), "").means("in any of these shapes"),
    key(Shape, "difference", Tables(Shape), "").means("in the first shape and in none of the others"),
    key(Shape, "intersection", Tables(Shape), "").means("in every one of these shapes"),
    key(Shape, "layer", Table(Layer), "").means("the lattice continued outside a shape"),

    key(Block, "min", Vector, "m").required().means("lower corner, included"),
    key(Block, "max", Vector, "m").required().means("upper corner, excluded"),
    key(Ball, "centre", Vector, "m").required().means("the point in the middle"),
    key(Ball, "radius", Number, "m").within(Above(0.0)).required().means("distance of the edge from the centre"),
    key(Ellipsoid, "centre", Vector, "m").required().means("the point in the middle"),
    key(Ellipsoid, "axes", Vector, "m").within(Above(0.0)).required().means("semi-axes"),
    key(Shell, "centre", Vector, "m").required().means("the point in the middle"),
    key(Shell, "inner", Number, "m").within(AtLeast(0.0)).required().means("radius of the hole"),
    key(Shell, "outer", Number, "m").within(Above(0.0)).required().means("outer radius"),
    key(Polygon, "points", Points, "m").required().means("corners [x, y] in order"),
    key(Layer, "around", Table(Shape), "").required().means("the shape that is wrapped"),
    key(Layer, "depth", Number, "particle spacings").within(AboveUpTo(0.0, 10.0)).required().means("how far out the layer reaches; 2.5 gives three rows"),
];
