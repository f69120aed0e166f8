//! Room `written`: symbols by the names that users gave them.
//!
//! In: symbols. Out: identifiers such as `legs[2].knee` with a dot for its rate, `anchor` with the index x.

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::mechanics::loops::constraints::{coordinate_name, path};
use crate::model::types::{Coordinate, JointId, Model, Place, Type};
use crate::symbolic::write::formula::{Class, Identifier};

const AXES: [&str; 3] = ["x", "y", "z"];

/// Name of a symbol.
pub(in crate::mechanics) fn identifier(model: &Model, symbol: Symbol) -> Identifier {
    let leaf = |place: &Place, ty: &Type, element: usize, class| {
        let (elements, index) = place_of(ty, element);
        Identifier { text: path(model, place) + &elements, dots: 0, index, class, typed: false }
    };
    match symbol {
        Symbol::Time => named("t".to_owned(), Class::Time),
        Symbol::Param { param, element } => {
            let param = &model.params[param];
            leaf(&param.place, &param.ty, element, Class::Parameter)
        }
        Symbol::Input { input, element } => {
            let input = &model.inputs[input];
            leaf(&input.place, &input.ty, element, Class::Input)
        }
        Symbol::State { state } => named(path(model, &model.states[state].place), Class::State),
        Symbol::Position { joint, component } => position(model, joint, component),
        Symbol::Velocity { joint, component } => motion(model, joint, component, 1),
        Symbol::Acceleration { joint, component } => motion(model, joint, component, 2),
        Symbol::Multiplier { row } => entry("lambda", format!("{}", row + 1), Class::Multiplier),
        Symbol::Impulse { joint, component } => of_coordinate("impulse", model, joint, component),
        Symbol::Momentum { joint, component } => of_coordinate("momentum", model, joint, component),
        Symbol::Alternative { component } => entry("alternative", format!("{}", component + 1), Class::Defined),
        Symbol::Rate { row } => entry("rate", format!("{}", row + 1), Class::Rate),
        Symbol::Guess { index } => entry("guess", format!("{}", index + 1), Class::Defined),
        Symbol::UnknownPoint { index, component } => {
            entry("unknown", format!("{}, {}", index + 1, ["cos", "sin"][component]), Class::Defined)
        }
        Symbol::Unknown { index } => entry("unknown", format!("{}", index + 1), Class::Defined),
        Symbol::Number { index } => entry("number", format!("{}", index + 1), Class::Defined),
    }
}

/// Name of a function of the user's own Rust, with a stroke and the name of an argument where it is its slope by that.
pub(super) fn external(model: &Model, call: Call) -> Identifier {
    let id = call.external().or_fault("only functions of Rust have names of users");
    let function = &model.externals[id];
    let name = named(function.name.to_string(), Class::Defined);
    match call {
        Call::ExternalSlope(_, argument) => Identifier {
            text: format!("{}'", name.text),
            index: function.arguments.get(argument).map(ToString::to_string),
            ..name
        },
        _ => name,
    }
}

/// A matrix or a list with an index.
pub(super) fn entry(text: &str, index: String, class: Class) -> Identifier {
    Identifier { text: text.to_owned(), dots: 0, index: Some(index), class, typed: false }
}

fn named(text: String, class: Class) -> Identifier {
    Identifier { text, dots: 0, index: None, class, typed: false }
}

fn of_coordinate(what: &str, model: &Model, joint: JointId, index: usize) -> Identifier {
    entry(what, coordinate_name(model, Coordinate { joint, index }), Class::Rate)
}

/// `[2]` behind the name of an array, and the component of a vector.
fn place_of(ty: &Type, element: usize) -> (String, Option<String>) {
    match ty {
        Type::Vec3 => (String::new(), AXES.get(element).map(|axis| (*axis).to_owned())),
        Type::Array(inner, _) => {
            let width = inner.scalars().max(1);
            let (rest, index) = place_of(inner, element % width);
            (format!("[{}]{rest}", element / width), index)
        }
        _ => (String::new(), None),
    }
}

fn position(model: &Model, joint: JointId, component: usize) -> Identifier {
    let kind = model.joints[joint].kind;
    let quaternion = component.checked_sub(kind.turning().start).filter(|_| kind.has_quaternion());
    match quaternion.and_then(|k| ["w", "i", "j", "k"].get(k)) {
        Some(name) => {
            let text = path(model, &model.joints[joint].place);
            Identifier { text, dots: 0, index: Some((*name).to_owned()), class: Class::Position, typed: false }
        }
        None => named(coordinate_name(model, Coordinate { joint, index: component }), Class::Position),
    }
}

fn motion(model: &Model, joint: JointId, component: usize, order: u8) -> Identifier {
    if let Some(speed) = model.speed(joint) {
        let class = if order == 1 { Class::Rate } else { Class::Acceleration };
        return Identifier { dots: order - 1, ..named(path(model, &speed.place), class) };
    }
    let kind = model.joints[joint].kind;
    let class = if order == 1 { Class::Rate } else { Class::Acceleration };
    let turning = component.checked_sub(kind.turning().start).filter(|_| kind.has_quaternion());
    match turning.and_then(|k| AXES.get(k)) {
        // An angular velocity is no rate of anything: omega of the joint, along the child's axes.
        Some(axis) => Identifier {
            text: format!("{}.omega", path(model, &model.joints[joint].place)),
            dots: order - 1,
            index: Some((*axis).to_owned()),
            class,
            typed: false,
        },
        None => Identifier {
            text: coordinate_name(model, Coordinate { joint, index: component }),
            dots: order,
            index: None,
            class,
            typed: false,
        },
    }
}
