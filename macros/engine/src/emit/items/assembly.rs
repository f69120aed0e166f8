//! Stage `emit`: `Model::assembly_modes`, which goes through all points and sides that tell a mode.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::contracts::function::FunctionKind;
use crate::emit::methods::functions;
use crate::emit::{Context, document, names};
use crate::mechanics::loops::structure::Modes;
use crate::model::types::Coordinate;

/// Name of the method.
pub(super) const NAME: &str = "assembly_modes";

/// Expands to `pub fn assembly_modes(..)` where it is asked for.
pub(super) fn items(context: &Context<'_>) -> Option<TokenStream> {
    let layout = &context.layout;
    let krate = layout.krate();
    context.function(FunctionKind::Assembly)?;
    let condition = context.function(FunctionKind::AssemblyCondition);
    let found = layout.model.assembly.iter().flat_map(|wanted| &wanted.find);
    let found: Vec<String> = found.map(|c| format!("`{}`", document::code(&layout.coordinate(*c)))).collect();
    let count = Literal::usize_unsuffixed(found.len());
    // Of a model with mistakes nobody knows how many there are.
    let unknown = Modes { sides: 0, roots: 0, choices: 0 };
    let Modes { sides, roots, choices } = layout.structure.modes.unwrap_or(unknown);
    let modes = roots.max(1) << sides;
    let docs = document::attributes(&document::assembly_modes(&found, layout.structure.modes));
    let turning = |c: &Coordinate| !layout.model.joints[c.joint].kind.is_slide(c.index);
    let wanted = layout.model.assembly.iter().flat_map(|wanted| &wanted.find);
    let angles = wanted.take(64).enumerate().fold(0_u64, |bits, (k, c)| bits | u64::from(turning(c)) << k);
    let angles = Literal::u64_unsuffixed(angles);
    let [samples, points, choices, modes] = [roots + 1, roots, 1 << choices, modes].map(Literal::usize_unsuffixed);
    let [t, q, alternative] = ["t", "q", "alternative"].map(names::ident);
    let call = |kind: FunctionKind| {
        let name = names::ident(&functions::name(layout.model, kind));
        quote!(|#alternative| self.#name(#t, #q, #alternative))
    };
    let mode = call(FunctionKind::Assembly);
    let body = match condition {
        _ if context.hollow => quote!(::core::unimplemented!()),
        Some(_) => {
            let condition = call(FunctionKind::AssemblyCondition);
            quote!(#krate::assembly::modes_by_points::<T, #samples, #points, #choices, #modes, #angles, #count>(#condition, #mode))
        }
        None => quote!(#krate::assembly::modes_by_sides::<T, #modes, #angles, #count>(#mode)),
    };
    let at = layout.model.assembly.as_ref().map(|wanted| wanted.span);
    let name = at.map_or_else(|| names::ident(NAME), |span| names::at(span, NAME));
    let parameters = if context.hollow {
        let [t, q] = ["_t", "_q"].map(names::ident);
        quote!(#t: T, #q: &Position<T>)
    } else {
        quote!(#t: T, #q: &Position<T>)
    };
    Some(quote! {
        impl<T: Real> Model<T> {
            #docs
            #[must_use]
            pub fn #name(&self, #parameters) -> [#krate::AssemblyMode<T, #count>; #modes] { #body }
        }
    })
}
