//! Viscous flows as they are looked at: velocities at any place, and energies in time.

use crate::lab::{Lab, LabError};
use crate::svg::{self, Chart, Series};
use loschmidt_core::kernel::WendlandC2;
use loschmidt_runner::Player;
use loschmidt_runner::scene::{InitialState, InitialWall, Velocity};

/// The particles of a flow and of its walls, and how fast they are or pretend to be.
pub struct Flow {
    /// How many flow: they come first.
    pub flowing: usize,
    /// m.
    pub position: Vec<[f64; 2]>,
    /// m/s.
    pub velocity: Vec<[f64; 2]>,
    /// Rows of the distortion: xx, xy, yx, yy.
    pub distortion: Vec<[f64; 4]>,
    /// The kernel, and its support radius, m.
    kernel: WendlandC2,
    support: f64,
}

impl Flow {
    /// The present state of a player, whose first `flowing` particles are no walls; with walls that
    /// are no particles, and how fast they pretend to be.
    pub fn of(player: &mut Player, flowing: usize, walls: &[[[f64; 2]; 2]]) -> Self {
        let state = player.save();
        let all = 0..state.id.len();
        let support = player.scene().support_radius();
        let distortion = state.fields.iter().find(|field| field.name == "distortion");
        let words = distortion.map_or(&[][..], |field| &field.words);
        let unit = 2.0_f64.powi(-48);
        Self {
            flowing,
            position: all
                .clone()
                .map(|n| plane(state.position(n)))
                .chain(walls.iter().map(|wall| wall[0]))
                .collect(),
            velocity: all
                .map(|n| plane(state.velocity(n)))
                .chain(walls.iter().map(|wall| wall[1]))
                .collect(),
            distortion: words
                .chunks_exact(4)
                .map(|a| std::array::from_fn(|k| a[k] as f64 * unit))
                .collect(),
            kernel: WendlandC2::new(2, support, 1.0),
            support,
        }
    }

    /// The velocity at a place, m/s: that of the linear field that fits best, each particle within
    /// the support weighted by the kernel.
    pub fn velocity_at(&self, place: [f64; 2]) -> [f64; 2] {
        let mut matrix = [[0.0; 3]; 3];
        let mut right = [[0.0; 3]; 2];
        for (x, v) in self.position.iter().zip(&self.velocity) {
            let d = [x[0] - place[0], x[1] - place[1]];
            let r = d[0].hypot(d[1]);
            if r >= self.support {
                continue;
            }
            let weight = self.kernel.value(r);
            let basis = [1.0, d[0], d[1]];
            for i in 0..3 {
                for j in 0..3 {
                    matrix[i][j] += weight * basis[i] * basis[j];
                }
                for (right, v) in right.iter_mut().zip(v) {
                    right[i] += weight * basis[i] * v;
                }
            }
        }
        // The first component of the solution, by Cramer's rule.
        let minor = |a: usize, b: usize| matrix[1][a] * matrix[2][b] - matrix[1][b] * matrix[2][a];
        let cofactors = [minor(1, 2), -minor(0, 2), minor(0, 1)];
        let sum =
            |row: &[f64; 3]| row[0] * cofactors[0] + row[1] * cofactors[1] + row[2] * cofactors[2];
        let determinant = sum(&matrix[0]);
        right.map(|right| sum(&right) / determinant)
    }

    /// Streamlines of a flow in the unit square under a lid.
    pub fn streamlines(&self) -> Vec<Vec<[f64; 2]>> {
        SEEDS.map(|seed| self.streamline(seed)).to_vec()
    }

    /// The streamline through a place, until it has come round or to the edge.
    fn streamline(&self, seed: [f64; 2]) -> Vec<[f64; 2]> {
        const STEP: f64 = 0.01;
        let along = |[x, y]: [f64; 2]| {
            let [u, v] = self.velocity_at([x, y]);
            let speed = u.hypot(v).max(1e-9);
            [u / speed, v / speed]
        };
        let (mut line, mut x) = (vec![seed], seed);
        for n in 0..400 {
            let [u, v] = along(x);
            let [u, v] = along([x[0] + 0.5 * STEP * u, x[1] + 0.5 * STEP * v]);
            x = [x[0] + STEP * u, x[1] + STEP * v];
            if !x.iter().all(|x| (0.005..0.995).contains(x)) {
                break;
            }
            line.push(x);
            let home = (x[0] - seed[0]).hypot(x[1] - seed[1]);
            if n > 5 && home < 0.75 * STEP {
                break;
            }
        }
        line
    }
}

/// Where streamlines begin: from the middle of the vortex outwards, and in the lower corners.
const SEEDS: [[f64; 2]; 13] = [
    [0.58, 0.68],
    [0.58, 0.62],
    [0.58, 0.55],
    [0.58, 0.47],
    [0.58, 0.38],
    [0.58, 0.29],
    [0.58, 0.2],
    [0.58, 0.12],
    [0.58, 0.06],
    [0.95, 0.05],
    [0.9, 0.07],
    [0.03, 0.03],
    [0.05, 0.06],
];

/// Places of walls that are no particles, and their velocities.
fn still_walls(player: &Player, initial: &InitialState) -> Vec<[[f64; 2]; 2]> {
    let regions = &player.scene().regions;
    let velocity = |place: usize| {
        let before = |wall: &&InitialWall| wall.first <= place as u64;
        let wall = initial.walls.iter().rev().find(before);
        match wall.map(|wall| &regions[wall.region].velocity[..]) {
            Some([Velocity::Uniform(velocity)]) => plane(*velocity),
            _ => [0.0; 2],
        }
    };
    let walls = initial.wall.iter().enumerate();
    walls.map(|(n, x)| [plane(*x), velocity(n)]).collect()
}

fn plane(x: [f64; 3]) -> [f64; 2] {
    [x[0], x[1]]
}

/// Energies in time, and how well they balance.
#[derive(Default)]
pub struct Budget {
    /// Time in s and kinetic, bulk, shear energy and heat in J for each m.
    curves: [Vec<[f64; 2]>; 4],
    first: f64,
    /// The sum of all energies less that at the start, over the work of the walls, at the end.
    pub error: f64,
}

const KINDS: [&str; 4] = ["kinetic", "bulk", "shear", "heat"];

impl Budget {
    /// Energies over the kinetic one at the end.
    pub fn chart(&self, figure: &str) -> Chart {
        let end = self.curves[0].last().map_or(1.0, |[_, e]| *e);
        let series = |(n, (name, curve)): (usize, (&&str, &Vec<[f64; 2]>))| -> Series {
            svg::line(name, n, curve.iter().map(|[t, e]| [*t, e / end]))
        };
        Chart {
            title: format!("{figure}: energies over the kinetic one at the end"),
            x_label: "t / s".to_owned(),
            y_label: "E / K(end)".to_owned(),
            y_log: true,
            series: KINDS
                .iter()
                .zip(&self.curves)
                .enumerate()
                .map(series)
                .collect(),
            ..Chart::default()
        }
    }

    fn take(&mut self, player: &mut Player) -> Result<(), LabError> {
        let energies = player.measure()?.energies;
        let time = player.time();
        for (curve, kind) in self.curves.iter_mut().zip(KINDS) {
            curve.push([time, energies.get(kind)]);
        }
        if self.curves[0].len() == 1 {
            self.first = energies.total();
        }
        let work = -energies.get("drive");
        self.error = (energies.total() - self.first) / work.max(f64::MIN_POSITIVE);
        Ok(())
    }
}

/// Takes a flow to its end and looks at it so many times on the way, evenly.
pub fn march(
    lab: &mut Lab<'_>,
    name: &str,
    player: &mut Player,
    looks: u64,
    mut look: impl FnMut(f64, &Flow),
) -> Result<Budget, LabError> {
    let initial = player.scene().initial_state()?;
    let walls = initial.parts.get(1).map(|part| part.first as usize);
    let flowing = walls.unwrap_or(initial.fluid.len());
    let still = still_walls(player, &initial);
    let steps = player.scene().steps_out();
    let mut budget = Budget::default();
    budget.take(player)?;
    let mut taken = 0;
    for n in 1..=looks {
        let next = steps * n / looks;
        lab.advance(name, player, next - taken)?;
        taken = next;
        budget.take(player)?;
        let flow = Flow::of(player, flowing, &still);
        look(player.time(), &flow);
    }
    Ok(budget)
}
