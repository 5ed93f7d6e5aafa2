//! The program `loschmidt`.
fn main() {}
