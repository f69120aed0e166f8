//! Stage `solve`: equations in one unknown and their solutions.
//!
//! In: coefficients. Out: the value of the unknown, an equation that vanishes there, and one over its slope, which the
//! solution itself gives. No inverse function is used: an angle is its cosine and sine, quotients of what is known.
//!
//! - [`Primitive::Turn`]: R(x) w = v about a coordinate axis, known on both sides (Paden-Kahan 1).
//! - [`Primitive::Root`]: A cos x + B sin x = C; with D = A^2 + B^2 and r = sqrt(D - C^2) it is
//!   (cos x, sin x) = ((A C + B r) / D, (B C - A r) / D), where B cos x - A sin x = r.
//! - [`Primitive::Linear`] and [`Primitive::Quadratic`] in a travel.
//!
//! Paden-Kahan 2 and 3 are pairs whose equation is a `Root`: a point on one axis against the other axis' normal plane,
//! and the distance of two points.

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Scalar, ScalarNode, VectorNode};
use crate::symbolic::substitute::Substitution;

use super::{Balance, Root, Solved, Value};

/// One equation in one unknown x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Primitive {
    /// In the plane of the turning: near, turned, is far.
    Turn { near: [Scalar; 2], far: [Scalar; 2] },
    /// a cos x + b sin x = c
    Root { a: Scalar, b: Scalar, c: Scalar },
    /// slope x + one = 0
    Linear { slope: Scalar, one: Scalar },
    /// square x^2 + 2 half x + one = 0
    Quadratic { square: Scalar, half: Scalar, one: Scalar },
}

/// Expressions in placeholders whose values are known otherwise since earlier unknowns were solved: what they turned
/// into, and slopes, which are roots.
#[derive(Clone, Default)]
pub(super) struct Known(Vec<(Scalar, Scalar)>);

impl Known {
    fn insert(&mut self, g: &Graph, expression: Scalar, value: Scalar) {
        let known = self.0.iter().any(|(key, _)| key.positive() == expression.positive());
        if g.literal(expression).is_none() && !known {
            self.0.push((expression, value));
        }
    }

    /// With the simpler values put in. A component of a sum of vectors is looked at term by term, since the known
    /// expression may be one of them.
    pub(super) fn simplest<const N: usize>(&self, g: &mut Graph, list: [Scalar; N]) -> [Scalar; N] {
        let mut simple = Substitution::of_nodes(&self.0);
        list.map(|s| {
            let sum = match *g.node(s) {
                ScalarNode::Component(v, axis) => match g.vector_node(v) {
                    VectorNode::Sum(terms) => Some((terms.clone(), axis)),
                    _ => None,
                },
                _ => None,
            };
            let terms = match sum {
                Some((vectors, axis)) => vectors.iter().map(|&v| g.component(v, axis)).collect(),
                None => vec![s.positive()],
            };
            let put = simple.scalars(g, &terms);
            match put == terms {
                true => s,
                false if s.is_negative() => -g.sum(&put),
                false => g.sum(&put),
            }
        })
    }
}

fn squares(g: &mut Graph, list: [Scalar; 2]) -> Scalar {
    let squares = list.map(|s| g.mul(s, s));
    g.sum(&squares)
}

fn combine(g: &mut Graph, [a, b]: [Scalar; 2], [x, y]: [Scalar; 2]) -> Scalar {
    let terms = [g.mul(a, x), g.mul(b, y)];
    g.sum(&terms)
}

impl Primitive {
    /// Number of free choices of a sign.
    pub(super) fn signs(&self) -> usize {
        usize::from(matches!(self, Primitive::Root { .. } | Primitive::Quadratic { .. }))
    }

    /// Whether it gives a point of the circle.
    pub(super) fn is_angle(&self) -> bool {
        matches!(self, Primitive::Turn { .. } | Primitive::Root { .. })
    }

    /// All coefficients.
    pub(super) fn coefficients(&self) -> Vec<Scalar> {
        match *self {
            Primitive::Turn { near, far } => [near, far].concat(),
            Primitive::Root { a, b, c } => vec![a, b, c],
            Primitive::Linear { slope, one } => vec![slope, one],
            Primitive::Quadratic { square, half, one } => vec![square, half, one],
        }
    }

    /// What the solution is divided by: where all of these vanish the equation says nothing about the unknown.
    pub(super) fn leading(&self) -> Vec<Scalar> {
        match *self {
            Primitive::Turn { near, .. } => near.to_vec(),
            Primitive::Root { a, b, .. } => vec![a, b],
            Primitive::Linear { slope, .. } => vec![slope],
            Primitive::Quadratic { square, .. } => vec![square],
        }
    }

    /// Words for the report.
    pub(super) fn describe(&self) -> &'static str {
        match self {
            Primitive::Turn { .. } => "(r cos x, r sin x) = (u, v)",
            Primitive::Root { c: Scalar::ZERO, .. } => "A cos x + B sin x = 0",
            Primitive::Root { .. } => "A cos x + B sin x = C",
            Primitive::Linear { .. } => "linear",
            Primitive::Quadratic { half: Scalar::ZERO, .. } => "square of the travel",
            Primitive::Quadratic { .. } => "quadratic in the travel",
        }
    }

    /// The solution. `sign`, one or minus one, chooses between two.
    pub(super) fn solve(&self, g: &mut Graph, symbol: Scalar, sign: Scalar, known: &mut Known, how: String) -> Solved {
        let mut parts = Parts::default();
        let parts = &mut parts;
        let (value, equation, inverse_slope, root) = match *self {
            Primitive::Turn { near, far } => turn(g, symbol, near, far, (known, parts)),
            Primitive::Root { a, b, c } => root(g, symbol, [a, b, c], sign, (known, parts)),
            Primitive::Linear { slope, one } => {
                let [simple_slope, simple_one] = known.simplest(g, [slope, one]);
                let inverse = g.reciprocal(simple_slope);
                let value = g.mul(-simple_one, inverse);
                let product = g.mul(slope, symbol);
                (Value::Length(value), g.add(product, one), inverse, None)
            }
            Primitive::Quadratic { square, half, one } => travel(g, symbol, [square, half, one], sign, (known, parts)),
        };
        let balances = vec![Balance { equation, inverse_slope }];
        let roots = root.into_iter().map(|value| Root { value, sign: 0 }).collect();
        Solved { symbol, value, balances, together: vec![symbol], how, roots, parts: std::mem::take(parts) }
    }
}

type Parts = Vec<(&'static str, Scalar)>;
type Found = (Value, Scalar, Scalar, Option<Scalar>);

/// R w = v in a plane.
fn turn(g: &mut Graph, x: Scalar, w: [Scalar; 2], v: [Scalar; 2], (known, parts): (&mut Known, &mut Parts)) -> Found {
    let [wi, wj, vi, vj] = known.simplest(g, [w[0], w[1], v[0], v[1]]);
    // (r cos x, r sin x), with the coefficients as they stand in placeholders too.
    let zero = Scalar::ZERO;
    let (u, raw, scale) = if wj == zero {
        ([vi, vj], v, wi)
    } else if wi == zero {
        ([vj, -vi], [v[1], -v[0]], wj)
    } else if vj == zero {
        ([wi, -wj], [w[0], -w[1]], vi)
    } else if vi == zero {
        ([wj, wi], [w[1], w[0]], vj)
    } else {
        let cross = |g: &mut Graph, [wi, wj]: [Scalar; 2], [vi, vj]: [Scalar; 2]| {
            [combine(g, [wi, wj], [vi, vj]), combine(g, [wi, -wj], [vj, vi])]
        };
        let (near, far) = (squares(g, [wi, wj]), squares(g, [vi, vj]));
        let scale = if g.literal(far).is_some() && g.literal(near).is_none() { far } else { near };
        (cross(g, [wi, wj], [vi, vj]), cross(g, w, v), scale)
    };
    let inverse = g.reciprocal(scale);
    parts.extend([("u", u[0]), ("v", u[1]), ("radius", scale), ("radius_inv", inverse)]);
    let [cos, sin] = u.map(|u| g.mul(u, inverse));
    let (c, s) = (g.cos(x), g.sin(x));
    let equation = combine(g, [raw[0], -raw[1]], [s, c]);
    let turned = [combine(g, [w[0], -w[1]], [c, s]), combine(g, [w[1], w[0]], [c, s])];
    let back = [combine(g, [v[0], v[1]], [c, s]), combine(g, [v[1], -v[0]], [c, s])];
    for (expression, value) in turned.into_iter().zip([vi, vj]).chain(back.into_iter().zip([wi, wj])) {
        known.insert(g, expression, value);
    }
    (Value::Angle { cos, sin }, equation, inverse, None)
}

/// a cos x + b sin x = c
fn root(g: &mut Graph, x: Scalar, raw: [Scalar; 3], sign: Scalar, (known, parts): (&mut Known, &mut Parts)) -> Found {
    let [a, b, c] = known.simplest(g, raw);
    let whole = squares(g, [a, b]);
    let square = g.mul(c, c);
    let rest = g.sub(whole, square);
    parts.extend([("a", a), ("b", b), ("c", c), ("d", whole), ("discriminant", rest)]);
    let root = g.sqrt(rest);
    let r = g.mul(sign, root);
    let zero = Scalar::ZERO;
    let slope = g.reciprocal(r);
    let (cos, sin) = if c == zero {
        (g.mul(b, slope), g.mul(-a, slope))
    } else if a == zero {
        let inverse = g.reciprocal(b);
        (g.mul(r, inverse), g.mul(c, inverse))
    } else if b == zero {
        let inverse = g.reciprocal(a);
        (g.mul(c, inverse), g.mul(-r, inverse))
    } else {
        let inverse = g.reciprocal(whole);
        let (cos, sin) = (combine(g, [a, b], [c, r]), combine(g, [b, -a], [c, r]));
        (g.mul(cos, inverse), g.mul(sin, inverse))
    };
    let (cosine, sine) = (g.cos(x), g.sin(x));
    let left = combine(g, [raw[0], raw[1]], [cosine, sine]);
    let across = combine(g, [raw[1], -raw[0]], [cosine, sine]);
    known.insert(g, left, c);
    known.insert(g, across, r);
    (Value::Angle { cos, sin }, g.sub(left, raw[2]), slope, Some(root))
}

/// square x^2 + 2 half x + one = 0
fn travel(g: &mut Graph, x: Scalar, raw: [Scalar; 3], sign: Scalar, (known, parts): (&mut Known, &mut Parts)) -> Found {
    let [square, half, one] = known.simplest(g, raw);
    let (whole, product) = (g.mul(half, half), g.mul(square, one));
    let rest = g.sub(whole, product);
    parts.extend([("square", square), ("half", half), ("constant", one), ("discriminant", rest)]);
    let root = g.sqrt(rest);
    let r = g.mul(sign, root);
    let inverse = g.reciprocal(square);
    let top = g.sub(r, half);
    let value = g.mul(top, inverse);
    let (scaled, middle) = (g.mul(raw[0], x), raw[1]);
    let slope = g.add(scaled, middle);
    known.insert(g, slope, r);
    // Half the equation: its slope is the root itself.
    let half = g.decimal(0.5);
    let terms = [g.product(&[half, scaled, x]), g.mul(middle, x), g.mul(half, raw[2])];
    let equation = g.sum(&terms);
    (Value::Length(value), equation, g.reciprocal(r), Some(root))
}

/// An x with a cos x + b sin x = c, the other one if `second`. NaN where the equation holds no x.
pub fn circular(g: &mut Graph, [a, b, c]: [Scalar; 3], second: bool) -> Value {
    if (a, b) == (Scalar::ZERO, Scalar::ZERO) {
        return Value::Length(g.call(Call::Nan, &[]));
    }
    // Nobody reads the equation that comes with the value, so its unknown needs no symbol.
    let sign = if second { -Scalar::ONE } else { Scalar::ONE };
    Primitive::Root { a, b, c }.solve(g, Scalar::ZERO, sign, &mut Known::default(), String::new()).value
}

/// An x with a x^2 + 2 b x + c = 0, the other one if `second`.
///
/// Of two solutions the one nearer to zero is c / q, the other q / a with q = -(b +- r), where nothing cancels (Higham 2002,
/// section 1.8). It stays where a becomes zero; the other one is NaN there, as both are where the equation holds no x.
pub fn quadratic(g: &mut Graph, [a, b, c]: [Scalar; 3], second: bool) -> Scalar {
    let nan = g.call(Call::Nan, &[]);
    if a == Scalar::ZERO {
        if second || b == Scalar::ZERO {
            return nan;
        }
        let quotient = g.div(c, b);
        let half = g.decimal(-0.5);
        return g.mul(half, quotient);
    }
    let (square, product) = (g.mul(b, b), g.mul(a, c));
    let rest = g.sub(square, product);
    let root = g.sqrt(rest);
    if b == Scalar::ZERO {
        let x = g.div(root, a);
        return if second { -x } else { x };
    }
    let below = g.call(Call::Less, &[b, Scalar::ZERO]);
    let away = g.call(Call::Select, &[below, -root, root]);
    let sum = g.add(b, away);
    let q = -sum;
    if !second {
        return g.div(c, q);
    }
    let far = g.div(q, a);
    let none = g.call(Call::Equal, &[a, Scalar::ZERO]);
    g.call(Call::Select, &[none, nan, far])
}

#[cfg(test)]
mod tests {
    use super::{Known, Value, root};
    use crate::symbolic::evaluate::{Evaluator, Real};
    use crate::symbolic::graph::{Graph, Scalar};

    /// Each of the four forms, at coefficients of which one, or none, is zero by structure.
    #[test]
    fn roots_fulfil_their_equation() {
        for absent in [None, Some(0), Some(1), Some(2)] {
            let mut g = Graph::new();
            let [x, a, b, c] = [(); 4].map(|()| g.symbol());
            let mut raw = [a, b, c];
            if let Some(k) = absent {
                raw[k] = Scalar::ZERO;
            }
            for sign in [Scalar::ONE, -Scalar::ONE] {
                let (value, ..) = root(&mut g, x, raw, sign, (&mut Known::default(), &mut Vec::new()));
                let Value::Angle { cos, sin } = value else { panic!("an angle") };
                let at = [0.0, 0.7, -0.9, 0.4];
                let symbols = |id: crate::symbolic::graph::SymbolId| at[id.0];
                let list = [&[cos, sin][..], &raw].concat();
                let found = Evaluator::new(&g, Real { symbols: &symbols }).run(&list);
                let [cos, sin, a, b, c] = found[..] else { panic!("five values") };
                assert!((a * cos + b * sin - c).abs() < 1e-14, "{absent:?}");
                assert!((cos.hypot(sin) - 1.0).abs() < 1e-14, "{absent:?}");
                // The sign of the root is that of the slope.
                let slope = b * cos - a * sin;
                assert_eq!(slope > 0.0, sign == Scalar::ONE, "{absent:?}");
            }
        }
    }
}
