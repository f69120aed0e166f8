//! Stage `emit`: the equations as constants, where the model asks for them.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Context;
use crate::model::types::Request;
use crate::symbolic::write::{latex, text};

/// Expands to `pub const FORMULAS: &[Equation] = &[..];`.
pub(super) fn items(context: &Context<'_>) -> TokenStream {
    let layout = &context.layout;
    let krate = layout.krate();
    let asked = layout.model.emit.contains(&Request::Equations);
    let Some(page) = layout.structure.page.as_ref().filter(|_| asked && !context.hollow) else {
        // Beside errors the name is there for those who read it.
        return if asked {
            quote!(#[doc = "Equations."] pub const FORMULAS: &[#krate::Equation] = &[];)
        } else {
            quote!()
        };
    };
    let equations = page
        .sections
        .iter()
        .flat_map(|section| page.folded(section).into_iter().map(|line| (section.title, line.line)));
    let equations = equations.map(|(section, line)| {
        let (text, latex) = (text::equation(&line.equation), latex::equation(&line.equation));
        let says = line.says.unwrap_or_default().replace('`', "");
        quote!(#krate::Equation { section: #section, text: #text, latex: #latex, says: #says })
    });
    quote! {
        /// The equations of the model, those of identical parts once. Each stands after those that it reads, but for equations of
        /// motion in the names of their parts, which stand before these.
        pub const FORMULAS: &[#krate::Equation] = &[#(#equations),*];
    }
}
