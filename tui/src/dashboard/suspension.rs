//! The dashboard sent to the background, and brought back.
//!
//! SIGTSTP stops a program. The terminal is given back before, and taken again when SIGCONT comes:
//! the shell had it meanwhile. In raw mode Ctrl-Z is a key; the signals come from other programs.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What the signals have asked for.
#[derive(Default)]
pub struct Suspension {
    /// To stop.
    stop: Arc<AtomicBool>,
    /// The program was continued.
    continued: Arc<AtomicBool>,
}

#[cfg(unix)]
impl Suspension {
    /// Hears the signals.
    ///
    /// # Errors
    /// The system does not give them.
    pub fn new() -> io::Result<Self> {
        use signal_hook::consts::{SIGCONT, SIGTSTP};
        let suspension = Self::default();
        signal_hook::flag::register(SIGTSTP, Arc::clone(&suspension.stop))?;
        signal_hook::flag::register(SIGCONT, Arc::clone(&suspension.continued))?;
        Ok(suspension)
    }

    /// Stops the program where that was asked for; true if the terminal must be taken anew, and
    /// all of it drawn. `give_back` is called before.
    ///
    /// # Errors
    /// The program cannot be stopped.
    pub fn obey(&self, give_back: impl FnOnce()) -> io::Result<bool> {
        use std::sync::atomic::Ordering::SeqCst;
        if self.stop.swap(false, SeqCst) {
            give_back();
            signal_hook::low_level::emulate_default_handler(signal_hook::consts::SIGTSTP)?;
            self.continued.store(false, SeqCst);
            return Ok(true);
        }
        Ok(self.continued.swap(false, SeqCst))
    }
}

#[cfg(not(unix))]
impl Suspension {
    /// There are no such signals.
    pub fn new() -> io::Result<Self> {
        Ok(Self::default())
    }

    /// Nothing is asked for.
    pub fn obey(&self, _: impl FnOnce()) -> io::Result<bool> {
        Ok(false)
    }
}
