//! What the view shows: the region that the fluid visits.
//!
//! The region of a state is the box around its fluid. One particle of 200 at either end of an axis
//! may be spray: it counts, but it takes the box no farther beyond the others than these are wide
//! themselves, so that a drop that flies off does not shrink the picture to nothing. What falls
//! together, as a drop of water does, stays in the picture however far it falls.
//!
//! Where all states are known beforehand (stored frames), the view shows all regions from the first
//! picture on ([`Home::show_all`]). Where they are not, it grows with the fluid ([`Home::follow`]):
//! an edge of the view stands still until the fluid comes near, and then keeps its distance. The
//! fluid moves on a smooth path, and so does the edge.

use crate::camera::FILL;
use crate::home::{Box3, Home};
use loschmidt_runner::Points;

/// One particle of so many may be spray, at either end of an axis.
const SPRAY: usize = 200;

/// Room around fluid without walls whose way is known, in its largest side.
const KNOWN: f64 = 0.02;

/// Room around fluid without walls whose way is not known.
const UNKNOWN: f64 = 0.1;

/// Distance that an edge keeps from fluid without walls.
const KEPT: f64 = 0.05;

/// The region of a state; `None` without fluid.
#[must_use]
pub fn region(points: &Points, spacing: f64) -> Option<Box3> {
    let dimension = points.dimension.clamp(2, 3);
    let mut ends = [[0.0; 2]; 3];
    let mut inner = [[0.0; 2]; 3];
    for axis in 0..dimension {
        let mut list = points.position[axis].clone();
        let spray = list.len() / SPRAY;
        let last = list.len().checked_sub(1)?;
        ends[axis] = ends_of(&list);
        list.select_nth_unstable_by(spray, f32::total_cmp);
        let low = f64::from(list[spray]);
        list.select_nth_unstable_by(last - spray, f32::total_cmp);
        inner[axis] = [low, f64::from(list[last - spray])];
    }
    let reach = inner.iter().map(|[low, high]| high - low);
    let reach = reach.fold(spacing, f64::max);
    let side = |axis: usize, end: usize| {
        let half = if axis < dimension { 0.5 * spacing } else { 0.0 };
        match end {
            0 => ends[axis][0].max(inner[axis][0] - reach) - half,
            _ => ends[axis][1].min(inner[axis][1] + reach) + half,
        }
    };
    Some(Box3 {
        low: std::array::from_fn(|axis| side(axis, 0)),
        high: std::array::from_fn(|axis| side(axis, 1)),
    })
}

fn ends_of(list: &[f32]) -> [f64; 2] {
    let low = list.iter().copied().fold(f32::INFINITY, f32::min);
    let high = list.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    [low, high].map(f64::from)
}

/// Whether all of the fluid lies in a box, which is found sooner than its region.
fn lies_in(points: &Points, room: &Box3) -> bool {
    (0..points.dimension.clamp(2, 3)).all(|axis| {
        let [low, high] = ends_of(&points.position[axis]);
        low >= room.low[axis] && high <= room.high[axis]
    })
}

impl Home {
    /// The view at the beginning: the walls, or the fluid and a little room.
    pub(crate) fn first_view(fluid: Box3, walls: Option<Box3>, dimension: usize) -> Box3 {
        match walls {
            Some(walls) => walls.joined(fluid),
            None => fluid.grown(UNKNOWN * largest(&fluid), dimension),
        }
    }

    /// Shows all of a run that visits these regions.
    pub fn show_all(&mut self, regions: impl IntoIterator<Item = Box3>) {
        let visited = regions.into_iter().reduce(Box3::joined);
        let visited = visited.map_or(self.fluid, |visited| visited.joined(self.fluid));
        self.shown = match self.walls {
            Some(_) => self.shown.joined(visited),
            None => visited.grown(KNOWN * largest(&visited), self.dimension),
        };
        self.laid_out = self.shown;
    }

    /// Shows this rectangle of the plane and nothing else: its lower left and its upper right
    /// corner, m.
    pub fn show_only(&mut self, [left, bottom, right, top]: [f64; 4]) {
        // To the very edges of the picture.
        let scaled = |a: f64, b: f64| 0.5 * (a + b - FILL * (b - a));
        self.shown = Box3 {
            low: [scaled(left, right), scaled(bottom, top), 0.0],
            high: [scaled(right, left), scaled(top, bottom), 0.0],
        };
        self.laid_out = self.shown;
    }

    /// Lets the view grow as far as the fluid of these states takes it.
    pub fn follow<'a>(&mut self, states: impl IntoIterator<Item = &'a Points>) {
        let kept = match self.walls {
            Some(_) => 0.0,
            None => KEPT * largest(&self.fluid),
        };
        let half = 0.5 * self.spacing;
        for points in states {
            // The fluid is half a spacing larger than the middles of its particles.
            if lies_in(points, &self.shown.grown(-kept - half, self.dimension)) {
                continue;
            }
            if let Some(region) = region(points, self.spacing) {
                self.shown = self.shown.joined(region.grown(kept, self.dimension));
            }
        }
    }
}

/// The largest side of a box, m.
fn largest(box3: &Box3) -> f64 {
    box3.size().into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A square of 20 x 20 particles a metre wide, moved by this.
    fn square(by: [f64; 2]) -> Points {
        let at = |k: usize| (k as f64 + 0.5) / 20.0;
        let place = |f: fn(usize) -> usize, by: f64| {
            let all = (0..400).map(|n| (at(f(n)) + by) as f32);
            all.collect::<Vec<f32>>()
        };
        Points {
            dimension: 2,
            id: (0..400).collect(),
            position: [
                place(|n| n % 20, by[0]),
                place(|n| n / 20, by[1]),
                Vec::new(),
            ],
            speed: vec![0.0; 400],
            ..Points::default()
        }
    }

    /// The Kepler ring.
    pub(crate) fn home() -> Home {
        let scene = loschmidt_runner::scene::resolve("kepler-ring").expect("a scene");
        let set = ["particle_spacing=0.2".to_owned()];
        let scene = loschmidt_runner::scene::load(&scene, &set).expect("a scene");
        let initial = scene.initial_state().expect("particles");
        let options = loschmidt_runner::Options::default();
        let player = loschmidt_runner::Player::new(scene.clone(), initial, options);
        Home::new(&scene, &player.expect("a player").frame().expect("a frame"))
    }

    #[test]
    fn the_ring_fills_the_picture() {
        let home = home();
        let area = |box3: &Box3| box3.size()[0] * box3.size()[1];
        let part = area(&home.fluid) / area(&home.shown);
        assert!((0.6..1.0).contains(&part), "{part}");
    }

    /// The fluid flies away faster and faster, and back.
    #[test]
    fn the_view_grows_with_the_fluid_and_never_hops() {
        let mut home = home();
        let (spacing, width) = (0.05, home.shown.size()[0]);
        home.spacing = spacing;
        let mut last: Option<(f64, Box3)> = None;
        for n in 0..400 {
            let t = f64::from(n.min(400 - n)) / 20.0;
            let x = t * t * width;
            let points = square([x, -2.0 * x]);
            home.follow([&points]);
            let fluid = region(&points, spacing).expect("fluid");
            assert_eq!(home.shown.joined(fluid), home.shown, "step {n}");
            if let Some((before, shown)) = last.replace((x, home.shown)) {
                let way = 2.0 * (x - before).abs() + 1e-4;
                for axis in 0..2 {
                    assert!(
                        (home.shown.low[axis] - shown.low[axis]).abs() < way,
                        "step {n}"
                    );
                    assert!(
                        (home.shown.high[axis] - shown.high[axis]).abs() < way,
                        "step {n}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_rectangle_that_was_asked_for_goes_to_the_edges_of_the_picture() {
        let mut home = home();
        home.show_only([-1.0, 2.0, 3.0, 4.0]);
        let projection = crate::Projection::new(&home, &crate::View::default(), 400, 200);
        for (corner, [x, y]) in [([0.0, 0.0], [-1.0, 4.0]), ([400.0, 200.0], [3.0, 2.0])] {
            let found = projection.unproject(corner[0], corner[1]);
            assert!(
                (found[0] - x).abs() < 1e-9 && (found[1] - y).abs() < 1e-9,
                "{found:?}"
            );
        }
    }

    fn close(box3: Box3, expected: [f64; 4]) {
        let found = [box3.low[0], box3.low[1], box3.high[0], box3.high[1]];
        let pairs = found.iter().zip(expected);
        let away = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(away < 1e-4, "{found:?} for {expected:?}");
    }

    #[test]
    fn the_region_of_a_drop_is_where_it_is() {
        let drop = region(&square([3.0, -700.0]), 0.05).expect("fluid");
        close(drop, [3.0, -700.0, 4.0, -699.0]);
    }

    #[test]
    fn two_particles_far_away_do_not_shrink_the_picture_to_nothing() {
        let mut points = square([0.0, 0.0]);
        points.position[0][17] = 1000.0;
        points.position[0][18] = 900.0;
        let found = region(&points, 0.05).expect("fluid");
        assert!(found.size()[0] < 2.1, "{found:?}");
        // Near ones are all in the picture.
        points.position[0][17] = 1.8;
        points.position[0][18] = 1.7;
        close(
            region(&points, 0.05).expect("fluid"),
            [0.0, 0.0, 1.825, 1.0],
        );
    }
}
