//! Stage `emit`: parts for other calls.
//!
//! In: the parts of a call that are not private. Out: of each one a declarative macro that hands the part's tokens to the call
//! that uses it; `syntax/imports` says how. Its name in rustdoc is the part's, with the part's documentation.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use syn::Visibility;

use super::{document, names};
use crate::model::exports::{Export, Shown};

/// Expands to `macro_rules! __multibody_leg_0f.. { .. } pub use __multibody_leg_0f.. as leg;` for each part.
///
/// Exported macros of a crate need different names: `suffix` is another one for each call.
pub fn exports(exports: impl IntoIterator<Item = Export>, suffix: &str) -> TokenStream {
    exports.into_iter().map(|export| macro_of(&export, suffix)).collect()
}

fn macro_of(export: &Export, suffix: &str) -> TokenStream {
    let Export { vis, tokens, .. } = export;
    let hidden: Ident = format_ident!("__multibody_part_{}_{suffix}", names::plain(&export.name));
    // A call may stand in a function body, where an exported macro would raise a lint.
    let exported =
        matches!(vis, Visibility::Public(_)).then(|| quote!(#[macro_export] #[allow(non_local_definitions)]));
    let name = names::field(&export.name);
    let docs = document::attributes(&documentation(export));
    quote! {
        #[doc(hidden)]
        #exported
        macro_rules! #hidden {
            (($($callback:tt)*) ($($head:tt)*) $($rest:tt)*) => {
                $($callback)* ! { $($head)* @part(#tokens) $($rest)* }
            };
        }
        #docs
        #[doc(inline)]
        #vis use #hidden as #name;
    }
}

fn documentation(export: &Export) -> Vec<String> {
    let name = names::plain(&export.name);
    let mut lines = document::item(&export.docs, &format!("Part `{name}`."));
    let ports = export.items.iter().filter(|item| item.keyword == "port");
    let ports: Vec<String> = ports.map(|port| format!("{}: ..", port.name)).collect();
    lines.extend([
        String::new(),
        "A part for the models of other calls: `use` it at the head of a call, then write".to_owned(),
        format!("`part name: {name} {{ {} }};`.", ports.join(", ")),
        String::new(),
        "| | name | |".to_owned(),
        "|---|---|---|".to_owned(),
    ]);
    lines.extend(export.items.iter().map(row));
    lines
}

/// One line of the table of items.
fn row(item: &Shown) -> String {
    let Shown { keyword, name, kind, default, docs } = item;
    let kind = kind.as_ref().map_or_else(String::new, |kind| format!(": {kind}"));
    let text = document::item(docs, "").join(" ").replace('|', "\\|");
    let default = default.as_ref().map_or_else(String::new, |default| {
        let default = document::code(default).replace('|', "\\|");
        format!(" Default: `{default}`.")
    });
    format!("| {keyword} | `{name}{kind}` | {}{default} |", text.trim())
}
