//! The digest: a 128-bit fingerprint of a state, the same on every machine.
//!
//! All integers are written as little-endian 64-bit words, whatever the machine's own order and
//! word size. H is SipHash-2-4 with a 128-bit result and an all-zero key (Aumasson & Bernstein,
//! INDOCRYPT 2012), over bytes.
//!
//! Per particle, H of
//!
//! | bytes | what |
//! |---|---|
//! | 8 | 0 for fluid, 1 for a wall |
//! | 8 | id; of a wall, the number of fluid particles plus its place in storage |
//! | 8 each | fluid: every field of the state, in order, component by component |
//! | 8 each | walls: position, component by component; density field |
//!
//! These hashes are added as 128-bit integers, modulo 2^128, so the fluid's order of storage is
//! irrelevant (walls have no id of their own and keep their order). The digest is H of
//!
//! | bytes | what |
//! |---|---|
//! | 20 | ASCII `loschmidt digest 1.0` |
//! | 8 | dimension |
//! | 8 | 0 for fixed-point, 1 for floating-point state |
//! | 24 | the exponents k, j, d of the [`Scale`], two's complement |
//! | 16 | number of fluid particles, of wall particles |
//! | 8 + n, each | for every field: the length of its name, the name in ASCII |
//! | 16 | the sum, least significant byte first |
//!
//! Words of a fixed-point state are its integers; of a floating-point one, the bits of the `f64`
//! with negative zero as zero. As text, a digest is 32 hexadecimal digits, its bytes in order.

use crate::number::{Arithmetic, Quantity, Scale};
use crate::state::System;
use core::fmt;
use siphasher::sip128::SipHasher24;

/// A fingerprint of a state.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Digest(pub [u8; 16]);

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// SipHash-2-4-128 with a zero key, over bytes.
#[must_use]
pub fn hash(bytes: &[u8]) -> [u8; 16] {
    SipHasher24::new().hash(bytes).as_bytes()
}

/// Most words in one particle's record: kind, id, position, velocity, density in 3D.
const MAX_WORDS: usize = 9;

/// Collects little-endian words.
struct Record {
    bytes: [u8; 8 * MAX_WORDS],
    used: usize,
}

impl Record {
    fn new(kind: u64, id: u64) -> Self {
        let mut record = Self {
            bytes: [0; 8 * MAX_WORDS],
            used: 0,
        };
        record.push(kind as i64);
        record.push(id as i64);
        record
    }
    fn push(&mut self, word: i64) {
        self.bytes[self.used..self.used + 8].copy_from_slice(&word.to_le_bytes());
        self.used += 8;
    }
    fn hash(&self) -> u128 {
        u128::from_le_bytes(hash(&self.bytes[..self.used]))
    }
}

/// The digest of fluid and walls.
#[must_use]
pub fn digest<A: Arithmetic, const D: usize>(system: &System<'_, A, D>, scale: &Scale) -> Digest {
    let state = &system.state;
    let fields = state.fields();
    let mut sum = 0u128;
    for (place, id) in state.id.iter().enumerate() {
        let mut record = Record::new(0, *id);
        for (f, field) in fields.iter().enumerate() {
            for c in 0..field.components {
                record.push(state.word(f, c, place));
            }
        }
        sum = sum.wrapping_add(record.hash());
    }
    let walls = &system.walls;
    for (w, (x, density)) in walls.position.iter().zip(&*walls.density).enumerate() {
        let mut record = Record::new(1, (state.len() + w) as u64);
        for x in x {
            record.push(x.to_word());
        }
        record.push(density.to_word());
        sum = sum.wrapping_add(record.hash());
    }
    // Long enough for the fixed part and three short names.
    let mut header = heapless::Vec::<u8, 256>::new();
    let mut push = |bytes: &[u8]| {
        // The longest header has 20 + 56 + 3 * 24 + 16 bytes.
        let _ = header.extend_from_slice(bytes);
    };
    push(b"loschmidt digest 1.0");
    for word in [
        D as i64,
        i64::from(!A::EXACT),
        i64::from(scale.length_exponent),
        i64::from(scale.speed_exponent),
        i64::from(scale.density_exponent),
        state.len() as i64,
        walls.position.len() as i64,
    ] {
        push(&word.to_le_bytes());
    }
    for field in fields {
        push(&(field.name.len() as u64).to_le_bytes());
        push(field.name.as_bytes());
    }
    push(&sum.to_le_bytes());
    Digest(hash(&header))
}
