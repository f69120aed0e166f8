//! Stage `emit`: `Params::check`: masses and inertias at values other than the declared ones.
//!
//! A body whose inertia no body can have at the declared values already carries `#[allow(unphysical_inertia)]`, since the
//! checker refuses it otherwise; it is not checked here.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::blocks::each_leaf;
use crate::emit::expressions::Names;
use crate::emit::{Context, lower, names, numeric};
use crate::model::types::{Body, Expr, Model};
use crate::optimize::program::Expression;

/// Expands to `impl<T: Real> Params<T> { pub fn check(&self) -> Result<(), ParamError> { .. } }`.
pub(super) fn item(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let print = Names { layout, locals: &[], fields: &[] };
    let mut checks = TokenStream::new();
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
    let params = names::ident("params");
    let open = (!checks.is_empty()).then(|| quote!(let #params = self;));
    quote! {
        impl<T: Real> Params<T> {
            /// Whether rigid bodies can have the masses and inertias that follow from these parameters.
            ///
            /// # Errors
            ///
            /// Names the first body whose mass or inertia is impossible.
            pub fn check(&self) -> Result<(), #krate::ParamError> {
                #open
                #checks
                Ok(())
            }
        }
    }
}

/// An expression that parameters change.
fn adjustable(model: &Model, expr: &Expr) -> Option<Expression> {
    let expression = lower::scalar(model, expr)?;
    let mut reads = false;
    each_leaf(&expression, &mut |leaf| reads |= matches!(leaf, Expression::Symbol(_)));
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
