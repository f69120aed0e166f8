//! Stage `model`: one use of a part.
//!
//! In: `part name: [kind; n] = |i| kind { .. };`. Out: the module behind it, the number of instances, its place in the
//! list of part types; errors in its fields.

use proc_macro2::Ident;
use syn::Expr;

use crate::model::checker::{Checker, Context, ScopeId};
use crate::model::expand::{MAX_ITEMS, article, declared, root};
use crate::model::typed::Allowed;
use crate::model::types::{PartType, PartTypeId};
use crate::model::{docs, names};
use crate::syntax::tree::{self, Home, ItemKind};

/// What a port of this name is given.
fn wanted(module: &tree::Module, name: &str) -> &'static str {
    let ty = module.items.iter().find_map(|item| match &item.kind {
        ItemKind::Port { name: own, ty, .. } if own == name => Some(ty.to_string()),
        _ => None,
    });
    match ty.as_deref() {
        Some("Joint") => "<joint>",
        Some("Scalar" | "Vec3") => "<value>",
        _ => "<frame>",
    }
}

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn part_module(&mut self, kind: &Ident) -> Option<usize> {
        let name = kind.to_string();
        let caller = self.expanding.last().map_or(Home::Own, |&index| self.source.modules[index].home);
        // Parts of a part are known where that one was declared.
        let knows = |module: &tree::Module| caller != Home::Own || module.home != Home::Inner;
        match self.modules.get(&name).filter(|&&index| knows(&self.source.modules[index])) {
            Some(&index) => {
                let module = &self.source.modules[index];
                if crate::model::is_part(module) {
                    return Some(index);
                }
                self.report.help(
                    kind.span(),
                    format!("`{name}` is a model, not a part"),
                    "a part has at least one `port name: Frame;`",
                );
            }
            None if self.source.lost => self.report.silent(),
            None => {
                let source = self.source;
                let parts = source.modules.iter().filter(|m| crate::model::is_part(m) && knows(m));
                let parts: Vec<String> = parts.map(|m| m.name.to_string()).collect();
                self.report.unknown(
                    kind.span(),
                    format!("unknown part `{name}`"),
                    &name,
                    parts.iter().map(String::as_str),
                    Some("declare it in this call, or write `use path::of::it;` at its head".into()),
                );
            }
        }
        None
    }

    pub(in crate::model) fn part_count(&mut self, expr: &'a Expr, scope: ScopeId) -> Option<usize> {
        let count = self.whole_number(expr, root(scope))?;
        match usize::try_from(count) {
            Ok(count) if (1..=MAX_ITEMS).contains(&count) => Some(count),
            _ => {
                self.report.error(
                    crate::model::expressions::span(expr),
                    format!("expected a number of parts between 1 and {MAX_ITEMS}, found {count}"),
                );
                None
            }
        }
    }

    /// Entry in the model's list of part types. All instances of one must set the same params: they share a struct.
    pub(in crate::model) fn part_type(&mut self, index: usize, part: &'a tree::Part) -> PartTypeId {
        let module = &self.source.modules[index];
        let mut set: Vec<String> = module
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Param(value) => Some(value.name.to_string()),
                _ => None,
            })
            .filter(|name| part.fields.list.iter().any(|field| field.name == *name))
            .collect();
        set.sort();
        set.dedup();
        if let Some((id, (_, first, name))) = self.part_modules.iter_ids().find(|(_, (m, ..))| *m == index) {
            if *first != set {
                let list = match first.as_slice() {
                    [] => "none".to_string(),
                    some => format!("`{}`", some.join("`, `")),
                };
                self.report.help(
                    part.name.span(),
                    format!("all parts of type `{}` in one model must set the same params", module.name),
                    format!("`{name}` sets {list}"),
                );
            }
            return id;
        }
        self.part_modules.push((index, set, part.name.to_string()));
        self.part_types.push(PartType { name: module.name.clone(), docs: docs::docs(&module.attrs) })
    }

    /// `|i|` belongs to arrays, and hides nothing.
    pub(in crate::model) fn check_index(&mut self, part: &'a tree::Part, scope: ScopeId) {
        let Some(index) = &part.index else { return };
        let name = index.to_string();
        let is_taken = self.scopes[scope].names.contains_key(&name);
        if part.count.is_none() {
            self.report.help(
                index.span(),
                "an index belongs to an array of parts",
                format!("write `part {}: [{}; n] = |{name}| ..`", part.name, part.kind),
            );
        } else if let Some(why) = names::refusal(&name) {
            self.report.help(index.span(), why, "take another name for the index");
        } else if is_taken {
            let message = format!("the name `{name}` is taken in this model");
            self.report.help(index.span(), message, "take another name for the index");
        }
    }

    pub(in crate::model) fn check_part_fields(&mut self, part: &'a tree::Part, index: usize) {
        let module = &self.source.modules[index];
        let settable: Vec<(String, &str)> = module
            .items
            .iter()
            .filter_map(|item| declared(&item.kind))
            .map(|(name, keyword)| (name.to_string(), keyword))
            .collect();
        let mut seen: Vec<String> = Vec::new();
        for field in &part.fields.list {
            let name = field.name.to_string();
            if seen.contains(&name) {
                let message = format!("the field `{name}` is given twice");
                self.report.error(field.name.span(), message);
                continue;
            }
            let of_name = || settable.iter().filter(|(known, _)| *known == name);
            let set = of_name().find(|(_, keyword)| matches!(*keyword, "port" | "param"));
            match set.or_else(|| of_name().next()) {
                Some((_, "port" | "param")) => {}
                Some((_, keyword)) => self.report.error(
                    field.name.span(),
                    format!(
                        "only ports and params can be set: `{name}` is {} `{keyword}` of `{}`",
                        article(keyword),
                        part.kind
                    ),
                ),
                None => self.report.unknown(
                    field.name.span(),
                    format!("the part `{}` has no port or param `{name}`", part.kind),
                    &name,
                    settable
                        .iter()
                        .filter(|(_, keyword)| matches!(*keyword, "port" | "param"))
                        .map(|(name, _)| name.as_str()),
                    None,
                ),
            }
            seen.push(name);
        }
        let missing: Vec<&str> = settable
            .iter()
            .filter(|(name, keyword)| *keyword == "port" && !seen.contains(name))
            .map(|(name, _)| name.as_str())
            .collect();
        if part.fields.broken {
            self.report.silent();
        } else if let [first, ..] = missing.as_slice() {
            self.report.help(
                part.name.span(),
                format!("the port `{}` of `{}` is not bound", missing.join("`, `"), part.kind),
                format!("write `{first}: {}` between the braces", wanted(module, first)),
            );
        }
    }

    /// A compile-time whole number.
    pub(in crate::model) fn whole_number(&mut self, expr: &Expr, context: Context<'a>) -> Option<i64> {
        let span = crate::model::expressions::span(expr);
        let value = self.scalar(expr, context, Allowed::Constants)?;
        let number = self.evaluator.scalar(&value.expr)?;
        if number.fract() == 0.0 && number.abs() < 1e15 {
            return Some(number as i64);
        }
        let message = format!("expected a whole number, found {number}");
        self.report.error(span, message);
        None
    }
}
