//! Shapes: what they are made of, and boxes that hold them. Which lattice nodes belong to one is
//! decided in [`filling`](super::filling).

use super::geometry::{AxisBox, Vector3, around_both, grown, overlap};
use super::words::Dimension;

/// Tolerance of the faces, in spacings.
pub(super) const TOLERANCE: f64 = 1e-9;

/// A shape; lengths in m, and only the first two coordinates count in two dimensions.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Rectangle or box along the axes.
    Block {
        /// Lower corner, included.
        min: Vector3,
        /// Upper corner, excluded.
        max: Vector3,
    },
    /// Circle or sphere.
    Ball {
        /// Centre.
        centre: Vector3,
        /// Radius.
        radius: f64,
    },
    /// Ellipse or ellipsoid along the axes.
    Ellipsoid {
        /// Centre.
        centre: Vector3,
        /// Semi-axes.
        axes: Vector3,
    },
    /// Annulus, or a ball with a round hole.
    Shell {
        /// Centre.
        centre: Vector3,
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

impl Shape {
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

    /// What the layers of the shape are wrapped around.
    pub(super) fn cores(&self) -> Vec<&Self> {
        match self {
            Self::Union(shapes) | Self::Difference(shapes) | Self::Intersection(shapes) => {
                shapes.iter().flat_map(Self::cores).collect()
            }
            Self::Layer { around, .. } => {
                let mut cores = around.cores();
                cores.push(around);
                cores
            }
            _ => Vec::new(),
        }
    }

    /// The depth, in spacings, of the layer with the least, where the shape has one.
    pub(super) fn thinnest_layer(&self) -> Option<f64> {
        match self {
            Self::Union(shapes) | Self::Difference(shapes) | Self::Intersection(shapes) => {
                let depths = shapes.iter().filter_map(Self::thinnest_layer);
                depths.reduce(f64::min)
            }
            Self::Layer { around, depth } => {
                Some(around.thinnest_layer().map_or(*depth, |d| d.min(*depth)))
            }
            _ => None,
        }
    }

    /// A box that holds every node of the shape; `None` when the shape is empty.
    pub(super) fn bounds(&self, spacing: f64) -> Option<AxisBox> {
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
    pub(super) fn corner(&self) -> Option<Vector3> {
        Some(self.outline()?.0)
    }

    /// The middle around which a spiral turns: that of the same bounds.
    pub(super) fn middle(&self) -> Option<Vector3> {
        let (low, high) = self.outline()?;
        Some(std::array::from_fn(|k| 0.5 * (low[k] + high[k])))
    }

    /// AxisBox in which a layer counts as the shape it wraps. The bounds of an intersection may be
    /// empty.
    fn outline(&self) -> Option<AxisBox> {
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

    /// The key under which a scene of `dimension` writes the shape.
    pub(super) fn word(&self, dimension: Dimension) -> &'static str {
        let plane = dimension == Dimension::Two;
        match self {
            Self::Block { .. } if plane => "rectangle",
            Self::Block { .. } => "box",
            Self::Ball { .. } if plane => "circle",
            Self::Ball { .. } => "sphere",
            Self::Ellipsoid { .. } if plane => "ellipse",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Shell { .. } if plane => "annulus",
            Self::Shell { .. } => "shell",
            Self::Polygon { .. } => "polygon",
            Self::Union(_) => "union",
            Self::Difference(_) => "difference",
            Self::Intersection(_) => "intersection",
            Self::Layer { .. } => "layer",
        }
    }
}

/// Distance of the farthest node of a layer from the nearest node inside, in spacings.
pub(super) fn layer_reach(depth: f64) -> f64 {
    depth + 0.5 + TOLERANCE
}
