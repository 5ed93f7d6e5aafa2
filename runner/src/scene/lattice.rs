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

/// The indices of a box of nodes: lower ones included, upper ones excluded.
pub(super) type Extent = (Index, Index);

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

    /// The indices of all nodes in a box, and a few around it.
    fn extent(&self, bounds: Bounds) -> Extent {
        let pitch = self.pitch();
        let axes = self.dimension().axes();
        let index = |k: usize, x: f64| (x - self.origin[k]) / pitch[k];
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
        let (low, high) = self.extent(bounds);
        for k in low[2]..high[2] {
            for j in low[1]..high[1] {
                for i in low[0]..high[0] {
                    if shape.contains(self, [i, j, k]) {
                        visitor(self.node([i, j, k]));
                    }
                }
            }
        }
    }

    /// Whether `test` holds for a node within `reach` spacings of `index`.
    pub fn any_neighbour(
        &self,
        index: Index,
        reach: f64,
        mut test: impl FnMut(Index) -> bool,
    ) -> bool {
        // The rows of every lattice are at least 0.9 spacings apart.
        let steps = (reach / 0.9).ceil() as i64;
        let deep = match self.dimension() {
            Dimension::Two => 0,
            Dimension::Three => steps,
        };
        let unit = Self {
            origin: [0.0; 3],
            spacing: 1.0,
            ..*self
        };
        // Offsets repeat from row to row but for the parity of the row.
        let here = [0, index[1].rem_euclid(2), 0];
        let from = unit.node(here);
        for k in -deep..=deep {
            for j in -steps..=steps {
                for i in -steps..=steps {
                    let to = unit.node([i, here[1] + j, k]);
                    let d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
                    let near = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= reach * reach;
                    if near && test([index[0] + i, index[1] + j, index[2] + k]) {
                        return true;
                    }
                }
            }
        }
        false
    }
}
