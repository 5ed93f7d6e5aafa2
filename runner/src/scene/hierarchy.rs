//! Unions of many shapes, made quick to ask.
//!
//! Whether a point is in one of N shapes takes N questions, and a scene has at least as many points
//! as shapes. A long union is therefore cut in halves, again and again, each half within a box
//! around it: a point asks for the box first. Which points belong to the shape does not change.

use super::geometry::{AxisBox, around_both, grown};
use super::shape::Shape;

/// Unions up to this length are left as they are.
const SHORT: usize = 16;

/// The same shape with its long unions as hierarchies of boxes.
pub(super) fn of(shape: &Shape, spacing: f64) -> Shape {
    let each = |shapes: &[Shape]| -> Vec<Shape> { shapes.iter().map(|s| of(s, spacing)).collect() };
    match shape {
        Shape::Union(shapes) => split(each(shapes), spacing),
        Shape::Difference(shapes) => match shapes.split_first() {
            Some((first, others)) if others.len() > SHORT => {
                Shape::Difference(vec![of(first, spacing), split(each(others), spacing)])
            }
            _ => Shape::Difference(each(shapes)),
        },
        Shape::Intersection(shapes) => Shape::Intersection(each(shapes)),
        Shape::Layer { around, depth } => Shape::Layer {
            around: Box::new(of(around, spacing)),
            depth: *depth,
        },
        other => other.clone(),
    }
}

/// A union of these shapes.
fn split(shapes: Vec<Shape>, spacing: f64) -> Shape {
    if shapes.len() <= SHORT {
        return Shape::Union(shapes);
    }
    // An empty shape holds nothing.
    let bounded = |shape: Shape| shape.bounds(spacing).map(|bounds| (bounds, shape));
    halved(shapes.into_iter().filter_map(bounded).collect(), spacing)
}

fn halved(mut shapes: Vec<(AxisBox, Shape)>, spacing: f64) -> Shape {
    if shapes.len() <= SHORT {
        return Shape::Union(shapes.into_iter().map(|(_, shape)| shape).collect());
    }
    let all = shapes.iter().map(|(bounds, _)| *bounds).reduce(around_both);
    let (low, high) = all.unwrap_or_default();
    let longest = (0..3).max_by(|&a, &b| (high[a] - low[a]).total_cmp(&(high[b] - low[b])));
    let axis = longest.unwrap_or(0);
    let middle = |(bounds, _): &(AxisBox, Shape)| bounds.0[axis] + bounds.1[axis];
    let half = shapes.len() / 2;
    shapes.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
    let upper = shapes.split_off(half);
    Shape::Union(vec![boxed(shapes, spacing), boxed(upper, spacing)])
}

/// A half within its box, which is larger by more than the tolerance of faces.
fn boxed(shapes: Vec<(AxisBox, Shape)>, spacing: f64) -> Shape {
    let bounds = shapes.iter().map(|(bounds, _)| *bounds).reduce(around_both);
    let (min, max) = grown(bounds.unwrap_or_default(), [spacing; 3]);
    Shape::Intersection(vec![Shape::Block { min, max }, halved(shapes, spacing)])
}

#[cfg(test)]
mod tests {
    use super::super::filling::holds;
    use super::*;

    fn discs(count: usize) -> Vec<Shape> {
        let disc = |n: usize| Shape::Ball {
            centre: [(n % 64) as f64, (n / 64) as f64, 0.0],
            radius: 0.4,
        };
        (0..count).map(disc).collect()
    }

    /// Shapes that are looked at to find out about a point.
    fn questions(shape: &Shape, x: [f64; 3]) -> usize {
        let inner = |shapes: &[Shape]| -> usize { shapes.iter().map(|s| questions(s, x)).sum() };
        match shape {
            Shape::Union(shapes) => inner(shapes),
            Shape::Intersection(shapes) => {
                let is_in = holds(&shapes[0], x, 2, 0.1, &|_, _| false);
                1 + if is_in { inner(&shapes[1..]) } else { 0 }
            }
            _ => 1,
        }
    }

    #[test]
    fn a_long_union_holds_the_same_and_is_asked_little() {
        let (flat, layered) = (
            Shape::Union(discs(4096)),
            of(&Shape::Union(discs(4096)), 0.1),
        );
        let holed = [
            vec![Shape::Block {
                min: [0.0; 3],
                max: [64.0; 3],
            }],
            discs(4096),
        ]
        .concat();
        let (holed, quick) = (
            Shape::Difference(holed.clone()),
            of(&Shape::Difference(holed), 0.1),
        );
        let at = |shape: &Shape, x| holds(shape, x, 2, 0.1, &|_, _| false);
        for n in 0..500 {
            let x = [0.131 * n as f64, 0.127 * (n % 487) as f64, 0.0];
            assert_eq!(at(&flat, x), at(&layered, x), "{x:?}");
            assert_eq!(at(&holed, x), at(&quick, x), "{x:?}");
            assert!(
                questions(&layered, x) < 200,
                "{x:?}: {}",
                questions(&layered, x)
            );
        }
        assert!(at(&flat, [1.0, 1.0, 0.0]) && !at(&flat, [1.5, 1.5, 0.0]));
    }
}
