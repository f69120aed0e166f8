//! The exact identity test: it passes every rewrite of the graph, and catches wrong ones.

use crate::expressions::{self, Expression};
use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::dynamics::articulated_inertia::ArticulatedInertia;
use multibody_engine::dynamics::inertia::Inertia;
use multibody_engine::symbolic::evaluate::{Evaluator, Field, Real};
use multibody_engine::symbolic::graph::{BlockKind, Graph, Rotation, Scalar, ScalarNode, SymbolId};
use multibody_engine::symbolic::identity::{Draw, Modular, Verdict, close, identical};
use multibody_engine::symbolic::lower::Lowering;
use multibody_engine::symbolic::number::Number;

/// A graph and its first symbols.
fn graph<const N: usize>() -> (Graph, [Scalar; N]) {
    let mut g = Graph::new();
    let symbols = [(); N].map(|()| g.symbol());
    (g, symbols)
}

/// Compares one expression of each of two graphs.
fn compare<const N: usize>(
    left: impl Fn(&mut Graph, [Scalar; N]) -> Scalar,
    right: impl Fn(&mut Graph, [Scalar; N]) -> Scalar,
) -> (Verdict, Verdict) {
    let ((mut g, xs), (mut h, ys)) = (graph(), graph());
    let (x, y) = (left(&mut g, xs), right(&mut h, ys));
    (identical(&g, &[x], &h, &[y], 11), close(&g, &[x], &h, &[y], 11, 1e-9))
}

const SAME: (Verdict, Verdict) = (Verdict::Identical, Verdict::Identical);
const OTHER: (Verdict, Verdict) = (Verdict::Different(0), Verdict::Different(0));

/// Random expressions, evaluated directly and through the graph's constructors.
#[test]
fn constructors_keep_values() {
    let mut decided = 0;
    for seed in 0..400 {
        let mut rng = Rng::new(seed);
        let expression = Expression::random(&mut rng, 6);
        let (mut g, symbols) = graph::<{ expressions::SYMBOLS }>();
        let root = expression.make(&mut g, &symbols);
        let lowered = {
            let mut lowering = Lowering::new(&g);
            let root = lowering.run(&[root]);
            (lowering.to, root)
        };
        for attempt in 0..32 {
            let draw = Draw::new(&g, 1000 * seed + attempt);
            let field = Modular { draw: &draw };
            let direct = expression.evaluate(&field);
            let built = Evaluator::new(&g, field).run(&[root])[0];
            let low = Evaluator::new(&lowered.0, field).run(&lowered.1)[0];
            if draw.is_refused() {
                continue;
            }
            assert_eq!(direct, built, "seed {seed}: {expression:?}");
            assert_eq!(direct, low, "seed {seed}, lowered: {expression:?}");
            decided += 1;
            break;
        }
    }
    assert!(decided > 380, "{decided}");
}

/// One literal or sign of an expression changed: the test sees it wherever the expression's value changes.
#[test]
fn small_changes_are_caught() {
    let mut changed = 0;
    for seed in 0..300 {
        let mut rng = Rng::new(7000 + seed);
        let expression = Expression::random(&mut rng, 5);
        let broken = expression.broken(&mut rng);
        let ((mut g, xs), (mut h, ys)) = (graph::<{ expressions::SYMBOLS }>(), graph());
        let (x, y) = (expression.make(&mut g, &xs), broken.make(&mut h, &ys));
        let verdict = identical(&g, &[x], &h, &[y], seed);
        let differs = (0..64).any(|attempt| {
            let draw = Draw::new(&g, 90_000 + 100 * seed + attempt);
            let field = Modular { draw: &draw };
            let (a, b) = (expression.evaluate(&field), broken.evaluate(&field));
            !draw.is_refused() && a != b
        });
        if differs {
            changed += 1;
            assert_ne!(verdict, Verdict::Identical, "seed {seed}: {expression:?} and {broken:?}");
        }
    }
    assert!(changed > 150, "{changed}");
}

#[test]
fn wrong_rules_are_caught() {
    let sum = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let angle = g.add(x, y);
        g.sin(angle)
    };
    let addition_theorem = |sign: bool| {
        move |g: &mut Graph, [x, y]: [Scalar; 2]| {
            let (sx, cx, sy, cy) = (g.sin(x), g.cos(x), g.sin(y), g.cos(y));
            let (a, b) = (g.mul(sx, cy), g.mul(cx, sy));
            g.add(a, if sign { b } else { -b })
        }
    };
    assert_eq!(compare(sum, addition_theorem(true)), SAME);
    assert_eq!(compare(sum, addition_theorem(false)), OTHER);
    let quotient = |g: &mut Graph, [x, y]: [Scalar; 2]| g.div(x, y);
    assert_eq!(compare(quotient, |g, [x, y]| g.div(y, x)), OTHER);
    // Half angles, and constant angles on their common base.
    let whole = |g: &mut Graph, [x]: [Scalar; 1]| {
        let third = g.decimal(0.3);
        let angle = g.add(x, third);
        g.cos(angle)
    };
    let halves = |constant: f64| {
        move |g: &mut Graph, [x]: [Scalar; 1]| {
            let (half, constant, two) = (g.decimal(0.5), g.decimal(constant), g.integer(2));
            let x = g.mul(half, x);
            let angle = g.add(x, constant);
            let cos = g.cos(angle);
            let square = g.product(&[two, cos, cos]);
            g.sub(square, Scalar::ONE)
        }
    };
    assert_eq!(compare(whole, halves(0.15)), SAME);
    assert_eq!(compare(whole, halves(0.150_000_1)), OTHER);
}

#[test]
fn roots_are_exact_but_for_their_sign() {
    let root_of_product = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let product = g.mul(x, y);
        g.sqrt(product)
    };
    let product_of_roots = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let (x, y) = (g.sqrt(x), g.sqrt(y));
        g.mul(x, y)
    };
    assert_eq!(compare(root_of_product, product_of_roots).0, Verdict::Identical);
    // 1 / (sqrt(x) + y) = (sqrt(x) - y) / (x - y^2)
    let plain = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let root = g.sqrt(x);
        let sum = g.add(root, y);
        g.reciprocal(sum)
    };
    let conjugate = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let (root, square) = (g.sqrt(x), g.mul(y, y));
        let (over, under) = (g.sub(root, y), g.sub(x, square));
        g.div(over, under)
    };
    assert_eq!(compare(plain, conjugate), SAME);
    // -x^2 is a square nowhere.
    let never = |g: &mut Graph, [x]: [Scalar; 1]| {
        let square = g.mul(x, x);
        g.sqrt(-square)
    };
    assert_eq!(compare(never, never), (Verdict::Undecided, Verdict::Undecided));
}

fn is_root(g: &mut Graph, x: Scalar) -> bool {
    let root = g.sqrt(x);
    matches!(g.node(root), ScalarNode::Sqrt(_))
}

/// A root of what is the square of something at hand is its size, however it is written; a root of anything else stays one.
#[test]
fn roots_of_squares_are_sizes() {
    let (mut g, [a, b]) = graph();
    let (sin, cos) = (g.sin(a), g.cos(a));
    let squares = [sin, cos, b].map(|x| g.mul(x, x));
    let rest = g.sub(Scalar::ONE, squares[0]);
    let root = g.sqrt(rest);
    assert_eq!(root, g.call(Call::Abs, &[cos]));
    let values = Evaluator::new(&g, Real { symbols: &|id: SymbolId| [2.0, 0.3][id.0] }).run(&[root]);
    assert!((values[0] + 2.0_f64.cos()).abs() < 1e-15);
    assert!(is_root(&mut g, -rest), "of what is never positive");
    // b^2 - (b cos a)^2 = (b sin a)^2, which is at hand once b sin a is.
    let shadow = g.mul(squares[1], squares[2]);
    let height = g.sub(squares[2], shadow);
    assert!(is_root(&mut g, height));
    let (mut g, [a, b]) = graph();
    let (sin, cos) = (g.sin(a), g.cos(a));
    let side = g.mul(sin, b);
    let squares = [cos, b].map(|x| g.mul(x, x));
    let shadow = g.mul(squares[0], squares[1]);
    let height = g.sub(squares[1], shadow);
    assert_eq!(g.sqrt(height), g.call(Call::Abs, &[side]));
}

#[test]
fn numbers_decide_what_is_opaque() {
    let exp_of_sum = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let sum = g.add(x, y);
        g.call(Call::Exp, &[sum])
    };
    let product = |g: &mut Graph, [x, y]: [Scalar; 2]| {
        let (x, y) = (g.call(Call::Exp, &[x]), g.call(Call::Exp, &[y]));
        g.mul(x, y)
    };
    assert_eq!(compare(exp_of_sum, product), (Verdict::Different(0), Verdict::Identical));
    // The sign of a root: sqrt(x^2) is |x|, not x.
    let root = |g: &mut Graph, [x]: [Scalar; 1]| {
        let square = g.mul(x, x);
        g.sqrt(square)
    };
    assert_eq!(compare(root, |g, [x]| g.call(Call::Abs, &[x])).1, Verdict::Identical);
    assert_eq!(compare(root, |_, [x]| x).1, Verdict::Different(0));
    let (smaller, larger) = (
        |g: &mut Graph, [x, y]: [Scalar; 2]| g.call(Call::Min, &[x, y]),
        |g: &mut Graph, [x, y]: [Scalar; 2]| g.call(Call::Max, &[x, y]),
    );
    assert_eq!(compare(smaller, larger), OTHER);
    assert_eq!(compare(smaller, |g, [x, y]| -g.call(Call::Max, &[-x, -y])).1, Verdict::Identical);
}

#[test]
fn quaternions_lie_on_the_sphere() {
    let mut g = Graph::new();
    g.symbol();
    let q = g.unit_quaternion();
    for seed in 0..4 {
        let draw = Draw::new(&g, seed);
        let field = Modular { draw: &draw };
        let values = Evaluator::new(&g, field).run(&q);
        let square = values.iter().fold(0, |sum, &x| field.add(sum, field.mul(x, x)));
        assert_eq!(square, 1);
    }
}

/// What iterations make of points on a circle is on it too.
#[test]
fn circles_stay_circles() {
    let mut g = Graph::new();
    let by = g.symbol();
    let [cos, sin] = g.unit_circle();
    let square = |g: &mut Graph, [c, s]: [Scalar; 2]| {
        let squares = [g.mul(c, c), g.mul(s, s)];
        g.sum(&squares)
    };
    assert_eq!(square(&mut g, [cos, sin]), Scalar::ONE);
    let angle = g.angle(cos, sin);
    assert_eq!([g.cos(angle), g.sin(angle)], [cos, sin]);
    for seed in 0..4 {
        let draw = Draw::new(&g, seed);
        let field = Modular { draw: &draw };
        let values = Evaluator::new(&g, field).run(&[cos, sin]);
        assert_eq!(field.add(field.mul(values[0], values[0]), field.mul(values[1], values[1])), 1);
    }
    let (c, s) = (g.cos(by), g.sin(by));
    let further = [g.mul(cos, c), -g.mul(sin, s), g.mul(sin, c), g.mul(cos, s)];
    let next = [g.sum(&further[..2]), g.sum(&further[2..])];
    let unknowns: Vec<SymbolId> = [cos, sin].iter().filter_map(|&x| g.symbol_id(x)).collect();
    let kind = BlockKind::Iterate { unknowns: unknowns.into(), count: 3 };
    let found = g.block_outputs(kind, &[Scalar::ONE, Scalar::ZERO, next[0], next[1], by]);
    assert_eq!(square(&mut g, [found[0], found[1]]), Scalar::ONE);
    assert_ne!(found[0], Scalar::ONE);
    let turned = g.angle(found[0], found[1]);
    let (threefold, by) = (g.cos(turned), 0.7_f64);
    let value =
        Evaluator::new(&g, Real { symbols: &|id: SymbolId| [by, f64::NAN, f64::NAN][id.0] }).run(&[threefold])[0];
    assert!((value - (3.0 * by).cos()).abs() < 1e-15);
}

/// Turning about an axis by its short formulas, and by two products with the matrix.
#[test]
fn turning_is_rotating() {
    for axis in 0..3 {
        let make = || {
            let (g, [angle, mass, x, y, z, a, b, c, d, e, f]) = graph();
            (g, angle, Inertia { mass, first: [x, y, z], second: [a, b, c, d, e, f] })
        };
        let list = |i: &Inertia| [&i.first[..], &i.second].concat();
        let (mut g, angle, inertia) = make();
        let turned = list(&inertia.turn(&mut g, axis, angle));
        let (mut h, angle, inertia) = make();
        let r = h.axis_rotation(axis, angle);
        let rotated = list(&inertia.rotate(&mut h, r));
        assert_eq!(identical(&g, &turned, &h, &rotated, 3), Verdict::Identical, "axis {axis}");
        let back = list(&inertia.rotate(&mut h, r.transpose()));
        assert_ne!(identical(&g, &turned, &h, &back, 3), Verdict::Identical, "axis {axis}");
    }
}

/// Placements that map an axis to an axis exchange and turn: the same as two products with the matrix. A turn about a
/// third axis, composed with the placement, hides it from the short formulas.
#[test]
fn articulated_inertias_rotate() {
    let mut rng = Rng::new(3);
    for case in 0..40 {
        let mut q = [0_i64; 4];
        while q == [0; 4] {
            q = [(); 4].map(|()| rng.below(3) as i64 - 1);
        }
        let rotated = |in_steps: bool| {
            let (mut g, entries) = graph::<21>();
            let tilts = [0, 1].map(|axis| {
                let angle = g.symbol();
                g.axis_rotation(axis, angle)
            });
            let tilt = g.compose(tilts[0], tilts[1]);
            let placement = placement(&mut g, q);
            let inertia = ArticulatedInertia::from_entries(entries);
            assert_eq!(inertia.entries(), entries);
            let result = if in_steps {
                let placed = inertia.rotate(&mut g, placement);
                placed.rotate(&mut g, tilt)
            } else {
                let both = g.compose(tilt, placement);
                inertia.rotate(&mut g, both)
            };
            (g, result.entries())
        };
        let ((g, xs), (h, ys)) = (rotated(true), rotated(false));
        assert_eq!(identical(&g, &xs, &h, &ys, case), Verdict::Identical, "{q:?}");
    }
}

/// The matrix of a quaternion of small integers.
fn placement(g: &mut Graph, [w, x, y, z]: [i64; 4]) -> Rotation {
    let rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ];
    let norm = Number::integer(w * w + x * x + y * y + z * z);
    let rows = rows.map(|row| row.map(|n| g.number(Number::integer(n) / norm)));
    g.matrix_rotation(rows)
}

/// In doubles several points are compared: one may lie where two functions are equal.
#[test]
fn doubles_are_compared_at_more_than_one_point() {
    let mut seen = 0;
    for seed in 0..20 {
        let ((g, [x]), (mut h, [y])) = (graph(), graph());
        let size = h.call(Call::Abs, &[y]);
        seen += u32::from(close(&g, &[x], &h, &[size], seed, 1e-9) == Verdict::Different(0));
    }
    assert!(seen >= 19, "{seen}");
}

#[test]
fn quaternions_have_unit_length_in_doubles() {
    let (mut g, (mut h, q)) = (Graph::new(), graph::<4>());
    g.unit_quaternion();
    let squares = q.map(|x| h.mul(x, x));
    let square = h.sum(&squares);
    for seed in 0..20 {
        assert_eq!(close(&g, &[Scalar::ONE], &h, &[square], seed, 1e-12), Verdict::Identical);
    }
}
