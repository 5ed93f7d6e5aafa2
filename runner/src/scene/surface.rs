//! Where the surface of a flow is: the nearest point of its boundary to each particle of a wall.
//!
//! Rays leave the wall particle in many directions and stop where they enter a region of fluid; the
//! shortest one is then turned, by smaller and smaller angles, until no turn shortens it. That finds
//! the foot on a plane, on a cylinder and at a corner alike, for every shape that can say whether a
//! point is inside.

use super::filling::holds;
use super::geometry::Vector3;
use super::initial::InitialState;
use super::region::Region;
use super::shape::Shape;
use super::types::Scene;
use super::words::RegionKind;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Steps of a ray for each spacing, before it is halved.
const STEPS: f64 = 4.0;

/// Halvings of a step.
const HALVINGS: usize = 40;

/// First directions in the plane, and in space.
const DIRECTIONS: [usize; 2] = [48, 120];

/// The flow, and how far one looks for it.
struct Flow<'a> {
    shapes: Vec<&'a Shape>,
    axes: usize,
    spacing: f64,
    /// Longest ray, m.
    reach: f64,
}

impl Scene {
    /// The ways from wall particles to the nearest point of the surface of the fluid, or of what a
    /// layer is wrapped around, m; none for particles that flow, and for those of walls that have
    /// neither in reach.
    pub(super) fn wall_offsets(&self, state: &InitialState) -> Vec<Vector3> {
        let fluid = |region: &&Region| region.kind == RegionKind::Fluid;
        let fluids = self.regions.iter().filter(fluid);
        let walls = self.regions.iter().filter(|region| !fluid(region));
        // Fluid may come to where there is none at first: a layer says where its walls end.
        let layers = walls.flat_map(|region| wrapped(&region.shape));
        let flow = Flow {
            shapes: fluids.map(|region| &region.shape).chain(layers).collect(),
            axes: self.dimension.axes(),
            spacing: self.particle_spacing,
            reach: (self.support + 1.0) * self.particle_spacing,
        };
        let held = |id: u64| {
            let part = state.parts.iter().rev().find(|part| part.first <= id);
            part.is_some_and(|part| part.held)
        };
        state
            .fluid
            .par_iter()
            .enumerate()
            .map(|(id, x)| {
                if held(id as u64) {
                    flow.way(*x)
                } else {
                    [0.0; 3]
                }
            })
            .collect()
    }
}

/// The shapes that the layers of a shape are wrapped around.
fn wrapped(shape: &Shape) -> Vec<&Shape> {
    match shape {
        Shape::Layer { around, .. } => vec![around],
        Shape::Union(shapes) | Shape::Difference(shapes) | Shape::Intersection(shapes) => {
            shapes.iter().flat_map(wrapped).collect()
        }
        _ => Vec::new(),
    }
}

impl Flow<'_> {
    fn holds(&self, x: Vector3) -> bool {
        // A layer of fluid has no surface of its own: it is made of nodes.
        let in_layer = |_: &Shape, _: f64| false;
        let holds = |shape: &&Shape| holds(shape, x, self.axes, self.spacing, &in_layer);
        self.shapes.iter().any(holds)
    }

    /// How far the fluid is from x in this direction, where that is less than `most`.
    fn distance(&self, x: Vector3, direction: Vector3, most: f64) -> Option<f64> {
        let at = |s: f64| std::array::from_fn(|k| x[k] + s * direction[k]);
        let step = self.spacing / STEPS;
        let mut outside = 0.0;
        while outside < most {
            let mut inside = outside + step;
            if self.holds(at(inside)) {
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (outside + inside);
                    if self.holds(at(middle)) {
                        inside = middle;
                    } else {
                        outside = middle;
                    }
                }
                return Some(inside).filter(|s| *s < most);
            }
            outside = inside;
        }
        None
    }

    /// The way to the nearest point of the fluid.
    fn way(&self, x: Vector3) -> Vector3 {
        let (mut best, mut least) = ([0.0; 3], self.reach);
        let mut found = false;
        for direction in self.directions() {
            if let Some(distance) = self.distance(x, direction, least) {
                (best, least, found) = (direction, distance, true);
            }
        }
        if !found {
            return [0.0; 3];
        }
        let mut angle = 2.0 * PI / DIRECTIONS[0] as f64;
        while angle > 1e-8 {
            let turned = self.turned(best, angle);
            let shorter = turned
                .into_iter()
                .find_map(|d| self.distance(x, d, least).map(|distance| (d, distance)));
            match shorter {
                Some((direction, distance)) => (best, least) = (direction, distance),
                None => angle *= 0.5,
            }
        }
        best.map(|x| x * least)
    }

    /// Directions all round, evenly.
    fn directions(&self) -> Vec<Vector3> {
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        if self.axes == 2 {
            let n = DIRECTIONS[0];
            let angles = (0..n).map(|k| 2.0 * PI * k as f64 / n as f64);
            return angles
                .map(|angle| [libm::cos(angle), libm::sin(angle), 0.0])
                .collect();
        }
        let n = DIRECTIONS[1];
        let points = (0..n).map(|k| {
            let z = 1.0 - (2.0 * k as f64 + 1.0) / n as f64;
            let r = (1.0 - z * z).sqrt();
            let angle = golden * k as f64;
            [r * libm::cos(angle), r * libm::sin(angle), z]
        });
        points.collect()
    }

    /// This direction, turned by an angle to every side.
    fn turned(&self, direction: Vector3, angle: f64) -> Vec<Vector3> {
        let [x, y, z] = direction;
        let sides: Vec<Vector3> = if self.axes == 2 {
            vec![[-y, x, 0.0]]
        } else {
            // Two that are normal to it and to each other.
            let other = if z.abs() < 0.7 {
                [0.0, 0.0, 1.0]
            } else {
                [1.0, 0.0, 0.0]
            };
            let first = unit(cross(direction, other));
            vec![first, cross(direction, first)]
        };
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        let turn = |side: &Vector3, s: f64| -> Vector3 {
            std::array::from_fn(|k| c * direction[k] + s * side[k])
        };
        sides
            .iter()
            .flat_map(|side| [turn(side, s), turn(side, -s)])
            .collect()
    }
}

fn cross(a: Vector3, b: Vector3) -> Vector3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(a: Vector3) -> Vector3 {
    let length = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way(shape: &Shape, axes: usize, x: Vector3) -> Vector3 {
        let flow = Flow {
            shapes: vec![shape],
            axes,
            spacing: 0.1,
            reach: 0.4,
        };
        flow.way(x)
    }

    #[track_caller]
    fn assert_near(found: Vector3, expected: Vector3) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-7, "{found:?} is not {expected:?}");
        }
    }

    #[test]
    fn the_surface_is_found_beside_a_face_at_a_corner_and_on_both_sides_of_a_ring() {
        let square = Shape::Block {
            min: [0.0; 3],
            max: [1.0; 3],
        };
        assert_near(way(&square, 2, [0.37, -0.15, 0.0]), [0.0, 0.15, 0.0]);
        assert_near(way(&square, 2, [1.05, 1.15, 0.0]), [-0.05, -0.15, 0.0]);
        assert_near(way(&square, 3, [1.05, 0.31, 0.72]), [-0.05, 0.0, 0.0]);
        assert_near(way(&square, 3, [1.05, 1.15, 0.4]), [-0.05, -0.15, 0.0]);
        let ring = Shape::Shell {
            centre: [0.0; 3],
            inner: 1.0,
            outer: 2.0,
        };
        let out = [0.6, 0.8, 0.0];
        assert_near(way(&ring, 2, out.map(|x| 0.85 * x)), out.map(|x| 0.15 * x));
        assert_near(way(&ring, 2, out.map(|x| 2.25 * x)), out.map(|x| -0.25 * x));
    }

    #[test]
    fn there_is_no_way_to_a_flow_out_of_reach() {
        let square = Shape::Block {
            min: [0.0; 3],
            max: [1.0; 3],
        };
        assert_eq!(way(&square, 2, [0.5, -0.6, 0.0]), [0.0; 3]);
    }
}
