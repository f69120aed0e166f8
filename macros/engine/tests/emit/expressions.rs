//! Expressions are written with the parentheses that they need and no others, and mean what the program says.

use crate::parsed;
use crate::samples::*;
use multibody_engine::contracts::call::Call;
use multibody_engine::optimize::program::Expression;

fn a() -> Expression {
    field(0)
}
fn b() -> Expression {
    field(1)
}
fn c() -> Expression {
    field(2)
}

fn written(value: Expression) -> String {
    let text = parsed::written(&[], vec![], value);
    let text = text.replace("self.g_by_l", "a").replace("self.inertia", "b");
    text.replace("self.l", "c")
}

#[test]
fn parentheses() {
    let sum = || sum(&[b(), c()]);
    let cases = [
        (mul(&[a(), sum()]), "a*(b+c)"),
        (mul(&[sum(), a()]), "(b+c)*a"),
        (minus(a(), sum()), "a-(b+c)"),
        (minus(sum(), a()), "b+c-a"),
        (div(mul(&[a(), b()]), c()), "a*b/c"),
        (div(a(), mul(&[b(), c()])), "a/(b*c)"),
        (div(a(), div(b(), c())), "a/(b/c)"),
        (div(div(a(), b()), c()), "a/b/c"),
        (mul(&[a(), div(b(), c())]), "a*(b/c)"),
        (mul(&[div(a(), b()), c()]), "a/b*c"),
        (mul(&[a(), mul(&[b(), c()])]), "a*(b*c)"),
        (mul(&[mul(&[a(), b()]), c()]), "a*b*c"),
        (div(sum(), sum()), "(b+c)/(b+c)"),
        (call(Call::Sqrt, &[sum()]), "Real::sqrt(b+c)"),
        (mul(&[a(), call(Call::Atan2, &[b(), neg(c())])]), "a*Real::atan2(b,-c)"),
        (Expression::Sum(vec![]), "T::lit(0.0)"),
        (Expression::Product(vec![]), "T::lit(1.0)"),
        (mul(&[sum()]), "b+c"),
        (mul(&[a(), mul(&[sum()])]), "a*(b+c)"),
    ];
    for (value, expected) in cases {
        assert_eq!(written(value), expected);
    }
}

#[test]
fn signs() {
    let cases = [
        (neg(a()), "-a"),
        (neg(neg(a())), "a"),
        (neg(sum(&[a(), b()])), "-(a+b)"),
        (neg(mul(&[a(), b()])), "-a*b"),
        (neg(div(a(), b())), "-a/b"),
        (neg(mul(&[sum(&[a(), b()]), c()])), "-(a+b)*c"),
        (mul(&[a(), neg(b())]), "-a*b"),
        (mul(&[neg(a()), neg(b())]), "a*b"),
        (mul(&[a(), neg(sum(&[b(), c()]))]), "-a*(b+c)"),
        (mul(&[lit(-2.0), a()]), "T::lit(-2.0)*a"),
        (mul(&[lit(-2.0), neg(a())]), "T::lit(2.0)*a"),
        (neg(lit(2.0)), "T::lit(-2.0)"),
        (div(lit(-1.0), a()), "T::lit(-1.0)/a"),
        (div(neg(a()), neg(b())), "a/b"),
        (sum(&[neg(a()), b()]), "b-a"),
        (sum(&[neg(a()), neg(b())]), "-a-b"),
        (sum(&[neg(a()), b(), c()]), "b-a+c"),
        (minus(a(), neg(b())), "a+b"),
        (minus(a(), mul(&[lit(-2.0), b()])), "a+T::lit(2.0)*b"),
        (sum(&[a(), mul(&[lit(-2.0), b()])]), "a-T::lit(2.0)*b"),
        (sum(&[a(), lit(-2.0)]), "a-T::lit(2.0)"),
        (sum(&[a(), neg(sum(&[b(), c()]))]), "a-(b+c)"),
        (sum(&[neg(sum(&[a(), b()])), neg(c())]), "-(a+b)-c"),
        (call(Call::Abs, &[neg(mul(&[a(), b()]))]), "Real::abs(-a*b)"),
    ];
    for (value, expected) in cases {
        assert_eq!(written(value), expected);
    }
}

#[test]
fn conditions() {
    let less = |x: Expression, y: Expression| call(Call::Less, &[x, y]);
    let both = call(Call::And, &[less(a(), b()), less(b(), c())]);
    let not_both = call(Call::Not, std::slice::from_ref(&both));
    let either = call(Call::Or, &[both.clone(), not_both]);
    let nested = call(Call::And, &[either.clone(), less(a(), c())]);
    let (ab, bc) = ("Real::lt(a,b)", "Real::lt(b,c)");
    let cases = [
        (both, format!("Real::select({ab}&{bc},a,b)")),
        (either, format!("Real::select({ab}&{bc}|!({ab}&{bc}),a,b)")),
        (nested, format!("Real::select(({ab}&{bc}|!({ab}&{bc}))&Real::lt(a,c),a,b)")),
    ];
    for (mask, expected) in cases {
        assert_eq!(written(call(Call::Select, &[mask, a(), b()])), expected);
    }
}

/// Random expressions, evaluated as they are and as they are written: the same bits.
#[test]
fn writing_rounds_nothing() {
    let mut seed = 1_u64;
    for _ in 0..20 {
        let values: Vec<Expression> = (0..150).map(|_| random(&mut seed, 5)).collect();
        let names: Vec<String> = (0..values.len()).map(|i| format!("value_{i}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let locals: Vec<Expression> = (0..values.len()).map(local).collect();
        let statements = values.iter().cloned().enumerate();
        let statements = statements.map(|(i, value)| set(i, value)).collect();
        let method = parsed::scalar_function(program(&names, statements, vec![sum(&locals)]));
        let mut lets = method.block.stmts.iter();
        for value in &values {
            let Some(syn::Stmt::Local(written)) = lets.next() else {
                panic!("not enough statements");
            };
            let written = &written.init.as_ref().unwrap().expr;
            let (direct, read) = (evaluate(value), evaluate_syntax(written));
            let same = direct.to_bits() == read.to_bits() || direct.is_nan() && read.is_nan();
            // Zero has a sign too, which is free.
            let zero = direct == 0.0 && read == 0.0;
            assert!(same || zero, "{value:?} is written {}", parsed::text(written));
        }
    }
}

fn next(seed: &mut u64, below: u64) -> u64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) % below
}

fn random(seed: &mut u64, depth: u32) -> Expression {
    if depth == 0 {
        return match next(seed, 5) {
            0 => lit(1.5 - next(seed, 4) as f64),
            n => field(n as usize - 1),
        };
    }
    let count = 1 + next(seed, 3);
    match next(seed, 5) {
        0 => neg(random(seed, depth - 1)),
        1 => div(random(seed, depth - 1), random(seed, depth - 1)),
        2 => mul(&(0..count).map(|_| random(seed, depth - 1)).collect::<Vec<_>>()),
        3 => Expression::Sum((0..=count).map(|_| (next(seed, 2) == 1, random(seed, depth - 1))).collect()),
        _ => random(seed, 0),
    }
}

const FIELDS: [(&str, f64); 4] = [("g_by_l", 0.3), ("inertia", -1.7), ("l", 0.7654321), ("moment", 3.21e-3)];

fn evaluate(value: &Expression) -> f64 {
    match value {
        Expression::Literal(value) => *value,
        Expression::Field(field) => FIELDS[field.0].1,
        Expression::Neg(a) => -evaluate(a),
        Expression::Quotient(a, b) => evaluate(a) / evaluate(b),
        Expression::Product(list) => list.iter().map(evaluate).reduce(|a, b| a * b).unwrap(),
        Expression::Sum(terms) => terms
            .iter()
            .map(|(minus, term)| if *minus { -evaluate(term) } else { evaluate(term) })
            .reduce(|a, b| a + b)
            .unwrap(),
        _ => unreachable!(),
    }
}

fn evaluate_syntax(expr: &syn::Expr) -> f64 {
    match expr {
        syn::Expr::Paren(inner) => evaluate_syntax(&inner.expr),
        syn::Expr::Unary(unary) => -evaluate_syntax(&unary.expr),
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Float(value), .. }) => value.base10_parse().unwrap(),
        syn::Expr::Call(call) => evaluate_syntax(&call.args[0]),
        syn::Expr::Field(field) => {
            let syn::Member::Named(name) = &field.member else { unreachable!() };
            FIELDS.iter().find(|(known, _)| name == known).unwrap().1
        }
        syn::Expr::Binary(binary) => {
            let (a, b) = (evaluate_syntax(&binary.left), evaluate_syntax(&binary.right));
            match binary.op {
                syn::BinOp::Add(_) => a + b,
                syn::BinOp::Sub(_) => a - b,
                syn::BinOp::Mul(_) => a * b,
                _ => a / b,
            }
        }
        _ => unreachable!(),
    }
}
