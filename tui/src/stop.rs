//! The signals to stop.

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::exit::INTERRUPTED;

/// A terminal that is closed is one of them where there is such a signal, and SIGQUIT, which would
/// end the program without giving the terminal back.
#[cfg(unix)]
const SIGNALS: [i32; 4] = {
    use signal_hook::consts::{SIGHUP, SIGQUIT};
    [SIGINT, SIGTERM, SIGHUP, SIGQUIT]
};
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// What the signals to stop do. During set-up, when nothing is there that could be lost, they end
/// the program. [Later](Stop::wait_for_steps) they set a flag, and repeated ones change nothing: a
/// run stops after the step it is at, and its snapshot and last words are not to be lost to an
/// impatient second Ctrl-C.
pub struct Stop {
    at_once: Arc<AtomicBool>,
    asked: Arc<AtomicBool>,
}

impl Stop {
    /// Takes the signals.
    ///
    /// # Errors
    /// The system does not give them.
    pub fn new() -> io::Result<Self> {
        let stop = Self {
            at_once: Arc::new(AtomicBool::new(true)),
            asked: Arc::default(),
        };
        for signal in SIGNALS {
            let at_once = Arc::clone(&stop.at_once);
            flag::register_conditional_shutdown(signal, i32::from(INTERRUPTED), at_once)?;
            flag::register(signal, Arc::clone(&stop.asked))?;
        }
        Ok(stop)
    }

    /// From now on a signal is only heard.
    pub fn wait_for_steps(&self) {
        self.at_once.store(false, Ordering::SeqCst);
    }

    /// Whether one has come since.
    #[must_use]
    pub fn asked(&self) -> &Arc<AtomicBool> {
        &self.asked
    }
}
