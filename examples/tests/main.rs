//! What the examples claim.

mod embedded;
mod lennard_jones;
