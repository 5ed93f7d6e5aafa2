//! The claims of Loschmidt, as tests: see `tests/`.
