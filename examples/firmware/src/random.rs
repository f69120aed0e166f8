//! Numbers that look random and are the same everywhere (Marsaglia's xorshift, 2003).

use crate::Scalar;

/// A generator with a fixed seed.
pub struct Random(u32);

impl Random {
    pub(crate) fn new() -> Self {
        Self(2_463_534_242)
    }

    /// A number between -`span` and `span`.
    pub(crate) fn within(&mut self, span: Scalar) -> Scalar {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        let centred = (self.0 >> 8) as i32 - (1 << 23);
        centred as Scalar * (span / 8_388_608.0)
    }
}
