//! Points, vectors and boxes along the axes.

/// A point or vector; z is 0 in two dimensions.
pub type Vector3 = [f64; 3];

/// Lower and upper corner of a box along the axes.
pub(super) type AxisBox = (Vector3, Vector3);

/// The box with every face moved outwards by so much along its axis.
pub(super) fn grown((min, max): AxisBox, by: Vector3) -> AxisBox {
    (
        std::array::from_fn(|k| min[k] - by[k]),
        std::array::from_fn(|k| max[k] + by[k]),
    )
}

/// The smallest box around two boxes.
pub(super) fn around_both(a: AxisBox, b: AxisBox) -> AxisBox {
    (
        std::array::from_fn(|k| a.0[k].min(b.0[k])),
        std::array::from_fn(|k| a.1[k].max(b.1[k])),
    )
}

/// The common part of two boxes, faces included.
pub(super) fn overlap(a: AxisBox, b: AxisBox) -> Option<AxisBox> {
    let both: AxisBox = (
        std::array::from_fn(|k| a.0[k].max(b.0[k])),
        std::array::from_fn(|k| a.1[k].min(b.1[k])),
    );
    (0..3).all(|k| both.0[k] <= both.1[k]).then_some(both)
}
