//! A bracket around a crossing: [`Bracket`], narrowed by the Illinois variant of regula falsi (Dowell and Jarratt 1971),
//! with bisection where that stalls.

use crate::Real;

/// Greatest number of steps: bisection takes 52 from one to a rounding, and every third step bisects if need be.
pub(super) const STEPS: usize = 200;

/// Two arguments with a crossing between them; the function is negative at the lower one, and zero or more at the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Values at both, NaN if unknown; halved where the other end stays the one that moves.
    at_low: f64,
    at_high: f64,
    /// Which end moved last.
    last_high: Option<bool>,
    /// Width two moves ago, and moves since.
    before: f64,
    moves: u32,
}

impl Bracket {
    pub(super) fn new((low, at_low): (f64, f64), (high, at_high): (f64, f64)) -> Self {
        Self { low, high, at_low, at_high, last_high: None, before: f64::INFINITY, moves: 0 }
    }

    pub(super) fn width(&self) -> f64 {
        self.high - self.low
    }

    /// Where to look next, if the bracket is wider than `width`.
    pub(super) fn next(&mut self, width: f64) -> Option<f64> {
        let span = self.width();
        if span <= width {
            return None;
        }
        self.moves += 1;
        if self.moves == 3 {
            let stalled = span > 0.5 * self.before;
            (self.moves, self.before) = (0, span);
            if stalled {
                return self.middle();
            }
        }
        let secant = self.low - self.at_low * (span / (self.at_high - self.at_low));
        let known = self.at_low < 0.0 && self.at_high >= 0.0 && secant.is_finite();
        if !known || span <= 2.0 * width {
            return self.middle();
        }
        // Not nearer to an end than the width: the last move closes the bracket from the other side.
        let edge = 0.9 * width;
        let x = Real::min(Real::max(secant, self.low + edge), self.high - edge);
        if x > self.low && x < self.high { Some(x) } else { self.middle() }
    }

    /// The middle, unless there is no number between the ends.
    fn middle(&self) -> Option<f64> {
        let middle = self.low + 0.5 * self.width();
        (middle > self.low && middle < self.high).then_some(middle)
    }

    /// The value at a point between.
    pub(super) fn narrow(&mut self, x: f64, value: f64) {
        let high = value >= 0.0;
        if high {
            (self.high, self.at_high) = (x, value);
        } else {
            (self.low, self.at_low) = (x, value);
        }
        if self.last_high == Some(high) {
            if high {
                self.at_low *= 0.5;
            } else {
                self.at_high *= 0.5;
            }
        }
        self.last_high = Some(high);
    }
}
