//! Stage `symbolic`: square roots of rational numbers, exactly.
//!
//! In: an integer. Out: a [`Radical`], the square that it holds and the primes that are left, each once. Every prime has
//! one root in each field ([`Residue::root_of_prime`]), which stands for the positive one, so the root of a product is the
//! product of the roots. Small primes are found by division, others by Pollard's method (1975) with the test of Miller
//! and Rabin. What is left beyond 2^64 is not taken apart: it counts as a prime, and whoever uses its root must see to it
//! that no factor of it is used beside it (see [`Radical::large`]).

use super::modular::Residue;

/// Primes below it are found by division.
const SMALL: u128 = 1 << 10;

/// The root of an integer: `square` times the roots of `primes`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Radical {
    pub square: u128,
    pub primes: Vec<u128>,
}

impl Radical {
    pub fn of(mut n: u128) -> Radical {
        let mut factors = Vec::new();
        let mut divisor = 2;
        while divisor < SMALL && divisor * divisor <= n {
            while n.is_multiple_of(divisor) {
                factors.push(divisor);
                n /= divisor;
            }
            divisor += if divisor == 2 { 1 } else { 2 };
        }
        let root = n.isqrt();
        if root * root == n {
            factors.extend([root, root]);
        } else {
            take_apart(n, &mut factors);
        }
        factors.sort_unstable();
        let (mut square, mut primes) = (1_u128, Vec::new());
        let mut k = 0;
        while let Some(&prime) = factors.get(k) {
            if factors.get(k + 1) == Some(&prime) {
                square = square.saturating_mul(prime);
                k += 2;
            } else {
                primes.push(prime);
                k += 1;
            }
        }
        Radical { square, primes }
    }

    /// The root as an element of a field.
    pub fn image<R: Residue>(&self) -> R {
        self.primes.iter().fold(whole(self.square), |product, &prime| product * R::root_of_prime(prime))
    }

    /// What may be no prime, or divide what is none.
    pub fn large(&self) -> impl Iterator<Item = u128> {
        self.primes.iter().copied().filter(|&prime| prime > SMALL)
    }
}

/// An integer of any size as an element of a field.
pub fn whole<R: Residue>(n: u128) -> R {
    let half = R::integer(1 << 64);
    R::integer((n >> 64) as i128) * half + R::integer((n & u128::from(u64::MAX)) as i128)
}

pub fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// Appends the prime factors, and what is too large to be taken apart as it is.
fn take_apart(n: u128, factors: &mut Vec<u128>) {
    let mut open = vec![n];
    while let Some(n) = open.pop() {
        let divisor = u64::try_from(n).ok().filter(|&small| !is_prime(small)).and_then(divisor);
        match divisor {
            Some(d) => open.extend([u128::from(d), n / u128::from(d)]),
            None => factors.extend((n > 1).then_some(n)),
        }
    }
}

fn times(a: u64, b: u64, n: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(n)) as u64
}

/// Certain for all words, with these bases.
fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 || BASES.iter().any(|&b| n != b && n.is_multiple_of(b)) {
        return false;
    }
    if BASES.contains(&n) {
        return true;
    }
    let twos = (n - 1).trailing_zeros();
    let odd = (n - 1) >> twos;
    BASES.iter().all(|&base| {
        let (mut x, mut power, mut rest) = (1, base, odd);
        while rest > 0 {
            if rest & 1 == 1 {
                x = times(x, power, n);
            }
            power = times(power, power, n);
            rest >>= 1;
        }
        if x == 1 || x == n - 1 {
            return true;
        }
        (1..twos).any(|_| {
            x = times(x, x, n);
            x == n - 1
        })
    })
}

/// A divisor of what is no prime: Pollard's method, with a bounded number of steps.
fn divisor(n: u64) -> Option<u64> {
    if n < 4 {
        return None;
    }
    let root = n.isqrt();
    if root * root == n {
        return Some(root);
    }
    (1..8_u64).find_map(|c| {
        let step = |x: u64| ((u128::from(times(x, x, n)) + u128::from(c)) % u128::from(n)) as u64;
        let (mut slow, mut fast, mut product) = (2, 2, 1);
        for round in 1..1 << 19 {
            slow = step(slow);
            fast = step(step(fast));
            if slow == fast {
                return None;
            }
            let next = times(product, slow.abs_diff(fast), n);
            // Many differences at once; where they meet zero, one of the last ones alone is the divisor.
            if next == 0 || round % 32 == 0 {
                for x in [product, slow.abs_diff(fast)] {
                    let d = gcd(u128::from(x), u128::from(n)) as u64;
                    if d > 1 && d < n {
                        return Some(d);
                    }
                }
                product = 1;
            } else {
                product = next;
            }
        }
        None
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(n: u128) -> (u128, Vec<u128>) {
        let radical = Radical::of(n);
        let product: u128 = radical.primes.iter().product();
        assert_eq!(radical.square * radical.square * product, n);
        (radical.square, radical.primes)
    }

    #[test]
    fn primes_are_known() {
        let by_division = |n: u64| n > 1 && (2..n).take_while(|d| d * d <= n).all(|d| !n.is_multiple_of(d));
        for n in (0..3000).chain([1_000_003, 4_294_967_291, 4_294_967_293]) {
            assert_eq!(is_prime(n), by_division(n), "{n}");
        }
        // Strong pseudoprimes to the first four and the first nine primes; two products of primes that are 3 modulo 4.
        for n in [3_215_031_751, 3_825_123_056_546_413_051, 1063 * 1087, 4_294_967_291 * 4_294_967_279] {
            assert!(!is_prime(n), "{n}");
        }
    }

    #[test]
    fn integers_beyond_a_word_are_elements() {
        use crate::symbolic::fingerprint::Print;
        for n in [5, (1 << 64) + 5, (7 << 70) + (1 << 40) + 3] {
            assert_eq!(whole::<Print>(n), Print::integer(n as i128), "{n}");
        }
    }

    #[test]
    fn integers_are_taken_apart() {
        assert_eq!(parts(1), (1, vec![]));
        assert_eq!(parts(72), (6, vec![2]));
        assert_eq!(parts(1061), (1, vec![1061]));
        assert_eq!(parts(1_000_003 * 1_000_033), (1, vec![1_000_003, 1_000_033]));
        assert_eq!(parts(1_000_003 * 1_000_003 * 7), (1_000_003, vec![7]));
        assert_eq!(parts(4_294_967_291 * 4_294_967_279), (1, vec![4_294_967_279, 4_294_967_291]));
        let large = (1_u128 << 89) - 1;
        assert_eq!(parts(large), (1, vec![large]));
        assert_eq!(Radical::of(large * 9).square, 3);
        assert_eq!(parts(1_000_003 * 1_000_003), (1_000_003, vec![]));
    }
}
