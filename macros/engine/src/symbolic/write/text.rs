//! Stage `symbolic`, writing: formulas as plain text.
//!
//! In: a formula. Out: one line for terminals and text files: `m l² φ¨ + m g l sin(φ) = 0`. Factors stand side by side, `/`
//! binds as a product does, a rate has a dot behind its name. A bracket right behind a word holds its arguments; behind a space
//! it is a factor. Beside words of functions only `if` and `else` have a meaning, which no name can be: `(a if x < y else b)`.

use super::formula::{Equation, Formula, Identifier, Relation};

/// How strongly what stands around a formula binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Around {
    Nothing,
    Sum,
    Product,
    Power,
}

/// One line.
pub fn equation(Equation { left, right }: &Equation) -> String {
    format!("{} = {}", formula(left), formula(right))
}

pub fn formula(formula: &Formula) -> String {
    let mut text = String::new();
    put(&mut text, formula, Around::Nothing);
    text
}

/// A name with its index and dots.
pub fn name(identifier: &Identifier) -> String {
    let dots = ["", "˙", "¨"][usize::from(identifier.dots.min(2))];
    let index = identifier.index.as_ref().map_or(String::new(), |index| format!("[{index}]"));
    format!("{}{index}{dots}", identifier.text)
}

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

fn superscript(n: u32) -> String {
    n.to_string().bytes().map(|digit| SUPERSCRIPTS[usize::from(digit - b'0')]).collect()
}

fn put(text: &mut String, formula: &Formula, around: Around) {
    let brackets = match formula {
        Formula::Minus(_) | Formula::Sum(_) | Formula::Related(..) | Formula::Not(_) => around > Around::Nothing,
        Formula::Product(_) => around > Around::Product,
        Formula::Fraction(..) => around > Around::Sum,
        Formula::Power(..) | Formula::General(..) => around > Around::Product,
        Formula::Name(identifier) => around > Around::Product && identifier.dots > 0,
        _ => false,
    };
    if brackets {
        text.push('(');
    }
    bare(text, formula);
    if brackets {
        text.push(')');
    }
}

fn bare(text: &mut String, formula: &Formula) {
    match formula {
        Formula::Number(digits) => text.push_str(digits),
        Formula::Pi => text.push('π'),
        Formula::Name(identifier) => text.push_str(&name(identifier)),
        Formula::Minus(x) => {
            text.push('-');
            put(text, x, Around::Sum);
        }
        Formula::Sum(terms) => {
            for (k, (minus, term)) in terms.iter().enumerate() {
                text.push_str(match (k, minus) {
                    (0, false) => "",
                    (0, true) => "-",
                    (_, false) => " + ",
                    (_, true) => " - ",
                });
                put(text, term, Around::Sum);
            }
        }
        Formula::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                if k > 0 {
                    text.push(' ');
                }
                put(text, factor, Around::Product);
            }
        }
        Formula::Fraction(above, below) => {
            put(text, above, Around::Product);
            text.push_str(" / ");
            // A product below the line has brackets here, since a quotient is read from the left.
            let around = if matches!(**below, Formula::Product(_)) { Around::Power } else { Around::Product };
            put(text, below, around);
        }
        Formula::Power(x, n) => {
            put(text, x, Around::Power);
            text.push_str(&superscript(*n));
        }
        Formula::General(x, y) => {
            put(text, x, Around::Power);
            text.push_str("^(");
            put(text, y, Around::Nothing);
            text.push(')');
        }
        Formula::Root(x) => call(text, "sqrt", [&**x]),
        Formula::Absolute(x) => call(text, "abs", [&**x]),
        // What takes no arguments is told from names by its empty brackets.
        Formula::Apply(function, list) => call(text, function.word(), list),
        Formula::Called(function, list) => call(text, &name(function), list),
        Formula::Related(relation, a, b) => {
            put(text, a, Around::Sum);
            text.push_str(match relation {
                Relation::Less => " < ",
                Relation::LessEqual => " <= ",
                Relation::Equal => " == ",
                Relation::And => " ∧ ",
                Relation::Or => " ∨ ",
            });
            put(text, b, Around::Sum);
        }
        Formula::Not(x) => {
            text.push('¬');
            put(text, x, Around::Power);
        }
        Formula::Cases(parts) => {
            let [condition, yes, no] = &**parts;
            text.push('(');
            put(text, yes, Around::Nothing);
            text.push_str(" if ");
            put(text, condition, Around::Nothing);
            text.push_str(" else ");
            put(text, no, Around::Nothing);
            text.push(')');
        }
    }
}

fn call<'f>(text: &mut String, name: &str, list: impl IntoIterator<Item = &'f Formula>) {
    text.push_str(name);
    text.push('(');
    for (k, argument) in list.into_iter().enumerate() {
        if k > 0 {
            text.push_str(", ");
        }
        put(text, argument, Around::Nothing);
    }
    text.push(')');
}
