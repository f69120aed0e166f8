//! Angles given as points, linear systems and iterations on the graph, against plain double precision.

use crate::rng::Rng;
use multibody_engine::symbolic::evaluate::{Evaluator, Real, solve_f64};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Scalar, ScalarNode, SymbolId};
use multibody_engine::symbolic::identity::{Verdict, close, identical};
use multibody_engine::symbolic::lower::Lowering;

fn values(g: &Graph, roots: &[Scalar], point: &[f64]) -> Vec<f64> {
    let symbols = |id: SymbolId| point.get(id.0).copied().unwrap_or(f64::NAN);
    Evaluator::new(g, Real { symbols: &symbols }).run(roots)
}

/// No sine or cosine of an angle that is given as a point is left.
fn needs_inverse(g: &Graph, roots: &[Scalar]) -> bool {
    let is_angle = |index: usize| matches!(g.node(g.scalar_at(index)), ScalarNode::Angle(..));
    g.reachable_scalars(roots).into_iter().any(is_angle)
}

/// Sums with any number of given angles, signs and multiples, nested as they come.
#[test]
fn sines_and_cosines_of_given_angles() {
    for seed in 0..300 {
        let mut rng = Rng::new(seed);
        let mut g = Graph::new();
        let symbols: Vec<Scalar> = (0..6).map(|_| g.symbol()).collect();
        let directions: Vec<f64> = (0..2).map(|_| rng.real(-3.1, 3.1)).collect();
        let mut point = directions.iter().flat_map(|a| [a.cos(), a.sin()]).collect::<Vec<f64>>();
        point.extend([rng.real(-2.0, 2.0), rng.real(-2.0, 2.0)]);
        let mut list = vec![
            (g.angle(symbols[0], symbols[1]), directions[0]),
            (g.angle(-symbols[2], -symbols[3]), (-directions[1].sin()).atan2(-directions[1].cos())),
            (symbols[4], point[4]),
            (symbols[5], point[5]),
        ];
        for _ in 0..5 {
            let (a, b) = (list[rng.below(list.len())], list[rng.below(list.len())]);
            list.push(match rng.below(4) {
                0 => (g.add(a.0, b.0), a.1 + b.1),
                1 => (g.sub(a.0, b.0), a.1 - b.1),
                2 => {
                    let two = g.integer(-2);
                    (g.mul(two, a.0), -2.0 * a.1)
                }
                _ => {
                    // As typed, or exact.
                    let quarters = [0, 1, 2, -1][rng.below(4)];
                    let x = if quarters == 0 { 0.3 } else { quarters as f64 * std::f64::consts::FRAC_PI_2 };
                    let (pi, two, count) = (g.pi(), g.integer(2), g.integer(quarters));
                    let turned = g.mul(count, pi);
                    let typed = quarters == 0 || rng.chance(50);
                    let literal = if typed { g.decimal(x) } else { g.div(turned, two) };
                    (g.sub(a.0, literal), a.1 - x)
                }
            });
        }
        let mut roots = Vec::new();
        let mut expected = Vec::new();
        for &(angle, value) in &list {
            if let Some((s, c)) = (value.abs() < 60.0).then(|| value.sin_cos()) {
                roots.extend([g.sin(angle), g.cos(angle), -g.sin(-angle), g.cos(-angle)]);
                expected.extend([s, c, s, c]);
            }
        }
        for (k, (x, y)) in values(&g, &roots, &point).iter().zip(&expected).enumerate() {
            assert!((x - y).abs() < 1e-12, "seed {seed}, {k}: {x} {y}");
        }
        // Multiples beyond eight need the angle itself.
        let direct: Vec<Scalar> = roots[..24].to_vec();
        assert!(!needs_inverse(&g, &direct), "seed {seed}");
        // Rotations by such angles are those of their sines and cosines.
        for &(angle, _) in &list[..6] {
            let turned = g.axis_rotation(2, angle);
            let rows = g.rotation_rows(turned);
            assert_eq!(rows[1][..2], [g.sin(angle), g.cos(angle)], "seed {seed}");
        }
        let angles: Vec<Scalar> = list.iter().map(|a| a.0).collect();
        let back = values(&g, &angles, &point);
        assert!(back.iter().zip(&list).all(|(x, y)| (x - y.1).abs() < 1e-12), "seed {seed}");
    }
}

/// An iteration gives the point (c, s), and what it has turned by since its guess as an angle: sums with the guess and others are turns of
/// that point, and no sine is taken of anything but the others.
#[test]
fn guesses_and_turns_are_one_point() {
    for (factor, sign) in [(1, 1), (3, 1), (1, -1), (-2, -1)] {
        let mut g = Graph::new();
        let [c, s, guess, other] = [(); 4].map(|()| g.symbol());
        let (cos, sin) = (g.cos(guess), g.sin(guess));
        let products = [g.mul(c, cos), g.mul(s, sin), g.mul(s, cos), -g.mul(c, sin)];
        let (along, across) = (g.sum(&products[..2]), g.sum(&products[2..]));
        let turned = g.angle(along, across);
        let found = g.add(guess, turned);
        let factor = g.integer(factor);
        let more = g.mul(factor, other);
        let angle = g.add(if sign < 0 { -found } else { found }, more);
        let (cos, sin) = (g.cos(angle), g.sin(angle));
        for index in g.reachable_scalars(&[cos, sin]) {
            if let ScalarNode::Sin(x) | ScalarNode::Cos(x) = *g.node(g.scalar_at(index)) {
                assert!(!g.depends_on(x, &[guess]), "{factor:?}, {sign}");
            }
        }
        let at = [0.6_f64.cos(), 0.6_f64.sin(), 0.4, -1.3];
        let angle = f64::from(sign) * 0.6 + g.literal(factor).unwrap().value() * -1.3;
        let got = values(&g, &[cos, sin], &at);
        assert!((got[0] - angle.cos()).abs() + (got[1] - angle.sin()).abs() < 1e-14, "{got:?} of {angle}");
    }
}

#[test]
fn given_angles_fold() {
    let mut g = Graph::new();
    let (x, c, s) = (g.symbol(), g.symbol(), g.symbol());
    let (cos, sin) = (g.cos(x), g.sin(x));
    assert_eq!(g.angle(cos, sin), x);
    assert_eq!(g.angle(cos, -sin), -x);
    assert_eq!(g.angle(c, -s), -g.angle(c, s));
    let angle = g.angle(c, s);
    assert_eq!((g.cos(angle), g.sin(angle), g.sin(-angle)), (c, s, -s));
    let sum = g.add(angle, x);
    let rest = g.sub(sum, angle);
    assert_eq!(g.sin(rest), sin);
    let (zero, one) = (Scalar::ZERO, Scalar::ONE);
    let (pi, two) = (g.pi(), g.integer(2));
    assert_eq!((g.angle(one, zero), g.angle(zero, -one)), (zero, -g.div(pi, two)));
    assert_eq!(g.decimal(-std::f64::consts::FRAC_PI_2), -g.div(pi, two));
}

/// Two ways to the same point, by a seed of the test's own.
#[test]
fn the_identity_test_knows_given_angles() {
    let mut g = Graph::new();
    let (x, y) = (g.symbol(), g.symbol());
    let (c, s) = (g.cos(x), g.sin(x));
    // Not found by the graph to be x.
    let (c2, s2) = (g.product(&[c, c]), g.product(&[s, c]));
    let (c2, s2) = (g.sub(c2, y), g.add(s2, y));
    let angle = g.angle(c2, s2);
    let sum = g.sum(&[angle, angle, -x]);
    let v = g.vector([y, x, c]);
    let turn = g.axis_rotation(0, sum);
    let turned = g.rotate(turn, v);
    let roots: Vec<Scalar> = g.components(turned).to_vec();
    let mut lowering = Lowering::new(&g);
    let lowered = lowering.run(&roots);
    assert_eq!(identical(&g, &roots, &lowering.to, &lowered, 3), Verdict::Identical);
    let wrong = [lowered[0], lowered[2], lowered[1]];
    assert_eq!(identical(&g, &roots, &lowering.to, &wrong, 3), Verdict::Different(1));
}

#[test]
fn systems_are_solved_with_their_rank() {
    for seed in 0..100 {
        let mut rng = Rng::new(seed);
        let n = 1 + rng.below(6);
        let rank = 1 + rng.below(n);
        // Products of factors of the rank; columns and rows of every size.
        let factor = |rng: &mut Rng, n: usize| (0..n).map(|_| rng.real(-1.0, 1.0)).collect::<Vec<f64>>();
        let (left, right) = (factor(&mut rng, n * rank), factor(&mut rng, rank * n));
        let sizes: Vec<f64> = (0..n).map(|_| 10.0_f64.powi(rng.below(12) as i32 - 6)).collect();
        let entry = |i: usize, j: usize| {
            sizes[i] * (0..rank).map(|k| left[i * rank + k] * right[k * n + j]).sum::<f64>() / sizes[n - 1 - j]
        };
        let matrix: Vec<f64> = (0..n * n).map(|at| entry(at / n, at % n)).collect();
        let truth: Vec<f64> = (0..n).map(|j| rng.real(-1.0, 1.0) * sizes[n - 1 - j]).collect();
        let rhs: Vec<f64> = matrix.chunks(n).map(|row| row.iter().zip(&truth).map(|(a, x)| a * x).sum()).collect();
        let solved = solve_f64(&matrix, &rhs);
        assert_eq!(solved[n], rank as f64, "seed {seed}");
        for (i, row) in matrix.chunks(n).enumerate() {
            let left: f64 = row.iter().zip(&solved).map(|(a, x)| a * x).sum();
            let size: f64 = row.iter().zip(&solved).map(|(a, x)| (a * x).abs()).sum();
            assert!((left - rhs[i]).abs() < 1e-11 * (size + rhs[i].abs()), "seed {seed}");
        }
    }
    assert_eq!(solve_f64(&[0.0; 4], &[1.0, 2.0]), [0.0, 0.0, 0.0]);
    assert_eq!(solve_f64(&[0.0, 2.0, 1.0, 1.0], &[4.0, 3.0]), [1.0, 2.0, 2.0]);
    // Full rank in a column however small.
    assert_eq!(solve_f64(&[1.0, 1e-20, 1.0, 2e-20], &[1.0, 1.0])[2], 2.0);
}

/// Newton's method for x + a sin y = b, y - a cos x = c: its step is a linear system within the body.
fn newton(g: &mut Graph, [a, b, c]: [Scalar; 3], count: usize) -> Vec<Scalar> {
    let unknowns = [g.symbol(), g.symbol()];
    let [x, y] = unknowns;
    let (sin_y, cos_x) = (g.sin(y), g.cos(x));
    let (first, second) = (g.mul(a, sin_y), g.mul(a, cos_x));
    let residuals = [g.sum(&[x, first, -b]), g.sum(&[y, -second, -c])];
    let mut system = Vec::new();
    for residual in residuals {
        system.extend(g.gradient(residual, &unknowns));
    }
    system.extend(residuals);
    let step = g.block_outputs(BlockKind::Solve { size: 2, symmetric: false, groups: [].into() }, &system);
    let squares = residuals.map(|r| g.mul(r, r));
    let square = g.sum(&squares);
    let size = g.sqrt(square);
    let next = [g.sub(x, step[0]), g.sub(y, step[1])];
    let ids: Vec<SymbolId> = unknowns.iter().filter_map(|&s| g.symbol_id(s)).collect();
    let kind = BlockKind::Iterate { unknowns: ids.into(), count };
    g.block_outputs(kind, &[b, c, next[0], next[1], size])
}

#[test]
fn iterations_converge() {
    let mut g = Graph::new();
    let symbols: [Scalar; 3] = std::array::from_fn(|_| g.symbol());
    let outputs = newton(&mut g, symbols, 6);
    let [x, y, residual] = outputs[..] else { panic!("three outputs") };
    // The unknowns' symbols have values of their own outside.
    let outside = g.symbol_handle(SymbolId(3)).unwrap();
    let sum = g.add(outside, x);
    let point = [0.4, 0.7, -0.2, 100.0, 200.0];
    let found = values(&g, &[sum, x, y, residual, outside], &point);
    assert!((found[1] + 0.4 * found[2].sin() - 0.7).abs() < 1e-15, "{found:?}");
    assert!((found[2] - 0.4 * found[1].cos() + 0.2).abs() < 1e-15, "{found:?}");
    assert!(found[3] < 1e-12 && found[0] == 100.0 + found[1] && found[4] == 100.0, "{found:?}");
    // One round: the residual is that of the start.
    let [_, _, first] = newton(&mut g, symbols, 1)[..] else { panic!("three outputs") };
    let found = values(&g, &[first], &point);
    let expected = (0.4 * (-0.2_f64).sin()).hypot(0.4 * 0.7_f64.cos());
    assert!((found[0] - expected).abs() < 1e-15, "{found:?}");
}

/// Lowered, the same in both tests; a wrong operand is noticed.
#[test]
fn blocks_are_compared() {
    let mut g = Graph::new();
    let symbols: [Scalar; 3] = std::array::from_fn(|_| g.symbol());
    let outputs = newton(&mut g, symbols, 3);
    let mut lowering = Lowering::new(&g);
    let lowered = lowering.run(&outputs);
    // The root of a sum of squares of opaque values is one half of the time.
    assert_eq!(identical(&g, &outputs[..2], &lowering.to, &lowered[..2], 5), Verdict::Identical);
    assert_eq!(close(&g, &outputs, &lowering.to, &lowered, 5, 1e-9), Verdict::Identical);
    let other = newton(&mut g, [symbols[0], symbols[2], symbols[1]], 3);
    assert_eq!(identical(&g, &outputs[..2], &g, &other[..2], 5), Verdict::Different(0));
}

#[test]
fn nothing_is_answered_by_nothing() {
    let mut g = Graph::new();
    let [a, b] = [g.symbol(), g.symbol()];
    let solved = g.block_outputs(
        BlockKind::Solve { size: 2, symmetric: true, groups: [].into() },
        &[a, b, b, a, Scalar::ZERO, Scalar::ZERO],
    );
    assert_eq!(solved[..2], [Scalar::ZERO; 2]);
    assert_eq!(values(&g, &[solved[2]], &[1.0, 1.0]), [1.0]);
}

/// The exact test solves systems: what the unknowns are put into gives the right sides.
#[test]
fn unknowns_fulfil_their_equations_exactly() {
    for n in 1..=3 {
        let mut g = Graph::new();
        let entries: Vec<Scalar> = (0..n * (n + 1)).map(|_| g.symbol()).collect();
        let (matrix, right) = entries.split_at(n * n);
        let unknowns = g.block_outputs(BlockKind::Solve { size: n, symmetric: false, groups: [].into() }, &entries);
        let left: Vec<Scalar> = (0..n)
            .map(|i| {
                let terms: Vec<Scalar> = (0..n).map(|j| g.mul(matrix[i * n + j], unknowns[j])).collect();
                g.sum(&terms)
            })
            .collect();
        assert_eq!(identical(&g, &left, &g, right, 3), Verdict::Identical, "{n}");
        assert_eq!(identical(&g, &left[..1], &g, &matrix[..1], 3), Verdict::Different(0), "{n}");
    }
}
