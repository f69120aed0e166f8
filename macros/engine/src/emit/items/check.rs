//! Stage `emit`: `Params::check`: what values other than the declared ones can break, and what the scalar can't hold.
//!
//! Numbers of the model are compared with what the scalar makes of them; every parameter must be finite; masses and inertias,
//! with states where they start, and lengths must be such as there are; then come the tests that were derived: pivots of the mass matrix and loops at
//! the default position. A body whose inertia no body can have at the declared values already carries
//! `#[allow(unphysical_inertia)]`, since the checker refuses it otherwise; its inertia is not checked here.

mod lower;
mod numeric;

use proc_macro2::TokenStream;
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::contracts::symbol::Symbol;
use crate::emit::document::formula;
use crate::emit::items::system;
use crate::emit::layout::Layout;
use crate::emit::layout::places::RESERVED;
use crate::emit::methods::functions;
use crate::emit::print::blocks::body;
use crate::emit::print::expressions::Names;
use crate::emit::print::{literals, range};
use crate::emit::{Context, names};
use crate::mechanics::Condition;
use crate::mechanics::loops::constraints::unfit;
use crate::model::types::{Body, Comparison, ConstraintKind, Expr, ExprNode, ForceKind, Model, ParamId};
use crate::optimize::program::Expression;

/// Expands to `impl<T: Real> Params<T> { pub fn check(&self) -> Result<(), ParamError> { .. } }`.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let print = Names { layout, locals: &[], fields: &[], stored: None, commented: context.commented, packed: None };
    let mut checks = TokenStream::new();
    for value in range::beyond_single(context) {
        let what = format!("the number {} of this model is out of the range of the scalar", literals::text(value));
        let value = literals::number(value);
        checks.extend(quote! {
            if !#krate::all(#krate::is_held::<T>(#value)) {
                return Err(#krate::ParamError { what: #what });
            }
        });
    }
    let mut reads = false;
    for (number, param) in layout.model.params.iter().enumerate() {
        let count = param.ty.scalars();
        if count == 0 {
            continue;
        }
        reads = true;
        let what = format!("`{}` is not finite", layout.name(&param.place));
        let values = (0..count).map(|element| {
            let symbol = Expression::Symbol(Symbol::Param { param: ParamId(number), element });
            let value = print.expression(&symbol);
            quote!(Real::is_finite(#value))
        });
        checks.extend(quote! {
            if !#krate::all(#(#values)&*) {
                return Err(#krate::ParamError { what: #what });
            }
        });
        // A default that the scalar turned into something else, where it still stands.
        for (element, &default) in param.default.iter().enumerate().filter(|(_, x)| range::is_beyond(**x)) {
            let what = format!(
                "`{}` is declared as {}, which is out of the range of the scalar",
                layout.name(&param.place),
                literals::text(default)
            );
            let symbol = Expression::Symbol(Symbol::Param { param: ParamId(number), element });
            let (value, default) = (print.expression(&symbol), literals::number(default));
            checks.extend(quote! {
                if !#krate::all(#krate::is_held::<T>(#default) | !Real::eq(#value, T::lit(#default))) {
                    return Err(#krate::ParamError { what: #what });
                }
            });
        }
    }
    for (length, least, name) in lengths(layout) {
        let what = format!("the length of `{name}` is {least}");
        let length = print.expression(&length);
        let holds = if least == "negative" { quote!(Real::ge) } else { quote!(Real::gt) };
        checks.extend(quote! {
            if !#krate::all(#holds(#length, T::lit(0.0))) {
                return Err(#krate::ParamError { what: #what });
            }
        });
    }
    for body in &layout.model.bodies {
        let name = layout.name(&body.place);
        if let Some(mass) = adjustable(layout.model, &body.mass) {
            let what = format!("the mass of `{name}` is negative or not finite");
            let mass = print.expression(&mass);
            checks.extend(quote! {
                {
                    let mass = #mass;
                    if !#krate::all(Real::ge(mass, T::lit(0.0)) & Real::is_finite(mass)) {
                        return Err(#krate::ParamError { what: #what });
                    }
                }
            });
        }
        if let Some(inertia) = inertia(layout.model, body) {
            let what = format!("no rigid body can have the inertia of `{name}`");
            let entries = inertia.iter().map(|entry| print.expression(entry));
            checks.extend(quote! {
                if #krate::any(#krate::inertia_violation(#(#entries),*)) {
                    return Err(#krate::ParamError { what: #what });
                }
            });
        }
    }
    for condition in assumed(layout.model) {
        let what = format!("`{}` does not hold", formula::text(layout, condition));
        let holds = adjustable(layout.model, condition).map(|condition| print.expression(&condition));
        checks.extend(holds.map(|holds| {
            quote! {
                if !#krate::all(#holds) {
                    return Err(#krate::ParamError { what: #what });
                }
            }
        }));
    }
    checks.extend(derived(context));
    checks.extend(iterated(context));
    let params = names::ident("params");
    let open = reads.then(|| quote!(let #params = self;));
    quote! {
        impl<T: Real> Params<T> {
            /// Whether a mechanism can have these parameters: they are finite, masses, inertias and lengths are such as
            /// there are, the mass matrix is regular at the default position and loops with conditions have a solution
            /// there, and the scalar holds the numbers of the model.
            ///
            /// # Errors
            ///
            /// Names the first parameter, body, coordinate or number for which that is not so.
            pub fn check(&self) -> Result<(), #krate::ParamError> {
                #open
                #checks
                Ok(())
            }
        }
    }
}

/// What is assumed, one by one.
fn assumed(model: &Model) -> Vec<&Expr> {
    let (mut all, mut stack) = (Vec::new(), model.assumptions.iter().rev().collect::<Vec<_>>());
    while let Some(condition) = stack.pop() {
        match &*condition.node {
            ExprNode::And(a, b) => stack.extend([b, a]),
            // Numbers are rounded, and not in the same way for every scalar.
            ExprNode::Compare(Comparison::Equal | Comparison::NotEqual, ..) => {}
            _ => all.push(condition),
        }
    }
    all
}

/// Lengths that parameters change: of rods, which are positive, and of springs between points.
fn lengths(layout: &Layout<'_>) -> Vec<(Expression, &'static str, String)> {
    let model = layout.model;
    let rods = model.constraints.iter().filter_map(|constraint| match &constraint.kind {
        ConstraintKind::Rod { length, .. } => {
            Some((adjustable(model, length)?, "not positive", layout.name(&constraint.place)))
        }
        ConstraintKind::Value(_) | ConstraintKind::Rate(_) => None,
    });
    let springs = model.forces.iter().filter_map(|force| match &force.kind {
        ForceKind::LineSpring { length: Some(length), .. } => {
            let length = Some(length).filter(|length| !length.follows_states())?;
            Some((adjustable(model, length)?, "negative", layout.name(&force.place)))
        }
        ForceKind::LineSpring { length: None, .. }
        | ForceKind::Effort { .. }
        | ForceKind::JointSpring { .. }
        | ForceKind::Force { .. }
        | ForceKind::Torque { .. } => None,
    });
    rods.chain(springs).collect()
}

/// Expands to the statements of the derived tests and what they demand.
fn derived(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let checks = &context.compiled.checks;
    if checks.list.is_empty() || context.hollow {
        return TokenStream::new();
    }
    let locals = names::unique(checks.program.locals.iter().map(String::as_str), RESERVED);
    let body = body(
        &checks.program,
        &Names { layout, locals: &locals, fields: &[], stored: None, commented: context.commented, packed: None },
    );
    let mut values = body.results.into_iter();
    let mut tests = TokenStream::new();
    for (what, condition, count) in &checks.list {
        let values: Vec<TokenStream> = values.by_ref().take(*count).collect();
        let holds = match (condition, &values[..]) {
            (Condition::Pivot, [pivot, whole]) => {
                quote!(Real::gt(#pivot, T::lit(64.0) * T::epsilon() * (#whole)))
            }
            (Condition::Small, _) => quote!(#(Real::lt(Real::abs(#values), Real::sqrt(T::epsilon())))&*),
            _ => quote!(#(Real::is_finite(#values))&*),
        };
        tests.extend(quote! {
            if !#krate::all(#holds) {
                return Err(#krate::ParamError { what: #what });
            }
        });
    }
    let statements = body.statements;
    quote!(#statements #tests)
}

/// Expands to the test of equations that parameters make hold, where Newton's method closes the loops at the default
/// position, lane by lane: where it finds no solution nothing is known. Both are judged as at a start.
fn iterated(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    let close = functions::arguments(context.function(FunctionKind::Guess)?);
    let (passed, arguments) = system::call_granted(context)?;
    if context.hollow || close.has_input() || arguments.has_input() {
        return None;
    }
    let closing = close.pass();
    let [t, state] = ["t", "state"].map(names::ident);
    let names = system::granted_names(layout);
    let messages = names.iter().map(|name| unfit(name));
    let opening = system::iterations(layout);
    Some(quote! {
        {
            let model = Model::new(self);
            let (#t, #state) = (T::lit(0.0), &State::<T>::default());
            let closed = model.close(#closing);
            let #state = &closed.state;
            let left = model.granted(#passed);
            let unknown = #opening.open_lanes();
            for (&left, (name, what)) in left.as_slice().iter().zip([#((#names, #messages)),*]) {
                let open = #krate::Opening::of_equation(left, name).open_lanes();
                if !#krate::all(!open | unknown) {
                    return Err(#krate::ParamError { what });
                }
            }
        }
    })
}

/// An expression that parameters change.
fn adjustable(model: &Model, expr: &Expr) -> Option<Expression> {
    let expression = lower::scalar(model, expr)?;
    let mut reads = false;
    expression.each_leaf(&mut |leaf| reads |= matches!(leaf, Expression::Symbol(_)));
    reads.then_some(expression)
}

/// xx, yy, zz, xy, xz, yz where parameters change them and the declared values are legal.
fn inertia(model: &Model, body: &Body) -> Option<Vec<Expression>> {
    let entries = body.inertia.as_deref()?;
    if !entries.iter().any(|entry| adjustable(model, entry).is_some()) {
        return None;
    }
    let entries: Vec<Expression> = entries.iter().map(|entry| lower::scalar(model, entry)).collect::<Option<_>>()?;
    let declared: Vec<f64> = entries.iter().map(|entry| numeric::value(model, entry)).collect::<Option<_>>()?;
    is_legal(&declared).then_some(entries)
}

/// As the runtime's `inertia_violation` sees it.
fn is_legal(entries: &[f64]) -> bool {
    let [xx, yy, zz, xy, xz, yz] = *entries else {
        return false;
    };
    let trace = xx + yy + zz;
    let half = 0.5 * trace + 1e-9 * trace + f64::from(f32::MIN_POSITIVE);
    let (a, b, c) = (half - xx, half - yy, half - zz);
    let (l, m) = (-xy / a, -xz / a);
    let (d, e, f) = (b + l * xy, -yz + l * xz, c + m * xz);
    a > 0.0 && d > 0.0 && f - e / d * e > 0.0 && trace.is_finite()
}
