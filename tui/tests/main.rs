//! The program, as a user meets it: all tests in one program, linked once.

#[cfg(unix)]
mod cli_dashboard;
mod cli_interrupt;
mod cli_movie;
mod cli_reproduce;
mod cli_result;
mod cli_resume;
mod cli_usage;
mod program;
