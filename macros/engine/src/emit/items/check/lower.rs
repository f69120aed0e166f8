//! Stage `emit`: expressions of parameters as scalar expressions, for `Params::check`.
//!
//! In: a checked expression of parameters, and of states, which stand where they start. Out: its scalars as [`Expression`]s, or
//! nothing where it depends on anything else. No algebra: what the check computes needs no optimisation.

use std::f64::consts::PI;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::model::types::{Comparison, Expr, ExprNode, Function, Model};
use crate::optimize::program::Expression;

/// The expression of a scalar.
pub(in crate::emit) fn scalar(model: &Model, expr: &Expr) -> Option<Expression> {
    match <[Expression; 1]>::try_from(lower(model, expr)?) {
        Ok([scalar]) => Some(scalar),
        Err(_) => None,
    }
}

/// One expression per scalar of the value.
fn lower(model: &Model, expr: &Expr) -> Option<Vec<Expression>> {
    let all = |expr: &Expr| lower(model, expr);
    let one = |expr: &Expr| scalar(model, expr);
    Some(match expr.node.as_ref() {
        ExprNode::Number(value) => vec![Expression::Literal(*value)],
        ExprNode::Pi => vec![Expression::Literal(PI)],
        ExprNode::Param(param) => {
            let count = model.params[*param].ty.scalars();
            let symbol = |element| Symbol::Param { param: *param, element };
            (0..count).map(|i| Expression::Symbol(symbol(i))).collect()
        }
        ExprNode::State(state) => vec![Expression::Literal(model.states[*state].start)],
        ExprNode::Vec3(components) => components.iter().map(one).collect::<Option<_>>()?,
        ExprNode::Array(elements) => elements.iter().map(all).collect::<Option<Vec<_>>>()?.concat(),
        ExprNode::Index(array, index) => {
            let size = expr.ty.scalars();
            all(array)?.into_iter().skip(index * size).take(size).collect()
        }
        ExprNode::Component(vector, axis) => vec![all(vector)?.into_iter().nth(*axis)?],
        ExprNode::Neg(a) => all(a)?.into_iter().map(negative).collect(),
        ExprNode::Add(a, b) => pairwise(all(a)?, all(b)?, |a, b| Expression::Sum(vec![(false, a), (false, b)])),
        ExprNode::Sub(a, b) => pairwise(all(a)?, all(b)?, minus),
        ExprNode::Mul(a, b) => pairwise(all(a)?, all(b)?, times),
        ExprNode::Div(a, b) => pairwise(all(a)?, all(b)?, over),
        ExprNode::Call(function, arguments) => call(model, *function, arguments)?,
        ExprNode::Compare(comparison, a, b) => vec![compare(*comparison, one(a)?, one(b)?)],
        ExprNode::And(a, b) => vec![Expression::Call(Call::And, vec![one(a)?, one(b)?])],
        ExprNode::Or(a, b) => vec![Expression::Call(Call::Or, vec![one(a)?, one(b)?])],
        ExprNode::Not(a) => vec![Expression::Call(Call::Not, vec![one(a)?])],
        ExprNode::Select(condition, a, b) => {
            let condition = one(condition)?;
            pairwise(all(a)?, all(b)?, |a, b| Expression::Call(Call::Select, vec![condition.clone(), a, b]))
        }
        _ => return None,
    })
}

fn call(model: &Model, function: Function, arguments: &[Expr]) -> Option<Vec<Expression>> {
    let lowered: Vec<Vec<Expression>> = arguments.iter().map(|a| lower(model, a)).collect::<Option<_>>()?;
    let simple = match function {
        Function::Tan => Call::Tan,
        Function::Asin => Call::Asin,
        Function::Acos => Call::Acos,
        Function::Atan => Call::Atan,
        Function::Atan2 => Call::Atan2,
        Function::Sinh => Call::Sinh,
        Function::Cosh => Call::Cosh,
        Function::Tanh => Call::Tanh,
        Function::Exp => Call::Exp,
        Function::Ln => Call::Ln,
        Function::Sqrt => Call::Sqrt,
        Function::Abs => Call::Abs,
        Function::Signum => Call::Signum,
        Function::Min => Call::Min,
        Function::Max => Call::Max,
        Function::Powf | Function::Powi => Call::Powf,
        _ => return special(function, lowered),
    };
    Some(vec![Expression::Call(simple, lowered.concat())])
}

/// Functions that are not one call of the scalar's.
fn special(function: Function, arguments: Vec<Vec<Expression>>) -> Option<Vec<Expression>> {
    let mut arguments = arguments.into_iter();
    let a = arguments.next()?;
    let mut b = || arguments.next().or_fault("a function of two values has two arguments");
    Some(match function {
        Function::Deg => pairwise(a, vec![Expression::Literal(PI / 180.0)], times),
        Function::Dot => vec![dot(a, b())],
        Function::Norm => vec![Expression::Call(Call::Sqrt, vec![dot(a.clone(), a)])],
        Function::Hypot => {
            let sides = [a, b()].concat();
            vec![Expression::Call(Call::Sqrt, vec![dot(sides.clone(), sides)])]
        }
        Function::Cross => {
            let (Ok([ax, ay, az]), Ok([bx, by, bz])) =
                (<[Expression; 3]>::try_from(a), <[Expression; 3]>::try_from(b()))
            else {
                return None;
            };
            let of = |p: &Expression, q: &Expression, r: &Expression, s: &Expression| {
                minus(times(p.clone(), q.clone()), times(r.clone(), s.clone()))
            };
            vec![of(&ay, &bz, &az, &by), of(&az, &bx, &ax, &bz), of(&ax, &by, &ay, &bx)]
        }
        // Sine and cosine are statements of programs, not expressions.
        _ => return None,
    })
}

fn compare(comparison: Comparison, a: Expression, b: Expression) -> Expression {
    let not = |mask| Expression::Call(Call::Not, vec![mask]);
    match comparison {
        Comparison::Less => Expression::Call(Call::Less, vec![a, b]),
        Comparison::LessEqual => Expression::Call(Call::LessEqual, vec![a, b]),
        Comparison::Greater => Expression::Call(Call::Less, vec![b, a]),
        Comparison::GreaterEqual => Expression::Call(Call::LessEqual, vec![b, a]),
        Comparison::Equal => Expression::Call(Call::Equal, vec![a, b]),
        Comparison::NotEqual => not(Expression::Call(Call::Equal, vec![a, b])),
    }
}

/// Element by element; a scalar goes with every element of the other side.
fn pairwise(
    a: Vec<Expression>,
    b: Vec<Expression>,
    operation: impl Fn(Expression, Expression) -> Expression,
) -> Vec<Expression> {
    let count = a.len().max(b.len());
    let (a, b) = (a.into_iter().cycle(), b.into_iter().cycle());
    a.zip(b).take(count).map(|(a, b)| operation(a, b)).collect()
}

fn negative(a: Expression) -> Expression {
    Expression::Neg(Box::new(a))
}

fn minus(a: Expression, b: Expression) -> Expression {
    Expression::Sum(vec![(false, a), (true, b)])
}

fn times(a: Expression, b: Expression) -> Expression {
    Expression::Product(vec![a, b])
}

fn over(a: Expression, b: Expression) -> Expression {
    Expression::Quotient(Box::new(a), Box::new(b))
}

fn dot(a: Vec<Expression>, b: Vec<Expression>) -> Expression {
    Expression::Sum(pairwise(a, b, times).into_iter().map(|term| (false, term)).collect())
}
