//! Stage `symbolic`: arithmetic modulo a prime of 62 bits, and what the two fields of the engine have in common.
//!
//! In: words. Out: sums, products, inverses and square roots modulo `P`, any prime between 2^61 and 2^62 (Barrett 1986);
//! [`Residue`], the interface of a field in which literals and angles have exact images; [`Point`], the circle over it.

use std::ops::{Add, Mul, Neg, Sub};

use crate::invariant::fault::OrFault;

use super::number::Number;

/// What the orders of both circle groups are divisible by: multiples of 2 pi / TURN have exact sines and cosines.
pub const TURN: i128 = 16_062_686_640_000;

/// The primes in [`TURN`]. Their square roots are sums of cosines of these angles.
pub const PRIMES_OF_TURN: [u64; 9] = [2, 3, 5, 7, 11, 13, 17, 19, 23];

const fn barrett(p: u64) -> u64 {
    ((1_u128 << 124) / p as u128) as u64
}

/// Reduces a number below 2 P^2.
pub fn reduce_wide<const P: u64>(x: u128) -> u64 {
    let q = (((x >> 61) * const { barrett(P) } as u128) >> 63) as u64;
    // The quotient is at most three too small, and 4 P is below 2^64.
    let mut r = (x as u64).wrapping_sub(q.wrapping_mul(P));
    while r >= P {
        r -= P;
    }
    r
}

pub fn add<const P: u64>(a: u64, b: u64) -> u64 {
    let r = a + b;
    if r >= P { r - P } else { r }
}

pub fn neg<const P: u64>(a: u64) -> u64 {
    if a == 0 { 0 } else { P - a }
}

pub fn mul<const P: u64>(a: u64, b: u64) -> u64 {
    reduce_wide::<P>(u128::from(a) * u128::from(b))
}

pub fn pow<const P: u64>(mut base: u64, mut exponent: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul::<P>(result, base);
        }
        base = mul::<P>(base, base);
        exponent >>= 1;
    }
    result
}

/// Multiplicative inverse, by Euclid's algorithm; zero for zero.
pub fn inverse<const P: u64>(a: u64) -> u64 {
    let (mut r0, mut r1) = (P, a);
    let (mut t0, mut t1) = (0_i128, 1_i128);
    while r1 != 0 {
        let q = r0 / r1;
        (r0, r1) = (r1, r0 - q * r1);
        (t0, t1) = (t1, t0 - i128::from(q) * t1);
    }
    if r0 != 1 {
        return 0;
    }
    (if t0 < 0 { t0 + i128::from(P) } else { t0 }) as u64
}

/// Of an integer of any size and sign.
pub fn integer<const P: u64>(n: i128) -> u64 {
    n.rem_euclid(i128::from(P)) as u64
}

pub fn is_square<const P: u64>(a: u64) -> bool {
    a == 0 || pow::<P>(a, (P - 1) / 2) == 1
}

/// A square root of a square (Tonelli 1891, Shanks 1973): of the two, the one that is not above P / 2.
pub fn root<const P: u64>(a: u64) -> Option<u64> {
    if a == 0 {
        return Some(0);
    }
    if !is_square::<P>(a) {
        return None;
    }
    let twos = (P - 1).trailing_zeros();
    let odd = (P - 1) >> twos;
    let other = (2..P).find(|&z| !is_square::<P>(z))?;
    let mut generator = pow::<P>(other, odd);
    let mut root = pow::<P>(a, odd.div_ceil(2));
    let mut rest = pow::<P>(a, odd);
    let mut order = twos;
    while rest != 1 {
        let (mut square, mut steps) = (rest, 0);
        while square != 1 {
            square = mul::<P>(square, square);
            steps += 1;
        }
        let factor = (0..order - steps - 1).fold(generator, |f, _| mul::<P>(f, f));
        generator = mul::<P>(factor, factor);
        root = mul::<P>(root, factor);
        rest = mul::<P>(rest, generator);
        order = steps;
    }
    Some(root.min(P - root))
}

/// A fixed mixing of 64 bits (SplitMix64, Steele et al. 2014): draws must be the same on every machine.
pub fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// An element of a field in which literals have exact images.
pub trait Residue:
    Copy + Eq + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    const ZERO: Self;
    const ONE: Self;
    fn integer(n: i128) -> Self;
    /// Zero for zero.
    fn inverse(self) -> Self;
    /// An element that depends on `tag` and these alone.
    fn opaque(tag: u64, arguments: &[Self]) -> Self;
    /// Of `x` and `-x`, the one that stands for both.
    fn canonical(self) -> Self;
    fn of(n: Number) -> Self;
    /// The point of 2 pi / [`TURN`].
    fn first_turn() -> Point<Self>;
    /// The root of a prime that stands for the positive one.
    fn root_of_prime(prime: u128) -> Self;
}

/// A point on the circle: cosine and sine of an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point<R> {
    pub cos: R,
    pub sin: R,
}

impl<R: Residue> Point<R> {
    pub const ZERO: Point<R> = Point { cos: R::ONE, sin: R::ZERO };
    pub const QUARTER: Point<R> = Point { cos: R::ZERO, sin: R::ONE };

    /// The point whose half-angle tangent is `t`, unless 1 + t^2 vanishes.
    pub fn from_tangent(t: R) -> Option<Point<R>> {
        let square = t * t;
        let scale = (R::ONE + square).inverse();
        (scale != R::ZERO).then(|| Point { cos: (R::ONE - square) * scale, sin: (t + t) * scale })
    }

    /// A point that depends on this key alone.
    pub fn drawn(tag: u64, key: R) -> Point<R> {
        // By chance 1 + t^2 vanishes once in 2^61: then another is drawn.
        let draws = (0..8).filter_map(|attempt| Point::from_tangent(R::opaque(mix(tag + attempt), &[key])));
        draws.into_iter().next().or_fault("one of eight draws is a point of the circle")
    }

    /// Of an integer multiple of the angle.
    pub fn times(self, k: i128) -> Point<R> {
        let mut base = if k < 0 { -self } else { self };
        let mut k = k.unsigned_abs();
        let mut result = Point::ZERO;
        while k > 0 {
            if k & 1 == 1 {
                result = result + base;
            }
            base = base + base;
            k >>= 1;
        }
        result
    }
}

/// Of the sum of two angles.
impl<R: Residue> Add for Point<R> {
    type Output = Point<R>;
    fn add(self, other: Point<R>) -> Point<R> {
        Point { cos: self.cos * other.cos - self.sin * other.sin, sin: self.sin * other.cos + self.cos * other.sin }
    }
}

impl<R: Residue> Neg for Point<R> {
    type Output = Point<R>;
    fn neg(self) -> Point<R> {
        Point { cos: self.cos, sin: -self.sin }
    }
}
