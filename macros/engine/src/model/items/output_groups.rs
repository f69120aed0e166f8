//! Stage `model`: groups of outputs that functions of their own give.
//!
//! In: `emit outputs { name: [output, ..] }`, all outputs and the instances of parts. Out: which outputs each group holds, and the
//! fields of its struct. A path leads through parts; through an array of parts without an index it leads to the output of all.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Span};
use syn::ext::IdentExt;
use syn::spanned::Spanned;
use syn::{Expr, ExprLit, Lit, Member};

use crate::model::checker::Checker;
use crate::model::types::{GroupField, InstanceId, Output, OutputGroup};
use crate::rust_keywords::is_keyword;
use crate::syntax::tree;

use super::requests::elements;

/// A name on a path, with what stands in brackets behind it.
struct Step<'e> {
    name: &'e Ident,
    index: Option<&'e Expr>,
}

/// Where a path has led so far.
struct Reached {
    instances: Vec<InstanceId>,
    counts: Vec<usize>,
    name: Vec<String>,
}

impl<'a> Checker<'a, '_> {
    pub(in crate::model) fn output_groups(
        &mut self,
        requested: &[&'a tree::Fields],
        outputs: &[Output],
    ) -> Vec<OutputGroup> {
        let mut groups: Vec<OutputGroup> = Vec::new();
        for options in requested {
            if options.broken {
                self.report.silent();
            } else if options.list.is_empty() {
                let form = "write `outputs { name: [output, ..] }`";
                self.report.help(options.span, "no group of outputs is named", form);
            }
            for field in &options.list {
                if field.name == tree::UNREADABLE {
                    self.report.silent();
                    continue;
                }
                // The structs are told apart by their names, in which letters change their case.
                let struct_name = OutputGroup::struct_name_of(&field.name);
                let is_part = self.part_types.iter().any(|part| part.name == struct_name);
                if is_part || struct_name == "Output" {
                    let message = format!("the struct of the group `{}` would be `{struct_name}`", field.name);
                    self.report.help(field.name.span(), message, "there is one already: take another name");
                    continue;
                }
                let called = |group: &OutputGroup| group.struct_name() == struct_name;
                if groups.iter().any(called) {
                    let message = format!("the group `{}` is declared twice", field.name);
                    self.report.error(field.name.span(), message);
                    continue;
                }
                let fields = self.group_fields(&field.value, outputs);
                groups.push(OutputGroup { name: field.name.clone(), fields });
            }
        }
        groups
    }

    fn group_fields(&mut self, list: &'a Expr, outputs: &[Output]) -> Vec<GroupField> {
        let mut fields: Vec<GroupField> = Vec::new();
        let elements = elements(list);
        if elements.is_empty() {
            self.report.help(list.span(), "this group is empty", "list outputs: `name: [output, ..]`");
        }
        for element in elements {
            if is_unreadable(element) {
                self.report.silent();
                continue;
            }
            let Some(field) = self.group_field(element, outputs) else { continue };
            let known: BTreeSet<usize> = fields.iter().flat_map(|field| field.outputs.iter().copied()).collect();
            if field.outputs.iter().any(|place| known.contains(place)) || fields.iter().any(|f| f.name == field.name) {
                self.report.error(element.span(), "an output of this name is in the group already");
                continue;
            }
            fields.push(field);
        }
        fields
    }

    /// Follows a path such as `legs.foot`.
    fn group_field(&mut self, path: &'a Expr, outputs: &[Output]) -> Option<GroupField> {
        let mut steps = Vec::new();
        if !take_steps(path, &mut steps) {
            let form = "write the name of an output, or `part.output`";
            self.report.help(path.span(), "expected an output", form);
            return None;
        }
        let (last, parts) = steps.split_last()?;
        let mut at = Reached { instances: vec![InstanceId(0)], counts: Vec::new(), name: Vec::new() };
        for step in parts {
            at = self.inner_part(step, at)?;
        }
        if let Some(index) = last.index {
            let message = format!("`{}` is listed whole: its elements are not taken apart", last.name);
            self.report.error(index.span(), message);
            return None;
        }
        let of = |instance: &InstanceId| {
            outputs.iter().position(|o| o.place.instance == *instance && o.place.field == *last.name)
        };
        let Some(found) = at.instances.iter().map(of).collect::<Option<Vec<usize>>>() else {
            self.no_output(last.name, &at.instances, outputs);
            return None;
        };
        let types: Vec<_> = found.iter().map(|&place| &outputs[place].value.ty).collect();
        if types.windows(2).any(|pair| pair[0] != pair[1]) {
            let message = format!("`{}` has different types in different parts", last.name);
            self.report.help(path.span(), message, "list them one by one, with an index");
            return None;
        }
        at.name.push(plain(last.name));
        let (name, span) = (at.name.join("_"), last.name.span().resolved_at(Span::mixed_site()));
        let name = if is_keyword(&name) { Ident::new_raw(&name, span) } else { Ident::new(&name, span) };
        Some(GroupField { name, outputs: found, counts: at.counts })
    }

    /// Goes on into a part, or into all parts of an array.
    fn inner_part(&mut self, step: &Step<'a>, at: Reached) -> Option<Reached> {
        let Reached { instances, mut counts, mut name } = at;
        let mut inside = Vec::new();
        let mut array = None;
        for &instance in &instances {
            let children = self.instances.iter().enumerate();
            let children = children.filter(|(_, c)| c.parent == Some(instance) && c.field == *step.name);
            let mut children: Vec<(Option<(usize, usize)>, InstanceId)> =
                children.map(|(number, child)| (child.index, InstanceId(number))).collect();
            children.sort_unstable();
            array = children.first().and_then(|child| child.0).map(|(_, count)| count);
            inside.push(children.into_iter().map(|child| child.1).collect::<Vec<_>>());
        }
        name.push(plain(step.name));
        if inside.iter().any(Vec::is_empty) {
            let fields: BTreeSet<String> = self.instances.iter().map(|part| plain(&part.field)).collect();
            let message = format!("there is no part `{}`", step.name);
            let near = fields.iter().map(String::as_str);
            self.report.unknown(step.name.span(), message, &step.name.to_string(), near, None);
            return None;
        }
        match (step.index, array) {
            (None, None) => {}
            (None, Some(count)) => counts.push(count),
            (Some(index), None) => {
                self.report.error(index.span(), format!("`{}` is one part, not an array", step.name));
                return None;
            }
            (Some(index), Some(count)) => {
                let number = match index {
                    Expr::Lit(ExprLit { lit: Lit::Int(number), .. }) => number.base10_parse::<usize>().ok(),
                    _ => None,
                };
                let Some(number) = number.filter(|&number| number < count) else {
                    let message = format!("expected a number from 0 to {}", count - 1);
                    self.report.error(index.span(), message);
                    return None;
                };
                name.push(number.to_string());
                inside.iter_mut().for_each(|children| *children = children.drain(number..=number).collect());
            }
        }
        Some(Reached { instances: inside.concat(), counts, name })
    }

    fn no_output(&mut self, name: &Ident, instances: &[InstanceId], outputs: &[Output]) {
        let here = outputs.iter().filter(|output| instances.contains(&output.place.instance));
        let here: BTreeSet<String> = here.map(|output| plain(&output.place.field)).collect();
        let listed = (!here.is_empty()).then(|| {
            let list: Vec<&str> = here.iter().map(String::as_str).collect();
            format!("there are `{}`", list.join("`, `"))
        });
        let instead = listed.or_else(|| Some("declare it: `output name = value;`".to_owned()));
        let message = format!("there is no output `{name}`");
        self.report.unknown(name.span(), message, &name.to_string(), here.iter().map(String::as_str), instead);
    }
}

/// Whether an error has been told of it.
fn is_unreadable(expr: &Expr) -> bool {
    match expr {
        Expr::Verbatim(_) => true,
        Expr::Paren(inner) => is_unreadable(&inner.expr),
        Expr::Group(inner) => is_unreadable(&inner.expr),
        Expr::Field(field) => is_unreadable(&field.base),
        Expr::Index(index) => is_unreadable(&index.expr) || is_unreadable(&index.index),
        _ => false,
    }
}

/// Whether an expression is a path of names and indices.
fn take_steps<'e>(expr: &'e Expr, steps: &mut Vec<Step<'e>>) -> bool {
    match expr {
        Expr::Paren(inner) => take_steps(&inner.expr, steps),
        Expr::Group(inner) => take_steps(&inner.expr, steps),
        Expr::Path(path) => match path.path.get_ident().filter(|_| path.qself.is_none()) {
            Some(name) => {
                steps.push(Step { name, index: None });
                true
            }
            None => false,
        },
        Expr::Field(field) => match &field.member {
            Member::Named(name) if take_steps(&field.base, steps) => {
                steps.push(Step { name, index: None });
                true
            }
            _ => false,
        },
        Expr::Index(index) => {
            let is_path = take_steps(&index.expr, steps);
            match steps.last_mut().filter(|step| is_path && step.index.is_none()) {
                Some(step) => {
                    step.index = Some(&index.index);
                    true
                }
                None => false,
            }
        }
        _ => false,
    }
}

/// As it is in generated names.
fn plain(name: &Ident) -> String {
    name.unraw().to_string()
}
