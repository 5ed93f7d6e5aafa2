//! Names of energies where there is little room.

/// The name cut short: `kin`, `int`, `grav`, `pen`; five letters and fewer are left as they are.
pub fn brief(kind: &str) -> &str {
    let letters = match kind {
        "kinetic" | "internal" | "penalty" => 3,
        short if short.len() <= 5 => short.len(),
        _ => 4,
    };
    kind.get(..letters).unwrap_or(kind)
}
