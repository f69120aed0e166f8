//! What is read off the form of an expression: its sign, the symbols that it depends on, its cost.

use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::cost::Cost;
use multibody_engine::symbolic::evaluate::Evaluator;
use multibody_engine::symbolic::graph::{Graph, Scalar, SymbolId};
use multibody_engine::symbolic::signs::{is_positive, is_proven};
use multibody_engine::symbolic::sized::WithSizes;

/// Squares are positive, symbols are anything, roots count as positive.
#[test]
fn signs_of_forms() {
    let mut g = Graph::new();
    let [x, y, z] = [(); 3].map(|()| g.symbol());
    let [one, two, half] = [1.0, 2.0, 0.5].map(|n| g.decimal(n));
    let (xx, yy) = (g.mul(x, x), g.mul(y, y));
    let (root, exp) = (g.sqrt(z), g.call(Call::Exp, &[y]));
    let (cube, cross) = (g.product(&[x, x, x]), g.mul(x, y));
    let both = g.product(&[two, x, x, root]);
    let sums = [&[one, xx, yy][..], &[xx, exp], &[root, both]].map(|terms| g.sum(terms));
    let mixed = [&[one, x][..], &[xx, -yy], &[-one, xx], &[root, -exp]].map(|terms| g.sum(terms));
    let [inverse, other] = [root, x].map(|s| g.reciprocal(s));
    let odd = g.product(&[-half, xx, root]);
    let mask = g.call(Call::Less, &[x, y]);
    let mut select = |a: Scalar, b: Scalar| g.call(Call::Select, &[mask, a, b]);
    let (chosen, open, below) = (select(root, two), select(root, -two), select(-root, -two));
    let touching = select(Scalar::ZERO, -two);

    let positive = [one, xx, yy, root, exp, both, sums[0], sums[1], sums[2], inverse, chosen];
    for s in positive {
        assert!(is_positive(&g, s) && !is_positive(&g, -s), "{:?}", g.node(s));
    }
    for s in [odd, below] {
        assert!(is_positive(&g, -s) && !is_positive(&g, s), "{:?}", g.node(s));
    }
    for s in [x, cube, cross, mixed[0], mixed[1], mixed[2], mixed[3], other, open, touching, Scalar::ZERO] {
        assert!(!is_positive(&g, s) && !is_positive(&g, -s), "{:?}", g.node(s));
    }
}

#[test]
fn comparisons_that_hold_whatever_symbols_are() {
    let mut g = Graph::new();
    let [x, y] = [(); 2].map(|()| g.symbol());
    let [one, two] = [1.0, 2.0].map(|n| g.decimal(n));
    let xx = g.mul(x, x);
    let mut sum = |terms: &[Scalar]| g.sum(terms);
    let above = sum(&[x, xx]);
    let (more, less) = (sum(&[y, two]), sum(&[y, one]));
    let (beyond, zero) = (sum(&[y, one, xx]), Scalar::ZERO);
    let mut order = |call: Call, a: Scalar, b: Scalar| g.call(call, &[a, b]);
    let proven = [
        order(Call::Less, zero, xx),
        order(Call::Less, x, above),
        order(Call::Less, less, more),
        order(Call::LessEqual, less, beyond),
        order(Call::Less, -more, -less),
        order(Call::Less, zero, two),
        order(Call::Less, -xx, one),
    ];
    let open = [
        order(Call::Less, zero, x),
        order(Call::Less, xx, zero),
        order(Call::Less, above, x),
        order(Call::Less, more, less),
        order(Call::Less, xx, one),
        order(Call::Less, more, beyond),
        order(Call::Less, x, y),
        order(Call::Less, x, x),
        order(Call::Equal, x, y),
    ];
    for (&mask, holds) in proven.iter().map(|mask| (mask, true)).chain(open.iter().map(|mask| (mask, false))) {
        assert_eq!(is_proven(&g, mask), holds, "{:?}", g.node(mask));
    }
    let (yes, no) = (proven[1], open[0]);
    let mut join = |call: Call, a: Scalar, b: Scalar| g.call(call, &[a, b]);
    let other = proven[0];
    let list = [
        (join(Call::And, yes, other), true),
        (join(Call::And, yes, no), false),
        (join(Call::Or, yes, no), true),
        (join(Call::Or, no, open[1]), false),
    ];
    for (mask, holds) in list {
        assert_eq!(is_proven(&g, mask), holds, "{:?}", g.node(mask));
    }
}

#[test]
fn symbols_that_are_reached() {
    let mut g = Graph::new();
    let [x, y, z] = [(); 3].map(|()| g.symbol());
    let (sine, product) = (g.sin(x), g.mul(x, y));
    let s = g.add(sine, product);
    assert!(g.depends_on(s, &[x]) && g.depends_on(s, &[z, y]) && g.depends_on(x, &[x]));
    assert!(!g.depends_on(s, &[z]) && !g.depends_on(sine, &[y, z]) && !g.depends_on(s, &[]));
    // What cancels is not there.
    let cancelled = g.sub(s, product);
    assert!(!g.depends_on(cancelled, &[y]));
}

#[test]
fn costs_of_nodes() {
    let mut g = Graph::new();
    let [x, y, z] = [(); 3].map(|()| g.symbol());
    let sum = g.sum(&[x, y, z]);
    let product = g.product(&[x, y, sum]);
    let (root, inverse) = (g.sqrt(sum), g.reciprocal(product));
    let pair = [g.sin(x), g.cos(x)];
    let mask = g.call(Call::Less, &[x, y]);
    let calls = [g.call(Call::Max, &[x, y]), g.call(Call::Select, &[mask, x, z]), g.call(Call::Atan, &[z])];
    let roots = [&[sum, product, root, inverse][..], &pair, &calls].concat();
    let expected = Cost { add: 2 + 2, mul: 2, div: 1, sqrt: 1, sincos: 1, compare: 1, other: 1 };
    assert_eq!(g.cost(&roots), expected);
}

/// A sum of what cancels is rounding beside its terms, and zero beside nothing.
#[test]
fn sums_beside_their_terms() {
    let mut g = Graph::new();
    let [x, y] = [(); 2].map(|()| g.symbol());
    let sum = g.add(x, y);
    let is_rounding = |x: f64, y: f64| {
        let symbols = |id: SymbolId| [x, y][id.0];
        Evaluator::new(&g, WithSizes { symbols: &symbols }).run(&[sum])[0].is_rounding()
    };
    assert!(is_rounding(1.0, -1.0 + f64::EPSILON) && is_rounding(1.0, -1.0) && is_rounding(0.0, 0.0));
    assert!(!is_rounding(1.0, 1.0) && !is_rounding(1.0, -0.999) && !is_rounding(1e-30, 0.0));
}
