//! From what was written to a [`Scene`]: every key, and the rules that join several keys.

use super::builder::{Builder, Here};
use super::check::{check, dimension, family};
use super::declare::Keys;
use super::error::SceneError;
use super::model::Model;
use super::region::Region;
use super::regions::require_movers;
use super::schema::ValueType;
use super::source::is_name_character;
use super::spec::{SceneSpec, WrittenValue};
use super::types::{Scene, TOP, whole_steps};
use super::values::{as_table, elements};
use super::viscous::Relaxation;
use super::wcsph::{DensityCorrection, WallModel};
use super::words::{Dimension, RegionKind};
use loschmidt_core::schemes::solid::{MAX_BODIES, MAX_PARTS, MOST_OF_PAPER};
use loschmidt_core::schemes::superfluid::{Helium, MAX_WALLS};

/// The most steps of a leg; every count below it is an exact f64.
const MOST_STEPS: u64 = 1 << 48;

/// Builds the scene and collects every mistake on the way.
pub(super) fn build(spec: &SceneSpec) -> Result<Scene, SceneError> {
    let top = Here::top(&spec.root, TOP);
    let dimension = dimension(&spec.root).unwrap_or(Dimension::Two);
    let mut builder = Builder::new(spec, dimension, family(&spec.root), check(spec));
    if builder.has_enough() {
        return builder.give_up();
    }
    builder.require_tables(top);
    require_movers(&mut builder, top);
    let mut scene = Scene::read(&mut builder, top);
    name(&mut builder, top, &mut scene, &spec.stem);
    wall(&mut builder, top, &scene);
    hydrostatic(&mut builder, top, &scene);
    times(&mut builder, top, &scene);
    exclusions(&mut builder, top, scene.model);
    forces(&mut builder, top, &scene);
    bodies(&mut builder, top, &mut scene);
    relaxation(&mut builder, top, &scene);
    friction(&mut builder, top, &scene);
    builder.finish(scene)
}

/// A scene that states no name has that of its file; runs are filed under it.
fn name<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &mut Scene, stem: &str) {
    let Some(name) = builder.text(top, "name") else {
        scene.name = stem.to_owned();
        return;
    };
    let fit = !name.is_empty() && !name.starts_with('.') && name.chars().all(is_name_character);
    if !fit && let Some(entry) = top.table.get("name") {
        builder.out_of_range(
            format!("`name` cannot be \"{}\"", name.escape_debug()),
            entry.node.span,
            "runs are filed under it: letters, digits, `-`, `_` and `.`, no dot in front"
                .to_owned(),
        );
    }
}

/// Walls that act by a potential need one.
fn wall<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    if scene.fluid.is_none() {
        return;
    }
    let model = builder.word(top, "wall_model");
    let wall = scene
        .regions
        .iter()
        .position(|region| region.kind == RegionKind::Wall);
    if let (None, Some(number), Some(WallModel::Conservative)) =
        (top.table.get("wall"), wall, model)
    {
        builder.missing(
            top,
            format!(
                "`[wall]` is missing: region {number} is a wall, \
                 and `wall_model` is \"conservative\""
            ),
            vec![
                "add `[wall]` with `energy` in J/kg, about 10 g H for a column of height H in m"
                    .to_owned(),
                "or set `wall_model` to \"dummy\" or \"none\"".to_owned(),
            ],
        );
    }
}

/// Water at rest needs a weight, and a model whose density has a constant.
fn hydrostatic<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    let entry = top.table.get("density_correction");
    let asked = scene.water.density_correction == DensityCorrection::Hydrostatic;
    let Some(entry) = entry.filter(|_| asked) else {
        return;
    };
    let why = if scene.gravity.uniform == [0.0; 3] {
        "it needs a weight: set `gravity.uniform`"
    } else if scene.model == Model::Standard {
        "the density of this model is advanced in time: write `model = \"symplectic\"`"
    } else {
        return;
    };
    builder.conflict(
        "`density_correction = \"hydrostatic\"` does not go with this scene".to_owned(),
        entry.node.span,
        why.to_owned(),
    );
}

/// Bodies: not too many, and one lattice each.
fn bodies<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &mut Scene) {
    if !scene.has_distortion() {
        return;
    }
    let Some(entry) = top.table.get("region") else {
        return;
    };
    let (numbers, count) = scene.bodies();
    if scene.solid.is_none() {
        if scene.regions.len() > MAX_PARTS {
            builder.out_of_range(
                format!("{} regions", scene.regions.len()),
                entry.key,
                format!("allowed: at most {MAX_PARTS} regions"),
            );
        }
        return;
    }
    if scene.regions.len() > MAX_PARTS || count > MAX_BODIES {
        builder.out_of_range(
            format!("{} regions of {count} bodies", scene.regions.len()),
            entry.key,
            format!("allowed: at most {MAX_PARTS} regions and {MAX_BODIES} bodies"),
        );
        return;
    }
    for (number, node) in elements(&entry.node).iter().enumerate() {
        let first = numbers.iter().position(|body| *body == numbers[number]);
        let first = first.unwrap_or(number);
        let (lattice, material) = (scene.regions[first].lattice, scene.regions[first].material);
        let written = |key| as_table(node).and_then(|table| table.get(key));
        let region = &mut scene.regions[number];
        // What is not written is that of the body, as the print of the region says.
        let differs = [
            (written("lattice"), "lattice", region.lattice != lattice),
            (written("material"), "material", region.material != material),
        ];
        (region.lattice, region.material) = (lattice, material);
        for (written, what, differs) in differs {
            if let Some(written) = written.filter(|_| differs && first != number) {
                builder.conflict(
                    format!("the regions of a body have one {what}, that of its first region"),
                    written.node.span,
                    "remove it, or give the region a `body` of its own".to_owned(),
                );
            }
        }
    }
}

/// Forces that the model does not know.
fn forces<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    if let Some(entry) = top.table.get("gravity")
        && scene.gravity.central.is_some()
        && (scene.has_distortion() || scene.superfluid.is_some())
    {
        builder.conflict(
            format!(
                "`gravity.central` does not go with `model = \"{}\"`",
                scene.model.word()
            ),
            entry.key,
            "write `gravity.uniform`, or remove it".to_owned(),
        );
    }
}

/// The paper's relaxation grows where its step is too long.
fn relaxation<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    let Some(viscous) = scene.viscous else {
        return;
    };
    let table = top.table.get("viscous");
    let written = table
        .and_then(|entry| as_table(&entry.node))
        .and_then(|table| table.get("relaxation"));
    let (dt, most) = (scene.time_step(), MOST_OF_PAPER * viscous.relaxation_time());
    if let Some(entry) = written
        && viscous.relaxation == Relaxation::Paper
        && dt >= most
    {
        builder.out_of_range(
            format!("the paper's relaxation grows at this time step: {dt:.4e} s"),
            entry.node.span,
            format!(
                "allowed: below {most:.4e} s, 0.464 of the relaxation time: choose a smaller `cfl`, \
                 or write `relaxation = \"exact\"`"
            ),
        );
    }
}

/// Walls of helium: not too many.
fn walls_of_helium<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    let wall = |region: &&Region| region.kind == RegionKind::Wall;
    let count = scene.regions.iter().filter(wall).count();
    if let Some(entry) = top.table.get("region")
        && count > MAX_WALLS
    {
        builder.out_of_range(
            format!("{count} wall regions"),
            entry.key,
            format!("allowed: at most {MAX_WALLS} of them; a `union` joins walls of one kind"),
        );
    }
}

/// First entropies at which there is no such helium.
fn entropies<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene, helium: &Helium) {
    let nodes = top.table.get("region").map(|entry| elements(&entry.node));
    for (node, region) in nodes.into_iter().flatten().zip(&scene.regions) {
        let entry = as_table(node).and_then(|table| table.get("entropy"));
        let (Some(entry), Some(entropy)) = (entry, region.entropy) else {
            continue;
        };
        let wrong = |x: &f64| {
            let normal = helium.normal_fraction_at(*x);
            !(normal > 0.0 && normal <= 1.0) || helium.temperature + helium.warming(*x, 0.0) <= 0.0
        };
        if let Some(x) = entropy.extremes(helium.entropy).into_iter().find(wrong) {
            builder.out_of_range(
                format!(
                    "there is no such helium at an entropy of {:.1} J/(kg K)",
                    helium.entropy + x
                ),
                entry.key,
                format!(
                    "its normal fraction would be {:.4}, and its temperature {:.4} K: the first must be \
                     above 0 and at most 1, the second above 0",
                    helium.normal_fraction_at(x),
                    helium.temperature + helium.warming(x, 0.0)
                ),
            );
        }
    }
}

/// Friction where the model has none.
fn friction<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    let Some(superfluid) = scene.superfluid else {
        return;
    };
    entropies(builder, top, scene, &superfluid.helium());
    walls_of_helium(builder, top, scene);
    // Another model has no such table at all.
    if !matches!(scene.model, Model::Superfluid | Model::SuperfluidPaper) {
        return;
    }
    let table = top.table.get("superfluid");
    let table = table.and_then(|entry| as_table(&entry.node));
    let power = superfluid.heater.map_or(0.0, |heater| heater.power);
    let mut refused = Vec::new();
    for (name, given) in [
        ("viscosity", superfluid.viscosity > 0.0),
        ("diffusion", superfluid.diffusion > 0.0),
        ("mutual_friction", superfluid.mutual_friction > 0.0),
        ("heater", power > 0.0),
        ("superleak", superfluid.superleak.is_some()),
    ] {
        let entry = table.and_then(|table| table.get(name));
        refused.extend(entry.filter(|_| given).map(|entry| (name, entry.key)));
    }
    let nodes = top.table.get("region").map(|entry| elements(&entry.node));
    for (node, region) in nodes.into_iter().flatten().zip(&scene.regions) {
        let wall = region.kind == RegionKind::Wall;
        for (name, given) in [
            ("conduction", region.conduction.is_some()),
            ("velocity", wall && !region.velocity.is_empty()),
        ] {
            let entry = as_table(node).and_then(|table| table.get(name));
            refused.extend(entry.filter(|_| given).map(|entry| (name, entry.key)));
        }
    }
    for (name, span) in refused {
        builder.conflict(
            format!(
                "`{name}` does not go with `model = \"{}\"`",
                scene.model.word()
            ),
            span,
            "it takes energy and information out of the flow or puts them in: write \
             `model = \"superfluid-dissipative\"`, or remove it"
                .to_owned(),
        );
    }
}

/// Reports the keys that the model does not go with.
fn exclusions<'a>(builder: &mut Builder<'a>, top: Here<'a>, model: Model) {
    for exclusion in model.exclusions() {
        let Some(entry) = top.table.get(exclusion.key) else {
            continue;
        };
        let (what, span) = match (exclusion.unless, &entry.node.value) {
            (None, _) => (format!("`{}`", exclusion.key), entry.key),
            (Some(unless), WrittenValue::Text(word))
                if is_choice(exclusion.key, word) && word != unless =>
            {
                (format!("`{} = \"{word}\"`", exclusion.key), entry.node.span)
            }
            _ => continue,
        };
        builder.conflict(
            format!("{what} does not go with `model = \"{}\"`", model.word()),
            span,
            exclusion.help.to_owned(),
        );
    }
}

/// Whether a word is one of those that a key of the top level allows.
fn is_choice(key: &str, word: &str) -> bool {
    let kind = TOP.key(key).map(|key| key.kind);
    matches!(kind, Some(ValueType::Choice(words)) if words.contains(&word))
}

/// Turnaround, end and time step must give a number of steps that can be run.
fn times<'a>(builder: &mut Builder<'a>, top: Here<'a>, scene: &Scene) {
    let turnaround = top.table.get("turnaround");
    let end = top.table.get("end");
    if turnaround.is_none() && end.is_none() {
        builder.missing(
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
        builder.out_of_range(
            format!("`end` does not lie on the way back: {stop:?} s"),
            entry.node.span,
            format!(
                "allowed: greater than {out} s, where time is turned, \
                 at most {} s, where the run is back",
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
            builder.out_of_range(
                format!("{what} is shorter than half a time step"),
                entry.node.span,
                format!("the time step is {step:?} s"),
            );
        } else if whole_steps(time, step) > MOST_STEPS {
            builder.out_of_range(
                format!("{what} takes more than 2^48 steps"),
                entry.node.span,
                format!("the time step is {step:?} s"),
            );
        }
    }
}
