//! The reversal on a bare Cortex-M4: no operating system, no allocator, no f64 unit.
//!
//! Prints the run's outcome over semihosting, word for word as the host twin does, and leaves
//! the emulator with 0 if time came back, 1 if not or if anything else went wrong.
#![no_std]
#![no_main]

use core::fmt::{self, Write as _};
use core::panic::PanicInfo;

use cortex_m_rt::{ExceptionFrame, entry, exception};
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hio;
use loschmidt_embedded_scene::Dam;

/// Parts of the system pass over the stack on its way to its place, at worst all of it in several
/// copies: the rest of the board's 4 MiB, which is the stack, has room for a dozen.
const _: () = assert!(size_of::<Option<Dam>>() < 256 * 1024);

#[entry]
fn main() -> ! {
    // `entry` runs once and hands this out as a `&'static mut`: the system has a place of its
    // own, given at link time, and not on the stack.
    static mut DAM: Option<Dam> = None;

    match loschmidt_embedded_scene::run_in(DAM) {
        Ok(outcome) => leave(print(format_args!("{outcome}")) && outcome.reversed_exactly()),
        Err(error) => fail(format_args!("error: {error}")),
    }
}

/// Prints on the emulator's standard output; false if that cannot be had.
///
/// A stream of one's own instead of the crate's `hprint!`: that one shares a stream among
/// interrupts and asks for a critical section. Nothing here interrupts.
fn print(text: fmt::Arguments<'_>) -> bool {
    hio::hstdout().is_ok_and(|mut out| out.write_fmt(text).is_ok())
}

/// Says why on the emulator's standard error, and ends it as a failure.
fn fail(why: fmt::Arguments<'_>) -> ! {
    if let Ok(mut err) = hio::hstderr() {
        // Whether or not it could be said, the exit code tells.
        let _ = writeln!(err, "{why}");
    }
    leave(false)
}

/// Ends the emulator with 0 or 1.
fn leave(success: bool) -> ! {
    debug::exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    // Nothing answers semihosting on a chip that runs alone: rest.
    loop {
        core::hint::spin_loop();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    fail(format_args!("{info}"))
}

/// A fault ends the run at once; the default handler would spin until somebody's patience ends.
#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    fail(format_args!("hard fault at {:#010x}", frame.pc()))
}
