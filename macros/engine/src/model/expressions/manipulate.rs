//! Stage `model`: expressions made of expressions.
//!
//! In: `diff(x, hinge)`, `substitute(x, push = 0.0)`, `mass_matrix[a, b]`, `bias[a]`, `constraint[pin.x]`, `jacobian[pin.x, a]`,
//! `closed(stroke)`. Out: typed nodes. They are taken in
//! finished equations, so nothing that decides positions may use them; and what follows from forces or is an acceleration is
//! not known in them, and can't be taken apart.

use proc_macro2::{Ident, Span};
use syn::spanned::Spanned;
use syn::{Expr, ExprIndex};

use crate::model::checker::{Checker, Context, Meaning};
use crate::model::names::MATRICES;
use crate::model::typed::{Class, Typed, Uses, type_text};
use crate::model::types::{Coordinate, Expr as Checked, ExprNode, LoopClosure, Order, Type, Variable};

use super::{source_text, span};

const VARIABLES: &str = "there are coordinates, their rates, states, parameters, inputs, and `t`";

impl<'a> Checker<'a, '_> {
    /// `diff(value, variable)`: the partial derivative; by `t` the total one.
    pub(super) fn diff(&mut self, name: &Ident, arguments: &[&Expr], at: Span, context: Context<'a>) -> Option<Typed> {
        let [of, by] = arguments else {
            self.report.help(at, "`diff` takes a value and a variable", "write `diff(expression, hinge)`");
            return None;
        };
        let of = self.taken_apart(name, of, context);
        let by = self.variable(by, context);
        let (of, by) = (of?, by?);
        // Rates of states may read all that forces do, so they count with accelerations.
        let moving = [Class::Own, Class::State];
        let accelerated = by == Variable::Time && moving.into_iter().any(|class| of.uses.culprit(class).is_some());
        if by == Variable::Time
            && let Some((span, subject)) = of.uses.culprit(Class::Input)
        {
            let message = format!("{subject} is an input: its rate is not known, so there is no derivative by time");
            self.report.error(span, message);
            return None;
        }
        if !self.has_slopes(&of.expr, name) {
            return None;
        }
        let ty = of.expr.ty.clone();
        let node = ExprNode::Derivative { of: of.expr.clone(), by, accelerated };
        let mut value = self.build(node, ty, at, &[&of])?;
        value.uses.add(Class::Finished, "diff", name.span());
        if by == Variable::Time {
            value.uses.add(Class::State, "diff", name.span());
        }
        if accelerated {
            value.uses.add(Class::Acceleration, "diff", name.span());
        }
        Some(value)
    }

    /// `substitute(value, variable = value, ..)`: all at once.
    pub(super) fn substitute(
        &mut self,
        name: &Ident,
        arguments: &[&Expr],
        at: Span,
        context: Context<'a>,
    ) -> Option<Typed> {
        const FORM: &str = "write `substitute(expression, hinge.rate = 0.0)`";
        let [of, put @ ..] = arguments else {
            self.report.help(at, "`substitute` takes a value and what to put in", FORM);
            return None;
        };
        let of = self.taken_apart(name, of, context);
        if put.is_empty() {
            self.report.help(at, "nothing is put in", FORM);
            return None;
        }
        let mut pairs: Vec<(Variable, Typed)> = Vec::new();
        let mut complete = true;
        for pair in put {
            let Expr::Assign(pair) = pair else {
                self.report.help(span(pair), "expected `variable = value`", FORM);
                complete = false;
                continue;
            };
            let variable = self.variable(&pair.left, context);
            let value = self.scalar_apart(name, &pair.right, context);
            let (Some(variable), Some(value)) = (variable, value) else {
                complete = false;
                continue;
            };
            if pairs.iter().any(|known| known.0 == variable) {
                self.report.error(span(&pair.left), "this variable is named twice");
                complete = false;
                continue;
            }
            pairs.push((variable, value));
        }
        let of = of.filter(|_| complete)?;
        let parts: Vec<&Typed> = std::iter::once(&of).chain(pairs.iter().map(|pair| &pair.1)).collect();
        let listed = pairs.iter().map(|(variable, value)| (*variable, value.expr.clone())).collect();
        let node = ExprNode::Substituted { of: of.expr.clone(), pairs: listed };
        let mut value = self.build(node, of.expr.ty.clone(), at, &parts)?;
        value.uses.add(Class::Finished, "substitute", name.span());
        Some(value)
    }

    /// What can be taken apart: numbers of positions, velocities, states, parameters, inputs and time.
    fn taken_apart(&mut self, name: &Ident, expr: &Expr, context: Context<'a>) -> Option<Typed> {
        let value = self.value(expr, context)?;
        if !has_parts(&value.expr.ty) {
            let message = format!("`{name}` takes numbers and vectors, found {}", type_text(&value.expr.ty));
            self.report.help(span(expr), message, "take `.position`, an entry, or a component of it");
            return None;
        }
        for class in [Class::Acceleration, Class::Load] {
            if let Some((at, subject)) = value.uses.culprit(class) {
                let message = format!("{subject} follows from the equations of motion: `{name}` can't take it apart");
                self.report.help(
                    at,
                    message,
                    "`emit linearize` differentiates outputs, accelerations and reactions too",
                );
                return None;
            }
        }
        Some(value)
    }

    fn scalar_apart(&mut self, name: &Ident, expr: &Expr, context: Context<'a>) -> Option<Typed> {
        let value = self.taken_apart(name, expr, context)?;
        if value.expr.ty != Type::Scalar {
            self.report.error(span(expr), format!("expected a scalar, found {}", type_text(&value.expr.ty)));
            return None;
        }
        Some(value)
    }

    /// The same, or all scalars of a parameter or an input, with the type of what is put in.
    pub(super) fn variables(&mut self, expr: &Expr, context: Context<'a>) -> Option<(Vec<Variable>, Type)> {
        if let Meaning::Value(value) = self.meaning(expr, context)?
            && value.expr.ty != Type::Scalar
            && let Some((node, first)) = place_of(&value.expr)
        {
            let places = first..first + value.expr.ty.scalars();
            let all = places.map(|place| match *node {
                ExprNode::Param(id) => Some(Variable::Param(id, place)),
                ExprNode::Input(id) => Some(Variable::Input(id, place)),
                _ => None,
            });
            return Some((all.collect::<Option<_>>()?, value.expr.ty));
        }
        Some((vec![self.variable(expr, context)?], Type::Scalar))
    }

    /// A coordinate, rate, state, parameter, input, or time.
    fn variable(&mut self, expr: &Expr, context: Context<'a>) -> Option<Variable> {
        let meaning = self.meaning(expr, context)?;
        let found = match &meaning {
            Meaning::Joint(joint) if self.joint_kind(*joint)?.freedoms() == 1 => {
                Some(Variable::Coordinate(Coordinate { joint: *joint, index: 0 }, Order::Position))
            }
            Meaning::Coordinate(joint, index) => {
                Some(Variable::Coordinate(Coordinate { joint: *joint, index: *index }, Order::Position))
            }
            Meaning::Value(value) => variable_of(&value.expr),
            _ => None,
        };
        match found {
            Some(Variable::Coordinate(_, Order::Acceleration)) => {
                self.report.help(span(expr), "accelerations are no variables: they follow from all others", VARIABLES);
                None
            }
            Some(Variable::Coordinate(coordinate, _)) => {
                self.uses_coordinates(coordinate.joint, span(expr));
                found
            }
            Some(_) => found,
            None => {
                let what = match expr {
                    Expr::Path(_) | Expr::Lit(_) | Expr::Field(_) | Expr::Index(_) => {
                        format!("`{}`", source_text(expr))
                    }
                    _ => "this expression".to_owned(),
                };
                self.report.help(span(expr), format!("{what} is no variable"), VARIABLES);
                None
            }
        }
    }

    /// Which matrix a name stands for where nothing has been declared of that name.
    pub(super) fn matrix_name(&self, expr: &Expr, context: Context<'a>) -> Option<&'static str> {
        let Expr::Path(path) = expr else { return None };
        let name = path.path.get_ident()?.to_string();
        let declared = self.scopes[context.scope].symbol(&name).is_some() || self.locals(context).contains(&name);
        MATRICES.into_iter().find(|known| *known == name && !declared)
    }

    /// `closed(stroke)`: a coordinate for which there is a formula.
    pub(super) fn closed(
        &mut self,
        name: &Ident,
        arguments: &[&Expr],
        at: Span,
        context: Context<'a>,
    ) -> Option<Typed> {
        let &[written] = arguments else {
            self.report.help(at, "`closed` takes a coordinate", "write `closed(stroke)`");
            return None;
        };
        let Variable::Coordinate(coordinate, Order::Position) = self.variable(written, context)? else {
            self.report.error(span(written), format!("`{}` is no coordinate", source_text(written)));
            return None;
        };
        let mut uses = Uses::of(Class::Position, "closed", name.span());
        uses.add(Class::Finished, "closed", name.span());
        Some(Typed::leaf(ExprNode::Closed(coordinate), Type::Scalar, at).with(uses))
    }

    /// `constraint[ball.x]`, `jacobian[ball.x, crank]`: an equation that closes a loop, and its slope along a coordinate.
    fn entry_of_constraints(
        &mut self,
        matrix: &'static str,
        indices: &[&Expr],
        at: &ExprIndex,
        context: Context<'a>,
    ) -> Option<Typed> {
        let (row, column) = match (matrix, indices) {
            ("constraint", &[row]) => (row, None),
            ("jacobian", &[row, column]) => (row, Some(column)),
            _ => {
                let form =
                    if matrix == "jacobian" { "write `jacobian[ball.x, hinge]`" } else { "write `constraint[ball.x]`" };
                let message = format!("`{matrix}` has no entry of {} indices", indices.len());
                self.report.help(span(&at.index), message, form);
                return None;
            }
        };
        let row = self.row(row, context);
        let column = column.map(|column| self.entry_coordinate(matrix, column, context));
        let (closing, component) = row?;
        let residual = ExprNode::Residual { closing, component };
        let mut uses = Uses::of(Class::Position, matrix, span(&at.expr));
        uses.add(Class::Finished, matrix, span(&at.expr));
        let residual = Typed::leaf(residual, Type::Scalar, at.span()).with(uses);
        let Some(column) = column else { return Some(residual) };
        let by = Variable::Coordinate(column?, Order::Position);
        let node = ExprNode::Derivative { of: residual.expr.clone(), by, accelerated: false };
        self.build(node, Type::Scalar, at.span(), &[&residual])
    }

    /// An equation by its name: a constraint, or a component of what a joint closes.
    fn row(&mut self, expr: &Expr, context: Context<'a>) -> Option<(LoopClosure, Option<String>)> {
        if let Expr::Field(field) = expr
            && let syn::Member::Named(component) = &field.member
            && let Meaning::Joint(joint) = self.meaning(&field.base, context)?
        {
            return Some((LoopClosure::Cut(joint), Some(component.to_string())));
        }
        match self.meaning(expr, context)? {
            Meaning::Constraint(constraint) => Some((LoopClosure::Constraint(constraint), None)),
            Meaning::Joint(_) => {
                let text = source_text(expr);
                let message = format!("`{text}` closes its loop by several equations");
                self.report.help(span(expr), message, format!("name one, such as `{text}.x`"));
                None
            }
            _ => {
                let message = format!("`{}` is no constraint, and no joint that closes a loop", source_text(expr));
                self.report.error(span(expr), message);
                None
            }
        }
    }

    /// `mass_matrix[a, b]`, `bias[a]`, `constraint[rack]`, `jacobian[rack, a]`.
    pub(super) fn entry(&mut self, matrix: &'static str, index: &ExprIndex, context: Context<'a>) -> Option<Typed> {
        let at = index.span();
        let indices: Vec<&Expr> = match &*index.index {
            Expr::Tuple(several) => several.elems.iter().collect(),
            one => vec![one],
        };
        if matches!(matrix, "constraint" | "jacobian") {
            return self.entry_of_constraints(matrix, &indices, index, context);
        }
        // Whoever takes numbers for names takes them twice: said once.
        let coordinates = indices.iter().map(|index| self.entry_coordinate(matrix, index, context));
        let coordinates: Vec<Coordinate> = coordinates.collect::<Option<_>>()?;
        let (node, class) = match (matrix, coordinates.as_slice()) {
            ("mass_matrix", &[row, column]) => (ExprNode::MassMatrix([row, column]), Class::State),
            ("bias", &[row]) => (ExprNode::Bias(row), Class::Load),
            _ => {
                let form = if matrix == "bias" { "write `bias[hinge]`" } else { "write `mass_matrix[hinge, hinge]`" };
                let count = coordinates.len();
                self.report.help(span(&index.index), format!("`{matrix}` has no entry of {count} indices"), form);
                return None;
            }
        };
        let mut uses = Uses::of(class, matrix, span(&index.expr));
        uses.add(Class::Finished, matrix, span(&index.expr));
        Some(Typed::leaf(node, Type::Scalar, at).with(uses))
    }

    fn entry_coordinate(&mut self, matrix: &str, expr: &Expr, context: Context<'a>) -> Option<Coordinate> {
        match self.meaning(expr, context)? {
            Meaning::Joint(joint) if self.joint_kind(joint)?.freedoms() == 1 => {
                self.uses_coordinates(joint, span(expr));
                Some(Coordinate { joint, index: 0 })
            }
            Meaning::Coordinate(joint, index) => {
                self.uses_coordinates(joint, span(expr));
                Some(Coordinate { joint, index })
            }
            _ => {
                let message =
                    format!("`{}` is no coordinate: entries of `{matrix}` are named by them", source_text(expr));
                self.report.error(span(expr), message);
                None
            }
        }
    }
}

fn has_parts(ty: &Type) -> bool {
    match ty {
        Type::Scalar | Type::Vec3 | Type::Twist | Type::Wrench => true,
        Type::Array(element, _) => has_parts(element),
        Type::Bool | Type::Rotation | Type::Pose | Type::Jacobian => false,
    }
}

/// The variable that an expression is.
fn variable_of(expr: &Checked) -> Option<Variable> {
    match &*expr.node {
        ExprNode::Time => Some(Variable::Time),
        &ExprNode::Coordinate { joint, index, order } => Some(Variable::Coordinate(Coordinate { joint, index }, order)),
        &ExprNode::State(id) => Some(Variable::State(id)),
        _ if expr.ty == Type::Scalar => match place_of(expr)? {
            (&ExprNode::Param(id), place) => Some(Variable::Param(id, place)),
            (&ExprNode::Input(id), place) => Some(Variable::Input(id, place)),
            _ => None,
        },
        _ => None,
    }
}

/// A declared value with the place of a part of it among its scalars.
fn place_of(expr: &Checked) -> Option<(&ExprNode, usize)> {
    match &*expr.node {
        node @ (ExprNode::Param(_) | ExprNode::Input(_)) => Some((node, 0)),
        ExprNode::Index(base, index) | ExprNode::Component(base, index) => {
            let (node, first) = place_of(base)?;
            Some((node, first + index * expr.ty.scalars()))
        }
        _ => None,
    }
}
