//! What `check` says of the sense of a scene: how much of the number range it uses, how well its
//! shapes are filled, and whether walls and sound suit the flow.

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
        line("fastest flow", format!("about {v:.4} m/s to be expected"));
        line(
            "  speed of sound",
            format!(
                "{c} m/s, {:.1} times that{}",
                c / v,
                if c >= WANTED * v {
                    ", kept (ten times)".to_owned()
                } else {
                    let percent = 100.0 * (v / c).powi(2);
                    format!(": TOO LOW (ten times), the density changes by about {percent:.1} %")
                }
            ),
        );
    }
    if let Some(wall) = sense.wall.filter(|_| v > 0.0) {
        let energy = sense.energy();
        let times = wall.energy / energy;
        line(
            "  wall energy",
            if wall.energy >= WANTED * energy {
                format!(
                    "{} J/kg, {times:.1} times that of the flow, kept (ten times)",
                    wall.energy
                )
            } else {
                format!(
                    "{} J/kg, {times:.1} times that of the flow: TOO LOW (ten times, {:.4} J/kg)",
                    wall.energy,
                    WANTED * energy
                )
            },
        );
        line(
            "  wall gaps",
            if wall.barrier > energy {
                format!(
                    "{:.4} J/kg between wall particles, above the {energy:.4} J/kg of the flow, kept",
                    wall.barrier
                )
            } else {
                format!(
                    "{:.4} J/kg between wall particles, below the {energy:.4} J/kg of the flow: \
                     HOLES, raise `wall.radius` or `wall.energy`",
                    wall.barrier
                )
            },
        );
    }
    text
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
    format!("{range} m from the origin along each axis; {whose} {used:.0} % of it")
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
        "particles for {:.4e} {unit}, {:+.1} % of its shape{verdict}",
        filled.particles,
        100.0 * excess + 0.0
    )
}
