//! Expressions bind as Rust's own do: what this parser reads, syn reads the same way.

use multibody_engine::syntax::tree::ItemKind;
use syn::Expr;

use crate::robust::Random;
use crate::valid;

/// The expression as the engine reads it.
fn read(text: &str) -> Expr {
    let source = valid(&format!("mod m {{ let a = {text}; }}"));
    match source.modules.into_iter().next().and_then(|module| module.items.into_iter().next()).map(|item| item.kind) {
        Some(ItemKind::Let(value)) => value.value.unwrap_or_else(|| panic!("a value in {text}")),
        _ => panic!("one `let` in {text}"),
    }
}

fn same(text: &str) {
    let rust: Expr = syn::parse_str(text).unwrap_or_else(|error| panic!("{error} in {text}"));
    assert_eq!(read(text), rust, "{text}");
}

#[test]
fn precedence() {
    for text in [
        "a - b - c",
        "a / b * c / d",
        "a + b * c - d / e",
        "-x.powi(2)",
        "-a * b",
        "--a",
        "a--b",
        "!a == b",
        "!(a < b) || c > d && e != f",
        "a && b || c && d",
        "-a.b.c(d)[e].f",
        "[a, -b, [c, d]][0][1]",
        "f(a, g(b), [c])",
        "(((a)))",
        "1.0.max(2.)",
        "1 + 0x1F + 0b11 + 1_000.5e-3",
        "a.b[i + 1].at(-0.5 * l * Y)",
    ] {
        same(text);
    }
}

#[test]
fn random_expressions() {
    let mut random = Random::new(7);
    for _ in 0..500 {
        let mut text = String::new();
        expression(&mut random, 4, true, &mut text);
        same(&text);
    }
}

/// A valid expression; a comparison only where it can't be chained.
fn expression(random: &mut Random, depth: usize, compare: bool, text: &mut String) {
    let terms = 1 + random.below(3);
    let compared = compare && random.below(4) == 0;
    for term in 0..terms {
        if term > 0 {
            let operators = if compared { &["<", "<=", "==", "!="] as &[&str] } else { &["+", "-", "*", "/", "-"] };
            text.push_str(operators[random.below(operators.len())]);
        }
        if term > 0 && compared {
            operand(random, depth, text);
            let logic = ["&&", "||"][random.below(2)];
            text.push_str(logic);
        }
        operand(random, depth, text);
    }
}

fn operand(random: &mut Random, depth: usize, text: &mut String) {
    for _ in 0..random.below(6).saturating_sub(3) {
        text.push_str([" -", " !"][random.below(2)]);
    }
    let leaf = ["a", "2", "3.5", "motor", "1e-3"][random.below(5)];
    match if depth == 0 { 0 } else { random.below(8) } {
        0..=2 => text.push_str(leaf),
        3 => bracketed("(", ")", 1, random, depth, text),
        4 => bracketed("[", "]", 3, random, depth, text),
        5 => bracketed("f(", ")", 2, random, depth, text),
        6 => bracketed("a.m(", ").y", 2, random, depth, text),
        _ => bracketed("table[", "].x", 1, random, depth, text),
    }
}

fn bracketed(open: &str, close: &str, elements: usize, random: &mut Random, depth: usize, text: &mut String) {
    text.push_str(open);
    for element in 0..elements {
        if element > 0 {
            text.push(',');
        }
        expression(random, depth - 1, true, text);
    }
    text.push_str(close);
}
