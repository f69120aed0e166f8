//! Stage `verify`: outputs of one frame against each other.
//!
//! In: positions, velocities and Jacobians that a model shows. Out: whether each is the rate, or the slope, of the other.

use std::ops::Range;
use std::rc::Rc;

use crate::contracts::function::FunctionKind;
use crate::contracts::symbol::Symbol;
use crate::model::types::{BodyRef, Expr, ExprNode, Frame, FrameQuantity, FrameStep, Model, Output, Type};
use crate::symbolic::doubled::Doubled;

use super::{At, Judged, Law, Sum, judged};

pub(super) const LAWS: &[Law] = &[
    Law { between: "positions and velocities of outputs", judge: |at| at.velocities_of_frames() },
    Law { between: "Jacobians and velocities of outputs", judge: |at| at.jacobians() },
    Law { between: "outputs and their groups", judge: |at| at.groups() },
];

/// Outputs of frames with the place of their first number.
pub(super) struct Shown<'m> {
    pub(super) quantities: Vec<(usize, &'m Frame, FrameQuantity)>,
    /// In world axes.
    jacobians: Vec<(usize, &'m Frame)>,
}

impl<'m> Shown<'m> {
    pub(super) fn new(model: &'m Model, freedoms: usize) -> Shown<'m> {
        let mut shown = Shown { quantities: Vec::new(), jacobians: Vec::new() };
        let mut place = 0;
        for output in &model.outputs {
            match &*output.value.node {
                ExprNode::OfFrame(frame, quantity) => shown.quantities.push((place, frame, *quantity)),
                ExprNode::Jacobian { frame, axes } if axes.body == BodyRef::Ground && axes.steps.is_empty() => {
                    shown.jacobians.push((place, frame));
                }
                _ => {}
            }
            place += width(&output.value.ty, freedoms);
        }
        shown
    }
}

/// By output where its numbers are among those of all.
fn places(model: &Model, freedoms: usize) -> Vec<Range<usize>> {
    let mut next = 0;
    let place = |output: &Output| {
        let first = next;
        next += width(&output.value.ty, freedoms);
        first..next
    };
    model.outputs.iter().map(place).collect()
}

/// Numbers of one output.
fn width(ty: &Type, freedoms: usize) -> usize {
    match ty {
        Type::Scalar | Type::Bool => 1,
        Type::Vec3 => 3,
        Type::Rotation => 9,
        Type::Pose => 7,
        Type::Twist | Type::Wrench => 6,
        Type::Jacobian => 6 * freedoms,
        Type::Array(element, count) => count * width(element, freedoms),
    }
}

impl At<'_, '_> {
    /// A group has the numbers of its outputs.
    fn groups(&mut self) -> Judged {
        let (outputs, model) = (FunctionKind::Outputs, self.laws.model);
        let places = places(model, self.dof());
        for (number, group) in model.output_groups.iter().enumerate() {
            let kind = FunctionKind::OutputGroup(number);
            if !self.has(kind) || !self.has(outputs) {
                continue;
            }
            let (own, all) = (self.values(kind)?, self.values(outputs)?);
            let weights = self.weights(own.len());
            let mut of_all = vec![0.0; all.len()];
            let mut sum = Sum::default();
            let taken = group.outputs().flat_map(|output| places[output].clone());
            for ((place, &value), &weight) in taken.zip(&own).zip(&weights) {
                sum.product(&[value, Doubled::new(weight)]);
                sum.product(&[-all[place], Doubled::new(weight)]);
                of_all[place] = -weight;
            }
            if sum.holds() != Some(true) {
                sum.bound = self.bound(kind, &weights) + self.bound(outputs, &of_all);
            }
            match judged(&sum, kind, outputs) {
                Some(None) => {}
                other => return other,
            }
        }
        Some(None)
    }

    /// Slopes of a position times velocities are its velocity.
    fn velocities_of_frames(&mut self) -> Judged {
        let outputs = FunctionKind::Outputs;
        let shown = Shown::new(self.laws.model, self.dof());
        if !self.has(outputs) || !self.is_moved() {
            return Some(None);
        }
        let values = self.values(outputs)?;
        let (mut sum, mut any) = (Sum::default(), false);
        let (mut of_positions, mut of_velocities) = (vec![0.0; values.len()], vec![0.0; values.len()]);
        for &(position, frame, _) in shown.quantities.iter().filter(|q| q.2 == FrameQuantity::Position) {
            let speed = |q: &&(usize, &Frame, FrameQuantity)| {
                matches!(q.2, FrameQuantity::Velocity | FrameQuantity::Twist) && is_same(q.1, frame)
            };
            let Some(&(velocity, ..)) = shown.quantities.iter().find(speed) else { continue };
            any = true;
            for (k, weight) in self.weights(3).into_iter().enumerate() {
                sum.product(&[values[velocity + k], Doubled::new(weight)]);
                of_positions[position + k] = weight;
                of_velocities[velocity + k] = weight;
            }
        }
        if !any {
            return Some(None);
        }
        let (symbols, moved) = (self.symbols(), self.moved()?);
        let slopes = self.trace(outputs)?.slopes::<Doubled>(&of_positions, symbols);
        self.displacements(&slopes).iter().zip(&moved).for_each(|(&x, &v)| sum.product(&[-x, v]));
        sum.add(-self.slope(&slopes, Symbol::Time));
        if sum.holds() != Some(true) {
            sum.bound = slopes.bound + self.bound(outputs, &of_velocities);
        }
        judged(&sum, outputs, outputs)
    }

    /// A Jacobian times velocities is the velocity, and times displacements what positions are displaced by.
    fn jacobians(&mut self) -> Judged {
        let outputs = FunctionKind::Outputs;
        let n = self.dof();
        let shown = Shown::new(self.laws.model, n);
        if shown.jacobians.is_empty()
            || !self.has(outputs)
            || !self.is_moved()
            || !self.is_scleronomic(&[outputs, FunctionKind::PositionRates])
        {
            return Some(None);
        }
        let (values, v) = (self.values(outputs)?, self.velocities());
        let (mut sum, mut any, mut positions) = (Sum::default(), false, false);
        let (mut weights, mut of_positions) = (vec![0.0; values.len()], vec![0.0; values.len()]);
        for &(jacobian, frame) in &shown.jacobians {
            for &(place, _, quantity) in shown.quantities.iter().filter(|q| is_same(q.1, frame)) {
                let (first, count) = match quantity {
                    FrameQuantity::Position | FrameQuantity::Velocity => (0, 3),
                    FrameQuantity::AngularVelocity => (3, 3),
                    FrameQuantity::Twist => (0, 6),
                    _ => continue,
                };
                any = true;
                positions |= quantity == FrameQuantity::Position;
                for (k, weight) in self.weights(count).into_iter().enumerate() {
                    for (column, &v) in v.iter().enumerate() {
                        let at = jacobian + (first + k) * n + column;
                        sum.product(&[values[at], v, Doubled::new(weight)]);
                        weights[at] += v.high * weight;
                    }
                    if quantity == FrameQuantity::Position {
                        of_positions[place + k] += weight;
                    } else {
                        sum.product(&[-values[place + k], Doubled::new(weight)]);
                        weights[place + k] -= weight;
                    }
                }
            }
        }
        if !any {
            return Some(None);
        }
        if positions {
            let (symbols, moved) = (self.symbols(), self.moved()?);
            let slopes = self.trace(outputs)?.slopes::<Doubled>(&of_positions, symbols);
            self.displacements(&slopes).iter().zip(&moved).for_each(|(&x, &v)| sum.product(&[-x, v]));
            sum.bound += slopes.bound;
        }
        sum.bound += self.bound(outputs, &weights);
        judged(&sum, outputs, outputs)
    }
}

/// Whether two frames are written alike.
fn is_same(a: &Frame, b: &Frame) -> bool {
    let step = |(a, b): (&FrameStep, &FrameStep)| match (a, b) {
        (FrameStep::At(a), FrameStep::At(b)) => is_alike(a, b),
        (FrameStep::Rotated(axis, angle), FrameStep::Rotated(other, turn)) => {
            is_alike(axis, other) && is_alike(angle, turn)
        }
        _ => false,
    };
    a.body == b.body && a.steps.len() == b.steps.len() && a.steps.iter().zip(&b.steps).all(step)
}

fn is_alike(a: &Expr, b: &Expr) -> bool {
    if Rc::ptr_eq(&a.node, &b.node) {
        return true;
    }
    match (&*a.node, &*b.node) {
        (ExprNode::Number(a), ExprNode::Number(b)) => a == b,
        (ExprNode::Pi, ExprNode::Pi) => true,
        (ExprNode::Param(a), ExprNode::Param(b)) => a == b,
        (ExprNode::Vec3(a), ExprNode::Vec3(b)) => a.iter().zip(b).all(|(a, b)| is_alike(a, b)),
        (ExprNode::Neg(a), ExprNode::Neg(b)) => is_alike(a, b),
        (ExprNode::Index(a, i), ExprNode::Index(b, j)) | (ExprNode::Component(a, i), ExprNode::Component(b, j)) => {
            i == j && is_alike(a, b)
        }
        (ExprNode::Add(a, b), ExprNode::Add(c, d))
        | (ExprNode::Sub(a, b), ExprNode::Sub(c, d))
        | (ExprNode::Mul(a, b), ExprNode::Mul(c, d))
        | (ExprNode::Div(a, b), ExprNode::Div(c, d)) => is_alike(a, c) && is_alike(b, d),
        _ => false,
    }
}
