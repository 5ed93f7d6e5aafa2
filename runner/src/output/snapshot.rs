//! Snapshots: a state to resume from, on disk.
//!
//! Integers only, all little-endian 64-bit words unless stated; no floating-point number, no
//! `usize`, no wall time. The file is, in this order:
//!
//! | bytes | what |
//! |---|---|
//! | 8 | ASCII `LSCHSNAP` |
//! | 8 | format version, 1 |
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

use super::PIECE;
use crate::player::Arrow;
use crate::saved::{ArithmeticKind, SavedState};
use loschmidt_core::digest::{Hashing, Header, Kind, ParticleSum, hash};
use loschmidt_core::{Digest, Scale};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

const MAGIC: &[u8; 8] = b"LSCHSNAP";
const VERSION: u64 = 1;

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
    /// The first bytes are others.
    #[error("it does not begin with LSCHSNAP")]
    NotASnapshot,
    /// Written by another version of the format.
    #[error("its format version is {0}; this program reads version {VERSION}")]
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
        writer.bytes(MAGIC)?;
        writer.word(VERSION as i64)?;
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
            s.wall_density.len() as i64,
            s.fields.len() as i64,
        ] {
            writer.word(word)?;
        }
        for (name, words) in &s.fields {
            writer.word(name.len() as i64)?;
            writer.bytes(name.as_bytes())?;
            writer.word((words.len() / s.id.len().max(1)) as i64)?;
            words.iter().try_for_each(|w| writer.word(*w))?;
        }
        s.id.iter().try_for_each(|id| writer.word(*id as i64))?;
        let walls = s.wall_position.iter().chain(&s.wall_density);
        walls.into_iter().try_for_each(|w| writer.word(*w))?;
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
        if version != VERSION {
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
            let length = reader.count("name of a field")?;
            let name = reader.slice(length, "name of a field")?;
            let name = str::from_utf8(name).map_err(|_| Damage::Field("name of a field"))?;
            let components = reader.count("number of components")?;
            let words = fluid
                .checked_mul(components)
                .ok_or(Damage::Field("number of components"))?;
            fields.push((name.to_owned(), reader.words(words, "field")?));
        }
        let id: Vec<u64> = reader
            .words(fluid, "ids")?
            .into_iter()
            .map(|w| w as u64)
            .collect();
        let coordinates = walls
            .checked_mul(dimension)
            .ok_or(Damage::Field("number of wall particles"))?;
        let state = SavedState {
            dimension,
            arithmetic,
            scale,
            step,
            id,
            fields,
            wall_position: reader.words(coordinates, "walls")?,
            wall_density: reader.words(walls, "walls")?,
        };
        let ids_count_up = state.id.iter().enumerate().all(|(n, id)| *id == n as u64);
        let vectors = state.fields.len() == 3
            && state.fields[0].1.len() == fluid * dimension
            && state.fields[1].1.len() == fluid * dimension
            && state.fields[2].1.len() == fluid;
        if !reader.rest.is_empty() || !ids_count_up || !vectors {
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
        let bytes = std::fs::read(path).map_err(|source| SnapshotError::Io {
            path: path.to_owned(),
            source,
        })?;
        Self::from_bytes(&bytes).map_err(|why| SnapshotError::Damaged {
            path: path.to_owned(),
            why,
        })
    }

    /// The digest of the state, with the velocities along physical time.
    #[must_use]
    pub fn digest(&self) -> Digest {
        let s = &self.state;
        let mut sum = ParticleSum::default();
        for (n, id) in s.id.iter().enumerate() {
            let words = s.fields.iter().flat_map(|(name, words)| {
                let c = words.len() / s.id.len();
                let turned = name == "velocity" && self.arrow == Arrow::Backward;
                words[n * c..(n + 1) * c]
                    .iter()
                    .map(move |&w| if turned { negated(w, s.arithmetic) } else { w })
            });
            sum.add(Kind::Fluid, *id, words);
        }
        for (w, density) in s.wall_density.iter().enumerate() {
            let x = &s.wall_position[w * s.dimension..(w + 1) * s.dimension];
            let id = (s.id.len() + w) as u64;
            sum.add(Kind::Wall, id, x.iter().copied().chain([*density]));
        }
        sum.finish(&Header {
            dimension: s.dimension,
            fixed_point: s.arithmetic == ArithmeticKind::Fixed,
            scale: s.scale,
            fluid: s.id.len() as u64,
            walls: s.wall_density.len() as u64,
            fields: [0, 1, 2].map(|f| s.fields[f].0.as_str()),
        })
    }
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
    fn words(&mut self, count: usize, what: &'static str) -> Result<Vec<i64>, Damage> {
        let length = count.checked_mul(8).ok_or(Damage::Field(what))?;
        let (chunks, _) = self.slice(length, what)?.as_chunks::<8>();
        Ok(chunks.iter().map(|c| i64::from_le_bytes(*c)).collect())
    }
}
