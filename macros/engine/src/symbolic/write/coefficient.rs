//! Stage `symbolic`, writing: literals as people write them.
//!
//! In: a number of the graph. Out: a numerator and a denominator: small fractions, decimals that end, roots and multiples of
//! pi as such, all other numbers with the seventeen digits that a double needs.

use crate::symbolic::number::Number;

use super::formula::Formula;

/// A positive number over another.
pub(super) struct Quotient {
    pub above: Vec<Formula>,
    pub below: Vec<Formula>,
}

/// Denominators that are written as such where a decimal would end too.
const MOST_COMMON: i64 = 12;
/// Beyond this many digits a fraction is not shorter than a decimal.
const MOST_DENOMINATOR: i64 = 9_999;
/// Beyond these powers of ten a decimal has one as a factor.
const MOST_ZEROS: i32 = 6;

/// The number without its sign.
pub(super) fn written(n: Number) -> Quotient {
    let n = n.abs();
    if let Some((above, below)) = n.rational() {
        return fraction(above, below).unwrap_or_else(|| decimal(n.value()));
    }
    if let Some(form) = n.form().filter(|form| form.n == 0 && form.turns != 0) {
        let (turns, parts) = (u64::from(form.turns.unsigned_abs()), u64::from(form.parts.unsigned_abs()));
        let mut above = unless_one(turns);
        above.push(Formula::Pi);
        return Quotient { above, below: unless_one(parts) };
    }
    if let Some(quotient) = root(n) {
        return quotient;
    }
    decimal(n.value())
}

fn unless_one(n: u64) -> Vec<Formula> {
    if n == 1 { Vec::new() } else { vec![Formula::integer(n)] }
}

fn fraction(above: i64, below: i64) -> Option<Quotient> {
    let (n, d) = (above.unsigned_abs(), below.unsigned_abs());
    let ends = ends(d);
    let plain = d == 1 && n < 1_000_000;
    let common = i64::try_from(d).is_ok_and(|d| d <= MOST_COMMON) && !matches!(d, 5 | 10) && n <= 1_000;
    let only = !ends && i64::try_from(d).is_ok_and(|d| d <= MOST_DENOMINATOR) && n <= 1_000_000;
    (plain || common || only).then(|| Quotient { above: unless_one(n), below: unless_one(d) })
}

/// Whether 1 / d is a decimal that ends.
fn ends(mut d: u64) -> bool {
    for prime in [2, 5] {
        while d > 1 && d.is_multiple_of(prime) {
            d /= prime;
        }
    }
    d == 1
}

/// k sqrt(r) / d.
fn root(n: Number) -> Option<Quotient> {
    let (above, below) = (n * n).rational()?;
    // sqrt(a / b) = sqrt(a b) / b, and squares go before the root.
    let radicand = above.unsigned_abs().checked_mul(below.unsigned_abs())?;
    if radicand > 1_000_000_000 || below > MOST_DENOMINATOR {
        return None;
    }
    let (mut outside, mut inside) = (1, radicand);
    let mut k = 2;
    while k * k <= inside {
        while inside.is_multiple_of(k * k) {
            inside /= k * k;
            outside *= k;
        }
        k += 1;
    }
    let mut below = below.unsigned_abs();
    let common = greatest_common_divisor(outside, below);
    (outside, below) = (outside / common, below / common);
    let mut above = unless_one(outside);
    above.push(Formula::Root(Box::new(Formula::integer(inside))));
    Some(Quotient { above, below: unless_one(below) })
}

fn greatest_common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

fn decimal(x: f64) -> Quotient {
    let text = format!("{x:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if x == 1.0 {
        // One that rounding has made.
        return Quotient { above: Vec::new(), below: Vec::new() };
    }
    if (-MOST_ZEROS..=MOST_ZEROS).contains(&exponent) {
        return Quotient { above: vec![Formula::Number(format!("{x}"))], below: Vec::new() };
    }
    let power = vec![Formula::Power(Box::new(Formula::integer(10)), exponent.unsigned_abs())];
    let mantissa = match mantissa {
        "1" => Vec::new(),
        digits => vec![Formula::Number(digits.to_owned())],
    };
    match exponent < 0 {
        true => Quotient { above: mantissa, below: power },
        false => Quotient { above: mantissa.into_iter().chain(power).collect(), below: Vec::new() },
    }
}
