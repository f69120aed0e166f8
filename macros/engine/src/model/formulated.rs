//! Stage `model`: formulas of coordinates that are tried for the user to see what they bring.
//!
//! In: coordinates with what they are. Out: the model with them, as `solve` items of the user's.

use super::types::{Coordinate, Expr, ExprNode, Model, Order, Solve, SolveHow, Type};

/// What a coordinate is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formula {
    Number(f64),
    Same(Coordinate),
    Opposite(Coordinate),
}

impl Model {
    /// The same with formulas for coordinates.
    pub fn solving(&self, items: &[Vec<(Coordinate, Formula)>]) -> Model {
        let mut model = self.clone();
        for item in items {
            let Some(first) = item.first() else { continue };
            let span = model.joints[first.0.joint].span;
            let scalar = |node: ExprNode| Expr::new(node, Type::Scalar, span);
            let position = |Coordinate { joint, index }: Coordinate| {
                scalar(ExprNode::Coordinate { joint, index, order: Order::Position })
            };
            let value = |formula: Formula| match formula {
                Formula::Number(value) => scalar(ExprNode::Number(value)),
                Formula::Same(other) => position(other),
                Formula::Opposite(other) => scalar(ExprNode::Neg(position(other))),
            };
            let (unknowns, formulas) = item.iter().map(|&(unknown, formula)| (unknown, value(formula))).unzip();
            model.solves.push(Solve { unknowns, how: SolveHow::Formulas(formulas), span });
        }
        model
    }
}
