//! What walls enclose: the places that a fluid can come to without passing a wall.
//!
//! The box around all particles is cut into cells half a spacing wide. A cell whose middle is nearer
//! than 0.8 spacings to a wall particle belongs to the wall: rows a spacing apart leave no gap
//! then, in the plane and in space. From the cells of the fluid the free ones are filled through
//! their faces, as far as the box goes. Where the filling arrives at a side of the box, that side is
//! open.

use crate::scene::Vector3;

/// Width of a cell, in spacings.
const CELL: f64 = 0.5;

/// Half of the thickness of a row of wall particles, in spacings. The middle of four particles of a
/// square is 0.71 away from each.
const THICK: f64 = 0.8;

/// Cells within so many of a place that the fluid can come to are not beyond the wall: particles may
/// press into its first row.
const TOLERATED: i64 = 2;

/// The most cells.
const MOST_CELLS: f64 = (1_u64 << 25) as f64;

/// The places that a fluid can come to without passing a wall.
#[derive(Clone, Debug)]
pub struct Enclosure {
    /// Middle of the first cell, m.
    low: Vector3,
    /// Width of a cell, m.
    cell: f64,
    /// Cells along each axis; one along z in the plane.
    size: [i64; 3],
    /// What is known of each cell, x fastest.
    cells: Vec<Cell>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cell {
    Free,
    Wall,
    Reached,
}

impl Enclosure {
    /// What `wall` encloses of `fluid` (m), with this particle spacing (m); `None` without walls,
    /// and where the box is too large to be searched.
    #[must_use]
    pub fn of(fluid: &[Vector3], wall: &[Vector3], spacing: f64) -> Option<Self> {
        wall.first()?;
        let all = || fluid.iter().chain(wall);
        let end = |k: usize, pick: fn(f64, f64) -> f64| all().map(|x| x[k]).reduce(pick);
        let cell = CELL * spacing;
        let mut grid = Self {
            low: [0.0; 3],
            cell,
            size: [1; 3],
            cells: Vec::new(),
        };
        let mut count = 1.0;
        for k in 0..3 {
            let (low, high) = (end(k, f64::min)?, end(k, f64::max)?);
            let cells = ((high - low) / cell).round() + 1.0;
            count *= cells;
            if count.is_nan() || count > MOST_CELLS {
                return None;
            }
            grid.low[k] = low;
            grid.size[k] = cells as i64;
        }
        grid.cells = vec![Cell::Free; count as usize];
        grid.build(wall, THICK * spacing);
        grid.fill(fluid);
        Some(grid)
    }

    /// The cell of a place, which may lie outside the box.
    fn cell_of(&self, x: &Vector3) -> [i64; 3] {
        std::array::from_fn(|k| ((x[k] - self.low[k]) / self.cell).round() as i64)
    }

    fn index(&self, at: [i64; 3]) -> Option<usize> {
        let inside = (0..3).all(|k| (0..self.size[k]).contains(&at[k]));
        inside.then(|| (at[0] + self.size[0] * (at[1] + self.size[1] * at[2])) as usize)
    }

    /// Where the cell of this number is.
    fn place(&self, index: usize) -> [i64; 3] {
        let index = index as i64;
        let rows = index / self.size[0];
        [
            index % self.size[0],
            rows % self.size[1],
            rows / self.size[1],
        ]
    }

    /// The cells around one, so many to each side.
    fn around(&self, at: [i64; 3], by: i64) -> impl Iterator<Item = [i64; 3]> + use<> {
        let deep = if self.size[2] > 1 { by } else { 0 };
        let rows = (-deep..=deep).flat_map(move |k| (-by..=by).map(move |j| [j, k]));
        rows.flat_map(move |[j, k]| (-by..=by).map(move |i| [at[0] + i, at[1] + j, at[2] + k]))
    }

    /// Marks what is nearer than `thick` (m) to a wall particle.
    fn build(&mut self, wall: &[Vector3], thick: f64) {
        let by = (thick / self.cell).ceil() as i64;
        for x in wall {
            for at in self.around(self.cell_of(x), by) {
                let distance: f64 = (0..3)
                    .map(|k| (self.low[k] + at[k] as f64 * self.cell - x[k]).powi(2))
                    .sum();
                if distance < thick * thick
                    && let Some(index) = self.index(at)
                {
                    self.cells[index] = Cell::Wall;
                }
            }
        }
    }

    /// Fills from the cells of the fluid, which are free whatever stands there.
    fn fill(&mut self, fluid: &[Vector3]) {
        let mut todo: Vec<[i64; 3]> = fluid.iter().map(|x| self.cell_of(x)).collect();
        for at in &todo {
            if let Some(index) = self.index(*at) {
                self.cells[index] = Cell::Reached;
            }
        }
        while let Some(at) = todo.pop() {
            for k in 0..3 {
                for by in [-1, 1] {
                    let mut next = at;
                    next[k] += by;
                    if let Some(index) = self.index(next)
                        && self.cells[index] == Cell::Free
                    {
                        self.cells[index] = Cell::Reached;
                        todo.push(next);
                    }
                }
            }
        }
    }

    /// Whether the fluid can come to the lower or the upper side of the box along each axis. Along z
    /// it cannot in the plane.
    #[must_use]
    pub fn open_sides(&self) -> [[bool; 2]; 3] {
        let mut open = [[false; 2]; 3];
        for (index, cell) in self.cells.iter().enumerate() {
            if *cell != Cell::Reached {
                continue;
            }
            let at = self.place(index);
            for k in (0..3).filter(|&k| self.size[k] > 1) {
                open[k][0] |= at[k] == 0;
                open[k][1] |= at[k] == self.size[k] - 1;
            }
        }
        open
    }

    /// The largest value of a function at the places that the fluid can come to, m.
    #[must_use]
    pub fn largest(&self, value: impl Fn(&Vector3) -> f64) -> f64 {
        let cells = self.cells.iter().enumerate();
        cells
            .filter(|(_, cell)| **cell == Cell::Reached)
            .map(|(index, _)| {
                let at = self.place(index);
                value(&std::array::from_fn(|k| {
                    self.low[k] + at[k] as f64 * self.cell
                }))
            })
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// How many of these particles (m) are where the fluid cannot come to without passing a wall.
    /// Outside the box these are those that have not left it on an open side.
    #[must_use]
    pub fn count_beyond(&self, fluid: &[Vector3]) -> u64 {
        let open = self.open_sides();
        fluid.iter().filter(|x| self.is_beyond(x, &open)).count() as u64
    }

    fn is_beyond(&self, x: &Vector3, open: &[[bool; 2]; 3]) -> bool {
        let at = self.cell_of(x);
        let mut outside = false;
        for k in 0..3 {
            for (is_outside, is_open) in [
                (at[k] < -TOLERATED, open[k][0]),
                (at[k] >= self.size[k] + TOLERATED, open[k][1]),
            ] {
                if is_outside && is_open {
                    return false;
                }
                outside |= is_outside;
            }
        }
        if outside {
            return true;
        }
        let near = self.around(at, TOLERATED);
        !near
            .filter_map(|at| self.index(at))
            .any(|index| self.cells[index] == Cell::Reached)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nodes of the square [-size, size]² or the cube that lie on its faces, but for those that
    /// are left out.
    fn faces(size: i64, deep: bool, leave_out: impl Fn([i64; 3]) -> bool) -> Vec<Vector3> {
        let along = -size..=size;
        let depths = if deep { -size..=size } else { 0..=0 };
        let nodes = depths.flat_map(|k| {
            let rows = along.clone().map(move |j| [j, k]);
            rows.flat_map(|[j, k]| (-size..=size).map(move |i| [i, j, k]))
        });
        nodes
            .filter(|at| at.iter().any(|x| x.abs() == size) && !leave_out(*at))
            .map(|at| at.map(|x| 0.1 * x as f64))
            .collect()
    }

    #[test]
    fn a_single_row_of_wall_particles_is_tight_and_one_missing_is_a_hole() {
        let fluid = [[0.0; 3]];
        for deep in [false, true] {
            let tight = Enclosure::of(&fluid, &faces(5, deep, |_| false), 0.1).expect("a box");
            assert_eq!(tight.open_sides(), [[false; 2]; 3]);
            // In the middle, pressed into the wall, through it on each side, and on the diagonal.
            let z = if deep { 0.1 } else { 0.0 };
            let inside = [[0.0; 3], [0.48, 0.1, z]];
            let outside = [[0.64, 0.0, z], [0.0, -0.7, z], [-0.7, 0.7, 0.0]];
            assert_eq!(tight.count_beyond(&inside), 0);
            assert_eq!(tight.count_beyond(&outside), 3);
            assert!((tight.largest(|x| -x[1]) - 0.4).abs() < 0.051);

            let hole = |at: [i64; 3]| at[0] == 1 && at[1] == -5 && at[2] == 0;
            let leaky = Enclosure::of(&fluid, &faces(5, deep, hole), 0.1).expect("a box");
            assert_eq!(leaky.open_sides(), [[false; 2], [true, false], [false; 2]]);
            // Below the hole nothing is beyond the wall.
            assert_eq!(leaky.count_beyond(&[[0.0, -0.9, z]]), 0);
        }
    }

    #[test]
    fn an_open_tank_is_open_above_and_a_wall_in_it_is_gone_around() {
        let lid = |at: [i64; 3]| at[1] == 5 && at[0].abs() < 5;
        let mut wall = faces(5, false, lid);
        wall.extend((-5..3).map(|j| [0.1, 0.1 * f64::from(j), 0.0]));
        let tank = Enclosure::of(&[[-0.2, 0.0, 0.0]], &wall, 0.1).expect("a box");
        assert_eq!(tank.open_sides(), [[false; 2], [false, true], [false; 2]]);
        let places = [[0.3, -0.3, 0.0], [0.0, 2.0, 0.0], [3.0, 2.0, 0.0]];
        assert_eq!(tank.count_beyond(&places), 0);
    }

    #[test]
    fn nothing_encloses_without_walls_and_what_is_too_large_is_not_searched() {
        let fluid = [[0.0; 3]];
        assert!(Enclosure::of(&fluid, &[], 0.1).is_none());
        for far in [1e6, f64::INFINITY] {
            assert!(Enclosure::of(&fluid, &[[far, far, 0.0]], 0.1).is_none());
        }
    }
}
