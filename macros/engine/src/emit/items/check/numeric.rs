//! Stage `emit`: values of parameter expressions at the declared defaults.
//!
//! In: expressions over parameters. Out: numbers, or nothing where there is anything else in them.

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::model::types::Model;
use crate::optimize::program::Expression;

/// The expression's value.
pub(in crate::emit) fn value(model: &Model, expression: &Expression) -> Option<f64> {
    let of = |expression: &Expression| value(model, expression);
    Some(match expression {
        Expression::Literal(value) => *value,
        Expression::Symbol(Symbol::Param { param, element }) => *model.params[*param].default.get(*element)?,
        Expression::Neg(a) => -of(a)?,
        Expression::Sum(terms) => {
            let mut sum = 0.0;
            for (minus, term) in terms {
                sum += if *minus { -of(term)? } else { of(term)? };
            }
            sum
        }
        Expression::Product(factors) => {
            let mut product = 1.0;
            for factor in factors {
                product *= of(factor)?;
            }
            product
        }
        Expression::Quotient(a, b) => of(a)? / of(b)?,
        Expression::Call(function, arguments) => {
            let values: Vec<f64> = arguments.iter().map(of).collect::<Option<_>>()?;
            call(*function, &values)?
        }
        _ => return None,
    })
}

/// Masks are zero and one.
fn call(call: Call, values: &[f64]) -> Option<f64> {
    let mask = |is: bool| f64::from(u8::from(is));
    Some(match (call, values) {
        (Call::Tan, [x]) => x.tan(),
        (Call::Asin, [x]) => x.asin(),
        (Call::Acos, [x]) => x.acos(),
        (Call::Atan, [x]) => x.atan(),
        (Call::Atan2, [y, x]) => y.atan2(*x),
        (Call::Sinh, [x]) => x.sinh(),
        (Call::Cosh, [x]) => x.cosh(),
        (Call::Tanh, [x]) => x.tanh(),
        (Call::Exp, [x]) => x.exp(),
        (Call::Ln, [x]) => x.ln(),
        (Call::Powf, [x, y]) => x.powf(*y),
        (Call::Sqrt, [x]) => x.sqrt(),
        (Call::Abs, [x]) => x.abs(),
        (Call::Signum, [x]) if *x == 0.0 => 0.0,
        (Call::Signum, [x]) => x.signum(),
        (Call::Min, [x, y]) => x.min(*y),
        (Call::Max, [x, y]) => x.max(*y),
        (Call::Less, [x, y]) => mask(x < y),
        (Call::LessEqual, [x, y]) => mask(x <= y),
        (Call::Equal, [x, y]) => mask(x == y),
        (Call::And, [x, y]) => x * y,
        (Call::Or, [x, y]) => x.max(*y),
        (Call::Not, [x]) => 1.0 - x,
        (Call::Select, [condition, x, y]) => {
            if *condition == 0.0 {
                *y
            } else {
                *x
            }
        }
        _ => return None,
    })
}
