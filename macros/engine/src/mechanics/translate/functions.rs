//! Stage `mechanics`: functions and comparisons of user expressions.
//!
//! In: values of arguments. Out: nodes; what the graph has rules for (sine, root, product) is said in its own terms.

use crate::contracts::call::Call;
use crate::invariant::fault::raise;
use crate::mechanics::equations::Equations;
use crate::model::types::{Comparison, Function, Type};
use crate::symbolic::graph::{Graph, Scalar, ScalarNode};

use super::values::Value;

/// Whole powers up to this are products.
const MOST_FACTORS: f64 = 8.0;

/// A function of the language.
pub(in crate::mechanics) fn call(g: &mut Graph, function: Function, arguments: &[Value]) -> Value {
    let argument = |k: usize| arguments[k].clone();
    let x = || argument(0).scalar();
    let y = || argument(1).scalar();
    Value::Scalar(match function {
        Function::Sin => g.sin(x()),
        Function::Cos => g.cos(x()),
        Function::Tan => g.call(Call::Tan, &[x()]),
        Function::Asin => g.call(Call::Asin, &[x()]),
        Function::Acos => g.call(Call::Acos, &[x()]),
        Function::Atan => g.call(Call::Atan, &[x()]),
        Function::Atan2 => g.call(Call::Atan2, &[x(), y()]),
        Function::Sinh => g.call(Call::Sinh, &[x()]),
        Function::Cosh => g.call(Call::Cosh, &[x()]),
        Function::Tanh => g.call(Call::Tanh, &[x()]),
        Function::Exp => g.call(Call::Exp, &[x()]),
        Function::Ln => g.call(Call::Ln, &[x()]),
        Function::Sqrt => g.sqrt(x()),
        Function::Abs => g.call(Call::Abs, &[x()]),
        Function::Signum => g.call(Call::Signum, &[x()]),
        Function::Min => g.call(Call::Min, &[x(), y()]),
        Function::Max => g.call(Call::Max, &[x(), y()]),
        Function::Hypot => g.length([x(), y(), Scalar::ZERO]),
        Function::Powi => {
            let power = g.literal(y()).map_or(0.0, |n| n.value());
            // Within range: a saturating cast of what the checker has seen to be an integer.
            g.powi(x(), power as i32)
        }
        Function::Powf => {
            match g.literal(y()).map(|n| n.value()).filter(|n| n.fract() == 0.0 && n.abs() <= MOST_FACTORS) {
                // The same for whole numbers, of negative bases too.
                Some(whole) => g.powi(x(), whole as i32),
                None => g.call(Call::Powf, &[x(), y()]),
            }
        }
        Function::Deg => {
            let degree = g.integer(180);
            let degree = g.reciprocal(degree);
            let pi = g.pi();
            g.product(&[x(), pi, degree])
        }
        Function::Dot => {
            let (a, b) = (argument(0).vector(g), argument(1).vector(g));
            g.dot(a, b)
        }
        Function::Norm => {
            let a = argument(0).vector(g);
            let components = g.components(a);
            if components.iter().all(|&c| g.literal(c).is_some()) {
                return Value::Scalar(g.length(components));
            }
            let square = g.dot(a, a);
            length(g, square)
        }
        Function::Cross => {
            let (a, b) = (argument(0).vector(g), argument(1).vector(g));
            return Value::Vector(g.cross(a, b));
        }
    })
}

/// The root of a square that is a product x x: the absolute value, as a vector may have one component only.
pub(in crate::mechanics) fn length(g: &mut Graph, square: Scalar) -> Scalar {
    if let ScalarNode::Product(factors) = g.node(square)
        && let [a, b] = factors[..]
        && a == b
    {
        return g.call(Call::Abs, &[a]);
    }
    g.sqrt(square)
}

/// A mask.
pub(in crate::mechanics) fn compare(g: &mut Graph, comparison: Comparison, a: Scalar, b: Scalar) -> Scalar {
    match comparison {
        Comparison::Less => g.call(Call::Less, &[a, b]),
        Comparison::LessEqual => g.call(Call::LessEqual, &[a, b]),
        Comparison::Greater => g.call(Call::Less, &[b, a]),
        Comparison::GreaterEqual => g.call(Call::LessEqual, &[b, a]),
        Comparison::Equal => g.call(Call::Equal, &[a, b]),
        Comparison::NotEqual => {
            let equal = g.call(Call::Equal, &[a, b]);
            g.call(Call::Not, &[equal])
        }
    }
}

impl Equations<'_> {
    /// A param or input in its declared shape, from its flattened scalars.
    pub(in crate::mechanics) fn shaped(&mut self, list: &[Scalar], ty: &Type) -> Value {
        match (ty, list) {
            (Type::Vec3, &[x, y, z]) => Value::Vector(self.g.vector([x, y, z])),
            (Type::Array(element, _), _) => {
                let width = element.scalars().max(1);
                Value::Array(list.chunks(width).map(|part| self.shaped(part, element)).collect())
            }
            (Type::Scalar, &[x]) => Value::Scalar(x),
            _ => raise("a symbol has as many scalars as its type"),
        }
    }
}
