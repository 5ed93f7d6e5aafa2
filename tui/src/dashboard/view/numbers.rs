//! Numbers of the dashboard: those of [`figures`], as it writes them.

use loschmidt_runner::figures;
pub use loschmidt_runner::figures::{Scale, count, quantity};

/// Steps, which may lie before the start.
pub fn steps(n: i64) -> String {
    let sign = if n < 0 { "−" } else { "" };
    format!("{sign}{}", count(n.unsigned_abs()))
}

/// Three digits that count, with as few zeros as that takes: 0.03, 12, 1.25e-6.
pub fn short(x: f64) -> String {
    figures::number(x, 3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_before_the_start_have_a_minus() {
        assert_eq!([steps(-1000), steps(12)], ["−1,000", "12"]);
    }
}
