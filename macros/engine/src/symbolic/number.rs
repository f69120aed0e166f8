//! Stage `symbolic`: literals that fold exactly.
//!
//! In: what a user wrote. Out: a [`Number`]: its value to 31 digits, a bound of the rounding in that value, and its exact
//! images in the field of the prints and in that of the check. Sums, products and quotients keep the images exact, so
//! literals cancel and coincide when they do in exact arithmetic, however they were computed; the emitted value is
//! rounded once.
//!
//! **Exact** are rational numbers, pi, square roots of rational numbers, sines and cosines of rational multiples of pi with
//! a denominator that [`TURN`](super::modular::TURN) has and of rational angles, and all sums, products and quotients of
//! these: their images are equal if and only if the numbers are, but for the chance that governs all prints. Such a number
//! is zero when its image is. If its value is lost in rounding all the same, it is no number: the model that holds it is
//! refused.
//!
//! **Opaque** is what follows from other functions (exp, ln, asin of what is no exact angle, nested roots, pi / 29). Its
//! image is a hash, which can miss an identity. So a sum that holds one is zero where its value lies below its rounding.
//!
//! No rewrite divides by a number that isn't [sharp](Number::is_sharp).

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::invariant::fault::OrFault;

use super::check::Check;
use super::doubled::{Doubled, ROUNDING};
use super::fingerprint::{Print, mix, reconstruct};
use super::modular::Residue;
use super::radical::{Radical, gcd, whole};

/// Digits of a decimal that was rounded to double precision.
const DIGITS_OF_A_ROUNDED: i64 = 10_000_000_000_000;

/// A literal: value, its rounding, and exact images.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    value: Doubled,
    noise: f64,
    pub residue: Print,
    check: Check,
    form: Form,
    exact: bool,
}

/// n / d + pi turns / parts, in lowest terms; unknown where `d` is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    pub n: i64,
    pub d: i64,
    pub turns: i32,
    pub parts: i32,
}

/// A square root, and what of its radicand may be no prime; see [`super::radical`].
pub struct Root {
    pub number: Number,
    pub large: Vec<u128>,
}

impl Number {
    pub const ZERO: Number = Number::small(0, Print::ZERO, Check::ZERO);
    pub const ONE: Number = Number::small(1, Print::ONE, Check::ONE);

    const fn small(n: i64, residue: Print, check: Check) -> Number {
        let value = Doubled::new(n as f64);
        Number { value, noise: 0.0, residue, check, form: Form { n, d: 1, turns: 0, parts: 1 }, exact: true }
    }

    /// The decimal that prints shortest among those that round to `x`: what the user has most likely written.
    /// Earlier stages refuse values that aren't finite.
    pub fn decimal(x: f64) -> Number {
        let text = format!("{x:e}");
        let (mantissa, exponent) = text.split_once('e').or_fault("a decimal is finite");
        let exponent = exponent.parse::<i32>().ok().or_fault("an exponent is an integer");
        let digits = mantissa.bytes().filter(u8::is_ascii_digit).fold(0_i64, |n, d| n * 10 + i64::from(d - b'0'));
        let fraction = mantissa.split_once('.').map_or(0, |(_, f)| f.len() as i32);
        let magnitude = Number::integer(digits);
        let power = exponent - fraction;
        let mut number = match 10_i64.checked_pow(power.unsigned_abs()) {
            Some(scale) if power < 0 => Number::ratio(digits, scale),
            Some(scale) => magnitude * Number::integer(scale),
            None => {
                let scale = Number::integer(10).powi(power.unsigned_abs());
                if power < 0 { magnitude / scale } else { magnitude * scale }
            }
        };
        // Powers of ten beyond 10^308 overflow on the way; the value itself is known.
        if !number.value.is_finite() || number.value.high != x.abs() {
            number.value = Doubled::new(x.abs());
            number.noise = x.abs() * f64::EPSILON;
        }
        if x < 0.0 { -number } else { number }
    }

    pub fn integer(n: i64) -> Number {
        let n = i128::from(n);
        let form = Form { n: n as i64, d: 1, turns: 0, parts: 1 };
        let (residue, check) = (Print::integer(n), Check::integer(n));
        Number { value: Doubled::integer(n), noise: 0.0, residue, check, form, exact: true }
    }

    /// The fraction n / d.
    pub fn ratio(n: i64, d: i64) -> Number {
        Number::integer(n) / Number::integer(d)
    }

    /// The constant pi; its images are fixed draws, as it is no algebraic number.
    pub fn pi() -> Number {
        Number {
            value: Doubled::PI,
            noise: 4.0 * ROUNDING,
            residue: Print([mix(314_159) % super::fingerprint::PRIME, 0]),
            check: Check::new(mix(271_828)),
            form: Form { n: 0, d: 1, turns: 1, parts: 1 },
            exact: true,
        }
    }

    /// A value with a bound of its rounding, whose images are known otherwise.
    pub fn known(value: Doubled, noise: f64, residue: Print, check: Check, exact: bool) -> Number {
        let number = Number { value, noise, residue, check, form: Form::UNKNOWN, exact };
        // What is rational after all is known for that.
        match reconstruct(residue) {
            Some((n, d)) if exact => {
                let rational = Number::ratio(n, d);
                let near = (rational.value - value).high.abs() <= 4.0 * noise;
                if near { rational } else { number.settled() }
            }
            _ => number.settled(),
        }
    }

    /// A value of a function that has no exact image: a hash of the function's arguments.
    pub fn opaque(value: Doubled, noise: f64, tag: u64, arguments: &[Number]) -> Number {
        let prints: Vec<Print> = arguments.iter().map(|n| n.residue).collect();
        let checks: Vec<Check> = arguments.iter().map(|n| n.check).collect();
        let (residue, check) = (Print::opaque(tag, &prints), Check::opaque(tag, &checks));
        Number { value, noise, residue, check, form: Form::UNKNOWN, exact: false }
    }

    /// What has no value: a model that holds it is refused.
    fn nothing(self) -> Number {
        let value = Doubled::new(f64::NAN);
        Number::opaque(value, f64::INFINITY, 0xBAD, &[self])
    }

    /// Rounded to double precision.
    pub fn value(self) -> f64 {
        self.value.high
    }

    /// To 31 digits.
    pub fn doubled(self) -> Doubled {
        self.value
    }

    /// A bound of the value's error.
    pub fn noise(self) -> f64 {
        self.noise
    }

    pub fn check(self) -> Check {
        self.check
    }

    pub fn print(self) -> Print {
        self.residue
    }

    /// Whether equal images mean equal numbers, and others different ones.
    pub fn is_exact(self) -> bool {
        self.exact
    }

    /// Whether a quotient by this number is known to double precision and beyond: nothing has cancelled in it.
    pub fn is_sharp(self) -> bool {
        self.noise <= 1e-20 * self.value.high.abs()
    }

    pub fn is_zero(self) -> bool {
        self.residue.is_zero()
    }

    pub fn is_one(self) -> bool {
        self.residue == Print::ONE
    }

    /// One or minus one.
    pub fn is_unit(self) -> bool {
        self.is_one() || -self.residue == Print::ONE
    }

    /// Whether the product with another is one or minus one.
    pub fn is_inverse_of(self, other: Number) -> bool {
        let product = self.residue * other.residue;
        product == Print::ONE || -product == Print::ONE
    }

    pub fn equals_up_to_sign(self, other: Number) -> bool {
        self.residue == other.residue || -self.residue == other.residue
    }

    pub fn is_negative(self) -> bool {
        self.value.high < 0.0
    }

    pub fn abs(self) -> Number {
        if self.is_negative() { -self } else { self }
    }

    /// As a rational number and a rational multiple of pi, where that is known.
    pub fn form(self) -> Option<Form> {
        (self.form.d != 0).then_some(self.form)
    }

    /// Numerator and denominator of what is known to be rational.
    pub fn rational(self) -> Option<(i64, i64)> {
        self.form().filter(|form| form.turns == 0).map(|form| (form.n, form.d))
    }

    /// Whether a user has written this number with all digits that double precision has.
    pub fn is_rounded_decimal(self) -> bool {
        self.rational().is_some_and(|(_, d)| d >= DIGITS_OF_A_ROUNDED)
    }

    pub fn powi(self, mut n: u32) -> Number {
        let (mut base, mut result) = (self, Number::ONE);
        while n > 0 {
            if n & 1 == 1 {
                result = result * base;
            }
            n >>= 1;
            if n > 0 {
                base = base * base;
            }
        }
        result
    }

    /// The square root of a rational number, exactly.
    pub fn root(self) -> Option<Root> {
        if self.is_negative() || self.is_zero() {
            return None;
        }
        let (n, d) = self.fraction()?;
        let (above, below) = (Radical::of(n), Radical::of(d));
        let value = self.value.sqrt();
        let noise = self.noise / value.high + value.high * ROUNDING;
        let residue = above.image::<Print>() * below.image::<Print>().inverse();
        let check = above.image::<Check>() * below.image::<Check>().inverse();
        let number = Number::known(value, noise, residue, check, true);
        Some(Root { number, large: above.large().chain(below.large()).collect() })
    }

    /// The length of a vector of rational numbers, whatever their number of digits.
    pub fn length(list: &[Number]) -> Option<Root> {
        let large = list.iter().copied().max_by(|a, b| a.value().abs().total_cmp(&b.value().abs()))?;
        let direct = list.iter().all(|n| n.rational().is_some());
        // Decimals with more places than an integer holds are rational to each other.
        let unit = if direct || large.is_zero() { Number::ONE } else { large.abs() };
        let fraction = |&n: &Number| match (n / unit).abs() {
            zero if zero.is_zero() => Some((0, 1)),
            ratio => ratio.fraction(),
        };
        let rationals: Option<Vec<(u128, u128)>> = list.iter().map(fraction).collect();
        let rationals = rationals?;
        let common = rationals.iter().try_fold(1_u128, |common, &(_, d)| common.checked_mul(d / gcd(common, d)))?;
        let integers: Option<Vec<u128>> = rationals.iter().map(|&(n, d)| n.checked_mul(common / d)).collect();
        let integers = integers?;
        let shared = integers.iter().fold(0, |shared, &n| gcd(n, shared));
        if shared == 0 {
            return None;
        }
        let square = integers.iter().try_fold(0_u128, |sum, n| {
            let n = n / shared;
            sum.checked_add(n.checked_mul(n)?)
        })?;
        let radical = Radical::of(square);
        let value = Doubled::integer(i128::try_from(square).ok()?).sqrt();
        let noise = 4.0 * value.high * ROUNDING;
        let root = Number::known(value, noise, radical.image(), radical.image(), true);
        let number = root * unit * Number::whole(shared)? / Number::whole(common)?;
        Some(Root { number, large: radical.large().collect() })
    }

    fn whole(n: u128) -> Option<Number> {
        if let Ok(small) = i64::try_from(n) {
            return Some(Number::integer(small));
        }
        let value = Doubled::integer(i128::try_from(n).ok()?);
        Some(Number::known(value, value.high * ROUNDING, whole(n), whole(n), true))
    }

    /// Numerator and denominator of a positive rational number: as it was made, or as the continued fraction of its value
    /// whose image is that of the number.
    fn fraction(self) -> Option<(u128, u128)> {
        if let Some((n, d)) = self.rational() {
            return Some((u128::from(n.unsigned_abs()), u128::from(d.unsigned_abs())));
        }
        if !self.residue.is_constant() || !self.exact {
            return None;
        }
        let (mut n, mut d) = ([0_u128, 1], [1_u128, 0]);
        let mut rest = self.value;
        for _ in 0..80 {
            let whole = rest.high.floor();
            let part = rest - Doubled::new(whole);
            // A value just below a whole number is rounded up to it.
            let (whole, part) = if part.high < 0.0 { (whole - 1.0, part + Doubled::ONE) } else { (whole, part) };
            if !(0.0..1e18).contains(&whole) {
                return None;
            }
            let next = |list: [u128; 2]| list[1].checked_mul(whole as u128)?.checked_add(list[0]);
            (n, d) = ([n[1], next(n)?], [d[1], next(d)?]);
            // The value has no more digits than these.
            if n[1].checked_mul(d[1])? >> 92 != 0 {
                return None;
            }
            if super::radical::whole::<Print>(n[1]) == super::radical::whole::<Print>(d[1]) * self.residue {
                return Some((n[1], d[1]));
            }
            if part.high <= 0.0 {
                return None;
            }
            rest = Doubled::ONE / part;
        }
        None
    }

    /// Zero where it is, and nothing where the value can't tell what the image says.
    fn settled(self) -> Number {
        let size = self.value.high.abs();
        if self.residue.is_zero() {
            // An image that is zero by chance, of a value that isn't.
            let differs = size.is_finite() && size > 4.0 * self.noise;
            return if differs { self.nothing() } else { Number::ZERO };
        }
        if size <= self.noise { if self.exact { self.nothing() } else { Number::ZERO } } else { self }
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        let form = Form { n: -self.form.n, turns: -self.form.turns, ..self.form };
        Number { value: -self.value, residue: -self.residue, check: -self.check, form, ..self }
    }
}

impl Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let value = self.value + other.value;
        Number {
            value,
            noise: self.noise + other.noise + value.high.abs() * ROUNDING,
            residue: self.residue + other.residue,
            check: self.check + other.check,
            form: self.form.plus(other.form),
            exact: self.exact && other.exact,
        }
        .settled()
    }
}

impl Sub for Number {
    type Output = Number;
    fn sub(self, other: Number) -> Number {
        self + -other
    }
}

impl Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        if self.is_one() || other.is_zero() {
            return other;
        }
        if other.is_one() || self.is_zero() {
            return self;
        }
        let value = self.value * other.value;
        let noise = self.value.high.abs() * other.noise + other.value.high.abs() * self.noise;
        Number {
            value,
            noise: noise + rounding(value),
            residue: self.residue * other.residue,
            check: self.check * other.check,
            form: self.form.times(other.form),
            exact: self.exact && other.exact,
        }
        .settled()
    }
}

/// The quotient; not finite where `other` is zero.
impl Div for Number {
    type Output = Number;
    fn div(self, other: Number) -> Number {
        if other.is_one() || (self.is_zero() && !other.is_zero()) {
            return self;
        }
        if other.is_zero() {
            return self.nothing();
        }
        let value = self.value / other.value;
        let noise = (self.noise + value.high.abs() * other.noise) / other.value.high.abs();
        Number {
            value,
            noise: noise + rounding(value),
            residue: self.residue * other.residue.inverse(),
            check: self.check * other.check.inverse(),
            form: self.form.over(other.form),
            exact: self.exact && other.exact,
        }
        .settled()
    }
}

/// Of a product or quotient; near the end of the range the second half of a value has no digits left.
fn rounding(value: Doubled) -> f64 {
    let size = value.high.abs();
    size * ROUNDING + if size < 1e-285 { 1e-322 } else { 0.0 }
}

impl PartialEq for Number {
    fn eq(&self, other: &Number) -> bool {
        self.residue == other.residue
    }
}

impl Form {
    const UNKNOWN: Form = Form { n: 0, d: 0, turns: 0, parts: 1 };

    fn plus(self, other: Form) -> Form {
        if self.d == 0 || other.d == 0 {
            return Form::UNKNOWN;
        }
        let rational = sum((self.n, self.d), (other.n, other.d));
        let turns = if self.turns == 0 && other.turns == 0 {
            Some((0, 1))
        } else {
            sum((self.turns.into(), self.parts.into()), (other.turns.into(), other.parts.into()))
        };
        Form::new(rational, turns)
    }

    fn times(self, other: Form) -> Form {
        if self.d == 0 || other.d == 0 || (self.turns != 0 && other.turns != 0) {
            return Form::UNKNOWN;
        }
        let rational = product((self.n, self.d), (other.n, other.d));
        let turns = match (self.turns, other.turns) {
            (0, 0) => Some((0, 1)),
            (0, _) => product((self.n, self.d), (other.turns.into(), other.parts.into())),
            _ => product((self.turns.into(), self.parts.into()), (other.n, other.d)),
        };
        Form::new(rational, turns)
    }

    fn over(self, other: Form) -> Form {
        match other {
            Form { n: 0, d: 1.., turns, parts } if self.n == 0 && self.d != 0 && turns != 0 => {
                let ratio = product(
                    (self.turns.into(), self.parts.into()),
                    (i64::from(parts) * i64::from(turns.signum()), i64::from(turns).abs()),
                );
                Form::new(ratio, Some((0, 1)))
            }
            Form { turns: 0, n, d: 1.., .. } if n != 0 && n != i64::MIN => {
                self.times(Form { n: other.d * n.signum(), d: n.abs(), ..other })
            }
            _ => Form::UNKNOWN,
        }
    }

    fn new(rational: Option<(i64, i64)>, turns: Option<(i64, i64)>) -> Form {
        let (Some((n, d)), Some((turns, parts))) = (rational, turns) else { return Form::UNKNOWN };
        match (i32::try_from(turns), i32::try_from(parts)) {
            (Ok(turns), Ok(parts)) if n != i64::MIN && turns != i32::MIN => Form { n, d, turns, parts },
            _ => Form::UNKNOWN,
        }
    }
}

fn sum((a, b): (i64, i64), (c, d): (i64, i64)) -> Option<(i64, i64)> {
    if b == d && b == 1 {
        return Some((a.checked_add(c)?, 1));
    }
    let shared = gcd64(b, d);
    let n = a.checked_mul(d / shared)?.checked_add(c.checked_mul(b / shared)?)?;
    let d = (b / shared).checked_mul(d)?;
    let shared = gcd64(n, d);
    Some((n / shared, d / shared))
}

fn product((a, b): (i64, i64), (c, d): (i64, i64)) -> Option<(i64, i64)> {
    if b == 1 && d == 1 {
        return Some((a.checked_mul(c)?, 1));
    }
    let (left, right) = (gcd64(a, d), gcd64(c, b));
    Some(((a / left).checked_mul(c / right)?, (b / right).checked_mul(d / left)?))
}

/// Greatest common divisor of what fits; positive.
fn gcd64(a: i64, b: i64) -> i64 {
    let (mut a, mut b) = (a.unsigned_abs(), b.unsigned_abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    i64::try_from(a).unwrap_or(1).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root(n: i64) -> Number {
        Number::integer(n).root().map_or(Number::ZERO, |root| root.number)
    }

    #[test]
    fn decimals_are_exact() {
        let (a, b) = (Number::decimal(0.1), Number::decimal(0.2));
        assert_eq!(a + b, Number::decimal(0.3));
        assert_eq!((a + b).value(), 0.3);
        assert!((a + b - Number::decimal(0.3)).is_zero());
        assert_eq!(Number::decimal(-2.5e-7).value(), -2.5e-7);
        assert_eq!(Number::decimal(1e-300).value(), 1e-300);
        assert_eq!(Number::decimal(5e-324).value(), 5e-324);
        assert_eq!(Number::decimal(f64::MAX).value(), f64::MAX);
    }

    #[test]
    fn digits_that_a_rounded_number_has() {
        assert!(Number::decimal(0.123_456_789_012_3).is_rounded_decimal());
        assert!(!Number::decimal(0.123_456_789_013).is_rounded_decimal());
        assert!(Number::pi().is_exact());
    }

    #[test]
    fn quotients_invert() {
        let a = Number::decimal(0.371);
        let b = Number::decimal(12.9);
        let q = a / b;
        assert_eq!(q * b, a);
        assert_eq!(q.value(), 0.028_759_689_922_480_62);
    }

    #[test]
    fn roots_are_positive_and_multiply() {
        assert_eq!(root(2) * root(3), root(6));
        assert_eq!(root(8), Number::integer(2) * root(2));
        assert_eq!(root(1061) * root(1061), Number::integer(1061));
        assert_eq!(root(1061) * root(103), root(1061 * 103));
        assert_eq!(root(1_000_003) * root(29), root(29_000_087));
        let sum = Number::ONE + root(2);
        assert_eq!(sum * sum, Number::integer(3) + Number::integer(2) * root(2));
        for a in 1..60 {
            for b in 1..60 {
                let (x, y) = (root(a) * root(b), root(a * b));
                assert_eq!(x, y, "{a} {b}");
                assert_eq!(x.check(), y.check(), "{a} {b}");
                assert!((x.value() - y.value()).abs() < 1e-13);
                let ratio = Number::ratio(a, b).root().map_or(Number::ZERO, |root| root.number);
                assert_eq!(ratio * root(b), root(a));
            }
        }
        assert_eq!(Number::ratio(9, 4).root().and_then(|root| root.number.rational()), Some((3, 2)));
        assert!((root(2) - root(2)).is_zero());
        assert_eq!((root(2) * root(2)).rational(), None);
        assert_eq!((root(2) * root(2)).root().map(|r| r.number), Some(root(2)));
    }

    #[test]
    fn directions_have_length_one() {
        let axes = [[1.0, 2.0, 3.0], [0.3, -0.5, 0.2], [0.123_456, 7.5, 1e-3], [0.866_025_403_784_438_6, 0.5, 0.1]];
        for axis in axes {
            let axis = axis.map(Number::decimal);
            let length = Number::length(&axis).map_or(Number::ZERO, |root| root.number);
            let unit = axis.map(|x| x / length);
            let square = unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2];
            assert!(square.is_one(), "{axis:?}");
            assert!(
                (length.doubled() * length.doubled()
                    - axis.iter().fold(Doubled::ZERO, |sum, x| sum + x.doubled() * x.doubled()))
                .high
                .abs()
                    < 1e-28 * length.value() * length.value()
            );
        }
    }

    /// What an exact number has lost in rounding is no number; what an opaque one has is zero.
    #[test]
    fn nothing_is_divided_by_rounding() {
        let tiny = |n: Number| n * Number::decimal(1e-17) * Number::decimal(1e-17);
        let lost = (Number::ONE + tiny(root(2))) - Number::ONE;
        assert!(lost.value().is_nan() && !lost.is_zero());
        let opaque = |x: f64| Number::opaque(Doubled::new(x), x * ROUNDING, 1, &[Number::decimal(x)]);
        let sum = (opaque(0.3) + Number::ONE) - opaque(0.3) - Number::ONE;
        assert!(sum.is_zero());
        let cancelled = root(2) - Number::decimal(std::f64::consts::SQRT_2);
        assert!(!cancelled.is_zero() && !cancelled.is_sharp() && root(2).is_sharp());
        assert!((cancelled.value() - -5.119_831_127_579_030_2e-17).abs() < 1e-30, "{:e}", cancelled.value());
        assert!(!(Number::ONE / Number::ZERO).value().is_finite());
    }
}
