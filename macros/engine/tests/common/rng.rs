//! Random numbers for tests, the same in every run.

/// SplitMix64 (Steele et al. 2014): the same mechanisms on every machine.
pub(crate) struct Rng(u64);

impl Rng {
    pub(crate) fn new(seed: u64) -> Rng {
        Rng(seed)
    }

    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    }

    /// From zero to below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.word() % n as u64) as usize
    }

    pub(crate) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// Decimals of three places in the range.
    pub(crate) fn decimal(&mut self, from: f64, to: f64) -> f64 {
        (self.real(from, to) * 1e3).round() / 1e3
    }

    /// Uniform in the range.
    pub(crate) fn real(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.word() as f64 / 2.0_f64.powi(64))
    }
}
