//! Stage `mechanics`: names of constraint equations.
//!
//! In: a closing and the number of one of its equations. Out: a name such as `legs[2].ball.x` or `hinge.turn_y`. `x` is
//! a way along an axis, `turn_x` an angle about one; axes count in the parent frame, turned so that a joint's axis is a
//! coordinate axis.

use crate::mechanics::translate::symbols::has_quaternion;
use crate::model::types::{Closing, Coordinate, Expr, ExprNode, Joint, JointKind, Model, Place};

const AXES: [&str; 3] = ["x", "y", "z"];

/// What is said of an equation that parameters don't make hold, by its name.
pub fn unfit(name: &str) -> String {
    format!("`{name}` does not hold with these parameters")
}

/// Name of an equation.
pub fn row_name(model: &Model, closing: Closing, index: usize) -> String {
    match closing {
        Closing::Constraint(id) => model.constraints.get(id.0).map_or_else(String::new, |c| match c.drive {
            Some(coordinate) => format!("drive of {}", coordinate_name(model, coordinate)),
            None => path(model, &c.place),
        }),
        Closing::Cut(id) => model.joints.get(id.0).map_or_else(String::new, |joint| {
            let list = of_joint(joint);
            let suffix = list.get(index).map_or("", String::as_str);
            format!("{}.{suffix}", path(model, &joint.place))
        }),
    }
}

/// A coordinate as the user addresses it.
pub fn coordinate_name(model: &Model, coordinate: Coordinate) -> String {
    let Some(joint) = model.joints.get(coordinate.joint.0) else { return String::new() };
    let turns = has_quaternion(joint);
    let names: &[&str] = match &joint.kind {
        JointKind::Fixed | JointKind::Revolute { .. } | JointKind::Prismatic { .. } | JointKind::Screw { .. } => &[],
        JointKind::Cylindrical { .. } => &["travel", "angle"],
        JointKind::Universal { .. } => &["first", "second"],
        JointKind::Planar { .. } => &["x", "y", "angle"],
        JointKind::Ball(_) if turns => &["turn_x", "turn_y", "turn_z"],
        JointKind::Ball(_) => &["roll", "pitch", "yaw"],
        JointKind::Free(_) if turns => &["x", "y", "z", "turn_x", "turn_y", "turn_z"],
        JointKind::Free(_) => &["x", "y", "z", "roll", "pitch", "yaw"],
    };
    let suffix = names.get(coordinate.index).map_or(String::new(), |name| format!(".{name}"));
    path(model, &joint.place) + &suffix
}

/// A leaf as the user addresses it.
pub(in crate::mechanics) fn path(model: &Model, place: &Place) -> String {
    let mut parts = vec![place.field.to_string()];
    let mut at = model.instances.get(place.instance.0);
    while let Some(instance) = at {
        let Some(parent) = instance.parent else { break };
        let index = instance.index.map_or(String::new(), |(index, _)| format!("[{index}]"));
        parts.push(format!("{}{index}", instance.field));
        at = model.instances.get(parent.0);
    }
    parts.reverse();
    parts.join(".")
}

fn of_joint(joint: &Joint) -> Vec<String> {
    let all = |what: &'static str| AXES.into_iter().map(move |axis| format!("{what}{axis}"));
    let (gap, turns) = (|| all(""), || all("turn_"));
    let across = |axis: &Expr| {
        let k = coordinate_axis(axis);
        [(k + 1) % 3, (k + 2) % 3]
    };
    let along = |axis: &Expr| across(axis).map(|k| AXES[k].to_owned()).into_iter();
    // The child's axis moves towards one parent's axis by a turn about the other.
    let tilts = |axis: &Expr| {
        let [a, b] = across(axis);
        [b, a].map(|k| format!("turn_{}", AXES[k])).into_iter()
    };
    // Axis k of the child against k + 1 of the parent: a turn about k + 2.
    let orientation = || [2, 0, 1].into_iter().filter_map(move |k| turns().nth(k));
    match &joint.kind {
        JointKind::Free(_) => Vec::new(),
        JointKind::Ball(_) => gap().collect(),
        JointKind::Universal { .. } => gap().chain(["turn".to_owned()]).collect(),
        JointKind::Revolute { axis } => gap().chain(tilts(axis)).collect(),
        JointKind::Prismatic { axis } => along(axis).chain(orientation()).collect(),
        JointKind::Cylindrical { axis } => along(axis).chain(tilts(axis)).collect(),
        JointKind::Screw { axis, .. } => along(axis).chain(tilts(axis)).chain(["pitch".to_owned()]).collect(),
        JointKind::Planar { axis } => [AXES[coordinate_axis(axis)].to_owned()].into_iter().chain(tilts(axis)).collect(),
        JointKind::Fixed => gap().chain(orientation()).collect(),
    }
}

/// The coordinate axis behind a written axis; any other axis is turned into z.
fn coordinate_axis(axis: &Expr) -> usize {
    let mut expr = axis;
    while let ExprNode::Neg(inner) = &*expr.node {
        expr = inner;
    }
    let ExprNode::Vec3(components) = &*expr.node else { return 2 };
    let zero = |e: &Expr| matches!(&*e.node, ExprNode::Number(x) if *x == 0.0);
    let nonzero: Vec<usize> = (0..3).filter(|&k| !zero(&components[k])).collect();
    if let [k] = nonzero[..] { k } else { 2 }
}
