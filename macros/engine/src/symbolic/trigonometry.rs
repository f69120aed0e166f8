//! Stage `symbolic`: angles, their sines and cosines.
//!
//! In: an angle, any scalar. Out: its point on the circle modulo the prime, and nodes for sine and cosine. An angle is
//! read as a sum of units with rational factors and a literal (see [`super::elementary`]). Each unit is drawn as a twelfth
//! of itself, so halves, thirds, sums and differences of angles agree exactly with the addition theorems.

use std::collections::BTreeMap;
use std::ops::Add;

use crate::contracts::call::Call;

use super::elementary::{literal_point, multiple, quarters, sin_cos};
use super::fingerprint::{Point, Print, reconstruct};
use super::graph::{Graph, Scalar, ScalarNode, SymbolId};
use super::number::Number;

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
        if let (Some(c), Some(s)) = (self.literal(cos), self.literal(sin))
            && let Some(angle) = super::elementary::call(Call::Atan2, &[s, c])
        {
            self.keep_point(angle, Call::Atan2, &[sin, cos]);
            return self.number(angle);
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
        match factor.rational().or_else(|| reconstruct(factor.residue)) {
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
        let (mut given, mut others) = (Vec::new(), Vec::new());
        for (unit, factor) in units.terms {
            match self.given_point(unit, factor) {
                Some(point) => given.push(point),
                None => others.push((unit, factor)),
            }
        }
        if given.is_empty() {
            return None;
        }
        for point in &mut given {
            if let Some((at, sum)) = self.known_sum(*point, &others) {
                others.remove(at);
                *point = sum;
            }
        }
        let mut rest = vec![self.number(units.constant)];
        for (unit, factor) in others {
            let factor = self.number(factor);
            rest.push(self.mul(factor, unit));
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

    /// The unit that, added to a given point, makes one whose cosine and sine are at hand, and that point. An iteration gives both its
    /// result and how far that is turned from the guess: guess and turn together are the result.
    fn known_sum(
        &self,
        (c, s, times): (Scalar, Scalar, i64),
        units: &[(Scalar, Number)],
    ) -> Option<(usize, (Scalar, Scalar, i64))> {
        let given = Point { cos: self.print(c), sin: self.print(s) }.times(times.into());
        let sum = |&(unit, factor): &(Scalar, Number)| {
            let unit = multiple(self.print(unit), factor, |unit| Point::drawn(0xA9_61E5, unit));
            let Point { cos, sin } = given + unit;
            let [cos, sin] = [self.find(cos)?, self.find(sin)?];
            (self.is_at_hand(cos) && self.is_at_hand(sin)).then_some((cos, sin, 1))
        };
        units.iter().enumerate().find_map(|(at, unit)| Some((at, sum(unit)?)))
    }

    /// The angle of a point that is this one, or this one up to what is added.
    pub fn angle_in(&self, angle: Scalar) -> Option<Scalar> {
        let is_given = |s: Scalar| matches!(self.node(s), ScalarNode::Angle(..));
        match self.node(angle) {
            ScalarNode::Angle(..) => Some(angle),
            ScalarNode::Sum(terms) => {
                let given = terms.iter().copied().find(|&term| is_given(term));
                given.map(|term| term.flip_if(angle.is_negative()))
            }
            _ => None,
        }
    }

    /// Symbols of points on the circle whose angle these expressions read, and not its cosine and sine alone.
    pub fn angles_read(&self, roots: &[Scalar]) -> Vec<SymbolId> {
        let angle = |index: usize| match self.node(Scalar::new(index, false)) {
            &ScalarNode::Angle(cos, sin) => [cos, sin].map(|part| self.symbol_id(part)).into_iter().flatten(),
            _ => [None, None].into_iter().flatten(),
        };
        self.reachable_scalars(roots).into_iter().flat_map(angle).collect()
    }

    pub fn sin(&mut self, angle: Scalar) -> Scalar {
        if angle.is_negative() {
            return -self.sin(-angle);
        }
        if let Some((_, sin)) = self.by_points(angle) {
            return sin;
        }
        if let Some(n) = self.literal(angle) {
            return self.number(self.literal_sin_cos(n)[0]);
        }
        match self.quarter_turns(angle) {
            (Scalar::ZERO, 0 | 2) => Scalar::ZERO,
            (Scalar::ZERO, 1) => Scalar::ONE,
            (Scalar::ZERO, _) => -Scalar::ONE,
            (rest, 1) => self.cos(rest),
            (rest, 2) => -self.sin(rest),
            (rest, 3) => -self.cos(rest),
            _ => {
                let print = self.point(angle).sin;
                self.find(print).unwrap_or_else(|| self.insert_scalar(ScalarNode::Sin(angle), print))
            }
        }
    }

    pub fn cos(&mut self, angle: Scalar) -> Scalar {
        let angle = angle.positive();
        if let Some((cos, _)) = self.by_points(angle) {
            return cos;
        }
        if let Some(n) = self.literal(angle) {
            return self.number(self.literal_sin_cos(n)[1]);
        }
        match self.quarter_turns(angle) {
            (Scalar::ZERO, 1 | 3) => Scalar::ZERO,
            (Scalar::ZERO, 0) => Scalar::ONE,
            (Scalar::ZERO, _) => -Scalar::ONE,
            (rest, 1) => -self.sin(rest),
            (rest, 2) => -self.cos(rest),
            (rest, 3) => self.sin(rest),
            _ => {
                let print = self.point(angle).cos;
                self.find(print).unwrap_or_else(|| self.insert_scalar(ScalarNode::Cos(angle), print))
            }
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
            Some((c, s, times)) => Point { cos: self.print(c), sin: self.print(s) }.times(times.into()),
            None => multiple(self.print(unit), factor, |unit| Point::drawn(0xA9_61E5, unit)),
        };
        let constant = match self.exact_point(units.constant) {
            Some([sin, cos]) => Point { cos: cos.print(), sin: sin.print() },
            None => literal_point(units.constant).0,
        };
        units.terms.iter().map(point).fold(constant, Add::add)
    }

    /// Sine and cosine of a literal angle. The angle acos(1 / 3) is no exact number, but its cosine is one, and so is its sine,
    /// as long as the angle itself is asked for; of what is added to it only the hash is known.
    fn literal_sin_cos(&self, angle: Number) -> [Number; 2] {
        self.exact_point(angle).unwrap_or_else(|| sin_cos(angle).into())
    }

    fn exact_point(&self, angle: Number) -> Option<[Number; 2]> {
        let key = angle.print().canonical();
        let &[sin, cos] = self.exact_points.get(&key)?;
        Some([if key == angle.print() { sin } else { -sin }, cos])
    }

    /// Remembers where an angle lies that a function of literals gives, if these and the root beside them are exact. What rounds to
    /// quarter turns means them: what rounding has left of a zero is none.
    pub(super) fn keep_point(&mut self, angle: Number, call: Call, arguments: &[Scalar]) {
        if angle.is_exact() || quarters(angle).is_some() {
            return;
        }
        let [sin, cos] = match (call, arguments) {
            (Call::Asin, &[sin]) => [sin, self.other_side(sin)],
            (Call::Acos, &[cos]) => [self.other_side(cos), cos],
            (Call::Atan, &[slope]) => self.direction(slope, Scalar::ONE),
            (Call::Atan2, &[sin, cos]) => self.direction(sin, cos),
            _ => return,
        };
        let (Some(sin), Some(cos)) = (self.literal(sin), self.literal(cos)) else { return };
        if sin.is_exact() && cos.is_exact() {
            let key = angle.print().canonical();
            self.exact_points.insert(key, [if key == angle.print() { sin } else { -sin }, cos]);
        }
    }

    /// The other side of a right triangle with a hypotenuse of one.
    fn other_side(&mut self, side: Scalar) -> Scalar {
        let square = self.mul(side, side);
        let other = self.sub(Scalar::ONE, square);
        self.sqrt(other)
    }

    /// Sine and cosine of the angle of a point off the origin.
    fn direction(&mut self, y: Scalar, x: Scalar) -> [Scalar; 2] {
        let length = self.length([y, x, Scalar::ZERO]);
        [y, x].map(|part| self.div(part, length))
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
