//! Which nodes of a lattice belong to a shape.
//!
//! That is decided with `+ - * /` and comparisons alone, so that a scene has the same particles on
//! every machine. Faces are half-open: a node on a lower face is inside, one on an upper face
//! outside, and so shapes that share a face share no particle. A tolerance of 10⁻⁹ spacings absorbs
//! the rounding of coordinates such as 49.5 * 0.02: a node counts as lying on a face when it is
//! that near.

use super::geometry::{AxisBox, Vector3};
use super::hierarchy;
use super::lattice::{Index, Lattice};
use super::shape::{Shape, TOLERANCE, layer_reach};
use super::words::{Dimension, LatticeKind};

/// Visits the nodes of a lattice that belong to a shape, x fastest, then y, then z.
pub(super) fn visit(lattice: &Lattice, shape: &Shape, mut visitor: impl FnMut(Vector3)) {
    let Some(bounds) = shape.bounds(lattice.spacing) else {
        return;
    };
    let (low, high) = lattice.extent(bounds);
    let shape = &hierarchy::of(shape, lattice.spacing);
    let mut reaches = shape.reaches();
    reaches.sort_unstable_by(f64::total_cmp);
    reaches.dedup();
    let cores = shape.cores().into_iter();
    let near = Neighbourhoods {
        lattice: *lattice,
        cores: cores
            .map(|core| (core, core.bounds(lattice.spacing)))
            .collect(),
        around: if lattice.kind == LatticeKind::Vogel {
            Around::Spiral(Spiral::new(lattice, high[0], &reaches))
        } else {
            let stencils = reaches
                .into_iter()
                .map(|reach| Stencil::new(lattice, reach));
            Around::Lattice(stencils.collect())
        },
    };
    for k in low[2]..high[2] {
        for j in low[1]..high[1] {
            for i in low[0]..high[0] {
                if contains(shape, &near, [i, j, k]) {
                    visitor(lattice.node([i, j, k]));
                }
            }
        }
    }
}

/// Whether the node `index` of the near's lattice belongs to the shape.
fn contains(shape: &Shape, near: &Neighbourhoods, index: Index) -> bool {
    let lattice = &near.lattice;
    let in_layer = |around: &Shape, depth: f64| {
        !contains(around, near, index)
            && near.any_neighbour(index, layer_reach(depth), around, |neighbour| {
                contains(around, near, neighbour)
            })
    };
    let axes = lattice.dimension().axes();
    holds(shape, lattice.node(index), axes, lattice.spacing, &in_layer)
}

/// Whether a point belongs to the shape, with the tolerance of this particle spacing; a layer
/// around a shape is asked about by its depth.
pub(super) fn holds(
    shape: &Shape,
    x: Vector3,
    axes: usize,
    spacing: f64,
    in_layer: &dyn Fn(&Shape, f64) -> bool,
) -> bool {
    let tolerance = TOLERANCE * spacing;
    let inner = |shape: &Shape| holds(shape, x, axes, spacing, in_layer);
    match shape {
        Shape::Block { min, max } => {
            (0..axes).all(|k| x[k] + tolerance >= min[k] && x[k] + tolerance < max[k])
        }
        Shape::Ball { centre, radius } => {
            let limit = radius - tolerance;
            limit > 0.0 && squared_distance(x, *centre, axes) < limit * limit
        }
        Shape::Ellipsoid { centre, axes: semi } => {
            let mut sum = 0.0;
            for k in 0..axes {
                let limit = semi[k] - tolerance;
                if limit <= 0.0 {
                    return false;
                }
                let ratio = (x[k] - centre[k]) / limit;
                sum += ratio * ratio;
            }
            sum < 1.0
        }
        Shape::Shell {
            centre,
            inner,
            outer,
        } => {
            let squared = squared_distance(x, *centre, axes);
            let (hole, limit) = (inner - tolerance, outer - tolerance);
            let outside_the_hole = hole <= 0.0 || squared >= hole * hole;
            outside_the_hole && limit > 0.0 && squared < limit * limit
        }
        Shape::Polygon { points } => inside_polygon(points, [x[0] + tolerance, x[1] + tolerance]),
        Shape::Union(shapes) => shapes.iter().any(inner),
        Shape::Difference(shapes) => match shapes.split_first() {
            Some((first, others)) => inner(first) && !others.iter().any(inner),
            None => false,
        },
        Shape::Intersection(shapes) => !shapes.is_empty() && shapes.iter().all(inner),
        Shape::Layer { around, depth } => in_layer(around, *depth),
    }
}

fn squared_distance(x: Vector3, centre: Vector3, axes: usize) -> f64 {
    let mut sum = 0.0;
    for k in 0..axes {
        let d = x[k] - centre[k];
        sum += d * d;
    }
    sum
}

/// The even-odd rule: counts the edges to the right of `p`.
///
/// Each edge is walked from its lower end to its upper one whichever way the polygon
/// runs, so that two polygons that share an edge compute the same crossing.
fn inside_polygon(points: &[[f64; 2]], p: [f64; 2]) -> bool {
    let mut inside = false;
    let ends = points.iter().zip(points.iter().cycle().skip(1));
    for (&a, &b) in ends {
        let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        if low[1] <= p[1] && p[1] < high[1] {
            let crossing = low[0] + (p[1] - low[1]) * (high[0] - low[0]) / (high[1] - low[1]);
            if p[0] < crossing {
                inside = !inside;
            }
        }
    }
    inside
}

/// A lattice with the neighbourhoods that the layers of a shape ask for.
struct Neighbourhoods<'a> {
    lattice: Lattice,
    /// What the layers are wrapped around, and its bounds.
    cores: Vec<(&'a Shape, Option<AxisBox>)>,
    around: Around,
}

/// How neighbours are found.
enum Around {
    /// By the offsets of their indices.
    Lattice(Vec<Stencil>),
    /// By their places.
    Spiral(Spiral),
}

impl Neighbourhoods<'_> {
    /// Whether `test` holds for a node of `core` within `reach` spacings of `index`.
    fn any_neighbour(
        &self,
        index: Index,
        reach: f64,
        core: &Shape,
        test: impl Fn(Index) -> bool,
    ) -> bool {
        let stencils = match &self.around {
            Around::Lattice(stencils) => stencils,
            Around::Spiral(spiral) => {
                return spiral.any_neighbour(&self.lattice, index, reach, test);
            }
        };
        let stencil = stencils.iter().find(|stencil| stencil.reach == reach);
        stencil.is_some_and(|stencil| {
            let least = self.spacings_to(core, index);
            stencil
                .farther_than(least, self.lattice.parity(index))
                .iter()
                .any(|(_, offset)| test(std::array::from_fn(|k| index[k] + offset[k])))
        })
    }

    /// The distance of a node from the bounds of a core, in spacings: no node of it is nearer.
    fn spacings_to(&self, core: &Shape, index: Index) -> f64 {
        let mut known = self.cores.iter();
        let Some((_, bounds)) = known.find(|(other, _)| std::ptr::eq(*other, core)) else {
            return 0.0;
        };
        let Some((low, high)) = bounds else {
            return f64::INFINITY;
        };
        let x = self.lattice.node(index);
        let axes = 0..self.lattice.dimension().axes();
        let beyond = axes.map(|k| (low[k] - x[k]).max(x[k] - high[k]).max(0.0));
        let squared: f64 = beyond.map(|d| d * d).sum();
        // Less by far more than rounding and the tolerance of the faces.
        (squared.sqrt() / self.lattice.spacing - 1e-6).max(0.0)
    }
}

/// The offsets to all nodes within a distance, nearest first, for even and odd rows.
struct Stencil {
    /// The distance in spacings.
    reach: f64,
    /// Squared distances and offsets.
    offsets: [Vec<(f64, Index)>; 2],
}

impl Stencil {
    fn new(lattice: &Lattice, reach: f64) -> Self {
        let unit = Lattice {
            origin: [0.0; 3],
            spacing: 1.0,
            ..*lattice
        };
        // The rows of every lattice are at least 0.9 spacings apart, but for the layers of a
        // body-centred one.
        let apart = match lattice.kind {
            LatticeKind::BodyCentred => 0.6,
            _ => 0.9,
        };
        let steps = (reach / apart).ceil() as i64;
        let deep = match lattice.dimension() {
            Dimension::Two => 0,
            Dimension::Three => steps,
        };
        let around = |row: i64| {
            let from = unit.node([0, row, row]);
            let mut near = Vec::new();
            for k in -deep..=deep {
                for j in -steps..=steps {
                    for i in -steps..=steps {
                        let to = unit.node([i, row + j, row + k]);
                        let d = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
                        let squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                        if squared <= reach * reach {
                            near.push((squared, [i, j, k]));
                        }
                    }
                }
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            near
        };
        Self {
            reach,
            offsets: [around(0), around(1)],
        }
    }

    /// Those that are at least so long, in spacings, for rows of this parity.
    fn farther_than(&self, least: f64, parity: usize) -> &[(f64, Index)] {
        let all = &self.offsets[parity];
        &all[all.partition_point(|(squared, _)| *squared < least * least)..]
    }
}

/// The nodes of a spiral, sorted into squares.
struct Spiral {
    /// Edge of the squares, m.
    edge: f64,
    /// Squares and the nodes in them.
    nodes: Vec<([i64; 2], i64)>,
}

impl Spiral {
    /// The first `count` nodes; none where no layer looks for neighbours.
    fn new(lattice: &Lattice, count: i64, reaches: &[f64]) -> Self {
        let edge = lattice.spacing * reaches.iter().fold(1.0, |a: f64, b| a.max(*b));
        let count = if reaches.is_empty() { 0 } else { count };
        let mut spiral = Self {
            edge,
            nodes: Vec::new(),
        };
        let squares = (0..count).map(|n| (spiral.square(&lattice.spiral(n)), n));
        spiral.nodes = squares.collect();
        spiral.nodes.sort_unstable();
        spiral
    }

    fn square(&self, x: &Vector3) -> [i64; 2] {
        std::array::from_fn(|k| (x[k] / self.edge).floor() as i64)
    }

    fn any_neighbour(
        &self,
        lattice: &Lattice,
        index: Index,
        reach: f64,
        test: impl Fn(Index) -> bool,
    ) -> bool {
        let x = lattice.spiral(index[0]);
        let home = self.square(&x);
        let limit = reach * lattice.spacing;
        let is_near = |n: i64| {
            let y = lattice.spiral(n);
            let d = [y[0] - x[0], y[1] - x[1]];
            d[0] * d[0] + d[1] * d[1] <= limit * limit
        };
        (0..9).any(|k| {
            let square = [home[0] + k % 3 - 1, home[1] + k / 3 - 1];
            let start = self.nodes.partition_point(|(s, _)| *s < square);
            self.nodes[start..]
                .iter()
                .take_while(|(s, _)| *s == square)
                .any(|&(_, n)| is_near(n) && test([n, 0, 0]))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without this a layer 8.39 spacings deep around a box in space took 13 s.
    #[test]
    fn deep_layers_look_for_their_core_where_it_can_be() {
        let lattice = Lattice {
            kind: LatticeKind::Cubic,
            origin: [0.0; 3],
            spacing: 0.1,
        };
        let core = Shape::Block {
            min: [0.0; 3],
            max: [2.0; 3],
        };
        let reach = layer_reach(8.39);
        let near = Neighbourhoods {
            lattice,
            cores: vec![(&core, core.bounds(0.1))],
            around: Around::Lattice(vec![Stencil::new(&lattice, reach)]),
        };
        let looks = std::cell::Cell::new(0);
        for (i, is_near) in [(-1, true), (-8, true), (-9, false)] {
            looks.set(0);
            let found = near.any_neighbour([i, 5, 5], reach, &core, |index| {
                looks.set(looks.get() + 1);
                contains(&core, &near, index)
            });
            assert_eq!(found, is_near, "{i}");
            assert!(looks.get() < 400, "{i}: {}", looks.get());
        }
    }
}
