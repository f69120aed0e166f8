//! Symbolic derivatives against dual numbers and finite differences, and exactly against each other.

use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::model::types::ExternalId;
use multibody_engine::symbolic::differentiate::Differentiator;
use multibody_engine::symbolic::evaluate::{Evaluator, Field, Real, call_f64};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Rotation, Scalar, SymbolId, Vector};
use multibody_engine::symbolic::identity::{Verdict, identical};
use multibody_engine::symbolic::lower::Lowering;
use multibody_engine::symbolic::number::Number;

/// Value and derivative.
type Dual = (f64, f64);

/// Evaluates the undifferentiated graph with dual numbers.
struct Duals<'a>(&'a [Dual]);

impl Field for Duals<'_> {
    type Value = Dual;
    fn literal(&self, n: Number) -> Dual {
        (n.value(), 0.0)
    }
    fn symbol(&self, id: SymbolId) -> Dual {
        self.0[id.0]
    }
    fn add(&self, a: Dual, b: Dual) -> Dual {
        (a.0 + b.0, a.1 + b.1)
    }
    fn mul(&self, a: Dual, b: Dual) -> Dual {
        (a.0 * b.0, a.1 * b.0 + a.0 * b.1)
    }
    fn neg(&self, a: Dual) -> Dual {
        (-a.0, -a.1)
    }
    fn reciprocal(&self, a: Dual) -> Dual {
        (1.0 / a.0, -a.1 / (a.0 * a.0))
    }
    fn call(&self, call: Call, x: &[Dual]) -> Dual {
        let values: Vec<f64> = x.iter().map(|x| x.0).collect();
        let value = call_f64(call, &values);
        let slope = match (call, &values[..], x) {
            (Call::Sqrt, _, [a]) => a.1 / (2.0 * value),
            (Call::Tan, [a], [d]) => d.1 / a.cos().powi(2),
            (Call::Asin, [a], [d]) => d.1 / (1.0 - a * a).sqrt(),
            (Call::Acos, [a], [d]) => -d.1 / (1.0 - a * a).sqrt(),
            (Call::Atan, [a], [d]) => d.1 / (1.0 + a * a),
            (Call::Atan2, [y, x], [dy, dx]) => (x * dy.1 - y * dx.1) / (x * x + y * y),
            (Call::Sinh, [a], [d]) => a.cosh() * d.1,
            (Call::Cosh, [a], [d]) => a.sinh() * d.1,
            (Call::Tanh, [a], [d]) => d.1 / a.cosh().powi(2),
            (Call::Exp, _, [d]) => value * d.1,
            (Call::Ln, [a], [d]) => d.1 / a,
            (Call::Powf, [a, b], [da, db]) => value * (db.1 * a.ln() + b * da.1 / a),
            (Call::Abs, [a], [d]) => a.signum() * d.1,
            (Call::Min, [a, b], [da, db]) => (if a < b { da } else { db }).1,
            (Call::Max, [a, b], [da, db]) => (if a > b { da } else { db }).1,
            (Call::Select, [m, ..], [_, a, b]) => (if *m == 0.0 { b } else { a }).1,
            _ => 0.0,
        };
        (value, slope)
    }
    fn point(&self, _: &Graph, _: Scalar, a: Dual, _: &dyn Fn(Scalar) -> Dual) -> (Dual, Dual) {
        let (s, c) = a.0.sin_cos();
        ((c, -s * a.1), (s, c * a.1))
    }
    /// Elimination without pivots.
    fn solve(&self, _: bool, matrix: &[Dual], rhs: &[Dual]) -> Vec<Dual> {
        let n = rhs.len();
        let mut rows: Vec<Vec<Dual>> =
            (0..n).map(|i| matrix[i * n..(i + 1) * n].iter().chain([&rhs[i]]).copied().collect()).collect();
        for k in 0..n {
            let row = rows[k].clone();
            let inverse = self.reciprocal(row[k]);
            rows[k].iter_mut().for_each(|x| *x = self.mul(*x, inverse));
            let row = rows[k].clone();
            for i in (0..n).filter(|&i| i != k) {
                let factor = self.neg(rows[i][k]);
                for (x, &y) in rows[i].iter_mut().zip(&row) {
                    *x = self.add(*x, self.mul(factor, y));
                }
            }
        }
        rows.iter().map(|row| row[n]).chain([(n as f64, 0.0)]).collect()
    }
}

fn values(g: &Graph, roots: &[Scalar], point: &[f64]) -> Vec<f64> {
    let symbols = |id: SymbolId| point[id.0];
    Evaluator::new(g, Real { symbols: &symbols }).run(roots)
}

/// Scalars and vectors to grow random expressions from: six free symbols, a unit quaternion, and everything made so far.
struct Garden {
    g: Graph,
    symbols: Vec<Scalar>,
    scalars: Vec<Scalar>,
    vectors: Vec<Vector>,
    rotations: Vec<Rotation>,
}

impl Garden {
    fn new() -> Garden {
        let mut g = Graph::new();
        let mut symbols: Vec<Scalar> = (0..6).map(|_| g.symbol()).collect();
        let q = g.unit_quaternion();
        let vectors = vec![g.vector([symbols[0], symbols[1], symbols[2]]), g.vector([symbols[5], symbols[3], q[1]])];
        let rotations = vec![g.quaternion_rotation(q)];
        symbols.extend(q);
        Garden { g, scalars: symbols.clone(), symbols, vectors, rotations }
    }

    fn scalar(&self, rng: &mut Rng) -> Scalar {
        self.scalars[rng.below(self.scalars.len())]
    }

    fn vector(&self, rng: &mut Rng) -> Vector {
        self.vectors[rng.below(self.vectors.len())]
    }

    /// Kept near one in size, so that nothing runs away.
    fn bounded(&mut self, s: Scalar) -> Scalar {
        let square = self.g.mul(s, s);
        let sum = self.g.add(square, Scalar::ONE);
        self.g.sqrt(sum)
    }

    fn grow(&mut self, rng: &mut Rng) {
        let (a, b) = (self.scalar(rng), self.scalar(rng));
        let (u, v) = (self.vector(rng), self.vector(rng));
        let g = &mut self.g;
        // Sums of coordinates, as in mechanisms.
        let (halves, constant) = (g.decimal(0.5 * rng.below(4) as f64), g.decimal(rng.decimal(0.0, 2.0)));
        let half = g.mul(halves, self.symbols[rng.below(6)]);
        let angle = g.sum(&[self.symbols[rng.below(6)], -half, constant]);
        match rng.below(12) {
            0 => self.scalars.push(g.sum(&[a, b, -Scalar::ONE])),
            1 => self.scalars.push(g.mul(a, b)),
            2 => {
                let over = self.bounded(b);
                self.scalars.push(self.g.div(a, over));
            }
            3 => self.scalars.push(g.sin(angle)),
            4 => self.scalars.push(g.cos(angle)),
            5 => self.scalars.push(g.dot(u, v)),
            6 => self.scalars.push(g.component(u, rng.below(3))),
            7 => self.vectors.push(g.sub_vectors(u, v)),
            8 => {
                let s = g.sin(angle);
                self.vectors.push(g.scale(s, v));
            }
            9 => self.vectors.push(g.cross(u, v)),
            10 => {
                let axis = g.axis_rotation(rng.below(3), angle);
                let other = self.rotations[rng.below(self.rotations.len())];
                let r = g.compose(axis, if rng.chance(50) { other } else { other.transpose() });
                self.rotations.push(r);
            }
            _ => {
                let r = self.rotations[rng.below(self.rotations.len())];
                self.vectors.push(g.rotate(if rng.chance(50) { r } else { r.transpose() }, v));
            }
        }
    }

    /// A point, and a direction along which the quaternion stays on its sphere.
    fn point(rng: &mut Rng) -> Vec<Dual> {
        let mut point: Vec<Dual> = (0..10).map(|_| (rng.real(-1.0, 1.0), rng.real(-1.0, 1.0))).collect();
        let norm = point[6..].iter().map(|x| x.0 * x.0).sum::<f64>().sqrt();
        point[6..].iter_mut().for_each(|x| x.0 /= norm);
        let along: f64 = point[6..].iter().map(|x| x.0 * x.1).sum();
        point[6..].iter_mut().for_each(|x| x.1 -= along * x.0);
        point
    }
}

#[test]
fn random_expressions_agree_with_dual_numbers() {
    for seed in 0..60 {
        let mut rng = Rng::new(seed);
        let mut garden = Garden::new();
        for _ in 0..30 {
            garden.grow(&mut rng);
        }
        let roots = garden.scalars.clone();
        let g = &mut garden.g;
        let seeds: Vec<(Scalar, Scalar)> = garden.symbols.iter().map(|&s| (s, g.symbol())).collect();
        let derivatives = Differentiator::new(&seeds).scalars(g, &roots);
        let point = Garden::point(&mut rng);
        let want = Evaluator::new(g, Duals(&point)).run(&roots);
        let flat: Vec<f64> = point.iter().map(|x| x.0).chain(point.iter().map(|x| x.1)).collect();
        for (got, want) in values(g, &derivatives, &flat).iter().zip(&want) {
            assert!((got - want.1).abs() <= 1e-10 * (1.0 + want.1.abs()), "seed {seed}: {got} for {}", want.1);
        }
    }
}

/// Differentiated as vectors and then lowered, or lowered and then differentiated as scalars.
#[test]
fn vectors_differentiate_as_their_components() {
    for seed in 0..30 {
        let mut rng = Rng::new(1000 + seed);
        let mut garden = Garden::new();
        for _ in 0..20 {
            garden.grow(&mut rng);
        }
        let g = &mut garden.g;
        // The quaternion rests: single components of its derivative mean nothing.
        let seeds: Vec<(Scalar, Scalar)> = garden.symbols[..6].iter().map(|&s| (s, g.symbol())).collect();
        let roots: Vec<Scalar> = garden.vectors.iter().flat_map(|&v| g.components(v)).collect();
        let (mut low, lowered) = {
            let mut lowering = Lowering::new(g);
            let lowered = lowering.run(&roots);
            (lowering.to, lowered)
        };
        let mut differentiator = Differentiator::new(&seeds);
        let whole: Vec<Scalar> = garden
            .vectors
            .iter()
            .flat_map(|&v| {
                let d = differentiator.vector(g, v);
                g.components(d)
            })
            .collect();
        let at = |s: Scalar| low.symbol_handle(SymbolId(symbol_number(g, s))).unwrap();
        let low_seeds: Vec<(Scalar, Scalar)> = seeds.iter().map(|&(s, d)| (at(s), at(d))).collect();
        let parts = Differentiator::new(&low_seeds).scalars(&mut low, &lowered);
        assert_eq!(identical(g, &whole, &low, &parts, seed), Verdict::Identical, "seed {seed}");
    }
}

/// Chains of rotations about axes, by literals and by a quaternion, forwards and back, composed or one after the other.
#[test]
fn what_stands_on_a_body_turns_with_it() {
    for seed in 0..200 {
        let mut rng = Rng::new(seed);
        let mut g = Graph::new();
        let q: Vec<Scalar> = (0..4).map(|_| g.symbol()).collect();
        let ball = g.unit_quaternion();
        let v: Vec<Scalar> = (0..8).map(|_| g.symbol()).collect();
        let a: Vec<Scalar> = (0..8).map(|_| g.symbol()).collect();
        // The quaternion rests in every other one, so that the second derivative is one along its sphere.
        let rests = seed % 2 == 0;
        let mut points: Vec<Vector> = (0..3)
            .map(|_| {
                let components = [0; 3].map(|_| g.decimal(rng.decimal(-2.0, 2.0)));
                g.vector(components)
            })
            .collect();
        for _ in 0..2 + rng.below(4) {
            let angle = g.decimal(rng.decimal(-3.0, 3.0));
            let turn = |g: &mut Graph, rng: &mut Rng| {
                let r = match rng.below(6) {
                    0 => g.axis_rotation(rng.below(3), angle),
                    1 => g.quaternion_rotation(ball),
                    _ => g.axis_rotation(rng.below(3), q[rng.below(4)]),
                };
                if rng.chance(50) { r } else { r.transpose() }
            };
            let mut r = turn(&mut g, &mut rng);
            if rng.chance(30) {
                let other = turn(&mut g, &mut rng);
                r = g.compose(r, other);
            }
            points = points.into_iter().map(|point| g.rotate(r, point)).collect();
        }
        let all: Vec<Scalar> = q.iter().copied().chain(ball).collect();
        let moving = if rests { 4 } else { 8 };
        let along = |from: &[Scalar], to: &[Scalar]| -> Vec<(Scalar, Scalar)> {
            from[..moving].iter().copied().zip(to.iter().copied()).collect()
        };
        let roots: Vec<Scalar> = points.iter().flat_map(|&point| g.components(point)).collect();
        let [plain, on_bodies] = [false, true].map(|on_bodies| {
            let mut g = g.clone();
            let mut first = Differentiator::new(&along(&all, &v));
            if on_bodies {
                first = first.with_turns_of_bodies();
            }
            let rates: Vec<Scalar> = points
                .iter()
                .flat_map(|&point| {
                    let rate = first.vector(&mut g, point);
                    g.components(rate)
                })
                .collect();
            let seeds: Vec<(Scalar, Scalar)> = along(&all, &v).into_iter().chain(along(&v, &a)).collect();
            let mut second = Differentiator::new(&seeds);
            if on_bodies {
                second = second.with_turns_of_bodies();
            }
            let accelerations = second.scalars(&mut g, &rates);
            (g, rates, accelerations)
        });
        // The point, with the quaternion on its sphere and its rate along it.
        let mut numbers: Vec<f64> = (0..24).map(|_| rng.real(-1.5, 1.5)).collect();
        let norm = numbers[4..8].iter().map(|x| x * x).sum::<f64>().sqrt();
        numbers[4..8].iter_mut().for_each(|x| *x /= norm);
        let radial: f64 = (0..4).map(|k| numbers[4 + k] * numbers[12 + k]).sum();
        (0..4).for_each(|k| numbers[12 + k] -= radial * numbers[4 + k]);
        let dual = |at: usize| (numbers[at], if at % 8 < moving { numbers[at + 8] } else { 0.0 });
        let duals: Vec<Dual> = (0..16).map(dual).collect();
        let want = Evaluator::new(&g, Duals(&duals)).run(&roots);
        let (g, rates, accelerations) = on_bodies;
        for (got, want) in values(&g, &rates, &numbers).iter().zip(&want) {
            assert!((got - want.1).abs() <= 1e-11, "seed {seed}: {got} for {}", want.1);
        }
        if rests {
            let want = Evaluator::new(&plain.0, Duals(&duals)).run(&plain.1);
            for (got, want) in values(&g, &accelerations, &numbers).iter().zip(&want) {
                assert!((got - want.1).abs() <= 1e-10, "seed {seed}: {got} for {}", want.1);
            }
        }
    }
}

/// Six points of a body whose orientation is roll, pitch and yaw: one angular velocity for all of them.
#[test]
fn points_of_a_body_share_its_angular_velocity() {
    let mut g = Graph::new();
    let q: Vec<Scalar> = (0..3).map(|_| g.symbol()).collect();
    let v: Vec<Scalar> = (0..3).map(|_| g.symbol()).collect();
    let points: Vec<Vector> = (1..7)
        .map(|k| {
            let components = [k, 2 * k - 7, 5 - k].map(|x| g.integer(x));
            let mut point = g.vector(components);
            for (axis, &angle) in q.iter().enumerate() {
                let r = g.axis_rotation(axis, angle);
                point = g.rotate(r, point);
            }
            point
        })
        .collect();
    let seeds: Vec<(Scalar, Scalar)> = q.iter().copied().zip(v).collect();
    let [plain, on_bodies] = [false, true].map(|on_bodies| {
        let mut g = g.clone();
        let along = Differentiator::new(&seeds);
        let mut along = if on_bodies { along.with_turns_of_bodies() } else { along };
        let rates: Vec<Scalar> = points
            .iter()
            .flat_map(|&point| {
                let rate = along.vector(&mut g, point);
                g.components(rate)
            })
            .collect();
        let mut lowering = Lowering::new(&g);
        let roots = lowering.run(&rates);
        lowering.to.cost(&roots).weight()
    });
    assert!(10 * on_bodies < 9 * plain, "{on_bodies} of {plain}");
}

fn symbol_number(g: &Graph, s: Scalar) -> usize {
    (0..).find(|&id| g.symbol_handle(SymbolId(id)) == Some(s)).unwrap()
}

/// Central differences, for each function by itself.
#[test]
fn functions_agree_with_differences() {
    use Call::*;
    let unary = [Tan, Asin, Acos, Atan, Sinh, Cosh, Tanh, Exp, Ln, Sqrt, Abs, Signum];
    let binary = [Atan2, Powf, Min, Max];
    for call in unary.into_iter().chain(binary) {
        for point in [[0.3, 0.7], [0.8, 0.2], [0.55, 0.4]] {
            let mut g = Graph::new();
            let (x, y) = (g.symbol(), g.symbol());
            let arguments = if unary.contains(&call) { vec![x] } else { vec![x, y] };
            let f = g.call(call, &arguments);
            let slopes = g.gradient(f, &[x, y]);
            let got = values(&g, &slopes, &point);
            for k in 0..2 {
                let h = 1e-6;
                let at = |h: f64| {
                    let mut moved = point;
                    moved[k] += h;
                    values(&g, &[f], &moved)[0]
                };
                let want = (at(h) - at(-h)) / (2.0 * h);
                assert!((got[k] - want).abs() < 1e-8, "{call:?} at {point:?}: {} for {want}", got[k]);
            }
        }
    }
}

#[test]
fn kinks_take_the_branch_of_the_value() {
    let mut g = Graph::new();
    let (x, y) = (g.symbol(), g.symbol());
    let abs = g.call(Call::Abs, &[x]);
    let larger = g.call(Call::Max, &[x, y]);
    let mask = g.call(Call::Less, &[x, y]);
    let square = g.mul(x, x);
    let chosen = g.call(Call::Select, &[mask, square, y]);
    let slopes: Vec<Scalar> =
        [abs, larger, mask, chosen].iter().map(|&f| g.derivative(f, &[(x, Scalar::ONE)])).collect();
    assert_eq!(values(&g, &slopes, &[-2.0, 1.0]), [-1.0, 0.0, 0.0, -4.0]);
    assert_eq!(values(&g, &slopes, &[3.0, 1.0]), [1.0, 1.0, 0.0, 0.0]);
}

/// A power that is zero stays so as its exponent moves; of one at a base of zero that isn't, the slope is as infinite as it is.
#[test]
fn powers_of_zero_have_slopes() {
    let mut g = Graph::new();
    let (x, y) = (g.symbol(), g.symbol());
    let power = g.call(Call::Powf, &[x, y]);
    let slopes = [[Scalar::ZERO, Scalar::ONE], [Scalar::ONE, Scalar::ONE]]
        .map(|[dx, dy]| g.derivative(power, &[(x, dx), (y, dy)]));
    assert_eq!(values(&g, &slopes, &[0.0, 2.5]), [0.0, 0.0]);
    assert_eq!(values(&g, &slopes, &[0.0, 1.0]), [0.0, 1.0]);
    assert!(values(&g, &slopes, &[0.0, 0.0]).iter().all(|slope| !slope.is_finite()));
    assert!(values(&g, &slopes, &[-1.0, 1.5]).iter().all(|slope| slope.is_nan()));
    let logarithm = 2f64.ln();
    assert_eq!(values(&g, &slopes[..1], &[2.0, 1.0]), [2.0 * logarithm]);
}

/// Written by hand in a graph of their own, so that no print can find them.
#[test]
fn rules_are_exact() {
    let make = || {
        let mut g = Graph::new();
        let symbols: [Scalar; 4] = [(); 4].map(|()| g.symbol());
        (g, symbols)
    };
    let (mut g, [x, y, dx, dy]) = make();
    let seeds = [(x, dx), (y, dy)];
    let product = g.product(&[x, x, y]);
    let quotient = g.div(x, y);
    let (sx, cy) = (g.sin(x), g.cos(y));
    let wave = g.mul(sx, cy);
    let squares = [g.mul(x, x), g.mul(y, y)];
    let square = g.sum(&squares);
    let length = g.sqrt(square);
    let got = Differentiator::new(&seeds).scalars(&mut g, &[product, quotient, wave, length]);

    let (mut h, [x, y, dx, dy]) = make();
    let two = h.integer(2);
    let terms = [h.product(&[two, x, y, dx]), h.product(&[x, x, dy])];
    let product = h.sum(&terms);
    let terms = [h.mul(y, dx), -h.mul(x, dy)];
    let (over, square) = (h.sum(&terms), h.mul(y, y));
    let quotient = h.div(over, square);
    // sin(x) cos(y) = (sin(x + y) + sin(x - y)) / 2
    let (plus, minus, rate, difference) = (h.add(x, y), h.sub(x, y), h.add(dx, dy), h.sub(dx, dy));
    let (plus, minus) = (h.cos(plus), h.cos(minus));
    let terms = [h.mul(plus, rate), h.mul(minus, difference)];
    let (sum, half) = (h.sum(&terms), h.decimal(0.5));
    let wave = h.mul(half, sum);
    let terms = [h.mul(x, dx), h.mul(y, dy)];
    let along = h.sum(&terms);
    let squares = [h.mul(x, x), square];
    let square = h.sum(&squares);
    let root = h.sqrt(square);
    let length = h.div(along, root);
    assert_eq!(identical(&g, &got, &h, &[product, quotient, wave, length], 5), Verdict::Identical);
}

/// A chain of a hundred thousand operations neither overflows the stack nor takes long.
#[test]
fn deep_expressions_are_fine() {
    let mut g = Graph::new();
    let (x, y) = (g.symbol(), g.symbol());
    let mut s = x;
    for _ in 0..50_000 {
        let product = g.mul(s, y);
        s = g.add(product, x);
    }
    let d = g.derivative(s, &[(x, Scalar::ONE)]);
    assert!((values(&g, &[d], &[1.0, 0.5])[0] - 2.0).abs() < 1e-12);
}

#[test]
fn linear_systems() {
    let mut g = Graph::new();
    let x: [Scalar; 3] = std::array::from_fn(|_| g.symbol());
    let (square, sine) = (g.mul(x[0], x[0]), g.sin(x[1]));
    let diagonal = g.add(square, Scalar::ONE);
    let system = [diagonal, sine, x[2], -sine, x[0], x[1], Scalar::ONE, -x[2], diagonal, x[1], sine, x[0]];
    let outputs = g.block_outputs(BlockKind::Solve { size: 3, symmetric: false, groups: [].into() }, &system);
    let product = g.mul(outputs[0], outputs[1]);
    let roots = [product, outputs[2], outputs[3]];
    let seeds: Vec<(Scalar, Scalar)> = x.iter().map(|&s| (s, g.symbol())).collect();
    let mut along = Differentiator::new(&seeds);
    let slopes = along.scalars(&mut g, &roots);
    let point = [0.7, -0.4, 1.3, 0.2, -1.1, 0.6];
    let duals: Vec<Dual> = (0..6).map(|k| (point[k], if k < 3 { point[k + 3] } else { 0.0 })).collect();
    let expected = Evaluator::new(&g, Duals(&duals)).run(&roots);
    for (value, expected) in values(&g, &slopes, &point).iter().zip(expected) {
        assert!((value - expected.1).abs() < 1e-13 * (1.0 + value.abs()), "{value} {}", expected.1);
    }
}

/// An angle that is known by its cosine and sine: twice the arc tangent of x.
#[test]
fn angles_of_points() {
    let mut g = Graph::new();
    let x = g.symbol();
    let xx = g.mul(x, x);
    let (below, above) = (g.add(Scalar::ONE, xx), g.sub(Scalar::ONE, xx));
    let inverse = g.reciprocal(below);
    let two = g.integer(2);
    let (cos, sin) = (g.mul(above, inverse), g.product(&[two, x, inverse]));
    let angle = g.angle(cos, sin);
    let expected = g.mul(two, inverse);
    assert_eq!(g.derivative(angle, &[(x, Scalar::ONE)]), expected);
    assert_eq!(g.derivative(angle, &[(-x, Scalar::ONE)]), -expected);
}

/// A linear system all of whose operands move.
#[test]
fn blocks_that_move_in_all_operands() {
    let mut g = Graph::new();
    let [a, b] = [(); 2].map(|()| g.symbol());
    let kind = BlockKind::Solve { size: 1, symmetric: false, groups: Box::new([0]) };
    let found = g.block_outputs(kind, &[a, b])[0];
    let slope = g.derivative(found, &[(a, Scalar::ONE), (b, Scalar::ONE)]);
    let symbols = |id: SymbolId| [3.0, 5.0][id.0];
    let value = Evaluator::new(&g, Real { symbols: &symbols }).run(&[slope])[0];
    // (b / a)' = b' / a - b a' / a^2
    assert!((value - (1.0 / 3.0 - 5.0 / 9.0)).abs() < 1e-12, "{value}");
}

/// Functions of the user's own: the chain rule by their slopes, against differences of the values of what stands for them.
#[test]
fn functions_of_rust_follow_the_chain_rule() {
    let mut g = Graph::new();
    let x: Vec<Scalar> = (0..3).map(|_| g.symbol()).collect();
    let (f, h) = (ExternalId(0), ExternalId(1));
    let sine = g.sin(x[1]);
    let product = g.mul(x[0], sine);
    let inner = g.call(Call::External(h), &[product]);
    // An argument that stands twice, one with a sign, one that is another call.
    let value = g.call(Call::External(f), &[-x[0], inner, x[0], x[2]]);
    let again = g.call(Call::External(f), &[-x[0], inner, x[0], x[2]]);
    assert_eq!(value, again, "equal calls are one");
    let other = g.call(Call::External(f), &[x[0], inner, -x[0], x[2]]);
    assert_ne!(value, other);
    assert_ne!(value, -other);
    let root = g.mul(value, x[2]);
    let slopes = g.gradient(root, &x);
    let back = g.transpose_linear(&[(root, Scalar::ONE)], &x);
    let at = |x: &[f64; 3], s: Scalar| {
        let symbols = |id: SymbolId| x[id.0];
        Evaluator::new(&g, Real { symbols: &symbols }).run(&[s])[0]
    };
    for place in [[0.3, -1.2, 0.7], [2.0, 0.4, -3.0]] {
        for k in 0..3 {
            let moved = |step: f64| {
                let mut place = place;
                place[k] += step;
                at(&place, root)
            };
            let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((at(&place, slopes[k]) - difference).abs() < 1e-8, "{k}: {difference}");
            assert!((at(&place, back[k]) - difference).abs() < 1e-8, "{k}: {difference}");
        }
    }
}

/// Slopes of slopes are there as long as they cancel, and are told where they don't.
#[test]
fn slopes_of_slopes_of_functions_of_rust_are_told() {
    let mut g = Graph::new();
    let (x, y) = (g.symbol(), g.symbol());
    let f = g.call(Call::External(ExternalId(3)), &[x, y]);
    let slope = g.derivative(f, &[(x, Scalar::ONE)]);
    assert_eq!(g.curvature(&[f, slope]), None);
    let product = g.mul(slope, y);
    assert_eq!(g.derivative(product, &[(x, Scalar::ZERO)]), Scalar::ZERO);
    let twice = g.derivative(product, &[(y, Scalar::ONE)]);
    assert_eq!(g.curvature(&[twice]), Some(ExternalId(3)));
    let mixed = [g.derivative(slope, &[(x, Scalar::ONE)]), g.derivative(slope, &[(y, Scalar::ONE)])];
    let difference = g.sub(mixed[0], mixed[1]);
    assert_ne!(difference, Scalar::ZERO, "one slope of a slope is not another");
    let third = g.derivative(mixed[0], &[(x, Scalar::ONE)]);
    assert_eq!(g.curvature(&[third]), Some(ExternalId(3)));
    let same = g.derivative(slope, &[(x, Scalar::ONE)]);
    assert_eq!(g.sub(mixed[0], same), Scalar::ZERO);
    // No literal makes a number of it.
    let two = g.integer(2);
    let of_literals = g.call(Call::External(ExternalId(3)), &[two, two]);
    assert_eq!(g.literal(of_literals), None);
}
