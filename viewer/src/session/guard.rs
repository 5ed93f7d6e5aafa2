//! Defects of the program while somebody watches: they are told, and the state is kept.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::{Arc, Mutex, PoisonError};

/// Exit code after a defect, that of `sysexits.h` for an error in software.
pub const DEFECT: u8 = 70;

/// A panic: what it said, and where in the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Defect(String);

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a defect of the program: {}", self.0)
    }
}

/// Does `work`, and catches a panic of it, on this thread or on one that it waits for. Meanwhile
/// no panic writes to a screen that is drawn on.
///
/// # Errors
/// The panic.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, Defect> {
    let said = Arc::new(Mutex::new(String::new()));
    let hears = Arc::clone(&said);
    let before = take_hook();
    set_hook(Box::new(move |info| {
        // The last one is that which ends the work: earlier ones were caught.
        *hears.lock().unwrap_or_else(PoisonError::into_inner) = info.to_string();
    }));
    let done = catch_unwind(AssertUnwindSafe(work));
    set_hook(before);
    let text = said.lock().unwrap_or_else(PoisonError::into_inner);
    done.map_err(|_| Defect(text.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_of_another_thread_is_told_with_its_place() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
        let pool = pool.expect("threads");
        let drawn = guarded(|| pool.install(|| [1, 2].get(2).copied().expect("a third")));
        let text = drawn.expect_err("a defect").to_string();
        for word in ["a defect of the program: ", "guard.rs:", "a third"] {
            assert!(text.contains(word), "{text}");
        }
        assert_eq!(guarded(|| 5), Ok(5));
    }
}
