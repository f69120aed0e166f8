//! Stage `symbolic`: functions of literals.
//!
//! In: [`Number`]s. Out: their sines, cosines, roots and other functions, exactly where they are exact. An angle is exact
//! if it is a sum of a rational multiple of pi, whose denominator [`TURN`] has, and of a rational number of radians: then
//! its point follows from a root of unity and from one drawn unit, in both fields. The functions that give angles know
//! these again: atan2(1, 1) is pi / 4.

use std::f64::consts::FRAC_PI_2;

use crate::contracts::call::Call;
use crate::invariant::fault::OrFault;

use super::check::Check;
use super::doubled::{Doubled, ROUNDING};
use super::fingerprint::{Print, mix, reconstruct};
use super::modular::{Point, Residue, TURN};
use super::number::{Number, Root};

/// Denominators up to twelve (1, 2, 3, 4, 6, 12) stay within the group of one unit.
pub(super) const PARTS: i64 = 12;

/// The unit of rational angles: 10^-18 rad and its twelfth.
const PARTS_OF_A_RADIAN: i128 = PARTS as i128 * 1_000_000_000_000_000_000;

/// Largest denominator that is looked for in multiples of pi.
const MOST_PARTS: f64 = 20_000.0;

/// `factor` times an angle that is one unit, known by its image. An irrational or odd fraction of it is a unit of its own.
pub(super) fn multiple<R: Residue>(unit: R, factor: Number, draw: impl Fn(R) -> Point<R>) -> Point<R> {
    let drawn = |unit: R, times: i128| {
        let key = unit.canonical();
        draw(key).times(if key == unit { times } else { -times })
    };
    match factor.rational().or_else(|| reconstruct(factor.residue)) {
        Some((n, d)) if PARTS % d == 0 => drawn(unit, i128::from(n) * i128::from(PARTS / d)),
        _ => drawn(unit * R::of(factor), PARTS.into()),
    }
}

/// Where a literal angle lies on the circle, and whether exactly.
pub(super) fn literal_point<R: Residue>(n: Number) -> (Point<R>, bool) {
    if n.is_zero() {
        return (Point::ZERO, true);
    }
    if let Some(quarters) = quarters(n) {
        return (Point::QUARTER.times(quarters.rem_euclid(4).into()), true);
    }
    let key = mix(0xA9_61E5);
    let drawn = |unit: R| Point::drawn(key, unit);
    let Some(form) = n.form() else { return (multiple(R::of(n), Number::ONE, drawn), false) };
    let (parts, d) = (2 * i128::from(form.parts), i128::from(form.d));
    let turns = i128::from(form.turns);
    let of_turn =
        if TURN % parts == 0 { Some(R::first_turn().times((turns * (TURN / parts)).rem_euclid(TURN))) } else { None };
    let of_radian = match i128::from(form.n).checked_mul(PARTS_OF_A_RADIAN / d) {
        _ if form.n == 0 => Some(Point::ZERO),
        Some(count) if PARTS_OF_A_RADIAN % d == 0 => Some(drawn(R::ONE).times(count)),
        _ => None,
    };
    let exact = of_turn.is_some() && of_radian.is_some();
    // Multiples of what has no exact point are at least multiples of one unit.
    let of_turn = of_turn.unwrap_or_else(|| Point::drawn(mix(key), R::integer(parts)).times(turns));
    let of_radian = of_radian.unwrap_or_else(|| Point::drawn(mix(key), R::integer(-d)).times(form.n.into()));
    (of_turn + of_radian, exact)
}

/// The number of quarter turns that a literal means: exactly, or as the decimal that rounds it to double precision.
pub(super) fn quarters(n: Number) -> Option<i64> {
    if let Some(form) = n.form()
        && form.turns != 0
    {
        return (form.n == 0 && form.parts <= 2).then(|| i64::from(form.turns) * i64::from(2 / form.parts));
    }
    let turns = (n.value() / FRAC_PI_2).round();
    if turns == 0.0 || turns.is_nan() || turns.abs() > 1e6 {
        return None;
    }
    (n.value() == multiple_of_pi(turns as i64, 2).value()).then_some(turns as i64)
}

fn multiple_of_pi(n: i64, d: i64) -> Number {
    Number::ratio(n, d) * Number::pi()
}

/// An angle typed with all its digits that is a multiple of a quarter of a degree is meant to be that.
fn meant(n: Number) -> Number {
    let count = (n.value() * 720.0 / std::f64::consts::PI).round();
    if n.is_rounded_decimal() && count != 0.0 && count.abs() < 1e6 {
        let exact = multiple_of_pi(count as i64, 720);
        // Whoever has divided pi in double precision is off by its last digit.
        if (exact.value() - n.value()).abs() <= f64::EPSILON * n.value().abs() {
            return exact;
        }
    }
    n
}

/// Sine and cosine.
pub(super) fn sin_cos(angle: Number) -> (Number, Number) {
    let angle = match quarters(angle) {
        Some(quarters) => multiple_of_pi(quarters, 2),
        None => meant(angle),
    };
    let (point, exact) = literal_point::<Print>(angle);
    let (check, _) = literal_point::<Check>(angle);
    let (sin, cos) = angle.doubled().sin_cos();
    let far = if angle.value().abs() < 1e9 { 0.0 } else { 1e-15 };
    let noise = |x: Doubled| angle.noise() + far + 8.0 * ROUNDING * x.high.abs();
    (
        Number::known(sin, noise(sin), point.sin, check.sin, exact),
        Number::known(cos, noise(cos), point.cos, check.cos, exact),
    )
}

/// The square root of a literal: of a rational number, or twice the cosine of half an angle.
pub(super) fn root(n: Number) -> Option<Root> {
    if let Some(root) = n.root() {
        return Some(root);
    }
    // sqrt(2 + 2 cos a) = 2 cos(a / 2)
    let value = n.doubled().sqrt();
    let within = value.high > 0.0 && value.high <= 2.0;
    if !n.is_exact() || !within {
        return None;
    }
    let (turns, parts) = part_of_pi((value / Doubled::new(2.0)).acos())?;
    let number = Number::integer(2) * sin_cos(multiple_of_pi(turns, parts)).1;
    let same = number * number == n && (number.value() - value.high).abs() < 1e-15;
    same.then(|| Root { number, large: Vec::new() })
}

/// The square root of a positive literal that has no exact one.
pub(super) fn opaque_root(n: Number) -> Option<Number> {
    let value = n.doubled().sqrt();
    let noise = n.noise() / value.high + 4.0 * ROUNDING * value.high;
    let is_number = value.high > 0.0 && value.is_finite() && noise.is_finite();
    is_number.then(|| Number::opaque(value, noise, 0x59, &[n]))
}

/// The simple fraction of pi that an angle seems to be; what it is taken for must be proven.
fn part_of_pi(angle: Doubled) -> Option<(i64, i64)> {
    let ratio = angle / Doubled::PI;
    let (mut n, mut d) = ([0.0, 1.0], [1.0, 0.0]);
    let mut rest = ratio.abs();
    for _ in 0..20 {
        let whole = (rest + Doubled::new(1e-20)).high.floor();
        n = [n[1], whole * n[1] + n[0]];
        d = [d[1], whole * d[1] + d[0]];
        if !(d[1] < MOST_PARTS && n[1] < 1e9) {
            return None;
        }
        let miss = ratio.abs() - Doubled::new(n[1]) / Doubled::new(d[1]);
        if miss.high.abs() < 1e-24 {
            let sign = if ratio.high < 0.0 { -1 } else { 1 };
            return Some((sign * n[1] as i64, d[1] as i64));
        }
        rest = Doubled::ONE / (rest - Doubled::new(whole));
    }
    None
}

/// The angle with this value if it is a simple fraction of pi for which `holds` says that it is.
fn exact_angle(value: Doubled, holds: impl Fn(Number, Number) -> bool) -> Option<Number> {
    let (turns, parts) = part_of_pi(value)?;
    let angle = multiple_of_pi(turns, parts);
    let (sin, cos) = sin_cos(angle);
    (sin.is_exact() && cos.is_exact() && holds(sin, cos)).then_some(angle)
}

/// Functions of literals; nothing for what has no value, or is no function of numbers.
pub(super) fn call(call: Call, arguments: &[Number]) -> Option<Number> {
    if let Some(exact) = exact(call, arguments) {
        return Some(exact);
    }
    let x = *arguments.first()?;
    // Functions of one number have no second, and none of its rounding.
    let (d, y) = (x.doubled(), arguments.get(1).map_or(Doubled::ZERO, |y| y.doubled()));
    let side = || ((Doubled::ONE - d) * (Doubled::ONE + d)).sqrt().high;
    // The value, and by how much more than the argument's its rounding is.
    let (value, slope) = match call {
        Call::Tan => (d.tan(), 1.0 + d.tan().high.powi(2)),
        Call::Asin => (d.asin(), 1.0 / side()),
        Call::Acos => (d.acos(), 1.0 / side()),
        Call::Atan => (d.atan(), 1.0),
        Call::Atan2 => (d.atan2(y), 1.0 / d.high.hypot(y.high)),
        Call::Sinh => (d.sinh(), d.cosh().high),
        Call::Cosh => (d.cosh(), d.sinh().high.abs()),
        Call::Tanh => (d.tanh(), 1.0),
        Call::Exp => (d.exp(), d.exp().high),
        Call::Ln => (d.ln(), 1.0 / d.high),
        Call::Powf => {
            let value = d.powf(y);
            (value, value.high.abs() * (d.high.abs().ln().abs() + (y.high / d.high).abs()))
        }
        _ => return None,
    };
    let noise = arguments.iter().map(|n| n.noise()).sum::<f64>() + ROUNDING * (d.high.abs() + y.high.abs());
    let noise = slope * noise + 32.0 * ROUNDING * value.high.abs();
    (value.is_finite() && noise.is_finite()).then(|| Number::opaque(value, noise, 0xCA_0000 + call.tag(), arguments))
}

fn exact(call: Call, arguments: &[Number]) -> Option<Number> {
    let first = *arguments.first()?;
    let second = || *arguments.get(1).or_fault("a function of two numbers has two arguments");
    let below = || (first - second()).is_negative();
    match call {
        Call::Abs => Some(first.abs()),
        Call::Signum if first.is_zero() => Some(first),
        Call::Signum => Some(if first.is_negative() { -Number::ONE } else { Number::ONE }),
        Call::Min => Some(if below() { first } else { second() }),
        Call::Max => Some(if below() { second() } else { first }),
        Call::Tan => {
            let (sin, cos) = sin_cos(first);
            (!cos.is_zero()).then(|| sin / cos)
        }
        Call::Exp | Call::Cosh if first.is_zero() => Some(Number::ONE),
        Call::Sinh | Call::Tanh if first.is_zero() => Some(first),
        Call::Ln if first.is_one() => Some(Number::ZERO),
        Call::Atan if first.is_zero() => Some(first),
        Call::Atan => exact_angle(first.doubled().atan(), |sin, cos| sin == first * cos),
        Call::Asin if first.is_zero() => Some(first),
        Call::Asin => exact_angle(first.doubled().asin(), |sin, _| sin == first),
        Call::Acos if first.is_one() => Some(Number::ZERO),
        Call::Acos => exact_angle(first.doubled().acos(), |_, cos| cos == first),
        Call::Atan2 if first.is_zero() && !second().is_zero() && !second().is_negative() => Some(first),
        Call::Atan2 if !(first.is_zero() && second().is_zero()) => {
            exact_angle(first.doubled().atan2(second().doubled()), |sin, cos| first * cos == second() * sin)
        }
        Call::Powf => match second().rational()? {
            (n @ -64..=64, 1) => {
                let power = first.powi(n.unsigned_abs() as u32);
                Some(if n < 0 { Number::ONE / power } else { power })
            }
            // A root whose radicand wasn't taken apart is left to the function that keeps account of these.
            (n @ -64..=64, 2) => {
                let root = root(first).filter(|root| root.large.is_empty())?.number.powi(n.unsigned_abs() as u32);
                Some(if n < 0 { Number::ONE / root } else { root })
            }
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deg(x: f64) -> Number {
        Number::decimal(x) * Number::pi() / Number::integer(180)
    }

    fn sqrt(n: i64) -> Number {
        root(Number::integer(n)).map_or(Number::ZERO, |root| root.number)
    }

    /// Equal in both fields, and in value.
    fn same(a: Number, b: Number) {
        assert_eq!(a, b);
        assert_eq!(a.check(), b.check());
        assert!((a.doubled() - b.doubled()).high.abs() <= a.noise() + b.noise(), "{a:?} {b:?}");
    }

    #[test]
    fn what_is_known_to_no_digit_is_no_number() {
        // One but for what 31 digits hold: the slope of its arc sine is infinite.
        let one = call(Call::Tanh, &[Number::integer(40)]).unwrap();
        assert!(one.doubled().high == 1.0 && !one.is_one());
        assert!(call(Call::Asin, &[one]).is_none());
        assert!(call(Call::Asin, &[call(Call::Tanh, &[Number::integer(1)]).unwrap()]).is_some());
    }

    #[test]
    fn roots_are_cosines() {
        let two = Number::integer(2);
        same(two * sin_cos(deg(45.0)).1, sqrt(2));
        same(two * sin_cos(deg(30.0)).1, sqrt(3));
        same(Number::integer(4) * sin_cos(deg(36.0)).1 - Number::ONE, sqrt(5));
        same(sin_cos(deg(36.0)).1 - sin_cos(deg(72.0)).1, Number::ratio(1, 2));
        same(sin_cos(deg(60.0)).1, Number::ratio(1, 2));
        for prime in [7_i64, 11, 13, 17, 19, 23] {
            // Gauss: the sum of (k / p) cos(2 pi k / p), or of sines where p is 3 modulo 4.
            let sum = (1..prime).fold(Number::ZERO, |sum, k| {
                let (sin, cos) = sin_cos(Number::ratio(2 * k, prime) * Number::pi());
                let term = if prime % 4 == 1 { cos } else { sin };
                let residue = (1..prime).any(|x| x * x % prime == k);
                if residue { sum + term } else { sum - term }
            });
            same(sum, sqrt(prime));
        }
    }

    #[test]
    fn points_of_angles() {
        let angles = [deg(0.25), deg(30.0), deg(-77.5), Number::decimal(0.3), Number::decimal(-1.234_567_890_12)];
        let angles = angles.into_iter().chain([Number::pi() / Number::integer(7), Number::decimal(0.1) + deg(12.0)]);
        let angles: Vec<Number> = angles.collect();
        for &a in &angles {
            let (sa, ca) = sin_cos(a);
            same(sa * sa + ca * ca, Number::ONE);
            for &b in &angles {
                let (sb, cb) = sin_cos(b);
                let (s, c) = sin_cos(a + b);
                same(s, sa * cb + ca * sb);
                same(c, ca * cb - sa * sb);
            }
            let (half, _) = sin_cos(a / Number::integer(2));
            same(Number::ONE - Number::integer(2) * half * half, ca);
        }
        same(deg(0.25) * Number::integer(4), deg(1.0));
        let typed = Number::decimal(0.523_598_775_598_298_8);
        same(sin_cos(typed).0, Number::ratio(1, 2));
        let (sin, cos) = sin_cos(Number::ZERO);
        assert!(sin.is_zero() && cos.is_exact() && cos.is_one());
        // No exact point: opaque, with the right value.
        let odd = sin_cos(Number::pi() / Number::integer(29)).0;
        assert!(!odd.is_exact() && (odd.value() - 0.108_119_018_423_941_76).abs() < 1e-16);
    }

    /// At least the rounding of the value, at most some of its and of its argument's.
    #[test]
    fn bounds_of_roundings() {
        let odd = Number::decimal(0.371);
        for function in [Call::Asin, Call::Acos, Call::Atan, Call::Sinh, Call::Cosh, Call::Tanh, Call::Exp, Call::Ln] {
            let result = call(function, &[odd]).expect("a value");
            let size = ROUNDING * result.value().abs();
            assert!(!result.is_exact() && (size..200.0 * size).contains(&result.noise()), "{function:?}: {result:?}");
        }
    }

    #[test]
    fn angles_are_known_again() {
        let quarter = call(Call::Atan2, &[Number::ONE, Number::ONE]);
        assert_eq!(quarter, Some(deg(45.0)));
        assert_eq!(call(Call::Acos, &[Number::ratio(-1, 2)]), Some(deg(120.0)));
        assert_eq!(call(Call::Asin, &[sqrt(3) / Number::integer(2)]), Some(deg(60.0)));
        assert_eq!(call(Call::Atan, &[-sqrt(3)]), Some(deg(-60.0)));
        assert_eq!(call(Call::Atan2, &[Number::ZERO, -Number::ONE]), Some(Number::pi()));
        let other = call(Call::Atan2, &[Number::ONE, Number::integer(2)]);
        assert!(other.is_some_and(|n| !n.is_exact() && (n.value() - 0.463_647_609_000_806_1).abs() < 1e-16));
        // Half an angle.
        let half = root(Number::integer(2) + Number::integer(2) * sin_cos(deg(22.5)).1);
        assert_eq!(half.map(|root| root.number), Some(Number::integer(2) * sin_cos(deg(11.25)).1));
        assert!(root(Number::integer(3) + Number::integer(2) * sqrt(2)).is_none());
        assert_eq!(call(Call::Powf, &[Number::integer(2), Number::ratio(3, 2)]), Some(Number::integer(2) * sqrt(2)));
        assert_eq!(call(Call::Max, &[sqrt(2), Number::decimal(1.414)]), Some(sqrt(2)));
        assert_eq!(call(Call::Ln, &[Number::ONE - Number::integer(2)]), None);
    }
}
