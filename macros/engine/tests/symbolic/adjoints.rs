//! Weighted derivatives from the results' side, against derivatives along each symbol, exactly.

use crate::rng::Rng;
use multibody_engine::symbolic::differentiate::Differentiator;
use multibody_engine::symbolic::graph::{BlockKind, Graph, Scalar, Vector};
use multibody_engine::symbolic::identity::{Verdict, identical};
use multibody_engine::symbolic::lower::Lowering;

/// Velocities of a random chain: `n` hinges or slides, one ball; rates last. Every node kind that carries vectors.
struct Chain {
    graph: Graph,
    q: Vec<Scalar>,
    rates: Vec<Scalar>,
    /// Linear and angular velocities of all links, in link axes.
    velocities: Vec<Vector>,
}

fn chain(seed: u64, n: usize) -> Chain {
    let mut rng = Rng::new(seed);
    let mut g = Graph::new();
    let q: Vec<Scalar> = (0..n).map(|_| g.symbol()).collect();
    let ball = g.unit_quaternion();
    let rates: Vec<Scalar> = (0..n + 3).map(|_| g.symbol()).collect();
    let lengths: Vec<[Scalar; 3]> = (0..n + 1).map(|_| [(); 3].map(|()| g.symbol())).collect();
    let mut velocities = Vec::new();
    let (mut linear, mut angular) = (Vector::ZERO, Vector::ZERO);
    for k in 0..=n {
        let offset = g.vector(lengths[k]);
        let swept = g.cross(angular, offset);
        linear = g.add_vectors(linear, swept);
        let axis = rng.below(3);
        let turn = match k {
            0 => g.quaternion_rotation(ball),
            _ => g.axis_rotation(axis, q[k - 1]),
        };
        linear = g.rotate(turn.transpose(), linear);
        angular = g.rotate(turn.transpose(), angular);
        let own = if k == 0 { g.vector([rates[n], rates[n + 1], rates[n + 2]]) } else { g.along(axis, rates[k - 1]) };
        if k % 3 == 2 {
            linear = g.add_vectors(linear, own);
        } else {
            angular = g.add_vectors(angular, own);
        }
        velocities.extend([linear, angular]);
    }
    Chain { graph: g, q, rates, velocities }
}

/// The sum over k of w_k dy_k/dv, column by column.
fn forward(
    g: &mut Graph,
    weighted: &[(Scalar, Scalar)],
    vectors: &[(Vector, Vector)],
    symbols: &[Scalar],
) -> Vec<Scalar> {
    let mut sums = Vec::new();
    for &symbol in symbols {
        let mut along = Differentiator::new(&[(symbol, Scalar::ONE)]);
        let mut terms = Vec::new();
        for &(y, w) in weighted {
            let slope = along.scalar(g, y);
            terms.push(g.mul(w, slope));
        }
        for &(y, w) in vectors {
            let slope = along.vector(g, y);
            terms.push(g.dot(w, slope));
        }
        sums.push(g.sum(&terms));
    }
    sums
}

#[test]
fn rates_are_transposed() {
    for seed in 0..20 {
        let mut chain = chain(seed, 6);
        let g = &mut chain.graph;
        let weights: Vec<Vector> = (0..chain.velocities.len())
            .map(|_| {
                let components = [(); 3].map(|()| g.symbol());
                g.vector(components)
            })
            .collect();
        let pairs: Vec<(Vector, Vector)> = chain.velocities.iter().copied().zip(weights).collect();
        let energy = g.dot(chain.velocities[5], chain.velocities[4]);
        let weight = g.symbol();
        // One that isn't linear, one with a sign.
        let scalars = [(energy, weight), (-g.component(chain.velocities[7], 1), weight)];
        g.forget();
        let reverse = g.transpose_vectors(&scalars, &pairs, &chain.rates);
        g.forget();
        let columns = forward(g, &scalars, &pairs, &chain.rates);
        assert_eq!(identical(g, &reverse, g, &columns, seed), Verdict::Identical, "seed {seed}");
    }
}

/// Through angles, a matrix, a ball, functions and a linear system.
#[test]
fn what_is_not_linear_is_transposed() {
    for seed in 0..20 {
        let mut chain = chain(seed, 4);
        let g = &mut chain.graph;
        let q = chain.q.clone();
        let (s, c) = (g.sin(q[0]), g.cos(q[0]));
        let rows = [[c, Scalar::ZERO, s], [Scalar::ZERO, Scalar::ONE, Scalar::ZERO], [-s, Scalar::ZERO, c]];
        let first = chain.velocities[3];
        let matrix = g.matrix_rotation(rows);
        let turned = g.axis_rotation(0, q[1]);
        let product = g.compose(matrix, turned);
        let images =
            [g.rotate(product, first), g.rotate(product.transpose(), first), g.rotate(matrix.transpose(), first)];
        let [x, y, z] = g.components(images[0]);
        let root = g.sqrt(x);
        let quotient = g.div(root, y);
        let angle = g.angle(x, y);
        let square = g.product(&[z, z, q[2]]);
        let tangent = g.call(multibody_engine::contracts::call::Call::Atan2, &[z, z]);
        let system = [x, q[3], q[2], y, z, s];
        let solved = g.block_outputs(BlockKind::Solve { size: 2, symmetric: false, groups: [].into() }, &system);
        let mut weighted = Vec::new();
        for y in [quotient, angle, square, tangent, solved[0], -solved[1], solved[2]] {
            weighted.push((y, g.symbol()));
        }
        let w = [(); 3].map(|()| g.symbol());
        let w = g.vector(w);
        let vectors: Vec<(Vector, Vector)> = images.iter().chain(&chain.velocities).map(|&v| (v, w)).collect();
        let reverse = g.transpose_vectors(&weighted, &vectors, &q);
        g.forget();
        let columns = forward(g, &weighted, &vectors, &q);
        assert_eq!(identical(g, &reverse, g, &columns, seed), Verdict::Identical, "seed {seed}");
    }
}

/// A ball's four symbols move along the sphere: against a turning of the whole.
#[test]
fn balls_are_transposed() {
    let mut g = Graph::new();
    let q = g.unit_quaternion();
    let list: Vec<Vector> = (0..4)
        .map(|_| {
            let components = [(); 3].map(|()| g.symbol());
            g.vector(components)
        })
        .collect();
    let r = g.quaternion_rotation(q);
    let there = g.rotate(r, list[0]);
    let back = g.rotate(r.transpose(), list[1]);
    let adjoint = g.transpose_vectors(&[], &[(there, list[2]), (back, list[3])], &q);
    // dq = q (0, w) / 2 for a turning w about x.
    let half = g.decimal(0.5);
    let dq = [-q[1], q[0], q[3], -q[2]].map(|c| g.mul(half, c));
    let terms: Vec<Scalar> = adjoint.iter().zip(dq).map(|(&a, d)| g.mul(a, d)).collect();
    let sum = g.sum(&terms);
    g.forget();
    let mut along = Differentiator::new(&[(q[0], dq[0]), (q[1], dq[1]), (q[2], dq[2]), (q[3], dq[3])]);
    let (a, b) = (along.vector(&mut g, there), along.vector(&mut g, back));
    let (a, b) = (g.dot(list[2], a), g.dot(list[3], b));
    let expected = g.add(a, b);
    assert_eq!(identical(&g, &[sum], &g, &[expected], 5), Verdict::Identical);
}

/// The whole transposed map costs what the map costs, and not a column per symbol.
#[test]
fn costs_are_those_of_the_map() {
    for n in [6, 12, 24] {
        let mut chain = chain(3, n);
        let g = &mut chain.graph;
        let weights: Vec<Scalar> = (0..3).map(|_| g.symbol()).collect();
        let weight = g.vector([weights[0], weights[1], weights[2]]);
        let last = chain.velocities[chain.velocities.len() - 2];
        let reverse = g.transpose_vectors(&[], &[(last, weight)], &chain.rates);
        let results = g.components(last);
        let cost = |roots: &[Scalar]| {
            let mut lowering = Lowering::new(g);
            let roots = lowering.run(roots);
            let cost = lowering.to.cost(&roots);
            cost.add + cost.mul
        };
        let (up, down) = (cost(&results), cost(&reverse));
        assert!(down < 2 * up, "{down} down, {up} up");
    }
}

/// A symbol may be given with a sign.
#[test]
fn symbols_with_a_sign() {
    let mut g = Graph::new();
    let [x, weight] = [(); 2].map(|()| g.symbol());
    let three = g.integer(3);
    let result = g.mul(three, x);
    let plain = g.transpose_linear(&[(result, weight)], &[x]);
    let turned = g.transpose_linear(&[(result, weight)], &[-x]);
    assert_eq!(plain, [g.mul(three, weight)]);
    assert_eq!(turned, [-plain[0]]);
}
