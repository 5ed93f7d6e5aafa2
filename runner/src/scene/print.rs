//! A scene as an annotated scene file that reads back as the same scene.
//!
//! Every key of the [schema] stands on its own line with unit and meaning.
//! A key that is not set is commented out, with the value that takes effect where there
//! is one.

use super::schema::{self, Section};
use super::shape::{Point, Shape};
use super::types::{Dimension, Region, RegionKind, Scene, StepRule, Velocity};

impl Scene {
    /// The scene as an annotated TOML file; [`load`](super::load) reads it back as an
    /// equal scene.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let mut page = Page {
            axes: self.dimension.axes(),
            lines: Vec::new(),
        };
        self.print_top(&mut page);
        self.print_forces(&mut page);
        self.print_output(&mut page);
        for region in &self.regions {
            self.print_region(&mut page, region);
        }
        page.finish()
    }

    fn print_top(&self, page: &mut Page) {
        let top = |page: &mut Page, name, value| page.key(Section::Top, name, name, value);
        let (cfl, seconds) = match self.step {
            StepRule::Cfl(cfl) => (Set(number(cfl)), Unset(number(self.time_step()))),
            StepRule::Seconds(seconds) => {
                let cfl = seconds * self.fluid.sound_speed / self.support_radius();
                (Unset(number(cfl)), Set(number(seconds)))
            }
        };
        let end = match self.end {
            Some(end) => Set(number(end)),
            None => Unset(number(self.end_time())),
        };
        top(page, "name", Set(text(&self.name)));
        top(page, "description", Set(text(&self.description)));
        top(page, "source", Set(text(&self.source)));
        top(page, "dimension", Set(self.dimension.axes().to_string()));
        top(page, "particle_spacing", Set(number(self.particle_spacing)));
        top(page, "support", Set(number(self.support)));
        top(page, "cfl", cfl);
        top(page, "time_step", seconds);
        top(page, "turnaround", optional(self.turnaround.map(number)));
        top(page, "end", end);
        top(page, "model", Set(text(self.model.word())));
        top(page, "filter_every", Set(self.filter_every.to_string()));
        top(page, "integrator", Set(text(self.integrator.word())));
        top(
            page,
            "density_correction",
            Set(text(self.density_correction.word())),
        );
        top(page, "wall_model", Set(text(self.wall_model.word())));

        page.header("[fluid]", true);
        let fluid = |page: &mut Page, name, value| page.key(Section::Fluid, name, name, value);
        fluid(
            page,
            "reference_density",
            Set(number(self.fluid.reference_density)),
        );
        fluid(page, "sound_speed", Set(number(self.fluid.sound_speed)));
        fluid(
            page,
            "equation_of_state",
            Set(text(self.fluid.equation_of_state.word())),
        );
        let clump = [
            ("anti_clump_pressure", self.fluid.anti_clump_pressure),
            ("anti_clump_radius", self.fluid.anti_clump_radius),
        ];
        for (name, value) in clump {
            fluid(page, name, Set(number(value)));
        }
    }

    fn print_forces(&self, page: &mut Page) {
        page.header("[gravity]", true);
        let uniform = page.vector(self.gravity.uniform);
        page.key(Section::Gravity, "uniform", "uniform", Set(uniform));

        let central = self.gravity.central;
        page.header("[gravity.central]", central.is_some());
        let centre = central.map(|central| page.vector(central.centre));
        let numbers = [
            ("centre", centre),
            ("strength", central.map(|central| number(central.strength))),
            (
                "softening",
                central.map(|central| number(central.softening)),
            ),
        ];
        for (name, value) in numbers {
            page.key(Section::Central, name, name, optional(value));
        }

        page.header("[wall]", self.wall.is_some());
        let numbers = [
            ("energy", self.wall.map(|wall| wall.energy)),
            ("radius", self.wall.map(|wall| wall.radius)),
            ("softening", self.wall.map(|wall| wall.softening)),
        ];
        for (name, value) in numbers {
            page.key(Section::Wall, name, name, optional(value.map(number)));
        }
    }

    fn print_output(&self, page: &mut Page) {
        page.header("[output]", true);
        let counts = [
            ("rows", self.output.rows),
            ("frames", self.output.frames),
            ("snapshots", self.output.snapshots),
        ];
        for (name, count) in counts {
            page.key(Section::Output, name, name, Set(count.to_string()));
        }
    }

    fn print_region(&self, page: &mut Page, region: &Region) {
        page.header("[[region]]", true);
        let kind = Set(text(region.kind.word()));
        page.key(Section::Region, "kind", "kind", kind);
        let lattice = optional(region.lattice.map(|lattice| text(lattice.word())));
        page.key(Section::Region, "lattice", "lattice", lattice);
        page.shape("shape", &region.shape, self.dimension);
        if region.kind == RegionKind::Fluid {
            self.print_velocity(page, region.velocity);
        }
    }

    fn print_velocity(&self, page: &mut Page, velocity: Option<Velocity>) {
        let mut values = [const { None }; 8];
        match velocity {
            None => {}
            Some(Velocity::Uniform(uniform)) => values[0] = Some(page.vector(uniform)),
            Some(Velocity::Rotation { omega, centre }) => {
                values[1] = Some(match self.dimension {
                    Dimension::Two => number(omega[2]),
                    Dimension::Three => page.vector(omega),
                });
                values[5] = Some(page.vector(centre));
            }
            Some(Velocity::Gresho {
                peak,
                radius,
                centre,
            }) => {
                values[2] = Some(number(peak));
                values[3] = Some(number(radius));
                values[5] = Some(page.vector(centre));
            }
            Some(Velocity::Kepler { strength, centre }) => {
                values[4] = Some(number(strength));
                values[5] = Some(page.vector(centre));
            }
            Some(Velocity::Linear { matrix, offset }) => {
                let rows: Vec<String> = matrix[..page.axes]
                    .iter()
                    .map(|&row| page.vector(row))
                    .collect();
                values[6] = Some(format!("[{}]", rows.join(", ")));
                values[7] = Some(page.vector(offset));
            }
        }
        let names = [
            "uniform", "rotation", "gresho", "radius", "kepler", "centre", "linear", "offset",
        ];
        for (name, value) in names.into_iter().zip(values) {
            let only = schema::find(Section::Velocity, name).and_then(|key| key.only);
            if only.is_some_and(|only| only != self.dimension) {
                continue;
            }
            let path = format!("velocity.{name}");
            page.key(Section::Velocity, name, &path, optional(value));
        }
    }
}

/// The value of a printed key.
enum Printed {
    /// Stands in the file.
    Set(String),
    /// Is commented out and follows from other keys.
    Unset(String),
    /// Is commented out and has no value.
    Absent,
}

use Printed::{Absent, Set, Unset};

fn optional(value: Option<String>) -> Printed {
    value.map_or(Absent, Set)
}

/// One line: the code and its comment.
struct Line {
    code: String,
    comment: String,
}

struct Page {
    axes: usize,
    lines: Vec<Line>,
}

impl Page {
    fn line(&mut self, code: String, comment: String) {
        self.lines.push(Line { code, comment });
    }

    fn header(&mut self, title: &str, set: bool) {
        self.line(String::new(), String::new());
        let code = if set {
            title.to_owned()
        } else {
            format!("# {title}")
        };
        self.line(code, String::new());
    }

    /// A key with unit and meaning, under the dotted `path` it has in its table.
    fn key(&mut self, section: Section, name: &str, path: &str, value: Printed) {
        let code = match value {
            Set(value) => format!("{path} = {value}"),
            Unset(value) => format!("# {path} = {value}"),
            Absent => format!("# {path} = …"),
        };
        self.line(code, comment(section, name));
    }

    /// A shape in dotted keys; lists of shapes hold inline tables, one on each line.
    fn shape(&mut self, path: &str, shape: &Shape, dimension: Dimension) {
        let word = shape.word(dimension);
        let path = format!("{path}.{word}");
        if let Some((section, pairs)) = shape.numbers(self.axes) {
            for (name, value) in pairs {
                self.key(section, name, &format!("{path}.{name}"), Set(value));
            }
        }
        match shape {
            Shape::Layer { around, depth } => {
                let key = format!("{path}.depth");
                self.key(Section::Layer, "depth", &key, Set(number(*depth)));
                self.shape(&format!("{path}.around"), around, dimension);
            }
            Shape::Union(shapes) | Shape::Difference(shapes) | Shape::Intersection(shapes) => {
                self.line(format!("{path} = ["), comment(Section::Shape, word));
                for inner in shapes {
                    let code = format!("    {},", inner.inline(dimension));
                    self.line(code, String::new());
                }
                self.line("]".to_owned(), String::new());
            }
            _ => {}
        }
    }

    fn vector(&self, point: Point) -> String {
        vector(&point[..self.axes])
    }

    /// Joins the lines, with the comments of neighbouring lines in one column.
    fn finish(self) -> String {
        const WIDEST: usize = 44;
        let mut page = String::new();
        for block in self.lines.split(|line| line.code.is_empty()) {
            if !page.is_empty() {
                page.push('\n');
            }
            let column = block
                .iter()
                .filter(|line| !line.comment.is_empty())
                .map(|line| line.code.chars().count())
                .filter(|&width| width <= WIDEST)
                .max()
                .unwrap_or(0);
            for line in block {
                let code = &line.code;
                if line.comment.is_empty() {
                    page.push_str(code);
                } else {
                    let gap = column.saturating_sub(code.chars().count());
                    page.push_str(&format!("{code}{:gap$}  # {}", "", line.comment));
                }
                page.push('\n');
            }
        }
        page
    }
}

impl Shape {
    /// The key under which a scene of `dimension` writes the shape.
    pub(super) fn word(&self, dimension: Dimension) -> &'static str {
        let plane = dimension == Dimension::Two;
        match self {
            Self::Block { .. } if plane => "rectangle",
            Self::Block { .. } => "box",
            Self::Ball { .. } if plane => "circle",
            Self::Ball { .. } => "sphere",
            Self::Ellipsoid { .. } if plane => "ellipse",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Shell { .. } if plane => "annulus",
            Self::Shell { .. } => "shell",
            Self::Polygon { .. } => "polygon",
            Self::Union(_) => "union",
            Self::Difference(_) => "difference",
            Self::Intersection(_) => "intersection",
            Self::Layer { .. } => "layer",
        }
    }

    /// The keys and values of a shape that is described by numbers alone.
    fn numbers(&self, axes: usize) -> Option<(Section, Vec<(&'static str, String)>)> {
        let point = |point: &Point| vector(&point[..axes]);
        Some(match self {
            Self::Block { min, max } => (
                Section::Block,
                vec![("min", point(min)), ("max", point(max))],
            ),
            Self::Ball { centre, radius } => (
                Section::Ball,
                vec![("centre", point(centre)), ("radius", number(*radius))],
            ),
            Self::Ellipsoid { centre, axes } => (
                Section::Ellipsoid,
                vec![("centre", point(centre)), ("axes", point(axes))],
            ),
            Self::Shell {
                centre,
                inner,
                outer,
            } => (
                Section::Shell,
                vec![
                    ("centre", point(centre)),
                    ("inner", number(*inner)),
                    ("outer", number(*outer)),
                ],
            ),
            Self::Polygon { points } => {
                let corners: Vec<String> = points.iter().map(|corner| vector(corner)).collect();
                (
                    Section::Polygon,
                    vec![("points", format!("[{}]", corners.join(", ")))],
                )
            }
            _ => return None,
        })
    }

    /// The shape as an inline table.
    fn inline(&self, dimension: Dimension) -> String {
        let word = self.word(dimension);
        if let Some((_, pairs)) = self.numbers(dimension.axes()) {
            let pairs: Vec<String> = pairs
                .into_iter()
                .map(|(name, value)| format!("{name} = {value}"))
                .collect();
            return format!("{{ {word} = {{ {} }} }}", pairs.join(", "));
        }
        match self {
            Self::Layer { around, depth } => {
                let around = around.inline(dimension);
                let depth = number(*depth);
                format!("{{ layer = {{ around = {around}, depth = {depth} }} }}")
            }
            Self::Union(shapes) | Self::Difference(shapes) | Self::Intersection(shapes) => {
                let shapes: Vec<String> =
                    shapes.iter().map(|shape| shape.inline(dimension)).collect();
                format!("{{ {word} = [{}] }}", shapes.join(", "))
            }
            // Shapes described by numbers have returned above.
            _ => String::new(),
        }
    }
}

/// Unit and meaning of a key.
fn comment(section: Section, name: &str) -> String {
    schema::find(section, name).map_or(String::new(), |key| {
        format!("{}; {}", key.unit_label(), key.meaning)
    })
}

/// The shortest decimal that reads back as the same number; always a TOML float.
fn number(x: f64) -> String {
    format!("{x:?}")
}

fn vector(numbers: &[f64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(|&x| number(x)).collect();
    format!("[{}]", numbers.join(", "))
}

/// A TOML basic string.
fn text(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            '\t' => quoted.push_str("\\t"),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
