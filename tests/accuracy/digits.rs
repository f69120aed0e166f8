//! Derived equations in 67 digits, and how they answer to every number that goes in.
//!
//! Each operation is written down with its value and its partial derivatives by its operands, so one sweep backwards from a
//! result gives the derivatives of the result by all data: symbols, and literals that no single precision holds. Values have
//! 224 bits, derivatives are those of double precision. A literal is exact where it is rational, else it has the 31 digits that
//! the derivation has of it.

use std::cell::{Cell, RefCell};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use multibody_engine::contracts::call::Call;
use multibody_engine::symbolic::evaluate::Field;
use multibody_engine::symbolic::graph::{Graph, Scalar, SymbolId};
use multibody_engine::symbolic::number::Number;

/// Of 67 digits.
pub(crate) type Big = FBig<HalfEven, 2>;

const BITS: usize = 224;

/// A pivot that is this much smaller than the greatest entry of its scaled matrix may be rounding.
const PIVOT: f64 = 1e-10;

/// Two numbers that are compared count as equal within this share of their size: single precision may tell them otherwise.
const NEAR: f64 = 1e-5;

/// A number of double precision as it is.
pub(crate) fn exact(x: f64) -> Big {
    let number = Big::try_from(x).expect("a finite number");
    number.with_precision(BITS).value()
}

/// Rounded to double precision.
pub(crate) fn rounded(x: &Big) -> f64 {
    x.to_f64().value()
}

/// The value of a number on a [`Tape`].
pub(crate) type Place = usize;

struct Node {
    value: Big,
    high: f64,
    /// Operands, and the derivatives by these.
    slopes: [(Place, f64); 2],
    /// Whether it is given with an error of rounding.
    is_data: bool,
}

/// Sums of sizes of derivatives of a result times what it is derived by: by how many errors of its own size the result
/// changes where each of these changes by one of its own.
#[derive(Clone, Copy)]
pub(crate) struct Sensitivity {
    /// By all data.
    pub(crate) data: f64,
    /// By results of all operations, and data: what one rounding of each leaves.
    pub(crate) operations: f64,
}

/// What the symbols of a graph are.
pub(crate) type Symbols<'a> = &'a dyn Fn(SymbolId) -> Big;

/// All operations of an evaluation.
pub(crate) struct Tape<'a> {
    nodes: RefCell<Vec<Node>>,
    symbols: Symbols<'a>,
    /// Whether some operation has no value, or one that rounding may turn: a root of what is negative, a quotient by zero, a
    /// comparison of equal numbers, a rank.
    unclear: Cell<bool>,
}

impl<'a> Tape<'a> {
    pub(crate) fn new(symbols: Symbols<'a>) -> Tape<'a> {
        Tape { nodes: RefCell::default(), symbols, unclear: Cell::new(false) }
    }

    pub(crate) fn is_unclear(&self) -> bool {
        self.unclear.get()
    }

    pub(crate) fn value(&self, at: Place) -> Big {
        self.nodes.borrow()[at].value.clone()
    }

    /// What errors of its operands do to a result.
    pub(crate) fn sensitivity(&self, result: Place) -> Sensitivity {
        let nodes = self.nodes.borrow();
        let mut slopes = vec![0.0; result + 1];
        slopes[result] = 1.0;
        let mut sum = Sensitivity { data: 0.0, operations: 0.0 };
        for at in (0..=result).rev() {
            let slope = slopes[at];
            if slope == 0.0 {
                continue;
            }
            let node = &nodes[at];
            let share = (slope * node.high).abs();
            sum.operations += share;
            if node.is_data {
                sum.data += share;
            }
            for (operand, partial) in node.slopes {
                if partial != 0.0 {
                    slopes[operand] += slope * partial;
                }
            }
        }
        sum
    }

    fn push(&self, value: Big, slopes: [(Place, f64); 2]) -> Place {
        let high = rounded(&value);
        self.note(!high.is_finite() || slopes.iter().any(|slope| !slope.1.is_finite()));
        let mut nodes = self.nodes.borrow_mut();
        nodes.push(Node { value, high, slopes, is_data: false });
        nodes.len() - 1
    }

    fn datum(&self, value: Big) -> Place {
        let at = self.constant(value);
        self.nodes.borrow_mut()[at].is_data = true;
        at
    }

    fn constant(&self, value: Big) -> Place {
        self.push(value, [(0, 0.0); 2])
    }

    fn note(&self, unclear: bool) {
        self.unclear.set(self.unclear.get() | unclear);
    }

    fn high(&self, at: Place) -> f64 {
        self.nodes.borrow()[at].high
    }

    /// What has no value.
    fn nothing(&self) -> Place {
        self.note(true);
        self.constant(exact(1.0))
    }

    /// A function of one number with its derivative, which has a value where `defined`.
    fn function(&self, x: Place, defined: bool, value: fn(&Big) -> Big, slope: f64) -> Place {
        if defined { self.push(value(&self.value(x)), [(x, slope), (0, 0.0)]) } else { self.nothing() }
    }

    fn compare(&self, a: Place, b: Place, holds: fn(&Big, &Big) -> bool) -> Place {
        let (x, y) = (self.high(a), self.high(b));
        self.note((x - y).abs() <= NEAR * (x.abs() + y.abs()) && (x, y) != (0.0, 0.0));
        self.constant(exact(if holds(&self.value(a), &self.value(b)) { 1.0 } else { 0.0 }))
    }

    fn sub(&self, a: Place, b: Place) -> Place {
        self.push(self.value(a) - self.value(b), [(a, 1.0), (b, -1.0)])
    }
}

impl Field for Tape<'_> {
    type Value = Place;

    fn literal(&self, n: Number) -> Place {
        let value = match n.rational() {
            Some((above, below)) => integer(above) / integer(below),
            None => exact(n.doubled().high) + exact(n.doubled().low),
        };
        let single = exact(f64::from(n.value() as f32));
        if value == single { self.constant(value) } else { self.datum(value) }
    }

    fn symbol(&self, id: SymbolId) -> Place {
        self.datum((self.symbols)(id))
    }

    fn add(&self, a: Place, b: Place) -> Place {
        self.push(self.value(a) + self.value(b), [(a, 1.0), (b, 1.0)])
    }

    fn mul(&self, a: Place, b: Place) -> Place {
        self.push(self.value(a) * self.value(b), [(a, self.high(b)), (b, self.high(a))])
    }

    fn neg(&self, a: Place) -> Place {
        self.push(-self.value(a), [(a, -1.0), (0, 0.0)])
    }

    fn reciprocal(&self, a: Place) -> Place {
        let inverse = 1.0 / self.high(a);
        self.function(a, inverse.is_finite(), |x| exact(1.0) / x, -inverse * inverse)
    }

    fn call(&self, call: Call, x: &[Place]) -> Place {
        let h: Vec<f64> = x.iter().map(|&at| self.high(at)).collect();
        let is = |k: usize| h[k] != 0.0;
        let mask = |holds: bool| self.constant(exact(if holds { 1.0 } else { 0.0 }));
        let one = |defined: bool, value: fn(&Big) -> Big, slope: f64| self.function(x[0], defined, value, slope);
        let outside = |a: f64| 1.0 / (1.0 - a * a).sqrt();
        match call {
            Call::External(_) | Call::ExternalSlope(..) | Call::ExternalCurvature(_) => {
                unreachable!("no model of the ledger calls Rust")
            }
            Call::Epsilon => self.constant(exact(f64::EPSILON)),
            Call::Nan => self.nothing(),
            Call::Tan => one(true, Big::tan, 1.0 + h[0].tan().powi(2)),
            Call::Asin => one(h[0].abs() < 1.0, Big::asin, outside(h[0])),
            Call::Acos => one(h[0].abs() < 1.0, Big::acos, -outside(h[0])),
            Call::Atan => one(true, Big::atan, 1.0 / (1.0 + h[0] * h[0])),
            Call::Atan2 => {
                let square = h[0] * h[0] + h[1] * h[1];
                if square == 0.0 {
                    return self.nothing();
                }
                self.push(self.value(x[0]).atan2(&self.value(x[1])), [(x[0], h[1] / square), (x[1], -h[0] / square)])
            }
            Call::Sinh => one(true, Big::sinh, h[0].cosh()),
            Call::Cosh => one(true, Big::cosh, h[0].sinh()),
            Call::Tanh => one(true, Big::tanh, 1.0 - h[0].tanh().powi(2)),
            Call::Exp => one(true, Big::exp, h[0].exp()),
            Call::Ln => one(h[0] > 0.0, Big::ln, 1.0 / h[0]),
            Call::Powf if h[0] <= 0.0 => self.nothing(),
            Call::Powf => {
                let slopes = [h[1] * h[0].powf(h[1] - 1.0), h[0].powf(h[1]) * h[0].ln()];
                self.push(self.value(x[0]).powf(&self.value(x[1])), [(x[0], slopes[0]), (x[1], slopes[1])])
            }
            Call::Sqrt => one(h[0] > 0.0, Big::sqrt, 0.5 / h[0].sqrt()),
            Call::Abs if h[0] < 0.0 => self.neg(x[0]),
            Call::Abs => x[0],
            Call::Signum => self.constant(exact(if h[0] == 0.0 { 0.0 } else { h[0].signum() })),
            Call::Less => self.compare(x[0], x[1], |a, b| a < b),
            Call::LessEqual => self.compare(x[0], x[1], |a, b| a <= b),
            Call::Equal => self.compare(x[0], x[1], |a, b| a == b),
            // Continuous, so nothing is unclear where they are equal.
            Call::Min | Call::Max => x[usize::from((self.value(x[0]) < self.value(x[1])) != (call == Call::Min))],
            Call::And => mask(is(0) && is(1)),
            Call::Or => mask(is(0) || is(1)),
            Call::Not => mask(!is(0)),
            Call::Select => x[if is(0) { 1 } else { 2 }],
        }
    }

    fn point(&self, _: &Graph, _: Scalar, at: Place, _: &dyn Fn(Scalar) -> Place) -> (Place, Place) {
        let (sin, cos) = self.value(at).sin_cos();
        let (s, c) = (rounded(&sin), rounded(&cos));
        (self.push(cos, [(at, -s), (0, 0.0)]), self.push(sin, [(at, c), (0, 0.0)]))
    }

    fn solve(&self, _: bool, matrix: &[Place], rhs: &[Place]) -> Vec<Place> {
        let n = rhs.len();
        let mut a: Vec<Vec<Place>> = matrix.chunks(n.max(1)).map(<[Place]>::to_vec).collect();
        let mut b = rhs.to_vec();
        let mut columns: Vec<usize> = (0..n).collect();
        let size = |list: &[Place]| list.iter().fold(0.0_f64, |most, &x| most.max(self.high(x).abs()));
        let mut scales: Vec<f64> = a.iter().map(|row| 1.0 / size(row)).collect();
        for k in 0..n {
            let entries = (k..n).flat_map(|i| (k..n).map(move |j| (i, j)));
            let scaled = |&(i, j): &(usize, usize)| self.high(a[i][j]).abs() * scales[i];
            let Some((i, j)) = entries.max_by(|x, y| scaled(x).total_cmp(&scaled(y))) else { break };
            if scaled(&(i, j)) <= PIVOT || !scaled(&(i, j)).is_finite() {
                self.note(true);
                return vec![self.nothing(); n + 1];
            }
            a.swap(k, i);
            b.swap(k, i);
            scales.swap(k, i);
            a.iter_mut().for_each(|row| row.swap(k, j));
            columns.swap(k, j);
            let pivot = self.reciprocal(a[k][k]);
            for i in k + 1..n {
                let factor = self.mul(a[i][k], pivot);
                let (above, below) = a.split_at_mut(i);
                for (entry, &over) in below[0].iter_mut().zip(&above[k]).skip(k + 1) {
                    *entry = self.sub(*entry, self.mul(factor, over));
                }
                b[i] = self.sub(b[i], self.mul(factor, b[k]));
            }
        }
        let mut x = vec![0; n];
        for k in (0..n).rev() {
            let mut rest = b[k];
            for j in k + 1..n {
                rest = self.sub(rest, self.mul(a[k][j], x[columns[j]]));
            }
            x[columns[k]] = self.mul(rest, self.reciprocal(a[k][k]));
        }
        x.push(self.constant(exact(n as f64)));
        x
    }
}

/// As it is.
pub(crate) fn integer(n: i64) -> Big {
    Big::from(n).with_precision(BITS).value()
}
