//! What a run says at its end.

use comfy_table::{CellAlignment, Table, presets::NOTHING};
use loschmidt_runner::Outcome;
use loschmidt_runner::figures::{Scale, number, quantity};
use loschmidt_runner::run::Row;
use loschmidt_runner::totals::total_for_people;

/// The table of energies, entropy and digests.
pub fn table(outcome: &Outcome, rows: &[Row], unit: Scale) -> String {
    let first = rows.first();
    let turn = rows.iter().rev().find(|row| row.leg == 1);
    let last = rows.last();
    let two_way = outcome.digest.turnaround.is_some();
    let columns: Vec<(&str, Option<&Row>)> = if two_way {
        vec![("start", first), ("turnaround", turn), ("end", last)]
    } else {
        vec![("start", first), ("end", last)]
    };
    let mut table = Table::new();
    table.load_preset(NOTHING);
    table.set_header(std::iter::once("").chain(columns.iter().map(|(name, _)| *name)));
    let mut line = |name: &str, value: &dyn Fn(&Row) -> String| {
        let cells = columns
            .iter()
            .map(|(_, row)| row.map_or(String::new(), value));
        table.add_row(std::iter::once(name.to_owned()).chain(cells));
    };
    line("time", &|row| unit.amount(row.time_s, 5));
    let largest = rows.iter().flat_map(|row| &row.energies);
    let largest = largest.fold(0.0, |most: f64, (_, value)| most.max(value.abs()));
    let joule = |energy: f64| Scale::of(largest, "J").amount(energy, 7);
    for (kind, _) in first.into_iter().flat_map(|row| &row.energies) {
        line(&format!("{kind} energy"), &|row| joule(row.energy(kind)));
    }
    line("total energy", &|row| joule(row.total));
    for (heading, _) in first.into_iter().flat_map(|row| &row.totals) {
        let (name, unit) = total_for_people(heading);
        line(&name, &|row| {
            row.total_of(heading)
                .map_or(String::new(), |x| quantity(x, unit, 10))
        });
    }
    let entropies = rows.iter().map(|row| row.entropy.abs());
    let nats = Scale::of(entropies.fold(0.0, f64::max), "");
    line("entropy", &|row| nats.fixed(row.entropy, 5));
    line("  in equilibrium", &|row| {
        row.equilibrium_entropy_of_energy
            .map_or("-".to_owned(), |s| nats.fixed(s, 5))
    });
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let mut text = table.trim_fmt();
    let error = match outcome.energy.max_error_over_released {
        Some(error) => format!(
            "{}, {} of the {} released",
            quantity(outcome.energy.max_error, "J", 3),
            number(error, 3),
            quantity(outcome.energy.released, "J", 5)
        ),
        None => {
            let error = outcome.energy.max_error;
            let kinetic = first.map_or(0.0, |row| row.energy("kinetic"));
            let work = last.map_or(0.0, |row| -row.energy("drive"));
            let of = if work > 0.0 {
                format!(", {} of the work of the walls", number(error / work, 3))
            } else if kinetic > 0.0 {
                let share = number(error / kinetic, 3);
                format!(", {share} of the kinetic energy at the start")
            } else if outcome.energy.initial > 0.0 {
                let share = number(error / outcome.energy.initial, 3);
                format!(", {share} of the energy at the start")
            } else {
                String::new()
            };
            let released = if work > 0.0 {
                ""
            } else {
                "; nothing was released"
            };
            format!("{}{of}{released}", quantity(error, "J", 4))
        }
    };
    text += &format!("\n\nlargest energy error    {error}");
    if outcome.lone_particles > 0 {
        text += &format!(
            "\nlone particles          {} with too few neighbours to feel all of their surroundings",
            outcome.lone_particles
        );
    }
    if let Some(compression) = outcome.seen.largest_compression {
        text += &format!("\nlargest compression     {:.2} %", 100.0 * compression);
        if compression > MOST_COMPRESSION {
            text += ": TOO MUCH, the speed of sound is too low for this flow, or the time step too long";
        }
    }
    if let Some(beyond) = outcome.seen.beyond_walls.filter(|beyond| *beyond > 0) {
        text += &format!(
            "\nbeyond the walls        {beyond} particles, where the fluid cannot come without passing a \
             wall: `loschmidt check` says whether the walls are strong and dense enough"
        );
    }
    text += &format!("\ndigest at the start     {}", outcome.digest.initial);
    if let Some(digest) = &outcome.digest.turnaround {
        text += &format!("\ndigest, turnaround      {digest}");
    }
    text += &format!("\ndigest at the end       {}", outcome.digest.last);
    text
}

/// From this compression on a fluid is not the one that was meant: that of a dam break which hits its
/// wall is below.
const MOST_COMPRESSION: f64 = 0.1;

/// Why a run cannot be expected to return.
fn reason(outcome: &Outcome) -> &'static str {
    match (outcome.model.as_str(), outcome.arithmetic.as_str()) {
        ("superfluid-paper", _) => {
            " The paper's integrator is not symmetric in time; model = \"superfluid\" returns."
        }
        ("standard", _) => {
            " The standard scheme is not symmetric in time; model = \"symplectic\" returns."
        }
        (_, "float") => {
            " Floating-point sums are rounded differently on the way back; --arithmetic fixed returns."
        }
        _ => "",
    }
}

/// The sentence that says whether time came back.
pub fn sentence(outcome: &Outcome) -> String {
    let steps = outcome.steps;
    match outcome.reversed_exactly {
        Some(true) => format!(
            "Time came back: after {} steps out and {} back, every bit of the last state equals the first.",
            steps / 2,
            steps / 2
        ),
        Some(false) => format!(
            "Time did not come back: after {} steps out and {} back, a particle is up to {} from home.{}",
            steps / 2,
            steps / 2,
            quantity(outcome.max_return_error_m.unwrap_or(f64::NAN), "m", 4),
            reason(outcome)
        ),
        None => {
            format!("The run ended after {steps} steps; it was not asked to come all the way back.")
        }
    }
}
