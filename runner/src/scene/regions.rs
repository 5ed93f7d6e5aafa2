//! The regions of a scene: shapes, lattices and first velocities.

use super::builder::{Builder, Here};
use super::declare::Keys;
use super::exclusive::only_one;
use super::helium::{counterflow, entropy, refuse_beside_walls};
use super::page::Page;
use super::print::print_region;
use super::region::{MaterialOfBody, Region, Velocity};
use super::region_keys::{
    BALL, BLOCK, COUNTERFLOW, ELLIPSOID, ENTROPY, LAYER, MATERIAL, POLYGON, REGION, REGIONS, SHAPE,
    SHELL, VELOCITY,
};
use super::schema::{Family, SceneKey};
use super::shape::Shape;
use super::spec::{Entry, WrittenTable, WrittenValue};
use super::values::{as_table, elements, numbers};
use super::velocity::velocity;
use super::wcsph;
use super::words::{ChoiceWord, Dimension, LatticeKind, RegionKind};
use super::{solid, superfluid, viscous};

/// The axes by name, for messages.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Reports a scene without anything that moves.
pub(super) fn require_movers<'a>(builder: &mut Builder<'a>, top: Here<'a>) {
    let Some(entry) = top.table.get(REGIONS.name) else {
        return;
    };
    let elastic = builder.is_of(solid::FAMILY) && !builder.is_of(wcsph::FAMILY);
    let held = |table: &WrittenTable| {
        let held = table.get("held").map(|held| &held.node.value);
        elastic && matches!(held, Some(WrittenValue::Boolean(true)))
    };
    // A region of unknown kind counts as one that moves: its kind is reported already.
    let moves = |table: &WrittenTable| match table.get("kind").map(|kind| &kind.node.value) {
        Some(WrittenValue::Text(word)) => {
            RegionKind::from_word(word) != Some(RegionKind::Wall) && !held(table)
        }
        _ => true,
    };
    let mut regions = elements(&entry.node).iter().filter_map(as_table);
    if matches!(entry.node.value, WrittenValue::List(_)) && !regions.any(moves) {
        let (what, help) = if elastic {
            (
                "no region is a solid that moves",
                "give at least one `[[region]]` the key `kind = \"solid\"`, without `held`",
            )
        } else {
            (
                "no region is fluid",
                "give at least one `[[region]]` the key `kind = \"fluid\"`",
            )
        };
        builder.missing(top, what.to_owned(), vec![help.to_owned()]);
    }
}

/// Reports a kind of region that the model does not know.
fn refuse_kind<'a>(builder: &mut Builder<'a>, here: Here<'a>, kind: RegionKind) {
    let Some(entry) = here.table.get("kind") else {
        return;
    };
    let help = match kind {
        RegionKind::Solid if !builder.is_of(solid::FAMILY) => {
            "write `kind = \"fluid\"`, or set `model` to \"solid\""
        }
        RegionKind::Fluid if builder.is_of(solid::FAMILY) && !builder.is_of(wcsph::FAMILY) => {
            "write `kind = \"solid\"`"
        }
        RegionKind::Wall if builder.is_of(solid::FAMILY) && !builder.is_of(wcsph::FAMILY) => {
            "write `kind = \"solid\"` and `held = true`: a solid that never moves"
        }
        _ => return,
    };
    builder.conflict(
        format!("the model has no {} regions", kind.word()),
        entry.node.span,
        help.to_owned(),
    );
}

/// Reports a held region that is to move.
fn refuse_moving_clamp<'a>(builder: &mut Builder<'a>, here: Here<'a>, held: bool) {
    if let Some(entry) = here.table.get("velocity").filter(|_| held) {
        builder.conflict(
            "a region that is held has no `velocity`".to_owned(),
            entry.key,
            "what is held stays where it is: remove it, or remove `held`".to_owned(),
        );
    }
}

/// Reports a wall whose velocity is not that of a rigid wall.
fn refuse_shapeless_motion<'a>(builder: &mut Builder<'a>, here: Here<'a>, velocity: &[Velocity]) {
    let turns = !builder.is_of(superfluid::FAMILY);
    let rigid = match velocity {
        [] | [Velocity::Uniform(_)] => true,
        [Velocity::Rotation { .. }] => turns,
        _ => false,
    };
    let (message, help) = if turns {
        (
            "a wall slides or turns",
            "write `velocity.uniform`, or `velocity.rotation` and `velocity.centre`",
        )
    } else {
        ("a wall of helium slides", "write `velocity.uniform`")
    };
    if let Some(entry) = here.table.get("velocity").filter(|_| !rigid) {
        builder.conflict(message.to_owned(), entry.key, help.to_owned());
    }
}

impl Keys for Vec<Region> {
    const KEYS: &'static [SceneKey] = &[REGIONS];
    const FAMILY: Option<Family> = None;

    fn read<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Self {
        let Some(entry) = builder.entry(here, REGIONS.name) else {
            return Vec::new();
        };
        let mut regions = Vec::new();
        for node in elements(&entry.node) {
            if let Some(table) = as_table(node) {
                let here = Here::table(table, node.span, &REGION, &entry.name);
                regions.push(region(builder, here));
            }
        }
        regions
    }

    fn print(values: Option<&Self>, page: &mut Page) {
        for region in values.into_iter().flatten() {
            print_region(page, region);
        }
    }
}

fn region<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Region {
    // A refused kind stands for fluid, about which no rule complains.
    let kind = builder.word(here, "kind").unwrap_or(RegionKind::Fluid);
    if kind == RegionKind::Wall {
        let rules = [
            (
                "lattice",
                "a wall continues the lattice of the first fluid region: remove it",
            ),
            ("velocity", "walls are at rest: remove it"),
        ];
        let moves = builder.is_of(viscous::FAMILY) || builder.is_of(superfluid::FAMILY);
        for (name, help) in rules {
            if let Some(entry) = here.table.get(name)
                && !(moves && name == "velocity")
            {
                let message = format!("a wall region has no `{name}`");
                builder.conflict(message, entry.key, help.to_owned());
            }
        }
    }
    refuse_kind(builder, here, kind);
    let held = builder.flag(here, "held");
    refuse_moving_clamp(builder, here, held);
    let body = builder.text(here, "body").map(str::to_owned);
    let material = builder
        .inner(here, "material", &MATERIAL)
        .map_or_else(MaterialOfBody::default, |inner| material(builder, inner));
    let lattice = lattice(builder, here);
    let velocity = builder
        .inner(here, "velocity", &VELOCITY)
        .map_or_else(Vec::new, |inner| velocity(builder, inner));
    if kind == RegionKind::Wall {
        refuse_shapeless_motion(builder, here, &velocity);
    }
    let counterflow = builder
        .inner(here, "counterflow", &COUNTERFLOW)
        .and_then(|inner| counterflow(builder, inner));
    let entropy = builder
        .inner(here, "entropy", &ENTROPY)
        .and_then(|inner| entropy(builder, inner));
    let smooth = builder.flag(here, "smooth");
    let conduction = builder.optional_number(here, "conduction");
    refuse_beside_walls(builder, here, kind);
    let shape = builder
        .inner(here, "shape", &SHAPE)
        .map_or(nothing(), |inner| shape(builder, inner));
    Region {
        kind,
        shape,
        lattice: kind.is_of_the_model().then_some(lattice),
        velocity,
        counterflow,
        entropy,
        smooth,
        conduction,
        body,
        material,
        held,
    }
}

fn material<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> MaterialOfBody {
    let energy = here.table.get("energy").is_some();
    MaterialOfBody {
        bulk_speed: builder.optional_number(here, "bulk_speed"),
        shear_speed: builder.optional_number(here, "shear_speed"),
        penalty: builder.optional_number(here, "penalty"),
        energy: energy.then(|| builder.word(here, "energy")).flatten(),
    }
}

/// What stands for a shape that was refused.
fn nothing() -> Shape {
    Shape::Union(Vec::new())
}

fn lattice<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> LatticeKind {
    let natural = LatticeKind::natural(builder.dimension);
    let Some(entry) = here.table.get("lattice") else {
        return natural;
    };
    let lattice = builder.word(here, "lattice").unwrap_or(natural);
    if !lattice.fits(builder.dimension) {
        let axes = builder.dimension.axes();
        let message = format!(
            "a {} lattice does not exist in {axes} dimensions",
            lattice.word()
        );
        let allowed = match builder.dimension {
            Dimension::Two => "allowed in 2 dimensions: \"square\", \"hexagonal\" or \"vogel\"",
            Dimension::Three => "allowed in 3 dimensions: \"cubic\" or \"body-centred\"",
        };
        builder.conflict(message, entry.node.span, allowed.to_owned());
    }
    lattice
}

/// Reads the shape in a table that holds exactly one.
fn shape<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Shape {
    let known = |name: &str| SHAPE.key(name).is_some();
    let Some(entry) = only_one(builder, here, "the shape", known) else {
        return nothing();
    };
    match entry.name.as_str() {
        "union" => Shape::Union(shapes(builder, entry)),
        "difference" => Shape::Difference(shapes(builder, entry)),
        "intersection" => Shape::Intersection(shapes(builder, entry)),
        name => primitive(builder, here, name).unwrap_or(nothing()),
    }
}

fn shapes<'a>(builder: &mut Builder<'a>, entry: &'a Entry) -> Vec<Shape> {
    let list = elements(&entry.node);
    if list.is_empty() && matches!(entry.node.value, WrittenValue::List(_)) {
        let help = format!("write `{} = [{{ … }}, {{ … }}]`", entry.name);
        builder.out_of_range(
            format!("`{}` holds no shape", entry.name),
            entry.node.span,
            help,
        );
    }
    let mut shapes = Vec::new();
    for node in list {
        if let Some(table) = as_table(node) {
            let here = Here::table(table, node.span, &SHAPE, &entry.name);
            shapes.push(shape(builder, here));
        }
    }
    shapes
}

/// A shape that is described by numbers, or a layer.
fn primitive<'a>(builder: &mut Builder<'a>, here: Here<'a>, name: &str) -> Option<Shape> {
    let mut inner = |rules| builder.inner(here, name, rules);
    Some(match name {
        "rectangle" | "box" => {
            let inner = inner(&BLOCK)?;
            block(builder, inner)
        }
        "circle" | "sphere" => {
            let inner = inner(&BALL)?;
            Shape::Ball {
                centre: builder.vector(inner, "centre"),
                radius: builder.number(inner, "radius"),
            }
        }
        "ellipse" | "ellipsoid" => {
            let inner = inner(&ELLIPSOID)?;
            Shape::Ellipsoid {
                centre: builder.vector(inner, "centre"),
                axes: builder.vector(inner, "axes"),
            }
        }
        "annulus" | "shell" => {
            let inner = inner(&SHELL)?;
            hollow(builder, inner)
        }
        "polygon" => {
            let inner = inner(&POLYGON)?;
            polygon(builder, inner)
        }
        _ => {
            let inner = inner(&LAYER)?;
            layer(builder, inner)
        }
    })
}

fn polygon<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Shape {
    let corners = builder
        .entry(here, "points")
        .map_or(&[][..], |entry| elements(&entry.node));
    let corner = |node| {
        let [x, y, _] = numbers(node);
        [x, y]
    };
    Shape::Polygon {
        points: corners.iter().map(corner).collect(),
    }
}

fn layer<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Shape {
    let around = builder
        .inner(here, "around", &SHAPE)
        .map_or(nothing(), |inner| shape(builder, inner));
    Shape::Layer {
        around: Box::new(around),
        depth: builder.number(here, "depth"),
    }
}

fn block<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Shape {
    let min = builder.vector(here, "min");
    let max = builder.vector(here, "max");
    if let (Some(_), Some(entry)) = (here.table.get("min"), here.table.get("max")) {
        let list = elements(&entry.node);
        for k in 0..builder.dimension.axes().min(list.len()) {
            if max[k] <= min[k] {
                builder.out_of_range(
                    format!("`max` is not above `min` along {}: {:?} m", AXES[k], max[k]),
                    list[k].span,
                    format!("allowed: greater than {} m, where `min` is", min[k]),
                );
            }
        }
    }
    Shape::Block { min, max }
}

fn hollow<'a>(builder: &mut Builder<'a>, here: Here<'a>) -> Shape {
    let inner = builder.number(here, "inner");
    let outer = builder.number(here, "outer");
    if let Some(entry) = here.table.get("outer")
        && outer <= inner
        && outer > 0.0
    {
        builder.out_of_range(
            format!("`outer` is not above `inner`: {outer:?} m"),
            entry.node.span,
            format!("allowed: greater than {inner} m, where `inner` is"),
        );
    }
    Shape::Shell {
        centre: builder.vector(here, "centre"),
        inner,
        outer,
    }
}
