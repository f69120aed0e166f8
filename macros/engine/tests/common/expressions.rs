//! Random expressions as plain trees: values without a graph, for comparison with what its constructors make.

use multibody_engine::contracts::call::Call;
use multibody_engine::symbolic::evaluate::Field;
use multibody_engine::symbolic::graph::{Graph, Scalar, SymbolId, Vector};
use multibody_engine::symbolic::identity::Modular;
use multibody_engine::symbolic::number::Number;

use super::rng::Rng;

pub(crate) const SYMBOLS: usize = 5;

/// A sum of symbols in quarters, and a decimal.
#[derive(Clone, Debug)]
pub(crate) struct Angle {
    terms: Vec<(usize, i64)>,
    constant: f64,
}

#[derive(Clone, Debug)]
pub(crate) enum Expression {
    Symbol(usize),
    Decimal(f64),
    Sum(Vec<Expression>),
    Difference(Box<Expression>, Box<Expression>),
    Product(Vec<Expression>),
    Quotient(Box<Expression>, Box<Expression>),
    Root(Box<Expression>),
    Sin(Angle),
    Cos(Angle),
    Function(Call, Vec<Expression>),
    Dot(Box<Triple>, Box<Triple>),
    Component(Box<Triple>, usize),
}

#[derive(Clone, Debug)]
pub(crate) enum Triple {
    Of(Box<[Expression; 3]>),
    Sum(Vec<Triple>),
    Scale(Expression, Box<Triple>),
    Cross(Box<Triple>, Box<Triple>),
    Turn(usize, Angle, bool, Box<Triple>),
}

impl Angle {
    fn random(rng: &mut Rng) -> Angle {
        let terms = (0..1 + rng.below(3)).map(|_| (rng.below(SYMBOLS), rng.below(9) as i64 - 4)).collect();
        Angle { terms, constant: if rng.chance(40) { rng.decimal(-2.0, 2.0) } else { 0.0 } }
    }

    fn build(&self, g: &mut Graph, symbols: &[Scalar; SYMBOLS]) -> Scalar {
        let mut terms = vec![g.decimal(self.constant)];
        for &(symbol, quarters) in &self.terms {
            let factor = g.decimal(quarters as f64 / 4.0);
            terms.push(g.mul(factor, symbols[symbol]));
        }
        g.sum(&terms)
    }

    fn evaluate(&self, field: &Modular<'_>) -> (u64, u64) {
        let factor = |quarters: i64| Number::integer(quarters) / Number::integer(4);
        let terms: Vec<(u64, Number)> =
            self.terms.iter().map(|&(symbol, quarters)| (field.symbol(SymbolId(symbol)), factor(quarters))).collect();
        field.angle(&terms, Number::decimal(self.constant))
    }
}

impl Expression {
    pub(crate) fn random(rng: &mut Rng, depth: usize) -> Expression {
        use Expression::*;
        if depth == 0 || rng.chance(10) {
            // Few distinct ones, so that equal subexpressions meet.
            return if rng.chance(70) { Symbol(rng.below(SYMBOLS)) } else { Decimal(rng.below(7) as f64 / 2.0 - 1.5) };
        }
        let list = |rng: &mut Rng| (0..2 + rng.below(2)).map(|_| Expression::random(rng, depth - 1)).collect();
        let one = |rng: &mut Rng| Box::new(Expression::random(rng, depth - 1));
        // Functions of literals fold to numbers, which the exact test takes for opaque.
        let varying = |rng: &mut Rng| Sum(vec![Symbol(rng.below(SYMBOLS)), Expression::random(rng, depth - 1)]);
        let triple = |rng: &mut Rng| Box::new(Triple::random(rng, depth - 1));
        match rng.below(20) {
            0..4 => Sum(list(rng)),
            4..6 => Difference(one(rng), one(rng)),
            6..10 => Product(list(rng)),
            10..12 => Quotient(one(rng), one(rng)),
            // Not of a literal: roots modulo the prime don't know their sign.
            12 if rng.chance(30) => Root(Box::new(Sum(vec![Symbol(rng.below(SYMBOLS)), *one(rng)]))),
            12..14 => Sin(Angle::random(rng)),
            14..16 => Cos(Angle::random(rng)),
            16 => {
                let unary = [Call::Tan, Call::Exp, Call::Abs, Call::Cosh];
                Function(unary[rng.below(unary.len())], vec![varying(rng)])
            }
            17 => {
                let binary = [Call::Min, Call::Max, Call::Atan2, Call::Powf];
                Function(binary[rng.below(binary.len())], vec![varying(rng), *one(rng)])
            }
            18 => Dot(triple(rng), triple(rng)),
            _ => Component(triple(rng), rng.below(3)),
        }
    }

    /// Angles are made first. A sum of angles that exists already in another form, such as a dot product, would be one
    /// unit of angle to the graph and to the identity test.
    pub(crate) fn make(&self, g: &mut Graph, symbols: &[Scalar; SYMBOLS]) -> Scalar {
        self.visit(&mut |angle| {
            angle.build(g, symbols);
        });
        self.build(g, symbols)
    }

    fn visit(&self, f: &mut dyn FnMut(&Angle)) {
        match self {
            Expression::Symbol(_) | Expression::Decimal(_) => {}
            Expression::Sum(list) | Expression::Product(list) | Expression::Function(_, list) => {
                list.iter().for_each(|e| e.visit(f));
            }
            Expression::Difference(a, b) | Expression::Quotient(a, b) => [a, b].into_iter().for_each(|e| e.visit(f)),
            Expression::Root(x) => x.visit(f),
            Expression::Sin(angle) | Expression::Cos(angle) => f(angle),
            Expression::Dot(a, b) => [a, b].into_iter().for_each(|v| v.visit(f)),
            Expression::Component(v, _) => v.visit(f),
        }
    }

    fn build(&self, g: &mut Graph, symbols: &[Scalar; SYMBOLS]) -> Scalar {
        let build =
            |g: &mut Graph, list: &[Expression]| -> Vec<Scalar> { list.iter().map(|e| e.build(g, symbols)).collect() };
        match self {
            Expression::Symbol(k) => symbols[*k],
            Expression::Decimal(x) => g.decimal(*x),
            Expression::Sum(list) => {
                let list = build(g, list);
                g.sum(&list)
            }
            Expression::Difference(a, b) => {
                let (a, b) = (a.build(g, symbols), b.build(g, symbols));
                g.sub(a, b)
            }
            Expression::Product(list) => {
                let list = build(g, list);
                g.product(&list)
            }
            Expression::Quotient(a, b) => {
                let (a, b) = (a.build(g, symbols), b.build(g, symbols));
                g.div(a, b)
            }
            Expression::Root(x) => {
                let x = x.build(g, symbols);
                g.sqrt(x)
            }
            Expression::Sin(angle) => {
                let angle = angle.build(g, symbols);
                g.sin(angle)
            }
            Expression::Cos(angle) => {
                let angle = angle.build(g, symbols);
                g.cos(angle)
            }
            Expression::Function(call, list) => {
                let list = build(g, list);
                g.call(*call, &list)
            }
            Expression::Dot(a, b) => {
                let (a, b) = (a.build(g, symbols), b.build(g, symbols));
                g.dot(a, b)
            }
            Expression::Component(v, axis) => {
                let v = v.build(g, symbols);
                g.component(v, *axis)
            }
        }
    }

    pub(crate) fn evaluate(&self, f: &Modular<'_>) -> u64 {
        match self {
            Expression::Symbol(k) => f.symbol(SymbolId(*k)),
            Expression::Decimal(x) => f.literal(Number::decimal(*x)),
            Expression::Sum(list) => list.iter().fold(0, |sum, e| f.add(sum, e.evaluate(f))),
            Expression::Difference(a, b) => f.add(a.evaluate(f), f.neg(b.evaluate(f))),
            Expression::Product(list) => list.iter().fold(1, |product, e| f.mul(product, e.evaluate(f))),
            Expression::Quotient(a, b) => f.mul(a.evaluate(f), f.reciprocal(b.evaluate(f))),
            Expression::Root(x) => f.call(Call::Sqrt, &[x.evaluate(f)]),
            Expression::Sin(angle) => angle.evaluate(f).1,
            Expression::Cos(angle) => angle.evaluate(f).0,
            Expression::Function(call, list) => {
                let list: Vec<u64> = list.iter().map(|e| e.evaluate(f)).collect();
                f.call(*call, &list)
            }
            Expression::Dot(a, b) => {
                let (a, b) = (a.evaluate(f), b.evaluate(f));
                (0..3).fold(0, |sum, k| f.add(sum, f.mul(a[k], b[k])))
            }
            Expression::Component(v, axis) => v.evaluate(f)[*axis],
        }
    }

    /// With one place changed: another literal, another symbol, a plus for a minus, a sine for a cosine.
    pub(crate) fn broken(&self, rng: &mut Rng) -> Expression {
        use Expression::*;
        let change = |list: &[Expression], rng: &mut Rng| {
            let mut list = list.to_vec();
            let at = rng.below(list.len());
            list[at] = list[at].broken(rng);
            list
        };
        match self {
            Symbol(k) => Symbol((k + 1) % SYMBOLS),
            Decimal(x) => Decimal(x + 0.25),
            Sum(list) => Sum(change(list, rng)),
            Difference(a, b) => Sum(vec![(**a).clone(), (**b).clone()]),
            Product(list) => Product(change(list, rng)),
            Quotient(a, b) => Quotient(b.clone(), a.clone()),
            Root(x) => Root(Box::new(x.broken(rng))),
            Sin(angle) => Cos(angle.clone()),
            Cos(angle) => Sin(angle.clone()),
            Function(call, list) => Function(*call, change(list, rng)),
            Dot(a, b) => Dot(a.clone(), Box::new(Triple::Cross(a.clone(), b.clone()))),
            Component(v, axis) => Component(v.clone(), (axis + 1) % 3),
        }
    }
}

impl Triple {
    fn random(rng: &mut Rng, depth: usize) -> Triple {
        let one = |rng: &mut Rng| Expression::random(rng, depth.saturating_sub(1));
        let triple = |rng: &mut Rng| Box::new(Triple::random(rng, depth - 1));
        if depth == 0 || rng.chance(20) {
            return Triple::Of(Box::new([one(rng), one(rng), one(rng)]));
        }
        match rng.below(5) {
            0 => Triple::Sum(vec![*triple(rng), *triple(rng)]),
            1 => Triple::Scale(one(rng), triple(rng)),
            2 => Triple::Cross(triple(rng), triple(rng)),
            _ => Triple::Turn(rng.below(3), Angle::random(rng), rng.chance(50), triple(rng)),
        }
    }

    fn visit(&self, f: &mut dyn FnMut(&Angle)) {
        match self {
            Triple::Of(list) => list.iter().for_each(|e| e.visit(f)),
            Triple::Sum(list) => list.iter().for_each(|v| v.visit(f)),
            Triple::Scale(s, v) => {
                s.visit(f);
                v.visit(f);
            }
            Triple::Cross(a, b) => [a, b].into_iter().for_each(|v| v.visit(f)),
            Triple::Turn(_, angle, _, v) => {
                f(angle);
                v.visit(f);
            }
        }
    }

    fn build(&self, g: &mut Graph, symbols: &[Scalar; SYMBOLS]) -> Vector {
        match self {
            Triple::Of(list) => {
                let [x, y, z] = &**list;
                let list = [x, y, z].map(|e| e.build(g, symbols));
                g.vector(list)
            }
            Triple::Sum(list) => {
                let list: Vec<Vector> = list.iter().map(|v| v.build(g, symbols)).collect();
                g.sum_vectors(&list)
            }
            Triple::Scale(s, v) => {
                let (s, v) = (s.build(g, symbols), v.build(g, symbols));
                g.scale(s, v)
            }
            Triple::Cross(a, b) => {
                let (a, b) = (a.build(g, symbols), b.build(g, symbols));
                g.cross(a, b)
            }
            Triple::Turn(axis, angle, back, v) => {
                let (angle, v) = (angle.build(g, symbols), v.build(g, symbols));
                let r = g.axis_rotation(*axis, angle);
                g.rotate(if *back { r.transpose() } else { r }, v)
            }
        }
    }

    fn evaluate(&self, f: &Modular<'_>) -> [u64; 3] {
        let minus = |a, b| f.add(a, f.neg(b));
        match self {
            Triple::Of(list) => [0, 1, 2].map(|k| list[k].evaluate(f)),
            Triple::Sum(list) => list.iter().fold([0; 3], |sum, v| {
                let v = v.evaluate(f);
                [0, 1, 2].map(|k| f.add(sum[k], v[k]))
            }),
            Triple::Scale(s, v) => {
                let s = s.evaluate(f);
                v.evaluate(f).map(|x| f.mul(s, x))
            }
            Triple::Cross(a, b) => {
                let (a, b) = (a.evaluate(f), b.evaluate(f));
                let term = |i: usize, j: usize| minus(f.mul(a[i], b[j]), f.mul(a[j], b[i]));
                [term(1, 2), term(2, 0), term(0, 1)]
            }
            Triple::Turn(axis, angle, back, v) => {
                let (cos, sin) = angle.evaluate(f);
                let sin = if *back { f.neg(sin) } else { sin };
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut turned = v.evaluate(f);
                let (x, y) = (turned[j], turned[k]);
                turned[j] = minus(f.mul(cos, x), f.mul(sin, y));
                turned[k] = f.add(f.mul(sin, x), f.mul(cos, y));
                turned
            }
        }
    }
}
