//! Room `references`: names inside a call.
//!
//! In: the references of a call. Out: an enum of each module's names, with their documentation, and a path to one of them, or
//! to a word of the language that the runtime documents, for each use.
//!
//! Completion expands a call twice, as it is and with a word at the cursor, and compares both by the offsets of tokens. So this stands
//! before all else that is generated, says the same of a model with mistakes as of one without, and keeps the order of the text.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::Path;

use crate::emit::{document, names};
use crate::model::references::{Declared, Module, References, Use, words};
use crate::rust_keywords::is_keyword;

/// Expands to `const _: () = { enum Modules { leg, .. } enum NamesOf0 { .. } const _: () = { .. }; .. };`; where `all` is not
/// said, without what leads nowhere.
pub fn names(references: &References, all: bool) -> TokenStream {
    let writer = Writer { references, all };
    let modules = || references.modules.iter().enumerate();
    let variants = modules().filter(|(index, module)| writer.is_first(*index, module)).map(|(_, module)| {
        let docs = document::attributes(&document::item(&module.docs, if module.is_part { "part" } else { "model" }));
        let name = names::field(&module.name);
        quote!(#docs #name,)
    });
    let enums = modules().map(|(index, _)| writer.declare(index));
    let uses = modules().filter(|(_, module)| !module.is_foreign).map(|(_, module)| writer.uses(module));
    quote! {
        const _: () = {
            enum Modules { #(#variants)* }
            #(#enums)*
            #(#uses)*
        };
    }
}

struct Writer<'a> {
    references: &'a References,
    all: bool,
}

impl Writer<'_> {
    /// Whether no module before has the same name, of which `cfg` may take one away.
    fn is_first(&self, index: usize, module: &Module) -> bool {
        self.references.called(&module.name).first() == Some(&index) && is_written(&module.name)
    }

    fn krate(&self) -> &Path {
        &self.references.krate
    }

    /// Expands to `enum NamesOf0 { /// .. length(::multibody::words::name::Param), .. }`.
    fn declare(&self, index: usize) -> TokenStream {
        let Some(module) = self.references.modules.get(index) else { return TokenStream::new() };
        let krate = self.krate();
        let all = enum_of(index);
        let variants = module.declared.iter().filter(|declared| is_written(&declared.name) && !declared.hidden);
        let variants = variants.map(|Declared { name, docs, room, word, .. }| {
            let docs = document::attributes(&document::item(docs, &word.to_lowercase()));
            let (name, room, word) = (names::field(name), names::ident(room), names::ident(word));
            quote!(#docs #name(#krate::words::#room::#word),)
        });
        // Outputs have names of their own: what else is called so is what the name means.
        let hidden: Vec<TokenStream> = module
            .declared
            .iter()
            .filter(|declared| is_written(&declared.name) && declared.hidden && declared.word == "Output")
            .map(|Declared { name, docs, .. }| {
                let docs = document::attributes(&document::item(docs, "output"));
                let name = names::field(name);
                quote!(#docs #name(#krate::words::name::Output),)
            })
            .collect();
        let outputs = names::ident(&format!("OutputsOf{index}"));
        let hidden = (!hidden.is_empty()).then(|| quote!(enum #outputs { #(#hidden)* }));
        quote!(enum #all { #(#variants)* } #hidden)
    }

    /// Expands to `const _: () = { fn uses<A: ::multibody::words::Never>() { .. } };`.
    fn uses(&self, module: &Module) -> TokenStream {
        let krate = self.krate();
        let uses = self.statements(&module.uses);
        quote! {
            const _: () = {
                fn uses<A: #krate::words::Never>() { #uses }
            };
        }
    }

    fn statements(&self, uses: &[Use]) -> TokenStream {
        uses.iter().map(|used| self.statement(used)).collect()
    }

    /// Expands to `let _ = NamesOf0::length;` and the like.
    fn statement(&self, used: &Use) -> TokenStream {
        let krate = self.krate();
        match used {
            Use::Name { module, name, is_known } if (*is_known || self.all) && is_written(name) => {
                let (all, name) = (enum_of(*module), names::field(name));
                quote!(let _ = #all::#name;)
            }
            Use::Module { name, is_known } if (*is_known || self.all) && is_written(name) => {
                let name = names::field(name);
                quote!(let _ = Modules::#name;)
            }
            Use::Word { room, word, fields } => {
                let known = words::fields(room, &word.to_string());
                if (known.is_none() && !self.all) || !is_written(word) {
                    return TokenStream::new();
                }
                let known = known.unwrap_or_default();
                let given = fields.iter().filter(|name| self.all || known.contains(&name.to_string().as_str()));
                let given = given.filter(|name| is_written(name)).map(names::field);
                let (room, word) = (names::ident(room), names::field(word));
                quote!(let #krate::words::#room::#word { #(#given: _,)* .. } = A::any();)
            }
            Use::Local { name, word, uses } => {
                let inside = self.statements(uses);
                if !is_written(name) || may_be_constant(name) {
                    return inside;
                }
                let (name, word) = (names::field(name), names::ident(word));
                quote!({ let #name: #krate::words::name::#word = A::any(); #inside })
            }
            Use::OfLocal(name) if is_written(name) && !may_be_constant(name) => {
                let name = names::field(name);
                quote!(let _ = #name;)
            }
            Use::Name { .. } | Use::Module { .. } | Use::OfLocal(_) => TokenStream::new(),
        }
    }
}

/// The enum of a module's names.
fn enum_of(module: usize) -> Ident {
    Ident::new(&format!("NamesOf{module}"), Span::mixed_site())
}

/// Whether a token of the user's can stand for a name in Rust; what can't has been reported.
fn is_written(name: &Ident) -> bool {
    let text = name.to_string();
    text != "_" && !is_keyword(&text)
}

/// As a pattern such a name would be a constant of the user's around the call, if there is one.
fn may_be_constant(name: &Ident) -> bool {
    name.to_string().trim_start_matches("r#").starts_with(char::is_uppercase)
}
