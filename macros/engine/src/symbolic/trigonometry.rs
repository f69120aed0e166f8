//! Stage `symbolic`: angles, their sines and cosines.
//!
//! In: an angle, any scalar. Out: its point on the circle modulo the prime, and nodes for sine and cosine. An angle is
//! read as a sum of units with rational factors and a literal. Each unit is drawn as a twelfth of itself, and decimal
//! literals on the common base of 1e-9 rad, so halves, thirds, sums and differences of angles agree exactly with the
//! addition theorems. Multiples of a quarter turn are exact.

use std::collections::BTreeMap;
use std::ops::{Add, Div, Mul};

use super::fingerprint::{self as field, Point, Print, mix, reconstruct};
use super::graph::{Graph, Scalar, ScalarNode};
use super::number::Number;

/// Denominators up to twelve (1, 2, 3, 4, 6, 12) stay within the group of one unit.
pub(super) const PARTS: i64 = 12;

/// Whole multiples of a given point that are written out.
const MOST_TIMES: i64 = 8;

impl Graph {
    /// The angle of a point on the unit circle. That of a known angle's cosine and sine is this angle.
    pub fn angle(&mut self, cos: Scalar, sin: Scalar) -> Scalar {
        if let (ScalarNode::Cos(x), ScalarNode::Sin(y)) = (self.node(cos), self.node(sin))
            && x == y
            && !cos.is_negative()
        {
            return if sin.is_negative() { -*x } else { *x };
        }
        if let (Some(c), Some(s)) = (self.literal(cos), self.literal(sin)) {
            return self.decimal(s.value().atan2(c.value()));
        }
        // atan2 is odd in the sine.
        if sin.is_negative() {
            return -self.angle(cos, -sin);
        }
        let print = Print::opaque(0xA7, &[self.print(cos), self.print(sin)]);
        match self.find(print) {
            Some(found) => found,
            None => self.insert_scalar(ScalarNode::Angle(cos, sin), print),
        }
    }

    /// An angle taken apart: units with their factors, each unit once, and a literal.
    pub(super) fn units(&self, angle: Scalar) -> Units {
        let mut units = Units { constant: Number::ZERO, terms: BTreeMap::new() };
        let mut stack = vec![(angle, Number::ONE)];
        while let Some((s, factor)) = stack.pop() {
            let factor = if s.is_negative() { -factor } else { factor };
            match self.node(s) {
                ScalarNode::Literal(n) => units.constant = units.constant + *n * factor,
                ScalarNode::Sum(terms) => stack.extend(terms.iter().map(|&t| (t, factor))),
                ScalarNode::Product(factors) => match (self.literal(factors[0]), &factors[..]) {
                    (Some(n), &[_, rest]) => stack.push((rest, factor * n)),
                    _ => units.add(s.positive(), factor),
                },
                _ => units.add(s.positive(), factor),
            }
        }
        units.terms.retain(|_, factor| !factor.is_zero());
        units
    }

    /// The point, and how many times, of a unit that is given as one. Other fractions of it need its angle.
    pub(super) fn given_point(&self, unit: Scalar, factor: Number) -> Option<(Scalar, Scalar, i64)> {
        let &ScalarNode::Angle(c, s) = self.node(unit) else { return None };
        match reconstruct(factor.residue) {
            Some((n, 1)) if n.abs() <= MOST_TIMES => Some((c, s, n)),
            _ => None,
        }
    }

    /// Cosine and sine of an angle that holds units given as points, by the addition theorems.
    fn by_points(&mut self, angle: Scalar) -> Option<(Scalar, Scalar)> {
        if !matches!(self.node(angle), ScalarNode::Angle(..) | ScalarNode::Sum(_) | ScalarNode::Product(_)) {
            return None;
        }
        let units = self.units(angle);
        let (mut given, mut rest) = (Vec::new(), vec![self.number(units.constant)]);
        for (unit, factor) in units.terms {
            match self.given_point(unit, factor) {
                Some(point) => given.push(point),
                None => {
                    let factor = self.number(factor);
                    rest.push(self.mul(factor, unit));
                }
            }
        }
        if given.is_empty() {
            return None;
        }
        let rest = self.sum(&rest);
        let (mut cos, mut sin) = (self.cos(rest), self.sin(rest));
        for (c, s, times) in given {
            let s = if times < 0 { -s } else { s };
            for _ in 0..times.abs() {
                let terms = [self.mul(cos, c), -self.mul(sin, s), self.mul(sin, c), self.mul(cos, s)];
                (cos, sin) = (self.sum(&terms[..2]), self.sum(&terms[2..]));
            }
        }
        Some((cos, sin))
    }

    pub fn sin(&mut self, angle: Scalar) -> Scalar {
        if angle.is_negative() {
            return -self.sin(-angle);
        }
        if let Some((_, sin)) = self.by_points(angle) {
            return sin;
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
        if let Some((cos, _)) = self.by_points(angle) {
            return cos;
        }
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
        let is_literal = |s: Scalar| matches!(self.node(s), ScalarNode::Literal(_));
        let rest: Vec<Scalar> = match self.node(angle) {
            ScalarNode::Literal(_) => Vec::new(),
            ScalarNode::Sum(terms) if terms.last().is_some_and(|&last| is_literal(last)) => {
                terms[..terms.len() - 1].iter().map(|t| t.flip_if(angle.is_negative())).collect()
            }
            _ => return (angle, 0),
        };
        let Some(turns) = quarters(self.units(angle).constant).filter(|&turns| turns != 0) else { return (angle, 0) };
        let rest = self.sum(&rest);
        // By its value a sum may be found that adds quarter turns which its terms take away: none may be left, or this
        // would go on for ever.
        if rest != Scalar::ZERO && !self.units(rest).constant.is_zero() {
            return (angle, 0);
        }
        (rest, turns.rem_euclid(4) as u8)
    }

    /// Where an angle lies on the circle modulo the prime. One given as a point lies there, wherever that is: a point
    /// that has a root in it lies on the circle by a value that the prime doesn't know.
    pub fn point(&self, angle: Scalar) -> Point {
        let units = self.units(angle);
        let point = |(&unit, &factor): (&Scalar, &Number)| match self.given_point(unit, factor) {
            Some((c, s, times)) => Point { cos: self.print(c), sin: self.print(s) }.times(times),
            None => unit_point(self.print(unit), factor),
        };
        units.terms.iter().map(point).fold(literal_point(units.constant), Add::add)
    }
}

/// See [`Graph::units`].
pub(super) struct Units {
    pub(super) constant: Number,
    pub(super) terms: BTreeMap<Scalar, Number>,
}

impl Units {
    fn add(&mut self, unit: Scalar, factor: Number) {
        let sum = self.terms.entry(unit).or_insert(Number::ZERO);
        *sum = *sum + factor;
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
