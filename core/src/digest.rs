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
//! | 8 each | walls: those fields that walls have too (position; density field of water) |
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

use crate::fields::{MAX_FIELDS, Side, state_fields};
use crate::number::{Arithmetic, Scale};
use crate::system::System;
use core::fmt;
use core::hash::Hasher;
use siphasher::sip128::{Hasher128, SipHasher24};

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
    let mut hashing = Hashing::default();
    hashing.add(bytes);
    hashing.finish()
}

/// [`hash`] of bytes that come one after another.
#[derive(Clone, Debug, Default)]
pub struct Hashing(SipHasher24);

impl Hashing {
    /// Goes on with these bytes.
    pub fn add(&mut self, bytes: &[u8]) {
        self.0.write(bytes);
    }
    /// The hash of all.
    #[must_use]
    pub fn finish(&self) -> [u8; 16] {
        self.0.finish128().as_bytes()
    }
}

/// Words of a particle's record that are hashed at a time; most records are shorter.
const PIECE: usize = 32;

/// Fluid or wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// 0.
    Fluid,
    /// 1.
    Wall,
}

/// What the digest says of the whole state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Header<'a> {
    /// 2 or 3.
    pub dimension: usize,
    /// False for a floating-point state.
    pub fixed_point: bool,
    /// Units.
    pub scale: Scale,
    /// Number of fluid particles.
    pub fluid: u64,
    /// Number of wall particles.
    pub walls: u64,
    /// Names of the particles' fields, in order.
    pub fields: &'a [&'a str],
}

/// The order-free sum of the particles' hashes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ParticleSum(u128);

impl ParticleSum {
    /// Adds a particle with these words after kind and id.
    pub fn add(&mut self, kind: Kind, id: u64, words: impl IntoIterator<Item = i64>) {
        let mut hashing = Hashing::default();
        let mut piece = [0u8; 8 * PIECE];
        let mut used = 0;
        let head = [i64::from(kind == Kind::Wall), id as i64];
        for word in head.into_iter().chain(words) {
            if used == piece.len() {
                hashing.add(&piece);
                used = 0;
            }
            piece[used..used + 8].copy_from_slice(&word.to_le_bytes());
            used += 8;
        }
        hashing.add(&piece[..used]);
        self.0 = self.0.wrapping_add(u128::from_le_bytes(hashing.finish()));
    }

    /// The digest of header and sum.
    #[must_use]
    pub fn finish(self, header: &Header<'_>) -> Digest {
        let mut hashing = Hashing::default();
        hashing.add(b"loschmidt digest 1.0");
        for word in [
            header.dimension as i64,
            i64::from(!header.fixed_point),
            i64::from(header.scale.length_exponent),
            i64::from(header.scale.speed_exponent),
            i64::from(header.scale.density_exponent),
            header.fluid as i64,
            header.walls as i64,
        ] {
            hashing.add(&word.to_le_bytes());
        }
        for name in header.fields {
            hashing.add(&(name.len() as u64).to_le_bytes());
            hashing.add(name.as_bytes());
        }
        hashing.add(&self.0.to_le_bytes());
        Digest(hashing.finish())
    }
}

/// The digest of particles and walls.
#[must_use]
pub fn digest<A: Arithmetic, const D: usize>(system: &System<'_, A, D>, scale: &Scale) -> Digest {
    let mut sum = ParticleSum::default();
    for (set, kind) in [
        (&system.particles, Kind::Fluid),
        (&system.walls, Kind::Wall),
    ] {
        for (place, id) in set.id.iter().enumerate() {
            let words = state_fields(set.fields(), set.side()).flat_map(|(f, field)| {
                let components = 0..field.words(set.side(), D);
                components.map(move |c| set.word(f, c, place))
            });
            sum.add(kind, *id, words);
        }
    }
    let fields = system.particles.fields();
    let names: heapless::Vec<&str, MAX_FIELDS> = state_fields(fields, Side::Particles)
        .map(|(_, field)| field.name)
        .collect();
    sum.finish(&Header {
        dimension: D,
        fixed_point: A::EXACT,
        scale: *scale,
        fluid: system.particles.len() as u64,
        walls: system.walls.len() as u64,
        fields: &names,
    })
}
