//! Published curves of the dam break's leading edge, X(T) with X = x/l, T = t (2 g/l)^(1/2), l the
//! width of the column. The files are in `data/`; their first lines say where they are from.

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
