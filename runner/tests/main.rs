//! What the runner promises of scenes and files, all in one program: built and linked once.

mod frames;
mod scene_catalogue;
mod scene_errors;
mod scene_lattice;
mod scene_solid;
mod scene_text;
mod scene_viscous;
