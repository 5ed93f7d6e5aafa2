//! What can end a run: always typed, never a wrap, never a deleted particle.

use thiserror::Error;

/// Why a particle could not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum FaultKind {
    /// A position component reached 2^51 quanta.
    #[error("its position left the number range")]
    PositionRange,
    /// A velocity component reached 2^51 quanta.
    #[error("its velocity left the number range")]
    VelocityRange,
    /// A distortion or the logarithm of a volume reached 2^51 quanta.
    #[error("its distortion left the number range")]
    DistortionRange,
    /// An entropy reached 2^51 quanta.
    #[error("its entropy left the number range")]
    EntropyRange,
    /// The fraction of the normal component is not above 0 and at most 1.
    #[error(
        "its normal component is no fraction of it: the entropy is too far from that of the \
             reference temperature"
    )]
    NormalFraction,
    /// The temperature is not positive.
    #[error("its temperature is not positive: its entropy is too low or its counterflow too fast")]
    Temperature,
    /// The two copies of the counterflow are farther apart than the bound.
    #[error("the two copies of its counterflow are farther apart than the scene allows")]
    CopiesApart,
    /// No liquid is near the heater.
    #[error("no liquid is left where the heater gives its heat")]
    HeaterDry,
    /// One pair term (or the pull of gravity in one kick) reached 2^51 quanta or was not a number.
    #[error("one of its force or density terms left the number range")]
    TermRange,
    /// The density is zero or negative.
    #[error("its density is not positive")]
    DensityNotPositive,
    /// The density constants were never computed: the model's `initialise` comes first.
    #[error("the run was not initialised")]
    NotInitialised,
    /// More neighbours than an integer sum is guaranteed to hold.
    #[error("it has more than {MAX_NEIGHBOURS} neighbours")]
    Crowded,
}

/// Most neighbours in one pass over pairs.
///
/// A density takes at most two passes (fluid and walls), the particle's own term and C_a: 4,094
/// numbers of at most 2^51 each, which stay below 2^63. A velocity takes at most four in one kick
/// (pressure and repulsion, each of fluid and walls), two terms of gravity, and itself: 8,187
/// numbers. That may wrap once, but it is below 2^64 - 2^51: no sum can come back into the range
/// unseen.
pub const MAX_NEIGHBOURS: u32 = 2046;

/// A particle that could not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("particle {particle} in step {step}: {kind}")]
pub struct Fault {
    /// The reason.
    pub kind: FaultKind,
    /// Id of the particle; the smallest one where several fail in the same pass. Wall particles
    /// count on from the last fluid particle.
    pub particle: u64,
    /// Number of the step, counting from 1 over both legs of a run; 0 while it is set up. Found by
    /// a measurement, it is the number of the last step.
    pub step: u64,
}

impl Fault {
    /// A fault of this particle, in a step that the model fills in.
    #[must_use]
    pub fn new(kind: FaultKind, particle: u64) -> Self {
        Self {
            kind,
            particle,
            step: 0,
        }
    }
    /// The same fault in this step.
    #[must_use]
    pub fn at_step(self, step: u64) -> Self {
        Self { step, ..self }
    }
    /// Of two faults in one pass, the one that is reported, of the earlier step or of the smaller
    /// id: independent of who finds it first.
    #[must_use]
    pub fn first(self, other: Self) -> Self {
        if (other.step, other.particle) < (self.step, self.particle) {
            other
        } else {
            self
        }
    }
}

/// Lent memory is too small or of unequal length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("{what}: room for {needed} needed, {given} given")]
pub struct CapacityError {
    /// The slice that is too small.
    pub what: &'static str,
    /// Elements needed.
    pub needed: usize,
    /// Elements lent.
    pub given: usize,
}

/// Refuses memory that is too small.
///
/// # Errors
/// Names it.
pub fn check_capacity(
    what: &'static str,
    needed: usize,
    given: usize,
) -> Result<(), CapacityError> {
    if needed <= given {
        Ok(())
    } else {
        Err(CapacityError {
            what,
            needed,
            given,
        })
    }
}
