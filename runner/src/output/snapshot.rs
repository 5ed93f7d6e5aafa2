//! Snapshots: a state to resume from, on disk.
//!
//! Integers only, all little-endian 64-bit words unless stated; no floating-point number, no
//! `usize`, no wall time. The file is, in this order:
//!
//! | bytes | what |
//! |---|---|
//! | 8 | ASCII `LSCHSNAP` |
//! | 8 | format version, 1 or 2 |
//! | 16 | SipHash-2-4-128 (zero key) of the resolved scene's text |
//! | 8 | dimension, 2 or 3 |
//! | 8 | arithmetic: 0 fixed, 1 floating point (words are then the bits of doubles, in quanta) |
//! | 3 × 8 | exponents k, j, d of the units: 2^(k-46) m, 2^(j-40) m/s, 2^(d-40) kg/m³ |
//! | 8 | steps taken over all legs |
//! | 8 | position: steps from home along physical time |
//! | 8 | arrow: 0 forward, 1 backward (velocities are stored along the arrow) |
//! | 8, 8, 8 | numbers N of fluid particles, W of wall particles, F of fields |
//! | F × | length of the name, the name (ASCII), components C, N·C words, particle by particle |
//! | 8 N | ids; the fields are in this order |
//! | 8 W D | positions of the walls |
//! | 8 W | density field of the walls |
//! | 16 | SipHash-2-4-128 (zero key) of everything before |
//!
//! Version 1 is that of water: position, velocity and one density field, which walls have too. Any
//! other state is written as version 2, which says more of its fields: before the name of each
//! stands its parity under reversal (0 even, 1 odd), and the ids are followed by
//!
//! | bytes | what |
//! |---|---|
//! | 8 | number of fields of the walls |
//! | each × | parity, length of the name, the name, components C, W·C words |
//! | 16 | the hash |

use super::PIECE;
use crate::player::Arrow;
use crate::saved::{ArithmeticKind, SavedField, SavedState};
use loschmidt_core::digest::{Hashing, Header, Kind, ParticleSum, hash};
use loschmidt_core::{Digest, Scale};
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

const MAGIC: &[u8; 8] = b"LSCHSNAP";
/// The newest version.
const VERSION: u64 = 2;

/// A state, where it stands in time, and the scene it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Hash of the resolved scene's text.
    pub scene: [u8; 16],
    /// Steps from home along physical time.
    pub position: i64,
    /// Direction of motion; the velocities are along it.
    pub arrow: Arrow,
    /// The state.
    pub state: SavedState,
}

/// A snapshot that cannot be read.
#[derive(Debug, Error)]
pub enum SnapshotError {
    /// The file system said no.
    #[error("cannot read snapshot {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Not a snapshot, or damaged.
    #[error("{} is not a usable snapshot: {why}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        why: Damage,
    },
}

/// What is wrong with a snapshot's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum Damage {
    /// A pipe or a device.
    #[error("it is no regular file")]
    NotAFile,
    /// The first bytes are others.
    #[error("it does not begin with LSCHSNAP")]
    NotASnapshot,
    /// Written by another version of the format.
    #[error("its format version is {0}; this program reads versions 1 to {VERSION}")]
    Version(u64),
    /// The checksum is another.
    #[error("its checksum does not match: it was cut off or changed")]
    Checksum,
    /// Counts that contradict the length of the file or one another.
    #[error("its {0} is impossible")]
    Field(&'static str),
}

impl Snapshot {
    /// The bytes of the file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // A vector takes all that is written to it.
        let _ = self.write(&mut bytes);
        bytes
    }

    /// Writes the file, in pieces.
    ///
    /// # Errors
    /// What `to` reports.
    pub fn write(&self, to: impl Write) -> io::Result<()> {
        let s = &self.state;
        let mut writer = Writer {
            to,
            piece: Vec::with_capacity(PIECE + 8),
            hashing: Hashing::default(),
        };
        let version = if is_water(s) { 1 } else { 2 };
        writer.bytes(MAGIC)?;
        writer.word(version)?;
        writer.bytes(&self.scene)?;
        for word in [
            s.dimension as i64,
            i64::from(s.arithmetic == ArithmeticKind::Float),
            i64::from(s.scale.length_exponent),
            i64::from(s.scale.speed_exponent),
            i64::from(s.scale.density_exponent),
            s.step as i64,
            self.position,
            i64::from(self.arrow == Arrow::Backward),
            s.id.len() as i64,
            s.walls as i64,
            s.fields.len() as i64,
        ] {
            writer.word(word)?;
        }
        for field in &s.fields {
            writer.field(field, s.id.len(), version)?;
        }
        s.id.iter().try_for_each(|id| writer.word(*id as i64))?;
        if version == 1 {
            let words = s.wall_fields.iter().flat_map(|field| &field.words);
            words.into_iter().try_for_each(|w| writer.word(*w))?;
            return writer.finish();
        }
        writer.word(s.wall_fields.len() as i64)?;
        for field in &s.wall_fields {
            writer.field(field, s.walls, version)?;
        }
        writer.finish()
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// [`Damage`]; nothing is allocated on the word of a damaged file.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Damage> {
        if !bytes.starts_with(MAGIC) {
            return Err(Damage::NotASnapshot);
        }
        let mut reader = Reader { rest: &bytes[8..] };
        let version = reader.word("version")? as u64;
        if !(1..=VERSION).contains(&version) {
            return Err(Damage::Version(version));
        }
        let Some((body, checksum)) = bytes.split_last_chunk::<16>() else {
            return Err(Damage::Checksum);
        };
        if hash(body) != *checksum {
            return Err(Damage::Checksum);
        }
        reader.rest = &body[16..];
        let scene = *reader.bytes::<16>("scene hash")?;
        let dimension = match reader.word("dimension")? {
            2 => 2,
            3 => 3,
            _ => return Err(Damage::Field("dimension")),
        };
        let arithmetic = match reader.word("arithmetic")? {
            0 => ArithmeticKind::Fixed,
            1 => ArithmeticKind::Float,
            _ => return Err(Damage::Field("arithmetic")),
        };
        let scale = Scale {
            length_exponent: reader.exponent()?,
            speed_exponent: reader.exponent()?,
            density_exponent: reader.exponent()?,
        };
        let step = reader.word("step")? as u64;
        let position = reader.word("position")?;
        let arrow = match reader.word("arrow")? {
            0 => Arrow::Forward,
            1 => Arrow::Backward,
            _ => return Err(Damage::Field("arrow")),
        };
        let fluid = reader.count("number of particles")?;
        let walls = reader.count("number of wall particles")?;
        let mut fields = Vec::new();
        for _ in 0..reader.count("number of fields")? {
            fields.push(reader.field(fluid, version)?);
        }
        let id: Vec<u64> = reader
            .words(fluid, "ids")?
            .into_iter()
            .map(|w| w as u64)
            .collect();
        let mut wall_fields = Vec::new();
        if version == 1 {
            let (name, parts) = (fields.get(2), [("position", dimension), ("", 1)]);
            for (known, components) in parts {
                let words = walls
                    .checked_mul(components)
                    .ok_or(Damage::Field("number of wall particles"))?;
                wall_fields.push(SavedField {
                    name: match known {
                        "" => name.map_or(String::new(), |field: &SavedField| field.name.clone()),
                        known => known.to_owned(),
                    },
                    odd: false,
                    words: reader.words(words, "walls")?,
                });
            }
        } else {
            for _ in 0..reader.count("number of wall fields")? {
                wall_fields.push(reader.field(walls, version)?);
            }
        }
        let state = SavedState {
            dimension,
            arithmetic,
            scale,
            step,
            id,
            fields,
            walls,
            wall_fields,
        };
        let ids_count_up = state.id.iter().enumerate().all(|(n, id)| *id == n as u64);
        let is_vector = |field: Option<&SavedField>, particles: usize| {
            field.is_some_and(|field| field.words.len() == particles * dimension)
        };
        let complete = is_vector(state.fields.first(), fluid)
            && is_vector(state.fields.get(1), fluid)
            && is_vector(state.wall_fields.first(), walls)
            && (version > 1 || is_water(&state));
        if !reader.rest.is_empty() || !ids_count_up || !complete {
            return Err(Damage::Field("list of fields"));
        }
        Ok(Self {
            scene,
            position,
            arrow,
            state,
        })
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`SnapshotError`], naming the file.
    pub fn read(path: &Path) -> Result<Self, SnapshotError> {
        let io = |source| SnapshotError::Io {
            path: path.to_owned(),
            source,
        };
        let damaged = |why| SnapshotError::Damaged {
            path: path.to_owned(),
            why,
        };
        let what = fs::metadata(path).map_err(io)?;
        // A pipe would be waited for, and a device has no end.
        if !what.is_file() && !what.is_dir() {
            return Err(damaged(Damage::NotAFile));
        }
        let mut file = fs::File::open(path).map_err(io)?;
        let mut bytes = Vec::new();
        let magic = MAGIC.len() as u64;
        let begun = Read::by_ref(&mut file).take(magic).read_to_end(&mut bytes);
        begun.map_err(io)?;
        if bytes != MAGIC {
            return Err(damaged(Damage::NotASnapshot));
        }
        file.read_to_end(&mut bytes).map_err(io)?;
        Self::from_bytes(&bytes).map_err(damaged)
    }

    /// The digest of the state, with the velocities along physical time.
    #[must_use]
    pub fn digest(&self) -> Digest {
        let s = &self.state;
        let mut sum = ParticleSum::default();
        let turned = |field: &SavedField, w: i64| match field.odd && self.arrow == Arrow::Backward {
            true => negated(w, s.arithmetic),
            false => w,
        };
        for (kind, fields, particles, first) in [
            (Kind::Fluid, &s.fields, s.id.len(), 0),
            (Kind::Wall, &s.wall_fields, s.walls, s.id.len()),
        ] {
            for n in 0..particles {
                let words = fields.iter().flat_map(|field| {
                    let c = field.words.len() / particles;
                    let words = field.words[n * c..(n + 1) * c].iter();
                    words.map(move |&w| turned(field, w))
                });
                sum.add(kind, (first + n) as u64, words);
            }
        }
        let names: Vec<&str> = s.fields.iter().map(|field| field.name.as_str()).collect();
        sum.finish(&Header {
            dimension: s.dimension,
            fixed_point: s.arithmetic == ArithmeticKind::Fixed,
            scale: s.scale,
            fluid: s.id.len() as u64,
            walls: s.walls as u64,
            fields: &names,
        })
    }
}

/// Whether version 1 of the format can hold the state.
fn is_water(s: &SavedState) -> bool {
    let [x, v, density] = &s.fields[..] else {
        return false;
    };
    let [wall_x, wall_density] = &s.wall_fields[..] else {
        return false;
    };
    v.name == "velocity"
        && [x.odd, v.odd, density.odd] == [false, true, false]
        && density.words.len() == s.id.len()
        && wall_x.words.len() == s.dimension * s.walls
        && wall_density.words.len() == s.walls
        && ![wall_x.odd, wall_density.odd].contains(&true)
}

fn negated(word: i64, arithmetic: ArithmeticKind) -> i64 {
    match arithmetic {
        ArithmeticKind::Fixed => word.wrapping_neg(),
        // A zero stays the positive zero.
        ArithmeticKind::Float => (0.0 - f64::from_bits(word as u64)).to_bits() as i64,
    }
}

/// Writes a file in pieces and keeps its checksum.
struct Writer<W> {
    to: W,
    piece: Vec<u8>,
    hashing: Hashing,
}

impl<W: Write> Writer<W> {
    fn word(&mut self, word: i64) -> io::Result<()> {
        self.bytes(&word.to_le_bytes())
    }
    fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.piece.extend_from_slice(bytes);
        if self.piece.len() < PIECE {
            return Ok(());
        }
        self.spill()
    }
    fn field(&mut self, field: &SavedField, particles: usize, version: i64) -> io::Result<()> {
        if version > 1 {
            self.word(i64::from(field.odd))?;
        }
        self.word(field.name.len() as i64)?;
        self.bytes(field.name.as_bytes())?;
        self.word((field.words.len() / particles.max(1)) as i64)?;
        field.words.iter().try_for_each(|w| self.word(*w))
    }
    fn spill(&mut self) -> io::Result<()> {
        self.hashing.add(&self.piece);
        self.to.write_all(&self.piece)?;
        self.piece.clear();
        Ok(())
    }
    fn finish(mut self) -> io::Result<()> {
        self.spill()?;
        self.to.write_all(&self.hashing.finish())
    }
}

/// Takes a file apart; every length is checked against what is left.
struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn slice(&mut self, length: usize, what: &'static str) -> Result<&'a [u8], Damage> {
        let (head, rest) = self
            .rest
            .split_at_checked(length)
            .ok_or(Damage::Field(what))?;
        self.rest = rest;
        Ok(head)
    }
    fn bytes<const N: usize>(&mut self, what: &'static str) -> Result<&'a [u8; N], Damage> {
        let (head, rest) = self
            .rest
            .split_first_chunk::<N>()
            .ok_or(Damage::Field(what))?;
        self.rest = rest;
        Ok(head)
    }
    fn word(&mut self, what: &'static str) -> Result<i64, Damage> {
        Ok(i64::from_le_bytes(*self.bytes(what)?))
    }
    fn exponent(&mut self) -> Result<i32, Damage> {
        match i32::try_from(self.word("scale")?) {
            Ok(e) if e.abs() < 1000 => Ok(e),
            _ => Err(Damage::Field("scale")),
        }
    }
    fn count(&mut self, what: &'static str) -> Result<usize, Damage> {
        usize::try_from(self.word(what)?).map_err(|_| Damage::Field(what))
    }
    fn field(&mut self, particles: usize, version: u64) -> Result<SavedField, Damage> {
        let odd = match version {
            1 => None,
            _ => match self.word("parity of a field")? {
                0 => Some(false),
                1 => Some(true),
                _ => return Err(Damage::Field("parity of a field")),
            },
        };
        let length = self.count("name of a field")?;
        let name = self.slice(length, "name of a field")?;
        let name = str::from_utf8(name).map_err(|_| Damage::Field("name of a field"))?;
        let components = self.count("number of components")?;
        let words = particles
            .checked_mul(components)
            .ok_or(Damage::Field("number of components"))?;
        Ok(SavedField {
            odd: odd.unwrap_or(name == "velocity"),
            name: name.to_owned(),
            words: self.words(words, "field")?,
        })
    }
    fn words(&mut self, count: usize, what: &'static str) -> Result<Vec<i64>, Damage> {
        let length = count.checked_mul(8).ok_or(Damage::Field(what))?;
        let (chunks, _) = self.slice(length, what)?.as_chunks::<8>();
        Ok(chunks.iter().map(|c| i64::from_le_bytes(*c)).collect())
    }
}
