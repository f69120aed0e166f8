//! Stage `model`: which names are taken by the language, and the tables of names that it offers.
//!
//! In: names. Out: whether a user may have them, and why not.

use syn::Expr;

use crate::rust_keywords::is_keyword;
use crate::syntax::tree::Fields;

use super::joint_kinds::JointKind;
use super::types::{Function, Orientation, SystemQuantity};

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

/// Quantities of several bodies as one: `centre_of_mass()`, `linear_momentum([torso, legs])`. Their names stay free for items.
pub(super) const SYSTEM_QUANTITIES: [(&str, SystemQuantity); 4] = [
    ("total_mass", SystemQuantity::TotalMass),
    ("centre_of_mass", SystemQuantity::CentreOfMass),
    ("linear_momentum", SystemQuantity::LinearMomentum),
    ("angular_momentum", SystemQuantity::AngularMomentum),
];

/// Functions of whole expressions, and matrices of which entries are taken: `diff(x, t)`, `mass_matrix[a, b]`. Their names stay
/// free for items.
pub(super) const MANIPULATIONS: [&str; 3] = ["diff", "substitute", "closed"];
pub(super) const MATRICES: [&str; 4] = ["mass_matrix", "bias", "constraint", "jacobian"];

/// Values between points of constant arrays. Their names stay free for items.
pub(super) const TABLES: [&str; 2] = ["table", "smooth_table"];

/// Types that a user may name.
pub(super) const TYPES: [&str; 7] = ["Scalar", "Vec3", "Pose", "Rotation", "Twist", "Wrench", "Jacobian"];

/// Structs and constants of a generated module.
const GENERATED: [&str; 20] = [
    "Params",
    "Position",
    "Velocity",
    "State",
    "States",
    "Derivative",
    "Closed",
    "SolveItem",
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
    "FORMULAS",
    "JACOBIAN",
];

/// What generated code names without a path: a part of this name would stand in its way.
const IN_SCOPE: [&str; 14] =
    ["T", "F", "A", "Real", "Default", "From", "FnMut", "Clone", "Copy", "Debug", "PartialEq", "Result", "Ok", "Err"];

/// Why an item can't have this name.
pub(crate) fn refusal(name: &str) -> Option<String> {
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
pub(crate) fn module_refusal(name: &str) -> Option<String> {
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

impl JointKind {
    /// Of a joint of this kind with these fields, before they are checked.
    pub(super) fn read(kind: &str, fields: &Fields) -> Option<&'static JointKind> {
        let said = fields.list.iter().find(|f| f.name == "coordinates");
        let angles =
            said.is_some_and(|field| matches!(&field.value, Expr::Path(path) if path.path.is_ident("RollPitchYaw")));
        let kind = JointKind::named(kind)?;
        let by_angles = kind.oriented(Orientation::RollPitchYaw).filter(|_| angles);
        Some(by_angles.unwrap_or(kind))
    }

    /// How a message names velocity coordinate `index` of the joint `name`.
    pub(super) fn coordinate_text(&self, name: &str, index: usize) -> String {
        if self.freedoms() == 1 {
            return format!("`{name}`");
        }
        match self.coordinates().get(index) {
            Some(coordinate) => format!("`{name}.{coordinate}`"),
            None => {
                let axis = ["x", "y", "z"][index % 3];
                format!("`{name}.angular_velocity.{axis}`")
            }
        }
    }
}
