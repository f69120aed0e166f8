//! What equations are worth at a state, for comparison with compiled functions.

use std::collections::HashMap;

use multibody_engine::symbolic::write::formula::{Formula, Function, Identifier, Relation};

/// Values by name.
pub(crate) type Known = HashMap<Identifier, f64>;

/// The value of a formula; NaN where a name has none.
pub(crate) fn value(formula: &Formula, known: &Known) -> f64 {
    let of = |x: &Formula| value(x, known);
    match formula {
        Formula::Number(digits) => digits.parse().unwrap(),
        Formula::Pi => std::f64::consts::PI,
        Formula::Name(name) => known.get(name).copied().unwrap_or(f64::NAN),
        Formula::Minus(x) => -of(x),
        Formula::Sum(terms) => terms.iter().map(|(minus, term)| if *minus { -of(term) } else { of(term) }).sum(),
        Formula::Product(factors) => factors.iter().map(of).product(),
        Formula::Fraction(a, b) => of(a) / of(b),
        Formula::Power(x, n) => of(x).powi(*n as i32),
        Formula::General(x, y) => of(x).powf(of(y)),
        Formula::Root(x) => of(x).sqrt(),
        Formula::Absolute(x) => of(x).abs(),
        Formula::Apply(function, list) => applied(*function, &list.iter().map(of).collect::<Vec<_>>()),
        Formula::Called(..) => unreachable!("no model here calls functions of Rust"),
        Formula::Related(..) | Formula::Not(_) => f64::from(u8::from(truth(formula, known))),
        Formula::Cases(parts) => of(&parts[if truth(&parts[0], known) { 1 } else { 2 }]),
    }
}

fn truth(formula: &Formula, known: &Known) -> bool {
    match formula {
        Formula::Related(Relation::And, a, b) => truth(a, known) && truth(b, known),
        Formula::Related(Relation::Or, a, b) => truth(a, known) || truth(b, known),
        Formula::Related(Relation::Less, a, b) => value(a, known) < value(b, known),
        Formula::Related(Relation::LessEqual, a, b) => value(a, known) <= value(b, known),
        Formula::Related(Relation::Equal, a, b) => value(a, known) == value(b, known),
        Formula::Not(x) => !truth(x, known),
        other => panic!("no condition: {other:?}"),
    }
}

fn applied(function: Function, list: &[f64]) -> f64 {
    match (function, list) {
        (Function::Sin, [x]) => x.sin(),
        (Function::Cos, [x]) => x.cos(),
        (Function::Tan, [x]) => x.tan(),
        (Function::Asin, [x]) => x.asin(),
        (Function::Acos, [x]) => x.acos(),
        (Function::Atan, [x]) => x.atan(),
        (Function::Atan2, [y, x]) => y.atan2(*x),
        (Function::Sinh, [x]) => x.sinh(),
        (Function::Cosh, [x]) => x.cosh(),
        (Function::Tanh, [x]) => x.tanh(),
        (Function::Exp, [x]) => x.exp(),
        (Function::Ln, [x]) => x.ln(),
        (Function::Signum, [x]) => {
            if *x == 0.0 {
                0.0
            } else {
                x.signum()
            }
        }
        (Function::Min, [x, y]) => x.min(*y),
        (Function::Max, [x, y]) => x.max(*y),
        (Function::Epsilon, []) => f64::EPSILON,
        (Function::Undefined, []) => f64::NAN,
        other => panic!("{other:?}"),
    }
}
