//! Published numbers: curves of the dam break's leading edge, X(T) with X = x/l,
//! T = t (2 g/l)^(1/2), l the width of the column, and velocities in a lid-driven cavity. The files
//! are in `data/`; their first lines say where they are from.

/// Points of a curve, T and X.
pub type Curve = Vec<[f64; 2]>;

/// The experiment of Koshizuka & Oka, Nucl. Sci. Eng. 123 (1996) 421.
#[must_use]
pub fn koshizuka_oka() -> Curve {
    parse(include_str!("../data/koshizuka-oka-1996.csv"))
}

/// The simulation in D. Violeau, Fluid Mechanics and the SPH Method, Oxford University Press
/// (2012).
#[must_use]
pub fn violeau() -> Curve {
    parse(include_str!("../data/violeau-2012.csv"))
}

/// A middle line of the lid-driven cavity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MiddleLine {
    /// x = 1/2: places are heights, and the velocity is that along x.
    Vertical,
    /// y = 1/2: the velocity is that along y.
    Horizontal,
}

/// Places between the walls and velocities of U. Ghia, K. N. Ghia & C. T. Shin, J. Comput. Phys. 48
/// (1982) 387, at a Reynolds number of 100, 400 or 1000; nothing for others.
///
/// At 400 the number for x = 0.9063 is left out: between its neighbours, -0.228 and -0.450, it is
/// printed as -0.238.
#[must_use]
pub fn ghia(line: MiddleLine, reynolds: u32) -> Curve {
    let word = match line {
        MiddleLine::Vertical => "u",
        MiddleLine::Horizontal => "v",
    };
    let text = include_str!("../data/ghia-1982.csv");
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let mut rows = rows.map(|row| row.split(',').collect::<Vec<&str>>());
    let name = reynolds.to_string();
    let column = rows
        .next()
        .and_then(|head| head.iter().position(|column| *column == name));
    let Some(column) = column else {
        return Curve::new();
    };
    let inner = |row: &Vec<&str>| -> Option<[f64; 2]> {
        let place: f64 = row.get(1)?.parse().ok()?;
        let misprint = line == MiddleLine::Horizontal && reynolds == 400 && place == 0.9063;
        let inside = row.first() == Some(&word) && place > 0.0 && place < 1.0 && !misprint;
        inside.then_some([place, row.get(column)?.parse().ok()?])
    };
    rows.filter_map(|row| inner(&row)).collect()
}

/// Lines of two numbers; others are a heading.
fn parse(text: &str) -> Curve {
    let pair = |line: &str| {
        let (a, b) = line.split_once(',')?;
        Some([a.trim().parse().ok()?, b.trim().parse().ok()?])
    };
    text.lines().filter_map(pair).collect()
}

/// The value at `x` on the straight lines between the points of a curve; `None` beyond its ends.
#[must_use]
pub fn at(curve: &[[f64; 2]], x: f64) -> Option<f64> {
    let pair = curve.windows(2).find(|p| p[0][0] <= x && x <= p[1][0])?;
    let [a, b] = [pair[0], pair[1]];
    let t = if b[0] > a[0] {
        (x - a[0]) / (b[0] - a[0])
    } else {
        0.0
    };
    Some(a[1] + t * (b[1] - a[1]))
}

/// Root mean square and mean of curve minus reference, at those points of the reference that the
/// curve reaches.
#[must_use]
pub fn distance(curve: &[[f64; 2]], reference: &[[f64; 2]]) -> (f64, f64) {
    let off: Vec<f64> = reference
        .iter()
        .filter_map(|p| Some(at(curve, p[0])? - p[1]))
        .collect();
    let n = off.len().max(1) as f64;
    let square: f64 = off.iter().map(|d| d * d).sum();
    ((square / n).sqrt(), off.iter().sum::<f64>() / n)
}

#[cfg(test)]
mod tests {
    use super::{MiddleLine, ghia};

    #[test]
    fn the_cavity_has_fifteen_places_on_each_line_but_for_a_misprint() {
        for reynolds in [100, 1000] {
            assert_eq!(ghia(MiddleLine::Vertical, reynolds).len(), 15);
            assert_eq!(ghia(MiddleLine::Horizontal, reynolds).len(), 15);
        }
        assert_eq!(ghia(MiddleLine::Vertical, 400).len(), 15);
        assert_eq!(ghia(MiddleLine::Horizontal, 400).len(), 14);
        assert!(ghia(MiddleLine::Vertical, 200).is_empty());
        let middle = ghia(MiddleLine::Vertical, 100)
            .into_iter()
            .find(|[y, _]| *y == 0.5);
        assert_eq!(middle, Some([0.5, -0.20581]));
    }
}
