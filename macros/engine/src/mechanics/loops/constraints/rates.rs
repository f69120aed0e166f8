//! Stage `mechanics`: constraints of velocities, e(q, v, x, t) = A(q, x, t) v + b(q, x, t) = 0.
//!
//! In: an expression that is affine in velocities; states x of the user's own may stand in it, such as the angle of a wheel that somebody
//! steers, since their rates are known where accelerations are. Out: the row A on the tree, e itself and its rate. Whether e is the rate of
//! some function of positions makes no difference here (the report tells, by [`crate::mechanics::analysis`]): such an equation has no
//! residual of positions, so nothing that moves positions alone looks at it but by A, which says in which directions they may be moved.
//! Its multiplier does the virtual work -lambda A dq (d'Alembert and Lagrange: the directions are those of A dq = 0, also where b is not
//! zero), on the bodies whose velocities the expression reads ([`super::expression`]).

use std::collections::HashSet;
use std::rc::Rc;

use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::structure::Row;
use crate::model::site::{Site, Sited};
use crate::model::types::{
    ConstraintId, ConstraintKind, Coordinate, Expr, ExprNode, JointId, LoopClosure, Model, SolveHow, SystemQuantity,
};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::Scalar;

use super::{coordinate_name, row_name};

/// Whether an equation is one of velocities alone.
pub fn is_rate(model: &Model, row: Row) -> bool {
    let LoopClosure::Constraint(id) = row.closing else { return false };
    matches!(model.constraints[id].kind, ConstraintKind::Rate(_))
}

/// All equations of velocities, in source order.
pub fn rate_rows(model: &Model) -> Vec<Row> {
    let rows =
        (0..model.constraints.len()).map(|k| Row { closing: LoopClosure::Constraint(ConstraintId(k)), index: 0 });
    rows.filter(|&row| is_rate(model, row)).collect()
}

/// Velocity coordinates of the tree.
pub(in crate::mechanics) fn tree_coordinates(model: &Model) -> Vec<Coordinate> {
    let joints = (0..model.joints.len()).map(JointId).filter(|joint| !model.cuts.contains(joint));
    joints
        .flat_map(|joint| (0..model.joints[joint].kind.freedoms()).map(move |index| Coordinate { joint, index }))
        .collect()
}

/// Complaints about expressions that velocities do not enter linearly.
pub(in crate::mechanics) fn complaints(model: &Model) -> Vec<Complaint> {
    let rows = rate_rows(model);
    if rows.is_empty() && model.speeds.is_empty() {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    let mut complaints: Vec<Complaint> = rows.iter().filter_map(|&row| e.misfit(row)).collect();
    complaints.extend((0..model.speeds.len()).filter_map(|number| e.misfit_of_speed(number)));
    for solve in &model.solves {
        let SolveHow::From { closings, .. } = &solve.how else { continue };
        for closing in closings.iter().filter(|closing| rows.iter().any(|row| row.closing == closing.what)) {
            let message = "this is a constraint of velocities: no position follows from it".to_owned();
            complaints.push(Complaint { at: closing.site(), message, help: None });
        }
    }
    complaints
}

/// What an expression reads whose part in virtual work is not known.
fn unknown(value: &Expr) -> Option<(&Expr, String)> {
    let (mut stack, mut seen) = (vec![value], HashSet::new());
    while let Some(expr) = stack.pop() {
        if !seen.insert(Rc::as_ptr(&expr.node)) {
            continue;
        }
        let what = match &*expr.node {
            ExprNode::OfBodies(_, SystemQuantity::CentreOfMass | SystemQuantity::TotalMass) => continue,
            ExprNode::OfBodies(..) => "a velocity or momentum of several bodies",
            ExprNode::Kinetic => "the kinetic energy",
            _ => {
                stack.extend(expr.node.operands());
                continue;
            }
        };
        return Some((
            expr,
            format!(
                "a constraint of velocities can't read {what}: velocities of frames and rates of joints may stand here"
            ),
        ));
    }
    None
}

impl Equations<'_> {
    /// The expression of an equation of velocities, on the tree.
    pub(in crate::mechanics) fn rate_expression(&mut self, row: Row) -> Option<Scalar> {
        let LoopClosure::Constraint(id) = row.closing else { return None };
        let model = self.scene.model;
        let ConstraintKind::Rate(value) = &model.constraints[id].kind else { return None };
        Some(self.scalar(value))
    }

    /// A, by coordinate of the tree, without zeros.
    pub(in crate::mechanics) fn rate_slopes(&mut self, row: Row) -> Vec<(Coordinate, Scalar)> {
        let Some(rate) = self.rate_expression(row) else { return Vec::new() };
        self.slopes_by_velocity(rate)
    }

    /// Coefficients of velocities of the tree in what is affine in them, without zeros.
    pub(in crate::mechanics) fn slopes_by_velocity(&mut self, rate: Scalar) -> Vec<(Coordinate, Scalar)> {
        let mut slopes = Vec::new();
        for coordinate in tree_coordinates(self.scene.model) {
            let velocity = self.coordinate_symbols(coordinate)[1];
            let slope = self.g.derivative(rate, &[(velocity, Scalar::ONE)]);
            if slope != Scalar::ZERO {
                slopes.push((coordinate, slope));
            }
        }
        slopes
    }

    /// The rate of an equation, and the rate of that: of positions from their residual, with nothing put in for what follows
    /// from others; of velocities the expression itself and its derivative.
    pub(in crate::mechanics) fn row_rates(&mut self, row: Row) -> (Scalar, Scalar) {
        let Some(rate) = self.rate_expression(row) else {
            let residual = self.row(row);
            return self.implicit_rates(residual, &[], false);
        };
        let mut seeds = self.seeds(2);
        let read = self.g.read_by(&[rate], &self.scene.symbols.states);
        seeds.extend(self.seeds_of_states(&read));
        (rate, Differentiator::new(&seeds).scalar(&mut self.g, rate))
    }

    /// What is wrong with an expression of velocities.
    fn misfit(&mut self, row: Row) -> Option<Complaint> {
        let model = self.scene.model;
        let LoopClosure::Constraint(id) = row.closing else { return None };
        let constraint = &model.constraints[id];
        let ConstraintKind::Rate(value) = &constraint.kind else { return None };
        let name = format!("the constraint `{}`", row_name(model, row.closing, row.index));
        if let Some((at, message)) = unknown(value) {
            return Some(Complaint { at: at.site(), message, help: None });
        }
        if self.scalar(value) == Scalar::ZERO {
            return None;
        }
        let help = "wheels, blades and gears give equations that are linear in velocities";
        self.not_affine(value, &name, (constraint.site(), help))
    }

    /// What is wrong with a speed of the user's choice.
    pub(super) fn misfit_of_speed(&mut self, number: usize) -> Option<Complaint> {
        let model = self.scene.model;
        let speed = &model.speeds[number];
        let name = format!("the speed `{}`", coordinate_name(model, model.coordinate_of(number)));
        self.not_affine(
            &speed.value,
            &name,
            (speed.site(), "a speed is a sum of velocities times functions of positions"),
        )
    }

    /// Why an expression is not affine in velocities.
    fn not_affine(&mut self, value: &Expr, name: &str, (at, help): (Site, &str)) -> Option<Complaint> {
        let model = self.scene.model;
        let rate = self.scalar(value);
        let slopes = self.slopes_by_velocity(rate);
        let complaint =
            |message: String, help: Option<&str>| Some(Complaint { at, message, help: help.map(str::to_owned) });
        if slopes.is_empty() {
            return complaint(format!("{name} is of velocities, but none of them has a say in it"), None);
        }
        let coordinates = tree_coordinates(model);
        let velocities: Vec<(usize, Coordinate)> =
            coordinates.into_iter().map(|at| (self.coordinate_symbols(at)[1].index(), at)).collect();
        for &(coordinate, slope) in &slopes {
            let read: HashSet<usize> = self.g.reachable_scalars(&[slope]).into_iter().collect();
            let Some(&(_, other)) = velocities.iter().find(|(symbol, _)| read.contains(symbol)) else { continue };
            let of = |at| format!("`{}.rate`", coordinate_name(model, at));
            let message = format!(
                "{name} is not linear in velocities: what stands before {} holds {}",
                of(coordinate),
                of(other)
            );
            return complaint(message, Some(help));
        }
        // Functions in pieces have slopes of zero: what is left has to read no velocity either.
        let still = self.scene.symbols.velocities.concat().into_iter().map(|v| (v, Scalar::ZERO));
        let still = self.map(&still.collect::<Vec<_>>());
        let still = self.g.substitute(&[rate], &still)[0];
        let mut terms = vec![rate];
        for (coordinate, slope) in slopes {
            let velocity = self.coordinate_symbols(coordinate)[1];
            terms.push(-self.g.mul(slope, velocity));
        }
        let rest = self.g.sum(&terms);
        // Equal values are one node.
        if rest == still {
            return None;
        }
        let read: HashSet<usize> = self.g.reachable_scalars(&[rest]).into_iter().collect();
        let (_, other) = velocities.into_iter().find(|(symbol, _)| read.contains(symbol))?;
        let of = coordinate_name(model, other);
        complaint(
            format!("{name} is not linear in velocities: it reads `{of}.rate` in a function in pieces"),
            Some(help),
        )
    }
}
