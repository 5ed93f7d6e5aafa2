//! Values of a scene as it was written, seen as numbers, lists and tables.

use super::spec::{Node, WrittenTable, WrittenValue};

/// A finite or infinite number, whole or not.
pub(super) fn number(node: &Node) -> Option<f64> {
    match node.value {
        // Exact below 2^53, and rounded to the nearest number above.
        WrittenValue::Integer(n) => Some(n as f64),
        WrittenValue::Float(x) => Some(x),
        _ => None,
    }
}

/// A finite number, whole or not.
pub(super) fn finite(node: &Node) -> Option<f64> {
    number(node).filter(|x| x.is_finite())
}

/// The table in a node, if it is one.
pub(super) fn as_table(node: &Node) -> Option<&WrittenTable> {
    match &node.value {
        WrittenValue::Table(table) => Some(table),
        _ => None,
    }
}

/// The elements of a list; none for anything else.
pub(super) fn elements(node: &Node) -> &[Node] {
    match &node.value {
        WrittenValue::List(list) => list,
        _ => &[],
    }
}

/// Up to three numbers of a list; zero for absent ones, NaN for refused ones.
pub(super) fn numbers(node: &Node) -> [f64; 3] {
    let list = elements(node);
    std::array::from_fn(|k| {
        list.get(k)
            .map_or(0.0, |element| finite(element).unwrap_or(f64::NAN))
    })
}
