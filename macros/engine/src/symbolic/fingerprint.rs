//! Stage `symbolic`: exact randomised values, by which equal expressions are found.
//!
//! In: field operations. Out: a [`Print`], the value of an expression at one random point modulo the prime
//! p = 2^61 - 1, in two independent draws. Two expressions with the same print are equal as rational functions of
//! their symbols but for a chance of about (degree / p)^2 (Schwartz 1980, Zippel 1979). Angles are drawn as points on
//! the circle s^2 + c^2 = 1, whose group law is exact modulo p, so sines and cosines of sums agree with the addition
//! theorems. Roots and transcendental functions get a print of their own, a hash of their arguments' prints: that can
//! miss an identity, never invent one.

use std::ops::{Add, Mul, Neg, Sub};

/// The prime 2^61 - 1.
pub const PRIME: u64 = (1 << 61) - 1;

/// Value of an expression at a random point, in two draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Print(pub [u64; 2]);

/// Reduces any 64-bit word modulo the prime.
pub fn reduce(x: u64) -> u64 {
    let r = (x & PRIME) + (x >> 61);
    if r >= PRIME { r - PRIME } else { r }
}

pub fn add(a: u64, b: u64) -> u64 {
    let r = a + b;
    if r >= PRIME { r - PRIME } else { r }
}

pub fn neg(a: u64) -> u64 {
    if a == 0 { 0 } else { PRIME - a }
}

pub fn mul(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    let r = (wide as u64 & PRIME) + (wide >> 61) as u64;
    if r >= PRIME { r - PRIME } else { r }
}

pub fn pow(mut base: u64, mut exponent: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul(result, base);
        }
        base = mul(base, base);
        exponent >>= 1;
    }
    result
}

/// Multiplicative inverse; zero for zero.
pub fn inverse(a: u64) -> u64 {
    pow(a, PRIME - 2)
}

/// A fixed mixing of 64 bits (SplitMix64, Steele et al. 2014): draws must be the same on every machine.
pub fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

impl Print {
    pub const ZERO: Print = Print([0, 0]);
    pub const ONE: Print = Print([1, 1]);

    /// Of a literal: the same in both draws.
    pub fn constant(residue: u64) -> Self {
        Print([residue, residue])
    }

    /// A draw that depends on `key` alone.
    pub fn draw(key: u64) -> Self {
        Print([reduce(mix(key)), reduce(mix(mix(key ^ 0x5DEE_CE66)))])
    }

    /// A draw for an opaque function `tag` of arguments with these prints.
    pub fn opaque(tag: u64, arguments: &[Print]) -> Self {
        let fold = |lane: usize| {
            let mut h = mix(tag);
            for argument in arguments {
                h = mix(h ^ argument.0[lane]);
            }
            reduce(h)
        };
        Print([fold(0), fold(1)])
    }

    /// Literals have equal draws; anything that depends on a symbol has not, but for a chance of 1 / p.
    pub fn is_constant(self) -> bool {
        self.0[0] == self.0[1]
    }

    pub fn is_zero(self) -> bool {
        self == Print::ZERO
    }

    /// Of `x` and `-x`, the one that stands for both in tables.
    pub fn canonical(self) -> Print {
        if self.0[0] <= PRIME / 2 { self } else { self.neg() }
    }

    pub fn inverse(self) -> Print {
        Print([inverse(self.0[0]), inverse(self.0[1])])
    }

    /// One word for hash tables.
    pub fn key(self) -> u64 {
        self.0[0] ^ self.0[1].rotate_left(32)
    }
}

impl Add for Print {
    type Output = Print;
    fn add(self, other: Print) -> Print {
        Print([add(self.0[0], other.0[0]), add(self.0[1], other.0[1])])
    }
}

impl Sub for Print {
    type Output = Print;
    fn sub(self, other: Print) -> Print {
        self + -other
    }
}

impl Neg for Print {
    type Output = Print;
    fn neg(self) -> Print {
        Print([neg(self.0[0]), neg(self.0[1])])
    }
}

impl Mul for Print {
    type Output = Print;
    fn mul(self, other: Print) -> Print {
        Print([mul(self.0[0], other.0[0]), mul(self.0[1], other.0[1])])
    }
}

/// A point on the circle: cosine and sine of an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point {
    pub cos: Print,
    pub sin: Print,
}

impl Point {
    pub const ZERO: Point = Point { cos: Print::ONE, sin: Print::ZERO };
    pub const QUARTER: Point = Point { cos: Print::ZERO, sin: Print::ONE };

    /// The point whose half-angle tangent is `t`.
    pub fn from_tangent(t: Print) -> Point {
        let square = t.mul(t);
        let scale = Print::ONE.add(square).inverse();
        Point { cos: Print::ONE.sub(square).mul(scale), sin: t.add(t).mul(scale) }
    }

    /// Of an integer multiple of the angle.
    pub fn times(self, k: i64) -> Point {
        let mut base = if k < 0 { self.neg() } else { self };
        let mut k = k.unsigned_abs();
        let mut result = Point::ZERO;
        while k > 0 {
            if k & 1 == 1 {
                result = result.add(base);
            }
            base = base.add(base);
            k >>= 1;
        }
        result
    }
}

/// Of the sum of two angles.
impl Add for Point {
    type Output = Point;
    fn add(self, other: Point) -> Point {
        Point { cos: self.cos * other.cos - self.sin * other.sin, sin: self.sin * other.cos + self.cos * other.sin }
    }
}

impl Neg for Point {
    type Output = Point;
    fn neg(self) -> Point {
        Point { cos: self.cos, sin: -self.sin }
    }
}

/// Finds n / d with |n| and d below 2^16 that has this residue (Wang 1981). One residue in 2^28 has one by chance.
pub fn reconstruct(residue: u64) -> Option<(i64, i64)> {
    let bound = 1_i128 << 16;
    let (mut r0, mut r1) = (i128::from(PRIME), i128::from(residue));
    let (mut t0, mut t1) = (0_i128, 1_i128);
    while r1 >= bound {
        let q = r0 / r1;
        (r0, r1) = (r1, r0 - q * r1);
        (t0, t1) = (t1, t0 - q * t1);
    }
    if t1 == 0 || t1.abs() >= bound {
        return None;
    }
    let sign = t1.signum();
    Some((i64::try_from(r1 * sign).ok()?, i64::try_from(t1.abs()).ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn field_laws_hold() {
        for k in 0..200 {
            let (a, b) = (reduce(mix(k)), reduce(mix(k + 1000)));
            assert_eq!(mul(a, inverse(a)), 1);
            assert_eq!(add(a, neg(a)), 0);
            assert_eq!(u128::from(mul(a, b)), u128::from(a) * u128::from(b) % u128::from(PRIME));
        }
    }

    #[test]
    fn points_stay_on_the_circle() {
        let p = Point::from_tangent(Print::draw(1));
        let q = Point::from_tangent(Print::draw(2));
        for point in [p, q, p.add(q), p.times(5), p.times(-3)] {
            assert_eq!(point.cos.mul(point.cos).add(point.sin.mul(point.sin)), Print::ONE);
        }
        assert_eq!(p.times(3).add(p.times(-2)), p);
        assert_eq!(Point::QUARTER.times(4), Point::ZERO);
    }

    #[test]
    fn rationals_come_back() {
        for (n, d) in [(0_i64, 1_i64), (1, 1), (-1, 1), (1, 2), (-7, 3), (12_345, 7_891)] {
            let n_mod = if n < 0 { neg(n.unsigned_abs()) } else { n.unsigned_abs() };
            assert_eq!(reconstruct(mul(n_mod, inverse(d as u64))), Some((n, d)));
        }
    }
}
