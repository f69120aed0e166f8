//! Stage `model`: where names are declared and used, for editors.
//!
//! In: the syntax tree of a call. Out: every name that is declared, with its documentation, and every use of it, each with the
//! user's own token, in source order. Values and types play no role, and nothing is reported: what a name means follows from
//! where it stands, so a model with mistakes has references as well. Each module is read once, however often it is used.

mod walk;
pub mod words;

use std::collections::{HashMap, HashSet};

use proc_macro2::Ident;
use syn::Path;

use crate::syntax::tree::{self, Home};

use super::types::Docs;
use super::{assemble, is_part};

/// All of one call.
pub struct References {
    /// Of the runtime crate.
    pub krate: Path,
    /// In source order, as in the syntax tree.
    pub modules: Vec<Module>,
    /// Places among these, by name: `cfg` lets several have one.
    places: HashMap<String, Vec<usize>>,
}

impl References {
    /// The modules of a name, in source order.
    pub fn called(&self, name: &Ident) -> &[usize] {
        self.places.get(&name.to_string()).map_or(&[], Vec::as_slice)
    }
}

/// A model or part.
pub struct Module {
    pub name: Ident,
    pub is_part: bool,
    /// Declared in another call, where its uses are followed.
    pub is_foreign: bool,
    pub docs: Docs,
    pub declared: Vec<Declared>,
    pub uses: Vec<Use>,
}

/// A name that an item declares.
pub struct Declared {
    pub name: Ident,
    pub docs: Docs,
    /// The word of [`words`] that says what it is.
    pub room: &'static str,
    pub word: &'static str,
    /// Another item of this name comes first, wherever the name is used.
    pub hidden: bool,
}

/// A token that stands for something declared elsewhere.
pub enum Use {
    /// A name of a module.
    Name { module: usize, name: Ident, is_known: bool },
    /// The kind of a part, or a model that is asked for a formula.
    Module { name: Ident, is_known: bool },
    /// A word of the language with its fields.
    Word { room: &'static str, word: Ident, fields: Vec<Ident> },
    /// A name that means something in one place alone, with the word for what it is and all that stands in that place: `|i|` in
    /// the part's braces, an argument in its function's value.
    Local { name: Ident, word: &'static str, uses: Vec<Use> },
    /// A use of that name.
    OfLocal(Ident),
}

/// Reads a call.
pub fn of(source: &tree::Source) -> References {
    let declared = |module: &tree::Module| {
        let mut list: Vec<Declared> = walk::declared(module);
        let mut before = HashSet::new();
        for declared in &mut list {
            declared.hidden = !before.insert(declared.name.to_string());
        }
        list
    };
    let mut modules: Vec<Module> = source
        .modules
        .iter()
        .map(|module| Module {
            name: module.name.clone(),
            is_part: is_part(module),
            is_foreign: module.home != Home::Own,
            docs: super::docs::docs(&module.attrs),
            declared: declared(module),
            uses: Vec::new(),
        })
        .collect();
    // A compiler's identifiers are compared by asking it for their texts, so texts are what is looked up.
    let known = walk::Known::new(source, &modules);
    let own = modules.iter().map(|module| !module.is_foreign).enumerate();
    let uses = own.map(|(index, is_own)| if is_own { walk::uses(source, &known, index) } else { Vec::new() });
    let uses: Vec<Vec<Use>> = uses.collect();
    for (module, uses) in modules.iter_mut().zip(uses) {
        module.uses = uses;
    }
    let mut places: HashMap<String, Vec<usize>> = HashMap::new();
    for (index, module) in modules.iter().enumerate() {
        places.entry(module.name.to_string()).or_default().push(index);
    }
    References { krate: source.krate.clone().unwrap_or_else(assemble::runtime), modules, places }
}
