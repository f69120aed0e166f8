//! Stage `model`: angles and travels of joints that have no coordinates.
//!
//! In: a joint, where `formulation` gives all bodies absolute coordinates. Out: its angle, travel or rate from the frames
//! on both sides, so that friction or a spring on a joint is the same force whatever the coordinates. With `n` the axis in
//! the parent frame, `d` from the parent frame's origin to the child's and `u` across the axis:
//! travel `n . d`, its rate `n . (v_c - v_p - omega_p x d)`, rate of the angle `n . (omega_c - omega_p)`, and the angle
//! that from `u` to the `u` of the child, between minus and plus a half turn.

use proc_macro2::Span;
use syn::spanned::Spanned;

use crate::model::checker::Checker;
use crate::model::coordinates::Coordinates;
use crate::model::evaluate::dot;
use crate::model::expand::root;
use crate::model::fields::field;
use crate::model::names::Shape;
use crate::model::typed::{Typed, new_expr};
use crate::model::types::{Expr as Checked, ExprNode, Frame, FrameQuantity, FrameStep, Function, JointId, Order, Type};
use crate::syntax::tree::ItemKind;

/// What is measured along or about the axis.
#[derive(Clone, Copy)]
enum Motion {
    Slides,
    Turns,
}

impl<'a> Checker<'a, '_> {
    /// `Some(None)` if the joint has coordinates, or its motion is not one along or about an axis.
    pub(super) fn measured(&mut self, joint: JointId, index: usize, order: Order, at: Span) -> Option<Option<Typed>> {
        if !matches!(self.coordinates, Some(Coordinates::Absolute(_))) {
            return Some(None);
        }
        let motion = match (self.shape(joint)?, index) {
            (Shape::Revolute | Shape::Screw, 0) | (Shape::Cylindrical, 1) => Motion::Turns,
            (Shape::Prismatic | Shape::Cylindrical, 0) => Motion::Slides,
            _ => return Some(None),
        };
        let slot = self.joints.get(joint.0)?;
        let (item, context) = (slot.item, root(slot.scope));
        let ItemKind::Joint { fields, .. } = &item.kind else {
            return Some(None);
        };
        let Some(written) = field(fields, "axis") else {
            self.report.silent();
            return None;
        };
        let axis = self.axis(written, context)?;
        let [parent, child] = self.joint_frames(joint, written.span())?;
        let value = self.evaluator.vector(&axis.expr)?;
        let length = dot(value, value).sqrt();
        let m = Measure { at, parent: parent.frame, child: child.frame };
        let literal = matches!(&*axis.expr.node, ExprNode::Vec3(list) if list.iter().all(|c| matches!(&*c.node, ExprNode::Number(_))));
        let n = if literal {
            Typed::vector(value.map(|x| x / length), at).expr
        } else {
            m.node(ExprNode::Div(axis.expr.clone(), m.call(Function::Norm, &[&axis.expr])), Type::Vec3)
        };
        let expr = match (motion, order) {
            (Motion::Slides, Order::Position) => m.along(&n, &m.between(FrameQuantity::Position)),
            (Motion::Slides, _) => {
                let carried = m.call(
                    Function::Cross,
                    &[&m.of(&m.parent, FrameQuantity::AngularVelocity), &m.between(FrameQuantity::Position)],
                );
                m.along(&n, &m.sub(m.between(FrameQuantity::Velocity), carried))
            }
            (Motion::Turns, Order::Position) => {
                // The unit vector that is most across the axis.
                let sizes = value.map(f64::abs);
                let least = sizes.iter().copied().fold(f64::INFINITY, f64::min);
                let mut across = [0.0; 3];
                if let Some((slot, _)) = across.iter_mut().zip(sizes).find(|(_, size)| *size <= least) {
                    *slot = 1.0;
                }
                let w = m.call(Function::Cross, &[&n, &Typed::vector(across, at).expr]);
                let u = m.call(Function::Cross, &[&w, &n]);
                let mut tip = m.child.clone();
                tip.steps.push(FrameStep::At(u.clone()));
                let turned = m.sub(m.of(&tip, FrameQuantity::Position), m.of(&m.child, FrameQuantity::Position));
                m.call(Function::Atan2, &[&m.along(&w, &turned), &m.along(&u, &turned)])
            }
            (Motion::Turns, _) => m.along(&n, &m.between(FrameQuantity::AngularVelocity)),
        };
        // Deep enough for any of the above.
        Some(Some(Typed { expr, uses: axis.uses.clone(), depth: axis.depth.saturating_add(8) }))
    }
}

/// Makes nodes about two frames.
struct Measure {
    at: Span,
    parent: Frame,
    child: Frame,
}

impl Measure {
    fn node(&self, node: ExprNode, ty: Type) -> Checked {
        new_expr(node, ty, self.at)
    }

    fn of(&self, frame: &Frame, quantity: FrameQuantity) -> Checked {
        self.node(ExprNode::OfFrame(frame.clone(), quantity), Type::Vec3)
    }

    fn sub(&self, a: Checked, b: Checked) -> Checked {
        self.node(ExprNode::Sub(a, b), Type::Vec3)
    }

    /// Of the child less that of the parent, in world axes.
    fn between(&self, quantity: FrameQuantity) -> Checked {
        self.sub(self.of(&self.child, quantity), self.of(&self.parent, quantity))
    }

    /// The component of a world vector along one of the parent frame.
    fn along(&self, direction: &Checked, vector: &Checked) -> Checked {
        let express = ExprNode::Express { frame: self.parent.clone(), vector: vector.clone() };
        self.call(Function::Dot, &[direction, &self.node(express, Type::Vec3)])
    }

    fn call(&self, function: Function, arguments: &[&Checked]) -> Checked {
        let ty = if function == Function::Cross { Type::Vec3 } else { Type::Scalar };
        self.node(ExprNode::Call(function, arguments.iter().map(|e| (*e).clone()).collect()), ty)
    }
}
