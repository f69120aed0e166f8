//! Stage `mechanics`: values of typed expressions.
//!
//! In: nothing. Out: [`Value`], one form per type of the language, and its scalars in the order of generated structs.

use std::rc::Rc;

use crate::invariant::fault::raise;
use crate::model::types::Type;
use crate::symbolic::graph::{Graph, Scalar, Vector};

/// A value on the graph. Clones are cheap.
#[derive(Clone, Debug)]
pub(in crate::mechanics) enum Value {
    /// A number, or a mask.
    Scalar(Scalar),
    Vector(Vector),
    /// Row by row.
    Rotation(Rc<[[Scalar; 3]; 3]>),
    /// Position; orientation w, i, j, k.
    Pose(Vector, [Scalar; 4]),
    /// `Twist`: linear, angular. `Wrench`: force, moment.
    Pair(Vector, Vector),
    /// Six rows.
    Jacobian(Rc<[Vec<Scalar>; 6]>),
    Array(Rc<[Value]>),
}

/// Number of scalars of a value, in a model with so many velocities.
pub(in crate::mechanics) fn width(ty: &Type, freedoms: usize) -> usize {
    match ty {
        Type::Jacobian => 6 * freedoms,
        Type::Array(element, count) => count * width(element, freedoms),
        Type::Scalar | Type::Bool => 1,
        Type::Vec3 => 3,
        Type::Twist | Type::Wrench => 6,
        Type::Pose => 7,
        Type::Rotation => 9,
    }
}

/// What the checker of the model sees to.
pub(in crate::mechanics) const TYPES: &str = "operands have the types that their operation takes";

impl Value {
    pub(in crate::mechanics) fn scalar(&self) -> Scalar {
        match self {
            Value::Scalar(s) => *s,
            _ => raise(TYPES),
        }
    }

    /// A vector, also of an array of three scalars.
    pub(in crate::mechanics) fn vector(&self, g: &mut Graph) -> Vector {
        match self {
            Value::Vector(v) => *v,
            Value::Array(list) => match &list[..] {
                [x, y, z] => g.vector([x.scalar(), y.scalar(), z.scalar()]),
                _ => raise(TYPES),
            },
            _ => raise(TYPES),
        }
    }

    /// Scalars in the order that `FunctionKind::Outputs` documents.
    pub(in crate::mechanics) fn flatten(&self, g: &mut Graph, out: &mut Vec<Scalar>) {
        match self {
            Value::Scalar(s) => out.push(*s),
            Value::Vector(v) => out.extend(g.components(*v)),
            Value::Rotation(rows) => out.extend(rows.iter().flatten()),
            Value::Pose(position, quaternion) => {
                out.extend(g.components(*position));
                out.extend(quaternion);
            }
            Value::Pair(first, second) => {
                out.extend(g.components(*first));
                out.extend(g.components(*second));
            }
            Value::Jacobian(rows) => out.extend(rows.iter().flatten()),
            Value::Array(list) => list.iter().for_each(|value| value.flatten(g, out)),
        }
    }

    /// Applies an operation to every part that is a scalar or a vector.
    pub(in crate::mechanics) fn map(&self, g: &mut Graph, f: &mut impl FnMut(&mut Graph, Part) -> Part) -> Value {
        match self {
            Value::Scalar(s) => Value::Scalar(f(g, Part::Scalar(*s)).scalar()),
            Value::Vector(v) => Value::Vector(f(g, Part::Vector(*v)).vector()),
            Value::Pair(a, b) => {
                let mut vector = |g: &mut Graph, v| f(g, Part::Vector(v)).vector();
                Value::Pair(vector(g, *a), vector(g, *b))
            }
            Value::Array(list) => Value::Array(list.iter().map(|value| value.map(g, f)).collect()),
            Value::Rotation(_) | Value::Pose(..) | Value::Jacobian(_) => self.clone(),
        }
    }

    /// Combines two values of one type, scalar by scalar; vectors stay whole where `vectors` can do that.
    pub(in crate::mechanics) fn zip(
        &self,
        other: &Value,
        g: &mut Graph,
        scalars: &mut impl FnMut(&mut Graph, Scalar, Scalar) -> Scalar,
        vectors: &mut impl FnMut(&mut Graph, Vector, Vector) -> Vector,
    ) -> Value {
        match (self, other) {
            (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(scalars(g, *a, *b)),
            (Value::Vector(a), Value::Vector(b)) => Value::Vector(vectors(g, *a, *b)),
            (Value::Pair(a, b), Value::Pair(c, d)) => Value::Pair(vectors(g, *a, *c), vectors(g, *b, *d)),
            (Value::Pose(p, q), Value::Pose(r, s)) => {
                let quaternion = [0, 1, 2, 3].map(|k| scalars(g, q[k], s[k]));
                Value::Pose(vectors(g, *p, *r), quaternion)
            }
            (Value::Rotation(a), Value::Rotation(b)) => {
                let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| scalars(g, a[i][j], b[i][j])));
                Value::Rotation(Rc::new(rows))
            }
            (Value::Jacobian(a), Value::Jacobian(b)) => {
                let row =
                    |k: usize| -> Vec<Scalar> { a[k].iter().zip(&b[k]).map(|(&x, &y)| scalars(g, x, y)).collect() };
                Value::Jacobian(Rc::new([0, 1, 2, 3, 4, 5].map(row)))
            }
            (Value::Array(a), Value::Array(b)) => {
                Value::Array(a.iter().zip(b.iter()).map(|(x, y)| x.zip(y, g, scalars, vectors)).collect())
            }
            _ => raise(TYPES),
        }
    }
}

/// A scalar or a vector.
#[derive(Clone, Copy, Debug)]
pub(in crate::mechanics) enum Part {
    Scalar(Scalar),
    Vector(Vector),
}

impl Part {
    fn scalar(self) -> Scalar {
        match self {
            Part::Scalar(s) => s,
            Part::Vector(_) => raise(TYPES),
        }
    }

    fn vector(self) -> Vector {
        match self {
            Part::Vector(v) => v,
            Part::Scalar(_) => raise(TYPES),
        }
    }
}
