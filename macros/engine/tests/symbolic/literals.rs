//! Literals and calls of literals: what is equal is one node, and what is not stays apart.

use multibody_engine::contracts::call::Call;
use multibody_engine::symbolic::check::Check;
use multibody_engine::symbolic::doubled::Doubled;
use multibody_engine::symbolic::evaluate::{Field, call_f64};
use multibody_engine::symbolic::graph::{Graph, Scalar};
use multibody_engine::symbolic::identity::{Draw, Modular, Verdict, identical};
use multibody_engine::symbolic::modular::Residue;
use multibody_engine::symbolic::number::Number;

#[test]
fn decimals_beyond_integers() {
    let ten = |power: u32| Number::integer(10).powi(power);
    assert!(Number::decimal(1e25) == ten(25) && Number::decimal(3e25) == Number::integer(3) * ten(25));
    assert!(Number::decimal(1e-25) * ten(25) == Number::ONE);
    assert!(Number::decimal(-7e-40) * ten(40) == Number::integer(-7));
    for x in [1.5e300, 1.5e-300, 1e308] {
        let n = Number::decimal(x);
        assert!(n.value() == x && n.noise() <= 1e-15 * x, "{x:e}: {:e}", n.noise());
    }
}

#[test]
fn multiples_of_pi_by_each_other() {
    let pi = |n: i64, d: i64| Number::ratio(n, d) * Number::pi();
    let ratio = |a: Number, b: Number| (a / b).rational();
    assert_eq!(ratio(pi(1, 3), pi(1, 1)), Some((1, 3)));
    assert_eq!(ratio(pi(1, 1), pi(-1, 3)), Some((-3, 1)));
    assert_eq!(ratio(pi(5, 6), pi(2, 9)), Some((15, 4)));
    assert_eq!(ratio(pi(1, 3) + Number::ONE, pi(1, 1)), None);
    assert_eq!(ratio(Number::ONE, pi(1, 1)), None);
}

/// Angles typed with all their digits, the last of them right or off by one, as after a division of pi in double precision.
#[test]
fn angles_that_are_meant() {
    let mut g = Graph::new();
    for k in 1..1440_i64 {
        let exact = Number::ratio(k, 720) * Number::pi();
        let typed = [exact.value().next_down(), exact.value(), exact.value().next_up()].map(Number::decimal);
        let exact = g.number(exact);
        for typed in typed.into_iter().filter(|typed| typed.is_rounded_decimal()) {
            let typed = g.number(typed);
            let pairs = [[typed, exact].map(|angle| g.sin(angle)), [typed, exact].map(|angle| g.cos(angle))];
            assert!(pairs.iter().all(|[a, b]| a == b), "{k}");
        }
    }
}

/// Parts of a turn and of a radian that have no exact point are units of their own.
#[test]
fn angles_that_have_no_exact_point() {
    let mut g = Graph::new();
    let turn = g.number(Number::ratio(1, 29) * Number::pi());
    let radians = [29, 58].map(|d| g.number(Number::ratio(1, d)));
    let sine = g.sin(turn);
    for angle in radians {
        assert_ne!(sine, g.sin(angle));
    }
}

/// An angle that is no exact number by its point, which is one.
#[test]
fn points_of_angles_that_functions_give() {
    let mut g = Graph::new();
    let [third, minus, two] = [(1, 3), (-2, 7), (2, 1)].map(|(n, d)| g.number(Number::ratio(n, d)));
    let side = |g: &mut Graph, n: i64, d: i64| {
        let square = g.number(Number::ratio(n, d));
        g.sqrt(square)
    };
    let angle = g.call(Call::Acos, &[third]);
    let root = side(&mut g, 8, 9);
    assert_eq!([g.cos(angle), g.sin(angle), g.cos(-angle), g.sin(-angle)], [third, root, third, -root]);
    let angle = g.call(Call::Asin, &[minus]);
    let root = side(&mut g, 45, 49);
    assert_eq!([g.cos(angle), g.sin(angle)], [root, minus]);
    let angle = g.call(Call::Atan, &[two]);
    let (cos, sin) = (side(&mut g, 1, 5), side(&mut g, 4, 5));
    assert_eq!([g.cos(angle), g.sin(angle)], [cos, sin]);
    let (y, x) = (g.decimal(-1.5), g.decimal(-3.0));
    let angle = g.call(Call::Atan2, &[y, x]);
    assert_eq!([g.cos(angle), g.sin(angle)], [-sin, -cos]);
    // The rest of a zero, as it is typed.
    for rest in [6.123_233_995_736_766e-17, 5e-17, 1e-17] {
        let rest = g.decimal(rest);
        for angle in [g.call(Call::Atan2, &[Scalar::ONE, rest]), g.call(Call::Acos, &[rest])] {
            assert_eq!([g.cos(angle), g.sin(angle)], [Scalar::ZERO, Scalar::ONE]);
        }
    }
    let angle = g.call(Call::Atan2, &[y, x]);
    // Beside a coordinate: the sines of the sum are those of the addition theorem.
    let q = g.symbol();
    let sum = g.add(q, angle);
    let (whole, [cq, sq]) = (g.sin(sum), [g.cos(q), g.sin(q)]);
    let terms = [g.mul(sq, -sin), g.mul(cq, -cos)];
    assert_eq!(whole, g.sum(&terms));
}

#[test]
fn calls_of_literals() {
    let mut g = Graph::new();
    let sixth = g.number(Number::ratio(1, 6) * Number::pi());
    let [three, two] = [3.0, 2.0].map(|x| g.decimal(x));
    let (root, tan) = (g.sqrt(three), g.call(Call::Tan, &[sixth]));
    assert_eq!(g.mul(root, tan), Scalar::ONE);
    let power = g.decimal(-0.5);
    let (power, root) = (g.call(Call::Powf, &[two, power]), g.sqrt(two));
    assert_eq!(g.mul(power, root), Scalar::ONE);
    let six = g.decimal(6.0);
    let three = g.decimal(3.0);
    let roots = [two, three, six].map(|x| g.sqrt(x));
    assert_eq!(g.mul(roots[0], roots[1]), roots[2]);
    assert_eq!(g.length([Scalar::ONE, Scalar::ZERO, -Scalar::ONE]), roots[0]);
    // As near to 2 + sqrt(3) as 31 digits tell, and not that.
    let (root, little) = (g.sqrt(three), g.decimal(1e-26));
    let exact = g.add(two, root);
    let near = g.add(exact, little);
    assert_ne!(g.sqrt(exact), g.sqrt(near));
}

#[test]
fn exponentials_of_large_numbers() {
    for x in [-700.0_f64, -400.0, 400.0, 600.0, 709.0] {
        let found = Doubled::new(x).exp().value();
        assert!((found / x.exp() - 1.0).abs() < 1e-12, "{x}: {found:e}");
    }
}

/// x and -x have one representative.
#[test]
fn signs_of_residues() {
    for n in 1..100_i128 {
        let x =
            Check::integer(n) * Check::integer(1 << 40) * Check::integer(n).inverse() + Check::integer((n * n) << 50);
        assert!(x.canonical() == (-x).canonical());
    }
}

#[test]
fn logic_in_doubles() {
    let call = |call: Call, list: &[f64]| call_f64(call, list) != 0.0;
    for (a, b) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)] {
        let (p, q) = (a != 0.0, b != 0.0);
        assert_eq!(call(Call::And, &[a, b]), p && q);
        assert_eq!(call(Call::Or, &[a, b]), p || q);
        assert_eq!(call(Call::Not, &[a]), !p);
        assert_eq!(call(Call::Less, &[a, b]), a < b);
        assert_eq!(call(Call::LessEqual, &[a, b]), a <= b);
        assert_eq!(call(Call::Equal, &[a, b]), a == b);
        assert_eq!(call_f64(Call::Select, &[a, 3.0, 4.0]), if p { 3.0 } else { 4.0 });
    }
}

/// In the field of the identity test functions are odd, even and symmetric as they are in numbers, and nothing else.
#[test]
fn calls_in_the_field() {
    let mut g = Graph::new();
    let [x, y, z] = [(); 3].map(|()| g.symbol());
    for seed in 0..20 {
        let draw = Draw::new(&g, seed);
        let field = Modular { draw: &draw };
        let [a, b] = [3 + seed, (1 << 59) + seed];
        for call in [Call::Tan, Call::Atan, Call::Asin, Call::Sinh, Call::Tanh] {
            assert_eq!(field.call(call, &[field.neg(a)]), field.neg(field.call(call, &[a])), "{call:?}");
            assert_ne!(field.call(call, &[a]), field.call(call, &[b]));
        }
        for call in [Call::Abs, Call::Cosh] {
            assert_eq!(field.call(call, &[field.neg(a)]), field.call(call, &[a]), "{call:?}");
        }
    }
    for call in [Call::Min, Call::Max] {
        let [one, two, three] = [[x, y], [z, y], [y, x]].map(|pair| g.call(call, &pair));
        for seed in 0..20 {
            assert!(matches!(identical(&g, &[one], &g, &[two], seed), Verdict::Different(0)), "{call:?}");
            assert_eq!(identical(&g, &[one], &g, &[three], seed), Verdict::Identical);
        }
    }
}

#[test]
fn quaternions_have_unit_length() {
    let mut g = Graph::new();
    for _ in 0..3 {
        let q = g.unit_quaternion();
        let squares = q.map(|x| g.mul(x, x));
        assert_eq!(g.sum(&squares), Scalar::ONE);
    }
}

/// A rotation is found again by its entries, or by those of its inverse, and by no others.
#[test]
fn rotations_that_are_near() {
    let mut g = Graph::new();
    let entries = |rows: [[i64; 3]; 3]| rows.map(|row| row.map(|n| n as f64 / 9.0));
    let rows = [[1, 8, -4], [-4, 4, 7], [8, 1, 4]];
    let symbols = rows.map(|row| row.map(|n| g.number(Number::ratio(n, 9))));
    let made = g.matrix_rotation(symbols);
    let m = entries(rows);
    let turned = [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]));
    assert_eq!(g.near_rotation(&m, 1e-9), Some(made));
    assert_eq!(g.near_rotation(&turned, 1e-9), Some(made.transpose()));
    for i in 0..3 {
        for j in 0..3 {
            let mut other = m;
            other[i][j] += 0.1;
            assert_eq!(g.near_rotation(&other, 1e-9), None);
        }
    }
    let row = [m[0], [0.0, 0.6, 0.8], [0.0, -0.8, 0.6]];
    assert_eq!(g.near_rotation(&row, 1e-9), None);
    assert_eq!(g.literal_rotations(), [(made, m), (made.transpose(), turned)]);
}
