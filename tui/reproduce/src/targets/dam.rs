//! Figs. 2, 3, 5 and 8 to 12: energies of the dam break, and what floating point does to it.

use super::{dam_break, percent, same_way_back};
use crate::lab::{Lab, LabError, Past, scene};
use crate::section::Section;
use crate::svg::{self, Chart, Field, Style};
use loschmidt_runner::ArithmeticKind::{self, Fixed, Float};
use loschmidt_runner::run::{EnergyBalance, Row};
use loschmidt_runner::{Options, SavedState};

fn dam(
    lab: &mut Lab<'_>,
    name: &str,
    set: &[&str],
    arithmetic: ArithmeticKind,
) -> Result<Past, LabError> {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    lab.run(name, scene("dam-break", &set)?, arithmetic)
}

/// Largest energy error over the energy released.
fn error_over_released(rows: &[Row]) -> f64 {
    EnergyBalance::of(rows)
        .and_then(|balance| balance.max_error_over_released)
        .unwrap_or(f64::NAN)
}

pub fn fig2(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let spacing = lab.size("particle_spacing=0.04", "particle_spacing=0.01");
    let metres = lab.size(0.04, 0.01);
    let mut section = Section::new(
        "Fig. 2: the standard scheme gains energy, the symplectic one does not",
        format!(
            "Table 1 with a spacing of {metres} m, one way to 1 s. The standard scheme advances its density once after the drift."
        ),
    );
    let set = |model| [spacing, "turnaround=", "end=1.0", "output.frames=0", model];
    let standard = dam(lab, "fig2-standard", &set("model=standard"), Fixed)?;
    let symplectic = dam(lab, "fig2-symplectic", &set("model=symplectic"), Fixed)?;
    let unit = standard
        .rows
        .first()
        .map_or(1.0, |row| row.energy("gravitational"));
    let error = |past: &Past| -> Vec<[f64; 2]> {
        let home = past.rows.first().map_or(0.0, |row| row.total);
        let rows = past.rows.iter();
        rows.map(|row| [row.time_s, (row.total - home).abs() / unit + 1e-9])
            .collect()
    };
    let (std, sym) = (error(&standard), error(&symplectic));
    let worst = sym.iter().fold(0.0, |m: f64, p| m.max(p[1]));
    let last = std.last().copied().unwrap_or([0.0, 0.0]);
    let tenth = std.iter().find(|p| p[1] > 0.1).map(|p| p[0]);
    section.check(
        "symplectic: largest error over the initial gravitational energy",
        format!("{worst:.1e}"),
        "stable",
        "below 0.01",
        worst < 0.01,
    );
    let ours = match (&standard.failure, tenth) {
        (Some(failure), _) => format!("the numbers end at {:.3} s ({failure})", last[0]),
        (None, Some(t)) => format!("a tenth of the energy off at {t:.3} s"),
        (None, None) => format!("error {:.1e} at {:.2} s", last[1], last[0]),
    };
    let diverges = standard.failure.is_some() || tenth.is_some();
    section.check(
        "standard",
        ours,
        "diverges",
        "diverges within 1 s",
        diverges,
    );
    let chart = Chart {
        title: "Energy error".to_owned(),
        x_label: "t, s".to_owned(),
        y_label: "|E − E_0| / E_g".to_owned(),
        y_log: true,
        series: vec![
            svg::line("standard (STD)", 1, std.into_iter()),
            svg::line("symplectic (SYM)", 0, sym.into_iter()),
        ],
        ..Chart::default()
    };
    lab.figure(
        &mut section,
        "fig2",
        &chart.svg(),
        "Error of the total energy over E_g, the gravitational energy at the start. Without any stabilisation the standard scheme's grows until the run ends.",
    )?;
    Ok(section)
}

/// A picture of a state in the box of the dam break.
fn picture(state: &SavedState, scene: &loschmidt_runner::scene::Scene, title: &str) -> Field {
    let n = state.id.len();
    let wall_words = state.wall_positions().chunks(state.dimension);
    let quantum = state.scale.length_quantum();
    let value = |w: i64| match state.arithmetic {
        Fixed => w as f64 * quantum,
        Float => f64::from_bits(w as u64) * quantum,
    };
    let speed = |n| {
        let v = state.velocity(n);
        (v[0] * v[0] + v[1] * v[1]).sqrt()
    };
    Field {
        title: title.to_owned(),
        bounds: [[-0.15, -0.15], [4.15, 3.0]],
        diameter: scene.particle_spacing,
        points: (0..n)
            .map(|n| [state.position(n)[0], state.position(n)[1]])
            .collect(),
        values: (0..n).map(speed).collect(),
        range: [0.0, 7.0],
        label: "speed, m/s".to_owned(),
        walls: wall_words.map(|w| [value(w[0]), value(w[1])]).collect(),
    }
}

pub fn fig3(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    // Floating point has no fast executor: 80,000 particles would take it most of an hour.
    let [fixed, float] = lab.size(["0.04"; 2], ["0.005", "0.01"]);
    let spacings = if fixed == float {
        format!("a spacing of {fixed} m")
    } else {
        format!(
            "a spacing of {fixed} m in fixed point and, to save time, {float} m in floating point"
        )
    };
    let mut section = Section::new(
        "Fig. 3: fixed point returns, floating point does not",
        format!(
            "Table 1 with {spacings}, out to 1 s and back, the same pair terms in both arithmetics."
        ),
    );
    let mut pictures = Vec::new();
    let titles = [
        "start",
        "0.5 s, out",
        "1 s, turned",
        "0.5 s, on the way back",
        "back at 0 s",
    ];
    let mut columns = Vec::new();
    for (arithmetic, name, spacing) in [
        (Fixed, "fixed point", fixed),
        (Float, "floating point", float),
    ] {
        lab.say(&format!("  {name}"));
        let set = [
            format!("particle_spacing={spacing}"),
            "turnaround=1.0".to_owned(),
        ];
        let scene = scene("dam-break", &set)?;
        let options = Options {
            arithmetic,
            ..lab.options()
        };
        let mut player = lab.player(&scene, options)?;
        let half = scene.steps_out() / 2;
        let mut column = Vec::new();
        for (k, title) in titles.iter().enumerate() {
            if k > 0 {
                lab.advance(name, &mut player, half)?;
            }
            column.push(picture(&player.save(), &scene, &format!("{name}: {title}")));
            if k == 2 {
                player.turn();
            }
        }
        let home = player.compare_with_home();
        let moved = format!("{:.3} m", home.error);
        let astray = format!("{} of {}", home.astray, player.home().id.len());
        if arithmetic == Fixed {
            section.check(
                "fixed point: farthest from home",
                moved,
                "returns",
                "every bit",
                home.is_exact(),
            );
        } else {
            section.check(
                "floating point: farthest from home",
                moved,
                "fails",
                "not home",
                !home.is_exact(),
            );
            section.measure("floating point: particles astray", astray, "");
        }
        columns.push(column);
    }
    for k in 0..titles.len() {
        for column in &columns {
            pictures.push(column[k].clone());
        }
    }
    lab.figure(
        &mut section,
        "fig3",
        &svg::fields(&pictures, 2, 420.0),
        &format!(
            "Coloured by speed; {spacings}. Left: fixed point. Right: the same in floating point."
        ),
    )?;
    Ok(section)
}

/// Name and title of a figure, and what it shows.
type Shown = (&'static str, &'static str, fn(&Row) -> f64);

pub fn fig5(lab: &mut Lab<'_>) -> Result<Section, LabError> {
    let past = dam_break(lab)?;
    let mut section = Section::new(
        "Figs. 5 and 8 to 12: the energy budget, there and back",
        format!(
            "Table 1 with a spacing of {} m, out to {} s and back: {} rows.",
            past.scene.particle_spacing,
            past.scene.turnaround.unwrap_or(0.0),
            past.rows.len()
        ),
    );
    let Some(home) = past.rows.first() else {
        return Ok(section);
    };
    budget(&past, lab.quick(), &mut section);
    let energies: [Shown; 5] = [
        ("fig8", "total energy", |row| row.total),
        ("fig9", "kinetic energy", |row| row.energy("kinetic")),
        ("fig10", "gravitational energy", |row| {
            row.energy("gravitational")
        }),
        ("fig11", "internal energy", |row| row.energy("internal")),
        ("fig12", "wall energy", |row| row.energy("wall")),
    ];
    let released = EnergyBalance::of(&past.rows).map_or(1.0, |balance| balance.released);
    let both = |value: &dyn Fn(&Row) -> f64| {
        let points = |leg: u8| -> Vec<[f64; 2]> {
            let rows = past.rows.iter().filter(|row| row.leg == leg);
            rows.map(|row| [row.time_s, value(row)]).collect()
        };
        vec![
            svg::line("out", 0, points(1).into_iter()),
            svg::styled("back", 1, Style::Dashed, points(2).into_iter()),
        ]
    };
    let chart = Chart {
        title: "Fig. 5: error of the total energy".to_owned(),
        x_label: "t, s".to_owned(),
        y_label: "(E − E_0) / energy released".to_owned(),
        series: both(&|row| (row.total - home.total) / released),
        ..Chart::default()
    };
    lab.figure(
        &mut section,
        "fig5",
        &chart.svg(),
        "The error of the total energy over the gravitational energy released.",
    )?;
    for (name, title, value) in energies {
        let chart = Chart {
            title: format!("{}: {title}", name.replace("fig", "Fig. ")),
            x_label: "t, s".to_owned(),
            y_label: format!("{title}, J/m"),
            series: both(&value),
            ..Chart::default()
        };
        lab.figure(
            &mut section,
            name,
            &chart.svg(),
            &format!("The {title}, out and back: the dashes lie on the line."),
        )?;
    }
    Ok(section)
}

/// The error of the energy in three units, and where the energy went.
fn budget(past: &Past, quick: bool, section: &mut Section) {
    let Some(home) = past.rows.first() else {
        return;
    };
    let to_one: Vec<Row> = past
        .out()
        .filter(|row| row.time_s <= 1.0 + 1e-9)
        .cloned()
        .collect();
    // c²/6 per kg, which eq. (3) has at the reference density.
    let scene = &past.scene;
    let particles = past.state("home").map_or(0, |state| state.id.len());
    let mass = particles as f64 * scene.particle_mass();
    let offset = mass * scene.sound_speed().powi(2) / 6.0;
    for (rows, until) in [(&to_one[..], "1 s"), (&past.rows[..], "the end")] {
        let error = error_over_released(rows);
        section.measure(
            &format!("largest error over released, up to {until}"),
            format!("{error:.2e}"),
            "",
        );
        let error = EnergyBalance::of(rows).map_or(f64::NAN, |balance| balance.max_error);
        let over_offset = 100.0 * error / (home.total + offset);
        section.check_at_full_size(
            quick,
            &format!("the same over the paper's total, offset c²/6 included, up to {until}"),
            format!("{over_offset:.2e} %"),
            "2e-4 %",
            "at most 2.5e-4 %",
            over_offset <= 2.5e-4,
        );
    }
    if let Some(turn) = past.out().last() {
        let released = home.energy("gravitational") - turn.energy("gravitational");
        section.measure(
            "released energy that is kinetic at the turnaround",
            percent((turn.energy("kinetic") - home.energy("kinetic")) / released),
            "about 3/4",
        );
        section.measure(
            "released energy that is internal at the turnaround",
            percent((turn.energy("internal") - home.energy("internal")) / released),
            "about 1/4",
        );
    }
    let same = same_way_back(past);
    section.check(
        "rows of the way back",
        if same { "equal, bit for bit" } else { "differ" },
        "",
        "equal those of the way out, bit for bit",
        same,
    );
}
