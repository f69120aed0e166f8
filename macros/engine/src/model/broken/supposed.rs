//! Stage `model`: what is supposed of a model with mistakes: how its bodies hang together, and of what type a value is
//! whose expression gives none.
//!
//! In: joints whose frames are partly unknown; expressions with mistakes. Out: a tree and the joints that close loops,
//! chosen as [`crate::model::topology`] would choose them if every unknown frame were where it is needed; types.

use proc_macro2::Ident;
use syn::{BinOp, Expr, Member};

use crate::diagnostics::nearest;
use crate::invariant::index_vec::IndexVec;
use crate::model::checker::{Checker, Context, Meaning};
use crate::model::names::{FUNCTIONS, VALUES};
use crate::model::topology::Topology;
use crate::model::types::{BodyRef, Function, JointId, Joints, Type};
use crate::syntax::tree::{Field, Fields};

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
    pub(in crate::model) fn supposed(
        &self,
        bodies: usize,
        joints: &Joints,
        ends: &IndexVec<JointId, [Option<BodyRef>; 2]>,
    ) -> Topology {
        let node = |body: BodyRef| match body {
            BodyRef::Ground => bodies,
            BodyRef::Body(id) => id.0,
        };
        let mut groups = Groups::new(bodies + 1);
        let cost = |id: JointId| {
            let kind = joints[id].kind;
            let says_cut = self.coordinates.is_none() && self.says_cut(id);
            (says_cut, if kind.is_free() { 0 } else { kind.freedoms() + 1 }, id)
        };
        let mut order: Vec<JointId> = joints.ids().collect();
        order.sort_by_key(|id| cost(*id));
        let mut is_cut: IndexVec<JointId, bool> = joints.iter().map(|_| false).collect();
        for &id in &order {
            if let [Some(parent), Some(child)] = ends[id] {
                is_cut[id] = !groups.join(node(parent), node(child));
            }
        }
        // An unknown frame lies wherever a body still hangs in the air.
        for &id in &order {
            if let sides @ ([None, _] | [_, None]) = &ends[id] {
                let known = sides.iter().flatten().next().map_or(bodies, |body| node(*body));
                let other = (0..=bodies).find(|other| !groups.joined(*other, known));
                let joins = other.is_some_and(|other| groups.join(known, other));
                // A child that nobody knows is a body that was lost.
                let is_lost = sides.last().is_some_and(Option::is_none) && !cost(id).0;
                is_cut[id] = !joins && !is_lost;
            }
        }
        let (cuts, tree) = joints.ids().partition(|id| is_cut[*id]);
        Topology { tree, cuts, skipped: Vec::new() }
    }

    /// Fields with misspelt names, in them and of them, replaced by the nearest.
    pub(super) fn corrected_fields(&self, fields: &Fields, known: &[&str], context: Context<'a>) -> Fields {
        let correct = |field: &Field| {
            let name = field.name.to_string();
            let near = nearest(&name, known.iter().copied()).filter(|_| !known.contains(&name.as_str()));
            let name = near.map_or_else(|| field.name.clone(), |near| Ident::new(near, field.name.span()));
            let mut value = field.value.clone();
            self.correct(&mut value, context);
            Field { name, value }
        };
        Fields { span: fields.span, list: fields.list.iter().map(correct).collect(), broken: fields.broken }
    }

    /// Replaces misspelt names by the nearest.
    fn correct(&self, expr: &mut Expr, context: Context<'a>) {
        match expr {
            Expr::Paren(inner) => self.correct(&mut inner.expr, context),
            Expr::Unary(unary) => self.correct(&mut unary.expr, context),
            Expr::Binary(binary) => {
                self.correct(&mut binary.left, context);
                self.correct(&mut binary.right, context);
            }
            Expr::Array(array) => array.elems.iter_mut().for_each(|element| self.correct(element, context)),
            Expr::Index(index) => self.correct(&mut index.expr, context),
            Expr::Call(call) => {
                let own = self.functions_of(context.scope);
                let known = FUNCTIONS.iter().map(|function| function.0);
                respell(&mut call.func, known.chain(own.iter().map(String::as_str)));
                call.args.iter_mut().for_each(|argument| self.correct(argument, context));
            }
            Expr::MethodCall(call) => {
                self.correct(&mut call.receiver, context);
                call.args.iter_mut().for_each(|argument| self.correct(argument, context));
            }
            Expr::Field(field) => {
                self.correct(&mut field.base, context);
                let members = || VECTORS.into_iter().chain(OTHERS.iter().map(|other| other.0));
                if let Member::Named(name) = &mut field.member {
                    let text = name.to_string();
                    let own = self.scopes.iter().any(|scope| scope.symbol(&text).is_some());
                    if let (false, Some(near)) = (own || members().any(|m| m == text), nearest(&text, members())) {
                        *name = Ident::new(near, name.span());
                    }
                }
            }
            Expr::Path(_) if !self.report.is_hopeless() => {
                let names = self.names_of(context.scope);
                let locals = self.locals(context);
                let names = names.iter().chain(&locals).map(String::as_str).chain(VALUES);
                respell(expr, names);
            }
            _ => {}
        }
    }

    /// The type that an expression with mistakes would probably have without them.
    pub(super) fn seeming_type(&mut self, expr: &Expr, context: Context<'a>) -> Type {
        let mut corrected = expr.clone();
        self.correct(&mut corrected, context);
        self.type_from(&corrected, context)
    }

    fn type_from(&mut self, expr: &Expr, context: Context<'a>) -> Type {
        match self.meaning(expr, context) {
            Some(Meaning::Value(value)) => return value.expr.ty,
            Some(Meaning::Joint(_) | Meaning::Coordinate(..)) => return Type::Scalar,
            _ => {}
        }
        match expr {
            Expr::Paren(inner) => self.type_from(&inner.expr, context),
            Expr::Unary(unary) => self.type_from(&unary.expr, context),
            Expr::Binary(binary) => {
                let (left, right) = (self.type_from(&binary.left, context), self.type_from(&binary.right, context));
                match (&binary.op, left, right) {
                    (BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_), Type::Scalar, other) => other,
                    (BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_) | BinOp::Div(_), known, _) => known,
                    _ => Type::Bool,
                }
            }
            Expr::Array(array) => match array.elems.first().map(|element| self.type_from(element, context)) {
                Some(element) => Type::Array(Box::new(element), array.elems.len()),
                None => Type::Scalar,
            },
            Expr::Call(call) => {
                let name = called(&call.func);
                let function = FUNCTIONS.iter().find(|function| function.0 == name);
                match (name.as_str(), function) {
                    (_, Some((_, Function::Cross, _))) => Type::Vec3,
                    ("select", _) => {
                        call.args.iter().nth(1).map_or(Type::Scalar, |value| self.type_from(value, context))
                    }
                    ("rotation" | "roll_pitch_yaw" | "identity", _) => Type::Rotation,
                    ("pose", _) => Type::Pose,
                    ("vec3" | "Vec3" | "vec" | "vector", _) => Type::Vec3,
                    _ => Type::Scalar,
                }
            }
            Expr::MethodCall(call) => match call.method.to_string().as_str() {
                "express" => match self.type_from(&call.receiver, context) {
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
            Expr::Index(index) => match self.type_from(&index.expr, context) {
                Type::Array(element, _) => *element,
                _ => Type::Scalar,
            },
            _ => Type::Scalar,
        }
    }
}

/// The nearest of the names in place of one that is none of them.
fn respell<'n>(path: &mut Expr, names: impl Iterator<Item = &'n str> + Clone) {
    let Expr::Path(path) = path else { return };
    let Some(name) = path.path.get_ident() else { return };
    let text = name.to_string();
    if names.clone().any(|known| known == text) {
        return;
    }
    if let Some(near) = nearest(&text, names) {
        path.path = Ident::new(near, name.span()).into();
    }
}

fn called(function: &Expr) -> String {
    match function {
        Expr::Path(path) => path.path.get_ident().map(ToString::to_string).unwrap_or_default(),
        _ => String::new(),
    }
}

/// Of `base.member`, by the member alone.
fn member_type(name: &str) -> Type {
    if VECTORS.contains(&name) {
        return Type::Vec3;
    }
    let other = OTHERS.iter().find(|other| other.0 == name);
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
            match self.0[node] {
                next if next != node => node = next,
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
        self.0[a.max(b)] = a.min(b);
        a != b
    }
}
