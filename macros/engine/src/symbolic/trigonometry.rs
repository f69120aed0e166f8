//! Stage `symbolic`: angles, their sines and cosines.
//!
//! In: an angle, any scalar. Out: its point on the circle modulo the prime, and nodes for sine and cosine. An angle is
//! read as a sum of units with rational factors and a literal. Each unit is drawn as a twelfth of itself, and decimal
//! literals on the common base of 1e-9 rad, so halves, thirds, sums and differences of angles agree exactly with the
//! addition theorems. Multiples of a quarter turn are exact.

use std::ops::{Add, Div, Mul, Neg};

use super::fingerprint::{self as field, Point, Print, mix, reconstruct};
use super::graph::{Graph, Scalar, ScalarNode};
use super::number::Number;

/// Denominators up to twelve (1, 2, 3, 4, 6, 12) stay within the group of one unit.
pub(super) const PARTS: i64 = 12;

impl Graph {
    pub fn sin(&mut self, angle: Scalar) -> Scalar {
        if angle.is_negative() {
            return -self.sin(-angle);
        }
        match self.quarter_turns(angle) {
            (Scalar::ZERO, 0 | 2) => Scalar::ZERO,
            (Scalar::ZERO, k) => {
                if k == 1 {
                    Scalar::ONE
                } else {
                    -Scalar::ONE
                }
            }
            (rest, 1) => self.cos(rest),
            (rest, 2) => -self.sin(rest),
            (rest, 3) => -self.cos(rest),
            _ => {
                let print = self.point(angle).sin;
                self.trigonometric(ScalarNode::Sin(angle), angle, print, f64::sin_cos)
            }
        }
    }

    pub fn cos(&mut self, angle: Scalar) -> Scalar {
        let angle = angle.positive();
        match self.quarter_turns(angle) {
            (Scalar::ZERO, 1 | 3) => Scalar::ZERO,
            (Scalar::ZERO, k) => {
                if k == 0 {
                    Scalar::ONE
                } else {
                    -Scalar::ONE
                }
            }
            (rest, 1) => -self.sin(rest),
            (rest, 2) => -self.cos(rest),
            (rest, 3) => self.sin(rest),
            _ => {
                let print = self.point(angle).cos;
                let swapped = |x: f64| (x.cos(), -x.sin());
                self.trigonometric(ScalarNode::Cos(angle), angle, print, swapped)
            }
        }
    }

    /// A literal's value, with its derivative's help for the digits beyond double precision, or a node.
    fn trigonometric(
        &mut self,
        node: ScalarNode,
        angle: Scalar,
        print: Print,
        f: impl Fn(f64) -> (f64, f64),
    ) -> Scalar {
        if let Some(found) = self.find(print) {
            return found;
        }
        match self.literal(angle) {
            Some(n) => {
                let (value, slope) = f(n.value());
                self.number(Number::transcendental(value + slope * n.low(), print.0[0]))
            }
            None => self.insert_scalar(node, print),
        }
    }

    /// Splits an angle into the rest and a number of quarter turns, 0 to 3.
    fn quarter_turns(&mut self, angle: Scalar) -> (Scalar, u8) {
        let term = match self.node(angle) {
            ScalarNode::Literal(_) => angle,
            ScalarNode::Sum(terms) => match terms.last() {
                Some(&last) => last.flip_if(angle.is_negative()),
                None => return (angle, 0),
            },
            _ => return (angle, 0),
        };
        match self.literal(term).and_then(quarters) {
            Some(turns) if turns != 0 => (self.sub(angle, term), turns.rem_euclid(4) as u8),
            _ => (angle, 0),
        }
    }

    /// Where an angle lies on the circle modulo the prime.
    pub fn point(&self, angle: Scalar) -> Point {
        let mut point = Point::ZERO;
        let mut constant = Number::ZERO;
        self.add_angle(angle, Number::ONE, &mut point, &mut constant);
        point.add(literal_point(constant))
    }

    fn add_angle(&self, angle: Scalar, factor: Number, point: &mut Point, constant: &mut Number) {
        let factor = if angle.is_negative() { factor.neg() } else { factor };
        match self.node(angle) {
            ScalarNode::Literal(n) => *constant = constant.add(n.mul(factor)),
            ScalarNode::Sum(terms) => {
                for &t in terms {
                    self.add_angle(t, factor, point, constant);
                }
            }
            ScalarNode::Product(factors) if factors.len() == 2 && self.literal(factors[0]).is_some() => {
                let rest = factors[1];
                if let Some(n) = self.literal(factors[0]) {
                    self.add_angle(rest, factor.mul(n), point, constant);
                }
            }
            _ => {
                let print = self.print(angle.positive());
                *point = point.add(unit_point(print, factor));
            }
        }
    }
}

/// The number of quarter turns that a literal means: exactly, or as the decimal that rounds it to double precision.
fn quarters(n: Number) -> Option<i64> {
    let turns = (n.value() / std::f64::consts::FRAC_PI_2).round();
    if turns.abs() > 1e6 {
        return None;
    }
    let exact = Number::integer(turns as i64).mul(Number::pi()).div(Number::integer(2));
    (n.residue == exact.residue || (turns != 0.0 && n.value() == exact.value())).then_some(turns as i64)
}

/// `factor` times the unit with this print.
fn unit_point(print: Print, factor: Number) -> Point {
    let key = print.canonical();
    let sign = if key == print { 1 } else { -1 };
    // The same mixing in both draws: a literal, whose draws agree, is a literal point.
    let draw = |print: Print| Point::from_tangent(Print(print.0.map(|lane| field::reduce(mix(lane ^ 0xA9_61E5)))));
    match reconstruct(factor.residue) {
        Some((n, d)) if PARTS % d == 0 && n.abs() < 1 << 20 => draw(key).times(sign * n * (PARTS / d)),
        // An irrational or odd fraction of a unit is a unit of its own.
        _ => {
            let scaled = key.mul(factor.print());
            let scaled_key = scaled.canonical();
            let scaled_sign = if scaled_key == scaled { 1 } else { -1 };
            draw(scaled_key).times(sign * scaled_sign)
        }
    }
}

/// A literal angle: quarter turns are exact, decimals up to nine places are multiples of one base, others are opaque.
pub(super) fn literal_point(n: Number) -> Point {
    if n.is_zero() {
        return Point::ZERO;
    }
    if let Some(turns) = quarters(n) {
        return Point::QUARTER.times(turns.rem_euclid(4));
    }
    let base = Number::decimal(1e-9);
    let count = (n.value() * 1e9).round();
    if count.abs() < 1e15 && Number::integer(count as i64).mul(base).residue == n.residue {
        return unit_point(base.print(), Number::ONE).times(count as i64);
    }
    unit_point(n.print(), Number::ONE)
}
