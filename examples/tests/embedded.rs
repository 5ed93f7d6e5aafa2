//! The run of the firmware, on the host.

use loschmidt_embedded_scene::{GOLDEN, run};

/// A change of the core's arithmetic shows here, without an emulator.
#[test]
fn the_dam_break_of_the_firmware_gives_the_golden_digests() {
    let outcome = run().expect("no number leaves its range");
    assert!(outcome.reversed_exactly());
    assert_eq!(outcome.digests(), GOLDEN);
}
