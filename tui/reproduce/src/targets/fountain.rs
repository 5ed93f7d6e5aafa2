//! The fountain of superfluid helium: Figs. 8 to 12 of the third paper.
//!
//! The speed of the jet is the area of particles that cross a plane in the nozzle, upwards less
//! downwards, over its width and the time. It is compared with
//!
//! - v = W/(T s ρ d), at the temperature and entropy in the cell                      (31)
//! - the same for W less what warms the cell, m T ds/dt: (31) supposes that nothing is stored.
//!
//! (31) supposes that both components leave together. The heat leaves with the normal one, whose
//! speed is that of (31) in any case; how much of the other comes with it is decided where the jet
//! ends. A jet is slower than second sound, so that it takes on the temperature of the bath that it
//! falls into, as it takes on its pressure. With ∇T = ∇p = 0 between its end and the bath,
//! Bernoulli's equation of the superfluid component, of which the bath's is at rest, is
//!
//! v_s²/2 - χ_n |v_n - v_s|²/2 = 0, whence v = χ_n v_n + χ_s v_s = √χ_n v_n.
//!
//! So a jet without friction between its components comes to 0.44 of (31) at 1.65 K as soon as it
//! is joined to the bath. With mutual friction a difference of temperatures remains along it.

use crate::lab::{Lab, LabError, scene};
use crate::section::Section;
use crate::svg::{self, Chart, Field, Style};
use loschmidt_runner::{Frame, Player};

/// Width of the nozzle, m.
const WIDTH: f64 = 0.002;
/// Height of the plane where the jet is counted, half a millimetre below the end of the nozzle, m.
const PLANE: f64 = 0.0175;
/// A look, s: the jet moves by less than the height of the nozzle.
const LOOK: f64 = 5e-4;
/// Looks over which the speed of a curve is averaged.
const WINDOW: usize = 20;
/// A at 1.65 K, m s/kg: A_λ (T/T_λ)³ with A_λ about 1450 m s/kg. (S. W. Van Sciver, Helium Cryogenics,
/// 2nd ed., Springer 2012, chapter 7.)
const MUTUAL_FRICTION: f64 = 632.0;
/// When the first pictures of the cell are taken, s.
const EARLY: [f64; 4] = [0.25e-3, 0.5e-3, 0.75e-3, 1e-3];

/// What is run.
#[derive(Clone, Copy)]
struct Setting {
    /// W/m.
    power: f64,
    /// Spacings in the width of the nozzle.
    across: f64,
    /// Time step over the acoustic one.
    cfl: f64,
    /// s.
    end: f64,
    /// Pa s.
    viscosity: f64,
    /// A, m s/kg.
    mutual_friction: f64,
}

/// What is seen at a time.
#[derive(Clone, Copy, Default)]
struct Look {
    time: f64,
    /// Of the jet, m/s.
    speed: f64,
    /// In the cell and in the bath, K.
    temperature: [f64; 2],
    /// (31), m/s.
    ideal: f64,
    /// (31) for what is not stored, m/s.
    unstored: f64,
    /// In the cell, J/(kg K).
    entropy: f64,
}

/// What was seen of a run.
struct Seen {
    looks: Vec<Look>,
    /// Energy that came from nowhere, over what the heater gave.
    unbalanced: f64,
    /// What ended it early.
    ended: Option<String>,
    early: Vec<Field>,
    late: Vec<Field>,
    /// Speeds and pressures at the end.
    last: [Field; 2],
}

/// Whether a place is in the cell above the plate, or in its nozzle.
fn in_cell(x: &[f64; 3]) -> bool {
    let half = match x[1] {
        y if (0.0035..0.008).contains(&y) => 0.004,
        y if (0.008..0.010).contains(&y) => 0.001 + 1.5 * (0.010 - y),
        y if (0.010..0.018).contains(&y) => 0.5 * WIDTH,
        _ => 0.0,
    };
    x[0].abs() < half
}

fn in_bath(x: &[f64; 3]) -> bool {
    (0.0062..0.0115).contains(&x[0].abs()) && (-0.0015..0.010).contains(&x[1])
}

fn mean(frame: &Frame, column: &str, inside: impl Fn(&[f64; 3]) -> bool) -> (f64, f64) {
    let values = frame.column(column).unwrap_or_default();
    let (mut sum, mut count) = (0.0, 0.0);
    for (x, value) in frame.position.iter().zip(values) {
        if inside(x) {
            sum += value;
            count += 1.0;
        }
    }
    (sum / count, count)
}

fn field(frame: &Frame, column: &str, title: String, spacing: f64, zoom: bool) -> Field {
    let plane = |x: &[f64; 3]| [x[0], x[1]];
    Field {
        title,
        bounds: if zoom {
            [[-0.0055, 0.0], [0.0055, 0.0185]]
        } else {
            [[-0.0126, -0.0026], [0.0126, 0.033]]
        },
        diameter: spacing,
        points: frame.position.iter().map(plane).collect(),
        values: match frame.column(column) {
            Some(values) => values.to_vec(),
            None => frame.velocity.iter().map(|v| v[0].hypot(v[1])).collect(),
        },
        walls: frame.wall_position.iter().map(plane).collect(),
        ..Field::default()
    }
}

/// Upward crossings of the plane in the nozzle less downward ones.
fn crossings(before: &[[f64; 3]], after: &[[f64; 3]]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in before.iter().zip(after) {
        if (0.5 * (a[0] + b[0])).abs() <= 0.5 * WIDTH {
            sum += f64::from(i8::from(a[1] < PLANE && b[1] >= PLANE));
            sum -= f64::from(i8::from(a[1] >= PLANE && b[1] < PLANE));
        }
    }
    sum
}

fn run(lab: &mut Lab<'_>, setting: Setting) -> Result<Seen, LabError> {
    let spacing = WIDTH / setting.across;
    let set = [
        format!("particle_spacing={spacing}"),
        format!("cfl={}", setting.cfl),
        format!("end={}", setting.end),
        format!("superfluid.heater.power={}", setting.power),
        format!("superfluid.viscosity={}", setting.viscosity),
        format!("superfluid.mutual_friction={}", setting.mutual_friction),
    ];
    let options = lab.options();
    let mut player = lab.player(&scene("fountain", &set)?, options)?;
    let name = format!(
        "fountain, {} W/m, d/{}, mu = {} Pa s, A = {} m s/kg",
        setting.power, setting.across, setting.viscosity, setting.mutual_friction
    );
    let step = player.scene().time_step();
    let first = player.measure()?.energies.total();
    let mut frame = player.frame()?;
    let mut seen = Seen {
        looks: Vec::new(),
        unbalanced: 0.0,
        ended: None,
        early: Vec::new(),
        late: Vec::new(),
        last: Default::default(),
    };
    let (mut taken, mut pictured) = (0_u64, 0_u32);
    // The first millisecond is looked at more often, for the pictures.
    'run: for n in 1..=(setting.end / LOOK).round() as u64 {
        let time = n as f64 * LOOK;
        for (k, early) in EARLY.iter().enumerate().skip(seen.early.len()) {
            if *early > time + 0.5 * step {
                break;
            }
            let next = (early / step).round() as u64;
            if !lab.advance_to_fault(&name, &mut player, next - taken, &mut seen.ended)? {
                break 'run;
            }
            taken = next;
            let picture = player.frame()?;
            let title = format!("{:.2} ms", 1e3 * EARLY[k]);
            seen.early
                .push(field(&picture, "temperature", title, spacing, true));
        }
        let next = (time / step).round() as u64;
        if !lab.advance_to_fault(&name, &mut player, next - taken, &mut seen.ended)? {
            break;
        }
        taken = next;
        seen.unbalanced = player.measure()?.energies.total() - first;
        let now = player.frame()?;
        let look = look(&player, setting, [&frame, &now], seen.looks.last());
        seen.looks.push(look);
        if time + 0.5 * LOOK >= setting.end / 8.0 * f64::from(pictured + 1) {
            pictured += 1;
            let title = format!("{:.1} ms", 1e3 * time);
            seen.late
                .push(field(&now, "temperature", title, spacing, false));
        }
        frame = now;
    }
    let time = seen.looks.last().map_or(0.0, |look| look.time);
    let title = format!("{} W/m, {:.0} ms", setting.power, 1e3 * time);
    seen.last = [
        Field {
            range: [0.0, 0.8],
            label: "speed, m/s".to_owned(),
            ..field(&frame, "none", title.clone(), spacing, false)
        },
        Field {
            range: [0.0, 120.0],
            label: "pressure, Pa".to_owned(),
            ..field(&frame, "pressure", title, spacing, false)
        },
    ];
    seen.unbalanced /= setting.power * time;
    Ok(seen)
}

fn look(
    player: &Player,
    setting: Setting,
    [before, now]: [&Frame; 2],
    last: Option<&Look>,
) -> Look {
    let helium = player.scene().superfluid.map(|it| it.helium());
    let density = helium.map_or(f64::NAN, |helium| helium.reference_density);
    let passed = now.time - before.time;
    let area = player.scene().particle_spacing * player.scene().particle_spacing;
    let (temperature, count) = mean(now, "temperature", in_cell);
    let entropy = mean(now, "entropy", in_cell).0;
    let mass = count * now.particle_mass;
    let per_watt = 1.0 / (temperature * entropy * density * WIDTH);
    let grown = last.map_or(0.0, |last| (entropy - last.entropy) / passed);
    Look {
        time: now.time,
        speed: crossings(&before.position, &now.position) * area / (WIDTH * passed),
        temperature: [temperature, mean(now, "temperature", in_bath).0],
        ideal: setting.power * per_watt,
        unstored: (setting.power - mass * temperature * grown) * per_watt,
        entropy,
    }
}

/// Means over the last third of a run.
fn steady(looks: &[Look], value: impl Fn(&Look) -> f64) -> f64 {
    let last = &looks[looks.len() - looks.len() / 3..];
    last.iter().map(value).sum::<f64>() / last.len().max(1) as f64
}

/// Running means.
fn smooth(looks: &[Look], value: impl Fn(&Look) -> f64) -> Vec<[f64; 2]> {
    let windows = looks.windows(WINDOW.min(looks.len().max(1)));
    let mean = |window: &[Look]| {
        let sum: f64 = window.iter().map(&value).sum();
        let middle = 0.5 * (window[0].time + window[window.len() - 1].time);
        [1e3 * middle, sum / window.len() as f64]
    };
    windows.map(mean).collect()
}

pub fn fountain(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let mut section = Section::new(
        "Superfluid helium, Figs. 8 to 12: the fountain",
        "Kincl, Schmoranzer & Pavelka, Phys. Fluids 35 (2023) 047124, section III C: a heater in a cell \
         under the surface of a bath at 1.65 K. The figure of the apparatus is not legible: cell, bath \
         and walls are those of the scene `fountain`, with a nozzle of 2 mm. Means are over the last \
         third of a run.",
    );
    let powers: &[f64] = lab.size(&[80.0], &[60.0, 80.0, 100.0]);
    let setting = Setting {
        power: 80.0,
        across: lab.size(10.0, 20.0),
        cfl: 0.4,
        end: lab.size(0.04, 0.3),
        viscosity: 1e-4,
        mutual_friction: MUTUAL_FRICTION,
    };
    let mut rows = Vec::new();
    let mut runs = Vec::new();
    for &power in powers {
        let seen = run(lab, Setting { power, ..setting })?;
        rows.push(row(Setting { power, ..setting }, &seen));
        runs.push((power, seen));
    }
    let viscosities: &[f64] = lab.size(&[], &[1e-4, 4e-4, 1.5e-3]);
    let mut relative = Vec::new();
    for &viscosity in viscosities {
        let changed = Setting {
            viscosity,
            across: 10.0,
            ..setting
        };
        let seen = run(lab, changed)?;
        rows.push(row(changed, &seen));
        let ideal = steady(&seen.looks, |look| look.ideal);
        let reynolds = 145.2 * WIDTH * ideal / viscosity;
        relative.push([reynolds, steady(&seen.looks, |look| look.speed) / ideal]);
    }
    for &mutual_friction in lab.size(&[][..], &[0.0]) {
        let changed = Setting {
            mutual_friction,
            across: 10.0,
            ..setting
        };
        let seen = run(lab, changed)?;
        without_mutual_friction(&mut section, &seen);
        rows.push(row(changed, &seen));
    }
    section.table(
        "The jet in the last third of each run",
        &[
            "W, W/m",
            "d/dr",
            "mu, Pa s",
            "A, m s/kg",
            "jet, m/s",
            "(31), m/s",
            "jet/(31)",
            "jet/(31) of what is not stored",
            "cell less bath, mK",
            "bath less T0, mK",
            "open balance, of the heat",
            "ended",
        ],
        rows,
    );
    for (power, seen) in &runs {
        if *power == 80.0 {
            checks(lab, &mut section, seen);
        }
    }
    figures(lab, &mut section, &runs, &relative)?;
    Ok(section)
}

fn row(setting: Setting, seen: &Seen) -> Vec<String> {
    let looks = &seen.looks;
    let speed = steady(looks, |look| look.speed);
    let ideal = steady(looks, |look| look.ideal);
    let unstored = steady(looks, |look| look.unstored);
    let difference = steady(looks, |look| look.temperature[0] - look.temperature[1]);
    let bath = steady(looks, |look| look.temperature[1] - 1.65);
    vec![
        setting.power.to_string(),
        setting.across.to_string(),
        setting.viscosity.to_string(),
        setting.mutual_friction.to_string(),
        format!("{speed:.3}"),
        format!("{ideal:.3}"),
        format!("{:.3}", speed / ideal),
        format!("{:.3}", speed / unstored),
        format!("{:.2}", 1e3 * difference),
        format!("{:.2}", 1e3 * bath),
        format!("{:.1e}", seen.unbalanced),
        seen.ended
            .clone()
            .unwrap_or_else(|| "as planned".to_owned()),
    ]
}

fn checks(lab: &Lab<'_>, section: &mut Section, seen: &Seen) {
    let speed = steady(&seen.looks, |look| look.speed);
    let ideal = steady(&seen.looks, |look| look.ideal);
    section.check_at_full_size(
        lab.quick(),
        "80 W/m: jet speed over (31)",
        format!("{:.3}", speed / ideal),
        "0.976",
        "within 10 % of 1",
        (speed / ideal - 1.0).abs() <= 0.1,
    );
    section.check(
        "80 W/m: a jet leaves the nozzle",
        format!("{speed:.3} m/s"),
        "",
        "above 0.1 m/s",
        speed > 0.1,
    );
    section.check(
        "80 W/m: energies less what the heater gave and the walls took, over the heat",
        format!("{:.1e}", seen.unbalanced),
        "",
        "at most 1e-3",
        seen.unbalanced.abs() <= 1e-3,
    );
}

/// Where nothing but the bath's temperature holds the components together.
fn without_mutual_friction(section: &mut Section, seen: &Seen) {
    let share = |look: &Look| look.speed / look.ideal;
    section.measure(
        "80 W/m without mutual friction, joined to the bath: jet speed over (31)",
        format!("{:.3}", steady(&seen.looks, share)),
        "0.976; √χ_n = 0.44 of a jet that takes on the temperature of the bath",
    );
}

fn figures(
    lab: &Lab<'_>,
    section: &mut Section,
    runs: &[(f64, Seen)],
    relative: &[[f64; 2]],
) -> Result<(), LabError> {
    let chart = |title: &str, y_label: &str| Chart {
        title: title.to_owned(),
        x_label: "t / ms".to_owned(),
        y_label: y_label.to_owned(),
        ..Chart::default()
    };
    let mut jets = chart("Fig. 8: speed of the jet", "v / (m/s)");
    let mut warmth = chart("Fig. 11, left: temperatures", "T / K");
    for (n, (power, seen)) in runs.iter().enumerate() {
        let curve = smooth(&seen.looks, |look| look.speed).into_iter();
        let label = format!("{power} W/m");
        jets.series.push(svg::line(&label, n, curve));
        let curve = smooth(&seen.looks, |look| look.ideal).into_iter();
        let label = format!("(31), {power} W/m");
        jets.series
            .push(svg::styled(&label, n, Style::Dashed, curve));
        for (k, (place, style)) in [("cell", Style::Line), ("bath", Style::Dashed)]
            .into_iter()
            .enumerate()
        {
            let curve = smooth(&seen.looks, |look| look.temperature[k]).into_iter();
            let label = format!("{place}, {power} W/m");
            warmth.series.push(svg::styled(&label, n, style, curve));
        }
    }
    lab.figure(section, "fountain-jet", &jets.svg(), "Means over 10 ms.")?;
    lab.figure(section, "fountain-temperatures", &warmth.svg(), "")?;
    if relative.len() > 1 {
        let curve = Chart {
            title: "Fig. 11, right: speed of the jet over (31)".to_owned(),
            x_label: "Re".to_owned(),
            y_label: "v / (31)".to_owned(),
            x_log: true,
            series: vec![svg::styled(
                "80 W/m, d/dr = 10",
                0,
                Style::LineDots,
                relative.iter().copied(),
            )],
            ..Chart::default()
        };
        lab.figure(section, "fountain-reynolds", &curve.svg(), "")?;
    }
    for (k, name) in ["speed", "pressure"].into_iter().enumerate() {
        let fields: Vec<Field> = runs.iter().map(|(_, seen)| seen.last[k].clone()).collect();
        let svg = svg::fields(&fields, 3, 420.0);
        lab.figure(
            section,
            &format!("fountain-{name}"),
            &svg,
            "Fig. 9, at the end.",
        )?;
    }
    for (power, seen) in runs {
        if *power != 80.0 {
            continue;
        }
        let captions = ["Fig. 10: the first millisecond.", "Fig. 12: the whole run."];
        let sets = [
            ("early", &seen.early, 4, 220.0),
            ("late", &seen.late, 4, 320.0),
        ];
        for ((name, fields, columns, width), caption) in sets.into_iter().zip(captions) {
            let fields = of_one_range(fields);
            let svg = svg::fields(&fields, columns, width);
            lab.figure(section, &format!("fountain-{name}"), &svg, caption)?;
        }
    }
    Ok(())
}

/// Temperatures with one range of colours: from the coldest tenth of them to nearly the warmest.
fn of_one_range(fields: &[Field]) -> Vec<Field> {
    let mut all: Vec<f64> = fields
        .iter()
        .flat_map(|f| f.values.iter().copied())
        .collect();
    all.sort_by(f64::total_cmp);
    let quantile = |share: f64| all.get((share * (all.len().max(1) - 1) as f64) as usize);
    let range = [0.05, 0.995].map(|share| quantile(share).copied().unwrap_or(0.0));
    let set = |field: &Field| Field {
        range,
        label: "temperature, K".to_owned(),
        ..field.clone()
    };
    fields.iter().map(set).collect()
}
