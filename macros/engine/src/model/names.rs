//! Stage `model`: which names are taken by the language, and the tables of names that it offers.
//!
//! In: names. Out: whether a user may have them, and why not.

use syn::Expr;

use crate::rust_keywords::is_keyword;
use crate::syntax::tree::Fields;

use super::types::{Function, JointKind, Orientation};

/// Constants, the world frame, and time: values that every expression may name.
pub(super) const VALUES: [&str; 6] = ["ground", "X", "Y", "Z", "PI", "t"];

/// Functions by name, with the number of their arguments.
pub(super) const FUNCTIONS: [(&str, Function, usize); 24] = [
    ("sin", Function::Sin, 1),
    ("cos", Function::Cos, 1),
    ("tan", Function::Tan, 1),
    ("asin", Function::Asin, 1),
    ("acos", Function::Acos, 1),
    ("atan", Function::Atan, 1),
    ("atan2", Function::Atan2, 2),
    ("sinh", Function::Sinh, 1),
    ("cosh", Function::Cosh, 1),
    ("tanh", Function::Tanh, 1),
    ("exp", Function::Exp, 1),
    ("ln", Function::Ln, 1),
    ("sqrt", Function::Sqrt, 1),
    ("abs", Function::Abs, 1),
    ("signum", Function::Signum, 1),
    ("min", Function::Min, 2),
    ("max", Function::Max, 2),
    ("hypot", Function::Hypot, 2),
    ("powi", Function::Powi, 2),
    ("powf", Function::Powf, 2),
    ("deg", Function::Deg, 1),
    ("dot", Function::Dot, 2),
    ("cross", Function::Cross, 2),
    ("norm", Function::Norm, 1),
];

/// Functions that are no [`Function`].
pub(super) const SPECIAL_FUNCTIONS: [&str; 3] = ["select", "kinetic", "potential"];

/// Functions that make rotations and poses. Their names stay free for items: a call is never mistaken for one.
pub(super) const CONSTRUCTORS: [&str; 4] = ["identity", "rotation", "roll_pitch_yaw", "pose"];

/// Types that a user may name.
pub(super) const TYPES: [&str; 7] = ["Scalar", "Vec3", "Pose", "Rotation", "Twist", "Wrench", "Jacobian"];

/// Structs and constants of a generated module.
const GENERATED: [&str; 19] = [
    "Params",
    "Position",
    "Velocity",
    "State",
    "States",
    "Derivative",
    "Closed",
    "Solved",
    "Jump",
    "Input",
    "Output",
    "Model",
    "DOF",
    "COSTS",
    "DERIVED",
    "COORDINATES",
    "CONSTRAINTS",
    "EQUATIONS",
    "JACOBIAN",
];

/// What generated code names without a path: a part of this name would stand in its way.
const IN_SCOPE: [&str; 14] =
    ["T", "F", "A", "Real", "Default", "From", "FnMut", "Clone", "Copy", "Debug", "PartialEq", "Result", "Ok", "Err"];

/// Why an item can't have this name.
pub(super) fn refusal(name: &str) -> Option<String> {
    if VALUES.contains(&name) {
        return Some(format!("`{name}` has a meaning of its own in the language"));
    }
    if FUNCTIONS.iter().any(|(function, ..)| *function == name) || SPECIAL_FUNCTIONS.contains(&name) {
        return Some(format!("`{name}` is a function of the language"));
    }
    if is_keyword(name) {
        return Some(format!("`{name}` is a keyword of Rust"));
    }
    if TYPES.contains(&name) {
        return Some(format!("`{name}` is a type of the language"));
    }
    None
}

/// Why a model or part can't have this name.
pub(super) fn module_refusal(name: &str) -> Option<String> {
    if GENERATED.contains(&name) {
        return Some(format!("`{name}` is the name of a generated item"));
    }
    if IN_SCOPE.contains(&name) {
        return Some(format!("generated code needs the name `{name}`"));
    }
    if is_keyword(name) {
        return Some(format!("`{name}` is a keyword of Rust"));
    }
    None
}

/// Shape of a joint's coordinates, known from the syntax alone: expressions need it before axes are checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Fixed,
    Revolute,
    Prismatic,
    Screw,
    Cylindrical,
    Universal,
    Planar,
    Ball(Orientation),
    Free(Orientation),
}

/// Joint kinds by name; Ball and Free with the default orientation.
pub(super) const JOINT_KINDS: [(&str, Shape); 9] = [
    ("Fixed", Shape::Fixed),
    ("Revolute", Shape::Revolute),
    ("Prismatic", Shape::Prismatic),
    ("Screw", Shape::Screw),
    ("Cylindrical", Shape::Cylindrical),
    ("Universal", Shape::Universal),
    ("Planar", Shape::Planar),
    ("Ball", Shape::Ball(Orientation::Quaternion)),
    ("Free", Shape::Free(Orientation::Quaternion)),
];

impl Shape {
    pub(super) fn named(name: &str) -> Option<Shape> {
        let found = JOINT_KINDS.iter().find(|(kind, _)| *kind == name);
        found.map(|(_, shape)| *shape)
    }

    /// Of a joint of this kind with these fields, before they are checked.
    pub(super) fn read(kind: &str, fields: &Fields) -> Option<Shape> {
        let said = fields.list.iter().find(|f| f.name == "coordinates");
        let angles =
            said.is_some_and(|field| matches!(&field.value, Expr::Path(path) if path.path.is_ident("RollPitchYaw")));
        Some(match Shape::named(kind)? {
            Shape::Ball(_) if angles => Shape::Ball(Orientation::RollPitchYaw),
            Shape::Free(_) if angles => Shape::Free(Orientation::RollPitchYaw),
            other => other,
        })
    }

    pub(super) fn of(kind: &JointKind) -> Shape {
        match kind {
            JointKind::Fixed => Shape::Fixed,
            JointKind::Revolute { .. } => Shape::Revolute,
            JointKind::Prismatic { .. } => Shape::Prismatic,
            JointKind::Screw { .. } => Shape::Screw,
            JointKind::Cylindrical { .. } => Shape::Cylindrical,
            JointKind::Universal { .. } => Shape::Universal,
            JointKind::Planar { .. } => Shape::Planar,
            JointKind::Ball(orientation) => Shape::Ball(*orientation),
            JointKind::Free(orientation) => Shape::Free(*orientation),
        }
    }

    pub(super) fn name(self) -> &'static str {
        let kind = match self {
            Shape::Ball(_) => Shape::Ball(Orientation::Quaternion),
            Shape::Free(_) => Shape::Free(Orientation::Quaternion),
            other => other,
        };
        let found = JOINT_KINDS.iter().find(|(_, shape)| *shape == kind);
        found.map_or("joint", |(name, _)| name)
    }

    /// Number of velocity coordinates.
    pub(super) fn freedoms(self) -> usize {
        match self {
            Shape::Fixed => 0,
            Shape::Revolute | Shape::Prismatic | Shape::Screw => 1,
            Shape::Cylindrical | Shape::Universal => 2,
            Shape::Planar | Shape::Ball(_) => 3,
            Shape::Free(_) => 6,
        }
    }

    /// Names of the coordinates that are scalars, in the order of the coordinates.
    pub(super) fn coordinates(self) -> &'static [&'static str] {
        match self {
            Shape::Fixed | Shape::Ball(Orientation::Quaternion) => &[],
            Shape::Revolute | Shape::Screw => &["angle"],
            Shape::Prismatic => &["travel"],
            Shape::Cylindrical => &["travel", "angle"],
            Shape::Universal => &["first", "second"],
            Shape::Planar => &["x", "y", "angle"],
            Shape::Ball(Orientation::RollPitchYaw) => &["roll", "pitch", "yaw"],
            Shape::Free(Orientation::RollPitchYaw) => &["x", "y", "z", "roll", "pitch", "yaw"],
            Shape::Free(Orientation::Quaternion) => &["x", "y", "z"],
        }
    }

    /// How a message names velocity coordinate `index` of the joint `name`.
    pub(super) fn coordinate_text(self, name: &str, index: usize) -> String {
        if self.freedoms() == 1 {
            return format!("`{name}`");
        }
        match self.coordinates().get(index) {
            Some(coordinate) => format!("`{name}.{coordinate}`"),
            None => {
                let axis = ["x", "y", "z"].get(index % 3).copied().unwrap_or("x");
                format!("`{name}.angular_velocity.{axis}`")
            }
        }
    }
}
