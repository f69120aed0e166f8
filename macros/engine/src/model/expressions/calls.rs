//! Stage `model`: function calls.
//!
//! In: `sin(x)`, `select(c, a, b)`, `kinetic()`. Out: typed nodes.

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{Expr, ExprCall};

use crate::model::checker::{Checker, Context, Meaning};
use crate::model::names::{CONSTRUCTORS, FUNCTIONS, MANIPULATIONS, SPECIAL_FUNCTIONS, SYSTEM_QUANTITIES, TABLES};
use crate::model::typed::{Class, Typed, Uses, type_text};
use crate::model::types::{Expr as Checked, ExprNode, Function, Type};

use super::coerce::convert;
use super::source_text;

/// Shapes of bodies: functions in the field `inertia` only.
const SHAPES: [&str; 6] = ["diag", "inertia", "rod", "cuboid", "cylinder", "sphere"];

/// Largest exponent of `powi`.
const MAX_POWER: i64 = 1000;

impl<'a> Checker<'a, '_> {
    pub(super) fn call(&mut self, call: &ExprCall, context: Context<'a>) -> Option<Meaning> {
        let name = match &*call.func {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        // Names of constructors and of other models are free for the user's own functions, which come first.
        if let Some((name, function)) = name.and_then(|name| Some((name, self.function_of(context.scope, name)?))) {
            let arguments: Vec<&Expr> = call.args.iter().collect();
            return self.expanded_call(function, name, &arguments, call.span(), context);
        }
        if let Some((name, external)) = name.and_then(|name| Some((name, self.external_of(context.scope, name)?))) {
            let arguments: Vec<&Expr> = call.args.iter().collect();
            return self.external_call(external, name, &arguments, call.span(), context).map(Meaning::Value);
        }
        self.call_of_language(call, context).map(Meaning::Value)
    }

    fn call_of_language(&mut self, call: &ExprCall, context: Context<'a>) -> Option<Typed> {
        let at = call.span();
        let name = match &*call.func {
            Expr::Path(path) => path.path.get_ident(),
            _ => None,
        };
        let Some(name) = name else {
            self.report.help(call.func.span(), "this is no function", "functions are called by name, such as `sin(x)`");
            return None;
        };
        let text = name.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        match text.as_str() {
            "select" => return self.select(name, &arguments, at, context),
            "diff" => return self.diff(name, &arguments, at, context),
            "substitute" => return self.substitute(name, &arguments, at, context),
            "closed" => return self.closed(name, &arguments, at, context),
            _ if TABLES.contains(&text.as_str()) && self.module_called(name).is_none() => {
                return self.table(name, &arguments, at, context);
            }
            "kinetic" | "potential" => {
                self.arity(name, &arguments, 0, at)?;
                let node = if text == "kinetic" { ExprNode::Kinetic } else { ExprNode::Potential };
                let mut uses = Uses::of(Class::State, format!("{text}()"), name.span());
                if text == "potential" {
                    uses.add(Class::Potential, "potential()", name.span());
                }
                return Some(Typed::leaf(node, Type::Scalar, at).with(uses));
            }
            _ if CONSTRUCTORS.contains(&text.as_str()) => return self.constructor(name, &arguments, at, context),
            _ => {}
        }
        let found = FUNCTIONS.iter().find(|(known, ..)| *known == text);
        let Some((_, function, count)) = found else {
            if let Some(module) = self.module_called(name) {
                return self.formula(name, module, call, context);
            }
            if let Some((_, quantity)) = SYSTEM_QUANTITIES.iter().find(|(known, _)| *known == text) {
                return self.of_bodies(name, *quantity, &arguments, at, context);
            }
            self.unknown_function(name, context);
            // What stands between the parentheses may hold mistakes of its own.
            for argument in arguments {
                self.meaning(argument, context);
            }
            return None;
        };
        let correct = self.arity(name, &arguments, *count, at);
        if *function == Function::Powi {
            return self.powi(&arguments, at, context, correct);
        }
        let (argument, result) = match function {
            Function::Dot | Function::Norm => (Type::Vec3, Type::Scalar),
            Function::Cross => (Type::Vec3, Type::Vec3),
            _ => (Type::Scalar, Type::Scalar),
        };
        let values: Vec<Option<Typed>> = arguments.iter().map(|e| self.expect(e, context, &argument)).collect();
        correct?;
        let values: Vec<Typed> = values.into_iter().collect::<Option<_>>()?;
        self.function(*function, values, result, at)
    }

    /// Functions whose values are rotations and poses.
    fn constructor(&mut self, name: &Ident, arguments: &[&Expr], at: Span, context: Context<'a>) -> Option<Typed> {
        let build = |this: &mut Self, node, ty, parts: &[&Typed]| this.build(node, ty, at, parts);
        match (name.to_string().as_str(), arguments) {
            ("identity", []) => Some(Typed::leaf(ExprNode::Identity, Type::Rotation, at)),
            ("rotation", [axis, angle]) => {
                let axis = self.axis(axis, context);
                let angle = self.expect(angle, context, &Type::Scalar);
                let (axis, angle) = (axis?, angle?);
                let node = ExprNode::RotationAbout { axis: axis.expr.clone(), angle: angle.expr.clone() };
                build(self, node, Type::Rotation, &[&axis, &angle])
            }
            ("roll_pitch_yaw", [roll, pitch, yaw]) => {
                let [roll, pitch, yaw] = [roll, pitch, yaw].map(|e| self.expect(e, context, &Type::Scalar));
                let (roll, pitch, yaw) = (roll?, pitch?, yaw?);
                let node = ExprNode::RollPitchYaw([&roll, &pitch, &yaw].map(|angle| angle.expr.clone()));
                build(self, node, Type::Rotation, &[&roll, &pitch, &yaw])
            }
            ("pose", [position, orientation]) => {
                let position = self.expect(position, context, &Type::Vec3);
                let orientation = self.expect(orientation, context, &Type::Rotation);
                let (position, orientation) = (position?, orientation?);
                let node = ExprNode::Pose(position.expr.clone(), orientation.expr.clone());
                build(self, node, Type::Pose, &[&position, &orientation])
            }
            (text, _) => {
                let count = match text {
                    "identity" => 0,
                    "roll_pitch_yaw" => 3,
                    _ => 2,
                };
                self.arity(name, arguments, count, at);
                None
            }
        }
    }

    pub(super) fn arity(&mut self, name: &Ident, arguments: &[&Expr], count: usize, at: Span) -> Option<()> {
        if arguments.len() == count {
            return Some(());
        }
        let found = arguments.len();
        let plural = if count == 1 { "" } else { "s" };
        self.report.error(at, format!("`{name}` takes {count} argument{plural}, found {found}"));
        None
    }

    fn function(&mut self, function: Function, values: Vec<Typed>, result: Type, at: Span) -> Option<Typed> {
        let exprs: Vec<Checked> = values.iter().map(|v| v.expr.clone()).collect();
        let parts: Vec<&Typed> = values.iter().collect();
        self.build(ExprNode::Call(function, exprs), result, at, &parts)
    }

    /// The exponent is a whole number, known now.
    fn powi(&mut self, arguments: &[&Expr], at: Span, context: Context<'a>, correct: Option<()>) -> Option<Typed> {
        let base = arguments.first().and_then(|e| self.expect(e, context, &Type::Scalar));
        let exponent = arguments.get(1).and_then(|e| {
            let exponent = self.whole_number(e, context)?;
            if exponent.abs() > MAX_POWER {
                let message = format!("exponents of `powi` lie between -{MAX_POWER} and {MAX_POWER}");
                self.report.help(e.span(), message, "write `powf(x, y)`");
                return None;
            }
            Some(Typed::number(exponent as f64, e.span()))
        });
        correct?;
        self.function(Function::Powi, vec![base?, exponent?], Type::Scalar, at)
    }

    fn select(&mut self, name: &Ident, arguments: &[&Expr], at: Span, context: Context<'a>) -> Option<Typed> {
        self.arity(name, arguments, 3, at)?;
        let [condition, yes, no] = arguments else {
            return None;
        };
        let condition = self.expect(condition, context, &Type::Bool);
        let yes = self.value(yes, context);
        let no = self.value(no, context);
        let (condition, mut yes, mut no) = (condition?, yes?, no?);
        if let (Some(a), Some(b)) = (convert(&yes, &Type::Vec3), convert(&no, &Type::Vec3)) {
            (yes, no) = (a, b);
        }
        if yes.expr.ty != no.expr.ty {
            let message = format!(
                "both values of `select` have one type: found {} and {}",
                type_text(&yes.expr.ty),
                type_text(&no.expr.ty)
            );
            self.report.error(no.expr.span, message);
            return None;
        }
        if !matches!(yes.expr.ty, Type::Scalar | Type::Vec3) {
            let message = format!("`select` chooses between scalars or Vec3, found {}", type_text(&yes.expr.ty));
            self.report.error(yes.expr.span, message);
            return None;
        }
        let ty = yes.expr.ty.clone();
        let node = ExprNode::Select(condition.expr.clone(), yes.expr.clone(), no.expr.clone());
        self.build(node, ty, at, &[&condition, &yes, &no])
    }

    fn unknown_function(&mut self, name: &Ident, context: Context<'a>) {
        let text = name.to_string();
        let pow = |help: &str| Some(help.to_string());
        let help = match text.as_str() {
            "pow" => pow("write `powi(x, 2)` or `powf(x, y)`"),
            "log" => pow("write `ln(x)`"),
            "clamp" => pow("write `max(low, min(high, x))`"),
            "sign" | "sgn" => pow("write `signum(x)`"),
            "degrees" | "rad" | "radians" | "to_radians" => pow("write `deg(30.0)`"),
            "length" | "magnitude" => pow("write `norm(v)`"),
            "mass" => pow("write `total_mass()`"),
            "com" | "center_of_mass" => pow("write `centre_of_mass()`"),
            "momentum" => pow("write `linear_momentum()` or `angular_momentum()`"),
            "energy" => pow("write `kinetic() + potential()`"),
            "vec3" | "vec" | "vector" => pow("a vector is written `[x, y, z]`"),
            "pow2" | "square" | "sqr" => pow("write `powi(x, 2)`"),
            "max3" | "min3" => pow("write `max(a, max(b, c))`"),
            "mod" | "fmod" | "rem" | "floor" | "ceil" | "round" => {
                pow("there is none: equations of motion need slopes")
            }
            "der" | "ddt" | "dt" => {
                pow("write `diff(x, t)`; the rate of a coordinate is `joint.rate`, of a point `frame.velocity`")
            }
            "derivative" | "gradient" | "partial" => pow("write `diff(x, hinge)`"),
            "subs" | "replace" => pow("write `substitute(x, hinge.rate = 0.0)`"),
            "interpolate" | "interp" | "interp1" | "lookup" => {
                pow("write `table(x, XS, YS)` or `smooth_table(x, XS, YS)`")
            }
            "if_else" | "ifelse" | "cond" => pow("write `select(condition, a, b)`"),
            _ => None,
        };
        if let Some(help) = help {
            let message = format!("unknown function `{text}`");
            return self.report.help(name.span(), message, help);
        }
        if SHAPES.contains(&text.as_str()) {
            let message = format!("`{text}` stands in the field `inertia` of a body only");
            return self.report.error(name.span(), message);
        }
        let locals = self.locals(context);
        let functions = self.functions_of(context.scope);
        if self.names_of(context.scope).contains(&text) || locals.contains(&text) {
            let message = format!("`{text}` is no function");
            return self.report.help(name.span(), message, "a product needs its `*`");
        }
        self.report.unknown(
            name.span(),
            format!("unknown function `{text}`"),
            &text,
            FUNCTIONS
                .iter()
                .map(|(known, ..)| *known)
                .chain(SPECIAL_FUNCTIONS)
                .chain(SYSTEM_QUANTITIES.iter().map(|(known, _)| *known))
                .chain(CONSTRUCTORS)
                .chain(MANIPULATIONS)
                .chain(TABLES)
                .chain(functions.iter().map(String::as_str)),
            None,
        );
    }

    /// `x.sin()`: a function written as a method.
    pub(super) fn function_as_method(&mut self, receiver: &Expr, method: &Ident, arguments: &[&Expr]) -> bool {
        let text = method.to_string();
        let known = FUNCTIONS.iter().any(|(known, ..)| *known == text);
        if known {
            let all: Vec<String> =
                std::iter::once(receiver).chain(arguments.iter().copied()).map(source_text).collect();
            self.report.help(
                method.span(),
                format!("`{text}` is a function, not a method"),
                format!("write `{text}({})`", all.join(", ")),
            );
        }
        known
    }
}
