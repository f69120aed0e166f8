//! Stage `model`: named values: `const`, `let`, `param`, `input`, `output`, `state`.
//!
//! In: their items. Out: types, defaults, typed expressions.

use syn::spanned::Spanned;
use syn::{Expr, Type as Written};

use crate::model::changing::states_of;
use crate::model::checker::{Checker, Context, Meaning, NamedId, NamedRequest, Role, ScopeId, Slot};
use crate::model::checks::evaluate::Value;
use crate::model::docs;
use crate::model::expand::root;
use crate::model::names::TYPES;
use crate::model::typed::{Allowed, Class, Typed, type_text};
use crate::model::types::{Expr as Checked, Output, Speed, State, Type};
use crate::syntax::tree::{self, ItemKind};

/// Nesting of array types.
const MAX_NESTING: usize = 8;

impl<'a> Checker<'a, '_> {
    /// Works out a named value when it is first asked for.
    pub(in crate::model) fn resolve_named(&mut self, request: &NamedRequest<'a>) -> Option<Meaning> {
        let Some(expr) = request.expr else {
            self.report.silent();
            return None;
        };
        let context = request.context;
        let written = request.item.and_then(|item| item.ty.as_ref());
        let ty = match written {
            Some(written) => Some(self.read_type(written, root(request.home), 0)?),
            None => None,
        };
        let value = match request.role {
            Role::Port => return self.frame(expr, context).map(Meaning::Frame),
            Role::JointPort => return self.joint_port(expr, context),
            Role::Let if ty.is_none() => return self.meaning(expr, context),
            Role::BoundParam => {
                let ty = match ty {
                    Some(ty) => ty,
                    None => self.default_type(request)?,
                };
                let value = self.typed(expr, context, &ty, Allowed::Parameters)?;
                self.finite(&value)?;
                value
            }
            Role::Const => {
                let value = self.value_as(expr, context, ty.as_ref())?;
                let value = self.allow(value, Allowed::Constants)?;
                self.finite(&value)?;
                value
            }
            Role::Output => {
                let value = self.value_as(expr, context, ty.as_ref())?;
                self.output_type(value)?
            }
            Role::Speed => {
                let value = self.expect(expr, context, &Type::Scalar)?;
                self.allow(value, Allowed::Speed)?
            }
            Role::Let | Role::Signal => self.value_as(expr, context, ty.as_ref())?,
        };
        Some(Meaning::Value(value))
    }

    /// What a port for a joint is given: one coordinate, or a joint that has no other.
    fn joint_port(&mut self, expr: &Expr, context: Context<'a>) -> Option<Meaning> {
        let meaning = self.meaning(expr, context)?;
        let (message, help) = match &meaning {
            Meaning::Coordinate(..) => return Some(meaning),
            Meaning::Joint(id) => match self.joints[*id].kind? {
                kind if kind.freedoms() == 1 => return Some(meaning),
                kind => (
                    format!("a {} joint has {} coordinates, a port for a joint takes one", kind.word, kind.freedoms()),
                    "name the coordinate, such as `gimbal.first`",
                ),
            },
            _ => (
                "this is no joint".to_owned(),
                "a port for a joint takes a joint of one coordinate, or a coordinate of one",
            ),
        };
        self.report.help(crate::model::expressions::span(expr), message, help);
        None
    }

    /// Of a port for a joint that says in its unit whether it slides or turns.
    pub(in crate::model) fn check_joint_unit(&mut self, id: NamedId, meaning: Option<&Meaning>) {
        let named = &self.named[id];
        let (Some(unit), Some(expr)) = (&named.unit, named.expr) else { return };
        let (joint, index) = match meaning {
            Some(Meaning::Joint(joint)) => (*joint, 0),
            Some(Meaning::Coordinate(joint, index)) => (*joint, *index),
            _ => return,
        };
        let Some(kind) = self.joints[joint].kind else { return };
        let (wanted, found) = match (&*unit.text, kind.is_slide(index)) {
            ("m", false) => ("m", "rad"),
            ("rad", true) => ("rad", "m"),
            _ => return,
        };
        let message = format!("`{}` is declared in {wanted}, this coordinate is in {found}", unit.name);
        self.report.error(crate::model::expressions::span(expr), message);
    }

    fn value_as(&mut self, expr: &Expr, context: Context<'a>, ty: Option<&Type>) -> Option<Typed> {
        match ty {
            Some(ty) => self.expect(expr, context, ty),
            None => self.value(expr, context),
        }
    }

    /// The type that a param has by its own default, when another value is set from outside.
    fn default_type(&mut self, request: &NamedRequest<'a>) -> Option<Type> {
        let default = request.item.and_then(|item| item.value.as_ref());
        match default {
            Some(default) => {
                let value = self.value(default, root(request.home))?;
                self.param_shape(value).map(|value| value.expr.ty)
            }
            None => Some(Type::Scalar),
        }
    }

    /// The default of a param: its type is the param's.
    pub(in crate::model) fn resolve_param(
        &mut self,
        item: &'a tree::Value,
        scope: ScopeId,
    ) -> Option<(Checked, Value)> {
        let ty = match &item.ty {
            Some(written) => Some(self.read_type(written, root(scope), 0)?),
            None => None,
        };
        let Some(default) = &item.value else {
            self.report.help(
                item.name.span(),
                format!("the param `{}` has no default", item.name),
                format!("write `param {} = 1.0;`", item.name),
            );
            return None;
        };
        let value = self.value_as(default, root(scope), ty.as_ref())?;
        let value = self.allow(value, Allowed::Parameters)?;
        let value = self.param_shape(value)?;
        self.finite(&value)?;
        let number = self.evaluator.value(&value.expr)?;
        Some((value.expr, number))
    }

    /// Type of an input; a scalar unless it says otherwise.
    pub(in crate::model) fn resolve_input(&mut self, item: &'a tree::Value, scope: ScopeId) -> Option<Type> {
        if let Some(value) = &item.value {
            self.report.help(
                value.span(),
                "an input has no value here",
                "it is given at every step; a constant is a `param`",
            );
        }
        let Some(written) = &item.ty else {
            return Some(Type::Scalar);
        };
        let ty = self.read_type(written, root(scope), 0)?;
        if is_plain(&ty) {
            return Some(ty);
        }
        self.report
            .error(written.span(), format!("an input is a Scalar, a Vec3 or an array of them, not {}", type_text(&ty)));
        None
    }

    /// Params are scalars, `Vec3` and arrays of these; triples inside an array are `Vec3`.
    fn param_shape(&mut self, value: Typed) -> Option<Typed> {
        let value = self.triples(value)?;
        if is_plain(&value.expr.ty) {
            return Some(value);
        }
        self.report.error(
            value.expr.span,
            format!("a param is a Scalar, a Vec3 or an array of them, not {}", type_text(&value.expr.ty)),
        );
        None
    }

    fn triples(&mut self, value: Typed) -> Option<Typed> {
        if let Type::Array(element, count) = &value.expr.ty
            && let Type::Array(inner, 3) = &**element
            && **inner == Type::Scalar
        {
            let ty = Type::Array(Box::new(Type::Vec3), *count);
            return self.coerce(value, &ty);
        }
        Some(value)
    }

    fn output_type(&mut self, value: Typed) -> Option<Typed> {
        let value = self.triples(value)?;
        let refusal = match &value.expr.ty {
            Type::Bool => Some("write `select(condition, 1.0, 0.0)`"),
            Type::Array(..) if !is_plain(&value.expr.ty) => Some("outputs are values and arrays of scalars or Vec3"),
            _ => None,
        };
        if let Some(help) = refusal {
            let message = format!("an output cannot be {}", type_text(&value.expr.ty));
            self.report.help(value.expr.span, message, help);
            return None;
        }
        Some(value)
    }

    /// A type as the user wrote it.
    pub(in crate::model) fn read_type(
        &mut self,
        written: &Written,
        context: Context<'a>,
        depth: usize,
    ) -> Option<Type> {
        if tree::poisoned_type(written) || matches!(written, Written::Infer(_)) {
            self.report.silent();
            return None;
        }
        if depth > MAX_NESTING {
            let message = format!("arrays are nested more than {MAX_NESTING} deep");
            self.report.error(written.span(), message);
            return None;
        }
        match written {
            Written::Paren(inner) => self.read_type(&inner.elem, context, depth + 1),
            Written::Group(inner) => self.read_type(&inner.elem, context, depth + 1),
            Written::Array(array) => {
                let element = self.read_type(&array.elem, context, depth + 1);
                let count = self.array_length(&array.len, context);
                let ty = Type::Array(Box::new(element?), count?);
                self.bounded(&ty, written.span())?;
                Some(ty)
            }
            Written::Path(path) => {
                let name = path.path.get_ident().map(ToString::to_string);
                let name = name.unwrap_or_default();
                let ty = match name.as_str() {
                    "Scalar" => Type::Scalar,
                    "Vec3" => Type::Vec3,
                    "Rotation" => Type::Rotation,
                    "Pose" => Type::Pose,
                    "Twist" => Type::Twist,
                    "Wrench" => Type::Wrench,
                    "Jacobian" => Type::Jacobian,
                    _ => return self.unknown_type(&name, written),
                };
                Some(ty)
            }
            _ => self.unknown_type("", written),
        }
    }

    fn unknown_type(&mut self, name: &str, written: &Written) -> Option<Type> {
        let instead = match name {
            "f64" | "f32" | "Real" | "Float" | "T" | "usize" | "i32" => Some("Scalar"),
            "Vector3" | "Vector" | "Point3" => Some("Vec3"),
            "UnitQuaternion" | "Quaternion" | "Rotation3" => Some("Rotation"),
            "Isometry3" | "Frame" => Some("Pose"),
            _ => None,
        };
        let span = written.span();
        let message = if name.is_empty() {
            "this is no type of the language".to_string()
        } else {
            format!("unknown type `{name}`")
        };
        match instead {
            Some(instead) => self.report.help(span, message, format!("write `{instead}`")),
            None => self.report.unknown(
                span,
                message,
                name,
                TYPES,
                Some(format!("types are `{}`, and arrays", TYPES.join("`, `"))),
            ),
        }
        None
    }

    pub(in crate::model) fn finish_output(&mut self, id: NamedId, item: &'a tree::Item) -> Option<Output> {
        let named = &self.named[id];
        let (name, scope) = (named.name, named.home);
        let meaning = self.named_meaning(id, name.span())?;
        let Meaning::Value(value) = meaning else {
            return None;
        };
        let instance = self.scopes[scope].instance;
        Some(Output {
            place: crate::model::types::Place { instance, field: name.clone() },
            value: value.expr,
            docs: docs::docs(&item.attrs),
        })
    }

    pub(in crate::model) fn finish_speed(&mut self, id: NamedId, item: &'a tree::Item) -> Option<Speed> {
        let named = &self.named[id];
        let (name, scope) = (named.name, named.home);
        let Meaning::Value(value) = self.named_meaning(id, name.span())? else { return None };
        if value.uses.culprit(Class::State).is_none() {
            let message = format!("the speed `{name}` reads no velocity");
            self.report.help(name.span(), message, "a speed is made of rates of joints and velocities of frames");
            return None;
        }
        let instance = self.scopes[scope].instance;
        Some(Speed {
            place: crate::model::types::Place { instance, field: name.clone() },
            value: value.expr,
            docs: docs::docs(&item.attrs),
            span: name.span(),
        })
    }

    pub(in crate::model) fn finish_state(&mut self, slot: &Slot<'a>) -> Option<State> {
        let ItemKind::State { name, rate, start } = &slot.item.kind else {
            return None;
        };
        let context = root(slot.scope);
        let rate = self.scalar(rate, context, Allowed::Forces);
        let Some(start) = start else {
            self.report.help(
                name.span(),
                format!("the state `{name}` has no start value"),
                format!("write `state {name}: rate = .., start: 0.0;`"),
            );
            return None;
        };
        let start = self.start(start, context)?;
        Some(State { place: slot.place.clone(), rate: rate?.expr, start, docs: docs::docs(&slot.item.attrs) })
    }

    fn start(&mut self, start: &Expr, context: Context<'a>) -> Option<f64> {
        let start = self.scalar(start, context, Allowed::Constants)?;
        self.finite(&start)?;
        self.evaluator.scalar(&start.expr)
    }

    /// Tells the evaluator where the states of an expression start. What is wrong with them is said where they are declared.
    pub(in crate::model) fn begin_states(&mut self, expr: &Checked) {
        for id in states_of([expr]) {
            let slot = self.states[id].clone();
            if let ItemKind::State { start: Some(start), .. } = &slot.item.kind
                && let Some(start) = self.start(start, root(slot.scope))
            {
                self.evaluator.set_start(id, start);
            }
        }
    }
}

/// Scalar, `Vec3`, or an array of them.
fn is_plain(ty: &Type) -> bool {
    match ty {
        Type::Scalar | Type::Vec3 => true,
        Type::Array(element, _) => matches!(**element, Type::Scalar | Type::Vec3),
        _ => false,
    }
}
