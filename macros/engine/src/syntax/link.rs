//! Stage `syntax`: one list of modules from those of a call and of the parts that it uses.
//!
//! In: the call's own modules, and bundles, in each of which names mean what they meant in its own call. Out: all modules with
//! names of their own. Names of parts are replaced by them; what is the same part, reached by two ways, is one module, but for parts that
//! call functions of their own crate: of these no text says whether they are the same.

use std::collections::{BTreeSet, HashMap};

use proc_macro2::Ident;

use super::externals;
use super::imports::Bundle;
use super::text;
use super::tree::{Home, ItemKind, Module, Source};
use crate::diagnostics::Diagnostics;

/// Puts the modules of `bundles` behind those of the call.
pub(super) fn link(source: &mut Source, bundles: Vec<Bundle>, diagnostics: &mut Diagnostics) {
    if bundles.is_empty() {
        return;
    }
    let own: BTreeSet<String> = source.modules.iter().map(|module| module.name.to_string()).collect();
    let mut linker = Linker { taken: own.clone(), ..Linker::default() };
    let mut used: HashMap<String, Ident> = HashMap::new();
    // Inner parts take what names are left.
    linker.taken.extend(bundles.iter().map(|bundle| bundle.local.to_string()));
    for bundle in bundles {
        let local = bundle.local.clone();
        let name = local.to_string();
        if own.contains(&name) || used.contains_key(&name) {
            let owner = if own.contains(&name) { "a module of this call" } else { "another `use`" };
            let help = format!("write `use .. as other_{name};`");
            diagnostics.error_help(local.span(), format!("the name `{name}` is taken: {owner} has it"), help);
        } else if let Some(unique) = linker.bundle(bundle, true) {
            used.insert(name, unique);
        } else {
            source.lost = true;
        }
    }
    for module in &mut source.modules {
        rename(module, &used);
    }
    source.modules.append(&mut linker.modules);
}

/// Parts of a module by their new names.
fn rename(module: &mut Module, names: &HashMap<String, Ident>) {
    for item in &mut module.items {
        let ItemKind::Part(part) = &mut item.kind else { continue };
        for kind in [Some(&mut part.kind), part.again.as_mut()].into_iter().flatten() {
            if let Some(name) = names.get(&kind.to_string()) {
                *kind = Ident::new(&name.to_string(), kind.span());
            }
        }
    }
}

/// What a module is: its tokens, and the new names of the parts that these mean.
#[derive(PartialEq, Eq, Hash)]
struct Identity {
    text: String,
    parts: Vec<(String, String)>,
}

#[derive(Default)]
struct Linker {
    taken: BTreeSet<String>,
    known: HashMap<Identity, usize>,
    modules: Vec<Module>,
}

impl Linker {
    /// The new name of a bundle's part; `None` if its own call has an error.
    fn bundle(&mut self, bundle: Bundle, top: bool) -> Option<Ident> {
        let Bundle { local, entry, bundles, modules, .. } = bundle;
        let mut names: HashMap<String, Ident> = HashMap::new();
        for inner in bundles {
            let name = inner.local.to_string();
            names.insert(name, self.bundle(inner, false)?);
        }
        let mut waiting: HashMap<String, Module> =
            modules.into_iter().map(|module| (module.name.to_string(), module)).collect();
        let entry = entry.to_string();
        let wanted = top.then_some(&local);
        self.module(&entry, &entry, wanted, &mut names, &mut waiting)
    }

    /// The new name of a module, with all modules that it needs. Parts that contain themselves are no parts that work, which is
    /// told in their own call.
    fn module(
        &mut self,
        name: &str,
        entry: &str,
        wanted: Option<&Ident>,
        names: &mut HashMap<String, Ident>,
        waiting: &mut HashMap<String, Module>,
    ) -> Option<Ident> {
        let mut module = waiting.remove(name)?;
        let kinds: Vec<String> = module
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Part(part) => Some(part.kind.to_string()),
                _ => None,
            })
            .collect();
        for kind in &kinds {
            if waiting.contains_key(kind) {
                let unique = self.module(kind, entry, None, names, waiting)?;
                names.insert(kind.clone(), unique);
            }
        }
        rename(&mut module, names);
        let parts = kinds.into_iter().map(|kind| {
            let means = names.get(&kind).map_or_else(String::new, Ident::to_string);
            (kind, means)
        });
        let identity = Identity { text: text(module.tokens.clone()), parts: parts.collect() };
        // Two crates may have one text, and functions of their own for it.
        let is_told = !externals::names_its_crate(&module);
        if let Some(&known) = self.known.get(&identity).filter(|_| is_told) {
            let known = &mut self.modules[known];
            if wanted.is_some() {
                known.home = Home::Used;
            }
            return Some(known.name.clone());
        }
        module.home = if wanted.is_some() { Home::Used } else { Home::Inner };
        module.name = match wanted {
            Some(name) => name.clone(),
            None => Ident::new(&self.free(name, entry), module.name.span()),
        };
        let unique = module.name.clone();
        self.known.insert(identity, self.modules.len());
        self.modules.push(module);
        Some(unique)
    }

    /// `foot`, `leg_foot`, `leg_foot_2`, ..
    fn free(&mut self, name: &str, entry: &str) -> String {
        let long = format!("{entry}_{name}");
        let numbered = (2..).map(|number| format!("{long}_{number}"));
        let mut all = [name.to_owned(), long.clone()].into_iter().chain(numbered);
        let found = all.find(|name| !self.taken.contains(name)).unwrap_or(long.clone());
        self.taken.insert(found.clone());
        found
    }
}
