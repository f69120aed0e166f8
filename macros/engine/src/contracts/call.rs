//! Functions of expressions beyond sums, products, roots and sines, which no rule of the graph looks into. The last ones work
//! with masks, which are scalars of the graph too.

/// Functions that generated code calls on the scalar trait, with their usual meaning and number of arguments.
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
}

impl Call {
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
