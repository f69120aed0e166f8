//! Stage `model`: typed expressions in f64, at the declared defaults of all params, and where states start that bodies follow.
//!
//! In: expressions of literals, params and these states. Out: their values; nothing for what changes in time.

use std::collections::HashMap;
use std::rc::Rc;

use crate::model::types::{
    BodyRef, Comparison, Expr, ExprNode, Frame, FrameQuantity, FrameStep, Function, ParamId, StateId,
};

use super::matrix3::{self, Matrix3};

/// A value at compile time.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Scalar(f64),
    Bool(bool),
    Vec3([f64; 3]),
    /// Row by row.
    Rotation(Matrix3),
    Array(Rc<[Value]>),
}

impl Value {
    pub(crate) fn scalar(&self) -> Option<f64> {
        match self {
            Value::Scalar(x) => Some(*x),
            _ => None,
        }
    }

    pub(crate) fn vector(&self) -> Option<[f64; 3]> {
        match self {
            Value::Vec3(v) => Some(*v),
            _ => None,
        }
    }

    /// All scalars in order, row by row.
    pub(crate) fn flatten(&self, into: &mut Vec<f64>) {
        match self {
            Value::Scalar(x) => into.push(*x),
            Value::Bool(b) => into.push(f64::from(u8::from(*b))),
            Value::Vec3(v) => into.extend(v),
            Value::Rotation(rows) => into.extend(rows.as_flattened()),
            Value::Array(elements) => elements.iter().for_each(|e| e.flatten(into)),
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        match self {
            Value::Scalar(x) => x.is_finite(),
            Value::Bool(_) => true,
            Value::Vec3(v) => v.iter().all(|x| x.is_finite()),
            Value::Rotation(rows) => rows.as_flattened().iter().all(|x| x.is_finite()),
            Value::Array(elements) => elements.iter().all(Value::is_finite),
        }
    }
}

impl From<Vec<Value>> for Value {
    fn from(elements: Vec<Value>) -> Self {
        Value::Array(elements.into())
    }
}

/// Remembers every node that it has met: shared subtrees cost once.
#[derive(Default)]
pub(crate) struct Evaluator {
    params: HashMap<usize, Value>,
    /// Of states that were told.
    starts: HashMap<usize, f64>,
    /// By address of the node; the node is kept, so that the address stays its own.
    memo: HashMap<*const ExprNode, (Rc<ExprNode>, Option<Value>)>,
    is_cautious: bool,
    /// By so many of its last digits everything that is rounded is moved, up and down by turns.
    digits: f64,
    moves: u64,
}

/// What is closer to a jump may be on either side of it: decimals are rounded.
const BESIDE_A_JUMP: f64 = 1e-12;

impl Evaluator {
    /// Gives no value where rounding may decide: comparisons of equal numbers, signs of zero, angles of half a turn. With
    /// `digits` other than zero values are off by what rounding may do to them.
    pub(crate) fn cautious(digits: f64) -> Self {
        Evaluator { is_cautious: true, digits, ..Evaluator::default() }
    }

    fn may_jump(&self, x: f64, size: f64) -> bool {
        self.is_cautious && x.abs() <= BESIDE_A_JUMP * (1.0 + size.abs())
    }

    pub(crate) fn set_param(&mut self, id: ParamId, default: Value) {
        self.params.insert(id.0, default);
    }

    pub(crate) fn set_start(&mut self, id: StateId, start: f64) {
        self.starts.insert(id.0, start);
    }

    pub(crate) fn param(&self, id: ParamId) -> Option<&Value> {
        self.params.get(&id.0)
    }

    pub(crate) fn scalar(&mut self, expr: &Expr) -> Option<f64> {
        self.value(expr)?.scalar()
    }

    pub(crate) fn vector(&mut self, expr: &Expr) -> Option<[f64; 3]> {
        self.value(expr)?.vector()
    }

    pub(crate) fn value(&mut self, expr: &Expr) -> Option<Value> {
        if let ExprNode::Number(x) = &*expr.node {
            // Integers are what they say.
            return Some(Value::Scalar(if x.fract() == 0.0 { *x } else { self.moved(*x) }));
        }
        let key = Rc::as_ptr(&expr.node);
        if let Some((_, value)) = self.memo.get(&key) {
            return value.clone();
        }
        let value = match self.compute(&expr.node) {
            Some(Value::Scalar(x)) => Some(Value::Scalar(self.moved(x))),
            Some(Value::Vec3(v)) => Some(Value::Vec3(v.map(|x| self.moved(x)))),
            other @ (Some(Value::Bool(_) | Value::Rotation(_) | Value::Array(_)) | None) => other,
        };
        self.memo.insert(key, (Rc::clone(&expr.node), value.clone()));
        value
    }

    fn moved(&mut self, x: f64) -> f64 {
        if self.digits == 0.0 {
            return x;
        }
        // Of the golden ratio's multiples: no pattern of signs that the order of operands could cancel.
        self.moves = self.moves.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let sign = if self.moves >> 63 == 0 { 1.0 } else { -1.0 };
        x * (1.0 + sign * self.digits * f64::EPSILON)
    }

    fn compute(&mut self, node: &ExprNode) -> Option<Value> {
        match node {
            ExprNode::Number(x) => Some(Value::Scalar(*x)),
            ExprNode::Pi => Some(Value::Scalar(std::f64::consts::PI)),
            ExprNode::Param(id) => self.params.get(&id.0).cloned(),
            ExprNode::State(id) => self.starts.get(&id.0).copied().map(Value::Scalar),
            ExprNode::Vec3([x, y, z]) => {
                let (x, y, z) = (self.scalar(x), self.scalar(y), self.scalar(z));
                Some(Value::Vec3([x?, y?, z?]))
            }
            ExprNode::Array(elements) => {
                let values: Option<Vec<Value>> = elements.iter().map(|e| self.value(e)).collect();
                Some(values?.into())
            }
            ExprNode::Index(array, index) => match self.value(array)? {
                Value::Array(elements) => Some(elements[*index].clone()),
                _ => None,
            },
            ExprNode::Component(vector, index) => {
                let vector = self.vector(vector)?;
                Some(Value::Scalar(vector[*index]))
            }
            ExprNode::Neg(a) => Some(match self.value(a)? {
                Value::Vec3(v) => Value::Vec3(v.map(|x| -x)),
                other => Value::Scalar(-other.scalar()?),
            }),
            ExprNode::Add(a, b) => self.sum(a, b, 1.0),
            ExprNode::Sub(a, b) => self.sum(a, b, -1.0),
            ExprNode::Mul(a, b) => match (self.value(a)?, self.value(b)?) {
                (Value::Scalar(s), Value::Vec3(v)) | (Value::Vec3(v), Value::Scalar(s)) => {
                    Some(Value::Vec3(v.map(|x| s * x)))
                }
                (a, b) => Some(Value::Scalar(a.scalar()? * b.scalar()?)),
            },
            ExprNode::Div(a, b) => {
                let divisor = self.scalar(b)?;
                match self.value(a)? {
                    Value::Vec3(v) => Some(Value::Vec3(v.map(|x| x / divisor))),
                    other => Some(Value::Scalar(other.scalar()? / divisor)),
                }
            }
            ExprNode::Call(function, arguments) => self.call(*function, arguments),
            ExprNode::Compare(comparison, a, b) => {
                let (a, b) = (self.scalar(a)?, self.scalar(b)?);
                (!self.may_jump(a - b, a)).then(|| Value::Bool(compare(*comparison, a, b)))
            }
            ExprNode::And(a, b) => Some(Value::Bool(self.truth(a)? && self.truth(b)?)),
            ExprNode::Or(a, b) => Some(Value::Bool(self.truth(a)? || self.truth(b)?)),
            ExprNode::Not(a) => Some(Value::Bool(!self.truth(a)?)),
            ExprNode::Identity => Some(Value::Rotation(matrix3::IDENTITY)),
            ExprNode::RotationAbout { axis, angle } => {
                let (axis, angle) = (self.vector(axis)?, self.scalar(angle)?);
                Some(Value::Rotation(matrix3::rotation(axis, angle)))
            }
            ExprNode::RollPitchYaw([roll, pitch, yaw]) => {
                let [x, y, z] = matrix3::IDENTITY;
                let roll = matrix3::rotation(x, self.scalar(roll)?);
                let pitch = matrix3::rotation(y, self.scalar(pitch)?);
                let yaw = matrix3::rotation(z, self.scalar(yaw)?);
                Some(Value::Rotation(matrix3::product(&yaw, &matrix3::product(&pitch, &roll))))
            }
            ExprNode::Compose(a, b) => {
                let (a, b) = (self.rotation(a)?, self.rotation(b)?);
                Some(Value::Rotation(matrix3::product(&a, &b)))
            }
            ExprNode::Rotated(rotation, vector) => {
                let (rotation, vector) = (self.rotation(rotation)?, self.vector(vector)?);
                Some(Value::Vec3(matrix3::times(&rotation, vector)))
            }
            ExprNode::OfFrame(frame, FrameQuantity::Position) => Some(Value::Vec3(self.fixed(frame)?.0)),
            ExprNode::OfFrame(frame, FrameQuantity::Rotation) => Some(Value::Rotation(self.fixed(frame)?.1)),
            ExprNode::Express { frame, vector } => {
                let (axes, vector) = (self.fixed(frame)?.1, self.vector(vector)?);
                Some(Value::Vec3(matrix3::times(&matrix3::transpose(axes), vector)))
            }
            ExprNode::Select(condition, yes, no) => {
                if self.truth(condition)? {
                    self.value(yes)
                } else {
                    self.value(no)
                }
            }
            _ => None,
        }
    }

    fn rotation(&mut self, expr: &Expr) -> Option<Matrix3> {
        match self.value(expr)? {
            Value::Rotation(rows) => Some(rows),
            _ => None,
        }
    }

    /// Origin and axes of a frame that stands still.
    fn fixed(&mut self, frame: &Frame) -> Option<([f64; 3], Matrix3)> {
        if frame.body != BodyRef::Ground {
            return None;
        }
        let (mut origin, mut axes) = ([0.0; 3], matrix3::IDENTITY);
        for step in &frame.steps {
            match step {
                FrameStep::At(offset) => {
                    origin = matrix3::add(origin, matrix3::times(&axes, self.vector(offset)?));
                }
                FrameStep::Rotated(axis, angle) => {
                    let turn = matrix3::rotation(self.vector(axis)?, self.scalar(angle)?);
                    axes = matrix3::product(&axes, &turn);
                }
                FrameStep::Oriented(rows) => {
                    let mut turn = matrix3::IDENTITY;
                    for (row, entries) in turn.iter_mut().zip(rows.iter()) {
                        for (entry, value) in row.iter_mut().zip(entries) {
                            *entry = self.scalar(value)?;
                        }
                    }
                    axes = matrix3::product(&axes, &turn);
                }
            }
        }
        Some((origin, axes))
    }

    fn truth(&mut self, expr: &Expr) -> Option<bool> {
        match self.value(expr)? {
            Value::Bool(b) => Some(b),
            _ => None,
        }
    }

    fn sum(&mut self, a: &Expr, b: &Expr, sign: f64) -> Option<Value> {
        match (self.value(a)?, self.value(b)?) {
            (Value::Vec3([ax, ay, az]), Value::Vec3([bx, by, bz])) => {
                Some(Value::Vec3([ax + sign * bx, ay + sign * by, az + sign * bz]))
            }
            (a, b) => Some(Value::Scalar(a.scalar()? + sign * b.scalar()?)),
        }
    }

    fn call(&mut self, function: Function, arguments: &[Expr]) -> Option<Value> {
        let (first, second) = (arguments.first()?, arguments.get(1));
        match function {
            Function::Dot | Function::Cross => {
                let (a, b) = (self.vector(first)?, self.vector(second?)?);
                Some(match function {
                    Function::Dot => Value::Scalar(dot(a, b)),
                    _ => Value::Vec3(cross(a, b)),
                })
            }
            Function::Norm => {
                let v = self.vector(first)?;
                Some(Value::Scalar(dot(v, v).sqrt()))
            }
            _ => {
                let x = self.scalar(first)?;
                let y = match second {
                    Some(second) => Some(self.scalar(second)?),
                    None => None,
                };
                let jumps = match function {
                    Function::Signum => self.may_jump(x, 0.0),
                    Function::Atan2 => y.is_some_and(|y| y <= BESIDE_A_JUMP && self.may_jump(x, y)),
                    _ => false,
                };
                if jumps {
                    return None;
                }
                scalar_call(function, x, y).map(Value::Scalar)
            }
        }
    }
}

fn scalar_call(function: Function, x: f64, y: Option<f64>) -> Option<f64> {
    Some(match function {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Atan2 => x.atan2(y?),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Sqrt => x.sqrt(),
        Function::Abs => x.abs(),
        Function::Signum if x == 0.0 => 0.0,
        Function::Signum => x.signum(),
        Function::Min => x.min(y?),
        Function::Max => x.max(y?),
        Function::Hypot => x.hypot(y?),
        Function::Powi | Function::Powf => x.powf(y?),
        Function::Deg => x.to_radians(),
        Function::Dot | Function::Cross | Function::Norm => return None,
    })
}

fn compare(comparison: Comparison, a: f64, b: f64) -> bool {
    match comparison {
        Comparison::Less => a < b,
        Comparison::LessEqual => a <= b,
        Comparison::Greater => a > b,
        Comparison::GreaterEqual => a >= b,
        Comparison::Equal => a == b,
        Comparison::NotEqual => a != b,
    }
}

pub(crate) fn dot([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> f64 {
    ax * bx + ay * by + az * bz
}

pub(crate) fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}
