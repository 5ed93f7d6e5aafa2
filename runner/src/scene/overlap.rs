//! Regions that fill one place twice.

use super::error::SceneError;
use super::filling::holds;
use super::geometry::{AxisBox, Vector3, around_both, grown, overlap};
use super::initial::InitialState;
use super::types::Scene;
use super::words::{Overlap, RegionKind};

/// Particles of two regions nearer than this, in spacings, belong to regions that overlap. Lattice
/// nodes lie half a spacing inside the lower faces of their region, so that regions which touch keep
/// their particles a spacing apart where the sizes are whole numbers of spacings.
const TOO_NEAR: f64 = 0.8;

/// The particles of a region.
struct Group<'a> {
    number: usize,
    points: &'a [Vector3],
}

impl Scene {
    /// Compares the particles of every two regions where their bounds overlap.
    pub(super) fn refuse_overlap(
        &self,
        state: &InitialState,
        placed: &[(usize, RegionKind, usize)],
    ) -> Result<(), SceneError> {
        let groups = self.groups(state, placed);
        let (bodies, _) = self.bodies();
        for [first, second] in self.near_each_other(&groups) {
            let (first, second) = (&groups[first], &groups[second]);
            if self.solid.is_some() && bodies[first.number] != bodies[second.number] {
                self.refuse_near_bodies(first, second)?;
            }
            if self.overlap == Overlap::Refuse {
                self.refuse_near(first, second)?;
            }
        }
        Ok(())
    }

    /// The pairs of groups whose boxes are within a support radius of each other, in their order.
    ///
    /// Boxes are sorted by their left sides, and each is compared with those that begin before it
    /// ends: of many regions that lie beside each other only neighbours are compared.
    fn near_each_other(&self, groups: &[Group<'_>]) -> Vec<[usize; 2]> {
        let box_of = |(n, group): (usize, &Group<'_>)| {
            let shape = self.regions[group.number]
                .shape
                .bounds(self.particle_spacing);
            let both = [shape, bounds(group.points)].into_iter().flatten();
            let around = both.reduce(around_both)?;
            Some((grown(around, [0.5 * self.support_radius(); 3]), n))
        };
        let mut boxes: Vec<(AxisBox, usize)> =
            groups.iter().enumerate().filter_map(box_of).collect();
        boxes.sort_by(|a, b| a.0.0[0].total_cmp(&b.0.0[0]));
        let mut pairs = Vec::new();
        for (position, (first, n)) in boxes.iter().enumerate() {
            let others = boxes[position + 1..].iter();
            for (second, m) in others.take_while(|(second, _)| second.0[0] <= first.1[0]) {
                if overlap(*first, *second).is_some() {
                    pairs.push([*n.min(m), *n.max(m)]);
                }
            }
        }
        pairs.sort_unstable();
        pairs
    }

    /// The particles by regions.
    fn groups<'a>(
        &self,
        state: &'a InitialState,
        placed: &[(usize, RegionKind, usize)],
    ) -> Vec<Group<'a>> {
        let group = |(position, &(number, kind, start)): (usize, &(usize, RegionKind, usize))| {
            let all = if self.is_movable(kind) {
                &state.fluid
            } else {
                &state.wall
            };
            let end = placed[position + 1..]
                .iter()
                .find(|next| self.is_movable(next.1) == self.is_movable(kind))
                .map_or(all.len(), |next| next.2);
            Group {
                number,
                points: &all[start..end],
            }
        };
        placed.iter().enumerate().map(group).collect()
    }

    /// Bodies within each other's reach would begin with a pressure between them that their
    /// constants hide.
    fn refuse_near_bodies(&self, first: &Group<'_>, second: &Group<'_>) -> Result<(), SceneError> {
        let axes = self.dimension.axes();
        let reach = self.support_radius();
        let Some(pair) = too_near(first.points, second.points, reach, axes) else {
            return Ok(());
        };
        Err(SceneError::BodiesTooNear {
            scene: self.name.clone(),
            regions: self.in_words([first.number, second.number]),
            point: pair.point[..axes].to_vec(),
            reach,
        })
    }

    /// Whether particles of one region lie in the other one's shape, or too near to its particles.
    fn refuse_near(&self, first: &Group<'_>, second: &Group<'_>) -> Result<(), SceneError> {
        let axes = self.dimension.axes();
        let near = TOO_NEAR * self.particle_spacing;
        let found = if let Some(pair) = too_near(first.points, second.points, near, axes) {
            (pair.point, Some(pair.distance / self.particle_spacing))
        } else if let Some(point) = self.first_inside(first, second) {
            (point, None)
        } else {
            return Ok(());
        };
        Err(SceneError::Overlap {
            scene: self.name.clone(),
            regions: self.in_words([first.number, second.number]),
            point: found.0[..axes].to_vec(),
            apart: found.1,
        })
    }

    /// The first particle of one of these regions that lies in the shape of the other one.
    fn first_inside(&self, first: &Group<'_>, second: &Group<'_>) -> Option<Vector3> {
        let bounds_of = |group: &Group<'_>| {
            let shape = &self.regions[group.number].shape;
            shape.bounds(self.particle_spacing)
        };
        overlap(bounds_of(first)?, bounds_of(second)?)?;
        let axes = self.dimension.axes();
        let inside = |shape: usize, points: &[Vector3]| {
            let shape = &self.regions[shape].shape;
            // A layer is where its particles are: what lies in it is near to one.
            let lies = |x: &&Vector3| holds(shape, **x, axes, self.particle_spacing, &|_, _| false);
            points.iter().find(lies).copied()
        };
        inside(second.number, first.points).or_else(|| inside(first.number, second.points))
    }

    fn in_words(&self, regions: [usize; 2]) -> Box<[(usize, String); 2]> {
        Box::new(regions.map(|n| (n, self.regions[n].in_words(self.dimension))))
    }
}

/// Two particles that are too near to each other.
struct NearPair {
    /// The first one, m.
    point: Vector3,
    /// m.
    distance: f64,
}

/// The first point of `a` that is nearer than `near` to one of `b`.
///
/// The points of `b` are sorted into cubes of the distance that is allowed; what is too near to a
/// point lies in its cube or in one of those around.
fn too_near(a: &[Vector3], b: &[Vector3], near: f64, axes: usize) -> Option<NearPair> {
    let common = overlap(grown(bounds(a)?, [near; 3]), grown(bounds(b)?, [near; 3]))?;
    let inside = |p: &&Vector3| (0..axes).all(|k| common.0[k] <= p[k] && p[k] <= common.1[k]);
    let cube = |p: &Vector3| -> [i64; 3] {
        std::array::from_fn(|k| ((p[k] - common.0[k]) / near).floor() as i64)
    };
    let mut sorted: Vec<([i64; 3], &Vector3)> =
        b.iter().filter(inside).map(|p| (cube(p), p)).collect();
    sorted.sort_unstable_by_key(|(cube, _)| *cube);
    let apart = |p: &Vector3, q: &Vector3| {
        let square: f64 = (0..axes).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum();
        square.sqrt()
    };
    // Where a distance is just the one allowed, rounding does not decide.
    let limit = near * (1.0 - 1e-9);
    let mut candidates = a.iter().filter(inside);
    candidates.find_map(|p| {
        let home = cube(p);
        let distances = (0..3_i64.pow(axes as u32)).flat_map(|n| {
            let offset = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
            let cell: [i64; 3] =
                std::array::from_fn(|k| home[k] + if k < axes { offset[k] } else { 0 });
            let start = sorted.partition_point(|(cube, _)| *cube < cell);
            sorted[start..]
                .iter()
                .take_while(move |(cube, _)| *cube == cell)
                .map(|(_, q)| apart(p, q))
        });
        let distance = distances.fold(f64::INFINITY, f64::min);
        (distance < limit).then_some(NearPair {
            point: *p,
            distance,
        })
    })
}

fn bounds(points: &[Vector3]) -> Option<AxisBox> {
    points
        .iter()
        .map(|&point| (point, point))
        .reduce(around_both)
}
