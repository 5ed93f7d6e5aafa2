//! Examples: programs beside this folder, scenes in `scenes/`, firmware in `embedded/`.
