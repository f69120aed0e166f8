//! Stage `model`: what is supposed of a model with mistakes: how its bodies hang together, and of what type a value is
//! whose expression gives none.
//!
//! In: joints whose frames are partly unknown; expressions with mistakes. Out: a tree and the joints that close loops,
//! chosen as [`super::topology`] would choose them if every unknown frame were where it is needed; types.

use syn::{BinOp, Expr, Member};

use super::checker::{Checker, Context, Meaning, Symbol};
use super::names::FUNCTIONS;
use super::topology::Topology;
use super::types::{BodyRef, Function, Joint, JointId, JointKind, Type};
use crate::diagnostics::nearest;

/// Members that vectors, and what has them, are asked for.
const VECTORS: [&str; 14] = [
    "position",
    "velocity",
    "acceleration",
    "angular_velocity",
    "angular_acceleration",
    "linear_velocity",
    "linear_acceleration",
    "omega",
    "force",
    "moment",
    "torque",
    "linear",
    "angular",
    "com",
];

/// Members of other types, and scalars.
const OTHERS: [(&str, Type); 22] = [
    ("rotation", Type::Rotation),
    ("orientation", Type::Rotation),
    ("quaternion", Type::Rotation),
    ("pose", Type::Pose),
    ("twist", Type::Twist),
    ("reaction", Type::Wrench),
    ("wrench", Type::Wrench),
    ("jacobian", Type::Jacobian),
    ("x", Type::Scalar),
    ("y", Type::Scalar),
    ("z", Type::Scalar),
    ("angle", Type::Scalar),
    ("travel", Type::Scalar),
    ("rate", Type::Scalar),
    ("accel", Type::Scalar),
    ("effort", Type::Scalar),
    ("power", Type::Scalar),
    ("first", Type::Scalar),
    ("second", Type::Scalar),
    ("roll", Type::Scalar),
    ("pitch", Type::Scalar),
    ("yaw", Type::Scalar),
];

impl<'a> Checker<'a, '_> {
    /// A tree over joints of which only some `ends` (parent, child) are known.
    pub(super) fn supposed(&self, bodies: usize, joints: &[Joint], ends: &[[Option<BodyRef>; 2]]) -> Topology {
        let node = |body: BodyRef| match body {
            BodyRef::Ground => bodies,
            BodyRef::Body(id) => id.0.min(bodies),
        };
        let mut groups = Groups::new(bodies + 1);
        let cost = |index: usize| {
            let joint = joints.get(index);
            let says_cut = self.coordinates.is_none() && self.says_cut(index);
            let freedoms = joint.map_or(0, |joint| match joint.kind {
                JointKind::Free(_) => 0,
                ref kind => kind.freedoms() + 1,
            });
            (says_cut, freedoms, index)
        };
        let mut order: Vec<usize> = (0..joints.len()).collect();
        order.sort_by_key(|index| cost(*index));
        let mut is_cut = vec![false; joints.len()];
        let mut set = |index: usize, cut: bool| {
            if let Some(slot) = is_cut.get_mut(index) {
                *slot = cut;
            }
        };
        for &index in &order {
            if let Some([Some(parent), Some(child)]) = ends.get(index) {
                set(index, !groups.join(node(*parent), node(*child)));
            }
        }
        // An unknown frame lies wherever a body still hangs in the air.
        for &index in &order {
            if let Some(sides @ ([None, _] | [_, None])) = ends.get(index) {
                let known = sides.iter().flatten().next().map_or(bodies, |body| node(*body));
                let other = (0..=bodies).find(|other| !groups.joined(*other, known));
                let joins = other.is_some_and(|other| groups.join(known, other));
                // A child that nobody knows is a body that was lost.
                let is_lost = sides.last().is_some_and(Option::is_none) && !cost(index).0;
                set(index, !joins && !is_lost);
            }
        }
        let all = || (0..joints.len()).map(JointId);
        let cut = |id: &JointId| is_cut.get(id.0) == Some(&true);
        Topology { tree: all().filter(|id| !cut(id)).collect(), cuts: all().filter(cut).collect(), skipped: Vec::new() }
    }

    /// The type that an expression with mistakes would probably have without them.
    pub(super) fn seeming_type(&mut self, expr: &Expr, context: Context<'a>) -> Type {
        if let Some(Meaning::Value(value)) = self.meaning(expr, context) {
            return match value.expr.ty {
                Type::Array(element, 3) if *element == Type::Scalar => Type::Vec3,
                ty => ty,
            };
        }
        match expr {
            Expr::Paren(inner) => self.seeming_type(&inner.expr, context),
            Expr::Unary(unary) => self.seeming_type(&unary.expr, context),
            Expr::Binary(binary) => {
                let (left, right) =
                    (self.seeming_type(&binary.left, context), self.seeming_type(&binary.right, context));
                match (&binary.op, left, right) {
                    (BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_), Type::Scalar, other) => other,
                    (BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_) | BinOp::Div(_), known, _) => known,
                    _ => Type::Bool,
                }
            }
            Expr::Array(array) => match array.elems.first().map(|element| self.seeming_type(element, context)) {
                Some(Type::Scalar) if array.elems.len() == 3 => Type::Vec3,
                Some(element) => Type::Array(Box::new(element), array.elems.len()),
                None => Type::Scalar,
            },
            Expr::Call(call) => {
                let name = called(&call.func);
                let known = nearest(&name, FUNCTIONS.iter().map(|function| function.0)).unwrap_or(&name);
                let function = FUNCTIONS.iter().find(|function| function.0 == known);
                match (known, function) {
                    (_, Some((_, Function::Cross, _))) => Type::Vec3,
                    ("select", _) => {
                        call.args.iter().nth(1).map_or(Type::Scalar, |value| self.seeming_type(value, context))
                    }
                    ("rotation" | "roll_pitch_yaw" | "identity", _) => Type::Rotation,
                    ("pose", _) => Type::Pose,
                    ("vec3" | "Vec3" | "vec" | "vector", _) => Type::Vec3,
                    _ => Type::Scalar,
                }
            }
            Expr::MethodCall(call) => match call.method.to_string().as_str() {
                "express" => match self.seeming_type(&call.receiver, context) {
                    Type::Scalar => Type::Vec3,
                    ty => ty,
                },
                "cross" => Type::Vec3,
                _ => Type::Scalar,
            },
            Expr::Field(field) => match &field.member {
                Member::Named(name) => member_type(&name.to_string()),
                Member::Unnamed(_) => Type::Scalar,
            },
            Expr::Index(index) => match self.seeming_type(&index.expr, context) {
                Type::Array(element, _) => *element,
                _ => Type::Scalar,
            },
            Expr::Path(path) => {
                let name = path.path.get_ident().map(ToString::to_string).unwrap_or_default();
                let names = self.names_of(context.scope);
                let near = nearest(&name, names.iter().map(String::as_str));
                let names = self.scopes.get(context.scope.0).map(|scope| &scope.names);
                let symbol = near.and_then(|near| names?.get(near)).cloned();
                match symbol {
                    Some(Symbol::Param(id)) => self.param_type(id, name_span(path)).unwrap_or(Type::Scalar),
                    Some(Symbol::Input(id)) => self.input_type(id).unwrap_or(Type::Scalar),
                    Some(Symbol::Named(id, _)) => match self.named_meaning(id, name_span(path)) {
                        Some(Meaning::Value(value)) => value.expr.ty,
                        _ => Type::Scalar,
                    },
                    _ => Type::Scalar,
                }
            }
            _ => Type::Scalar,
        }
    }
}

fn name_span(path: &syn::ExprPath) -> proc_macro2::Span {
    path.path.segments.first().map_or_else(proc_macro2::Span::call_site, |segment| segment.ident.span())
}

fn called(function: &Expr) -> String {
    match function {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string).unwrap_or_default(),
        _ => String::new(),
    }
}

/// Of `base.member`, by the member alone.
fn member_type(name: &str) -> Type {
    let all = VECTORS.into_iter().chain(OTHERS.iter().map(|other| other.0));
    let known = if all.clone().any(|known| known == name) { Some(name) } else { nearest(name, all) };
    let known = known.unwrap_or(name);
    if VECTORS.contains(&known) {
        return Type::Vec3;
    }
    let other = OTHERS.iter().find(|other| other.0 == known);
    other.map_or(Type::Scalar, |other| other.1.clone())
}

/// Bodies that are joined to one another.
struct Groups(Vec<usize>);

impl Groups {
    fn new(count: usize) -> Groups {
        Groups((0..count).collect())
    }

    fn root(&self, mut node: usize) -> usize {
        // A chain of parents is never longer than the list.
        for _ in 0..self.0.len() {
            match self.0.get(node) {
                Some(next) if *next != node => node = *next,
                _ => break,
            }
        }
        node
    }

    fn joined(&self, a: usize, b: usize) -> bool {
        self.root(a) == self.root(b)
    }

    /// Whether they were apart.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        if let Some(slot) = self.0.get_mut(a.max(b)) {
            *slot = a.min(b);
        }
        a != b
    }
}
