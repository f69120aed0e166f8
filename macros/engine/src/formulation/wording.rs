//! Stage `formulation`: frames and directions as the user would write them.
//!
//! In: checked frames, and expressions of parameters in them. Out: text that means the same; nothing where there is none.

use crate::mechanics::loops::constraints::{body_name, parameter_name};
use crate::model::types::{BodyId, BodyRef, Expr, ExprNode, Frame, FrameStep, InstanceId, Model, ParamId};

/// Whose names are used: of a part its own, of the model all.
#[derive(Clone, Copy)]
pub(super) struct Wording<'m> {
    pub model: &'m Model,
    pub part: Option<InstanceId>,
}

impl Wording<'_> {
    pub(super) fn frame(self, frame: &Frame) -> Option<String> {
        let mut text = match frame.body {
            BodyRef::Ground if self.part.is_some() => return None,
            BodyRef::Ground => "ground".to_owned(),
            BodyRef::Body(body) => self.body(body)?,
        };
        for step in &frame.steps {
            text += &match step {
                FrameStep::At(place) => format!(".at({})", self.expression(place)?),
                FrameStep::Rotated(axis, angle) => {
                    format!(".rotated({}, {})", self.expression(axis)?, self.expression(angle)?)
                }
                FrameStep::Oriented(_) => return None,
            };
        }
        Some(text)
    }

    fn body(self, body: BodyId) -> Option<String> {
        let place = &self.model.bodies[body].place;
        match self.part {
            None => Some(body_name(self.model, body)),
            Some(part) => (place.instance == part).then(|| place.field.to_string()),
        }
    }

    pub(super) fn parameter(self, parameter: ParamId) -> Option<String> {
        let place = &self.model.params[parameter].place;
        match self.part {
            None => Some(parameter_name(self.model, parameter)),
            Some(part) => (place.instance == part).then(|| place.field.to_string()),
        }
    }

    pub(super) fn expression(self, expr: &Expr) -> Option<String> {
        self.bound(expr, Level::Sum)
    }

    /// In brackets where it binds less tightly than what it stands in.
    fn bound(self, expr: &Expr, least: Level) -> Option<String> {
        let pair = |a: &Expr, sign: &str, b: &Expr, own: Level, right: Level| {
            Some((format!("{} {sign} {}", self.bound(a, own)?, self.bound(b, right)?), own))
        };
        let (text, own) = match &*expr.node {
            ExprNode::Number(value) => (format!("{value:?}"), if *value < 0.0 { Level::Product } else { Level::Word }),
            ExprNode::Pi => ("PI".to_owned(), Level::Word),
            ExprNode::Param(of) => (self.parameter(*of)?, Level::Word),
            ExprNode::Vec3(list) => match axis(list) {
                Some(name) => (name.to_owned(), Level::Word),
                None => {
                    let list: Option<Vec<String>> = list.iter().map(|one| self.expression(one)).collect();
                    (format!("[{}]", list?.join(", ")), Level::Word)
                }
            },
            ExprNode::Neg(a) => (format!("-{}", self.bound(a, Level::Word)?), Level::Product),
            ExprNode::Add(a, b) => pair(a, "+", b, Level::Sum, Level::Product)?,
            ExprNode::Sub(a, b) => pair(a, "-", b, Level::Sum, Level::Product)?,
            ExprNode::Mul(a, b) => pair(a, "*", b, Level::Product, Level::Word)?,
            ExprNode::Div(a, b) => pair(a, "/", b, Level::Product, Level::Word)?,
            _ => return None,
        };
        Some(if own < least { format!("({text})") } else { text })
    }
}

/// How tightly text binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Sum,
    Product,
    Word,
}

/// A coordinate axis.
fn axis(components: &[Expr; 3]) -> Option<&'static str> {
    let is = |expr: &Expr, wanted: f64| matches!(&*expr.node, ExprNode::Number(value) if *value == wanted);
    let name = |(at, name): (usize, &'static str)| {
        (0..3).all(|k| is(&components[k], if k == at { 1.0 } else { 0.0 })).then_some(name)
    };
    ["X", "Y", "Z"].into_iter().enumerate().find_map(name)
}
