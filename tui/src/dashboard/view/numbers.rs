//! Numbers for people.

use crate::progress::smaller_than_joule;
pub use loschmidt_viewer::session::count;

/// Steps, which may lie before the start.
pub fn steps(n: i64) -> String {
    let sign = if n < 0 { "−" } else { "" };
    format!("{sign}{}", count(n.unsigned_abs()))
}

/// Three digits that count, with as few zeros as that takes: 0.03, 12, 1.25e-6.
pub fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let size = x.abs();
    if !(1e-3..1e5).contains(&size) {
        return minus(format!("{x:.1e}"));
    }
    let digits = match size {
        100.0.. => 0,
        10.0.. => 1,
        1.0.. => 2,
        0.1.. => 3,
        0.01.. => 4,
        _ => 5,
    };
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    };
    minus(text)
}

/// A number with so many digits after the point and a minus sign that is one.
pub fn fixed(x: f64, digits: usize) -> String {
    minus(format!("{x:.digits$}"))
}

/// A small error: −8.7e-4.
pub fn error(x: f64) -> String {
    if x == 0.0 {
        "0".to_owned()
    } else {
        minus(format!("{x:.1e}"))
    }
}

fn minus(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

/// The unit of energies whose largest is this, and J per unit.
pub fn energy_unit(largest: f64) -> (&'static str, f64) {
    if largest >= 1e4 {
        ("kJ", 1e3)
    } else {
        smaller_than_joule(largest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let shorts = [0.0, 0.03, 300.0, 12.5, -0.5, 1e-7, 123_456.0].map(short);
        assert_eq!(
            shorts,
            ["0", "0.03", "300", "12.5", "−0.5", "1.0e-7", "1.2e5"]
        );
        assert_eq!(count(1_234_567), "1,234,567");
        assert_eq!(steps(-1000), "−1,000");
        assert_eq!(fixed(-0.0001, 2), "0.00");
    }
}
