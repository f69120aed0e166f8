//! Stage `model`: formulas and closed forms of coordinates that are tried for the user to see what they bring.
//!
//! In: coordinates with what they are, or with what closes their loop. Out: the model with them, as `solve` items of the user's.

use proc_macro2::Span;

use super::types::{
    Closing, Comparison, Coordinate, Expr, ExprNode, Frame, FrameQuantity, Function, LoopClosure, Model, Order,
    ParamId, Solve, SolveHow, Type,
};

/// What a coordinate is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formula {
    Number(f64),
    Same(Coordinate),
    Opposite(Coordinate),
}

/// What is found from closings, on the branch where all these conditions hold.
#[derive(Clone)]
pub struct ClosedForm {
    pub unknowns: Vec<Coordinate>,
    pub closings: Vec<LoopClosure>,
    pub sides: Vec<Side>,
    pub place: Option<Placed>,
}

/// Where something lies, as it is asked where no coordinate tells.
#[derive(Clone)]
pub enum Placed {
    Beyond(Beyond),
    Beside(Beside),
}

/// On which side of the plane of three points another one lies, from which rods lead to them: there two solutions meet.
#[derive(Clone)]
pub struct Beside {
    /// The ends of each rod, the one on what is moved last.
    pub rods: [[Frame; 2]; 3],
    pub is_above: bool,
}

impl Placed {
    /// The same condition or its opposite.
    pub fn turned(self, is_above: bool) -> Placed {
        match self {
            Placed::Beyond(beyond) => Placed::Beyond(Beyond { is_above, ..beyond }),
            Placed::Beside(beside) => Placed::Beside(Beside { is_above, ..beside }),
        }
    }

    fn condition(&self, span: Span) -> Expr {
        match self {
            Placed::Beyond(beyond) => beyond.condition(span),
            Placed::Beside(beside) => beside.condition(span),
        }
    }
}

impl Beside {
    /// As it stands between the braces of a `solve`, by the texts of the ends.
    pub fn text(&self, rods: &[[String; 2]; 3]) -> String {
        let sign = if self.is_above { '>' } else { '<' };
        let [a, b, c] = [0, 1, 2].map(|k| format!("{}.position - {}.position", rods[k][1], rods[k][0]));
        format!("dot(cross({a}, {b}), {c}) {sign} 0.0")
    }

    fn condition(&self, span: Span) -> Expr {
        let vector = |node: ExprNode| Expr::new(node, Type::Vec3, span);
        let position = |frame: &Frame| vector(ExprNode::OfFrame(frame.clone(), FrameQuantity::Position));
        let way = |rod: &[Frame; 2]| vector(ExprNode::Sub(position(&rod[1]), position(&rod[0])));
        let [a, b, c] = [0, 1, 2].map(|k| way(&self.rods[k]));
        let normal = vector(ExprNode::Call(Function::Cross, vec![a, b]));
        signed(ExprNode::Call(Function::Dot, vec![normal, c]), self.is_above, span)
    }
}

/// Above or below zero.
fn signed(value: ExprNode, is_above: bool, span: Span) -> Expr {
    let scalar = |node: ExprNode| Expr::new(node, Type::Scalar, span);
    let comparison = if is_above { Comparison::Greater } else { Comparison::Less };
    let (value, zero) = (scalar(value), scalar(ExprNode::Number(0.0)));
    Expr::new(ExprNode::Compare(comparison, value, zero), Type::Bool, span)
}

/// On which side of a hinge's arm something lies that a rod from the arm's end leads to: on the plane through the hinge's axis and that
/// end the two solutions of the hinge's angle meet.
#[derive(Clone)]
pub struct Beyond {
    /// Of the joint, on the body that it carries.
    pub hinge: Frame,
    /// Its direction there.
    pub axis: Expr,
    /// The rod's ends: on the arm, and the other one.
    pub near: Frame,
    pub far: Frame,
    pub is_above: bool,
}

impl Beyond {
    /// As it stands between the braces of a `solve`.
    pub fn text(&self, [hinge, axis, near, far]: &[String; 4]) -> String {
        let sign = if self.is_above { '>' } else { '<' };
        let from = |end: &str| format!("{hinge}.express({end}.position - {hinge}.position)");
        format!("dot({axis}, cross({}, {})) {sign} 0.0", from(near), from(far))
    }

    fn condition(&self, span: Span) -> Expr {
        let vector = |node: ExprNode| Expr::new(node, Type::Vec3, span);
        let position = |frame: &Frame| vector(ExprNode::OfFrame(frame.clone(), FrameQuantity::Position));
        let from = |end: &Frame| {
            let way = vector(ExprNode::Sub(position(end), position(&self.hinge)));
            vector(ExprNode::Express { frame: self.hinge.clone(), vector: way })
        };
        let normal = vector(ExprNode::Call(Function::Cross, vec![from(&self.near), from(&self.far)]));
        signed(ExprNode::Call(Function::Dot, vec![self.axis.clone(), normal]), self.is_above, span)
    }
}

/// A condition that tells solutions of a loop apart: of a sum of angles, or of a length.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    pub measure: Measure,
    /// Those that are subtracted are marked; the first is not.
    pub terms: Vec<(Coordinate, bool)>,
    /// Where the sum counts from.
    pub from: Origin,
    pub is_above: bool,
}

/// What has the sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    Sine,
    Cosine,
    Travel,
}

/// Where something counts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    Number(f64),
    /// A scalar parameter, or what is minus that.
    Parameter {
        of: ParamId,
        is_negative: bool,
    },
}

impl Side {
    /// As it stands between the braces of a `solve`; the parameter is named where it counts from one.
    pub fn text(&self, name: impl Fn(Coordinate) -> String, parameter: &str) -> String {
        let mut sum = String::new();
        for &(coordinate, is_subtracted) in &self.terms {
            match (sum.is_empty(), is_subtracted) {
                (true, _) => {}
                (false, true) => sum += " - ",
                (false, false) => sum += " + ",
            }
            sum += &name(coordinate);
        }
        let sign = if self.is_above { '>' } else { '<' };
        let from = match self.from {
            Origin::Number(value) => format!("{value:?}"),
            Origin::Parameter { is_negative, .. } => format!("{}{parameter}", if is_negative { "-" } else { "" }),
        };
        let word = match self.measure {
            Measure::Travel => return format!("{sum} {sign} {from}"),
            Measure::Sine => "sin",
            Measure::Cosine => "cos",
        };
        let shifted = match self.from {
            Origin::Number(0.0) => sum,
            Origin::Number(value) if value < 0.0 => format!("{sum} + {:?}", -value),
            Origin::Number(_) | Origin::Parameter { .. } => format!("{sum} - {from}"),
        };
        format!("{word}({shifted}) {sign} 0.0")
    }

    fn condition(&self, span: Span) -> Expr {
        let scalar = |node: ExprNode| Expr::new(node, Type::Scalar, span);
        let position = |Coordinate { joint, index }: Coordinate| {
            scalar(ExprNode::Coordinate { joint, index, order: Order::Position })
        };
        let sum = self.terms.iter().fold(None, |sum: Option<Expr>, &(coordinate, is_subtracted)| {
            let value = position(coordinate);
            Some(match (sum, is_subtracted) {
                (None, _) => value,
                (Some(sum), true) => scalar(ExprNode::Sub(sum, value)),
                (Some(sum), false) => scalar(ExprNode::Add(sum, value)),
            })
        });
        let sum = sum.unwrap_or_else(|| scalar(ExprNode::Number(0.0)));
        let from = match self.from {
            Origin::Number(value) => scalar(ExprNode::Number(value)),
            Origin::Parameter { of, is_negative: false } => scalar(ExprNode::Param(of)),
            Origin::Parameter { of, is_negative: true } => scalar(ExprNode::Neg(scalar(ExprNode::Param(of)))),
        };
        let (value, bound) = match self.measure {
            Measure::Travel => (sum, from),
            Measure::Sine | Measure::Cosine => {
                let function = if self.measure == Measure::Sine { Function::Sin } else { Function::Cos };
                let angle = match self.from {
                    Origin::Number(0.0) => sum,
                    _ => scalar(ExprNode::Sub(sum, from)),
                };
                (scalar(ExprNode::Call(function, vec![angle])), scalar(ExprNode::Number(0.0)))
            }
        };
        let comparison = if self.is_above { Comparison::Greater } else { Comparison::Less };
        Expr::new(ExprNode::Compare(comparison, value, bound), Type::Bool, span)
    }
}

impl Model {
    /// The same with loops closed by closed forms.
    pub fn closing(&self, forms: &[ClosedForm]) -> Model {
        let mut model = self.clone();
        for form in forms {
            let Some(first) = form.unknowns.first() else { continue };
            let span = model.joints[first.joint].span;
            let place = form.place.iter().map(|place| place.condition(span));
            let branches = form.sides.iter().map(|side| side.condition(span)).chain(place).collect();
            let closings = form.closings.iter().map(|&what| Closing { what, span }).collect();
            let how = SolveHow::From { closings, branches };
            model.solves.push(Solve { unknowns: form.unknowns.clone(), how, span });
        }
        model
    }

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
