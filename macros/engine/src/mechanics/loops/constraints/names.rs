//! Stage `mechanics`: names of constraint equations.
//!
//! In: a closing and the number of one of its equations. Out: a name such as `legs[2].ball.x` or `hinge.turn_y`. `x` is
//! a way along an axis, `turn_x` an angle about one; axes count in the parent frame, turned so that a joint's axis is a
//! coordinate axis.

use crate::model::joint_kinds::Hold;
use crate::model::types::Constraint;
use crate::model::types::{
    BodyId, Coordinate, Directions, Expr, ExprNode, Joint, JointId, LoopClosure, Model, ParamId, Place,
};

const AXES: [&str; 3] = ["x", "y", "z"];

/// What is said of an equation that parameters don't make hold, by its name.
pub fn unfit(name: &str) -> String {
    format!("`{name}` does not hold with these parameters")
}

/// Name of an equation.
pub fn row_name(model: &Model, closing: LoopClosure, index: usize) -> String {
    match closing {
        LoopClosure::Constraint(id) => match &model.constraints[id] {
            Constraint { drive: Some(coordinate), .. } => format!("drive of {}", coordinate_name(model, *coordinate)),
            constraint => path(model, &constraint.place),
        },
        LoopClosure::Cut(id) => {
            let joint = &model.joints[id];
            format!("{}.{}", path(model, &joint.place), of_joint(joint)[index])
        }
    }
}

/// The equation of a closing that has a name; without one, the only one.
pub(in crate::mechanics) fn row_called(model: &Model, closing: LoopClosure, component: Option<&str>) -> Option<usize> {
    match (closing, component) {
        (LoopClosure::Constraint(_), None) => Some(0),
        (LoopClosure::Cut(id), Some(name)) => of_joint(&model.joints[id]).iter().position(|known| known == name),
        _ => None,
    }
}

/// Names of the equations of a joint that closes a loop.
pub(in crate::mechanics) fn rows_of_joint(model: &Model, id: JointId) -> Vec<String> {
    of_joint(&model.joints[id])
}

/// A coordinate as the user addresses it.
pub fn coordinate_name(model: &Model, coordinate: Coordinate) -> String {
    if let Some(speed) = model.speed(coordinate.joint) {
        return path(model, &speed.place);
    }
    path(model, &model.joints[coordinate.joint].place) + &of_coordinate(model, coordinate)
}

/// What closes a loop, as the user addresses it.
pub fn closing_name(model: &Model, closing: LoopClosure) -> String {
    path(model, place_of(model, closing))
}

/// Where what closes a loop stands.
pub fn place_of(model: &Model, closing: LoopClosure) -> &Place {
    match closing {
        LoopClosure::Cut(id) => &model.joints[id].place,
        LoopClosure::Constraint(id) => &model.constraints[id].place,
    }
}

/// A body as the user addresses it.
pub fn body_name(model: &Model, body: BodyId) -> String {
    path(model, &model.bodies[body].place)
}

/// A parameter as the user addresses it.
pub fn parameter_name(model: &Model, parameter: ParamId) -> String {
    path(model, &model.params[parameter].place)
}

/// The same inside the part in which the joint stands.
pub fn local_name(model: &Model, coordinate: Coordinate) -> String {
    format!("{}{}", model.joints[coordinate.joint].place.field, of_coordinate(model, coordinate))
}

/// `.first`, of joints of one coordinate nothing.
fn of_coordinate(model: &Model, coordinate: Coordinate) -> String {
    let kind = model.joints[coordinate.joint].kind;
    match kind.freedoms.get(coordinate.index) {
        Some(_) if kind.freedoms() == 1 => String::new(),
        Some(freedom) => format!(".{}", freedom.name),
        None => format!(".turn_{}", AXES[coordinate.index - kind.freedoms.len()]),
    }
}

/// A leaf as the user addresses it.
pub(in crate::mechanics) fn path(model: &Model, place: &Place) -> String {
    let mut parts = vec![place.field.to_string()];
    let mut instance = &model.instances[place.instance];
    while let Some(parent) = instance.parent {
        let index = instance.index.map_or(String::new(), |(index, _)| format!("[{index}]"));
        parts.push(format!("{}{index}", instance.field));
        instance = &model.instances[parent];
    }
    parts.reverse();
    parts.join(".")
}

fn of_joint(joint: &Joint) -> Vec<String> {
    let two = |axes: &[Expr; 2], otherwise| match axes.each_ref().map(written_axis) {
        [Some(one), Some(other)] if one != other => [one, other],
        _ => otherwise,
    };
    let axes = match &joint.directions {
        Directions::Axis(axis) => [0, 1, 2].map(|next| (coordinate_axis(axis) + next) % 3),
        Directions::Plane(axes) => {
            let [x, y] = two(axes, [0, 1]);
            [3 - x - y, x, y]
        }
        Directions::Slot(axes) => {
            let [axis, slide] = two(axes, [2, 0]);
            [axis, slide, 3 - axis - slide]
        }
        Directions::Frame | Directions::Crossed(_) => [0, 1, 2],
    };
    let across = |direction: usize| [1, 2].map(|next| (axes[direction % 3] + next) % 3);
    let turn = |k: usize| format!("turn_{}", AXES[k]);
    let names = joint.kind.holds.iter().flat_map(|hold| match *hold {
        Hold::Point => AXES.map(str::to_owned).to_vec(),
        Hold::Line(k) => across(k).map(|k| AXES[k].to_owned()).to_vec(),
        Hold::Plane(k) => vec![AXES[axes[k % 3]].to_owned()],
        // The child's axis moves towards one parent's axis by a turn about the other.
        Hold::Axis(k) => {
            let [a, b] = across(k);
            vec![turn(b), turn(a)]
        }
        Hold::Crossing => vec!["turn".to_owned()],
        // Axis k of the child against k + 1 of the parent: a turn about k + 2.
        Hold::Orientation => [2, 0, 1].map(turn).to_vec(),
        Hold::Pitch => vec!["pitch".to_owned()],
    });
    names.collect()
}

/// The coordinate axis behind a written axis; any other axis is turned into z.
fn coordinate_axis(axis: &Expr) -> usize {
    written_axis(axis).unwrap_or(2)
}

fn written_axis(axis: &Expr) -> Option<usize> {
    let mut expr = axis;
    while let ExprNode::Neg(inner) = &*expr.node {
        expr = inner;
    }
    let ExprNode::Vec3(components) = &*expr.node else { return None };
    let zero = |e: &Expr| matches!(&*e.node, ExprNode::Number(x) if *x == 0.0);
    let nonzero: Vec<usize> = (0..3).filter(|&k| !zero(&components[k])).collect();
    if let [k] = nonzero[..] { Some(k) } else { None }
}
