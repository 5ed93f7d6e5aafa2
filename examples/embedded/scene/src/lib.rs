//! The run that the firmware and its host twins all make: a small dam break, there and back.
//!
//! A column of water, 1 m wide and 2 m high, stands at the left wall of an open box and falls for
//! [`STEPS`] steps; time is reversed, it makes [`STEPS`] steps more, and time is reversed again.
//! [`run`] returns what is needed to judge it: the digest of the state at the start, at the
//! turnaround and at the end. The [`Display`](fmt::Display) form of the [`Outcome`] is what every
//! program prints, so comparing the machines is comparing text.
//!
//! The parameters are those of Kincl & Pavelka, Comput. Phys. Commun. 284 (2023) 108593, Table 1,
//! but for the spacing dr (11 particles across the column instead of 200) and the speed of sound
//! (10 sqrt(2 g H) instead of 19 sqrt(2 g H)): with few particles and large steps, a processor
//! without an f64 unit gets somewhere in its minute.
//!
//! Exact: everything. The set-up is a few `+ - * /` of literals in f64, rounded once into the
//! state; from there on the core's contract holds. [`GOLDEN`] are the digests that every machine
//! must print.
#![no_std]
#![forbid(unsafe_code)]

use core::fmt;

use loschmidt_core::fault::CapacityError;
use loschmidt_core::integrator::STORMER_VERLET;
use loschmidt_core::model::{Model, SetupError};
use loschmidt_core::number::{Fixed, Scale};
use loschmidt_core::owned::{Owned, PushError, words};
use loschmidt_core::schemes::wcsph::{
    DensityCorrection, Gravity, Parameters, StateEquation, Symplectic, Wall,
};
use loschmidt_core::{Digest, Fault, Serial};

/// Steps of each leg.
pub const STEPS: u32 = 300;

/// The digests of the start, the turnaround and the end, which is the start again.
///
/// They change with the arithmetic of the core and with nothing else.
pub const GOLDEN: [Digest; 3] = [
    Digest(0xf1ca_8d1f_b172_9688_463a_1ea1_3921_60d8_u128.to_be_bytes()),
    Digest(0x6eb7_5394_e68b_764c_3b10_8e15_865d_48a0_u128.to_be_bytes()),
    Digest(0xf1ca_8d1f_b172_9688_463a_1ea1_3921_60d8_u128.to_be_bytes()),
];

/// Water in spacings: 1 m x 2 m.
const COLUMN: [i32; 2] = [11, 22];
/// The inside of the box in spacings: 4 m x 3 m, open at the top.
const BOX: [i32; 2] = [44, 33];
/// Rows of wall particles.
const WALL_ROWS: i32 = 3;

const FLUID: usize = (COLUMN[0] * COLUMN[1]) as usize;
const WALLS: usize = ((BOX[0] + 2 * WALL_ROWS) * (BOX[1] + WALL_ROWS) - BOX[0] * BOX[1]) as usize;
/// Enough for cells as wide as a wall particle reaches.
const BUCKETS: usize = 2048;

/// dr, m.
const SPACING: f64 = 1.0 / COLUMN[0] as f64;
/// H, m.
const HEIGHT: f64 = 2.0;
/// g, m/s².
const GRAVITY: f64 = 9.8;
/// ρ0, kg/m³.
const DENSITY: f64 = 1000.0;
/// c, m/s: 10 sqrt(2 g H), to three digits.
const SOUND_SPEED: f64 = 62.6;
/// h, m.
const SUPPORT_RADIUS: f64 = 3.0 * SPACING;

type Water = Symplectic<Fixed, 2>;

/// Words for the fields of water and walls.
const WORDS: usize = words(<Water as Model<Fixed, 2>>::FIELDS, 2, FLUID, WALLS);

/// The system, with all of its memory: about 63 kB.
pub type Dam = Owned<Fixed, Water, 2, FLUID, WALLS, { BUCKETS + 1 }, WORDS>;

/// What a run came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// Fluid particles.
    pub fluid: usize,
    /// Wall particles.
    pub walls: usize,
    /// Steps of each leg.
    pub steps: u32,
    /// How far the water reaches from the left wall at the turnaround, in whole millimetres.
    pub front_mm: i64,
    /// Digest of the first state.
    pub initial: Digest,
    /// Digest of the state between the legs, before time is reversed.
    pub turnaround: Digest,
    /// Digest of the last state, after reversing again.
    pub last: Digest,
}

impl Outcome {
    /// Whether time came back: something had happened, and the last state is the first, bit for
    /// bit.
    pub fn reversed_exactly(&self) -> bool {
        self.initial != self.turnaround && self.initial == self.last
    }

    /// The three digests, to be compared with [`GOLDEN`].
    pub fn digests(&self) -> [Digest; 3] {
        [self.initial, self.turnaround, self.last]
    }
}

impl fmt::Display for Outcome {
    /// One `name value` a line, the last line ended too.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "fluid {}", self.fluid)?;
        writeln!(f, "walls {}", self.walls)?;
        writeln!(f, "steps {}", self.steps)?;
        writeln!(f, "front_mm {}", self.front_mm)?;
        writeln!(f, "digest.initial {}", self.initial)?;
        writeln!(f, "digest.turnaround {}", self.turnaround)?;
        writeln!(f, "digest.final {}", self.last)
    }
}

/// Why a run stopped early.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RunError {
    /// No model can be built from the parameters.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The grid or the fields are larger than the memory for them.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// A particle was not taken.
    #[error(transparent)]
    Push(#[from] PushError<2>),
    /// A particle could not go on.
    #[error(transparent)]
    Fault(#[from] Fault),
}

/// Makes the run on the stack: [`STEPS`] steps, reverse, [`STEPS`] steps, reverse.
///
/// # Errors
/// [`RunError`], whichever part of the run it stopped.
pub fn run() -> Result<Outcome, RunError> {
    run_in(&mut None)
}

/// Makes the run in memory of the caller's choice, such as a static, and leaves the last state
/// there.
///
/// # Errors
/// As [`run`].
pub fn run_in(place: &mut Option<Dam>) -> Result<Outcome, RunError> {
    let dam = place.insert(Dam::new(Water::new(parameters())?)?);
    fill(dam)?;
    dam.initialise(&Serial)?;
    let initial = dam.digest();
    dam.advance(u64::from(STEPS), &Serial)?;
    let turnaround = dam.digest();
    let front_mm = front_mm(dam);
    dam.reverse();
    dam.advance(u64::from(STEPS), &Serial)?;
    dam.reverse();
    let last = dam.digest();
    let (_, system) = dam.parts();
    Ok(Outcome {
        fluid: system.particles.len(),
        walls: system.walls.len(),
        steps: STEPS,
        front_mm,
        initial,
        turnaround,
        last,
    })
}

fn parameters() -> Parameters<2> {
    Parameters {
        support_radius: SUPPORT_RADIUS,
        time_step: 0.2 * SUPPORT_RADIUS / SOUND_SPEED,
        mass: DENSITY * SPACING * SPACING,
        reference_density: DENSITY,
        sound_speed: SOUND_SPEED,
        state_equation: StateEquation::Tait,
        density_correction: DensityCorrection::Constant,
        gravity: Gravity {
            uniform: [0.0, -GRAVITY],
            central: None,
        },
        wall: Wall::Conservative {
            energy: 10.0 * GRAVITY * HEIGHT,
            radius: 0.95 * SPACING,
            softening: 0.0,
        },
        anti_clump: None,
        filter_every: 0,
        integrator: &STORMER_VERLET,
        // Positions below 32 m, velocities below 2048 m/s, densities below 2048 kg/m³.
        scale: Scale {
            length_exponent: 0,
            speed_exponent: 0,
            density_exponent: 0,
        },
        extent: BOX.map(|n| f64::from(n) * SPACING),
        max_buckets: BUCKETS,
    }
}

/// Water and walls on one square lattice, row after row from the bottom.
fn fill(dam: &mut Dam) -> Result<(), PushError<2>> {
    for j in -WALL_ROWS..BOX[1] {
        for i in -WALL_ROWS..BOX[0] + WALL_ROWS {
            let position = [i, j].map(|n| (f64::from(n) + 0.5) * SPACING);
            let inside = (0..BOX[0]).contains(&i) && j >= 0;
            if !inside {
                dam.push_wall(position)?;
            } else if i < COLUMN[0] && j < COLUMN[1] {
                dam.push_fluid(position, [0.0, 0.0])?;
            }
        }
    }
    Ok(())
}

/// The rightmost particle's distance from the left wall, cut to whole millimetres.
fn front_mm(dam: &mut Dam) -> i64 {
    let (_, system) = dam.parts();
    let rightmost = system.particles.position().iter().map(|x| x[0]).max();
    // Integers throughout; 2^46 quanta are a metre.
    rightmost.map_or(0, |x| ((i128::from(x.to_bits()) * 1000) >> 46) as i64)
}
