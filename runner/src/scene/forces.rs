//! The keys of the outside forces, per mass.

use super::declare::keys;
use super::geometry::Vector3;
use super::schema::ANY_MODEL;
use super::schema::IfAbsent::{Number, Optional, Required};
use super::schema::Range::{Any, AtLeast};

keys! {
    /// Outside forces, per mass.
    #[derive(Copy)]
    Gravity of ANY_MODEL, table Header "`[gravity]`" {
        uniform: Vector3 = Optional, Any, "the same acceleration everywhere", "m/s²";
        central: Option<CentralGravity> = Optional, Any, "attraction to a point";
    }
}

keys! {
    /// The acceleration -strength x / (|x|² + softening²)^(3/2), with x from the centre.
    #[derive(Copy)]
    CentralGravity of ANY_MODEL, table Other "`[gravity.central]`" {
        centre: Vector3 = Required, Any, "the attracting point", "m";
        strength: f64 = Required, Any,
            "gravitational constant times mass; negative: repulsion", "m³/s²";
        softening: f64 = Number(0.0), AtLeast(0.0),
            "length added in squares to the distance", "m";
    }
}
