//! Regular lattices, by integer index.
//!
//! A node's coordinate is origin + (i + 1/2) * pitch, computed from its integer index and
//! not from its neighbour's coordinate: nothing accumulates, and a region and the wall
//! around it agree on every bit. Only `+` and `*` are used.

use super::shape::{Bounds, Point, Shape};
use super::words::{Dimension, LatticeKind};

/// Position of a node along x, y and z.
pub(super) type Index = [i64; 3];

/// Pitch of a hexagonal lattice along a row, in spacings: sqrt(2 / sqrt(3)), which gives
/// every particle the area of one spacing squared.
const HEXAGONAL_PITCH: f64 = 1.074_569_931_823_542;

/// Distance of the rows of a hexagonal lattice, in spacings: sqrt(sqrt(3) / 2).
const HEXAGONAL_ROW: f64 = 0.930_604_859_102_099_6;

/// A regular lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    pub kind: LatticeKind,
    /// The corner half a pitch below node 0 along every axis, m.
    pub origin: Point,
    /// Particle spacing, m.
    pub spacing: f64,
}

impl Lattice {
    pub fn dimension(&self) -> Dimension {
        match self.kind {
            LatticeKind::Square | LatticeKind::Hexagonal => Dimension::Two,
            LatticeKind::Cubic => Dimension::Three,
        }
    }

    /// Distance of neighbouring nodes along each axis, m.
    fn pitch(&self) -> Point {
        let s = self.spacing;
        match self.kind {
            LatticeKind::Square | LatticeKind::Cubic => [s, s, s],
            LatticeKind::Hexagonal => [HEXAGONAL_PITCH * s, HEXAGONAL_ROW * s, s],
        }
    }

    /// The point of a node, m.
    pub fn node(&self, index: Index) -> Point {
        let pitch = self.pitch();
        let shift = match self.kind {
            LatticeKind::Hexagonal if index[1].rem_euclid(2) == 1 => 0.5,
            _ => 0.0,
        };
        // Indices stay far below 2^52: the sums in brackets are exact.
        let x = self.origin[0] + (index[0] as f64 + 0.5 + shift) * pitch[0];
        let y = self.origin[1] + (index[1] as f64 + 0.5) * pitch[1];
        let z = match self.dimension() {
            Dimension::Two => 0.0,
            Dimension::Three => self.origin[2] + (index[2] as f64 + 0.5) * pitch[2],
        };
        [x, y, z]
    }

    /// The number of nodes in a box, for a decision whether to visit them.
    pub fn nodes_within(&self, bounds: Bounds) -> f64 {
        let pitch = self.pitch();
        (0..self.dimension().axes())
            .map(|k| (bounds.1[k] - bounds.0[k]) / pitch[k] + 3.0)
            .product()
    }

    /// The lowest and one above the highest index of all nodes in a box and a few around it.
    fn extent(&self, bounds: Bounds) -> (Index, Index) {
        let pitch = self.pitch();
        let axes = self.dimension().axes();
        // Far beyond any scene that is accepted, and far below the end of i64.
        const FARTHEST: f64 = (1_u64 << 52) as f64;
        let index = |k: usize, x: f64| ((x - self.origin[k]) / pitch[k]).clamp(-FARTHEST, FARTHEST);
        let low = |k| {
            if k < axes {
                index(k, bounds.0[k]).floor() as i64 - 1
            } else {
                0
            }
        };
        let high = |k| {
            if k < axes {
                index(k, bounds.1[k]).ceil() as i64 + 1
            } else {
                1
            }
        };
        (std::array::from_fn(low), std::array::from_fn(high))
    }

    /// Visits the nodes of a shape, x fastest, then y, then z.
    pub fn visit(&self, shape: &Shape, mut visitor: impl FnMut(Point)) {
        let Some(bounds) = shape.bounds(self.spacing) else {
            return;
        };
        let grid = Grid {
            lattice: *self,
            stencils: shape
                .reaches()
                .into_iter()
                .map(|reach| Stencil::new(self, reach))
                .collect(),
        };
        let (low, high) = self.extent(bounds);
        for k in low[2]..high[2] {
            for j in low[1]..high[1] {
                for i in low[0]..high[0] {
                    if shape.contains(&grid, [i, j, k]) {
                        visitor(self.node([i, j, k]));
                    }
                }
            }
        }
    }
}

/// A lattice with the neighbourhoods that the layers of a shape ask for.
pub(super) struct Grid {
    pub lattice: Lattice,
    stencils: Vec<Stencil>,
}

impl Grid {
    /// Whether `test` holds for a node within `reach` spacings of `index`.
    pub fn any_neighbour(&self, index: Index, reach: f64, test: impl Fn(Index) -> bool) -> bool {
        let stencil = self.stencils.iter().find(|stencil| stencil.reach == reach);
        stencil.is_some_and(|stencil| {
            // The rows of a hexagonal lattice alternate; those of the others are alike.
            let parity = index[1].rem_euclid(2) as usize;
            stencil.offsets[parity]
                .iter()
                .any(|offset| test(std::array::from_fn(|k| index[k] + offset[k])))
        })
    }
}

/// The offsets to all nodes within a distance, nearest first, for even and odd rows.
struct Stencil {
    /// The distance in spacings.
    reach: f64,
    offsets: [Vec<Index>; 2],
}

impl Stencil {
    fn new(lattice: &Lattice, reach: f64) -> Self {
        let unit = Lattice {
            origin: [0.0; 3],
            spacing: 1.0,
            ..*lattice
        };
        // The rows of every lattice are at least 0.9 spacings apart.
        let steps = (reach / 0.9).ceil() as i64;
        let deep = match lattice.dimension() {
            Dimension::Two => 0,
            Dimension::Three => steps,
        };
        let around = |row: i64| {
            let from = unit.node([0, row, 0]);
            let mut near = Vec::new();
            for k in -deep..=deep {
                for j in -steps..=steps {
                    for i in -steps..=steps {
                        let to = unit.node([i, row + j, k]);
                        let d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
                        let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                        if squared <= reach * reach {
                            near.push((squared, [i, j, k]));
                        }
                    }
                }
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            near.into_iter().map(|(_, offset)| offset).collect()
        };
        Self {
            reach,
            offsets: [around(0), around(1)],
        }
    }
}
