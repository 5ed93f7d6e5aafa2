//! What `check` says of the sense of a scene: how much of the number range it uses, how well its
//! shapes are filled, and whether walls and sound suit the flow.

use loschmidt_runner::figures::{number, quantity};
use loschmidt_runner::scene::{
    Dimension, Filled, InitialState, LatticeKind, Scene, stretched_density,
};
use loschmidt_runner::setup::{self, WANTED};

/// A shape that is filled by so much less or more than it is, is worth a warning.
const MOST_EXCESS: f64 = 0.02;

/// A line for each finding.
pub fn lines(scene: &Scene, initial: &InitialState) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:<22}{value}\n");
    line("range", range(scene, initial));
    for filled in scene.filled() {
        line(&format!("region {}", filled.region), area(scene, &filled));
    }
    let Some(sense) = setup::sense(scene, initial) else {
        return text;
    };
    for kind in lattices(scene) {
        line(
            "under shear",
            format!(
                "{:+.1} % density on the {} lattice where it is stretched to twice its length, at a \
                 support of {} spacings",
                100.0 * stretched_density(kind, scene.support),
                kind.word(),
                scene.support
            ),
        );
    }
    let (c, v) = (scene.sound_speed(), sense.speed);
    if v > 0.0 {
        let flow = quantity(v, "m/s", 4);
        line("fastest flow", format!("about {flow} to be expected"));
        line("  speed of sound", sound(c, v));
    }
    if let Some(wall) = sense.wall.filter(|_| v > 0.0) {
        line("  wall energy", depth(wall.energy, sense.energy()));
        line("  wall gaps", gaps(wall.barrier, sense.energy()));
    }
    text
}

/// The speed of sound beside that of the flow, m/s.
fn sound(c: f64, v: f64) -> String {
    let verdict = if c >= WANTED * v {
        ", kept (ten times)".to_owned()
    } else {
        let percent = number(100.0 * (v / c).powi(2), 2);
        format!(": TOO LOW (ten times), the density changes by about {percent} %")
    };
    format!(
        "{}, {} times that{verdict}",
        quantity(c, "m/s", 4),
        number(c / v, 3)
    )
}

/// The energy of a wall beside that of the flow, J/kg.
fn depth(energy: f64, flow: f64) -> String {
    let verdict = if energy >= WANTED * flow {
        ", kept (ten times)".to_owned()
    } else {
        format!(
            ": TOO LOW (ten times, {})",
            quantity(WANTED * flow, "J/kg", 4)
        )
    };
    let times = number(energy / flow, 3);
    format!(
        "{}, {times} times that of the flow{verdict}",
        quantity(energy, "J/kg", 4)
    )
}

/// The energy of a wall where it is lowest beside that of the flow, J/kg.
fn gaps(barrier: f64, flow: f64) -> String {
    let (side, verdict) = if barrier > flow {
        ("above", "kept")
    } else {
        ("below", "HOLES, raise `wall.radius` or `wall.energy`")
    };
    format!(
        "{} between wall particles, {side} the {} of the flow: {verdict}",
        quantity(barrier, "J/kg", 4),
        quantity(flow, "J/kg", 4)
    )
}

/// The lattices of the fluid, each once.
fn lattices(scene: &Scene) -> Vec<LatticeKind> {
    let mut kinds = Vec::new();
    for kind in scene.regions.iter().filter_map(|region| region.lattice) {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

fn range(scene: &Scene, initial: &InitialState) -> String {
    let reach = setup::reach(scene, initial);
    let range = setup::length_range(scene, initial);
    let used = 100.0 * reach.expected / range;
    let whose = if scene.domain.is_some() {
        "the particles start within"
    } else {
        "the particles are expected within"
    };
    format!(
        "{} from the origin along each axis; {whose} {used:.0} % of it",
        quantity(range, "m", 4)
    )
}

fn area(scene: &Scene, filled: &Filled) -> String {
    let unit = match scene.dimension {
        Dimension::Two => "m²",
        Dimension::Three => "m³",
    };
    let excess = filled.excess();
    let verdict = if excess.abs() > MOST_EXCESS {
        ": its shape does not fit the particle spacing"
    } else {
        ""
    };
    format!(
        "particles for {}, {:+.1} % of its shape{verdict}",
        quantity(filled.particles, unit, 4),
        100.0 * excess + 0.0
    )
}
