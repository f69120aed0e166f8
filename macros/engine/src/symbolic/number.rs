//! Stage `symbolic`: literals that fold exactly.
//!
//! In: the decimals that a user wrote. Out: a [`Number`]: its value to 32 digits (double-double; Dekker 1971, Knuth) and
//! its exact residue modulo the prime of [`super::fingerprint`]. Sums, products and quotients keep the residue exact, so
//! literals cancel and coincide when they do in exact arithmetic, however they were computed; the emitted value is
//! rounded once.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::fingerprint::{self as field, Print};

/// A literal: value and exact residue.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    high: f64,
    low: f64,
    pub residue: u64,
}

impl Number {
    pub const ZERO: Number = Number { high: 0.0, low: 0.0, residue: 0 };
    pub const ONE: Number = Number { high: 1.0, low: 0.0, residue: 1 };

    /// The decimal that prints shortest among those that round to `x`: what the user has most likely written.
    /// Zero for values that aren't finite, which earlier stages refuse.
    pub fn decimal(x: f64) -> Number {
        let text = format!("{x:e}");
        let Some((mantissa, exponent)) = text.split_once('e') else { return Number::ZERO };
        let Ok(exponent) = exponent.parse::<i32>() else { return Number::ZERO };
        let digits = mantissa.bytes().filter(u8::is_ascii_digit).fold(0_i64, |n, d| n * 10 + i64::from(d - b'0'));
        let fraction = mantissa.split_once('.').map_or(0, |(_, f)| f.len() as i32);
        let magnitude = Number::integer(digits);
        let power = exponent - fraction;
        let scale = Number::integer(10).powi(power.unsigned_abs());
        let mut number = if power < 0 { magnitude.div(scale) } else { magnitude.mul(scale) };
        // Powers of ten beyond 10^308 overflow on the way; the value itself is known.
        if !(number.high.is_finite() && number.low.is_finite()) || number.high != x.abs() {
            (number.high, number.low) = (x.abs(), 0.0);
        }
        if x < 0.0 { number.neg() } else { number }
    }

    pub fn integer(n: i64) -> Number {
        let high = n as f64;
        let low = (i128::from(n) - high as i128) as f64;
        let residue = field::reduce(n.unsigned_abs());
        Number { high, low, residue: if n < 0 { field::neg(residue) } else { residue } }
    }

    /// The constant pi; its residue is a fixed draw, as it is no rational.
    pub fn pi() -> Number {
        Number {
            high: std::f64::consts::PI,
            low: 1.224_646_799_147_353_2e-16,
            residue: field::reduce(field::mix(314_159)),
        }
    }

    /// A value known to double precision with a residue known otherwise (sine of a literal, a root).
    pub fn transcendental(value: f64, residue: u64) -> Number {
        Number { high: value, low: 0.0, residue }
    }

    /// Rounded to double precision.
    pub fn value(self) -> f64 {
        self.high
    }

    pub fn low(self) -> f64 {
        self.low
    }

    pub fn print(self) -> Print {
        Print::constant(self.residue)
    }

    pub fn is_zero(self) -> bool {
        self.residue == 0
    }

    pub fn is_one(self) -> bool {
        self.residue == 1
    }

    /// One or minus one.
    pub fn is_unit(self) -> bool {
        self.residue == 1 || self.residue == field::PRIME - 1
    }

    pub fn is_negative(self) -> bool {
        self.high < 0.0
    }

    pub fn abs(self) -> Number {
        if self.is_negative() { self.neg() } else { self }
    }

    fn powi(self, mut n: u32) -> Number {
        let (mut base, mut result) = (self, Number::ONE);
        while n > 0 {
            if n & 1 == 1 {
                result = result.mul(base);
            }
            base = base.mul(base);
            n >>= 1;
        }
        result
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        Number { high: -self.high, low: -self.low, residue: field::neg(self.residue) }
    }
}

impl Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        let residue = field::add(self.residue, other.residue);
        if residue == 0 {
            return Number::ZERO;
        }
        let (s, e) = two_sum(self.high, other.high);
        let (high, low) = quick_two_sum(s, e + self.low + other.low);
        Number { high, low, residue }
    }
}

impl Sub for Number {
    type Output = Number;
    fn sub(self, other: Number) -> Number {
        self.add(other.neg())
    }
}

impl Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        let p = self.high * other.high;
        let e = self.high.mul_add(other.high, -p);
        let (high, low) = quick_two_sum(p, e + self.high * other.low + self.low * other.high);
        Number { high, low, residue: field::mul(self.residue, other.residue) }
    }
}

/// The quotient; not finite where `other` is zero.
impl Div for Number {
    type Output = Number;
    fn div(self, other: Number) -> Number {
        let q = self.high / other.high;
        let rest = q.mul_add(-other.high, self.high) + self.low - q * other.low;
        let (high, low) = quick_two_sum(q, rest / other.high);
        Number { high, low, residue: field::mul(self.residue, field::inverse(other.residue)) }
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Number) -> bool {
        self.residue == other.residue
    }
}

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    // Beyond the range there are no further digits, and infinity minus itself is no number.
    if s.is_finite() { (s, b - (s - a)) } else { (if a.is_finite() { s } else { a }, 0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact() {
        let (a, b) = (Number::decimal(0.1), Number::decimal(0.2));
        assert_eq!(a.add(b), Number::decimal(0.3));
        assert_eq!(a.add(b).value(), 0.3);
        assert!(a.add(b).sub(Number::decimal(0.3)).is_zero());
        assert_eq!(Number::decimal(-2.5e-7).value(), -2.5e-7);
        assert_eq!(Number::decimal(1e-300).value(), 1e-300);
        assert_eq!(Number::decimal(5e-324).value(), 5e-324);
        assert_eq!(Number::decimal(f64::MAX).value(), f64::MAX);
    }

    #[test]
    fn quotients_invert() {
        let a = Number::decimal(0.371);
        let b = Number::decimal(12.9);
        let q = a.div(b);
        assert_eq!(q.mul(b), a);
        assert_eq!(q.value(), 0.028_759_689_922_480_62);
    }
}
