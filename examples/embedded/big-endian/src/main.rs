//! The reversal on a big-endian processor: `s390x-unknown-linux-gnu` without a C library.
//!
//! Prints the run's outcome word for word as the host twin does, and ends with 0 if time came
//! back, 1 if not or if anything else went wrong. An emulator of Linux's system calls suffices to
//! run it: it makes two of them, `write` and `exit_group`.
#![no_std]
#![no_main]

use core::arch::{asm, global_asm};
use core::fmt::{self, Write};
use core::panic::PanicInfo;

// SAFETY: Linux enters with the stack pointer (r15) at argc. A caller owes the function it calls
// 160 bytes above the stack pointer, where the latter saves registers, and a zero to end the chain
// of frames.
global_asm!(
    ".globl _start",
    "_start:",
    "aghi %r15, -160",
    "xc 0(8,%r15), 0(%r15)",
    "brasl %r14, {start}",
    "j .", // never reached
    start = sym start,
);

const STANDARD_OUTPUT: u64 = 1;
const STANDARD_ERROR: u64 = 2;

extern "C" fn start() -> ! {
    match loschmidt_embedded_scene::run() {
        Ok(outcome) => {
            let printed = write!(Stream(STANDARD_OUTPUT), "{outcome}").is_ok();
            exit(printed && outcome.reversed_exactly())
        }
        Err(error) => fail(format_args!("error: {error}")),
    }
}

/// Says why on standard error, and ends as a failure.
fn fail(why: fmt::Arguments<'_>) -> ! {
    // Whether or not it could be said, the exit code tells.
    let _ = writeln!(Stream(STANDARD_ERROR), "{why}");
    exit(false)
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    fail(format_args!("{info}"))
}

/// A file descriptor.
struct Stream(u64);

impl Write for Stream {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let mut rest = text.as_bytes();
        while !rest.is_empty() {
            // Fewer bytes than asked for may be written; a negative count is an error.
            let count = usize::try_from(write(self.0, rest)).map_err(|_| fmt::Error)?;
            rest = rest.get(count..).ok_or(fmt::Error)?;
        }
        Ok(())
    }
}

/// System call 4 of s390x, `write`.
fn write(descriptor: u64, bytes: &[u8]) -> i64 {
    let result;
    // SAFETY: by the kernel's convention the number is in r1, arguments are in r2 to r4, the
    // result is in r2, and no other general register changes; memory is only read, and within
    // `bytes`. The condition code may change, which `asm!` assumes unless told otherwise.
    unsafe {
        asm!(
            "svc 0",
            in("r1") 4_u64,
            inlateout("r2") descriptor => result,
            in("r3") bytes.as_ptr(),
            in("r4") bytes.len(),
            options(nostack, readonly),
        );
    }
    result
}

/// System call 248 of s390x, `exit_group`, with 0 or 1.
fn exit(success: bool) -> ! {
    // SAFETY: the kernel ends the process here; nothing of it is used afterwards.
    unsafe {
        asm!(
            "svc 0",
            in("r1") 248_u64,
            in("r2") u64::from(!success),
            options(noreturn, nostack),
        )
    }
}
