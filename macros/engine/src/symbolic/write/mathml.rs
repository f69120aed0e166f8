//! Stage `symbolic`, writing: formulas in MathML Core.
//!
//! In: a formula. Out: a `<math>` element that browsers set without a script. Markdown passes it as it is where it stands in a
//! `<div>` on lines of its own; no line is empty and none is indented, which would end the block.

use super::formula::{Equation, Formula, Function, Identifier, Relation};
use super::latex;

/// One equation as a display.
pub fn equation(Equation { left, right }: &Equation) -> String {
    display(&format!("{}<mo>=</mo>{}", row(left), row(right)))
}

/// A formula as a display.
pub fn alone(formula: &Formula) -> String {
    display(&row(formula))
}

fn display(content: &str) -> String {
    format!("<math display=\"block\" style=\"margin:0.6em 0\"><mrow>{content}</mrow></math>")
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
    if index.is_empty() { dotted } else { format!("<msub>{dotted}<mtext>{}</mtext></msub>", escaped(&index)) }
}

fn greek(word: &str) -> Option<char> {
    const LETTERS: [char; 22] =
        ['α', 'β', 'γ', 'δ', 'ε', 'ζ', 'η', 'θ', 'ι', 'κ', 'λ', 'μ', 'ν', 'ξ', 'ρ', 'σ', 'τ', 'υ', 'φ', 'χ', 'ψ', 'ω'];
    latex::GREEK.iter().position(|known| *known == word).map(|k| LETTERS[k])
}

fn escaped(text: &str) -> String {
    // Markdown would read underscores and asterisks as emphasis.
    text.replace('&', "&amp;").replace('<', "&lt;").replace('_', "&#95;").replace('*', "&#42;")
}

/// Words beside each other need a space; the sign itself has none.
const TIMES: &str = "<mo lspace=\"0.2em\" rspace=\"0em\">&#8290;</mo>";

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
                    text.push_str(if starts_with_digit(factor) { "<mo>·</mo>" } else { TIMES });
                }
                bracketed(text, factor, matches!(factor, Formula::Sum(_) | Formula::Minus(_) | Formula::Related(..)));
            }
        }
        Formula::Fraction(above, below) => {
            text.push_str(&format!("<mfrac><mrow>{}</mrow><mrow>{}</mrow></mfrac>", row(above), row(below)));
        }
        Formula::Power(x, n) => text.push_str(&format!("<msup>{}<mn>{n}</mn></msup>", base(x))),
        Formula::General(x, y) => text.push_str(&format!("<msup>{}<mrow>{}</mrow></msup>", base(x), row(y))),
        Formula::Root(x) => text.push_str(&format!("<msqrt>{}</msqrt>", row(x))),
        Formula::Absolute(x) => text.push_str(&format!("<mrow><mo>|</mo>{}<mo>|</mo></mrow>", row(x))),
        Formula::Apply(function, list) => {
            text.push_str(&format!("<mi>{}</mi>", function.word()));
            if !matches!(function, Function::Epsilon | Function::Undefined) {
                let arguments: Vec<String> = list.iter().map(row).collect();
                let arguments = arguments.join("<mo>,</mo>");
                text.push_str(&format!("<mo>&#8289;</mo><mrow><mo>(</mo>{arguments}<mo>)</mo></mrow>"));
            }
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
    if plain || text.starts_with("<mrow>") { text } else { format!("<mrow>{text}</mrow>") }
}
