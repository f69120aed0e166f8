//! Stage `model`: from the syntax tree to the checked model.
//!
//! In: all modules of one `multibody!` call. Out: one [`types::Model`] per module without ports. Modules with ports are
//! parts; they are expanded where they are used, and a part that nobody uses is checked by itself. All mistakes are
//! reported in one go. Of a model with a mistake an outline is left (`broken`), from which emission makes what stands beside
//! the error.

mod arborescence;
mod assemble;
pub mod assumed;
mod broken;
mod changing;
mod checker;
pub(crate) mod checks;
mod docs;
mod expand;
pub mod exports;
mod expressions;
pub mod formulated;
pub mod free_bodies;
mod items;
pub mod joint_kinds;
pub(crate) mod names;
mod operands;
pub mod references;
mod report;
pub mod site;
mod topology;
mod typed;
pub mod types;
mod units;

use std::collections::{BTreeMap, BTreeSet};

use syn::spanned::Spanned;

use crate::diagnostics::Diagnostics;
use crate::syntax::tree::{self, Home, ItemKind};

use checker::Checker;
use report::Report;

/// What has become of one module that is no part.
pub struct Checked {
    pub model: types::Model,
    pub state: Soundness,
}

/// How much of a [`Checked`] model is the user's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Soundness {
    /// All of it.
    Sound,
    /// There are mistakes, but what moves and what holds it is known: its structure may be analysed.
    Whole,
    /// How bodies hang together is partly a guess.
    Guessed,
}

/// The models of one call that have no mistake.
pub fn check(source: &tree::Source, diagnostics: &mut Diagnostics) -> Vec<types::Model> {
    let checked = check_all(source, diagnostics).into_iter();
    checked.filter(|checked| checked.state == Soundness::Sound).map(|checked| checked.model).collect()
}

/// Checks all modules of one call. Of those with mistakes what is known of them is given.
pub fn check_all(source: &tree::Source, diagnostics: &mut Diagnostics) -> Vec<Checked> {
    let mut report = Report::new(diagnostics);
    let modules = modules(source, &mut report);
    let mut used: BTreeSet<usize> = BTreeSet::new();
    let mut models = Vec::new();
    let mut sound = BTreeSet::new();
    for (index, module) in source.modules.iter().enumerate() {
        if is_part(module) || module.home != Home::Own {
            continue;
        }
        // Without them the model is what was meant.
        for attr in module.attrs.iter().filter(|attr| docs::is_derive(attr)) {
            docs::refuse_derive(attr, &mut report);
        }
        report.take_failed();
        let mut checker = Checker::new(source, &modules, &sound, &mut report, false);
        let model = checker.model(index);
        let failed = checker.report.take_failed();
        let is_sound = model.is_some() && !failed;
        models.extend(match model {
            Some(model) if is_sound => Some(Checked { model, state: Soundness::Sound }),
            _ => checker.outline(index),
        });
        used.extend(checker.part_modules.iter().map(|(part, ..)| *part));
        if is_sound {
            sound.insert(index);
        }
    }
    for (index, module) in source.modules.iter().enumerate() {
        if !is_part(module) || module.home != Home::Own {
            continue;
        }
        if let Some(cfg) = module.attrs.iter().find(|a| a.path().is_ident("cfg")) {
            report.error(cfg.path().span(), "`cfg` stands on a model, not on a part");
        }
        if !used.contains(&index) {
            let mut checker = Checker::new(source, &modules, &sound, &mut report, true);
            checker.model(index);
            used.extend(checker.part_modules.iter().map(|(part, ..)| *part));
        }
    }
    // A model that isn't all of the user's is generated without equations: never without a word, here or where a part of it is declared.
    if diagnostics.is_empty()
        && !source.lost
        && let Some(untold) = models.iter().find(|checked| checked.state != Soundness::Sound)
    {
        let name = &untold.model.name;
        let message = format!("something in `{name}` can't be worked out while compiling, and nothing says what");
        diagnostics.error_help(name.span(), message, "this is an error of multibody: please report it with the model");
    }
    models
}

/// A module with ports is a part.
fn is_part(module: &tree::Module) -> bool {
    let mut items = module.items.iter();
    items.any(|item| matches!(item.kind, ItemKind::Port { .. }))
}

/// Modules by name. Two may share a name if `cfg` chooses between them.
fn modules(source: &tree::Source, report: &mut Report<'_>) -> BTreeMap<String, usize> {
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    for (index, module) in source.modules.iter().enumerate() {
        let name = module.name.to_string();
        if name == tree::UNREADABLE {
            continue;
        }
        if let Some(why) = names::module_refusal(&name) {
            report.help(module.name.span(), why, "take another name");
        }
        match found.get(&name).map(|first| &source.modules[*first]) {
            Some(first) if is_part(first) || is_part(module) || !(has_cfg(first) && has_cfg(module)) => {
                let message = format!("the name `{name}` is taken: a module above has it already");
                report.error(module.name.span(), message);
            }
            Some(_) => {}
            None => {
                found.insert(name, index);
            }
        }
    }
    found
}

fn has_cfg(module: &tree::Module) -> bool {
    module.attrs.iter().any(|attr| attr.path().is_ident("cfg"))
}
