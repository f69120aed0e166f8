//! Stage `symbolic`, writing: formulas in LaTeX.
//!
//! In: a formula. Out: what stands in an `equation` of amsmath. Names of one letter and Greek ones are set as such, digits
//! behind a name as an index, words upright.

use super::formula::{Equation, Formula, Function, Identifier, Relation};

/// One equation without its environment.
pub fn equation(Equation { left, right }: &Equation) -> String {
    format!("{} = {}", formula(left), formula(right))
}

pub fn formula(formula: &Formula) -> String {
    let mut text = String::new();
    put(&mut text, formula);
    text
}

/// A name with its index and dots.
pub fn name(identifier: &Identifier) -> String {
    let (stem, index) = taken_apart(identifier);
    let stem = match stem.as_str() {
        word if is_typed(identifier) => format!("\\mathtt{{{}}}", escaped(word)),
        word if GREEK.contains(&word) => format!("\\{word}"),
        word if word.chars().count() == 1 => word.to_owned(),
        word => format!("\\mathrm{{{}}}", escaped(word)),
    };
    let dotted = match identifier.dots {
        0 => stem,
        1 => format!("\\dot{{{stem}}}"),
        _ => format!("\\ddot{{{stem}}}"),
    };
    if index.is_empty() { dotted } else { format!("{dotted}_{{\\mathrm{{{}}}}}", escaped(&index)) }
}

/// Letters that have a name of their own.
pub(super) const GREEK: [&str; 32] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Sigma",
    "Upsilon", "Phi", "Psi", "Omega",
];

fn escaped(word: &str) -> String {
    // Spaces are lost in mathematics; behind a comma there is one.
    word.replace('_', "\\_").replace(' ', "\\ ").replace(",\\ ", ", ")
}

/// Whether a name is set as it is typed: one that is a function's word, or pi, would be read as that.
pub(super) fn is_typed(identifier: &Identifier) -> bool {
    identifier.typed || RESERVED.contains(&identifier.text.as_str())
}

/// Words that printers set for what is no name.
const RESERVED: [&str; 19] = [
    "sin",
    "cos",
    "tan",
    "arcsin",
    "arccos",
    "arctan",
    "atan2",
    "sinh",
    "cosh",
    "tanh",
    "exp",
    "ln",
    "sign",
    "min",
    "max",
    "eps",
    "undefined",
    "pi",
    "π",
];

/// A stem and all that is set below.
pub(super) fn taken_apart(identifier: &Identifier) -> (String, String) {
    if is_typed(identifier) {
        let index = identifier.index.as_ref().map_or(String::new(), |index| format!("[{index}]"));
        return (format!("{}{index}", identifier.text), String::new());
    }
    let (stem, index) = parts(&identifier.text);
    let all = [Some(&index).filter(|index| !index.is_empty()), identifier.index.as_ref()];
    let all: Vec<&str> = all.into_iter().flatten().map(String::as_str).collect();
    (stem, all.join(","))
}

/// A stem and what is set below: `l1` is l and 1, `legs[2].knee` knee and legs 2, `theta_a` theta and a.
fn parts(text: &str) -> (String, String) {
    let (path, last) = text.rsplit_once('.').unwrap_or(("", text));
    let digits = last.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, number) = if digits.is_empty() { (last, "") } else { last.split_at(digits.len()) };
    let (stem, below) = match stem.split_once('_').filter(|(first, rest)| is_letter(first) && !rest.is_empty()) {
        Some((first, rest)) => (first, rest),
        None => (stem, ""),
    };
    let path = without_brackets(path);
    let mut index = [path.as_str(), below].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(",");
    // A number stands right behind what it counts: `theta_a1` has the index a1, `legs[2].l1` has legs2,1.
    if !index.is_empty() && below.is_empty() && !number.is_empty() {
        index.push(',');
    }
    (stem.trim_end_matches('_').to_owned(), index + number)
}

/// `legs[2]` as `legs2`; a letter for the number keeps off the word, `legs i`.
fn without_brackets(path: &str) -> String {
    let mut result = String::new();
    let mut rest = path;
    while let Some((before, behind)) = rest.split_once('[') {
        result.push_str(before);
        if behind.starts_with(char::is_alphabetic) {
            result.push(' ');
        }
        rest = behind;
    }
    result.push_str(rest);
    result.replace(']', "")
}

fn is_letter(word: &str) -> bool {
    word.chars().count() == 1 || GREEK.contains(&word)
}

fn put(text: &mut String, formula: &Formula) {
    match formula {
        Formula::Number(digits) => text.push_str(digits),
        Formula::Pi => text.push_str("\\pi"),
        Formula::Name(identifier) => text.push_str(&name(identifier)),
        Formula::Minus(x) => {
            text.push('-');
            bracketed(text, x, matches!(**x, Formula::Sum(_) | Formula::Minus(_)));
        }
        Formula::Sum(terms) => {
            for (k, (minus, term)) in terms.iter().enumerate() {
                text.push_str(match (k, minus) {
                    (0, false) => "",
                    (0, true) => "-",
                    (_, false) => " + ",
                    (_, true) => " - ",
                });
                bracketed(text, term, matches!(term, Formula::Sum(_) | Formula::Minus(_)));
            }
        }
        Formula::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                if k > 0 {
                    // Digits beside each other would be one number.
                    text.push_str(if starts_with_digit(factor) { " \\cdot " } else { "\\," });
                }
                bracketed(text, factor, matches!(factor, Formula::Sum(_) | Formula::Minus(_) | Formula::Related(..)));
            }
        }
        Formula::Fraction(above, below) => {
            text.push_str("\\frac{");
            put(text, above);
            text.push_str("}{");
            put(text, below);
            text.push('}');
        }
        Formula::Power(x, n) => {
            base(text, x);
            text.push_str(&format!("^{{{n}}}"));
        }
        Formula::General(x, y) => {
            base(text, x);
            text.push_str("^{");
            put(text, y);
            text.push('}');
        }
        Formula::Root(x) => {
            text.push_str("\\sqrt{");
            put(text, x);
            text.push('}');
        }
        Formula::Absolute(x) => {
            text.push_str("\\left|");
            put(text, x);
            text.push_str("\\right|");
        }
        Formula::Apply(function, list) => {
            match function {
                Function::Epsilon => return text.push_str("\\varepsilon_{\\mathrm{rounding}}"),
                Function::Undefined => return text.push_str("\\mathrm{undefined}"),
                Function::Atan2 | Function::Signum => text.push_str(&format!("\\operatorname{{{}}}", function.word())),
                _ => text.push_str(&format!("\\{}", function.word())),
            }
            arguments(text, list);
        }
        Formula::Called(function, list) => {
            text.push_str(&name(function));
            arguments(text, list);
        }
        Formula::Related(relation, a, b) => {
            let side = |x: &Formula| matches!(x, Formula::Related(..));
            bracketed(text, a, side(a));
            text.push_str(match relation {
                Relation::Less => " < ",
                Relation::LessEqual => " \\le ",
                Relation::Equal => " = ",
                Relation::And => " \\land ",
                Relation::Or => " \\lor ",
            });
            bracketed(text, b, side(b));
        }
        Formula::Not(x) => {
            text.push_str("\\lnot ");
            bracketed(text, x, true);
        }
        Formula::Cases(parts) => {
            let [condition, yes, no] = &**parts;
            text.push_str("\\begin{cases} ");
            put(text, yes);
            text.push_str(" & \\text{if } ");
            put(text, condition);
            text.push_str(" \\\\ ");
            put(text, no);
            text.push_str(" & \\text{else} \\end{cases}");
        }
    }
}

fn starts_with_digit(formula: &Formula) -> bool {
    match formula {
        Formula::Number(_) => true,
        Formula::Power(x, _) | Formula::General(x, _) => starts_with_digit(x),
        _ => false,
    }
}

fn arguments(text: &mut String, list: &[Formula]) {
    text.push_str("\\left(");
    for (k, argument) in list.iter().enumerate() {
        if k > 0 {
            text.push_str(", ");
        }
        put(text, argument);
    }
    text.push_str("\\right)");
}

fn bracketed(text: &mut String, formula: &Formula, brackets: bool) {
    if brackets {
        text.push_str("\\left(");
    }
    put(text, formula);
    if brackets {
        text.push_str("\\right)");
    }
}

fn base(text: &mut String, formula: &Formula) {
    let plain = match formula {
        Formula::Number(_) | Formula::Pi => true,
        Formula::Name(identifier) => identifier.dots == 0 || taken_apart(identifier).1.is_empty(),
        _ => false,
    };
    bracketed(text, formula, !plain);
}
