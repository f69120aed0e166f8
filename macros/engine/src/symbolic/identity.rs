//! Stage `symbolic`: the exact randomised identity test, which every rewrite has to pass.
//!
//! In: expressions of two graphs whose symbols were made in the same order. Out: a [`Verdict`]. [`identical`] evaluates
//! both modulo the prime of [`super::check`] (Schwartz 1980, Zippel 1979) at points that are drawn from a seed. The prime,
//! the images of literals and the points have nothing in common with the prints by which the graph merges nodes. Angles
//! are points on the circle; unit quaternions lie on the sphere. Square roots are exact, but for their sign, where the
//! argument is a square: points are drawn until all are. Other functions are opaque: equal for equal arguments. What that
//! can't see (signs of roots, min, max, select, exp) is compared by [`close`] at random points in double precision.
//!
//! "Identical" can be trusted; "different" means so only if every angle is a sum of the same units: a product of sums, or
//! a dot product, is one unit.

use std::cell::Cell;

use crate::contracts::call::Call;

use super::check::{self as field, Check, PRIME};
use super::elementary::{literal_point, multiple};
use super::evaluate::{Evaluator, Field, Real};
use super::graph::{Graph, Scalar, SymbolId};
use super::modular::{self, mix};
use super::number::Number;

type Point = modular::Point<Check>;

/// What a test has found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Identical,
    /// Position of the first pair that isn't.
    Different(usize),
    /// No point was found at which the expressions have a value: one of them is the root of what is never a square, or
    /// isn't a number, or holds the root of a literal that the check's field doesn't have.
    Undecided,
}

/// Points at which all must agree.
const POINTS: u64 = 2;
/// Draws for one of them: ten independent roots need a thousand.
const DRAWS: u64 = 4096;

/// Whether two lists of expressions are equal, pair by pair, but for a chance of about (degree / 2^61)^2.
pub fn identical(a: &Graph, xs: &[Scalar], b: &Graph, ys: &[Scalar], seed: u64) -> Verdict {
    let mut points = 0;
    for attempt in 0..DRAWS {
        let draw = Draw::new(a, mix(seed).wrapping_add(attempt));
        let left = Evaluator::new(a, Modular { draw: &draw }).run(xs);
        let right = Evaluator::new(b, Modular { draw: &draw }).run(ys);
        if draw.refused.get() {
            continue;
        }
        if let Some(at) = first_difference(&left, &right, |x, y| x == y) {
            return Verdict::Different(at);
        }
        points += 1;
        if points == POINTS {
            return Verdict::Identical;
        }
    }
    Verdict::Undecided
}

/// Whether two lists of expressions agree in double precision, to a tolerance relative to 1 + |x|, at eight random points
/// at which all have a value.
pub fn close(a: &Graph, xs: &[Scalar], b: &Graph, ys: &[Scalar], seed: u64, tolerance: f64) -> Verdict {
    let mut points = 0;
    for attempt in 0..DRAWS {
        let values = real_point(a, mix(seed).wrapping_add(attempt));
        let symbols = |id: SymbolId| values[id.0];
        let left = Evaluator::new(a, Real { symbols: &symbols }).run(xs);
        let right = Evaluator::new(b, Real { symbols: &symbols }).run(ys);
        let finite = |list: &[f64]| list.iter().all(|x| x.is_finite());
        if !finite(&left) && !finite(&right) {
            continue;
        }
        // A value on one side only is a difference: NaN is never near.
        let near = |x: &f64, y: &f64| (x - y).abs() <= tolerance * (1.0 + x.abs());
        if let Some(at) = first_difference(&left, &right, near) {
            return Verdict::Different(at);
        }
        points += 1;
        if points == 8 {
            return Verdict::Identical;
        }
    }
    Verdict::Undecided
}

fn first_difference<T>(left: &[T], right: &[T], equal: impl Fn(&T, &T) -> bool) -> Option<usize> {
    let pairs = left.len().min(right.len());
    let found = left.iter().zip(right).position(|(x, y)| !equal(x, y));
    found.or((left.len() != right.len()).then_some(pairs))
}

/// Values of symbols up to two in size, unit quaternions and points on circles included.
fn real_point(g: &Graph, seed: u64) -> Vec<f64> {
    let mut values: Vec<f64> =
        (0..g.symbols.len() as u64).map(|id| mix(mix(seed) ^ id) as f64 / (1_u64 << 62) as f64 - 2.0).collect();
    for &SymbolId(first) in &g.quaternions {
        let q = &mut values[first..first + 4];
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        q.iter_mut().for_each(|x| *x /= norm);
    }
    for &SymbolId(first) in &g.circles {
        (values[first], values[first + 1]) = (values[first].cos(), values[first].sin());
    }
    values
}

/// A random point modulo the prime.
pub struct Draw {
    seed: u64,
    symbols: Vec<u64>,
    /// A root was taken of what is no square here.
    refused: Cell<bool>,
}

impl Draw {
    /// For the symbols of this graph.
    pub fn new(g: &Graph, seed: u64) -> Draw {
        let seed = mix(seed ^ 0x1DE_4717);
        let mut symbols: Vec<u64> = (0..g.symbols.len() as u64).map(|id| field::reduce(mix(seed ^ mix(id)))).collect();
        for &SymbolId(first) in &g.quaternions {
            project(&mut symbols[first..first + 4]);
        }
        for &SymbolId(first) in &g.circles {
            project(&mut symbols[first..first + 2]);
        }
        Draw { seed, symbols, refused: Cell::new(false) }
    }

    /// Gives a symbol another value.
    pub fn set(&mut self, id: SymbolId, value: u64) {
        self.symbols[id.0] = value;
    }

    /// Whether a root was asked for that doesn't exist here; values are of no use then.
    pub fn is_refused(&self) -> bool {
        self.refused.get()
    }

    /// The point of a multiple of an angle that has this value, on the circle of this draw.
    fn unit(&self, value: u64, factor: Number) -> Point {
        // An unknown may start at zero, which has no sign.
        if value == 0 {
            return Point::ZERO;
        }
        multiple(Check::new(value), factor, |unit| Point::drawn(mix(self.seed), unit))
    }

    /// An element that is known; else the point is refused.
    fn get(&self, element: Check) -> u64 {
        element.get().unwrap_or_else(|| {
            self.refused.set(true);
            0
        })
    }
}

/// Stereographic projection of all but the first onto the unit sphere, of which the first is the height.
fn project(q: &mut [u64]) {
    let [w, t @ ..] = q else { return };
    let square = t.iter().fold(0, |sum, &t| field::add(sum, field::mul(t, t)));
    let scale = field::inverse(field::add(1, square));
    *w = field::mul(field::add(1, field::neg(square)), scale);
    for t in t {
        *t = field::mul(field::add(*t, *t), scale);
    }
}

/// Of x and -x the one that stands for both, and whether it is -x.
fn canonical(x: u64) -> (u64, bool) {
    if x <= PRIME / 2 { (x, false) } else { (field::neg(x), true) }
}

/// Arithmetic modulo the prime at a drawn point.
#[derive(Clone, Copy)]
pub struct Modular<'d> {
    pub draw: &'d Draw,
}

impl Modular<'_> {
    /// Cosine and sine of a sum of angles with literal factors and a literal.
    pub fn angle(&self, terms: &[(u64, Number)], constant: Number) -> (u64, u64) {
        let units = terms.iter().map(|&(value, factor)| self.draw.unit(value, factor));
        let point = units.fold(literal_point(constant).0, |sum, point| sum + point);
        (self.draw.get(point.cos), self.draw.get(point.sin))
    }

    fn opaque(&self, call: Call, arguments: &[u64]) -> u64 {
        let fold = arguments.iter().fold(mix(self.draw.seed ^ mix(call.tag())), |h, &x| mix(h ^ x));
        field::reduce(fold)
    }
}

impl Field for Modular<'_> {
    type Value = u64;

    fn literal(&self, n: Number) -> u64 {
        self.draw.get(n.check())
    }

    fn symbol(&self, id: SymbolId) -> u64 {
        self.draw.symbols[id.0]
    }

    fn add(&self, a: u64, b: u64) -> u64 {
        field::add(a, b)
    }

    fn mul(&self, a: u64, b: u64) -> u64 {
        field::mul(a, b)
    }

    fn neg(&self, a: u64) -> u64 {
        field::neg(a)
    }

    /// One over zero is a value that nothing else has.
    fn reciprocal(&self, a: u64) -> u64 {
        if a == 0 { field::reduce(mix(self.draw.seed ^ 0xD1)) } else { field::inverse(a) }
    }

    /// Symmetries are all that is known of a function.
    fn call(&self, call: Call, x: &[u64]) -> u64 {
        match (call, x) {
            (Call::Sqrt, &[x]) => self.draw.get(Check::new(x).root()),
            (Call::Tan | Call::Atan | Call::Asin | Call::Sinh | Call::Tanh | Call::Signum, &[x]) => {
                let (key, negative) = canonical(x);
                match self.opaque(call, &[key]) {
                    _ if x == 0 => 0,
                    value if negative => field::neg(value),
                    value => value,
                }
            }
            (Call::Cosh | Call::Abs, &[x]) => self.opaque(call, &[canonical(x).0]),
            (Call::Min | Call::Max | Call::And | Call::Or, &[a, b]) if a == b => a,
            (Call::Min | Call::Max | Call::And | Call::Or | Call::Equal, &[a, b]) => {
                self.opaque(call, &[a.min(b), a.max(b)])
            }
            (Call::Select, &[_, a, b]) if a == b => a,
            (call, x) => self.opaque(call, x),
        }
    }

    /// Sums and literal factors are taken apart; what is left is a unit of angle, known by its value, or given as a point.
    fn point(&self, graph: &Graph, angle: Scalar, _: u64, known: &dyn Fn(Scalar) -> u64) -> (u64, u64) {
        let units = graph.units(angle);
        let (mut terms, mut point) = (Vec::new(), Point::ZERO);
        for (unit, factor) in units.terms {
            match graph.given_point(unit, factor) {
                Some((c, s, times)) => {
                    let [cos, sin] = [c, s].map(|x| Check::new(known(x)));
                    point = point + Point { cos, sin }.times(times.into());
                }
                None => terms.push((known(unit), factor)),
            }
        }
        let (cos, sin) = self.angle(&terms, units.constant);
        let sum = point + Point { cos: Check::new(cos), sin: Check::new(sin) };
        (self.draw.get(sum.cos), self.draw.get(sum.sin))
    }

    /// Elimination with the first pivot there is. The rank is that modulo the prime: the true one, but by chance.
    fn solve(&self, _: bool, matrix: &[u64], rhs: &[u64]) -> Vec<u64> {
        let n = rhs.len();
        let mut rows: Vec<Vec<u64>> =
            (0..n).map(|i| matrix[i * n..(i + 1) * n].iter().chain([&rhs[i]]).copied().collect()).collect();
        let mut pivots = Vec::new();
        for column in 0..n {
            let Some(row) = (pivots.len()..n).find(|&i| rows[i][column] != 0) else { continue };
            rows.swap(pivots.len(), row);
            let row = rows[pivots.len()].clone();
            let inverse = field::inverse(row[column]);
            for (_, other) in rows.iter_mut().enumerate().filter(|(i, _)| *i != pivots.len()) {
                let factor = field::neg(field::mul(other[column], inverse));
                other.iter_mut().zip(&row).for_each(|(x, &y)| *x = field::add(*x, field::mul(factor, y)));
            }
            pivots.push(column);
        }
        let mut x = vec![0; n];
        for (row, &column) in pivots.iter().enumerate() {
            x[column] = field::mul(rows[row][n], field::inverse(rows[row][column]));
        }
        x.push(pivots.len() as u64);
        x
    }
}
