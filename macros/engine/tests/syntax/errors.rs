//! What the parser says about mistakes: every message once at least, where it stands, and what is kept.

use multibody_engine::syntax::tree::{ItemKind, UNREADABLE, poisoned, poisoned_type};

use crate::parse_text;

const CASES: &str = include_str!("samples/errors.txt");

/// What is said, in the form of the file of cases.
fn said(text: &str) -> Vec<String> {
    let (source, diagnostics) = parse_text(text);
    let mut lines: Vec<String> = Vec::new();
    for error in diagnostics.errors() {
        let token = error.span.source_text().unwrap_or_default();
        let help = error.help.as_deref().map(|help| format!(" | {help}")).unwrap_or_default();
        lines.push(format!("{token} | {}{help}", error.message));
    }
    let items: usize = source.modules.iter().map(|module| module.items.len()).sum();
    lines.push(format!("kept: {items}"));
    lines
}

#[test]
fn cases() {
    let mut wrong = String::new();
    let mut lines = CASES.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")).peekable();
    let mut count = 0;
    while let Some(case) = lines.next() {
        let mut expected: Vec<&str> = Vec::new();
        while let Some(line) = lines.next_if(|line| line.starts_with("    ")) {
            expected.push(line.trim());
        }
        let text = case.strip_prefix("call:").map_or_else(|| format!("mod m {{ {case} }}"), str::to_owned);
        let said: Vec<String> = said(&text).iter().map(|line| line.trim().to_owned()).collect();
        if said != expected {
            wrong += &format!("{case}\n    {}\n", said.join("\n    "));
        }
        count += 1;
    }
    assert!(wrong.is_empty(), "said instead:\n{wrong}");
    assert!(count > 150, "{count} cases are read");
}

fn check(text: &str, kept: usize, expected: &[&str]) {
    let mut expected: Vec<String> = expected.iter().map(|line| line.to_string()).collect();
    expected.push(format!("kept: {kept}"));
    assert_eq!(said(text), expected, "{text}");
}

/// Later stages hear of what was lost, and of nothing else.
#[test]
fn placeholders() {
    let text = "mod m { param a: &f64 = 1^2; body b { mass: if, com: Y, 3 } joint j { axis: Z } link c {} }
        mod n { body b { mass: x^2 } }";
    let (source, diagnostics) = parse_text(text);
    assert_eq!(diagnostics.errors().len(), 7);
    let [m, n] = source.modules.as_slice() else { panic!("two models") };
    assert_eq!((m.broken, n.broken), (true, false));
    let [ItemKind::Param(a), ItemKind::Body { fields: b, .. }, ItemKind::Joint { kind, fields: j, .. }] =
        [&m.items[0].kind, &m.items[1].kind, &m.items[2].kind]
    else {
        panic!("three items")
    };
    assert!(a.ty.as_ref().is_some_and(poisoned_type) && a.value.as_ref().is_some_and(poisoned));
    assert!(b.broken && poisoned(&b.list[0].value) && !poisoned(&b.list[1].value));
    assert!(kind == UNREADABLE && !j.broken && !poisoned(&j.list[0].value));
    let ItemKind::Body { fields, .. } = &n.items[0].kind else { panic!("a body") };
    assert!(!fields.broken && poisoned(&fields.list[0].value));
}

/// All mistakes of one model at once, each at its own token.
#[test]
fn all_mistakes_at_once() {
    let text = "mod m {
        param a = 1.0f64
        parm b = v^2;
        body c { mass = 1, com: [0, 1 2], inertia: if x { 1 } };
        joint d Revolute { parent: ground child: c }
        output e = c.0;
        emit f;
    }";
    check(
        text,
        6,
        &[
            "1.0f64 | a number has no suffix here: remove `f64` | write `1.0`",
            "parm | unknown item `parm` | did you mean `param`?",
            "^ | `^` means nothing in an expression | write `powi(v, 2)`",
            "= | expected `:` after `mass`, found `=` | a field is written `name: value`",
            "2 | expected an operator or `,`, found `2` | a product is written with `*`",
            "if | `if` means nothing in an expression | write `select(condition, a, b)`",
            "; | an item with braces has no `;` | remove the `;`",
            "Revolute | expected `:` before the kind, found `Revolute` | write `joint name: Revolute { parent: ground, child: body, axis: Z }`",
            "child | missing `,` before `child`",
            "0 | expected a name after `.`, found `0` | elements are written `[0]`, components `.x`, `.y` and `.z`",
        ],
    );
}

/// Limits that no model written by hand meets.
#[test]
fn limits() {
    let case = |value: String, expected: &str| check(&format!("mod m {{ let a = {value}; }}"), 1, &[expected]);
    let nested = "( | brackets are nested more than 64 deep | name the inner expressions with `let`";
    case(format!("{}x{}", "(".repeat(64), ")".repeat(64)), nested);
    let tokens = [
        ("+ | ", "x + ".repeat(256) + "x"),
        ("- | ", "-".repeat(256) + "x"),
        (". | ", "x".to_owned() + &".y".repeat(256)),
    ];
    for (token, value) in tokens {
        let message = "this expression has more than 256 operators in a row | name parts of it with `let`";
        case(value, &format!("{token}{message}"));
    }
    let digits = "9".repeat(801);
    case(digits.clone(), &format!("{digits} | this number has more than 800 digits"));
}
