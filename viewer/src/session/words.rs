//! Words and numbers that both faces write.

use loschmidt_runner::ArithmeticKind;
use loschmidt_runner::deck::{Meddling, Perturbation};
use loschmidt_runner::time_unit::TimeUnit;

/// A whole number with commas: 5,000 and 1,234,567.
#[must_use]
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Why time did not come back: what was done to the state.
#[must_use]
pub fn because(meddling: &Meddling) -> String {
    // With four digits behind the point, a hundredth of a unit is still told apart.
    let unit = TimeUnit::of(100.0 * meddling.time.abs());
    let (time, unit) = (unit.count(meddling.time), unit.name);
    match meddling.what {
        Perturbation::Flipped(particle) => {
            format!("one bit of particle {particle} was flipped at t = {time:.4} {unit}")
        }
        Perturbation::Switched(kind) => {
            let name = match kind {
                ArithmeticKind::Fixed => "fixed",
                ArithmeticKind::Float => "floating",
            };
            format!("the arithmetic became {name} point at t = {time:.4} {unit}")
        }
    }
}
