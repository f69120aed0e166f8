//! Stage `symbolic`: the field of the independent check.
//!
//! In: literals. Out: their images modulo a prime of its own, q = [`PRIME`], that has nothing in common with that of the
//! prints: an error in the algebra of one isn't one in the other. q is 3 modulo 4, so roots of squares are x^((q + 1) / 4),
//! which is multiplicative: the root of a product is the product of roots, for symbols too. The circle group has q + 1
//! elements, among them all multiples of 2 pi / [`TURN`](super::modular::TURN). All primes up to 101 are squares modulo q.
//! An integer that is none has no root here: what holds one is not known, and the check says so.

use std::ops::{Add, Mul, Neg, Sub};

use super::modular::{self, Point, Residue, mix};
use super::number::Number;

/// The prime of the check.
pub const PRIME: u64 = 2_340_815_324_047_199_999;

/// Cosine and sine of 2 pi / TURN. Of all such points the one with which the roots of the primes in TURN are Gauss sums.
const FIRST_TURN: [u64; 2] = [268_790_423_207_278_775, 737_254_928_871_987_628];

/// An element, or nothing known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Check(u64);

impl Check {
    pub const UNKNOWN: Check = Check(u64::MAX);

    /// The element, if known.
    pub fn get(self) -> Option<u64> {
        (self != Check::UNKNOWN).then_some(self.0)
    }

    pub fn new(residue: u64) -> Check {
        Check(reduce(residue))
    }

    /// x^((q + 1) / 4), whose square is x where x is a square.
    pub fn root(self) -> Check {
        let Some(x) = self.get() else { return self };
        let root = modular::pow::<PRIME>(x, PRIME.div_ceil(4));
        if mul(root, root) == x { Check(root) } else { Check::UNKNOWN }
    }

    fn both(self, other: Check, f: impl Fn(u64, u64) -> u64) -> Check {
        match (self.get(), other.get()) {
            (Some(a), Some(b)) => Check(f(a, b)),
            _ => Check::UNKNOWN,
        }
    }
}

pub fn add(a: u64, b: u64) -> u64 {
    modular::add::<PRIME>(a, b)
}

pub fn mul(a: u64, b: u64) -> u64 {
    modular::mul::<PRIME>(a, b)
}

pub fn neg(a: u64) -> u64 {
    modular::neg::<PRIME>(a)
}

pub fn inverse(a: u64) -> u64 {
    modular::inverse::<PRIME>(a)
}

pub fn reduce(word: u64) -> u64 {
    word % PRIME
}

impl Add for Check {
    type Output = Check;
    fn add(self, other: Check) -> Check {
        self.both(other, add)
    }
}

impl Sub for Check {
    type Output = Check;
    fn sub(self, other: Check) -> Check {
        self + -other
    }
}

impl Neg for Check {
    type Output = Check;
    fn neg(self) -> Check {
        self.both(self, |a, _| neg(a))
    }
}

impl Mul for Check {
    type Output = Check;
    fn mul(self, other: Check) -> Check {
        self.both(other, mul)
    }
}

impl Residue for Check {
    const ZERO: Check = Check(0);
    const ONE: Check = Check(1);

    fn integer(n: i128) -> Check {
        Check(modular::integer::<PRIME>(n))
    }

    fn inverse(self) -> Check {
        self.both(self, |a, _| inverse(a))
    }

    fn opaque(tag: u64, arguments: &[Check]) -> Check {
        let hash = arguments.iter().try_fold(mix(tag), |h, argument| Some(mix(h ^ argument.get()?)));
        hash.map_or(Check::UNKNOWN, Check::new)
    }

    fn canonical(self) -> Check {
        if self.get().is_some_and(|x| x > PRIME / 2) { -self } else { self }
    }

    fn of(n: Number) -> Check {
        n.check()
    }

    fn first_turn() -> Point<Check> {
        Point { cos: Check(FIRST_TURN[0]), sin: Check(FIRST_TURN[1]) }
    }

    fn root_of_prime(prime: u128) -> Check {
        Check((prime % u128::from(PRIME)) as u64).root()
    }
}
