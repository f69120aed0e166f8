//! Vectors and rotations by the graph against plain numbers.

use crate::rng::Rng;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::{Graph, Rotation, Scalar, SymbolId, Vector};
use multibody_engine::symbolic::lower::Lowering;

fn values(g: &mut Graph, v: Vector, point: &[f64]) -> [f64; 3] {
    let components = g.components(v);
    let symbols = |id: SymbolId| point.get(id.0).copied().unwrap_or(f64::NAN);
    let values = Evaluator::new(g, Real { symbols: &symbols }).run(&components);
    [values[0], values[1], values[2]]
}

fn literal(g: &mut Graph, components: [i64; 3]) -> Vector {
    let components = components.map(|c| g.integer(c));
    g.vector(components)
}

#[track_caller]
fn assert_near(got: [f64; 3], want: [f64; 3]) {
    assert!(got.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-12), "{got:?} for {want:?}");
}

/// Of both signs of each: a vector and its opposite are one node.
#[test]
fn products_of_literal_vectors() {
    for signs in 0..4 {
        let mut g = Graph::new();
        let [mut a, mut b] = [[1, 2, 3], [4, 5, -6]].map(|v| literal(&mut g, v));
        let mut sign = 1.0;
        if signs & 1 == 1 {
            (a, sign) = (-a, -sign);
        }
        if signs & 2 == 2 {
            (b, sign) = (-b, -sign);
        }
        let cross = g.cross(a, b);
        assert_near(values(&mut g, cross, &[]), [-27.0, 18.0, -3.0].map(|x| sign * x));
        let dot = g.dot(a, b);
        assert_eq!(g.literal(dot).map(|n| n.value()), Some(-4.0 * sign));
    }
}

/// Turns about one axis and about several, one after the other and composed.
#[test]
fn composed_rotations_turn_as_their_factors() {
    let plain = |axis: usize, angle: f64, v: [f64; 3]| {
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut turned = v;
        turned[j] = angle.cos() * v[j] - angle.sin() * v[k];
        turned[k] = angle.sin() * v[j] + angle.cos() * v[k];
        turned
    };
    for seed in 0..200 {
        let mut rng = Rng::new(seed);
        let mut g = Graph::new();
        let symbols: Vec<Scalar> = (0..3).map(|_| g.symbol()).collect();
        let point: Vec<f64> = (0..3).map(|_| rng.real(-3.0, 3.0)).collect();
        let axes: Vec<usize> = (0..3).map(|_| rng.below(3)).collect();
        let turns: Vec<Rotation> = axes.iter().zip(&symbols).map(|(&axis, &q)| g.axis_rotation(axis, q)).collect();
        let inner = g.compose(turns[0], turns[1]);
        let whole = g.compose(inner, turns[2]);
        let v = literal(&mut g, [1, -2, 3]);
        let mut want = [1.0, -2.0, 3.0];
        for k in (0..3).rev() {
            want = plain(axes[k], point[k], want);
        }
        let turned = g.rotate(whole, v);
        assert_near(values(&mut g, turned, &point), want);
        let back = g.rotate(whole.transpose(), turned);
        assert_near(values(&mut g, back, &point), [1.0, -2.0, 3.0]);
    }
}

/// A scalar product is the same in any axes, and is written in those that need no rotation.
#[test]
fn a_product_of_vectors_forgets_what_turns_both() {
    for signs in 0..4 {
        let mut g = Graph::new();
        let symbols: Vec<Scalar> = (0..8).map(|_| g.symbol()).collect();
        let first = g.vector([symbols[0], symbols[1], symbols[2]]);
        let second = g.vector([symbols[3], symbols[4], symbols[5]]);
        let (tilt, turn) = (g.axis_rotation(1, symbols[6]), g.axis_rotation(2, symbols[7]));
        let mut turned = [first, second].map(|v| {
            let v = g.rotate(tilt, v);
            g.rotate(turn.transpose(), v)
        });
        (0..2).filter(|k| signs >> k & 1 == 1).for_each(|k| turned[k] = -turned[k]);
        let dot = g.dot(turned[0], turned[1]);
        let mut lowering = Lowering::new(&g);
        let roots = lowering.run(&[dot]);
        let cost = lowering.to.cost(&roots);
        assert_eq!((cost.add, cost.mul, cost.sincos), (2, 3, 0), "{cost:?}");
        let point = [0.3, -0.7, 1.1, 0.9, -1.3, 0.4, 0.8, -2.1];
        let symbols = |id: SymbolId| point[id.0];
        let got = Evaluator::new(&g, Real { symbols: &symbols }).run(&[dot])[0];
        let sign = if signs == 1 || signs == 2 { -1.0 } else { 1.0 };
        let want: f64 = (0..3).map(|k| point[k] * point[k + 3]).sum();
        assert!((got - sign * want).abs() < 1e-14, "{got} for {want}");
    }
}
