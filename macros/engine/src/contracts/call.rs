//! Functions of expressions beyond sums, products, roots and sines, which no rule of the graph looks into. The last ones work
//! with masks, which are scalars of the graph too.

pub use crate::model::types::ExternalId;

/// Functions that generated code calls on the scalar trait, with their usual meaning and number of arguments, and those of the
/// user's own Rust.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Call {
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Powf,
    Sqrt,
    Abs,
    Signum,
    Min,
    Max,
    /// Comparisons give a mask.
    Less,
    LessEqual,
    Equal,
    And,
    Or,
    Not,
    /// Mask, then, else.
    Select,
    /// The rounding unit of the scalar, of no arguments.
    Epsilon,
    /// No number: the result of what has none, of no arguments.
    Nan,
    /// A function of the user's own Rust. Nothing is known of it but that equal arguments give equal values, so it is never
    /// evaluated here, literal arguments or not; where numbers are needed it has a stand-in
    /// ([`external`](crate::symbolic::external)).
    External(ExternalId),
    /// Its slope by the argument of this number, which Rust gives too.
    ExternalSlope(ExternalId, usize),
    /// How such a slope changes: of the slope, and of changes of its arguments. Nobody gives that, so what needs it is refused.
    ExternalCurvature(ExternalId),
}

impl Call {
    /// A number of its own, from which hashes are made.
    pub fn tag(self) -> u64 {
        match self {
            Call::Tan => 0,
            Call::Asin => 1,
            Call::Acos => 2,
            Call::Atan => 3,
            Call::Atan2 => 4,
            Call::Sinh => 5,
            Call::Cosh => 6,
            Call::Tanh => 7,
            Call::Exp => 8,
            Call::Ln => 9,
            Call::Powf => 10,
            Call::Sqrt => 11,
            Call::Abs => 12,
            Call::Signum => 13,
            Call::Min => 14,
            Call::Max => 15,
            Call::Less => 16,
            Call::LessEqual => 17,
            Call::Equal => 18,
            Call::And => 19,
            Call::Or => 20,
            Call::Not => 21,
            Call::Select => 22,
            Call::Epsilon => 23,
            Call::Nan => 24,
            Call::External(function) => of_external(function, 0),
            Call::ExternalCurvature(function) => of_external(function, 1),
            Call::ExternalSlope(function, argument) => of_external(function, 2 + argument as u64),
        }
    }

    /// The function of the user's own Rust that it is, or is a slope of.
    pub fn external(self) -> Option<ExternalId> {
        match self {
            Call::External(function) | Call::ExternalSlope(function, _) | Call::ExternalCurvature(function) => {
                Some(function)
            }
            _ => None,
        }
    }

    /// Whether the result is a mask: the scalar's own kind of truth, which is no number and has no place in a field.
    pub fn is_mask(self) -> bool {
        use Call::{And, Equal, Less, LessEqual, Not, Or};
        matches!(self, Less | LessEqual | Equal | And | Or | Not)
    }

    /// Work of one instruction or two, as additions are.
    pub fn is_comparison(self) -> bool {
        use Call::{Abs, And, Equal, Less, LessEqual, Not, Or, Signum};
        matches!(self, Less | LessEqual | Equal | And | Or | Not | Abs | Signum)
    }
}

/// Apart from all others: a call declares fewer than 2^32 functions, with at most a handful of arguments.
fn of_external(function: ExternalId, which: u64) -> u64 {
    (1 << 40) | ((function.0 as u64) << 8) | which
}
