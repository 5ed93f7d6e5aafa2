//! Words that both faces write.

use loschmidt_runner::ArithmeticKind;
use loschmidt_runner::deck::{Meddling, Perturbation};
use loschmidt_runner::figures::quantity;

/// Why time did not come back: what was done to the state.
#[must_use]
pub fn because(meddling: &Meddling) -> String {
    let time = quantity(meddling.time, "s", 5);
    match meddling.what {
        Perturbation::Flipped(particle) => {
            format!("one bit of particle {particle} was flipped at t = {time}")
        }
        Perturbation::Switched(kind) => {
            let name = match kind {
                ArithmeticKind::Fixed => "fixed",
                ArithmeticKind::Float => "floating",
            };
            format!("the arithmetic became {name} point at t = {time}")
        }
    }
}
