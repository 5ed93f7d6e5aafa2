//! Shapes, as sets of lattice nodes.
//!
//! Whether a node belongs to a shape is decided with `+ - * /` and comparisons alone, so
//! that a scene has the same particles on every machine. Faces are half-open: a node on a
//! lower face is inside, one on an upper face outside, and so shapes that share a face
//! share no particle. A tolerance of 10⁻⁹ spacings absorbs the rounding of coordinates
//! such as 49.5 * 0.02: a node counts as lying on a face when it is that near.

use super::lattice::{Grid, Index};

/// A point or vector; z is 0 in two dimensions.
pub type Point = [f64; 3];

/// Tolerance of the faces, in spacings.
const TOLERANCE: f64 = 1e-9;

/// A shape; lengths in m, and only the first two coordinates count in two dimensions.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Rectangle or box along the axes.
    Block {
        /// Lower corner, included.
        min: Point,
        /// Upper corner, excluded.
        max: Point,
    },
    /// Circle or sphere.
    Ball {
        /// Centre.
        centre: Point,
        /// Radius.
        radius: f64,
    },
    /// Ellipse or ellipsoid along the axes.
    Ellipsoid {
        /// Centre.
        centre: Point,
        /// Semi-axes.
        axes: Point,
    },
    /// Annulus, or a ball with a round hole.
    Shell {
        /// Centre.
        centre: Point,
        /// Radius of the hole.
        inner: f64,
        /// Outer radius.
        outer: f64,
    },
    /// Polygon of the plane by the even-odd rule.
    Polygon {
        /// Corners in order, at least three.
        points: Vec<[f64; 2]>,
    },
    /// In any of the shapes.
    Union(Vec<Shape>),
    /// In the first shape and in none of the others.
    Difference(Vec<Shape>),
    /// In every one of the shapes.
    Intersection(Vec<Shape>),
    /// The nodes outside `around` that lie within `depth` spacings and a half of a node
    /// inside it: outside a face, the rows at 0.5, 1.5, … up to `depth` spacings.
    Layer {
        /// The shape that is wrapped.
        around: Box<Shape>,
        /// Depth in particle spacings.
        depth: f64,
    },
}

/// Lower and upper corner of a box that holds a shape.
pub(super) type Bounds = (Point, Point);

impl Shape {
    /// Whether the node `index` of the grid's lattice belongs to the shape.
    pub(super) fn contains(&self, grid: &Grid, index: Index) -> bool {
        let lattice = &grid.lattice;
        let tolerance = TOLERANCE * lattice.spacing;
        let x = lattice.node(index);
        let axes = lattice.dimension().axes();
        match self {
            Self::Block { min, max } => {
                (0..axes).all(|k| x[k] + tolerance >= min[k] && x[k] + tolerance < max[k])
            }
            Self::Ball { centre, radius } => {
                let limit = radius - tolerance;
                limit > 0.0 && squared_distance(x, *centre, axes) < limit * limit
            }
            Self::Ellipsoid { centre, axes: semi } => {
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
            Self::Shell {
                centre,
                inner,
                outer,
            } => {
                let squared = squared_distance(x, *centre, axes);
                let (hole, limit) = (inner - tolerance, outer - tolerance);
                let outside_the_hole = hole <= 0.0 || squared >= hole * hole;
                outside_the_hole && limit > 0.0 && squared < limit * limit
            }
            Self::Polygon { points } => {
                inside_polygon(points, [x[0] + tolerance, x[1] + tolerance])
            }
            Self::Union(shapes) => shapes.iter().any(|shape| shape.contains(grid, index)),
            Self::Difference(shapes) => match shapes.split_first() {
                Some((first, others)) => {
                    first.contains(grid, index)
                        && !others.iter().any(|shape| shape.contains(grid, index))
                }
                None => false,
            },
            Self::Intersection(shapes) => {
                !shapes.is_empty() && shapes.iter().all(|shape| shape.contains(grid, index))
            }
            Self::Layer { around, depth } => {
                !around.contains(grid, index)
                    && grid.any_neighbour(index, layer_reach(*depth), |neighbour| {
                        around.contains(grid, neighbour)
                    })
            }
        }
    }

    /// The distances, in spacings, at which the layers of the shape look for inner nodes.
    pub(super) fn reaches(&self) -> Vec<f64> {
        match self {
            Self::Union(shapes) | Self::Difference(shapes) | Self::Intersection(shapes) => {
                shapes.iter().flat_map(Self::reaches).collect()
            }
            Self::Layer { around, depth } => {
                let mut reaches = around.reaches();
                reaches.push(layer_reach(*depth));
                reaches
            }
            _ => Vec::new(),
        }
    }

    /// A box that holds every node of the shape; `None` when the shape is empty.
    pub(super) fn bounds(&self, spacing: f64) -> Option<Bounds> {
        match self {
            Self::Block { min, max } => Some((*min, *max)),
            Self::Ball { centre, radius } => Some(grown((*centre, *centre), [*radius; 3])),
            Self::Ellipsoid { centre, axes } => Some(grown((*centre, *centre), *axes)),
            Self::Shell { centre, outer, .. } => Some(grown((*centre, *centre), [*outer; 3])),
            Self::Polygon { points } => points
                .iter()
                .map(|&[x, y]| ([x, y, 0.0], [x, y, 0.0]))
                .reduce(around_both),
            Self::Union(shapes) => shapes
                .iter()
                .filter_map(|shape| shape.bounds(spacing))
                .reduce(around_both),
            Self::Difference(shapes) => shapes.first()?.bounds(spacing),
            Self::Intersection(shapes) => {
                let mut bounds = shapes.iter().map(|shape| shape.bounds(spacing));
                let first = bounds.next()??;
                bounds.try_fold(first, |a, b| overlap(a, b?))
            }
            Self::Layer { around, depth } => {
                // One spacing more than the reach, for the rounding of its square.
                let margin = (layer_reach(*depth) + 1.0) * spacing;
                Some(grown(around.bounds(spacing)?, [margin; 3]))
            }
        }
    }

    /// The corner from which a lattice starts: the lower corner of the bounds, where a
    /// layer counts as the shape it wraps, because it continues that shape's lattice.
    pub(super) fn corner(&self) -> Option<Point> {
        Some(self.outline()?.0)
    }

    /// The middle around which a spiral turns: that of the same bounds.
    pub(super) fn middle(&self) -> Option<Point> {
        let (low, high) = self.outline()?;
        Some(std::array::from_fn(|k| 0.5 * (low[k] + high[k])))
    }

    /// Bounds in which a layer counts as the shape it wraps. (Those of an intersection may be empty.)
    fn outline(&self) -> Option<Bounds> {
        match self {
            Self::Layer { around, .. } => around.outline(),
            Self::Union(shapes) => shapes.iter().filter_map(Self::outline).reduce(around_both),
            Self::Intersection(shapes) => shapes.iter().filter_map(Self::outline).reduce(|a, b| {
                (
                    std::array::from_fn(|k| a.0[k].max(b.0[k])),
                    std::array::from_fn(|k| a.1[k].min(b.1[k])),
                )
            }),
            Self::Difference(shapes) => shapes.first()?.outline(),
            // No layer inside: the spacing does not matter.
            _ => self.bounds(0.0),
        }
    }

    /// Whether the number of nodes grows with the surface, not with the volume.
    pub(super) fn is_thin(&self) -> bool {
        match self {
            Self::Layer { .. } => true,
            Self::Union(shapes) => shapes.iter().all(Self::is_thin),
            Self::Difference(shapes) => shapes.first().is_some_and(Self::is_thin),
            Self::Intersection(shapes) => shapes.iter().any(Self::is_thin),
            _ => false,
        }
    }
}

/// Distance of the farthest node of a layer from the nearest node inside, in spacings.
fn layer_reach(depth: f64) -> f64 {
    depth + 0.5 + TOLERANCE
}

fn squared_distance(x: Point, centre: Point, axes: usize) -> f64 {
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

fn grown((min, max): Bounds, by: Point) -> Bounds {
    (
        std::array::from_fn(|k| min[k] - by[k]),
        std::array::from_fn(|k| max[k] + by[k]),
    )
}

fn around_both(a: Bounds, b: Bounds) -> Bounds {
    (
        std::array::from_fn(|k| a.0[k].min(b.0[k])),
        std::array::from_fn(|k| a.1[k].max(b.1[k])),
    )
}

/// The common part of two boxes, faces included.
pub(super) fn overlap(a: Bounds, b: Bounds) -> Option<Bounds> {
    let both: Bounds = (
        std::array::from_fn(|k| a.0[k].max(b.0[k])),
        std::array::from_fn(|k| a.1[k].min(b.1[k])),
    );
    (0..3).all(|k| both.0[k] <= both.1[k]).then_some(both)
}
