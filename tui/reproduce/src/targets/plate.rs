//! The beryllium plate: Figs. 2 to 4 of the paper on solids.

use super::budget_chart;
use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use crate::svg::{self, Chart};
use loschmidt_runner::scene::Scene;
use loschmidt_runner::{Options, Player};

/// c_0 of beryllium, m/s.
const SPEED: f64 = 9046.59;

/// A period, about, s.
const PERIOD: f64 = 3e-5;

/// Thickness, m.
const THICKNESS: f64 = 0.01;

/// A plate: particles through the thickness, h/dr, c_p/c_0, and the paper's Courant number of
/// spacings per travel of sound.
#[derive(Clone, Copy, Debug)]
struct Setting {
    through: f64,
    h: f64,
    penalty: f64,
    courant: f64,
}

impl Setting {
    fn scene(self, model: &str) -> Result<Scene, LabError> {
        let spacing = THICKNESS / self.through;
        let longitudinal = SPEED * (7.0_f64 / 3.0).sqrt();
        let set = [
            format!("model={model}"),
            format!("particle_spacing={spacing}"),
            format!("support={}", 2.0 * self.h),
            format!("solid.penalty={}", self.penalty),
            "cfl=".to_owned(),
            format!("time_step={}", self.courant * spacing / longitudinal),
        ];
        scene("beryllium-plate", &set)
    }
}

/// What was seen of a plate.
#[derive(Clone, Debug, Default)]
struct Seen {
    /// Time in µs and displacement of the middle in mm.
    middle: Vec<[f64; 2]>,
    /// Time in µs and kinetic, elastic and penalty energy over the kinetic energy at the start.
    energies: [Vec<[f64; 2]>; 3],
    /// Largest energy error over the kinetic energy at the start, so far and in the first period.
    error: f64,
}

impl Seen {
    fn deflection(&self) -> f64 {
        self.middle
            .iter()
            .fold(0.0, |most, [_, y]| y.abs().max(most))
    }

    /// Times at which the middle goes through its place at the start, µs.
    fn zeros(&self) -> Vec<f64> {
        let pairs = self.middle.windows(2);
        let through = pairs.filter(|pair| pair[0][1] * pair[1][1] < 0.0);
        through
            .map(|pair| {
                let [[t, a], [u, b]] = [pair[0], pair[1]];
                t + (u - t) * a / (a - b)
            })
            .collect()
    }

    fn last(&self, kind: usize) -> f64 {
        self.energies[kind].last().map_or(0.0, |[_, e]| *e)
    }
}

/// Particles about the middle of the plate.
fn middle(player: &Player) -> Vec<usize> {
    let home = player.home();
    let near = |n: &usize| {
        let [x, y, _] = home.position(*n);
        x * x + y * y < player.scene().particle_spacing.powi(2)
    };
    (0..home.id.len()).filter(near).collect()
}

/// Takes a plate so far and looks at it now and then.
fn ring(
    lab: &mut Lab<'_>,
    name: &str,
    player: &mut Player,
    time: f64,
    looks: u64,
) -> Result<Seen, LabError> {
    let steps = (time / player.scene().time_step()).round() as u64;
    let (places, home) = (middle(player), player.home().clone());
    let first = player.measure()?.energies;
    let unit = first.get("kinetic");
    let mut seen = Seen::default();
    seen.middle.push([0.0; 2]);
    let mut taken = 0;
    for look in 1..=looks {
        let next = steps * look / looks;
        lab.advance(name, player, next - taken)?;
        taken = next;
        let t = player.time() * 1e6;
        let energies = player.measure()?.energies;
        let state = player.save();
        let moved = places
            .iter()
            .map(|&n| state.position(n)[1] - home.position(n)[1]);
        let mean = moved.sum::<f64>() / places.len().max(1) as f64;
        seen.middle.push([t, 1e3 * mean]);
        let kinds = [
            energies.get("kinetic"),
            energies.get("bulk") + energies.get("shear"),
            energies.get("penalty"),
        ];
        for (curve, energy) in seen.energies.iter_mut().zip(kinds) {
            curve.push([t, energy / unit]);
        }
        seen.error = seen
            .error
            .max((energies.total() - first.total()).abs() / unit);
    }
    Ok(seen)
}

/// A plate from its home.
fn from_home(
    lab: &mut Lab<'_>,
    name: &str,
    setting: Setting,
    model: &str,
    time: f64,
) -> Result<Seen, LabError> {
    let options: Options = lab.options();
    let mut player = lab.player(&setting.scene(model)?, options)?;
    ring(lab, name, &mut player, time, 600)
}

pub fn plate(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Solids, Figs. 2 to 4: the beryllium plate",
        "Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023) 127579, section 4.1: 6 cm \
         by 1 cm of beryllium on a hexagonal lattice. Displacements are those of the particles about \
         the middle; errors of the energy are relative to the kinetic energy at the start.",
    );
    settings(lab, &mut section)?;
    integrators(lab, &mut section)?;
    returns(lab, &mut section)?;
    if !lab.quick() {
        long(lab, &mut section)?;
    }
    Ok(section)
}

/// One period at several resolutions, supports and penalties.
fn settings(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let sizes: &[f64] = lab.size(&[10.0], &[10.0, 20.0, 30.0]);
    let mut rows = Vec::new();
    let mut deflections = Chart {
        title: "Fig. 2: the middle of the plate".to_owned(),
        x_label: "t / µs".to_owned(),
        y_label: "displacement / mm".to_owned(),
        ..Chart::default()
    };
    for &through in sizes {
        for (h, penalty) in [(1.5, 10.0), (1.5, 1.0), (1.6, 1.0), (1.5, 0.0)] {
            let setting = Setting {
                through,
                h,
                penalty,
                courant: 0.05,
            };
            let name = format!("plate W/{through}, h/dr {h}, c_p/c_0 {penalty}");
            let seen = from_home(lab, &name, setting, "solid", 1.05 * PERIOD)?;
            let zeros: Vec<String> = seen.zeros().iter().map(|t| format!("{t:.2}")).collect();
            rows.push(vec![
                format!("W/{through}"),
                format!("{h}"),
                format!("{penalty}"),
                format!("{:.2}", seen.deflection()),
                zeros.join(", "),
                format!("{:.1e}", seen.error),
                format!("{:.1e}", seen.last(2)),
                format!("{:.2}", seen.last(0)),
            ]);
            let place = deflections.series.len();
            if penalty != 0.0 {
                let label = format!("W/{through}, h/dr {h}, c_p/c_0 {penalty}");
                let series = svg::line(&label, place, seen.middle.iter().copied());
                deflections.series.push(series);
            }
            if through == 10.0 && penalty == 10.0 {
                section.check(
                    "the paper's settings, W/10: error of the energy in a period",
                    format!("{:.1e}", seen.error),
                    "5e-6",
                    "at most 5e-6",
                    seen.error <= 5e-6,
                );
                budget(lab, section, &seen)?;
            }
        }
    }
    section.table(
        "One period (31.5 µs) at the paper's time step",
        &[
            "dr",
            "h/dr",
            "c_p/c_0",
            "deflection, mm",
            "zeros, µs",
            "energy error",
            "penalty at the end",
            "kinetic at the end",
        ],
        rows,
    );
    section.note(
        "The paper gives about 30 µs for the period. With c_p = 10 c_0 at h = 1.5 dr the penalty \
         makes a hexagonal lattice 55 % too stiff in bulk; without it (c_p = 0) the plate tears.",
    );
    lab.figure(
        section,
        "plate-deflection",
        &deflections.svg(),
        "The plate drifts at about 6 m/s besides, for the prescribed velocities have a momentum.",
    )
}

/// Fig. 3.
fn budget(lab: &Lab<'_>, section: &mut Section, seen: &Seen) -> Result<(), LabError> {
    let chart = budget_chart("Fig. 3", "t / µs", &seen.energies);
    lab.figure(
        section,
        "plate-energies",
        &chart.svg(),
        "The paper's settings, W/10.",
    )
}

/// The two integrators at two time steps.
fn integrators(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let mut rows = Vec::new();
    let mut errors = Vec::new();
    let steps: &[f64] = lab.size(&[0.1, 0.05], &[0.1, 0.05, 0.025]);
    for &courant in steps {
        let mut row = vec![format!("{courant}")];
        for model in ["solid", "solid-midpoint"] {
            let setting = Setting {
                through: 10.0,
                h: 1.5,
                penalty: 10.0,
                courant,
            };
            let name = format!("plate, {model}, Courant number {courant}");
            let seen = from_home(lab, &name, setting, model, PERIOD)?;
            row.push(format!("{:.3e}", seen.error));
            errors.push(seen.error);
        }
        rows.push(row);
    }
    let order = (errors[0] / errors[2]).log2();
    section.check(
        "order of the reversible step",
        format!("{order:.2}"),
        "",
        "2 within 0.1",
        (order - 2.0).abs() < 0.1,
    );
    let apart = (errors[2] / errors[3] - 1.0).abs();
    section.check(
        "the reversible step against the paper's integrator (49), energy error",
        format!("{apart:.1e} apart"),
        "",
        "at most 0.01",
        apart <= 0.01,
    );
    section.table(
        "Energy error in a period, W/10, the paper's settings",
        &[
            "Courant number",
            "reversible (solid)",
            "paper's (solid-midpoint)",
        ],
        rows,
    );
    Ok(())
}

/// There and back.
fn returns(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let setting = Setting {
        through: 10.0,
        h: 1.6,
        penalty: 1.0,
        courant: 0.05,
    };
    let options = lab.options();
    let mut player = lab.player(&setting.scene("solid")?, options)?;
    let home = player.digest();
    let periods = lab.size(1.0, 20.0);
    let steps = (periods * PERIOD / player.scene().time_step()).round() as u64;
    for name in ["plate, out", "plate, back"] {
        lab.advance(name, &mut player, steps)?;
        player.turn();
    }
    section.check(
        &format!("{steps} steps out and back ({periods} periods)"),
        if player.digest() == home {
            "every bit as it was"
        } else {
            "not the first state"
        },
        "not reversible to the last bit",
        "the first state",
        player.digest() == home,
    );
    Ok(())
}

/// Twenty periods.
fn long(lab: &mut Lab<'_>, section: &mut Section) -> Result<(), LabError> {
    let mut rows = Vec::new();
    for (h, penalty) in [(1.5, 10.0), (1.5, 1.0), (1.6, 1.0)] {
        let setting = Setting {
            through: 10.0,
            h,
            penalty,
            courant: 0.05,
        };
        let name = format!("plate for 20 periods, h/dr {h}, c_p/c_0 {penalty}");
        let seen = from_home(lab, &name, setting, "solid", 20.0 * PERIOD)?;
        rows.push(vec![
            format!("{h}"),
            format!("{penalty}"),
            format!("{:.1e}", seen.error),
            format!("{:.2}", seen.last(2)),
        ]);
        if penalty == 1.0 && h == 1.6 {
            section.check(
                "the catalogue's settings, W/10: error of the energy in 20 periods",
                format!("{:.1e}", seen.error),
                "",
                "at most 5e-5",
                seen.error <= 5e-5,
            );
        }
    }
    section.table(
        "Twenty periods, W/10",
        &["h/dr", "c_p/c_0", "energy error", "penalty at the end"],
        rows,
    );
    Ok(())
}
