//! Stage `symbolic`: exact randomised values, by which equal expressions are found.
//!
//! In: field operations. Out: a [`Print`], the value of an expression at one random point in the field of p^2 elements
//! that a square root of [`NON_SQUARE`] makes of the integers modulo the prime p = [`PRIME`]. Two expressions with the
//! same print are equal as functions of their symbols but for a chance of about degree / p^2 (Schwartz 1980, Zippel
//! 1979). Angles are drawn as points on the circle s^2 + c^2 = 1, whose group law is exact, so sines and cosines of sums
//! agree with the addition theorems. Roots and transcendental functions of symbols get a print of their own, a hash of
//! their arguments' prints: that can miss an identity, never invent one.
//!
//! The prime is chosen for literals (see [`super::number`]). p - 1 is divisible by [`TURN`](super::modular::TURN), and by
//! four, so there is a root i of -1 and a root z of unity of that order, and with i = z^(TURN / 4) the cosine and sine of
//! 2 pi k / TURN are (z^k + z^-k) / 2 and (z^k - z^-k) / 2i. Square roots of the primes in TURN are Gauss sums of z. Every
//! other integer has a root too: modulo p, or as a multiple of the root that the field was made with.

use std::hash::{Hash, Hasher};
use std::ops::{Add, Mul, Neg, Sub};
use std::sync::OnceLock;

pub use super::modular::mix;
use crate::invariant::fault::OrFault;

use super::modular::{self, PRIMES_OF_TURN, Residue};
use super::number::Number;

/// The prime; below 2^62.
pub const PRIME: u64 = 4_580_050_217_783_040_001;

/// No square modulo the prime; the least.
pub const NON_SQUARE: u64 = 103;

/// A root of unity of order [`modular::TURN`].
const ROOT_OF_UNITY: u64 = 3_018_882_285_539_591_936;

/// Roots of [`PRIMES_OF_TURN`], which follow from the root of unity.
const ROOTS: [u64; 9] = [
    1_911_947_173_086_140_078,
    1_797_779_374_524_585_284,
    1_305_037_843_561_264_802,
    2_220_312_138_828_893_650,
    3_484_250_653_552_243_117,
    3_850_445_254_386_436_921,
    329_888_670_779_618_262,
    2_421_769_709_951_880_327,
    3_165_850_905_922_842_718,
];

/// A point on the circle: cosine and sine of an angle.
pub type Point = modular::Point<Print>;

/// Value of an expression at a random point: a + b sqrt([`NON_SQUARE`]). Rational numbers have no second part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Print(pub [u64; 2]);

/// By words: a slice is hashed byte by byte, which in a debug build is a tenth of a derivation.
impl Hash for Print {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.iter().for_each(|&word| state.write_u64(word));
    }
}

impl Print {
    pub const ZERO: Print = Print([0, 0]);
    pub const ONE: Print = Print([1, 0]);

    /// A draw that depends on `key` alone.
    pub fn draw(key: u64) -> Self {
        Print([mix(key) % PRIME, mix(mix(key ^ 0x5DEE_CE66)) % PRIME])
    }

    /// A draw for an opaque function `tag` of arguments with these prints.
    pub fn opaque(tag: u64, arguments: &[Print]) -> Self {
        let fold = |salt: u64| {
            arguments.iter().fold(mix(tag ^ salt), |h, argument| mix(mix(h ^ argument.0[0]) ^ argument.0[1])) % PRIME
        };
        Print([fold(0), fold(0x51A7)])
    }

    /// Rational numbers are; anything that depends on a symbol is not, but for a chance of 1 / p.
    pub fn is_constant(self) -> bool {
        self.0[1] == 0
    }

    pub fn is_zero(self) -> bool {
        self == Print::ZERO
    }

    /// Of `x` and `-x`, the one that stands for both in tables.
    pub fn canonical(self) -> Print {
        let first = if self.0[0] == 0 { self.0[1] } else { self.0[0] };
        if first <= PRIME / 2 { self } else { -self }
    }

    pub fn inverse(self) -> Print {
        let [a, b] = self.0;
        if b == 0 {
            return Print([modular::inverse::<PRIME>(a), 0]);
        }
        // 1 / (a + b r) = (a - b r) / (a^2 - b^2 r^2)
        let square = modular::mul::<PRIME>(modular::mul::<PRIME>(b, b), NON_SQUARE);
        let norm = modular::add::<PRIME>(modular::mul::<PRIME>(a, a), modular::neg::<PRIME>(square));
        let scale = modular::inverse::<PRIME>(norm);
        Print([modular::mul::<PRIME>(a, scale), modular::mul::<PRIME>(modular::neg::<PRIME>(b), scale)])
    }

    /// A value whose square this is, if there is one.
    pub fn root(self) -> Option<Print> {
        let [a, b] = self.0;
        if b == 0 {
            return None;
        }
        // (c + d r)^2 = a + b r: the norm is the square of c^2 - d^2 r^2, and c^2 is half of a and that.
        let (mul, add) = (modular::mul::<PRIME>, modular::add::<PRIME>);
        let square = mul(mul(b, b), NON_SQUARE);
        let norm = modular::root::<PRIME>(add(mul(a, a), modular::neg::<PRIME>(square)))?;
        let half = modular::inverse::<PRIME>(2);
        let halves = [add(a, norm), add(a, modular::neg::<PRIME>(norm))].map(|twice| mul(half, twice));
        let c = halves.into_iter().find_map(modular::root::<PRIME>)?;
        let d = mul(b, modular::inverse::<PRIME>(add(c, c)));
        let root = Print([c, d]);
        (root * root == self).then_some(root)
    }

    /// One word for hash tables.
    pub fn key(self) -> u64 {
        self.0[0] ^ self.0[1].rotate_left(32)
    }
}

impl Add for Print {
    type Output = Print;
    fn add(self, other: Print) -> Print {
        Print([modular::add::<PRIME>(self.0[0], other.0[0]), modular::add::<PRIME>(self.0[1], other.0[1])])
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
        Print([modular::neg::<PRIME>(self.0[0]), modular::neg::<PRIME>(self.0[1])])
    }
}

impl Mul for Print {
    type Output = Print;
    fn mul(self, other: Print) -> Print {
        // Written out: debug builds of users run this unoptimised, more often than anything else.
        let ([a, b], [c, d]) = (self.0, other.0);
        let (a, b, c, d) = (u128::from(a), u128::from(b), u128::from(c), u128::from(d));
        match (b, d) {
            (0, 0) => Print([modular::reduce_wide::<PRIME>(a * c), 0]),
            (0, _) => Print([modular::reduce_wide::<PRIME>(a * c), modular::reduce_wide::<PRIME>(a * d)]),
            (_, 0) => Print([modular::reduce_wide::<PRIME>(a * c), modular::reduce_wide::<PRIME>(b * c)]),
            _ => {
                let last = u128::from(modular::reduce_wide::<PRIME>(b * d));
                let first = modular::reduce_wide::<PRIME>(a * c + last * u128::from(NON_SQUARE));
                Print([first, modular::reduce_wide::<PRIME>(a * d + b * c)])
            }
        }
    }
}

impl Residue for Print {
    const ZERO: Print = Print::ZERO;
    const ONE: Print = Print::ONE;

    fn integer(n: i128) -> Print {
        Print([modular::integer::<PRIME>(n), 0])
    }

    fn inverse(self) -> Print {
        Print::inverse(self)
    }

    fn opaque(tag: u64, arguments: &[Print]) -> Print {
        Print::opaque(tag, arguments)
    }

    fn canonical(self) -> Print {
        Print::canonical(self)
    }

    fn of(n: Number) -> Print {
        n.residue
    }

    fn first_turn() -> Point {
        static POINT: OnceLock<Point> = OnceLock::new();
        *POINT.get_or_init(|| {
            let z = Print([ROOT_OF_UNITY, 0]);
            let i = Print([modular::pow::<PRIME>(ROOT_OF_UNITY, (modular::TURN / 4) as u64), 0]);
            let half = Print::integer(2).inverse();
            Point { cos: (z + z.inverse()) * half, sin: (z - z.inverse()) * half * i.inverse() }
        })
    }

    fn root_of_prime(prime: u128) -> Print {
        if let Some(at) = PRIMES_OF_TURN.iter().position(|&t| u128::from(t) == prime) {
            return Print([ROOTS[at], 0]);
        }
        let residue = (prime % u128::from(PRIME)) as u64;
        if let Some(root) = modular::root::<PRIME>(residue) {
            return Print([root, 0]);
        }
        let quotient = modular::mul::<PRIME>(residue, modular::inverse::<PRIME>(NON_SQUARE));
        Print([0, modular::root::<PRIME>(quotient).or_fault("of two numbers without a root the quotient has one")])
    }
}

/// Finds n / d with |n| and d below 2^16 that has this print (Wang 1981). One residue modulo p in 2^29 has one by chance.
pub fn reconstruct(print: Print) -> Option<(i64, i64)> {
    let bound = 1_i128 << 16;
    if !print.is_constant() {
        return None;
    }
    let (mut r0, mut r1) = (i128::from(PRIME), i128::from(print.0[0]));
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
            let (a, b, c) = (Print::draw(k), Print::draw(k + 1000), Print::draw(k + 2000));
            assert_eq!(a * a.inverse(), Print::ONE);
            assert_eq!(a + -a, Print::ZERO);
            assert_eq!((a * b) * c, a * (b * c));
            assert_eq!(a * (b + c), a * b + a * c);
            assert_eq!(a * b, b * a);
            assert_eq!((a * b).inverse(), a.inverse() * b.inverse());
            let plain = u128::from(a.0[0]) * u128::from(b.0[0]) % u128::from(PRIME);
            assert_eq!(u128::from(modular::mul::<PRIME>(a.0[0], b.0[0])), plain);
            assert_eq!(a.canonical(), (-a).canonical());
        }
        let pure = Print([0, 5]);
        assert_eq!(pure.canonical(), (-pure).canonical());
        assert_eq!(pure * pure, Print::integer(25 * i128::from(NON_SQUARE)));
        assert!(!modular::is_square::<PRIME>(NON_SQUARE));
        // The largest that is ever reduced.
        let most = 2 * u128::from(PRIME - 1) * u128::from(PRIME - 1);
        assert_eq!(u128::from(modular::reduce_wide::<PRIME>(most)), most % u128::from(PRIME));
    }

    #[test]
    fn squares_have_roots() {
        let mut squares = 0;
        for k in 0..64 {
            let x = Print::draw(k);
            let root = (x * x).root();
            assert!(root == Some(x) || root == Some(-x));
            squares += usize::from(x.root().is_some());
        }
        // Half of all values are squares.
        assert!((20..44).contains(&squares), "{squares}");
    }

    #[test]
    fn points_stay_on_the_circle() {
        let p = Point::drawn(1, Print::draw(1));
        let q = Point::drawn(1, Print::draw(2));
        for point in [p, q, p + q, p.times(5), p.times(-3), Print::first_turn()] {
            assert_eq!(point.cos * point.cos + point.sin * point.sin, Print::ONE);
        }
        assert_eq!(p.times(3) + p.times(-2), p);
        assert_eq!(Point::QUARTER.times(4), Point::ZERO);
        // A half-angle tangent of i is a point nowhere.
        let i = modular::pow::<PRIME>(ROOT_OF_UNITY, (modular::TURN / 4) as u64);
        assert_eq!(Point::from_tangent(Print([i, 0])), None);
    }

    #[test]
    fn rationals_come_back() {
        for (n, d) in [(0_i64, 1_i64), (1, 1), (-1, 1), (1, 2), (-7, 3), (12_345, 7_891)] {
            let print = Print::integer(i128::from(n)) * Print::integer(i128::from(d)).inverse();
            assert_eq!(reconstruct(print), Some((n, d)));
        }
        assert_eq!(reconstruct(Print::integer(1 << 16)), None);
    }
}
