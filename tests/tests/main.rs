//! The claims, all in one program: linked once instead of twenty times.

mod arithmetic;
mod caches;
mod conformance;
mod conservation;
mod deck;
mod digest;
mod energies;
mod entropy;
mod exact;
mod faults;
mod filtered;
mod integrators;
mod isc;
mod kernel;
mod neighbours;
mod number;
mod pieces;
mod player_moves;
mod reversal;
mod run_conservation;
mod run_dam_break;
mod run_faults;
mod setup_errors;
mod snapshot_bytes;
mod standard;
