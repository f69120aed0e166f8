//! What symbols stand for.

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
    /// What tells an assembly mode: cosine and sine of an angle, then three sides, one or minus one.
    Alternative {
        component: usize,
    },
    /// Where Newton's method starts: a component of the guess in `State`.
    Guess {
        index: usize,
    },
    /// An unknown inside an iteration; it is printed as a local.
    Unknown {
        index: usize,
    },
    /// Cosine or sine (0, 1) of an unknown that is iterated as a point on the circle.
    UnknownPoint {
        index: usize,
        component: usize,
    },
    /// A number of a limb while it is optimised, kept apart from those of other limbs: a literal in what is printed.
    Number {
        index: usize,
    },
}
