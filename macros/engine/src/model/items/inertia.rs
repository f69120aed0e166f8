//! Stage `model`: the inertia of a body, written as a tensor or as a shape.
//!
//! In: `diag(..)`, `inertia(..)`, `rod(..)`, `cuboid(..)`, `cylinder(..)`, `sphere(..)`. Out: the six entries of the
//! tensor about the centre of mass, as typed expressions. Shapes are solid and uniform; a shape of revolution about `a`
//! with axial moment `A` and transverse moment `B` has `B (1 - a a') + A a a'`, a rod `A = 0`, `B = m l^2 / 12`.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::{Expr as Written, ExprCall};

use crate::model::checker::{Checker, Context};
use crate::model::checks::evaluate::dot;
use crate::model::expressions::{component_of, source_text};
use crate::model::typed::{Allowed, new_expr, number, type_text};
use crate::model::types::{Expr, ExprNode, Type};
use crate::model::units::quantities::{INERTIA, LENGTH, MASS};

/// Shapes, their arguments and which of these are `Vec3`.
const SHAPES: [(&str, &[&str]); 6] = [
    ("diag", &["xx", "yy", "zz"]),
    ("inertia", &["xx", "yy", "zz", "xy", "xz", "yz"]),
    ("rod", &["mass", "length", "axis"]),
    ("cuboid", &["mass", "size"]),
    ("cylinder", &["mass", "radius", "length", "axis"]),
    ("sphere", &["mass", "radius"]),
];

/// xx, yy, zz, xy, xz, yz
pub(super) type Tensor = Box<[Expr; 6]>;

/// Row and column of each entry.
const ENTRIES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn inertia(&mut self, expr: &Written, context: Context<'a>) -> Option<Tensor> {
        let mut inner = expr;
        loop {
            inner = match inner {
                Written::Paren(paren) => &paren.expr,
                Written::Group(group) => &group.expr,
                _ => break,
            };
        }
        match inner {
            Written::Verbatim(_) => {
                self.report.silent();
                None
            }
            Written::Call(call) => self.shape_call(call, context),
            other => {
                self.report.help(
                    other.span(),
                    "expected an inertia",
                    "write `diag(xx, yy, zz)`, `inertia(xx, yy, zz, xy, xz, yz)`, `rod(..)`, `cuboid(..)`, `cylinder(..)` or `sphere(..)`",
                );
                None
            }
        }
    }

    fn shape_call(&mut self, call: &ExprCall, context: Context<'a>) -> Option<Tensor> {
        let at = call.span();
        let name = source_text(&call.func);
        if let Written::Path(path) = &*call.func
            && path.path.get_ident().is_some_and(|name| self.has_function(context.scope, name))
        {
            let message = format!("`{name}` is a function of this model: its value is no inertia");
            self.report.help(call.func.span(), message, "a shape needs its name for itself: rename the function");
            return None;
        }
        let Some((_, arguments)) = SHAPES.iter().find(|(known, _)| *known == name) else {
            let list: Vec<&str> = SHAPES.iter().map(|(known, _)| *known).collect();
            self.report.unknown(
                call.func.span(),
                format!("unknown shape `{name}`"),
                &name,
                list.iter().copied(),
                Some(format!("shapes are `{}`", list.join("`, `"))),
            );
            return None;
        };
        if call.args.len() != arguments.len() {
            self.report.error(
                at,
                format!(
                    "`{name}` takes {} arguments ({}), found {}",
                    arguments.len(),
                    arguments.join(", "),
                    call.args.len()
                ),
            );
            return None;
        }
        let form = || format!("write `{name}({})`", arguments.join(", "));
        for (expr, argument) in call.args.iter().zip(*arguments) {
            self.check_kind(expr, matches!(*argument, "axis" | "size"), context, &form)?;
        }
        let values: Vec<Option<Expr>> = call
            .args
            .iter()
            .zip(*arguments)
            .map(|(expr, argument)| {
                let value = match *argument {
                    "axis" => self.axis(expr, context),
                    "size" => self.vector(expr, context, Allowed::Inertia),
                    _ => self.scalar(expr, context, Allowed::Inertia),
                }?;
                self.begin_states(&value.expr);
                self.finite(&value)?;
                let quantity = match *argument {
                    "axis" => return Some(value.expr),
                    "mass" => MASS,
                    "length" | "radius" | "size" => LENGTH,
                    _ => INERTIA,
                };
                self.quantities.push((value.expr.clone(), quantity));
                Some(value.expr)
            })
            .collect();
        let values: Vec<Expr> = values.into_iter().collect::<Option<_>>()?;
        self.tensor(&name, values.as_slice(), at)
    }

    /// Refuses a scalar in the place of a `Vec3` and the other way round: arguments in another order.
    fn check_kind(
        &mut self,
        expr: &Written,
        wants_vector: bool,
        context: Context<'a>,
        form: &dyn Fn() -> String,
    ) -> Option<()> {
        if matches!(expr, Written::Verbatim(_)) {
            return Some(());
        }
        let value = self.value(expr, context)?;
        let vector = Type::Array(Box::new(Type::Scalar), 3);
        let is_vector = value.expr.ty == Type::Vec3 || value.expr.ty == vector;
        let (wanted, fits) = match wants_vector {
            true => (Type::Vec3, is_vector),
            false => (Type::Scalar, value.expr.ty == Type::Scalar),
        };
        if fits {
            return Some(());
        }
        let message = format!("expected {}, found {}", type_text(&wanted), type_text(&value.expr.ty));
        self.report.help(expr.span(), message, form());
        None
    }

    fn tensor(&mut self, name: &str, values: &[Expr], at: Span) -> Option<Tensor> {
        let s = Builder { at };
        let zero = || s.number(0.0);
        Some(match (name, values) {
            ("diag", [x, y, z]) => Box::new([x.clone(), y.clone(), z.clone(), zero(), zero(), zero()]),
            ("inertia", [xx, yy, zz, xy, xz, yz]) => {
                Box::new([xx.clone(), yy.clone(), zz.clone(), xy.clone(), xz.clone(), yz.clone()])
            }
            ("rod", [mass, length, axis]) => {
                let across = s.div(&s.mul(mass, &s.square(length)), 12.0);
                self.revolved(&zero(), &across, axis, s)?
            }
            ("cylinder", [mass, radius, length, axis]) => {
                let square = s.square(radius);
                let along = s.div(&s.mul(mass, &square), 2.0);
                let sum = s.add(&s.mul(&s.number(3.0), &square), &s.square(length));
                let across = s.div(&s.mul(mass, &sum), 12.0);
                self.revolved(&along, &across, axis, s)?
            }
            ("sphere", [mass, radius]) => {
                let moment = s.mul(&s.number(0.4), &s.mul(mass, &s.square(radius)));
                Box::new([moment.clone(), moment.clone(), moment, zero(), zero(), zero()])
            }
            ("cuboid", [mass, size]) => {
                let twelfth = s.div(mass, 12.0);
                let [x, y, z] = [0, 1, 2].map(|k| component_of(size, k).map(|e| s.square(&e)));
                let (x, y, z) = (x?, y?, z?);
                let moment = |a: &Expr, b: &Expr| s.mul(&twelfth, &s.add(a, b));
                Box::new([moment(&y, &z), moment(&z, &x), moment(&x, &y), zero(), zero(), zero()])
            }
            _ => return None,
        })
    }

    /// A body of revolution about `axis`, with its moments along and across it.
    fn revolved(&mut self, along: &Expr, across: &Expr, axis: &Expr, s: Builder) -> Option<Tensor> {
        let projector = self.projector(axis, s)?;
        let one = s.number(1.0);
        Some(Box::new(std::array::from_fn(|at| {
            let (row, column) = ENTRIES[at];
            let p = &projector[at];
            if row == column {
                s.add(&s.mul(across, &s.sub(&one, p)), &s.mul(along, p))
            } else {
                s.mul(&s.sub(along, across), p)
            }
        })))
    }

    /// `a a' / (a . a)`; exact numbers where the axis is one of X, Y, Z.
    fn projector(&mut self, axis: &Expr, s: Builder) -> Option<[Expr; 6]> {
        let [x, y, z] = [0, 1, 2].map(|k| component_of(axis, k));
        let parts = [x?, y?, z?];
        if let [Some(x), Some(y), Some(z)] = parts.each_ref().map(literal_value)
            && [x, y, z].iter().all(|x| x.is_finite())
        {
            let literal = [x, y, z];
            let length = dot(literal, literal);
            return Some(ENTRIES.map(|(r, c)| s.number(literal[r] * literal[c] / length)));
        }
        let [x, y, z] = parts.each_ref().map(|part| s.square(part));
        let length = s.add(&s.add(&x, &y), &z);
        Some(ENTRIES.map(|(r, c)| s.quotient(&s.mul(&parts[r], &parts[c]), &length)))
    }
}

fn literal_value(expr: &Expr) -> Option<f64> {
    match &*expr.node {
        ExprNode::Number(x) => Some(*x),
        _ => None,
    }
}

/// Sums and products without the zeros and ones that shapes are full of.
#[derive(Clone, Copy)]
struct Builder {
    at: Span,
}

impl Builder {
    fn number(self, value: f64) -> Expr {
        number(value, self.at)
    }

    fn node(self, node: ExprNode) -> Expr {
        new_expr(node, Type::Scalar, self.at)
    }

    fn is(a: &Expr, value: f64) -> bool {
        literal_value(a) == Some(value)
    }

    fn add(self, a: &Expr, b: &Expr) -> Expr {
        if Self::is(a, 0.0) {
            return b.clone();
        }
        if Self::is(b, 0.0) {
            return a.clone();
        }
        self.node(ExprNode::Add(a.clone(), b.clone()))
    }

    fn sub(self, a: &Expr, b: &Expr) -> Expr {
        if Self::is(b, 0.0) {
            return a.clone();
        }
        if let (Some(a), Some(b)) = (literal_value(a), literal_value(b)) {
            return self.number(a - b);
        }
        if Self::is(a, 0.0) {
            return self.node(ExprNode::Neg(b.clone()));
        }
        self.node(ExprNode::Sub(a.clone(), b.clone()))
    }

    fn mul(self, a: &Expr, b: &Expr) -> Expr {
        if Self::is(a, 0.0) || Self::is(b, 0.0) {
            return self.number(0.0);
        }
        if Self::is(a, 1.0) {
            return b.clone();
        }
        if Self::is(b, 1.0) {
            return a.clone();
        }
        self.node(ExprNode::Mul(a.clone(), b.clone()))
    }

    fn square(self, a: &Expr) -> Expr {
        self.mul(a, a)
    }

    fn div(self, a: &Expr, by: f64) -> Expr {
        self.quotient(a, &self.number(by))
    }

    fn quotient(self, a: &Expr, b: &Expr) -> Expr {
        if Self::is(a, 0.0) {
            return self.number(0.0);
        }
        self.node(ExprNode::Div(a.clone(), b.clone()))
    }
}
