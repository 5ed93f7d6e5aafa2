//! A deterministic generator: SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).

/// Numbers that look random and are the same on every machine.
#[derive(Clone, Debug)]
pub struct Generator(u64);

impl Generator {
    /// From a seed.
    #[must_use]
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

    /// Uniform in [0, n).
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// Uniform in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// D components, each uniform in [-size, size).
    pub fn vector<const D: usize>(&mut self, size: f64) -> [f64; D] {
        core::array::from_fn(|_| size * self.signed())
    }

    /// Exchanges all places of 0..n, one after another: calls `swap(a, b)`.
    pub fn shuffle(&mut self, n: usize, mut swap: impl FnMut(usize, usize)) {
        for a in (1..n).rev() {
            swap(a, self.below(a + 1));
        }
    }
}
