//! The run that the firmware and its host twin both make.
//!
//! A few hundred particles make [`STEPS`] steps, time is reversed, they make [`STEPS`] steps
//! more and time is reversed again. [`run`] returns what is needed to judge it: the digest of
//! the state at the start, at the turnaround and at the end. Its [`Display`](fmt::Display) form
//! is what both programs print, so comparing the machines is comparing text.
//!
//! The seam is [`run`] and [`Outcome`] alone. Neither program knows which particles they are or
//! what moves them.
//!
//! What moves them today is a stand-in for the dam break: anharmonic oscillators, each bound to
//! its own centre by the force f(x) = -k x / sqrt(a² + x²), stepped by Störmer–Verlet
//! (half drift, kick, half drift). It goes through what the real run needs of a microcontroller:
//! 64-bit fixed point, f64 `+ * / sqrt`, the odd rounding of drift and kick, `heapless` storage
//! and the hash.
//!
//! Exact: everything. Position and velocity are integers; each change of them is one rounding of
//! an f64 to the nearest integer, ties away from zero, so R(-x) = -R(x) and the way back undoes
//! the way out.
#![no_std]
#![forbid(unsafe_code)]

use core::fmt;
use core::hash::Hasher;

use fixed::FixedI64;
use fixed::types::extra::U46;
use heapless::Vec;
use siphasher::sip128::{Hasher128, SipHasher24};

/// Steps of each leg.
pub const STEPS: u32 = 200;

/// Particles of the run: the capacity, and the number used.
const PARTICLES: usize = 300;

/// Position in m and velocity in m/s: 46 bits behind the point, 17 before it.
type Fixed = FixedI64<U46>;

/// One fixed-point unit is 2^-46.
const UNITS_PER_ONE: f64 = (1_i64 << 46) as f64;

/// s
const TIME_STEP: f64 = 0.01;
/// m/s²
const STIFFNESS: f64 = 3.0;
/// a in m
const SOFTENING: f64 = 0.25;

/// What a run came to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outcome {
    /// Particles that took part.
    pub particles: usize,
    /// Steps of each leg.
    pub steps: u32,
    /// Digest of the first state.
    pub initial: u128,
    /// Digest of the state between the legs, before time is reversed.
    pub turnaround: u128,
    /// Digest of the last state, after reversing again.
    pub last: u128,
}

impl Outcome {
    /// Whether time came back: the last state is the first, bit for bit.
    pub fn reversed_exactly(&self) -> bool {
        self.initial == self.last
    }
}

impl fmt::Display for Outcome {
    /// One `name value` a line, digests as 32 hexadecimal digits, the last line ended too.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "particles {}", self.particles)?;
        writeln!(f, "steps {}", self.steps)?;
        writeln!(f, "digest.initial {:032x}", self.initial)?;
        writeln!(f, "digest.turnaround {:032x}", self.turnaround)?;
        writeln!(f, "digest.final {:032x}", self.last)
    }
}

/// Why a run stopped early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RunError {
    /// The storage holds fewer particles than the scene has.
    Capacity {
        /// What the storage holds.
        capacity: usize,
    },
    /// A number left the range of the fixed point.
    Range {
        /// The particle.
        particle: usize,
        /// The step, counted along both legs from 0.
        step: u32,
    },
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Capacity { capacity } => {
                write!(f, "more than the {capacity} particles there is room for")
            }
            Self::Range { particle, step } => {
                write!(
                    f,
                    "particle {particle} left the number range in step {step}"
                )
            }
        }
    }
}

impl core::error::Error for RunError {}

/// Makes the run: [`STEPS`] steps, reverse, [`STEPS`] steps, reverse.
///
/// # Errors
/// [`RunError`] where the storage is too small or a number leaves its range.
pub fn run() -> Result<Outcome, RunError> {
    let mut state = initial_state()?;
    let initial = digest(&state);
    for step in 0..STEPS {
        advance(&mut state, step)?;
    }
    let turnaround = digest(&state);
    reverse_velocities(&mut state);
    for step in STEPS..2 * STEPS {
        advance(&mut state, step)?;
    }
    reverse_velocities(&mut state);
    Ok(Outcome {
        particles: state.len(),
        steps: STEPS,
        initial,
        turnaround,
        last: digest(&state),
    })
}

#[derive(Debug, Clone, Copy)]
struct Particle {
    position: Fixed,
    velocity: Fixed,
}

type State = Vec<Particle, PARTICLES>;

fn initial_state() -> Result<State, RunError> {
    let mut state = State::new();
    for index in 0..PARTICLES {
        // Small integers over a power of two: the first state has no rounding in it.
        let particle = Particle {
            position: Fixed::from_num(index as i64 - 150) / 128,
            velocity: Fixed::from_num((index * index) as i64 % 61 - 30) / 32,
        };
        state.push(particle).map_err(|_| RunError::Capacity {
            capacity: PARTICLES,
        })?;
    }
    Ok(state)
}

fn advance(state: &mut State, step: u32) -> Result<(), RunError> {
    for (particle, body) in state.iter_mut().enumerate() {
        let range = RunError::Range { particle, step };
        for verb in [drift, kick, drift] {
            verb(body).ok_or(range)?;
        }
    }
    Ok(())
}

/// x += R(dt/2 v); `None` where x leaves its range.
fn drift(body: &mut Particle) -> Option<()> {
    let change = round(0.5 * TIME_STEP * body.velocity.to_num::<f64>())?;
    body.position = body.position.checked_add(change)?;
    Some(())
}

/// v += R(dt f(x)); `None` where v leaves its range.
fn kick(body: &mut Particle) -> Option<()> {
    let x = body.position.to_num::<f64>();
    let force = -STIFFNESS * x / libm::sqrt(SOFTENING * SOFTENING + x * x);
    body.velocity = body.velocity.checked_add(round(TIME_STEP * force)?)?;
    Some(())
}

/// Time is turned by turning the velocities. The fixed point is symmetric here: no velocity is
/// the one integer without a negative, since each is far inside the range.
fn reverse_velocities(state: &mut State) {
    for body in state {
        body.velocity = -body.velocity;
    }
}

/// The nearest fixed-point number, ties away from zero; `None` outside the range and for NaN.
fn round(value: f64) -> Option<Fixed> {
    let units = libm::round(value * UNITS_PER_ONE);
    // Below 2^62 the conversion is exact; the comparison is false for a NaN, which `as` would
    // turn into 0.
    (libm::fabs(units) < (1_i64 << 62) as f64).then(|| Fixed::from_bits(units as i64))
}

/// SipHash-2-4-128, zero key, over each particle's position and velocity as little-endian units.
fn digest(state: &State) -> u128 {
    let mut hasher = SipHasher24::new();
    for body in state {
        hasher.write(&body.position.to_bits().to_le_bytes());
        hasher.write(&body.velocity.to_bits().to_le_bytes());
    }
    // Not `as_u128`: on a big-endian machine that swaps the bytes within each half.
    u128::from_le_bytes(hasher.finish128().as_bytes())
}
