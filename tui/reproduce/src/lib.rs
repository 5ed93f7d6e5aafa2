//! The papers, run again: every figure and table of O. Kincl & M. Pavelka, Comput. Phys. Commun. 284
//! (2023) 108593, and those of Kincl, Peshkov, Pavelka & Klika, Appl. Math. Comput. 439 (2023)
//! 127579 that are about elastic bodies, with our number beside theirs and a verdict.
//!
//! ```text
//! Target --Lab (runs, kept in a directory)--> Section (findings, tables, figures) --report-->
//! Markdown, HTML
//! ```
//!
//! 1. [`target`]: what can be reproduced. Each is a function from a [`Lab`] to a [`Section`].
//! 2. [`lab`]: runs scenes in the directory of the report. What is finished is not run again, what
//!    was interrupted goes on.
//! 3. [`section`]: what a target found. [`svg`]: its figures. [`report`]: the two pages.
//! 4. [`mod@reference`]: published curves, with their sources.

#![forbid(unsafe_code)]

pub mod lab;
pub mod reference;
pub mod report;
pub mod section;
pub mod svg;
pub mod target;
mod targets;

pub use lab::{Lab, LabError, News};
pub use section::{Section, Verdict};
pub use target::{GROUPS, Target};
