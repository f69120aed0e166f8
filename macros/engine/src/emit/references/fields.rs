//! Room `references`: names inside a call as fields of the generated structs.
//!
//! In: the references of a call; a model of it. Out: for each use of a name the fields of that name, so that renaming changes
//! the model and the code that reads its state alike.

use std::collections::{BTreeMap, HashMap, HashSet};

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::emit::layout::{Layout, StructKind};
use crate::emit::names;
use crate::mechanics::loops::structure::Structure;
use crate::model::references::{Declared, References, Use};
use crate::model::types::{Model, PartTypeId};

/// Expands to `const _: () = { fn uses0(all: &pendulum::Params) { let _ = all.length; .. } .. };`.
pub fn fields(references: &References, model: &Model, structure: &Structure) -> TokenStream {
    let layout = Layout::new(model, structure);
    // In source order.
    let mut owners: BTreeMap<usize, Owner> = BTreeMap::new();
    let is_part = |module: usize| references.modules.get(module).is_some_and(|module| module.is_part);
    let models = references.called(&model.name).iter().filter(|&&module| !is_part(module));
    owners.extend(models.map(|&module| (module, None)));
    for (number, part) in model.part_types.iter().enumerate() {
        let parts = references.called(&part.name).iter().filter(|&&module| is_part(module));
        owners.extend(parts.map(|&module| (module, Some(PartTypeId(number)))));
    }
    // What names of each module are used by this model and its parts.
    let mut used: HashMap<usize, Vec<(&Ident, String)>> = HashMap::new();
    for module in owners.keys().filter_map(|&module| references.modules.get(module)) {
        each_name(&module.uses, &mut |module, name| used.entry(module).or_default().push((name, name.to_string())));
    }
    let mut structs: Vec<(StructKind, Owner, TokenStream)> = Vec::new();
    for (&index, &owner) in &owners {
        for group in StructKind::ALL.into_iter().filter(|group| !layout.is_empty(*group, owner)) {
            let fields = layout.fields(group, owner);
            let declared = references.modules.get(index).into_iter().flat_map(|module| &module.declared);
            let declared = declared.filter(|declared| !declared.hidden && holds(group, declared));
            let named: HashSet<String> = declared.map(|declared| declared.name.to_string()).collect();
            let found = fields.into_iter().filter(|field| named.contains(&field.name.to_string()));
            let found: HashMap<String, Ident> = found.map(|field| (field.name.to_string(), field.name)).collect();
            let mut statements = TokenStream::new();
            for (name, text) in used.get(&index).into_iter().flatten() {
                if let Some(field) = found.get(text) {
                    let mut field = field.clone();
                    field.set_span(names::field(name).span());
                    statements.extend(quote!(let _ = all.#field;));
                }
            }
            if !statements.is_empty() {
                structs.push((group, owner, statements));
            }
        }
    }
    if structs.is_empty() {
        return TokenStream::new();
    }
    let module = names::field(&model.name);
    let functions = structs.iter().enumerate().map(|(number, (group, owner, statements))| {
        let name = names::ident(&format!("uses{number}"));
        let path = layout.path(*group, *owner, false);
        quote!(fn #name(all: &#module::#path) { #statements })
    });
    let cfg = model.attrs.iter().filter(|attr| attr.path().is_ident("cfg") || attr.path().is_ident("cfg_attr"));
    quote! {
        #(#cfg)*
        const _: () = { #(#functions)* };
    }
}

/// The model itself, or a part.
type Owner = Option<PartTypeId>;

/// Whether a struct's field of this name is what was declared: an output may have the name of something else.
fn holds(group: StructKind, declared: &Declared) -> bool {
    match declared.word {
        "Part" => true,
        "Param" => group == StructKind::Params,
        "Input" => group == StructKind::Input,
        "State" => group == StructKind::States,
        "Output" => group == StructKind::Output,
        "Speed" => group == StructKind::Velocity,
        // A body may have coordinates of its own, which are joints' too.
        "Body" => matches!(
            group,
            StructKind::Position | StructKind::Velocity | StructKind::Rates | StructKind::Guess | StructKind::Poses
        ),
        "Const" | "Let" | "Function" | "Port" | "Force" | "Constraint" | "Unknown" => false,
        _ => matches!(group, StructKind::Position | StructKind::Velocity | StructKind::Rates | StructKind::Guess),
    }
}

/// Calls `f` with each use of a module's name.
fn each_name<'a>(uses: &'a [Use], f: &mut impl FnMut(usize, &'a Ident)) {
    for used in uses {
        match used {
            Use::Name { module, name, is_known: true } => f(*module, name),
            Use::Local { uses, .. } => each_name(uses, f),
            _ => {}
        }
    }
}
