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
    /// Of a constraint equation: an argument of the residual.
    Multiplier {
        row: usize,
    },
    /// An argument of the jump of velocities, and of velocities from momenta.
    Impulse {
        joint: JointId,
        component: usize,
    },
    Momentum {
        joint: JointId,
        component: usize,
    },
    /// Of a constraint equation: how fast it is to change in a jump.
    Rate {
        row: usize,
    },
    /// Where Newton's method starts: a component of the guess in `State`.
    Guess {
        index: usize,
    },
    /// An unknown inside an iteration; it is printed as a local.
    Unknown {
        index: usize,
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
    /// A pivoted solution of a linear system in the runtime; `results` are the unknowns, then the rank.
    Solve {
        size: usize,
        symmetric: bool,
        /// Equations of one unit, see [`BlockKind::Solve`](crate::symbolic::graph::BlockKind).
        groups: Box<[usize]>,
        /// Row by row.
        matrix: Vec<Expression>,
        rhs: Vec<Expression>,
        results: Vec<Local>,
    },
    /// A counted loop. `unknowns` start at `start` and become `next` in every round; they are read inside and behind it.
    /// `residual` is set in every round, before the unknowns are, and read behind the loop; it is zero where there is none.
    Iterate {
        count: usize,
        unknowns: Vec<Local>,
        start: Vec<Expression>,
        body: Vec<Statement>,
        next: Vec<Expression>,
        residual: (Local, Expression),
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

impl Statement {
    /// Its expressions, those of statements inside included.
    pub fn expressions(&self) -> Box<dyn Iterator<Item = &Expression> + '_> {
        match self {
            Statement::Let { value, .. } => Box::new(std::iter::once(value)),
            Statement::SinCos { angle, .. } => Box::new(std::iter::once(angle)),
            Statement::Solve { matrix, rhs, .. } => Box::new(matrix.iter().chain(rhs)),
            Statement::Iterate { start, body, next, residual, .. } => {
                let inside = body.iter().flat_map(Statement::expressions);
                Box::new(start.iter().chain(inside).chain(next).chain(std::iter::once(&residual.1)))
            }
        }
    }

    /// Locals that later statements may read.
    pub fn defined(&self) -> Vec<Local> {
        match self {
            Statement::Let { local, .. } => vec![*local],
            Statement::SinCos { sin, cos, .. } => vec![*sin, *cos],
            Statement::Solve { results, .. } => results.clone(),
            Statement::Iterate { unknowns, residual, .. } => unknowns.iter().copied().chain([residual.0]).collect(),
        }
    }
}

impl Program {
    /// All expressions of statements and results.
    pub fn expressions(&self) -> impl Iterator<Item = &Expression> + '_ {
        self.statements.iter().flat_map(Statement::expressions).chain(&self.results)
    }

    /// All numbers that are written in it.
    pub fn literals(&self) -> impl Iterator<Item = f64> + '_ {
        let mut stack: Vec<&Expression> = self.expressions().collect();
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
    /// Comparisons, what is done with masks, absolute values and signs.
    pub compare: u32,
    /// Any other function.
    pub other: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FunctionKind {
    /// Accelerations in the order of velocity coordinates, then the rates of the user's states; with constraints the
    /// multipliers and the rank of their system; with iterations the greatest residual of the loops.
    ForwardDynamics,
    /// Efforts in the order of velocity coordinates; with `solve_for` the inputs found, then the rank of their system.
    InverseDynamics,
    /// DOF x DOF, row by row.
    MassMatrix,
    /// DOF
    Bias,
    KineticEnergy,
    PotentialEnergy,
    /// Residuals of the constraint equations.
    Constraints,
    /// Equations x DOF, row by row.
    ConstraintJacobian,
    /// Time derivatives of the residuals.
    ConstraintRate,
    /// What is left of the second time derivatives of the residuals where accelerations are zero.
    ConstraintBias,
    /// DOF dynamic rows M a + bias + G^T lambda, then the residuals of the constraint equations.
    Residual,
    /// Of the model's kinematics number k: values, then rates, then accelerations.
    Kinematics(usize),
    /// The unknowns of all iterations, then the greatest residual.
    Guess,
    /// Roots in closed forms of loops that vanish where two solutions meet.
    DeadCentres,
    /// Of each of `Structure::margins` what vanishes in its dead centre, and the rate of its square; then, with iterations,
    /// the greatest residual at the guess.
    Margins,
    /// Of each of `Structure::granted` the residual over its scale, at the guess.
    Granted,
    /// Partial derivatives of the accelerations and of the rates of own states, R of them: R x DOF by displacements of the
    /// position, R x DOF by velocities, R x own states, R x scalars of inputs, each row by row.
    ForwardDerivatives,
    /// The same of the efforts, DOF of them.
    InverseDerivatives,
    /// The jump of the velocities; with constraints the multipliers and the rank of their system.
    Impulse,
    /// Momenta, by velocity coordinate.
    Momentum,
    /// Their rates.
    MomentumRate,
    /// Velocities that belong to momenta.
    MomentumVelocity,
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
    /// Its number among the candidates of the derivation.
    pub candidate: usize,
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
    /// What `Params::check` computes from parameters.
    pub checks: Checks,
    /// What `System::without_inertia` looks at: entries row by row. It reads fields.
    pub inertia: Inertia<Program>,
    /// Whether every rewrite passed the identity test. Where one didn't, the function stands as it was derived: right, but
    /// dearer than need be. The tests see to it that this never happens.
    pub sound: bool,
    /// What stage `verify` could not compare with its derived equations.
    pub unchecked: Vec<Unchecked>,
}

/// What has no clear value at any state that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unchecked {
    pub part: Part,
    pub doubt: Doubt,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Function(FunctionKind),
    /// The program of `Params::check`.
    Checks,
    /// The mass matrix of `System::without_inertia`.
    Inertia,
    /// What two functions must have in common, in words.
    Law(&'static str),
}

/// Why values are not clear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    NotFinite,
    /// Two numbers that are compared are equal but for rounding.
    Comparison,
    /// The rank of a system is less than its size, or hangs on rounding.
    Rank,
    /// Rounding leaves few digits.
    Rounding,
    /// Loops don't close.
    Open,
}

/// The mass matrix, where it may become singular.
#[derive(Clone, Debug, Default)]
pub enum Inertia<P> {
    /// It is regular wherever it is finite, or nothing is to be said of it.
    #[default]
    Regular,
    /// The function that the model asks for gives it.
    Requested,
    /// No function gives it.
    Own(P),
}

/// Tests of parameters.
#[derive(Clone, Debug, Default)]
pub struct Checks {
    /// Reads parameters and no fields; its results are the values of all tests in order.
    pub program: Program,
    /// What is wrong where a test fails, the test, and how many values it takes.
    pub list: Vec<(String, Condition, usize)>,
}

/// What must hold of values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    Finite,
    /// The first value is above rounding of the second.
    Pivot,
    /// Below the square root of the rounding unit.
    Small,
}
