//! Regular lattices, by integer index.
//!
//! A node's coordinate is origin + (i + 1/2) * pitch, computed from its integer index and
//! not from its neighbour's coordinate: nothing accumulates, and a region and the wall
//! around it agree on every bit. Only `+` and `*` are used, and for the spiral the square root,
//! sine and cosine of `libm`.
//!
//! Vogel's spiral: node n at r = s ((n + 1/2)/π)^(1/2) and the n-th multiple of the golden angle
//! 2π (1 - 1/φ), so that n nodes fill the area n s². (H. Vogel, Math. Biosci. 44 (1979) 179.)

use super::geometry::{AxisBox, Vector3};
use super::words::{Dimension, LatticeKind};
use std::f64::consts::PI;

/// Position of a node along x, y and z.
pub(super) type Index = [i64; 3];

/// Pitch of a hexagonal lattice along a row, in spacings: sqrt(2 / sqrt(3)), which gives
/// every particle the area of one spacing squared.
const HEXAGONAL_PITCH: f64 = 1.074_569_931_823_542;

/// Distance of the rows of a hexagonal lattice, in spacings: sqrt(sqrt(3) / 2).
const HEXAGONAL_ROW: f64 = 0.930_604_859_102_099_6;

/// Edge of the cubes of a body-centred lattice, in spacings: the cube root of 2, since there are
/// two particles in each.
const BODY_CENTRED_EDGE: f64 = 1.259_921_049_894_873_2;

/// The golden angle as a part of a turn: 1 - 1/φ = (3 - sqrt(5))/2.
const GOLDEN_TURN: f64 = 0.381_966_011_250_105_15;

/// A regular lattice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    pub kind: LatticeKind,
    /// The corner half a pitch below node 0 along every axis, m; of a spiral the middle.
    pub origin: Vector3,
    /// Particle spacing, m.
    pub spacing: f64,
}

impl Lattice {
    pub fn dimension(&self) -> Dimension {
        match self.kind {
            LatticeKind::Square | LatticeKind::Hexagonal | LatticeKind::Vogel => Dimension::Two,
            LatticeKind::Cubic | LatticeKind::BodyCentred => Dimension::Three,
        }
    }

    /// Distance of neighbouring nodes along each axis, m.
    fn pitch(&self) -> Vector3 {
        let s = self.spacing;
        match self.kind {
            LatticeKind::Square | LatticeKind::Cubic | LatticeKind::Vogel => [s, s, s],
            LatticeKind::BodyCentred => {
                let edge = BODY_CENTRED_EDGE * s;
                [edge, edge, 0.5 * edge]
            }
            LatticeKind::Hexagonal => [HEXAGONAL_PITCH * s, HEXAGONAL_ROW * s, s],
        }
    }

    /// The point of a node, m.
    pub fn node(&self, index: Index) -> Vector3 {
        if self.kind == LatticeKind::Vogel {
            return self.spiral(index[0]);
        }
        let pitch = self.pitch();
        let odd = self.parity(index) == 1;
        // The shift along x and along y.
        let shift = match self.kind {
            LatticeKind::Hexagonal if odd => [0.5, 0.0],
            // A quarter from the faces on both sides.
            LatticeKind::BodyCentred if odd => [0.25, 0.25],
            LatticeKind::BodyCentred => [-0.25, -0.25],
            _ => [0.0, 0.0],
        };
        // Indices stay far below 2^52: the sums in brackets are exact.
        let x = self.origin[0] + (index[0] as f64 + 0.5 + shift[0]) * pitch[0];
        let y = self.origin[1] + (index[1] as f64 + 0.5 + shift[1]) * pitch[1];
        let z = match self.dimension() {
            Dimension::Two => 0.0,
            Dimension::Three => self.origin[2] + (index[2] as f64 + 0.5) * pitch[2],
        };
        [x, y, z]
    }

    /// Node n of the spiral.
    pub fn spiral(&self, n: i64) -> Vector3 {
        let r = self.spacing * libm::sqrt((n as f64 + 0.5) / PI);
        // Whole turns are taken off while they can be told apart.
        let turns = n as f64 * GOLDEN_TURN;
        let angle = 2.0 * PI * (turns - libm::floor(turns));
        let x = self.origin[0] + r * libm::cos(angle);
        let y = self.origin[1] + r * libm::sin(angle);
        [x, y, 0.0]
    }

    /// The number of nodes of a spiral that reaches every corner of a box.
    fn spiral_nodes(&self, bounds: AxisBox) -> f64 {
        let mut r2 = 0.0;
        for k in 0..2 {
            let far = (bounds.0[k] - self.origin[k])
                .abs()
                .max((bounds.1[k] - self.origin[k]).abs());
            r2 += far * far;
        }
        PI * r2 / (self.spacing * self.spacing) + 1.0
    }

    /// The rows of a hexagonal lattice alternate, as do the layers of a body-centred one; those of
    /// the others are alike.
    pub fn parity(&self, index: Index) -> usize {
        let row = match self.kind {
            LatticeKind::Hexagonal => index[1],
            LatticeKind::BodyCentred => index[2],
            _ => 0,
        };
        row.rem_euclid(2) as usize
    }

    /// The number of nodes in a box, for a decision whether to visit them.
    pub fn nodes_within(&self, bounds: AxisBox) -> f64 {
        if self.kind == LatticeKind::Vogel {
            return self.spiral_nodes(bounds);
        }
        let pitch = self.pitch();
        (0..self.dimension().axes())
            .map(|k| (bounds.1[k] - bounds.0[k]) / pitch[k] + 3.0)
            .product()
    }

    /// The lowest and one above the highest index of all nodes in a box and a few around it.
    pub fn extent(&self, bounds: AxisBox) -> (Index, Index) {
        if self.kind == LatticeKind::Vogel {
            // The conversion saturates.
            return (
                [0; 3],
                [(self.spiral_nodes(bounds) as i64).saturating_add(1), 1, 1],
            );
        }
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
}
