//! Stage `mechanics`: readable names for generated code, in snake case.
//!
//! In: places in the generated structs. Out: names of links, such as `legs_2_gimbal`, and of symbols, such as `elbow`,
//! `elbow_rate`, `feet_0_x`.

use crate::contracts::symbol::Symbol;
use crate::model::joint_kinds::JointKind;
use crate::model::types::{Coordinate, JointId, Model, Place, Type};

const AXES: [&str; 3] = ["x", "y", "z"];

/// A leaf's name with the part instances that it stands in.
pub(in crate::mechanics) fn path(model: &Model, place: &Place) -> String {
    let mut parts = vec![plain(&place.field.to_string())];
    let mut instance = &model.instances[place.instance];
    while let Some(parent) = instance.parent {
        let index = instance.index.map_or(String::new(), |(index, _)| format!("_{index}"));
        parts.push(format!("{}{index}", plain(&instance.field.to_string())));
        instance = &model.instances[parent];
    }
    parts.reverse();
    parts.join("_")
}

fn plain(name: &str) -> String {
    name.strip_prefix("r#").unwrap_or(name).to_lowercase()
}

/// Name of a symbol.
pub(in crate::mechanics) fn symbol(model: &Model, symbol: Symbol) -> String {
    match symbol {
        Symbol::Time => "t".to_owned(),
        Symbol::Param { param, element } => {
            let param = &model.params[param];
            path(model, &param.place) + &suffix(&param.ty, element)
        }
        Symbol::Input { input, element } => {
            let input = &model.inputs[input];
            path(model, &input.place) + &suffix(&input.ty, element)
        }
        Symbol::State { state } => path(model, &model.states[state].place),
        Symbol::Position { joint, component } => of_joint(model, joint, |kind| position(kind, component)),
        Symbol::Velocity { joint, component } => of_velocity(model, joint, component, "rate"),
        Symbol::Acceleration { joint, component } => of_velocity(model, joint, component, "accel"),
        Symbol::Impulse { joint, component } => of_velocity(model, joint, component, "impulse"),
        Symbol::Momentum { joint, component } => of_velocity(model, joint, component, "momentum"),
        Symbol::Alternative { component } => {
            ["cos_alternative", "sin_alternative", "side_1", "side_2", "side_3"][component].to_owned()
        }
        Symbol::Rate { row } => format!("rate_{row}"),
        Symbol::Multiplier { row } => format!("multiplier_{row}"),
        Symbol::Guess { index } => format!("guess_{index}"),
        Symbol::Unknown { index } => format!("unknown_{index}"),
        Symbol::UnknownPoint { index, component } => format!("unknown_{index}_{}", ["cos", "sin"][component]),
        Symbol::Number { index } => format!("number_{index}"),
    }
}

/// Name of what belongs to a velocity coordinate.
pub(in crate::mechanics) fn of_freedom(model: &Model, coordinate: Coordinate, what: &str) -> String {
    of_velocity(model, coordinate.joint, coordinate.index, what)
}

/// The same by joint and component; of a speed of the user's choice the rate is the speed itself.
fn of_velocity(model: &Model, joint: JointId, component: usize, what: &str) -> String {
    match model.speed(joint) {
        Some(speed) if what == "rate" => path(model, &speed.place),
        Some(speed) => format!("{}_{what}", path(model, &speed.place)),
        None => of_joint(model, joint, |kind| rate(kind, component, what)),
    }
}

fn of_joint(model: &Model, joint: JointId, suffix: impl Fn(&JointKind) -> String) -> String {
    let joint = &model.joints[joint];
    path(model, &joint.place) + &suffix(joint.kind)
}

/// `_2_x` for an element of an array of `Vec3`.
fn suffix(ty: &Type, element: usize) -> String {
    match ty {
        Type::Vec3 => format!("_{}", AXES[element]),
        Type::Array(inner, _) => {
            let width = inner.scalars().max(1);
            format!("_{}{}", element / width, suffix(inner, element % width))
        }
        _ => String::new(),
    }
}

/// `_first` and the like; nothing for joints of one coordinate.
fn coordinate(kind: &JointKind, index: usize) -> String {
    let name = kind.freedoms.get(index).filter(|_| kind.freedoms() > 1);
    name.map_or(String::new(), |freedom| format!("_{}", freedom.name))
}

/// The number among those of a quaternion, of a component or a turning direction.
fn of_quaternion(kind: &JointKind, component: usize) -> Option<usize> {
    component.checked_sub(kind.turning().start).filter(|_| kind.has_quaternion())
}

fn position(kind: &JointKind, component: usize) -> String {
    match of_quaternion(kind, component).and_then(|k| ["w", "i", "j", "k"].get(k)) {
        Some(name) => format!("_{name}"),
        None => coordinate(kind, component),
    }
}

fn rate(kind: &JointKind, component: usize, what: &str) -> String {
    match of_quaternion(kind, component).and_then(|k| AXES.get(k)) {
        Some(axis) => format!("_angular_{what}_{axis}"),
        None => format!("{}_{what}", coordinate(kind, component)),
    }
}
