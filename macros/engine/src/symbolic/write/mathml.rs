//! Stage `symbolic`, writing: formulas in MathML Core.
//!
//! In: a formula. Out: a `<math>` element that browsers set without a script, in few tags: no rows around one thing, no brackets
//! around the one name that a sine is of, no attributes that are the operator's anyway. Markdown passes it as it is where it stands
//! in a `<div>` on lines of its own; no line is empty and none is indented, which would end the block.

use super::formula::{Equation, Formula, Function, Identifier, Relation};
use super::latex;

/// One equation as a display.
pub fn equation(Equation { left, right }: &Equation) -> String {
    // Right behind the equals sign a minus would be one between two terms.
    let is_negative = match right {
        Formula::Minus(_) => true,
        Formula::Sum(terms) => terms.first().is_some_and(|(minus, _)| *minus),
        _ => false,
    };
    let right = if is_negative { one(right) } else { row(right) };
    display(&format!("{}<mo>=</mo>{right}", row(left)))
}

/// A formula as a display.
pub fn alone(formula: &Formula) -> String {
    display(&row(formula))
}

fn display(content: &str) -> String {
    format!("<math display=\"block\" style=\"margin:0.6em 0\">{content}</math>")
}

fn row(formula: &Formula) -> String {
    let mut text = String::new();
    put(&mut text, formula);
    text
}

/// A name with its index and dots.
pub fn name(identifier: &Identifier) -> String {
    let (stem, index) = latex::taken_apart(identifier);
    let stem = match greek(&stem) {
        _ if latex::is_typed(identifier) => format!("<mtext>{}</mtext>", escaped(&stem)),
        Some(letter) => format!("<mi>{letter}</mi>"),
        None => format!("<mi>{}</mi>", escaped(&stem)),
    };
    let dotted = match identifier.dots {
        0 => stem,
        1 => format!("<mover>{stem}<mo>˙</mo></mover>"),
        _ => format!("<mover>{stem}<mo>¨</mo></mover>"),
    };
    match index.as_str() {
        "" => dotted,
        digits if digits.bytes().all(|byte| byte.is_ascii_digit()) => format!("<msub>{dotted}<mn>{digits}</mn></msub>"),
        words => format!("<msub>{dotted}<mi>{}</mi></msub>", escaped(words)),
    }
}

fn greek(word: &str) -> Option<char> {
    const LETTERS: [char; 32] = [
        'α', 'β', 'γ', 'δ', 'ε', 'ζ', 'η', 'θ', 'ι', 'κ', 'λ', 'μ', 'ν', 'ξ', 'ρ', 'σ', 'τ', 'υ', 'φ', 'χ', 'ψ', 'ω',
        'Γ', 'Δ', 'Θ', 'Λ', 'Ξ', 'Σ', 'Υ', 'Φ', 'Ψ', 'Ω',
    ];
    latex::GREEK.iter().position(|known| *known == word).map(|k| LETTERS[k])
}

fn escaped(text: &str) -> String {
    // Markdown would read underscores and asterisks as emphasis.
    text.replace('&', "&amp;").replace('<', "&lt;").replace('_', "&#95;").replace('*', "&#42;")
}

/// The sign between factors. It has no width, so words beside each other need a space.
fn times(before: &Formula, after: &Formula) -> &'static str {
    let is_function = matches!(after, Formula::Apply(..) | Formula::Called(..));
    let is_bracket = matches!(after, Formula::Sum(_) | Formula::Minus(_) | Formula::Related(..));
    match () {
        () if starts_with_digit(after) => "<mo>·</mo>",
        () if is_function || is_word(after) || is_word(before) && !is_bracket => "<mo lspace=\".2em\">\u{2062}</mo>",
        () => "<mo>\u{2062}</mo>",
    }
}

/// Whether a factor is set in letters that would run into those beside it.
fn is_word(factor: &Formula) -> bool {
    match factor {
        Formula::Name(identifier) => {
            let (stem, index) = latex::taken_apart(identifier);
            let is_letter = stem.chars().count() == 1 || greek(&stem).is_some();
            !is_letter || index.chars().count() > 1
        }
        Formula::Power(x, _) => is_word(x),
        Formula::Apply(..) | Formula::Called(..) => true,
        _ => false,
    }
}

/// A row where one thing must stand.
fn one(formula: &Formula) -> String {
    let is_one = match formula {
        Formula::Number(_) | Formula::Pi | Formula::Name(_) | Formula::Fraction(..) | Formula::Power(..) => true,
        Formula::General(..) | Formula::Root(_) | Formula::Absolute(_) | Formula::Cases(_) => true,
        Formula::Apply(function, _) => matches!(function, Function::Epsilon | Function::Undefined),
        Formula::Minus(_) | Formula::Sum(_) | Formula::Product(_) | Formula::Related(..) | Formula::Not(_) => false,
        Formula::Called(..) => false,
    };
    if is_one { row(formula) } else { format!("<mrow>{}</mrow>", row(formula)) }
}

fn put(text: &mut String, formula: &Formula) {
    match formula {
        Formula::Number(digits) => text.push_str(&format!("<mn>{digits}</mn>")),
        Formula::Pi => text.push_str("<mi>π</mi>"),
        Formula::Name(identifier) => text.push_str(&name(identifier)),
        Formula::Minus(x) => {
            text.push_str("<mo>−</mo>");
            bracketed(text, x, matches!(**x, Formula::Sum(_) | Formula::Minus(_)));
        }
        Formula::Sum(terms) => {
            for (k, (minus, term)) in terms.iter().enumerate() {
                text.push_str(match (k, minus) {
                    (0, false) => "",
                    (_, false) => "<mo>+</mo>",
                    (_, true) => "<mo>−</mo>",
                });
                bracketed(text, term, matches!(term, Formula::Sum(_) | Formula::Minus(_)));
            }
        }
        Formula::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                if k > 0 {
                    text.push_str(times(&factors[k - 1], factor));
                }
                bracketed(text, factor, matches!(factor, Formula::Sum(_) | Formula::Minus(_) | Formula::Related(..)));
            }
        }
        Formula::Fraction(above, below) => {
            text.push_str(&format!("<mfrac>{}{}</mfrac>", one(above), one(below)));
        }
        Formula::Power(x, n) => text.push_str(&format!("<msup>{}<mn>{n}</mn></msup>", base(x))),
        Formula::General(x, y) => text.push_str(&format!("<msup>{}{}</msup>", base(x), one(y))),
        Formula::Root(x) => text.push_str(&format!("<msqrt>{}</msqrt>", row(x))),
        Formula::Absolute(x) => text.push_str(&format!("<mrow><mo>|</mo>{}<mo>|</mo></mrow>", row(x))),
        Formula::Apply(function, list) => {
            text.push_str(&format!("<mi>{}</mi>", function.word()));
            match &list[..] {
                _ if matches!(function, Function::Epsilon | Function::Undefined) => {}
                [Formula::Name(argument)] => {
                    text.push_str(&format!("<mo rspace=\".17em\">\u{2061}</mo>{}", name(argument)));
                }
                list => arguments(text, list),
            }
        }
        Formula::Called(function, list) => {
            text.push_str(&name(function));
            arguments(text, list);
        }
        Formula::Related(relation, a, b) => {
            let side = |x: &Formula| matches!(x, Formula::Related(..));
            bracketed(text, a, side(a));
            text.push_str(match relation {
                Relation::Less => "<mo>&lt;</mo>",
                Relation::LessEqual => "<mo>≤</mo>",
                Relation::Equal => "<mo>=</mo>",
                Relation::And => "<mo>∧</mo>",
                Relation::Or => "<mo>∨</mo>",
            });
            bracketed(text, b, side(b));
        }
        Formula::Not(x) => {
            text.push_str("<mo>¬</mo>");
            bracketed(text, x, true);
        }
        Formula::Cases(parts) => {
            let [condition, yes, no] = &**parts;
            text.push_str(&format!(
                "<mrow><mo>{{</mo><mtable><mtr><mtd>{}</mtd><mtd><mtext>if&#160;</mtext>{}</mtd></mtr>\
                 <mtr><mtd>{}</mtd><mtd><mtext>else</mtext></mtd></mtr></mtable></mrow>",
                row(yes),
                row(condition),
                row(no)
            ));
        }
    }
}

fn arguments(text: &mut String, list: &[Formula]) {
    let arguments: Vec<String> = list.iter().map(row).collect();
    let arguments = arguments.join("<mo>,</mo>");
    text.push_str(&format!("<mo>\u{2061}</mo><mrow><mo>(</mo>{arguments}<mo>)</mo></mrow>"));
}

fn starts_with_digit(formula: &Formula) -> bool {
    match formula {
        Formula::Number(_) => true,
        Formula::Power(x, _) | Formula::General(x, _) => starts_with_digit(x),
        _ => false,
    }
}

fn bracketed(text: &mut String, formula: &Formula, brackets: bool) {
    if brackets {
        text.push_str("<mrow><mo>(</mo>");
    }
    put(text, formula);
    if brackets {
        text.push_str("<mo>)</mo></mrow>");
    }
}

fn base(formula: &Formula) -> String {
    let mut text = String::new();
    let plain = matches!(formula, Formula::Number(_) | Formula::Pi | Formula::Name(_));
    bracketed(&mut text, formula, !plain);
    text
}
