//! SplitMix64 (Steele, Lea & Flood, OOPSLA 2014): numbers that look random and are the same on
//! every machine.

/// A generator with 64 bits of state.
#[derive(Clone, Debug)]
pub(crate) struct SplitMix64(u64);

impl SplitMix64 {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [-1, 1), a multiple of 2^-52.
    pub fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Uniform in the ball of radius 1: points of the cube until one lies in it.
    pub fn in_ball<const D: usize>(&mut self) -> [f64; D] {
        loop {
            let x: [f64; D] = std::array::from_fn(|_| self.signed());
            if x.iter().fold(0.0, |sum, x| sum + x * x) < 1.0 {
                return x;
            }
        }
    }
}
