//! Stage `optimize`, its result: straight-line programs, ready to be printed.
//!
//! In: nothing. Out: the types that `schedule` fills, and `emit`, the interpreter and the ledger read. A program is a
//! list of statements in single-assignment form; expressions that are used once and need no name stand inside the
//! statement that uses them.

use crate::model::types::{InputId, JointId, ParamId, StateId};

/// What a symbol of the graph stands for in the generated structs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symbol {
    Time,
    /// Scalar number `element` of a flattened param.
    Param {
        param: ParamId,
        element: usize,
    },
    Input {
        input: InputId,
        element: usize,
    },
    State {
        state: StateId,
    },
    /// Component of a joint's position. Ball with quaternion: w, i, j, k. Free: x, y, z, then w, i, j, k or roll, pitch,
    /// yaw. Else in the order of the coordinates.
    Position {
        joint: JointId,
        component: usize,
    },
    /// Component of a joint's velocity. Free: linear, then angular (or rates of roll, pitch, yaw).
    Velocity {
        joint: JointId,
        component: usize,
    },
    Acceleration {
        joint: JointId,
        component: usize,
    },
}

/// Index into [`Program::locals`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Local(pub usize);

/// Index into [`Compiled::fields`]: a value that depends on parameters alone and is stored in `Model`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FieldId(pub usize);

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
}

/// An expression over symbols, fields and locals.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// Finite; the sign stands here.
    Literal(f64),
    Symbol(Symbol),
    Field(FieldId),
    Local(Local),
    Neg(Box<Expression>),
    /// Terms are added from left to right; `true` subtracts. The first term may be negative.
    Sum(Vec<(bool, Expression)>),
    Product(Vec<Expression>),
    Quotient(Box<Expression>, Box<Expression>),
    Call(Call, Vec<Expression>),
}

#[derive(Clone, Debug)]
pub enum Statement {
    Let {
        local: Local,
        value: Expression,
    },
    /// Sine and cosine of one angle, together.
    SinCos {
        sin: Local,
        cos: Local,
        angle: Expression,
    },
}

/// One function body.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Readable names, unique within the program, valid Rust identifiers, snake case.
    pub locals: Vec<String>,
    pub statements: Vec<Statement>,
    /// In the order that [`FunctionKind`] documents.
    pub results: Vec<Expression>,
}

impl Program {
    /// All numbers that are written in it.
    pub fn literals(&self) -> impl Iterator<Item = f64> + '_ {
        let mut stack: Vec<&Expression> = self.results.iter().collect();
        stack.extend(self.statements.iter().map(|statement| match statement {
            Statement::Let { value, .. } => value,
            Statement::SinCos { angle, .. } => angle,
        }));
        std::iter::from_fn(move || {
            while let Some(expression) = stack.pop() {
                match expression {
                    Expression::Literal(x) => return Some(*x),
                    Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {}
                    Expression::Neg(inner) => stack.push(inner),
                    Expression::Sum(terms) => stack.extend(terms.iter().map(|t| &t.1)),
                    Expression::Product(list) | Expression::Call(_, list) => stack.extend(list),
                    Expression::Quotient(a, b) => stack.extend([&**a, &**b]),
                }
            }
            None
        })
    }
}

/// Operations by the counting rule: sign changes and factors of one are free; `min`, `max` and a selection count as
/// additions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    pub add: u32,
    pub mul: u32,
    pub div: u32,
    pub sqrt: u32,
    pub sincos: u32,
    /// Any other function or comparison.
    pub other: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionKind {
    /// Accelerations in the order of velocity coordinates, then the rates of the user's states.
    ForwardDynamics,
    /// Efforts in the order of velocity coordinates.
    InverseDynamics,
    /// DOF x DOF, row by row.
    MassMatrix,
    /// DOF
    Bias,
    KineticEnergy,
    PotentialEnergy,
    /// Output after output, flattened: `Vec3` 3, `Rotation` 9 row by row, `Pose` x, y, z, w, i, j, k, `Twist` and
    /// `Wrench` 6, `Jacobian` 6 x DOF row by row, arrays element by element.
    Outputs,
}

/// One generated function.
#[derive(Clone, Debug)]
pub struct Function {
    pub kind: FunctionKind,
    pub program: Program,
    /// As derived, before optimisation.
    pub before: Cost,
    /// As emitted.
    pub after: Cost,
    /// What it was made from, such as `composite rigid body, LDL^T` or `articulated body`.
    pub method: &'static str,
}

/// Everything that `emit` prints for one model, besides the model itself.
#[derive(Clone, Debug, Default)]
pub struct Compiled {
    /// Names of the fields of `Model`, unique, readable.
    pub fields: Vec<String>,
    /// Computes the fields from parameters: one result per field.
    pub prelude: Program,
    pub prelude_cost: Cost,
    pub functions: Vec<Function>,
    /// Whether every rewrite passed the identity test. Where one didn't, the function stands as it was derived: right, but
    /// dearer than need be. The tests see to it that this never happens.
    pub sound: bool,
}
