//! Regions, velocities and shapes as keys of an annotated scene file.

use super::geometry::Vector3;
use super::page::{Page, comment, list, number, text};
use super::region::{MaterialOfBody, Region, Velocity};
use super::region_keys::{
    BALL, BLOCK, COUNTERFLOW, ELLIPSOID, ENTROPY, LAYER, MATERIAL, POLYGON, REGION, SHAPE, SHELL,
    VELOCITY,
};
use super::schema::TableRules;
use super::shape::Shape;
use super::superfluid::{self, Counterflow, FirstEntropy};
use super::viscous;
use super::words::{Dimension, RegionKind};

/// The name of a key and its value as it is printed.
type NamedValue = (&'static str, String);

/// Prints a region under a header of its own.
pub(super) fn print_region(page: &mut Page, region: &Region) {
    page.header("[[region]]", true);
    let kind = Some(text(region.kind.word()));
    print_at(page, &REGION, "kind", "kind", kind);
    if region.kind == RegionKind::Solid {
        print_at(
            page,
            &REGION,
            "body",
            "body",
            region.body.as_deref().map(text),
        );
        print_material(page, &region.material);
        print_at(page, &REGION, "held", "held", Some(region.held.to_string()));
    }
    let lattice = region.lattice.map(|lattice| text(lattice.word()));
    print_at(page, &REGION, "lattice", "lattice", lattice);
    print_shape(page, "shape", &region.shape);
    let wall = region.kind == RegionKind::Wall;
    let moves = page.is_of(viscous::FAMILY) || page.is_of(superfluid::FAMILY);
    if (region.kind.is_of_the_model() && !region.held) || (wall && moves) {
        print_velocity(page, &region.velocity);
    }
    if page.is_of(superfluid::FAMILY) && wall {
        let smooth = Some(region.smooth.to_string());
        print_at(page, &REGION, "smooth", "smooth", smooth);
        let conduction = region.conduction.map(number);
        print_at(page, &REGION, "conduction", "conduction", conduction);
    } else if page.is_of(superfluid::FAMILY) {
        print_superfluid(page, region);
    }
}

/// Prints the first counterflow and entropy of a superfluid.
fn print_superfluid(page: &mut Page, region: &Region) {
    let counterflow = match region.counterflow {
        None => Vec::new(),
        Some(Counterflow::Uniform(u)) => vec![("uniform", page.vector(u))],
        Some(Counterflow::Random {
            speed,
            length,
            seed,
        }) => vec![
            ("random", number(speed)),
            ("length", number(length)),
            ("seed", seed.to_string()),
        ],
    };
    let entropy = match region.entropy {
        None => Vec::new(),
        Some(FirstEntropy::Uniform(s)) => vec![("uniform", number(s))],
        Some(FirstEntropy::Wave { amplitude, length }) => {
            vec![("wave", number(amplitude)), ("length", number(length))]
        }
    };
    for (path, rules, given) in [
        ("counterflow", &COUNTERFLOW, counterflow),
        ("entropy", &ENTROPY, entropy),
    ] {
        for key in rules.keys {
            let value = given.iter().find(|(known, _)| *known == key.name);
            let value = value.map(|(_, value)| value.clone());
            page.value_at(key, &format!("{path}.{}", key.name), value);
        }
    }
}

/// Prints in what a body differs from the scene's solid.
fn print_material(page: &mut Page, material: &MaterialOfBody) {
    let values = [
        ("bulk_speed", material.bulk_speed.map(number)),
        ("shear_speed", material.shear_speed.map(number)),
        ("penalty", material.penalty.map(number)),
        ("energy", material.energy.map(|energy| text(energy.word()))),
    ];
    for (name, value) in values {
        print_at(page, &MATERIAL, name, &format!("material.{name}"), value);
    }
}

/// Prints the key `name` of these rules under the path that it has in the region.
fn print_at(
    page: &mut Page,
    rules: &'static TableRules,
    name: &str,
    path: &str,
    value: Option<String>,
) {
    if let Some(key) = rules.key(name) {
        page.value_at(key, path, value);
    }
}

/// The keys of a velocity in the order in which they are printed.
const VELOCITY_KEYS: [&str; 15] = [
    "uniform",
    "rotation",
    "gresho",
    "radius",
    "kepler",
    "centre",
    "bending",
    "wave_number",
    "a1",
    "a2",
    "start",
    "twist",
    "height",
    "linear",
    "offset",
];

/// Prints every key of a velocity that exists in the scene's dimension.
fn print_velocity(page: &mut Page, velocity: &[Velocity]) {
    let fields = velocity.iter();
    // Fields that turn have one centre, which the first of them says.
    let given: Vec<_> = fields
        .flat_map(|field| velocity_values(page, *field))
        .collect();
    for name in VELOCITY_KEYS {
        let key = VELOCITY.key(name);
        if let Some(key) = key.filter(|key| page.may_have(key)) {
            let value = given.iter().find(|(known, _)| *known == name);
            let value = value.map(|(_, value)| value.clone());
            page.value_at(key, &format!("velocity.{name}"), value);
        }
    }
}

/// The keys that a velocity has, with their values.
fn velocity_values(page: &Page, velocity: Velocity) -> Vec<NamedValue> {
    match velocity {
        Velocity::Uniform(uniform) => vec![("uniform", page.vector(uniform))],
        Velocity::Rotation { omega, centre } => {
            let rotation = match page.dimension {
                Dimension::Two => number(omega[2]),
                Dimension::Three => page.vector(omega),
            };
            vec![("rotation", rotation), ("centre", page.vector(centre))]
        }
        Velocity::Gresho {
            peak,
            radius,
            centre,
        } => vec![
            ("gresho", number(peak)),
            ("radius", number(radius)),
            ("centre", page.vector(centre)),
        ],
        Velocity::Kepler { strength, centre } => vec![
            ("kepler", number(strength)),
            ("centre", page.vector(centre)),
        ],
        Velocity::Bending {
            peak,
            wave_number,
            shape: [a1, a2],
            start,
        } => vec![
            ("bending", number(peak)),
            ("wave_number", number(wave_number)),
            ("a1", number(a1)),
            ("a2", number(a2)),
            ("start", number(start)),
        ],
        Velocity::Twist { rate, height } => {
            vec![("twist", number(rate)), ("height", number(height))]
        }
        Velocity::Linear { matrix, offset } => {
            let rows = matrix[..page.dimension.axes()].iter();
            let rows: Vec<String> = rows.map(|&row| page.vector(row)).collect();
            let matrix = format!("[{}]", rows.join(", "));
            vec![("linear", matrix), ("offset", page.vector(offset))]
        }
    }
}

/// A shape in dotted keys; lists of shapes hold inline tables, one on each line.
fn print_shape(page: &mut Page, path: &str, shape: &Shape) {
    let dimension = page.dimension;
    let word = shape.word(dimension);
    let path = format!("{path}.{word}");
    if let Some((rules, pairs)) = numbers(shape, dimension.axes()) {
        for (name, value) in pairs {
            print_at(page, rules, name, &format!("{path}.{name}"), Some(value));
        }
    }
    match shape {
        Shape::Layer { around, depth } => {
            let key = format!("{path}.depth");
            print_at(page, &LAYER, "depth", &key, Some(number(*depth)));
            print_shape(page, &format!("{path}.around"), around);
        }
        Shape::Union(shapes) | Shape::Difference(shapes) | Shape::Intersection(shapes) => {
            let comment = SHAPE.key(word).map_or(String::new(), comment);
            page.line(format!("{path} = ["), comment);
            for inner in shapes {
                let code = format!("    {},", inline(inner, dimension));
                page.line(code, String::new());
            }
            page.line("]".to_owned(), String::new());
        }
        _ => {}
    }
}

/// The keys and values of a shape that is described by numbers alone.
fn numbers(shape: &Shape, axes: usize) -> Option<(&'static TableRules, Vec<NamedValue>)> {
    let point = |point: &Vector3| list(&point[..axes]);
    Some(match shape {
        Shape::Block { min, max } => (&BLOCK, vec![("min", point(min)), ("max", point(max))]),
        Shape::Ball { centre, radius } => (
            &BALL,
            vec![("centre", point(centre)), ("radius", number(*radius))],
        ),
        Shape::Ellipsoid { centre, axes } => (
            &ELLIPSOID,
            vec![("centre", point(centre)), ("axes", point(axes))],
        ),
        Shape::Shell {
            centre,
            inner,
            outer,
        } => (
            &SHELL,
            vec![
                ("centre", point(centre)),
                ("inner", number(*inner)),
                ("outer", number(*outer)),
            ],
        ),
        Shape::Polygon { points } => {
            let corners: Vec<String> = points.iter().map(|corner| list(corner)).collect();
            (
                &POLYGON,
                vec![("points", format!("[{}]", corners.join(", ")))],
            )
        }
        _ => return None,
    })
}

/// The shape as an inline table.
fn inline(shape: &Shape, dimension: Dimension) -> String {
    let word = shape.word(dimension);
    if let Some((_, pairs)) = numbers(shape, dimension.axes()) {
        let pairs: Vec<String> = pairs
            .into_iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        return format!("{{ {word} = {{ {} }} }}", pairs.join(", "));
    }
    match shape {
        Shape::Layer { around, depth } => {
            let around = inline(around, dimension);
            let depth = number(*depth);
            format!("{{ layer = {{ around = {around}, depth = {depth} }} }}")
        }
        Shape::Union(shapes) | Shape::Difference(shapes) | Shape::Intersection(shapes) => {
            let shapes: Vec<String> = shapes
                .iter()
                .map(|shape| inline(shape, dimension))
                .collect();
            format!("{{ {word} = [{}] }}", shapes.join(", "))
        }
        // Shapes described by numbers have returned above.
        _ => String::new(),
    }
}
