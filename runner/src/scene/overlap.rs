//! Regions that fill one place twice.

use super::error::SceneError;
use super::geometry::{AxisBox, Vector3, around_both, grown, overlap};
use super::initial::InitialState;
use super::types::Scene;
use super::words::RegionKind;

/// Particles of two regions nearer than this, in spacings, are a mistake. Lattice nodes lie half a
/// spacing inside the faces of their region, so that regions which only touch keep their particles
/// farther apart; particles nearer than this mean regions that overlap.
pub(super) const TOO_NEAR: f64 = 0.45;

impl Scene {
    /// Compares the particles of every two regions where their bounds overlap.
    ///
    /// Two regions that do not interlock cost nothing beyond their bounds.
    pub(super) fn refuse_overlap(
        &self,
        state: &InitialState,
        placed: &[(usize, RegionKind, usize)],
    ) -> Result<(), SceneError> {
        let mut groups: Vec<(usize, &[Vector3])> = Vec::new();
        for (position, &(number, kind, start)) in placed.iter().enumerate() {
            let all = if self.is_movable(kind) {
                &state.fluid
            } else {
                &state.wall
            };
            let end = placed[position + 1..]
                .iter()
                .find(|next| self.is_movable(next.1) == self.is_movable(kind))
                .map_or(all.len(), |next| next.2);
            groups.push((number, &all[start..end]));
        }
        let axes = self.dimension.axes();
        let (bodies, _) = self.bodies();
        for (position, &(first, points)) in groups.iter().enumerate() {
            for &(second, others) in &groups[position + 1..] {
                // Bodies within each other's reach would begin with a pressure between them that
                // their constants hide.
                let reach = self.support_radius();
                if self.solid.is_some()
                    && bodies[first] != bodies[second]
                    && let Some(point) = too_near(points, others, reach, axes)
                {
                    let region = |n: usize| (n, self.regions[n].in_words(self.dimension));
                    return Err(SceneError::BodiesTooNear {
                        scene: self.name.clone(),
                        regions: Box::new([region(first), region(second)]),
                        point: point[..axes].to_vec(),
                        reach,
                    });
                }
                let near = TOO_NEAR * self.particle_spacing;
                if let Some(point) = too_near(points, others, near, axes) {
                    return Err(SceneError::Coincident {
                        scene: self.name.clone(),
                        first: (first, self.regions[first].in_words(self.dimension)),
                        second: (second, self.regions[second].in_words(self.dimension)),
                        point: point[..axes].to_vec(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// The first point of `a` that is nearer than `near` to one of `b`.
///
/// The points of `b` are sorted into cubes of the distance that is allowed; what is too near to a
/// point lies in its cube or in one of those around.
fn too_near(a: &[Vector3], b: &[Vector3], near: f64, axes: usize) -> Option<Vector3> {
    let common = overlap(grown(bounds(a)?, [near; 3]), grown(bounds(b)?, [near; 3]))?;
    let inside = |p: &&Vector3| (0..axes).all(|k| common.0[k] <= p[k] && p[k] <= common.1[k]);
    let cube = |p: &Vector3| -> [i64; 3] {
        std::array::from_fn(|k| ((p[k] - common.0[k]) / near).floor() as i64)
    };
    let mut sorted: Vec<([i64; 3], &Vector3)> =
        b.iter().filter(inside).map(|p| (cube(p), p)).collect();
    sorted.sort_unstable_by_key(|(cube, _)| *cube);
    let is_near = |p: &Vector3, q: &Vector3| {
        let square: f64 = (0..axes).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum();
        square < near * near
    };
    let mut candidates = a.iter().filter(inside);
    candidates
        .find(|p| {
            let home = cube(p);
            (0..3_i64.pow(axes as u32)).any(|n| {
                let offset = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
                let cell: [i64; 3] =
                    std::array::from_fn(|k| home[k] + if k < axes { offset[k] } else { 0 });
                let start = sorted.partition_point(|(cube, _)| *cube < cell);
                sorted[start..]
                    .iter()
                    .take_while(|(cube, _)| *cube == cell)
                    .any(|(_, q)| is_near(p, q))
            })
        })
        .copied()
}

fn bounds(points: &[Vector3]) -> Option<AxisBox> {
    points
        .iter()
        .map(|&point| (point, point))
        .reduce(around_both)
}
