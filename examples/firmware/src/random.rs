//! Numbers that look random and are the same everywhere (Marsaglia's xorshift, 2003).

use crate::Scalar;

/// How a coordinate is drawn.
pub type Draw = fn(&mut Random) -> Scalar;

/// A generator with a fixed seed.
pub struct Random(u32);

impl Random {
    pub(crate) fn new() -> Self {
        Self(2_463_534_242)
    }

    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// A number between -`span` and `span`.
    pub(crate) fn within(&mut self, span: Scalar) -> Scalar {
        let centred = (self.next() >> 8) as i32 - (1 << 23);
        centred as Scalar * (span / 8_388_608.0)
    }

    /// A number of either sign, from 1.1e6 up to the greatest there is, all exponents alike.
    pub(crate) fn beyond(&mut self) -> Scalar {
        // Less than 2^21, so it can be doubled as often as this without overflow.
        const DOUBLINGS: u32 = Scalar::MAX_EXP as u32 - 21;
        let mut number = 1.5e6 + self.within(0.4e6);
        for _ in 0..self.next() % (DOUBLINGS + 1) {
            number *= 2.0;
        }
        if self.next() & 1 == 0 { number } else { -number }
    }
}
